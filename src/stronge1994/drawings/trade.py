"""Beyond the paper: error of every model against its time, and time against the size of batch."""

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from stronge1994.csv_tables import Curves
from stronge1994.drawings import house_style
from stronge1994.drawings.house_style import Points, Settings, Style

_Row: TypeAlias = dict[str, Any]
Place: TypeAlias = tuple[str, float, float]

ERROR, MODEL, RESTITUTION = "rms_velocity [mu v2(0)]", "model", "restitution [1]"
STEPS, CIRCLES, TOLERANCE = "steps [1]", "circles [1]", "tolerance [mu v2(0)]"
# Smaller errors are rounding; they are drawn here.
FLOOR = 1e-12
# The axis of error is cut here: rough models are above, those that converge below, each part with
# its own scale.
CUT = 0.03
MICROSECONDS = 1e6
ERROR_WORDS, TIME_WORDS = r"error of $v_1(t_f)/\mu v_2(0)$, rms", "time of an impact (µs)"

# Where labels are: horizontal alignment, and distances from the point.
ABOVE, BELOW = ("center", 0, 4), ("center", 0, -10)
RIGHT, LEFT = ("left", 5, -2.5), ("right", -5, -2.5)
LOWER_LEFT = ("right", -4, -8)
# For points from which a line of the front goes to the right.
UPPER_RIGHT = ("left", 4, 2.5)


class Family(NamedTuple):
    """How the points of one model are drawn."""

    label: str
    marker: str
    size: float
    colour: str
    filled: bool
    place: Place | None

    def style(self) -> Style:
        """Keywords of its marker."""
        return {
            "marker": self.marker,
            "markersize": self.size,
            "color": self.colour,
            "markerfacecolor": self.colour if self.filled else "none",
            "markeredgewidth": 0.9,
        }


FORMULA = Family("formula", "D", 3.5, house_style.GREY, True, RIGHT)
FAMILIES = {
    "rigid": FORMULA._replace(place=LOWER_LEFT),
    "laws.smith": FORMULA._replace(place=LEFT),
    "laws.brach": FORMULA._replace(place=UPPER_RIGHT),
    "lumped": Family("lumped, exact", "o", 3.5, house_style.BLACK, True, ABOVE),
    "timestep.linear": Family("linear spring", "s", 6, house_style.BLUE, False, BELOW),
    "timestep.mindlin": Family("Mindlin", "^", 5, house_style.VERMILLION, True, BELOW),
    "timestep.mindlin_rescaled": Family(
        "Mindlin, rescaled", "v", 5, house_style.PURPLE, False, ABOVE
    ),
    "continuum": Family("continuum", "o", 5, house_style.GREEN, False, LEFT),
    "annuli": Family("annuli", "h", 5.5, house_style.BLUE, True, RIGHT),
    "response of lumped": Family("of lumped", "*", 7, house_style.BLACK, False, UPPER_RIGHT),
    "response of continuum": Family("of continuum", "*", 7, house_style.GREEN, True, UPPER_RIGHT),
}
NAMES = {"rigid": "rigid", "laws.smith": "Smith", "laws.brach": "Brach"}
NAMES |= {"pooltool": "pooltool"}
# These models have a line against the size of batch. The lines of the others would lie beside them.
GROWTH = {
    "laws.brach": house_style.DASHES[0],
    "lumped": house_style.DASHES[0],
    "timestep.mindlin": house_style.DASHES[1],
    "continuum": house_style.DASHES[2],
    "annuli": house_style.DASHES[3],
    "response of continuum": house_style.DASHES[4],
}
FRONT = {"color": house_style.BLACK, "linewidth": 0.6, "zorder": 0.9}
FRONT_WITH_RESPONSES = FRONT | {"linestyle": (0, (4, 2))}


def draw(
    curves: Curves, settings: Settings, points: Points, families: Mapping[str, Family] = FAMILIES
) -> Figure:
    """Draw (a) error against time for the first restitution, (b) for the last, (c) time and batch.

    `families` may hold more than those of the legend. The title warns if the machine was busy.
    """
    rows = [{key: value[0] for key, value in curve.items()} for curve in curves.values()]
    first, last = settings["restitution"][0], settings["restitution"][-1]
    batch = shown_batch(settings)
    figure = house_style.new(7.8)
    grid = figure.add_gridspec(2, 2, height_ratios=[3.5, 2.8], width_ratios=[6, 5])
    for letter, place, restitution, margin in (
        ("a", grid[0, :], first, 0.12),
        ("b", grid[1, 0], last, 0.33),
    ):
        rough, fine = place.subgridspec(2, 1, height_ratios=[3, 4]).subplots(sharex=True)
        for axes, span in ((rough, (CUT, np.inf)), (fine, (0, CUT))):
            _draw_errors(axes, _of(rows, restitution), batch, families, span, margin)
        _cut(rough, fine)
        rough.set_title(_title(letter, restitution))
        fine.set_ylabel(ERROR_WORDS, y=0.9)
        fine.set_xlabel(TIME_WORDS)
    growth = figure.add_subplot(grid[1, 1])
    _draw_growth(growth, _of(rows, first), sorted(settings["batches"]))
    growth.set(title=f"(c) $e = {first:g}$", xlabel="impacts together", ylabel=TIME_WORDS)
    note = f"numbers at points: steps, circles or tolerance; (a), (b): {batch} impacts together"
    notes = [note, warning(rows)]
    figure.suptitle("\n".join(filter(None, notes)), fontsize=house_style.NOTE)
    _add_legend(figure)
    return figure


def warning(rows: Sequence[_Row]) -> str:
    """A sentence if the machine was busy while some of the times were taken, else no words.

    Parameters
    ----------
    rows : sequence of dict
        Of results/curves/trade.csv, as texts or numbers.

    Examples
    --------
    >>> warning([{"time_1 [s]": 2.0, "busy_1 [1]": 1.9}, {"time_1 [s]": 1.0}])
    'the machine was busy: 1 of 2 times are up to 1.9 times too long'
    """
    cells = [(key, cell) for row in rows for key, cell in row.items() if cell]
    busy = [float(cell) for key, cell in cells if key.startswith("busy_")]
    if not busy:
        return ""
    count = sum(key.endswith(" [s]") for key, _ in cells)
    return (
        f"the machine was busy: {len(busy)} of {count} times are up to {max(busy):.2g} times too "
        "long"
    )


def shown_batch(settings: Settings) -> int:
    """Size of the batch whose times are drawn against errors: the middle one."""
    return sorted(settings["batches"])[len(settings["batches"]) // 2]


def _of(rows: Sequence[_Row], restitution: float) -> list[_Row]:
    return [row for row in rows if row[RESTITUTION] == restitution]


def _title(letter: str, restitution: float) -> str:
    against = "the elastic continuum" if restitution == 1 else "the lumped model"
    return f"({letter}) $e = {restitution:g}$, against {against}"


def _draw_errors(
    axes: Axes,
    rows: Sequence[_Row],
    batch: int,
    families: Mapping[str, Family],
    span: tuple[float, float],
    margin: float,
) -> None:
    """Draw the points in a span of error, and both fronts; `margin` leaves room for labels."""
    timed = [row for row in rows if f"time_{batch} [s]" in row]
    if not timed:
        return
    time = [MICROSECONDS * row[f"time_{batch} [s]"] for row in timed]
    error = [max(row[ERROR], FLOOR) for row in timed]
    for row, *at in zip(timed, time, error, strict=True):
        if span[0] < at[1] <= span[1]:
            family = families[row[MODEL]]
            axes.plot(*at, linestyle="none", **family.style())
            label(axes, at, words_of(row), family.place)
    left = min(time) * (min(time) / max(time)) ** margin
    edges = (left, max(time) * 3), (min(error) / 5, max(error) * 5)
    axes.set(xscale="log", yscale="log", xlim=edges[0], ylim=edges[1])
    solved = [i for i, row in enumerate(timed) if not row[MODEL].startswith("response")]
    for chosen, style in ((range(len(timed)), FRONT_WITH_RESPONSES), (solved, FRONT)):
        _draw_front(axes, [time[i] for i in chosen], [error[i] for i in chosen], edges, style)


def label(axes: Axes, at: Sequence[float], words: str, place: Place | None) -> None:
    """Write words beside a point, if there are any and a place for them."""
    if not words or place is None:
        return
    alignment, *offset = place
    axes.annotate(
        words,
        at,
        xytext=offset,
        textcoords="offset points",
        ha=alignment,
        fontsize=house_style.NOTE - 0.5,
        bbox={"facecolor": "white", "edgecolor": "none", "pad": 0.3},
        zorder=1,
        annotation_clip=True,
    )


def words_of(row: _Row) -> str:
    """Label of a point: the setting of its model, or its name."""
    if STEPS in row and CIRCLES not in row:
        return f"{row[STEPS]:g}"
    if CIRCLES in row:
        return f"{row[CIRCLES]:g}"
    if TOLERANCE in row:
        return f"$10^{{{np.log10(row[TOLERANCE]):.3g}}}$"
    return NAMES.get(row[MODEL], "")


def front(time: Sequence[float], error: Sequence[float]) -> list[int]:
    """Indices of the Pareto front, the fastest first: no other point is as fast and as accurate.

    Examples
    --------
    >>> front([3.0, 1.0, 2.0, 2.5], [0.1, 0.5, 0.2, 0.3])
    [1, 2, 0]
    """
    found: list[int] = []
    for index in sorted(range(len(time)), key=lambda i: (time[i], error[i])):
        if not found or error[index] < error[found[-1]]:
            found.append(index)
    return found


def _draw_front(
    axes: Axes,
    time: Sequence[float],
    error: Sequence[float],
    edges: tuple[tuple[float, float], tuple[float, float]],
    style: Style,
) -> None:
    """Draw a Pareto front: a point above and to the right of it is worse in both."""
    (_, right), (_, top) = edges
    best = front(time, error)
    x = [time[best[0]], *(time[i] for i in best), right]
    y = [top, *(error[i] for i in best), error[best[-1]]]
    axes.step(x, y, where="post", **style)


def _cut(rough: Axes, fine: Axes) -> None:
    """Make one panel of two: both have the same axis of error, with different scales."""
    rough.set_ylim(bottom=CUT)
    fine.set_ylim(top=CUT)
    rough.tick_params(labelbottom=False, bottom=False, which="both")
    rough.spines.bottom.set_visible(False)
    fine.spines.top.set_visible(False)
    marks = {"marker": [(-1, -0.5), (1, 0.5)], "markersize": 7, "linestyle": "none"}
    for axes, height in ((rough, 0), (fine, 1)):
        place = {"transform": axes.transAxes, "clip_on": False, "color": house_style.BLACK}
        axes.plot([0, 1], [height, height], **marks, **place)


def _draw_growth(axes: Axes, rows: Sequence[_Row], batches: Sequence[int]) -> None:
    for model, dashes in GROWTH.items():
        family = FAMILIES[model]
        same = [row for row in rows if row[MODEL] == model]
        if not same:  # the continuum, where the contact is not elastic
            continue
        row = same[len(same) // 2]
        known = [batch for batch in batches if f"time_{batch} [s]" in row]
        time = [MICROSECONDS * row[f"time_{batch} [s]"] for batch in known]
        axes.loglog(known, time, linestyle=dashes, linewidth=0.9, **family.style())


def _add_legend(figure: Figure) -> None:
    entries = {family.label: family for family in FAMILIES.values()}
    keys = [
        house_style.key(label, linestyle="none", **family.style())
        for label, family in entries.items()
    ]
    fronts = [
        house_style.key("Pareto front", **FRONT),
        house_style.key("with responses", **FRONT_WITH_RESPONSES),
    ]
    blank = house_style.key("", linestyle="none")
    groups = keys[:2], keys[2:7], [*keys[7:], blank, *fronts]
    house_style.legend_below(
        figure, *groups, titles=("closed form", "in steps", "compiled responses")
    )
