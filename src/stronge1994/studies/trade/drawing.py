"""Beyond the paper: error of every model and its time, and time against the size of batch."""

from collections.abc import Iterable, Sequence

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from stronge1994 import tables
from stronge1994.figures.shared.drawing import house_style
from stronge1994.figures.shared.drawing.house_style import Points, Settings, Style
from stronge1994.tables import Table

ERROR, SPLINE = "rms_velocity [mu v2(0)]", "spline of continuum"
SPREAD, SPREAD_STICK = "input_spread [mu v2(0)]", "input_spread_stick [mu v2(0)]"
OTHERS, BATCH_OF_OTHERS = "other_codes/impacts", 100
# Range of errors that uncertain inputs hide.
HIDDEN: Style = {"color": "0.9", "linewidth": 0, "zorder": 0.5, "label": r"uncertain $e$ and $\mu$"}
# Each model has a row, in this order; the names of both springs of the paper have the same.
ROWS = {
    "rigid": "rigid",
    "laws.smith": "law of Smith",
    "laws.brach": "law of Brach",
    "lumped": "lumped, as in the paper",
    "lumped.hysteretic": "lumped, as in the paper",
    "lumped.unloading-stiffness": r"lumped, $e^2\zeta^2$",
    "lumped.viscous": "lumped, Kelvin–Voigt",
    "timestep.linear": "linear spring, in steps",
    "timestep.mindlin": "Mindlin, in steps",
    "timestep.mindlin_rescaled": "Mindlin, rescaled",
    "LAMMPS": "LAMMPS",
    "pooltool": "pooltool",
    "continuum": "continuum",
    "continuum.viscous": "continuum, viscous",
    "continuum.plastic": "continuum, plastic",
    "spheres": "table",
    "spheres.viscous": "table, viscous",
    "spheres.plastic": "table, plastic",
    SPLINE: "spline, one pair",
}
# A row has a mark for each case: the elastic continuum, the viscous one, the plastic one.
MARKS: dict[str, Style] = {
    "": {"color": house_style.BLACK, "marker": "o"},
    "viscous": {"color": house_style.BLUE, "marker": "s"},
    "plastic": {"color": house_style.ORANGE, "marker": "^"},
}
# How far apart the marks of a row are, over its height.
CASE_SPACING = 0.24
# These models have a line against the size of batch. The lines of the others would lie beside them.
GROWTH = ("laws.brach", "lumped", "timestep.mindlin", "continuum", SPLINE)


def draw(curves: Table, settings: Settings, points: Points) -> Figure:
    """Draw (a) the error and (b) the time of each model, and (c) time against batch.

    The cases are the first restitution and the last, one below 1 with each loss.
    """
    batches = sorted(settings["batches"])
    batch = batches[len(batches) // 2]
    time = f"time_{batch} [s]"
    ends = dict.fromkeys((settings["restitution"][0], settings["restitution"][-1]))
    cases = {
        (e, loss): _with_others(same, points if batch == BATCH_OF_OTHERS else {}, e, loss)
        for e in ends
        for loss, same in curves[tables.where(curves, e=e)].groupby("loss", sort=False)
    }
    models = {*(model for rows in cases.values() for model in rows["model"])}
    names = list(dict.fromkeys(name_of(model) for model in [*ROWS, *sorted(models)]))
    names = [name for name in names if name in set(map(name_of, models))]
    figure = house_style.new(1.9 + 0.2 * len(names) + 2.5)
    grid = figure.add_gridspec(2, 1, height_ratios=[0.2 * len(names) + 0.4, 2])
    error, times = grid[0].subgridspec(1, 2).subplots(sharey=True)
    keys: house_style.Entries = []
    for place, ((e, loss), rows) in enumerate(cases.items()):
        mark: Style = MARKS[loss] | {"markersize": 4, "markerfacecolor": "white", "linewidth": 0.8}
        for row, name in enumerate(names):
            own = rows[[name_of(model) == name for model in rows["model"]]]
            height = row + CASE_SPACING * (place - (len(cases) - 1) / 2)
            for axes, column in ((error, ERROR), (times, time)):
                if column in own:
                    _draw_range(axes, own[column].dropna(), height, mark)
        # An artist of the panel, so that the slide has its entry, too.
        keys += error.plot([], [], label=f"$e = {e:g}$, {loss or 'elastic'}", **mark)
    spreads = [rows[[SPREAD_STICK, SPREAD]].iloc[0] for rows in cases.values() if len(rows)]
    if spreads:
        error.axvspan(
            min(own.min() for own in spreads), max(own.max() for own in spreads), **HIDDEN
        )
    error.set(ylim=(len(names) - 0.5, -0.5), title="(a) error, rms", xlabel=house_style.REBOUND)
    error.set_yticks(range(len(names)), names, fontsize=house_style.NOTE)
    times.set(title=f"(b) time, {batch} together", xlabel="time of an impact, s")
    for axes in (error, times):
        axes.set_xscale("log")
        axes.tick_params(axis="y", length=0)
        for row in range(1, len(names)):
            axes.axhline(row - 0.5, **house_style.GUIDE)
    growth = figure.add_subplot(grid[1])
    _draw_growth(growth, next(iter(cases.values())), batches)
    first = settings["restitution"][0]
    growth.set(title=f"(c) $e = {first:g}$", xlabel="impacts together", ylabel="time of one, s")
    half = (len(keys) + 2) // 2
    keys = [*keys, Patch(**HIDDEN)]
    house_style.legend_below(figure, keys[:half], keys[half:])
    return figure


def name_of(model: str) -> str:
    """The name of the row of a model; one that has none in `ROWS` has its own.

    >>> name_of("lumped.viscous"), name_of("own.law")
    ('lumped, Kelvin–Voigt', 'own.law')
    """
    return ROWS.get(model, model)


def _with_others(rows: Table, points: Points, e: float, loss: str) -> Table:
    """Rows of one case with those of other codes.

    Their times are known over that of the table of spheres, in which they are measured.
    """
    table = rows[rows["model"] == ("spheres." + loss if loss else "spheres")]
    if OTHERS not in points or not len(table):
        return rows
    time = f"time_{BATCH_OF_OTHERS} [s]"
    others = points[OTHERS].columns
    own = others[tables.where(others, loss=loss, **{"restitution [1]": e})]
    times = own["times_table [1]"] * table[time].iloc[0]
    added = own[[ERROR]].assign(model=own["code"], **{time: times})
    return pd.concat([rows, added], ignore_index=True)


def _draw_range(axes: Axes, values: Iterable[float], height: float, mark: Style) -> None:
    """Draw the least and the largest value of a row, with a line between them."""
    if ends := sorted({*values}):
        ends = sorted({ends[0], ends[-1]})
        axes.plot(ends, [height] * len(ends), label="_", **mark)


def _draw_growth(axes: Axes, rows: Table, batches: Sequence[int]) -> None:
    """Draw time against the size of batch, with the finest setting of each model."""
    columns = [f"time_{batch} [s]" for batch in batches]
    for model, dashes, colour in zip(GROWTH, house_style.DASHES, house_style.COLOURS, strict=True):
        own = rows[rows["model"] == model]
        finest = own.sort_values(["steps", "tolerance"], ascending=[True, False]).tail(1)
        for _, row in finest.reindex(columns=columns).iterrows():
            solved = row.notna().to_numpy()
            size, time = np.array(batches)[solved], row[solved].to_numpy(float)
            style: Style = {"linestyle": dashes, "color": colour, "marker": "o", "markersize": 3}
            axes.loglog(size, time, label=ROWS[model], **style)
            # The name stands between the first two sizes.
            place = np.exp(np.mean(np.log([size[:2], time[:2]]), axis=1))
            white: Style = {"facecolor": "white", "edgecolor": "none", "pad": 0.6}
            middle: Style = {"ha": "center", "va": "center", "fontsize": house_style.NOTE}
            axes.text(*place, ROWS[model], color=colour, bbox=white, **middle)
