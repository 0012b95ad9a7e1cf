"""Fig. 6: tangential velocity at separation against incidence, for several restitutions."""

from matplotlib.figure import Figure

from stronge1994.csv_tables import Curves
from stronge1994.curve_names import name
from stronge1994.figures.shared.drawing import beside, house_style
from stronge1994.figures.shared.drawing.house_style import Points, Settings

X, Y = "incidence [mu v2(0)]", "velocity [mu v2(0)]"


def draw(curves: Curves, settings: Settings, points: Points) -> Figure:
    """Draw a curve for each restitution, the continua and the printed equations."""
    figure = house_style.new(3.8)
    axes = figure.subplots()
    axes.axhline(0, **house_style.GUIDE)
    paper = []
    for e in settings["restitution"]:
        style = house_style.LUMPED | {"linestyle": house_style.of_restitution(e)}
        label = rf"lumped model, $e = {e:g}$"
        paper.append(house_style.line(axes, curves, name("e", e), X, Y, label=label, **style))
    added = house_style.as_printed(axes, curves, X, Y, "Eqs 15, 25")
    continua = settings["continua"]
    for e in continua["restitution"]:
        note = f", $e = {e:g}$"
        added += beside.lines(axes, curves, name("e", e), X, Y, continua["models"], note)
    axes.set_xlim(settings["incidence"])
    house_style.legend_below(figure, paper, added, titles=("in the paper", "added here"))
    return figure
