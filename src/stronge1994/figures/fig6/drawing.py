"""Fig. 6: tangential velocity at separation against incidence, for several restitutions."""

from matplotlib.figure import Figure

from stronge1994 import tables
from stronge1994.figures.shared.drawing import house_style, model_lines
from stronge1994.figures.shared.drawing.house_style import Points, Settings
from stronge1994.names import CONTINUA
from stronge1994.tables import Table

X, Y = "incidence [mu v2(0)]", "velocity [mu v2(0)]"


def draw(curves: Table, settings: Settings, points: Points) -> Figure:
    """Draw a curve for each restitution, the continua and the printed equations."""
    figure = house_style.new(3.8)
    axes = figure.subplots()
    axes.axhline(0, **house_style.GUIDE)
    paper = []
    for e, curve in tables.each(curves, "e", model="lumped"):
        style = house_style.LUMPED | {"linestyle": house_style.of_restitution(e)}
        label = rf"lumped model, $e = {e:g}$"
        paper.append(house_style.line(axes, curve, X, Y, label=label, **style))
    added = house_style.as_printed(axes, curves, X, Y, "Eqs 15, 25")
    continua = curves[tables.where(curves, model=CONTINUA)]
    for e, own in continua.groupby("e", sort=False):
        added += model_lines.draw(axes, own, X, Y, f", $e = {e:g}$")
    added += house_style.references(axes, points, X, Y).values()
    axes.set_xlim(settings["incidence"])
    house_style.legend_below(figure, paper, added, titles=("in the paper", "added here"))
    return figure
