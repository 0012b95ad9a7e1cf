"""Slide of the slender rod: Newton's coefficient of restitution can create energy."""

import numpy as np
from matplotlib.figure import Figure

from stronge1994.csv_tables import Curves
from stronge1994.curve_names import name
from stronge1994.figures.rod.drawing import ENERGY, TILT
from stronge1994.figures.shared.drawing import house_style, slide
from stronge1994.figures.shared.drawing.house_style import Points, Settings

LEAN = "tilt of the rod, degrees; positive: the tip is ahead of the centre"
KEPT = "kinetic energy that the contact can change, after over before"
ENERGETIC = "rigid, energetic\ncoefficient"


def draw(curves: Curves, settings: Settings, points: Points, ground: slide.Ground) -> Figure:
    """Draw the energy after the impact by three models, where Newton's coefficient keeps most."""
    newtons = {
        name("v1/v2", ratio): curves[f"rigid, Newton, {name('v1/v2', ratio)}"]
        for ratio in settings["velocity_ratio"]
    }
    pair = max(newtons, key=lambda one: newtons[one][ENERGY].max())
    newton, peak = newtons[pair], float(newtons[pair][ENERGY].max())
    title = "Kinetic energy of a slender rod after it has struck with its tip"
    if peak > 1:
        title = (
            "With Newton's coefficient of restitution the impact of a rigid rod can create energy: "
            f"{100 * (peak - 1):.0f} % more than before"
        )
    groups = f"mu = {settings['friction']:g}, e = {settings['restitution']:g}"
    data = f"solved here for a slender rod, {groups}, {pair} before the impact"
    figure, axes = slide.new(title, data, ground)
    axes.axhline(1, color=ground.quiet, linewidth=slide.LINE / 3)
    axes.fill_between(
        newton[TILT],
        1,
        newton[ENERGY],
        where=newton[ENERGY] > 1,
        interpolate=True,
        facecolor=ground.vermillion,
        alpha=0.3,
        linewidth=0,
    )
    top = float(newton[TILT][newton[ENERGY].argmax()])
    for curve, text, at, offset, colour, dashes in (
        (curves[f"rigid, {pair}"], ENERGETIC, 48.0, (14, 14), ground.blue, house_style.DASHES[1]),
        (curves[pair], "compliant", -24.0, (0, -24), ground.ink, "-"),
        (
            newton,
            "rigid, Newton's coefficient",
            top + 12,
            (24, 14),
            ground.vermillion,
            house_style.DASHES[2],
        ),
    ):
        axes.plot(curve[TILT], curve[ENERGY], color=colour, linestyle=dashes, linewidth=slide.LINE)
        slide.name_curve(axes, text, curve[TILT], curve[ENERGY], at, offset, (colour, ground.paper))
    low, high = settings["tilt"]
    axes.set(xlim=(low, high), xticks=np.arange(-60, 61, 30), ylim=(0, 1.1 * max(peak, 1)))
    slide.name_axes(axes, LEAN, KEPT, ground)
    return figure
