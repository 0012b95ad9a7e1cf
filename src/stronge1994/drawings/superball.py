"""Beyond the paper: a superball thrown under a table comes back."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Circle, FancyArrowPatch

from planarimpact import Regime
from stronge1994.csv_tables import Curves
from stronge1994.drawings import house_style
from stronge1994.drawings.house_style import Points, Settings, Style

PLACE, HEIGHT, SPIN = "place [m]", "height [m]", "spin_y [rad/s]"
SURFACE = {"facecolor": "0.9", "hatch": "////", "edgecolor": "0.7", "linewidth": 0}


def draw(curves: Curves, settings: Settings, points: Points) -> Figure:
    """Draw the path of the ball's centre and the ball at each impact. The legend has the spins."""
    path, throw = curves["path"], settings["throw"]
    radius, gap = throw["radius"], throw["gap"]
    place, height = path[PLACE], path[HEIGHT]
    figure = house_style.new(3.6)
    axes = figure.subplots()
    left, right = place.min() - 8 * radius, place.max() + 8 * radius
    for bottom in (-0.12 * gap, gap):
        axes.fill_between([left, right], bottom, bottom + 0.12 * gap, **SURFACE)
        axes.axhline(max(bottom, 0.0), color=house_style.BLACK, linewidth=0.8)
    flights = zip(place, height, place[1:], height[1:], strict=False)
    for number, (x, y, x_next, y_next) in enumerate(flights):
        _draw_flight(axes, number, (x, y), (x_next, y_next), last=number + 2 == len(place))
    for x, y, regime in zip(place[1:-1], height[1:-1], path["regime"][1:-1], strict=True):
        axes.add_patch(
            Circle((x, y), radius, facecolor="white", edgecolor=house_style.BLACK, zorder=3)
        )
        axes.text(
            np.clip(x, left + 0.25 * gap, right - 0.25 * gap),
            (-0.06 if y < gap / 2 else 1.06) * gap,
            Regime[regime].words,
            ha="center",
            va="center",
            bbox={"facecolor": "white", "edgecolor": "none", "pad": 1.5},
        )
    axes.set(xlim=(left, right), ylim=(-0.12 * gap, 1.12 * gap), aspect="equal")
    axes.set(xlabel="distance from the first impact (m)", ylabel="height (m)")
    shown = rf"$e = {throw['restitution']:g}$,  $\mu = {throw['friction']:g}$"
    axes.set_title(f"{shown},  rubber ball, gravity left out")
    legs = range(len(place) - 1)
    motions = zip(path["velocity_x [m/s]"], path[SPIN], strict=True)
    entries = [
        house_style.key(f"({n + 1}) {_plain(v, 1)} m/s, spin_y {_plain(s)} rad/s", **_style(v < 0))
        for n, (v, s) in zip(legs, motions, strict=False)
    ]
    house_style.legend_below(figure, entries[0::2], entries[1::2])
    return figure


def _style(back: bool) -> Style:
    if back:
        return {"color": house_style.VERMILLION, "linestyle": (0, (5, 2))}
    return {"color": house_style.BLUE, "linestyle": "-"}


def _draw_flight(
    axes: Axes, number: int, start: tuple[float, float], end: tuple[float, float], last: bool
) -> None:
    """Draw a flight, with its number near its start, where the paths have not crossed yet."""
    style = _style(end[0] < start[0])
    tip = {"arrowstyle": "-|>", "mutation_scale": 9, "shrinkA": 0, "shrinkB": 0 if last else 8}
    axes.add_patch(FancyArrowPatch(start, end, **tip, **style))
    near = [a + 0.25 * (b - a) for a, b in zip(start, end, strict=True)]
    axes.text(
        *near,
        f"({number + 1})",
        ha="center",
        va="center",
        fontsize=house_style.NOTE,
        bbox={"facecolor": "white", "edgecolor": "none", "pad": 1},
    )


def _plain(number: float, digits: int = 0) -> str:
    """A number with a proper minus sign, and without a negative zero."""
    return f"{np.round(number, digits) + 0.0:.{digits}f}".replace("-", "\N{MINUS SIGN}")
