"""Beyond the paper: a superball thrown under a table comes back."""

import numpy as np
from matplotlib.figure import Figure
from matplotlib.patches import Circle

from planarimpact.common.results import Regime
from stronge1994.figures.shared.drawing import house_style
from stronge1994.figures.shared.drawing.house_style import Points, Settings
from stronge1994.tables import Table

PLACE, HEIGHT, SPIN = "place [m]", "height [m]", "spin_y [rad/s]"
# Round arrows of a spin, by its sign.
TURNS = {
    1: " \N{CLOCKWISE OPEN CIRCLE ARROW}",
    0: "",
    -1: " \N{ANTICLOCKWISE OPEN CIRCLE ARROW}",
}
# Plates below words that stand on a flight or on a surface.
PLATE = {"facecolor": "white", "edgecolor": "none", "pad": 1.5}


def draw(curves: Table, settings: Settings, points: Points) -> Figure:
    """Draw the path of the ball, its impacts, and the direction of the spin of each flight."""
    throw = settings["throw"]
    radius, gap = throw["radius"], throw["gap"]
    figure = house_style.new(3.8)
    axes = figure.subplots()
    house_style.line(axes, curves, PLACE, HEIGHT, label="path", color=house_style.BLUE)
    left, right = (
        end(curves[PLACE]) + side * 8 * radius for end, side in ((np.min, -1), (np.max, 1))
    )
    words = {"ha": "center", "va": "center", "bbox": PLATE}
    for bottom, top, surface in ((-0.12 * gap, 0.0, "floor"), (gap, 1.12 * gap, "table")):
        axes.axhspan(bottom, top, **house_style.SURFACE)
        axes.text(left + 0.09 * gap, (bottom + top) / 2, surface, style="italic", **words)
    places = curves[[PLACE, HEIGHT]].to_numpy()
    entries = []
    for flight, (start, end) in enumerate(zip(places, places[1:], strict=False)):
        speed, spin = (curves[column][flight] for column in ("velocity_x [m/s]", SPIN))
        number = f"({flight + 1})"
        near_start = 0.64 * start + 0.36 * end
        turned = f"{number}{TURNS[np.sign(np.round(spin))]}"
        axes.text(*near_start, turned, fontsize=house_style.NOTE, **words)
        head = {"arrowstyle": "-|>", "color": house_style.BLUE, "shrinkB": 7}
        axes.annotate("", end, (start + end) / 2, arrowprops=head)
        label = f"{number} {_plain(speed, 1)} m/s, spin_y {_plain(spin)} rad/s"
        entries.append(house_style.key(label, linestyle="none"))
    for at, regime in zip(places[1:-1], curves["regime"][1:-1], strict=True):
        axes.add_patch(Circle(at, radius, facecolor="white", edgecolor=house_style.BLACK, zorder=3))
        height = (-0.06 if at[1] < gap / 2 else 1.06) * gap
        axes.text(at[0], height, Regime[regime].words, **words)
    axes.set(xlim=(left, right), ylim=(-0.12 * gap, 1.12 * gap), aspect="equal")
    axes.set_xlabel("distance from the first impact, m")
    groups = rf"$e = {throw['restitution']:g}$,  $\mu = {throw['friction']:g}$"
    axes.set_title(f"{groups},  rubber ball, gravity left out")
    house_style.legend_below(figure, entries[0::2], entries[1::2])
    return figure


def _plain(number: float, digits: int = 0) -> str:
    """A number with a proper minus sign, and without a negative zero."""
    return f"{np.round(number, digits) + 0.0:.{digits}f}".replace("-", "\N{MINUS SIGN}")
