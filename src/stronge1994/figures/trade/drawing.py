"""Beyond the paper: error of every model against its time, and time against the size of batch."""

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from stronge1994.csv_tables import Columns, Curves
from stronge1994.figures.shared.drawing import house_style
from stronge1994.figures.shared.drawing.house_style import Points, Settings, Style

ERROR, MODEL, E = "rms_velocity [mu v2(0)]", "model", "restitution [1]"
SPREAD, SPREAD_STICK = "input_spread [mu v2(0)]", "input_spread_stick [mu v2(0)]"
TOLERANCE, SPLINE = "tolerance [mu v2(0)]", "spline of continuum"
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
    "annuli": _mark("annuli", "h", ELASTIC),
    "continuum": _mark("continuum", "o", ELASTIC, filled=False),
    "continuum.viscous": _mark("continuum, viscous", "o", VISCOUS),
    "continuum.plastic": _mark("continuum, plastic", "o", PLASTIC, filled=False),
    "LAMMPS": _mark("LAMMPS", "d", OTHER, filled=False),
    "pooltool": _mark("pooltool", "p", OTHER),
}
# These models have a line against the size of batch. The lines of the others would lie beside them.
GROWTH = ("laws.brach", "lumped", "timestep.mindlin", "continuum", "annuli", SPLINE)


def draw(curves: Curves, settings: Settings, points: Points) -> Figure:
    """Draw error against time for the first restitution and the last, and time against batch.

    A restitution below 1 has a panel for each loss.
    """
    batches = sorted(settings["batches"])
    batch = batches[len(batches) // 2]
    cases: dict[tuple[float, str], Curves] = {}
    for e in dict.fromkeys((settings["restitution"][0], settings["restitution"][-1])):
        for name, curve in curves.items():
            if curve[E][0] == e:
                cases.setdefault((e, _loss(curve)), {})[name] = curve
    figure = house_style.new(10.2)
    grid = figure.add_gridspec(3, 2, height_ratios=[4, 4, 2.6])
    cells = grid[0, :], grid[1, 0], grid[1, 1]
    for letter, cell, ((e, loss), same) in zip("abc", cells, cases.items(), strict=False):
        axes = figure.add_subplot(cell, xscale="log", yscale="log")
        timed = {name: curve for name, curve in same.items() if f"time_{batch} [s]" in curve}
        _draw_errors(axes, timed, f"time_{batch} [s]", numbers=letter == "a")
        if OTHERS in points and batch == BATCH_OF_OTHERS:
            _draw_others(axes, timed, f"time_{batch} [s]", points[OTHERS]["columns"])
        axes.margins(0.15, 0.08)
        axes.set(title=f"({letter}) $e = {e:g}$, {loss or 'elastic'} continuum", xlabel=TIME_LABEL)
        axes.set_ylabel(ERROR_LABEL, visible=letter != "c")
    growth = figure.add_subplot(grid[2, :])
    _draw_growth(growth, next(iter(cases.values())), batches)
    first = settings["restitution"][0]
    growth.set(title=f"(d) $e = {first:g}$", xlabel="impacts together", ylabel=TIME_LABEL)
    figure.suptitle(f"(a) to (c): {batch} impacts together", fontsize=house_style.NOTE)
    styles = {str(style["label"]): style for style in MARKS.values()}
    keys = [house_style.key(**style) for style in styles.values()] + [Patch(**HIDDEN)]
    house_style.legend_below(figure, keys[:10], keys[10:])
    return figure


def _loss(curve: Columns) -> str:
    return str(curve["loss"][0]) if "loss" in curve else ""


def _draw_errors(axes: Axes, curves: Curves, time: str, numbers: bool) -> None:
    """Draw a point for each model, and which errors are hidden.

    With `numbers` the setting of a model stands beside its point, or the name of a formula.
    """
    for name, curve in curves.items():
        house_style.line(axes, curves, name, time, ERROR, **MARKS[curve[MODEL][0]])
        if numbers and (text := _number(curve)):
            # Names stand on the left: formulas are fast, and of nearly one time.
            left: Style = {"xytext": (-5, 0), "ha": "right", "va": "center"}
            place: Style = left if text.isalpha() else {"xytext": (4, 3)}
            place |= {"textcoords": "offset points", "fontsize": house_style.NOTE}
            axes.annotate(text, (curve[time][0], curve[ERROR][0]), **place)
    for curve in list(curves.values())[:1]:
        axes.axhspan(curve[SPREAD_STICK][0], curve[SPREAD][0], **HIDDEN)


def _number(curve: Columns) -> str:
    """The number of steps, circles or knots, or the tolerance; two laws of Mindlin need it once.

    >>> _number({"model": ["continuum"], "tolerance [mu v2(0)]": [1e-3]})
    '$10^{-3}$'
    """
    model = curve[MODEL][0]
    if TOLERANCE in curve:
        return f"$10^{{{np.log10(curve[TOLERANCE][0]):.3g}}}$"
    for key in ("circles [1]", "knots [1]", "steps [1]"):
        if key in curve and model != "timestep.mindlin_rescaled":
            return f"{curve[key][0]:g}"
    return NAMES.get(model, "")


def _draw_others(axes: Axes, curves: Curves, time: str, others: Columns) -> None:
    """Draw other codes, whose times are known over that of the table of spheres."""
    for table in curves.values():
        loss = _loss(table)
        if table[MODEL][0] != (f"spheres.{loss}" if loss else "spheres"):
            continue
        same = (others[E] == table[E][0]) & (others["loss"] == loss)
        times = others["times_table [1]"][same].astype(float) * table[time][0]
        for code in ("LAMMPS", "pooltool"):
            rows = np.char.startswith(others["curve"][same], code)
            axes.plot(times[rows], others[ERROR][same][rows], **MARKS[code])


def _draw_growth(axes: Axes, curves: Curves, batches: Sequence[int]) -> None:
    """Draw time against the size of batch, with the finest setting of each model."""
    for model, dashes in zip(GROWTH, ("-", *house_style.DASHES), strict=True):
        for curve in [c for c in curves.values() if c[MODEL][0] == model][-1:]:
            solved = {b: curve[f"time_{b} [s]"][0] for b in batches if f"time_{b} [s]" in curve}
            style = MARKS[model] | {"linestyle": dashes, "linewidth": 0.9}
            axes.loglog(list(solved), list(solved.values()), **style)
