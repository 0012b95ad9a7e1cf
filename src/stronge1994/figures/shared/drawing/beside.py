"""Lines of several models of an impact, beside measured points with their errors.

A colour stands for the cause of the loss: black for the normal element of the paper, purple for the
same with e^2 zeta^2, vermillion and orange for plastic flow, blue for viscosity, green for none.
"""

from collections.abc import Iterable

from matplotlib.axes import Axes

from stronge1994 import curve_names
from stronge1994.csv_tables import Curves
from stronge1994.curve_names import ELASTIC, ELASTIC_IN_SHEAR
from stronge1994.figures.shared.drawing import house_style
from stronge1994.figures.shared.drawing.house_style import DASHES, Entries, Style

MODELS = curve_names.MODELS[::-1]  # those of the paper's kind first
# Each model's line with its marks.
STYLES: dict[str, Style] = {
    model: {"label": label, "color": colour, "linestyle": dashes, "marker": marker}
    | {"linewidth": 1.1, "zorder": 1.9, "markersize": 3.4, "markeredgewidth": 0.8}
    | {"markerfacecolor": "white"}
    for model, label, colour, dashes, marker in (
        ("lumped.hysteretic", "lumped, as in the paper", house_style.BLACK, "-", "o"),
        ("lumped.unloading-stiffness", r"lumped, $e^2\zeta^2$", house_style.PURPLE, DASHES[1], "D"),
        ("lumped.viscous", "lumped, Kelvin–Voigt", house_style.BLUE, DASHES[2], "s"),
        ("continuum.plastic", "continuum, plastic", house_style.ORANGE, DASHES[3], "^"),
        ("continuum.viscous", "continuum, viscous", house_style.SKY, DASHES[4], "v"),
        (ELASTIC, "elastic continuum, $e = 1$", house_style.GREEN, DASHES[1], "P"),
        (ELASTIC_IN_SHEAR, "plastic, elastic in shear", house_style.VERMILLION, DASHES[1], "<"),
    )
}
POINT: Style = {"color": house_style.BLACK, "marker": "o", "markerfacecolor": "white"}
POINT |= {"markersize": 3.6, "linestyle": "none"}


def lines(
    axes: Axes,
    curves: Curves,
    end: str,
    x: str,
    y: str,
    models: Iterable[str] = MODELS,
    note: str = "",
) -> Entries:
    """Draw the curve `<model>, <end>` of each model; `note` ends their labels."""
    entries = []
    for model in models:
        style = STYLES[model] | {"label": STYLES[model]["label"] + note, "marker": ""}
        entries.append(house_style.line(axes, curves, f"{model}, {end}", x, y, **style))
    return entries
