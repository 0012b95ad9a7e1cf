"""Fig. 6: tangential velocity at separation against incidence, for several restitutions."""

import math
from collections.abc import Iterable

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from stronge1994.csv_tables import Curves
from stronge1994.curve_names import name
from stronge1994.figures.shared.drawing import house_style
from stronge1994.figures.shared.drawing.house_style import Points, Settings

X, Y = "incidence [mu v2(0)]", "velocity [mu v2(0)]"


def draw(curves: Curves, settings: Settings, points: Points) -> Figure:
    """Draw a curve for each restitution, named at its end, the continua and printed equations."""
    figure = house_style.new(3.8)
    axes = figure.subplots()
    axes.axhline(0, **house_style.GUIDE)
    ends = []
    for e in settings["restitution"]:
        curve = curves[name("e", e)]
        dashes = {"linestyle": house_style.of_restitution(e)}
        axes.plot(curve[X], curve[Y], **(house_style.LUMPED | dashes))
        ends.append((curve[X][-1], curve[Y][-1], house_style.symbols(name("e", e))))
    axes.set(xlim=settings["incidence"], xlabel=house_style.INCIDENCE, ylabel=house_style.REBOUND)
    _label_ends(axes, ends)
    added = house_style.as_printed(axes, curves, X, Y, "Eqs 15, 25")
    values = house_style.restitutions(settings["continua"]["restitution"])
    added += house_style.draw_lossy_continua(axes, curves, X, Y, values)
    paper = [house_style.key("lumped model, $e$ at the line", **house_style.LUMPED)]
    titles = ("in the paper", "added here")
    house_style.legend_below(figure, *([paper, added] if added else [paper]), titles=titles)
    return figure


def _label_ends(axes: Axes, ends: Iterable[tuple[float, float, str]]) -> None:
    """Write names to the right of the axes, at the heights of the curves but not too close."""
    low, high = axes.get_ylim()
    apart, last = 0.05 * (high - low), -math.inf
    place = {"textcoords": axes.get_yaxis_transform(), "va": "center"}
    for x, y, text in sorted(ends, key=lambda end: end[1:]):
        last = max(y, last + apart)
        axes.annotate(text, (x, y), (1.01, last), annotation_clip=False, **place)
