"""Fig. 6: tangential velocity at separation against incidence, for several restitutions."""

from matplotlib.figure import Figure

from stronge1994 import tables
from stronge1994.figures.shared.drawing import house_style, model_lines
from stronge1994.figures.shared.drawing.house_style import OURS, PAPERS, Points, Settings
from stronge1994.names import CONTINUA
from stronge1994.tables import Table

X, Y = "incidence [mu v2(0)]", "velocity [mu v2(0)]"
PALE = house_style.LUMPED | {"color": "0.6", "linewidth": 1.0}


def draw(curves: Table, settings: Settings, points: Points) -> Figure:
    """Draw (a) a curve for each restitution; (b) the printed equations and the continua."""
    figure = house_style.new(6.0)
    axes, below = figure.subplots(2, sharex=True, height_ratios=[4, 3])
    read, others = house_style.of_print(points)
    for e, curve in tables.each(curves, "e", model="lumped"):
        pattern = {"linestyle": house_style.of_restitution(e), "label": "_"}
        house_style.line(axes, curve, X, Y, **house_style.LUMPED | pattern)
        house_style.line(below, curve, X, Y, **PALE | pattern)
        # Where slip lasts throughout, the curves are parallel.
        at = settings["incidence"][1] * 0.88
        house_style.name_curve(axes, curve, X, Y, f"$e = {e:g}$", at)
    series = house_style.references(axes, read, X, Y)
    printed = house_style.as_printed(below, curves, X, Y, "Eqs 15, 25")
    continua = curves[tables.where(curves, model=CONTINUA)]
    models = [
        line
        for e, own in continua.groupby("e", sort=False)
        for line in model_lines.draw(below, own, X, Y, f", $e = {e:g}$")
    ]
    series |= house_style.references(below, others, X, Y)
    for panel in (axes, below):
        panel.axhline(0, **house_style.GUIDE)
    axes.set(xlim=settings["incidence"], ylim=(-3, None))
    house_style.letter([axes, below], [PAPERS, f"{OURS}; grey: curves of (a)"])
    house_style.above_each_other([axes, below])
    house_style.legend_below(figure, [*printed, *series.values()], models)
    return figure
