"""Lines of several models of an impact, as they are compared with measured points.

A colour stands for the cause of the loss: black for the normal element of the paper, purple for the
same with e^2 zeta^2, orange for plastic flow, blue for viscosity, green for none.
"""

from matplotlib.axes import Axes

from stronge1994.figures.shared.drawing import house_style
from stronge1994.figures.shared.drawing.house_style import DASHES, Entries, Style
from stronge1994.names import ELASTIC
from stronge1994.tables import Table

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
    )
}
POINT: Style = house_style.POINT | {"color": house_style.BLACK, "linestyle": "none"}


def draw(axes: Axes, curves: Table, x: str, y: str, note: str = "") -> Entries:
    """Draw curves, one of each model, in the style of the model; `note` ends their labels."""
    return [
        house_style.line(
            axes,
            own,
            x,
            y,
            **STYLES[model] | {"label": STYLES[model]["label"] + note, "marker": ""},
        )
        for model, own in curves.groupby("model", sort=False)
    ]
