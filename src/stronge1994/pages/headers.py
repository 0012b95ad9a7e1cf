"""Headers of the report's tables: a description of each column, with its unit."""

# Descriptions of columns whose names a reader would not understand.
HEADERS = {
    "rms_velocity": "root mean square error of the velocity at separation",
    "max_velocity": "largest error of the velocity at separation",
    "rms_peak_friction": "root mean square error of the largest friction",
    "max_peak_friction": "largest error of the largest friction",
    "rms_dissipation": "root mean square error of the work of friction",
    "max_dissipation": "largest error of the work of friction",
    "time": "time of an impact in the batch",
    "batch": "impacts in the batch",
    "time_alone": "time of an impact alone",
    "times_spheres": "over the time of the table of spheres",
    "restitution": "restitution $e$",
    "incidence": r"incidence $v_1(0)/(\mu v_2(0))$",
    "mass_ratio": r"mass ratio $m_2/m_1$",
    "stiffness_ratio": r"stiffness ratio $\zeta^2$",
}
# Units whose names in tables a reader would not understand.
UNITS = {
    "": "",
    "1": "",
    "us": "µs",
    "deg": "°",
    "kg/m^3": "kg/m³",
    "t_c": "$t_c$",
    "1/Omega": r"$1/\Omega$",
    "v2(0)": "$v_2(0)$",
    "v2(0)/Omega": r"$v_2(0)/\Omega$",
    "mu v2(0)": r"$\mu v_2(0)$",
    "mu v2(0)/R": r"$\mu v_2(0)/R$",
    "F2max": r"$F_{2\mathrm{max}}$",
    "mu F2max": r"$\mu F_{2\mathrm{max}}$",
    "m2 Omega S": r"$m_2 \Omega S$",
    "m2 Omega v2(0)": r"$m_2 \Omega v_2(0)$",
    "mu m2 Omega v2(0)": r"$\mu m_2 \Omega v_2(0)$",
    "m2 S^2/2": "$m_2 S^2/2$",
    "mu^2 m2 v2(0)^2": r"$\mu^2 m_2 v_2(0)^2$",
    "K0": "$K_0$",
    "a_max": r"$a_{\mathrm{max}}$",
    "delta_max": r"$\delta_{\mathrm{max}}$",
}


def header(column: str) -> str:
    r"""Description of a column, with its unit after a comma.

    >>> header("max_velocity [mu v2(0)]")
    'largest error of the velocity at separation, $\\mu v_2(0)$'
    >>> header("incidence [mu v2(0)]"), header("young_modulus [Pa]")
    ('incidence $v_1(0)/(\\mu v_2(0))$', 'young modulus, Pa')
    """
    name, _, unit = column.rstrip("]").partition(" [")
    plain = HEADERS.get(name, name.replace("_", " "))
    ratio = name == "incidence"  # its description has the unit
    return plain if ratio or unit in ("", "1") else f"{plain}, {UNITS.get(unit, unit)}"


def unit(name: str) -> str:
    """What stands behind a number: a space and a unit, or the sign of degrees.

    >>> unit("mu v2(0)"), unit("N"), unit("deg"), unit("1")
    (' $\\\\mu v_2(0)$', ' N', '°', '')
    """
    written = UNITS.get(name, name)
    return f" {written}" if written not in ("", "°") else written
