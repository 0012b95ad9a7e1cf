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
    start, end = f"{curve}; ", f" {SIGNS[1]} 1 sigma"
    own = [name for name in names if name.startswith(start) and name.endswith(end)]
    parameters = [name.removeprefix(start).removesuffix(end) for name in own]
    return [
        (shifted(f"{curve}", parameter, 1), shifted(f"{curve}", parameter, -1))
        for parameter in parameters
    ]


def is_printed(name: str) -> bool:
    """Whether a curve holds what the printed equations give.

    >>> is_printed("no solution as printed, e = 1"), is_printed("e = 1")
    (True, False)
    """
    return AS_PRINTED in name


def is_shifted(name: str) -> bool:
    """Whether one of the parameters of a curve is off by its uncertainty.

    >>> is_shifted(shifted("lumped", "friction", -1)), is_shifted("lumped")
    (True, False)
    """
    return name.endswith("1 sigma")
