"""Beyond the paper: a superball thrown under a table comes back."""

from typing import TypeAlias

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Circle, FancyArrowPatch

from planarimpact import Regime
from stronge1994.csv_tables import Columns, Curves
from stronge1994.figures.shared.drawing import house_style
from stronge1994.figures.shared.drawing.house_style import Points, Settings, Style

Place: TypeAlias = tuple[float, float]

PLACE, HEIGHT, SPIN = "place [m]", "height [m]", "spin_y [rad/s]"
# Place of the number of a flight, as a share of the flight, and its size as a share of the gap.
NUMBER_PLACE, NUMBER_SIZE = 0.36, 0.065


def sense(flight: int) -> str:
    """Name of the table of the round arrow that shows the direction of the spin."""
    return f"sense of spin {flight}"


def drawn_curves(curves: Curves, settings: Settings, points: Points) -> Curves:
    """Round arrows, clockwise if spin_y > 0, and open where no flight crosses them."""
    path, radius = curves["path"], NUMBER_SIZE * settings["throw"]["gap"]
    ways = np.diff(path[PLACE]) + 1j * np.diff(path[HEIGHT])
    tables = dict(curves)
    for number, (x, y, way, spin) in enumerate(
        zip(path[PLACE], path[HEIGHT], ways, path[SPIN], strict=False)
    ):
        angles = np.angle(1j * way) - np.sign(spin) * np.radians(np.linspace(35, 325, 60))
        tables[sense(number)] = {
            PLACE: x + NUMBER_PLACE * way.real + radius * np.cos(angles),
            HEIGHT: y + NUMBER_PLACE * way.imag + radius * np.sin(angles),
        }
    return tables


def draw(curves: Curves, settings: Settings, points: Points) -> Figure:
    """Draw the path of the ball, its impacts, and the direction of the spin of each flight."""
    path, throw = curves["path"], settings["throw"]
    radius, gap = throw["radius"], throw["gap"]
    place, height = path[PLACE], path[HEIGHT]
    figure = house_style.new(3.8)
    axes = figure.subplots()
    left, right = place.min() - 8 * radius, place.max() + 8 * radius
    plate = {"facecolor": "white", "edgecolor": "none", "pad": 1.5}
    for bottom, surface in ((-0.12 * gap, "floor"), (gap, "table")):
        axes.fill_between([left, right], bottom, bottom + 0.12 * gap, **house_style.SURFACE)
        axes.axhline(max(bottom, 0.0), color=house_style.BLACK, linewidth=0.8)
        at = left + 0.04 * gap, bottom + 0.06 * gap
        axes.text(*at, surface, ha="left", va="center", style="italic", bbox=plate)
    motions = zip(path["velocity_x [m/s]"], path[SPIN], strict=True)
    entries = []
    flights = zip(place, height, place[1:], height[1:], motions, strict=False)
    for number, (x, y, x_next, y_next, (v, spin)) in enumerate(flights):
        label = f"({number + 1}) {_plain(v, 1)} m/s, spin_y {_plain(spin)} rad/s"
        _draw_flight(axes, (x, y), (x_next, y_next), label, last=number + 2 == len(place))
        entries.append(house_style.key(label, **_style(v < 0)))
        near = x + NUMBER_PLACE * (x_next - x), y + NUMBER_PLACE * (y_next - y)
        _draw_number(axes, number + 1, near, NUMBER_SIZE * gap)
        if round(spin):
            _draw_spin(axes, curves[sense(number)])
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
            bbox=plate,
        )
    axes.set(xlim=(left, right), ylim=(-0.12 * gap, 1.12 * gap), aspect="equal")
    axes.set(xlabel="distance from the first impact (m)", ylabel="height (m)")
    groups = rf"$e = {throw['restitution']:g}$,  $\mu = {throw['friction']:g}$"
    axes.set_title(f"{groups},  rubber ball, gravity left out")
    entries.append(house_style.key("round arrow: sense of the spin", linestyle="none"))
    house_style.legend_below(figure, entries[0::2], entries[1::2])
    return figure


def _style(back: bool) -> Style:
    if back:
        return {"color": house_style.VERMILLION, "linestyle": (0, (5, 2))}
    return {"color": house_style.BLUE, "linestyle": "-"}


def _draw_flight(axes: Axes, start: Place, end: Place, label: str, last: bool) -> None:
    style = _style(end[0] < start[0]) | {"label": label}
    tip = {"arrowstyle": "-|>", "mutation_scale": 9, "shrinkA": 0, "shrinkB": 0 if last else 8}
    axes.add_patch(FancyArrowPatch(start, end, **tip, **style))


def _draw_number(axes: Axes, number: int, centre: Place, radius: float) -> None:
    """Draw the number of a flight on a disc that fits into the arrow of the spin."""
    axes.add_patch(
        Circle(
            centre,
            0.8 * radius,
            facecolor="white",
            linewidth=0,
            zorder=2,
        )
    )
    note = {"ha": "center", "va": "center_baseline", "fontsize": house_style.NOTE, "zorder": 3}
    axes.text(*centre, f"({number})", **note)


def _draw_spin(axes: Axes, arrow: Columns) -> None:
    x, y = arrow[PLACE], arrow[HEIGHT]
    style = {"color": house_style.BLACK, "linewidth": 0.9, "zorder": 2.5}
    axes.plot(x, y, **style)
    tip = {"arrowstyle": "-|>", "mutation_scale": 8, "shrinkA": 0, "shrinkB": 0}
    axes.add_patch(FancyArrowPatch((x[-2], y[-2]), (x[-1], y[-1]), **tip, **style))


def _plain(number: float, digits: int = 0) -> str:
    """A number with a proper minus sign, and without a negative zero."""
    return f"{np.round(number, digits) + 0.0:.{digits}f}".replace("-", "\N{MINUS SIGN}")
