"""Lines of several models of an impact, beside measured points with their errors.

A colour stands for the cause of the loss: black for the normal element of the paper, purple for the
same with e^2 zeta^2, vermillion and orange for plastic flow, blue for viscosity, green for none.
"""

from collections.abc import Iterable

from matplotlib.axes import Axes

from stronge1994.csv_tables import Curves
from stronge1994.figures.shared.drawing import house_style
from stronge1994.figures.shared.drawing.house_style import DASHES, Entries, Style

# Models that are held against every measurement below e = 1.
MODELS = (
    "lumped.hysteretic",
    "lumped.unloading-stiffness",
    "lumped.viscous",
    "continuum.plastic",
    "continuum.viscous",
)
# Of them the continua stand beside the figures of the paper.
CONTINUA = ("continuum.viscous", "continuum.plastic")
# One has no loss, and one serves for comparison alone, see `planarimpact.continuum.rebound`.
ELASTIC, ELASTIC_IN_SHEAR = "continuum", "continuum.plastic-elastic-shear"
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
        (ELASTIC, "elastic continuum", house_style.GREEN, DASHES[1], "P"),
        (ELASTIC_IN_SHEAR, "plastic, elastic in shear", house_style.VERMILLION, DASHES[1], "<"),
    )
}
POINT: Style = {"color": house_style.BLACK, "marker": "o", "markerfacecolor": "white"}
POINT |= {"markersize": 3.6, "linestyle": "none"}


def lines(
    axes: Axes, curves: Curves, end: str, x: str, y: str, models: Iterable[str] = MODELS
) -> Entries:
    """Draw the curve `<model>, <end>` of each model; entries of the legend, with the last part."""
    entries = []
    for model in models:
        label = f"{STYLES[model]['label']}, {house_style.symbols(end.split(', ')[-1])}"
        style = STYLES[model] | {"label": label, "marker": ""}
        entries.append(house_style.line(axes, curves, f"{model}, {end}", x, y, **style))
    return entries
