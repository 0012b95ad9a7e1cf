"""Headers of the report's tables: a description of each column, with its unit."""

# Descriptions of columns whose names a reader would not understand.
HEADERS = {
    "rms_velocity": "root mean square error of the velocity at separation",
    "max_velocity": "largest error of the velocity at separation",
    "rms_peak_friction": "root mean square error of the largest friction",
    "max_peak_friction": "largest error of the largest friction",
    "rms_dissipation": "root mean square error of the work of friction",
    "max_dissipation": "largest error of the work of friction",
    "times_spheres": "time over that of the table of spheres",
    "restitution": "restitution e",
    "incidence": "incidence v1(0)/(mu v2(0))",
    "mass_ratio": "mass ratio m2/m1",
    "stiffness_ratio": "stiffness ratio zeta^2",
}
SPELLED = {"us": "µs"}


def header(column: str) -> str:
    """Description of a column, with its unit after a comma.

    >>> header("max_velocity [mu v2(0)]")
    'largest error of the velocity at separation, mu v2(0)'
    >>> header("incidence [mu v2(0)]"), header("young_modulus [Pa]")
    ('incidence v1(0)/(mu v2(0))', 'young modulus, Pa')
    """
    name, _, unit = column.rstrip("]").partition(" [")
    plain = HEADERS.get(name, name.replace("_", " "))
    ratio = name == "incidence"  # its description has the unit
    return plain if ratio or unit in ("", "1") else f"{plain}, {SPELLED.get(unit, unit)}"
