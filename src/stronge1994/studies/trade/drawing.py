"""Beyond the paper: error of every model against its time, and time against the size of batch."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
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
ERROR_LABEL, TIME_LABEL = r"error of $v_1(t_f)/\mu v_2(0)$, rms", "time of an impact, s"
NAMES = {"rigid": "rigid", "laws.smith": "Smith", "laws.brach": "Brach"}
# Range of errors that uncertain inputs hide.
HIDDEN: Style = {"color": "0.9", "linewidth": 0, "zorder": 0.5, "label": r"uncertain $e$ and $\mu$"}


def _mark(label: str, marker: str, colour: str, filled: bool = True) -> Style:
    return {
        "label": label,
        "marker": marker,
        "markersize": 5,
        "color": colour,
        "markerfacecolor": colour if filled else "none",
        "markeredgewidth": 0.9,
        "linestyle": "none",
    }


# A colour stands for what takes the energy: black for the normal element of the paper, blue for
# viscosity, orange for plastic flow, green for an elastic contact. Grey formulas have none, and
# other codes are purple.
BLACK, ELASTIC = house_style.BLACK, house_style.GREEN
VISCOUS, PLASTIC, OTHER = house_style.BLUE, house_style.ORANGE, house_style.PURPLE
FORMULA = _mark("formula", "D", house_style.GREY)
MARKS = {
    "rigid": FORMULA,
    "laws.smith": FORMULA,
    "laws.brach": FORMULA,
    "lumped": _mark("lumped, as in the paper", "o", BLACK),
    "lumped.hysteretic": _mark("lumped, as in the paper", "o", BLACK),
    "lumped.viscous": _mark("lumped, viscous", "P", VISCOUS),
    "lumped.unloading-stiffness": _mark(r"lumped, $e^2\zeta^2$", "P", PLASTIC, filled=False),
    "spheres": _mark("table", "X", ELASTIC),
    "spheres.viscous": _mark("table, viscous", "X", VISCOUS),
    "spheres.plastic": _mark("table, plastic", "X", PLASTIC, filled=False),
    SPLINE: _mark("spline, one pair of bodies", "*", ELASTIC),
    "timestep.linear": _mark("linear spring, in steps", "s", BLACK, filled=False),
    "timestep.mindlin": _mark("Mindlin, in steps", "^", BLACK),
    "timestep.mindlin_rescaled": _mark("Mindlin, rescaled", "v", BLACK, filled=False),
    "continuum": _mark("continuum", "o", ELASTIC, filled=False),
    "continuum.viscous": _mark("continuum, viscous", "o", VISCOUS),
    "continuum.plastic": _mark("continuum, plastic", "o", PLASTIC, filled=False),
    "LAMMPS": _mark("LAMMPS", "d", OTHER, filled=False),
    "pooltool": _mark("pooltool", "p", OTHER),
}
# These models have a line against the size of batch. The lines of the others would lie beside them.
GROWTH = ("laws.brach", "lumped", "timestep.mindlin", "continuum", SPLINE)


def draw(curves: Table, settings: Settings, points: Points) -> Figure:
    """Draw error against time for the first restitution and the last, and time against batch.

    A restitution below 1 has a panel for each loss.
    """
    batches = sorted(settings["batches"])
    batch = batches[len(batches) // 2]
    time = f"time_{batch} [s]"
    ends = dict.fromkeys((settings["restitution"][0], settings["restitution"][-1]))
    cases = {
        (e, loss): same
        for e in ends
        for loss, same in curves[tables.where(curves, e=e)].groupby("loss", sort=False)
    }
    figure = house_style.new(10.2)
    grid = figure.add_gridspec(3, 2, height_ratios=[4, 4, 2.6])
    cells = grid[0, :], grid[1, 0], grid[1, 1]
    for letter, cell, ((e, loss), same) in zip("abc", cells, cases.items(), strict=False):
        axes = figure.add_subplot(cell, xscale="log", yscale="log")
        timed = same.reindex(columns=[*same, time]) if time not in same else same
        timed = timed.dropna(subset=[time])
        _draw_errors(axes, timed, time, numbers=letter == "a")
        if OTHERS in points and batch == BATCH_OF_OTHERS:
            others = points[OTHERS].columns
            others = others[tables.where(others, loss=loss, **{"restitution [1]": e})]
            _draw_others(axes, timed, time, others)
        axes.margins(0.15, 0.08)
        axes.set(title=f"({letter}) $e = {e:g}$, {loss or 'elastic'} continuum", xlabel=TIME_LABEL)
        axes.set_ylabel(ERROR_LABEL, visible=letter != "c")
    growth = figure.add_subplot(grid[2, :])
    _draw_growth(growth, next(iter(cases.values())), batches)
    first = settings["restitution"][0]
    growth.set(title=f"(d) $e = {first:g}$", xlabel="impacts together", ylabel=TIME_LABEL)
    figure.suptitle(f"(a) to (c): {batch} impacts together", fontsize=house_style.NOTE)
    styles = {str(mark["label"]): mark for mark in map(mark_of, [*MARKS, *curves["model"]])}
    keys = [house_style.key(**style) for style in styles.values()] + [Patch(**HIDDEN)]
    house_style.legend_below(figure, keys[:9], keys[9:])
    return figure


def mark_of(model: str) -> Style:
    """The mark of a model; one that has none in `MARKS` has its own name.

    >>> mark_of("lumped.viscous")["label"], mark_of("own.law")["label"]
    ('lumped, viscous', 'own.law')
    """
    return MARKS.get(model, _mark(model, "h", house_style.GREY, filled=False))


def _draw_errors(axes: Axes, rows: Table, time: str, numbers: bool) -> None:
    """Draw a point for each model, and which errors are hidden.

    With `numbers` the setting of a model stands beside its point, or the name of a formula.
    """
    for _, row in rows.iterrows():
        axes.plot([row[time]], [row[ERROR]], **mark_of(row["model"]))
        if numbers and (text := _number(row)):
            # Names stand on the left: formulas are fast, and of nearly one time.
            left: Style = {"xytext": (-5, 0), "ha": "right", "va": "center"}
            place: Style = left if text.isalpha() else {"xytext": (4, 3)}
            place |= {"textcoords": "offset points", "fontsize": house_style.NOTE}
            axes.annotate(text, (row[time], row[ERROR]), **place)
    if len(rows):
        axes.axhspan(*rows[[SPREAD_STICK, SPREAD]].iloc[0], **HIDDEN)


def _number(row: Mapping[str, Any]) -> str:
    """The number of steps or knots, or the tolerance; two laws of Mindlin need it once.

    >>> _number({"model": "continuum", "tolerance": 1e-3})
    '$10^{-3}$'
    """
    settings = {key: row.get(key, np.nan) for key in ("tolerance", "knots", "steps")}
    known = {key: value for key, value in settings.items() if value > 0}
    if "tolerance" in known:
        return f"$10^{{{np.log10(known['tolerance']):.3g}}}$"
    if known and row["model"] != "timestep.mindlin_rescaled":
        return f"{next(iter(known.values())):g}"
    return NAMES.get(row["model"], "")


def _draw_others(axes: Axes, rows: Table, time: str, others: Table) -> None:
    """Draw other codes, whose times are known over that of the table of spheres."""
    names = "spheres" + ("." + rows["loss"]).where(rows["loss"] != "", "")
    table = rows[rows["model"] == names]
    for code, own in others.groupby("code", sort=False) if len(table) else ():
        times = own["times_table [1]"] * table[time].iloc[0]
        axes.plot(times, own[ERROR], **MARKS[code])


def _draw_growth(axes: Axes, rows: Table, batches: Sequence[int]) -> None:
    """Draw time against the size of batch, with the finest setting of each model."""
    for model, dashes in zip(GROWTH, house_style.DASHES, strict=True):
        own = rows[rows["model"] == model]
        finest = own.sort_values(["steps", "tolerance"], ascending=[True, False]).tail(1)
        columns = [f"time_{batch} [s]" for batch in batches]
        for _, row in finest.reindex(columns=columns).iterrows():
            style = MARKS[model] | {"linestyle": dashes, "linewidth": 0.9}
            solved = row.notna().to_numpy()
            axes.loglog(np.array(batches)[solved], row[solved], **style)
