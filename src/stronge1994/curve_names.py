"""Names of curves, figures and scenes, spelled here for those who solve, draw and judge them."""

from collections.abc import Iterable

# A curve of the printed equations begins with one of these.
AS_PRINTED, NO_SOLUTION = "as printed", "no solution as printed"
SIGNS = {1: "+", -1: "-"}
# Beginning of the name of a parameter of which each point of the curve has its own value.
EACH = "each "
SCENE = "scene_"  # before the name of a scene, among what is judged


def is_of_paper(figure: str) -> bool:
    """Whether a figure is one of the paper's."""
    return figure.startswith("fig") and figure[3:].isdigit()


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
