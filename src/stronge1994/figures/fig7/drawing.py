"""Fig. 7: largest normal and tangential force against the angle of incidence."""

from matplotlib.figure import Figure

from stronge1994 import tables
from stronge1994.figures.shared.drawing import house_style
from stronge1994.figures.shared.drawing.house_style import Points, Settings, Style
from stronge1994.tables import Table

X, Y = "angle [deg]", "peak_force [m2 Omega S]"
TANGENTIAL: Style = {"color": house_style.BLUE, "linestyle": house_style.DASHES[1]}
PALE = TANGENTIAL | {"color": house_style.SKY, "linewidth": 1.0}
SLIDING: Style = {"facecolor": "none", "edgecolor": "0.75", "linewidth": 0, "hatch": "////"}


def draw(curves: Table, settings: Settings, points: Points) -> Figure:
    """Draw (a) both peak forces, hatched if slip never stops; (b) what printed equations give."""
    figure = house_style.new(7.6)
    axes, below = figure.subplots(2, sharex=True, height_ratios=[5, 3.6])
    label = rf"normal, ${house_style.F2MAX}$"
    force = tables.select(curves, variant="normal force")
    normal = house_style.line(axes, force, X, Y, label=label, **house_style.LUMPED)
    sliding = tables.select(curves, variant="slip throughout")
    area = axes.fill_between(sliding[X], sliding[Y], label="slip throughout", **SLIDING)
    frictions = dict(tables.each(curves, "mu", model="lumped"))
    values = ", ".join(f"{mu:g}" for mu in frictions)
    label = rf"tangential, ${house_style.F1MAX}$, from below" + f"\n$\\mu = {values}$"
    for mu, curve in frictions.items():
        rigid = tables.select(curves, model="rigid", mu=mu)
        rough = house_style.rigid(axes, rigid, X, Y, compliant=curve)
        tangential = house_style.line(axes, curve, X, Y, label=label, **TANGENTIAL)
        pale = house_style.line(below, curve, X, Y, label="tangential, solved", **PALE)
    printed = house_style.as_printed(below, curves, X, Y, "Eqs 31, 32")
    series = house_style.references(axes, points, X, Y).values()
    below.axhline(0, **house_style.GUIDE)
    axes.set_ylim(0, None)
    below.set_ylabel(rf"${house_style.F1MAX}$ over $m_2\Omega S$")
    house_style.angle_axes([axes, below], settings["angle"])
    house_style.letter([axes, below])
    house_style.legend_below(figure, [normal, tangential, *series], [rough, area, pale, *printed])
    return figure
