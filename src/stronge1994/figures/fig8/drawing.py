"""Fig. 8: largest forces in newtons on the ball of Lewis & Rogers, and stated angles."""

from matplotlib.axes import Axes
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

X, Y = "angle [deg]", "peak_force [N]"
TANGENTIAL: Style = {
    "color": house_style.BLUE,
    "linestyle": house_style.DASHES[1],
    "linewidth": 1.4,
}
# The paper draws tangential forces this many times larger, on a second axis.
ENLARGED = 2
WHITE: Style = {"markerfacecolor": "white"}
SERIES = {"lewis_rogers1988/normal_force": WHITE | {"color": house_style.BLACK, "marker": "o"}}
ENLARGED_SERIES = {
    "lewis_rogers1988/friction_force": WHITE | {"color": house_style.BLUE, "marker": "s"}
}
# Stated angles of the largest tangential force: where they come from, and patterns of their lines.
STATED = {
    "stronge1994/peak_angle_mu_0.18": ("text of the paper", "-"),
    "lewis_rogers1988/peak_angle": ("measured", house_style.DASHES[3]),
}


def draw(curves: Table, settings: Settings, points: Points) -> Figure:
    """Draw (a) both forces, each on its axis, and measurements; (b) where friction is largest."""
    figure = house_style.new(6.0)
    axes, below = figure.subplots(2, sharex=True, height_ratios=[4, 2.3])
    enlarged = axes.twinx()
    read, others = house_style.of_print(points, [*SERIES, *ENLARGED_SERIES])
    force, friction = (tables.select(curves, variant=name) for name in ("normal", "friction"))
    normal, tangential = (
        house_style.line(part, curve, X, Y, label=label, **style)
        for part, curve, label, style in (
            (axes, force, rf"normal, ${house_style.F2MAX}$", house_style.LUMPED),
            (enlarged, friction, rf"tangential, ${house_style.F1MAX}$", TANGENTIAL),
        )
    )
    on_right = {name: series for name, series in read.items() if "friction" in name}
    on_left = {name: series for name, series in read.items() if name not in on_right}
    measured = house_style.references(axes, on_left, X, Y, SERIES)
    measured |= house_style.references(enlarged, on_right, X, Y, ENLARGED_SERIES)
    axes.set_ylabel("largest normal force, N")
    enlarged.set_xlabel("")
    enlarged.set_ylabel("largest tangential, N", color=house_style.BLUE)
    enlarged.tick_params(axis="y", colors=house_style.BLUE)
    highest = max(axes.get_ylim()[1], ENLARGED * enlarged.get_ylim()[1])
    axes.set_ylim(0, highest)
    enlarged.set_ylim(0, highest / ENLARGED)
    _draw_peak(below, friction, points)
    series = house_style.references(below, others, X, Y)
    below.set_ylabel("tangential, N")
    house_style.angle_axes([axes, below], settings["angle"])
    house_style.letter([axes, below], [PAPERS, f"{OURS}: angle of the largest tangential force"])
    house_style.above_each_other([axes, below])
    mu, speed, mass = (settings[key] for key in ("friction", "speed", "mass"))
    note = rf"$\mu = {mu:g}$,  $S = {speed:g}$ m/s,  {mass:g} kg"
    axes.set_title(note, loc="right", fontsize=house_style.NOTE)
    house_style.legend_below(figure, [normal, tangential, *measured.values(), *series.values()])
    return figure


def _draw_peak(axes: Axes, friction: Table, points: Points) -> None:
    """Draw the tangential force with its peak, and where others put it."""
    house_style.line(axes, friction, X, Y, label="_", **TANGENTIAL)
    top = friction.loc[[friction[Y].idxmax()]]
    mark: Style = {"color": house_style.VERMILLION, "marker": "o", "linestyle": "none"}
    mark["label"] = rf"solved: ${top[X].iloc[0]:.1f}\degree$"
    entries = [*axes.plot(top[X], top[Y], **mark)]
    for name, (who, dashes) in STATED.items():
        if name in points:
            label = rf"{who}: about ${points[name].value:g}\degree$"
            style = house_style.PRINTED | {"linestyle": dashes, "label": label}
            entries.append(axes.axvline(points[name].value, **style))
    axes.set_ylim(0, 1.75 * float(top[Y].iloc[0]))  # the legend stands above the curve
    axes.legend(handles=entries, loc="upper right", fontsize=house_style.NOTE, handlelength=1.8)
