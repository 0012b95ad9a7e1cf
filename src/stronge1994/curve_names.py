"""Names of curves, columns, figures and scenes, for those who solve, draw, judge and show them."""

import re
from collections.abc import Iterable

# A curve of the printed equations begins with one of these.
AS_PRINTED, NO_SOLUTION = "as printed", "no solution as printed"
SIGNS = {1: "+", -1: "-"}
# Beginning of the name of a parameter of which each point of the curve has its own value.
EACH = "each "
# Continua that lose energy by relaxation, with one time in shear and compression, or by yield; and
# all models that are held against measurements below e = 1.
CONTINUA = ("continuum.viscous", "continuum.plastic")
MODELS = (*CONTINUA, "lumped.viscous", "lumped.unloading-stiffness", "lumped.hysteretic")
# Models without loss, and for comparison alone, see `planarimpact.continuum.rebound`.
ELASTIC, ELASTIC_IN_SHEAR = "continuum", "continuum.plastic-elastic-shear"
SCENE = "scene_"  # before the name of a scene, among what is judged

GREEK = {"mu": "μ", "nu": "ν"}
# Units whose names in tables a reader would not understand.
UNITS = {
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


def is_of_paper(figure: str) -> bool:
    """Whether a figure is one of Figs 2 to 9 of the paper."""
    return re.fullmatch("fig[2-9]", figure) is not None


def name(symbol: str, value: float) -> str:
    """Name of a curve by a parameter, the same in curves and in reference data.

    >>> name("e", 0.50)
    'e = 0.5'
    """
    return f"{symbol} = {value:g}"


def shifted(curve: str, parameter: str, sign: int) -> str:
    """Name of a curve whose parameter is off by its uncertainty.

    >>> shifted("lumped.hysteretic, experiment", "friction", 1)
    'lumped.hysteretic, experiment; friction + 1 sigma'
    """
    return f"{curve}; {parameter} {SIGNS[sign]} 1 sigma"


def shifted_by(curve: str | None, names: Iterable[str]) -> list[tuple[str, str]]:
    """Names of curves that differ from `curve` by the uncertainty of a parameter, up and down.

    >>> names = ["a", "b", "b; friction + 1 sigma", "b; friction - 1 sigma"]
    >>> shifted_by("a", names), shifted_by("b", names)
    ([], [('b; friction + 1 sigma', 'b; friction - 1 sigma')])
    """
    end = f" {SIGNS[1]} 1 sigma"
    ups = [up for up in names if up.startswith(f"{curve}; ") and up.endswith(end)]
    return [(up, f"{up.removesuffix(end)} {SIGNS[-1]} 1 sigma") for up in ups]


def is_shifted(name: str) -> bool:
    """Whether one of the parameters of a curve is off by its uncertainty.

    >>> is_shifted(shifted("lumped", "friction", -1)), is_shifted("lumped")
    (True, False)
    """
    return name.endswith("1 sigma")


def words(identifier: str) -> str:
    """The words of an identifier, with Greek letters.

    >>> words("contact-nu-0.3"), words("peak_over_mu_normal")
    ('contact ν 0.3', 'peak over μ normal')
    """
    return " ".join(GREEK.get(word, word) for word in re.split("[-_]", identifier))


def column(name: str) -> str:
    r"""Name of a column of a table, with its unit after a comma.

    >>> column("largest_error [mu v2(0)]"), column("restitution [1]")
    ('largest error, $\\mu v_2(0)$', 'restitution')
    """
    quantity, _, unit_name = name.rstrip("]").partition(" [")
    written = UNITS.get(unit_name, unit_name)
    return words(quantity) + (f", {written}" if written else "")


def unit(name: str) -> str:
    r"""What stands behind a number: a space and a unit, or the sign of degrees.

    >>> unit("mu v2(0)"), unit("N"), unit("deg"), unit("1")
    (' $\\mu v_2(0)$', ' N', '°', '')
    """
    written = UNITS.get(name, name)
    return f" {written}" if written not in ("", "°") else written
