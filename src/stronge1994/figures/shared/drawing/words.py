"""What the words of a picture mean: one dictionary for axes, one for legends and labels.

A meaning is a pattern of "curve: column". The checker of drawings looks it up.
"""

import re
from collections.abc import Sequence

from stronge1994.figures.shared.drawing import house_style

_LARGEST = r": peak_force \[m2 Omega S\]"
_VELOCITY = r": velocity \[mu v2\(0\)\]"
_INCIDENCE = r": incidence \[(mu v2\(0\)|cell)\]"
_ANGLE = r": angle \[deg\]"
_TIME = r": time \[t_c\]"

# Labels of axes, without the letter of the panel.
AXES = {
    "normal deflection $u_2$": r"^normal.*: deflection",
    "normal force $F_2$": r"^normal.*: force",
    "tangential deflection $u_1$": r"^tangential: deflection",
    "tangential force $F_1$": r"^tangential: force",
    "$t/t_c$": _TIME,
    "force": r": (normal_force|friction_force|friction_limit) ",
    r"velocity $v_1(t)/\mu v_2(0)$": _VELOCITY,
    house_style.INCIDENCE: _INCIDENCE,
    house_style.REBOUND: _VELOCITY,
    r"angle of incidence $\theta$": _ANGLE,
    r"largest force over $m_2\Omega S$": _LARGEST,
    rf"${house_style.F1MAX}$ over $m_2\Omega S$": f"mu = .*{_LARGEST}",
    "largest normal force, N": r"normal.*: peak_force \[N\]",
    "largest tangential force, N": r"friction.*: peak_force \[N\]",
    r"dissipated by friction, $2D_1/m_2S^2$": r": friction_dissipation \[m2 S\^2/2\]",
    r"radius over $a_\mathrm{max}$": r": (contact|stick)_radius \[a_max\]",
    "restitution $e$": r": restitution \[(1|cell)\]",
    r"tangential restitution $\beta_0$": r": tangential_restitution \[1\]",
    r"$\chi^2$ of pairs": r": chi_squared \[1\]",
    "steps or circles": r": (steps|circles) \[1\]",
    "time of an impact (ms)": r": time \[ms\]",
    "time of an impact (µs)": r": time_?\d* \[us\]",
    r"error of $v_1(t_f)/\mu v_2(0)$": r": error \[mu v2\(0\)\]",
    r"error of $v_1(t_f)/\mu v_2(0)$, rms": r": rms_velocity \[mu v2\(0\)\]",
    "error, rms": r"^LAMMPS .*: rms_velocity \[mu v2\(0\)\]",
    "impacts together": r": impacts \[1\]",
    "distance from the first impact (m)": r": place \[m\]",
    "height (m)": r": height \[m\]",
    r"tilt $\alpha$": r": tilt \[deg\]",
    r"$v_1(t_f)/v_2(0)$": r": tangential_velocity \[v2\(0\)\]",
    r"$v_2(t_f)/v_2(0)$": r": normal_velocity \[v2\(0\)\]",
    "$K(t_f)/K(0)$": r": kinetic_energy \[K0\]",
    r"$\Omega t$": r": time \[1/Omega\]",
    r"force$/m_2\Omega v_2(0)$": r": (normal_force|friction_over_mu) ",
    r"$\omega/\Omega$": r": omega \[cell\]",
    "digits found": r": digits \[1\]",
    "digits allowed by the condition": r": digits_allowed \[1\]",
    "digits of the worst output, median of a cell": r": median \[1\]",
    "$m_2/m_1$": r": mass_ratio",
    r"$\zeta^2$": r": stiffness_ratio",
}

# Units in mathematical letters; others are written as they are.
UNITS = {
    "mu v2(0)": r"$\mu v_2(0)$",
    "v2(0)/Omega": r"$v_2(0)/\Omega$",
    "1/Omega": r"$1/\Omega$",
    "t_c": "$t_c$",
    "sigma": r"$\sigma$",
}

# Parts of the words of a legend or of a label, as patterns.
LEGEND = {
    r"^\$F_2": ": normal_force ",
    r"^\$F_1/": ": friction_(force|over_mu) ",
    "without friction": "mu = 0",
    r"limit \$-": ": friction_limit ",
    "^contact$": ": contact_radius ",
    "^stick$": ": stick_radius ",
    "separation": ": velocity ",
    "lumped model|lumped, as in the paper|^lumped$": r"^(response of )?(lumped|e = |mu = )(?!\.)",
    r"lumped, (repaired|plastic)": r"^lumped\.plastic",
    "lumped, (Kelvin–Voigt|viscous)": r"^lumped\.viscous",
    "elastic continuum": "^continuum[,:]",
    "continuum, rubber|^continuum$": "^(response of )?continuum[,:]",
    "continuum, visco": r"continuum\.viscous",
    "continuum, (elastic-)?plastic": r"continuum\.plastic",
    "table, viscous": r"spheres\.viscous",
    "table, plastic": r"spheres\.plastic",
    "no tangential compliance": "^no tangential compliance",
    "rubber": "rubber",
    "finite elements": "chung_ooi2011|finite elements",
    "Kharaz": "kharaz2001",
    "Lewis": "lewis_rogers1988",
    "Eqs .* as printed": "^as printed",
    "no solution as printed": "^no solution as printed",
    r"^normal, ": "normal",
    r"^tangential, ": "mu = |friction",
    "^slip throughout$": "^slip throughout",
    r"of the model$": "^friction",
    r"^as in \(a\)": "^mu = ",
    "^compliant$": "^v1/v2",
    "^rigid impulse$": "^rigid, v1/v2",
    "Newton|creates energy": "^rigid, Newton",
    "^jams": "jam",
    "linear spring": "timestep.linear",
    "^Mindlin$": r"timestep\.mindlin[,:]",
    "Mindlin, rescaled": "mindlin_rescaled",
    "^annuli$": "^annuli",
    "^formula$": "^(rigid|laws)",
    "^LAMMPS: see": "^LAMMPS ",
}
# Equations that name a curve, such as e = 0.5.
_EQUATION = re.compile(r"(\\?\b(?:mu|nu|e|x)) = (-?[\d.]+)")


def of_column(column: str) -> str:
    """Name of a column for a reader.

    Examples
    --------
    >>> of_column("rebound_angle [deg]"), of_column("velocity [mu v2(0)]"), of_column("digits [1]")
    ('rebound angle [deg]', 'velocity [$\\\\mu v_2(0)$]', 'digits')
    """
    name, _, unit = column.rstrip("]").partition(" [")
    return name.replace("_", " ") + ("" if unit == "1" else f" [{UNITS.get(unit, unit)}]")


def of_axis(label: str, curve: str, column: str) -> bool:
    """Whether a column may be drawn along an axis with a label.

    Examples
    --------
    >>> of_axis("$t/t_c$", "e = 1", "time [t_c]"), of_axis("force", "e = 1", "time [t_c]")
    (True, False)
    """
    if pattern := AXES.get(label):
        return bool(re.search(pattern, f"{curve}: {column}"))
    return label == of_column(column)


def names_a_curve(words: str) -> bool:
    """Whether a part of some words has a meaning.

    Examples
    --------
    >>> names_a_curve("$e = 0.5$"), names_a_curve("maximum compression")
    (True, False)
    """
    return bool(_EQUATION.search(words)) or any(re.search(part, words) for part in LEGEND)


def of_curve(words: str, curve: str, columns: Sequence[str]) -> bool:
    """Whether words may name a curve, some columns of which are drawn.

    Examples
    --------
    >>> of_curve("$e = 0.5$", "e = 0.5", []), of_curve("$e = 0.5$", "e = 1", [])
    (True, False)
    >>> of_curve("normal, $F_2$", "friction", ["peak_force [N]"])
    False
    """
    drawn = [f"{curve}: {column} " for column in columns] or [f"{curve}: "]
    asked = [pattern for part, pattern in LEGEND.items() if re.search(part, words)]
    said = {symbol.lstrip("\\"): value for symbol, value in _EQUATION.findall(words)}
    own = dict(_EQUATION.findall(curve))
    if not asked and not said.keys() & own.keys():
        return words.split(":")[0] == curve.split(":")[0] or words in curve
    return all(own.get(symbol, value) == value for symbol, value in said.items()) and all(
        any(re.search(pattern, one) for one in drawn) for pattern in asked
    )
