"""Fig. 7: largest normal and tangential force against the angle of incidence."""

import numpy as np
from matplotlib.figure import Figure

from stronge1994 import tables
from stronge1994.figures.shared.drawing import house_style
from stronge1994.figures.shared.drawing.house_style import (
    OURS,
    PAPERS,
    Points,
    Settings,
    Style,
)
from stronge1994.tables import Table

X, Y = "angle [deg]", "peak_force [m2 Omega S]"
TANGENTIAL: Style = {"color": house_style.BLUE, "linestyle": house_style.DASHES[1]}
PALE = TANGENTIAL | {"color": house_style.SKY, "linewidth": 1.0}
# The caption of the paper calls these curves light.
LIGHT: Style = {"color": "0.6", "linestyle": "-", "linewidth": 0.8}
SLIDING: Style = {"facecolor": "none", "edgecolor": "0.75", "linewidth": 0, "hatch": "xxx"}
# Degrees from the peak of a curve to its name in (a), where no other curve is near.
BEYOND = 11


def draw(curves: Table, settings: Settings, points: Points) -> Figure:
    """Draw (a) both peak forces, hatched if slip never stops; (b) what printed equations give."""
    figure = house_style.new(7.2)
    axes, below = figure.subplots(2, sharex=True, height_ratios=[5, 3.2])
    label = rf"normal, ${house_style.F2MAX}$"
    force = tables.select(curves, variant="normal force")
    normal = house_style.line(axes, force, X, Y, label=label, **house_style.LUMPED)
    sliding = tables.select(curves, variant="slip throughout")
    # An area has all its corners in the file, so it gets few.
    angle = np.linspace(sliding[X].iloc[0], sliding[X].iloc[-1], 46)
    top = np.interp(angle, sliding[X], sliding[Y])
    area = axes.fill_between(angle, top, label="slip throughout", **SLIDING)
    label = rf"tangential, ${house_style.F1MAX}$"
    for mu, curve in tables.each(curves, "mu", model="lumped"):
        rigid = tables.select(curves, model="rigid", mu=mu)
        light = house_style.rigid(axes, rigid, X, Y, compliant=curve, **LIGHT)
        tangential = house_style.line(axes, curve, X, Y, label=label, **TANGENTIAL)
        pale = house_style.line(below, curve, X, Y, label="tangential, solved", **PALE)
        peak = curve[X][curve[Y].idxmax()]
        for panel, at in ((axes, peak + BEYOND), (below, peak)):
            house_style.name_curve(panel, curve, X, Y, f"{mu:g}", at)
    printed = house_style.as_printed(below, curves, X, Y, "Eqs 31, 32")
    read, others = house_style.of_print(points)
    series = house_style.references(axes, read, X, Y)
    series |= house_style.references(below, others, X, Y)
    below.axhline(0, **house_style.GUIDE)
    axes.set_ylim(0, None)
    below.set_ylabel(rf"${house_style.F1MAX}$ over $m_2\Omega S$")
    house_style.angle_axes([axes, below], settings["angle"])
    house_style.letter([axes, below], [f"{PAPERS}; numbers: $\\mu$", f"{OURS}: printed equations"])
    house_style.above_each_other([axes, below])
    house_style.legend_below(
        figure, [normal, tangential, light, area], [pale, *printed, *series.values()]
    )
    return figure
