"""Fig. 8: largest forces in newtons on the ball of Lewis & Rogers, and stated angles."""

from matplotlib.figure import Figure

from stronge1994 import tables
from stronge1994.figures.shared.drawing import house_style
from stronge1994.figures.shared.drawing.house_style import Points, Settings, Style
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
# Stated angles of the largest tangential force: who stated it, and the pattern of its line.
STATED = {
    "stronge1994/peak_angle_mu_0.18": ("stated in the paper, near", "-"),
    "lewis_rogers1988/peak_angle": ("measured, about", house_style.DASHES[3]),
}


def draw(curves: Table, settings: Settings, points: Points) -> Figure:
    """Draw the normal force on the left axis, the tangential one on the right; measurements too."""
    figure = house_style.new(5.0)
    axes = figure.subplots()
    enlarged = axes.twinx()
    largest = rf"largest ${house_style.F1MAX}$"
    force, friction = (tables.select(curves, variant=name) for name in ("normal", "friction"))
    top = friction[Y] == friction[Y].max()
    angle = friction[X][top].iloc[0]
    normal, tangential, solved = (
        house_style.line(part, curve, X, Y, rows, label=label, **style)
        for part, curve, rows, label, style in (
            (axes, force, None, rf"normal, ${house_style.F2MAX}$", house_style.LUMPED),
            (enlarged, friction, None, rf"tangential, ${house_style.F1MAX}$", TANGENTIAL),
            (
                enlarged,
                friction,
                top,
                rf"{largest}, solved ${angle:.1f}\degree$",
                {"color": house_style.VERMILLION, "marker": "o", "linestyle": "none"},
            ),
        )
    )
    paper = [normal, tangential]
    on_right = {name: series for name, series in points.items() if "friction" in name}
    on_left = {name: series for name, series in points.items() if name not in on_right}
    read = house_style.references(axes, on_left, X, Y, SERIES)
    read |= house_style.references(enlarged, on_right, X, Y, ENLARGED_SERIES)
    paper += read.values()
    for name, (label, dashes) in STATED.items():
        if name in points:
            where = rf"{largest}, {label} ${points[name].value:g}\degree$"
            style = house_style.PRINTED | {"linestyle": dashes, "label": where}
            paper.append(enlarged.axvline(points[name].value, **style))
    axes.set_ylabel("largest normal force, N")
    enlarged.set_xlabel("")
    enlarged.set_ylabel("largest tangential force, N", color=house_style.BLUE)
    enlarged.tick_params(axis="y", colors=house_style.BLUE)
    highest = max(axes.get_ylim()[1], ENLARGED * enlarged.get_ylim()[1])
    axes.set_ylim(0, highest)
    enlarged.set_ylim(0, highest / ENLARGED)
    house_style.angle_axes([axes], settings["angle"])
    friction, speed, mass = (settings[key] for key in ("friction", "speed", "mass"))
    note = rf"$\mu = {friction:g}$,  $S = {speed:g}$ m/s,  {mass:g} kg"
    figure.suptitle(f"{note}; scale of force: Hertz at normal incidence", fontsize=house_style.NOTE)
    house_style.legend_below(figure, paper, [solved], titles=("in the paper", "added here"))
    return figure
