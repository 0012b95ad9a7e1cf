"""Fig. 8: largest forces in newtons on the ball of Lewis & Rogers, and stated angles."""

import math
from collections.abc import Sequence

from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from stronge1994.csv_tables import Columns, Curves
from stronge1994.figures.shared.drawing import house_style
from stronge1994.figures.shared.drawing.house_style import Entries, Points, Settings

X, Y = "angle [deg]", "peak_force [N]"
TANGENTIAL = {"color": house_style.BLUE, "linestyle": house_style.DASHES[1], "linewidth": 1.4}
LARGEST = {"color": house_style.VERMILLION, "marker": "o", "linestyle": "none"}
# The paper draws tangential forces this many times larger, on a second axis.
ENLARGED = 2
# Stated angles of the largest tangential force: name of the fact, label, height of the line over
# that of the force. The first line is the taller, so that its label stands above the other.
STATED = {
    "stronge1994/peak_angle_mu_0.18": (r"{:g}$\degree$, stated in the paper", 1.45),
    "lewis_rogers1988/peak_angle": (r"$\approx {:g}\degree$, measured", 1.2),
}


def draw(curves: Curves, settings: Settings, points: Points) -> Figure:
    """Draw the normal force on the left axis, the tangential one on the right; measurements too."""
    figure = house_style.new(5.0)
    axes = figure.subplots()
    enlarged = axes.twinx()
    normal, friction = curves["normal"], curves["friction"]
    paper = [
        *axes.plot(
            normal[X], normal[Y], label=rf"normal, ${house_style.F2MAX}$", **house_style.LUMPED
        ),
        *enlarged.plot(
            friction[X], friction[Y], label=rf"tangential, ${house_style.F1MAX}$", **TANGENTIAL
        ),
        *_draw_measured(axes, enlarged, points),
    ]
    _set_axes(axes, enlarged, settings["angle"])
    for force, part in (("normal", axes), ("friction", enlarged)):
        if (name := f"lewis_rogers1988/{force}_force") in points:
            house_style.let_in(part, points[name])
    low, high = zip(axes.get_ylim(), (ENLARGED * y for y in enlarged.get_ylim()), strict=True)
    axes.set_ylim(min(low), max(high))
    enlarged.set_ylim(min(low) / ENLARGED, max(high) / ENLARGED)
    paper.append(_draw_statements(enlarged, friction, points))
    added = [_draw_largest(enlarged, friction)]
    _draw_note(axes, settings)
    house_style.legend_below(figure, paper, added, titles=("in the paper", "added here"))
    return figure


def _draw_measured(axes: Axes, enlarged: Axes, points: Points) -> Entries:
    """Draw the measurements of Lewis & Rogers, and return entries of the legend."""
    forces = {
        "normal": (axes, house_style.BLACK, "o"),
        "friction": (enlarged, house_style.BLUE, "s"),
    }
    entries = []
    for force, (part, colour, marker) in forces.items():
        style = {"color": colour, "marker": marker, "markerfacecolor": "white"}
        label = f"{'tangential' if force == 'friction' else force}, Lewis & Rogers"
        wanted = {f"lewis_rogers1988/{force}_force": (label, style)}
        entries += house_style.references(part, points, wanted)
    return entries


def _set_axes(axes: Axes, enlarged: Axes, span: Sequence[float]) -> None:
    top = 20 * math.ceil(max(axes.get_ylim()[1], ENLARGED * enlarged.get_ylim()[1]) / 20)
    axes.set(ylim=(0, top), ylabel="largest normal force, N")
    enlarged.set_ylim(0, top / ENLARGED)
    enlarged.set_ylabel("largest tangential force, N", color=house_style.BLUE)
    enlarged.tick_params(axis="y", colors=house_style.BLUE)
    house_style.angle_axes(axes, span)


def _draw_largest(axes: Axes, curve: Columns) -> Artist:
    """Mark the largest tangential force and its angle."""
    top = int(curve[Y].argmax())
    angle, force = curve[X][top], curve[Y][top]
    # To the left of the point: the stated angles are to the right.
    place = {"textcoords": "offset points", "ha": "right", "va": "bottom"}
    text = rf"{angle:.1f}$\degree$, solved"
    axes.annotate(text, (angle, force), (4, 5), fontsize=house_style.NOTE, **place)
    label = rf"largest ${house_style.F1MAX}$ of the model"
    return axes.plot(angle, force, label=label, **LARGEST)[0]


def _draw_statements(axes: Axes, curve: Columns, points: Points) -> Artist:
    """Draw thin lines at the stated angles, from the axis to above the curve."""
    place = {"textcoords": "offset points", "va": "center", "fontsize": house_style.NOTE}
    left, right = axes.get_xlim()
    for name, (text, height) in STATED.items():
        if name in points and left < (angle := points[name]["value"]) < right:
            top = height * curve[Y].max()
            axes.vlines(angle, 0, top, **house_style.PRINTED)
            axes.annotate(text.format(angle), (angle, top), (4, -2), **place)
    return house_style.key(rf"stated angle of largest ${house_style.F1MAX}$", **house_style.PRINTED)


def _draw_note(axes: Axes, settings: Settings) -> None:
    friction, speed, mass = (settings[key] for key in ("friction", "speed", "mass"))
    lines = [
        rf"$\mu = {friction:g}$,  $S = {speed:g}$ m/s,  {mass:g} kg",
        "scale of force assumed:",
        "Hertz at normal incidence",
    ]
    place = {"ha": "right", "va": "top", "transform": axes.transAxes}
    style = {"fontsize": house_style.NOTE, "linespacing": house_style.LINES}
    axes.text(0.97, 0.96, "\n".join(lines), **style, **place)
