"""Slide of Fig. 5: what tangential compliance does to the contact point."""

from matplotlib.figure import Figure

from stronge1994.csv_tables import Curves
from stronge1994.figures.fig5.drawing import X, Y
from stronge1994.figures.shared.drawing import slide
from stronge1994.figures.shared.drawing.house_style import DASHES, Points, Settings

TO = 8.0  # incidence, as in the paper
ELEMENTS = "chung_ooi2011/rebound"
BEFORE = r"tangential velocity before the impact, $v_1(0)/\mu v_2(0)$"
AFTER = r"tangential velocity after the impact, $v_1(t_f)/\mu v_2(0)$"


def draw(curves: Curves, settings: Settings, points: Points, ground: slide.Ground) -> Figure:
    """Draw the lumped model, the continuum, no tangential compliance, and finite elements."""
    lumped, continuum, rigid = (
        curves[name] for name in ("lumped", "continuum", "no tangential compliance")
    )
    title = "Tangential velocity after the impact, with and without tangential compliance"
    if lumped[Y].min() < rigid[Y].min():
        title = "The contact point springs back; without tangential compliance it would only stop"
    elements = points.get(ELEMENTS)
    data = "solved here" + ("; finite elements: Chung & Ooi 2011" if elements else "")
    figure, axes = slide.new(title, data, ground)
    for curve, name, at, offset, colour, dashes in (
        (rigid, "no tangential compliance", 4.0, (0, 14), ground.quiet, (0, (1, 1.5))),
        (lumped, "lumped model", 0.8, (0, 14), ground.ink, "-"),
        (continuum, "elastic continuum", 2.0, (-30, -14), ground.blue, DASHES[1]),
    ):
        axes.plot(curve[X], curve[Y], color=colour, linestyle=dashes, linewidth=slide.LINE)
        slide.name_curve(axes, name, curve[X], curve[Y], at, offset, (colour, ground.paper))
    if elements:
        x, y = elements["x"], elements["y"]
        mark = {"color": ground.vermillion, "markerfacecolor": ground.paper, "markeredgewidth": 4}
        axes.plot(x, y, "s", markersize=slide.MARK, clip_on=False, zorder=3, **mark)
        middle = abs(x - TO / 2).argmin()
        here = x[[middle]], y[[middle]], float(x[middle])
        colours = ground.vermillion, ground.paper
        slide.name_curve(axes, "finite elements", *here, (0, -24), colours)
    low = lumped[Y].min()
    axes.set(xlim=(settings["incidence"][0], min(TO, settings["incidence"][1])))
    axes.set_ylim(1.3 * low, -0.7 * low)
    slide.name_axes(axes, BEFORE, AFTER, ground)
    return figure
