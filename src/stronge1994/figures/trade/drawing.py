"""Beyond the paper: error of every model against its time, and time against the size of batch."""

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.gridspec import SubplotSpec

from stronge1994.csv_tables import Curves
from stronge1994.figures.shared.drawing import house_style
from stronge1994.figures.shared.drawing.house_style import Points, Settings, Style

_Row: TypeAlias = dict[str, Any]
Place: TypeAlias = tuple[str, float, float]

ERROR, MODEL, RESTITUTION = "rms_velocity [mu v2(0)]", "model", "restitution [1]"
SPREAD, SPREAD_STICK = "input_spread [mu v2(0)]", "input_spread_stick [mu v2(0)]"
STEPS, CIRCLES, TOLERANCE = "steps [1]", "circles [1]", "tolerance [mu v2(0)]"
KNOTS, SPLINE = "knots [1]", "spline of continuum"
LOSSES = (".viscous", ".plastic")
# Room for labels left of the fastest model, as a share of the axis of time: of the wide panel and
# of the others.
MARGINS = 0.12, 0.3
HIDDEN_NOTE = (
    "grey band: how far $v_1(t_f)$ moves if $e$ changes by 0.02 and $\\mu$ by 10 %;\n"
    "lower edge: impacts that stick at first; upper edge: all impacts"
)
ERROR_LABEL, TIME_LABEL = r"error of $v_1(t_f)/\mu v_2(0)$, rms", "time of an impact (µs)"

# Where labels are: horizontal alignment, and distances from the point. The line of a front comes to
# its point from above and leaves it to the right.
RIGHT, LEFT = ("left", 5, -2.5), ("right", -5, -2.5)
LOWER_RIGHT, LOWER_LEFT = ("left", 4, -9.5), ("right", -4, -9.5)
UPPER_RIGHT = ("left", 4, 2.5)
OTHER_LOSS, OF_OTHER_LOSS = "other loss", ("right", 5, 5)
FLOOR = 1e-12  # smaller errors are rounding
IMPACTS, TIME = "impacts [1]", "time [us]"


def over_batches(name: str) -> str:
    """Name of the table of the times of one row of results/curves/trade.csv."""
    return f"{name}, over batches"


def drawn_curves(curves: Curves, settings: Settings, points: Points) -> Curves:
    """Times in microseconds, errors from rounding on, and a table over the batches of each row."""
    named = {}
    for name, row in curves.items():
        known = [b for b in sorted(settings["batches"]) if f"time_{b} [s]" in row]
        times = {time_column(b): 1e6 * row[f"time_{b} [s]"] for b in known}
        named[name] = row | times
        if ERROR in row:
            named[name] |= {ERROR: np.maximum(row[ERROR], FLOOR)}
        over = np.concatenate([[], *times.values()])
        named[over_batches(name)] = {IMPACTS: np.array(known, float), TIME: over}
    return named


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


# A colour stands for what takes the energy: black for the normal element of the paper, blue for
# viscosity, vermillion for plastic flow, green for an elastic contact. Grey formulas have none.
BLACK, ELASTIC = house_style.BLACK, house_style.GREEN
VISCOUS, PLASTIC = house_style.BLUE, house_style.VERMILLION
FORMULA = Family("formula", "D", 3.5, house_style.GREY, True, ("left", 1, 9))
FAMILIES = {
    "rigid": FORMULA._replace(place=("right", -5, 1)),
    "laws.smith": FORMULA._replace(place=("right", -5, -6)),
    "laws.brach": FORMULA,
    **dict.fromkeys(
        ("lumped", "lumped.hysteretic"),
        Family("lumped, as in the paper", "o", 3.5, BLACK, True, None),
    ),
    "timestep.linear": Family("linear spring", "s", 5.5, BLACK, False, LOWER_RIGHT),
    # It has no label: its numbers of steps are those of the next model.
    "timestep.mindlin": Family("Mindlin", "^", 5, BLACK, True, None),
    "timestep.mindlin_rescaled": Family("Mindlin, rescaled", "v", 5, BLACK, False, UPPER_RIGHT),
    "lumped.viscous": Family("lumped, viscous", "P", 5, VISCOUS, True, None),
    "lumped.unloading-stiffness": Family(r"lumped, $e^2\zeta^2$", "P", 5, PLASTIC, False, None),
    "continuum": Family("continuum", "o", 5, ELASTIC, False, LOWER_LEFT),
    "continuum.viscous": Family("continuum, viscous", "o", 5, VISCOUS, True, LOWER_LEFT),
    "continuum.plastic": Family("continuum, plastic", "o", 5, PLASTIC, False, LOWER_LEFT),
    "spheres": Family("table", "X", 5.5, ELASTIC, True, None),
    "spheres.viscous": Family("table, viscous", "X", 5.5, VISCOUS, True, None),
    "spheres.plastic": Family("table, plastic", "X", 5.5, PLASTIC, False, None),
    "annuli": Family("annuli", "h", 5.5, ELASTIC, True, RIGHT),
    SPLINE: Family("spline of the continuum", "*", 7, ELASTIC, True, RIGHT),
}
# Two columns of equal length.
LEGEND = {
    "in steps": (
        "timestep.linear",
        "timestep.mindlin",
        "timestep.mindlin_rescaled",
        "annuli",
        "continuum",
        "continuum.viscous",
        "continuum.plastic",
    ),
    "for one pair of bodies": (SPLINE,),
    "closed form": ("rigid", "lumped", "lumped.viscous", "lumped.unloading-stiffness"),
    "from a table": ("spheres", "spheres.viscous", "spheres.plastic"),
}
NAMES = {"rigid": "rigid", "laws.smith": "Smith", "laws.brach": "Brach"}
NAMES |= {"pooltool": "pooltool"}
GROWTH_PANEL = "growth"
# These models have a line against the size of batch. The lines of the others would lie beside them.
GROWTH = {
    "laws.brach": house_style.DASHES[0],
    "lumped": house_style.DASHES[0],
    "timestep.mindlin": house_style.DASHES[1],
    "continuum": house_style.DASHES[2],
    "annuli": house_style.DASHES[3],
    SPLINE: house_style.DASHES[4],
}
# Range of errors that uncertain inputs hide.
HIDDEN = {"color": "0.9", "linewidth": 0, "zorder": 0.5}
FRONT = {"color": house_style.BLACK, "linewidth": 0.6, "zorder": 0.9}


def draw(
    curves: Curves, settings: Settings, points: Points, families: Mapping[str, Family] = FAMILIES
) -> Figure:
    """Draw error against time for the first restitution and the last, and time against batch.

    A restitution below 1 has a panel for each loss. `families` may hold more than those of the
    legend. The title says how far the times scatter.
    """
    rows = [
        {key: value[0] for key, value in curve.items()}
        for curve in curves.values()
        if MODEL in curve
    ]
    ends = settings["restitution"][0], settings["restitution"][-1]
    cases = {_case(row): None for e in ends for row in rows if row[RESTITUTION] == e}
    batch = shown_batch(settings)
    figure = house_style.new(9.4)
    grid = figure.add_gridspec(3, 2, height_ratios=[4, 4, 3.6])
    cells = grid[0, :], grid[1, 0], grid[1, 1]
    for number, (cell, case) in enumerate(zip(cells, cases, strict=False)):
        same = [row for row in rows if _case(row) == case]
        if number:  # more steps do not change an error here, and would hide other points
            step_counts = sorted({row[STEPS] for row in same if STEPS in row})
            same = [
                row for row in same if row.get(STEPS) in (None, step_counts[len(step_counts) // 2])
            ]
        axes = figure.add_subplot(cell)
        axes.set(title=_title("abc"[number], *case), xlabel=TIME_LABEL)
        axes.set_ylabel(ERROR_LABEL, visible=number < 2)
        _draw_errors(axes, same, batch, families, MARGINS[min(number, 1)])
    below = grid[2, :].subgridspec(1, 2, width_ratios=[2, 3])
    growth = figure.add_subplot(below[0], label=GROWTH_PANEL)
    case = next(iter(cases))
    _draw_growth(
        growth, {n: c for n, c in curves.items() if MODEL in c and _case(c) == case}, curves
    )
    growth.set(title=f"(d) $e = {ends[0]:g}$", xlabel="impacts together", ylabel=TIME_LABEL)
    numbers = "numbers at points: steps, circles, knots or tolerance"
    note = f"{numbers}; errors: {batch} impacts together"
    notes = "\n".join([note, scatter(rows), HIDDEN_NOTE])
    figure.suptitle(notes, fontsize=house_style.NOTE)
    _add_legend(figure, below[1])
    return figure


def scatter(rows: Sequence[_Row]) -> str:
    """How far the rounds of a time lie apart, over all times.

    >>> scatter([{"scatter_1 [1]": 0.02, "scatter_10 [1]": 0.3}, {"scatter_1 [1]": 0.04}])
    'times scatter by 4 % (median), 30 % at most'
    """
    found = [cell for row in rows for key, cell in row.items() if key.startswith("scatter_")]
    median, largest = 100 * np.median(found), 100 * max(found)
    return f"times scatter by {median:.0f} % (median), {largest:.0f} % at most"


def time_column(batch: int) -> str:
    """Times of an impact in a batch, as `drawn_curves` gives them."""
    return f"time_{batch} [us]"


def shown_batch(settings: Settings) -> int:
    """Size of the batch whose times are drawn against errors: the middle one."""
    return sorted(settings["batches"])[len(settings["batches"]) // 2]


def _case(row: Mapping[str, Any]) -> tuple[float, str]:
    """Restitution and loss of the reference, of a row or of its table of one row."""
    return float(np.ravel(row[RESTITUTION])[0]), str(np.ravel(row.get("loss", ""))[0])


def _title(letter: str, restitution: float, loss: str) -> str:
    return f"({letter}) $e = {restitution:g}$, {loss or 'elastic'} continuum"


def _draw_errors(
    axes: Axes,
    rows: Sequence[_Row],
    batch: int,
    families: Mapping[str, Family],
    margin: float,
) -> None:
    """Draw the points, the front of all but the spline, and what uncertain inputs hide."""
    column = time_column(batch)
    timed = [row for row in rows if column in row]
    if not timed:
        return
    time, error = ([row[key] for row in timed] for key in (column, ERROR))
    for row, *at in zip(timed, time, error, strict=True):
        family = families[row[MODEL]]
        axes.plot(*at, linestyle="none", **family.style())
        text = label_of(row)
        label(axes, at, text, OF_OTHER_LOSS if text == OTHER_LOSS else family.place)
    axes.axhspan(timed[0][SPREAD_STICK], timed[0][SPREAD], **HIDDEN)
    left = min(time) * (min(time) / max(time)) ** margin
    edges = (left, max(time) * 3), (min(error) / 8, max(error) * 5)
    axes.set(xscale="log", yscale="log", xlim=edges[0], ylim=edges[1])
    any_pair = [i for i, row in enumerate(timed) if row[MODEL] != SPLINE]
    _draw_front(axes, [time[i] for i in any_pair], [error[i] for i in any_pair], edges)


def label(axes: Axes, at: Sequence[float], text: str, place: Place | None) -> None:
    """Write a text beside a point, if it is not empty and has a place."""
    if not text or place is None:
        return
    alignment, *offset = place
    axes.annotate(
        text,
        at,
        xytext=offset,
        textcoords="offset points",
        ha=alignment,
        fontsize=house_style.NOTE - 0.5,
        annotation_clip=True,
    )


def label_of(row: _Row) -> str:
    """Label of a point: the setting of its model, or its name."""
    if loss := row.get("loss"):
        if row[MODEL].endswith(LOSSES) and not row[MODEL].endswith(loss):
            return OTHER_LOSS if row[MODEL].startswith("continuum") else ""
        if STEPS in row or row[MODEL] == "laws.brach":
            return ""
    if STEPS in row and CIRCLES not in row:
        return f"{row[STEPS]:g}"
    for key in (CIRCLES, KNOTS):
        if key in row:
            return f"{row[key]:g}"
    if TOLERANCE in row:
        return f"$10^{{{np.log10(row[TOLERANCE]):.3g}}}$"
    return NAMES.get(row[MODEL], "")


def front(time: Sequence[float], error: Sequence[float]) -> list[int]:
    """Indices of the Pareto front, the fastest first: no other point is as fast and as accurate.

    >>> front([3.0, 1.0, 2.0, 2.5], [0.1, 0.5, 0.2, 0.3])
    [1, 2, 0]
    """
    indices: list[int] = []
    for index in sorted(range(len(time)), key=lambda i: (time[i], error[i])):
        if not indices or error[index] < error[indices[-1]]:
            indices.append(index)
    return indices


def _draw_front(
    axes: Axes,
    time: Sequence[float],
    error: Sequence[float],
    edges: tuple[tuple[float, float], tuple[float, float]],
) -> None:
    """Draw a Pareto front: a point above and to the right of it is worse in both."""
    (_, right), (_, top) = edges
    best = front(time, error)
    x = [time[best[0]], *(time[i] for i in best), right]
    y = [top, *(error[i] for i in best), error[best[-1]]]
    axes.step(x, y, where="post", **FRONT)


def _draw_growth(axes: Axes, rows: Curves, curves: Curves) -> None:
    for model, dashes in GROWTH.items():
        same = [name for name, row in rows.items() if row[MODEL][0] == model]
        if not same:  # the continuum, where the contact is not elastic
            continue
        table = curves[over_batches(same[len(same) // 2])]
        batch, time = table[IMPACTS], table[TIME]
        axes.loglog(batch, time, linestyle=dashes, linewidth=0.9, **FAMILIES[model].style())


def _add_legend(figure: Figure, cell: SubplotSpec) -> None:
    axes = figure.add_subplot(cell)
    axes.axis("off")
    entries = []
    for title, models in LEGEND.items():
        entries.append(house_style.key(title, linestyle="none"))
        for model in models:
            family = FAMILIES[model]
            entries.append(house_style.key(family.label, linestyle="none", **family.style()))
    legend = axes.legend(
        handles=[*entries, house_style.key("Pareto front", **FRONT)],
        loc="center",
        ncols=2,
        fontsize=house_style.NOTE,
        handlelength=1.4,
        columnspacing=1,
    )
    for text in legend.get_texts():
        if text.get_text() in LEGEND:
            text.set_style("italic")
