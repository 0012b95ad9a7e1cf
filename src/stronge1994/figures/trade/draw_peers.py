"""LAMMPS and pooltool: error against time for e = 1, and errors below e = 1 for each loss."""

import itertools
from collections.abc import Iterable, Mapping, Sequence
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from stronge1994 import csv_tables
from stronge1994.csv_tables import Curves
from stronge1994.figures.shared.drawing import house_style
from stronge1994.figures.shared.drawing.house_style import Settings
from stronge1994.figures.trade import drawing as draw_trade

CODES = {"lammps": "LAMMPS", "pooltool": "pooltool"}
# Purple is the colour of the other codes.
OTHER = draw_trade.Family("", "d", 6, house_style.PURPLE, False, draw_trade.RIGHT)
# The laws of LAMMPS lie together in panel (a). Panel (d) shows them apart.
LAWS = {
    "LAMMPS mindlin": OTHER._replace(marker="<", label="mindlin"),
    "LAMMPS mindlin/force": OTHER._replace(marker="^", label="mindlin/force"),
    "LAMMPS mindlin_rescale": OTHER._replace(marker=">", label="mindlin_rescale"),
    "LAMMPS mindlin_rescale/force": OTHER._replace(marker="v", label="mindlin_rescale/force"),
}
TOGETHER = OTHER._replace(marker="+", size=6, label="LAMMPS: see (d)", place=None)
POOLTOOL = OTHER._replace(label="pooltool", place=draw_trade.UPPER_RIGHT)

ERROR, E, LOSS = draw_trade.ERROR, draw_trade.RESTITUTION, "loss"
STEPS, USUAL_STEPS = draw_trade.STEPS, 64
# The continuum of each panel.
PANELS = {"viscous": "(a) viscous loss", "plastic": "(b) plastic loss"}
# Labels of models of ours. Each continuum is drawn in the panel of the other.
OUR_LABELS = {
    "lumped.hysteretic": "lumped: the paper",
    "continuum.viscous": "continuum of the other loss",
    "continuum.plastic": "continuum of the other loss",
}
# How the points of the restitutions are drawn, from the largest on.
MARKERS = (
    {"marker": "o", "markersize": 3.6, "markerfacecolor": "white"},
    {"marker": "s", "markersize": 3.4, "markerfacecolor": "0.65"},
    {"marker": "^", "markersize": 3.8, "markerfacecolor": house_style.BLACK},
)
TICKS = (0.05, 0.1, 0.2, 0.5, 1)
# Height in inches of a line of a legend or of the second figure, and of all else in that figure.
LINE, FRAME = 0.22, 1.1
# Distance of the points of two restitutions, in lines, so that none hides another.
RESTITUTION_SPACING = 0.27

_Row: TypeAlias = dict[str, Any]


class _Line(NamedTuple):
    """A line of the second figure: a heading, or a code with its settings."""

    label: str
    heading: bool = False


def draw(curves: Curves, peers: Curves, settings: Settings) -> tuple[Figure, Curves]:
    """Draw figure `trade` with the other codes at e = 1, and the tables of which it shows numbers.

    `curves` are those of results/curves/trade.csv, `peers` those of results/peers.csv. The title
    names the codes that are not installed.
    """
    codes = dict.fromkeys(LAWS, TOGETHER) | {"pooltool": POOLTOOL}
    theirs = {
        name: row
        for name, row in peers.items()
        if row["model"][0] in codes and ERROR in row and row[E][0] == 1
    }
    tables = draw_trade.drawn_curves(curves | theirs, settings, {})
    theirs = {name: tables[name] for name in theirs}
    figure = draw_trade.draw(tables, settings, {}, draw_trade.FAMILIES | codes)
    models = {row["model"][0] for row in theirs.values()}
    legend = [_keys({codes[model].label: codes[model] for model in sorted(models)}.values())]
    if models & set(LAWS):
        axes = next(axes for axes in figure.axes if axes.get_label() == draw_trade.GROWTH_PANEL)
        axes.clear()
        _draw_laws(axes, theirs, draw_trade.shown_batch(settings))
        legend.append(_keys(LAWS.values()))
    if models:
        figure.set_figheight(figure.get_figheight() + LINE * max(map(len, legend)))
        house_style.legend_below(figure, *legend)
    if missing := _missing(peers):
        note = f"not installed: {missing}\n{figure.get_suptitle()}"
        figure.suptitle(note, fontsize=house_style.NOTE)
    return figure, tables


def _missing(peers: Curves) -> str:
    return ", ".join(label for code, label in CODES.items() if code in peers)


def _keys(families: Iterable[draw_trade.Family]) -> list[Line2D]:
    return [
        house_style.key(family.label, linestyle="none", **family.style()) for family in families
    ]


def _draw_laws(axes: Axes, peers: Curves, batch: int) -> None:
    """Draw errors of LAMMPS' laws against time, on a linear scale of error."""
    for curve in peers.values():
        row = {key: value[0] for key, value in curve.items()}
        time = row.get(draw_trade.time_column(batch))
        if row[draw_trade.MODEL] in LAWS and time is not None:
            family = LAWS[row[draw_trade.MODEL]]
            at = time, row[draw_trade.ERROR]
            axes.semilogx(*at, linestyle="none", **family.style())
            draw_trade.label(axes, at, draw_trade.label_of(row), family.place)
    axes.margins(x=1.0, y=0.15)  # so wide that there are two powers of ten
    axes.locator_params(axis="y", nbins=4)
    axes.set(xlabel=draw_trade.TIME_LABEL, ylabel="error, rms", title="(d) LAMMPS, part of (a)")


def draw_errors(peers: Curves) -> tuple[Figure, Curves]:
    """Draw the errors below e = 1 of each code and model, a panel for each loss; with tables."""
    rows = [{key: value[0] for key, value in row.items()} for row in peers.values()]
    rows = [row for row in rows if row.get(LOSS) in PANELS and ERROR in row and _is_drawn(row)]
    missing = _missing(peers)
    if not rows:
        return house_style.failure(f"not installed: {missing}" if missing else "no errors"), {}
    lines = _lines(rows)
    figure = house_style.new(FRAME + LINE * len(lines))
    both = figure.subplots(1, 2, sharex=True, sharey=True)
    values = sorted({row[E] for row in rows}, reverse=True)
    styles = {e: MARKERS[i] for i, e in enumerate(values)}
    tables = _errors(rows, values)
    for axes, (loss, title) in zip(both, PANELS.items(), strict=True):
        _draw_loss(axes, tables, loss, lines, styles)
        axes.set_xlabel(draw_trade.ERROR_LABEL, visible=False)
        axes.set_title(title)
    ticks = [place for place, line in enumerate(lines) if not line.heading]
    both[0].set_yticks(ticks, [lines[place].label for place in ticks], fontsize=house_style.NOTE)
    both[0].tick_params(axis="y", length=0)
    both[1].tick_params(axis="y", length=0)
    for place, line in enumerate(lines):
        if line.heading:
            at = {"xytext": (-4, 0), "textcoords": "offset points", "ha": "right", "va": "center"}
            both[0].annotate(
                line.label,
                (0, place),
                xycoords=both[0].get_yaxis_transform(),
                fontsize=house_style.NOTE,
                style="italic",
                **at,
            )
    both[0].set_ylim(len(lines) - 0.4, -0.6)
    keys = [
        house_style.key(f"$e = {e:g}$", linestyle="none", color=house_style.BLACK, **style)
        for e, style in styles.items()
    ]
    title = r"error of $v_1(t_f)/\mu v_2(0)$ against the continuum, rms over the incidences"
    absent = f"\nnot installed: {missing}" if missing else ""
    figure.legend(
        handles=keys,
        title=title + absent,
        title_fontsize=house_style.NOTE,
        loc="outside lower center",
        ncols=len(keys),
        handlelength=1,
    )
    return figure, tables


def _errors(rows: Sequence[_Row], values: Sequence[float]) -> Curves:
    """Errors of each line of a panel, together and for each restitution."""
    tables: Curves = {}
    for e, row in itertools.product(values, rows):
        if row[E] == e:
            name, error = f"{_label_of(row)}, {row[LOSS]}", np.array([row[ERROR]])
            line = tables.setdefault(name, {ERROR: np.array([])})
            tables[name] = {ERROR: np.append(line[ERROR], error)}
            tables[f"{name}, e = {e:g}"] = {ERROR: error}
    return tables


def _is_drawn(row: _Row) -> bool:
    """Whether a row is drawn: a continuum once, in the panel of the other loss.

    >>> _is_drawn({"model": "lumped.hysteretic", "loss": "viscous"})
    True
    >>> _is_drawn({"model": "continuum.viscous", "loss": "viscous"})
    False
    """
    model: str = row[draw_trade.MODEL]
    return not model.startswith("spheres.") and model != f"continuum.{row[LOSS]}"


def _lines(rows: Sequence[_Row]) -> list[_Line]:
    """Lines from the top: LAMMPS, pooltool, ours, each below its heading."""
    groups: dict[str, list[str]] = {
        "LAMMPS, viscoelastic and $x_t = 0$ unless said": [],
        "pooltool": [],
        "planarimpact": [],
    }
    theirs, pooltool, ours = groups.values()
    for row in rows:
        model = row[draw_trade.MODEL]
        group = theirs if model.startswith("LAMMPS") else pooltool if model == "pooltool" else ours
        if _label_of(row) not in group:
            group.append(_label_of(row))
    lines = []
    for heading, group in groups.items():
        if group:
            lines += [_Line(heading, heading=True), *map(_Line, group)]
    return lines


def _label_of(row: _Row) -> str:
    """Label of the code and settings of a row.

    >>> _label_of({"model": "LAMMPS mindlin, viscoelastic, xt = 0.5", "steps [1]": 256.0})
    'mindlin, $x_t = 0.5$, 256 steps'
    >>> _label_of({"model": "pooltool"})
    "the paper's model"
    """
    model: str = row[draw_trade.MODEL]
    if model == "pooltool":
        return "the paper's model"
    if not model.startswith("LAMMPS "):
        label = OUR_LABELS.get(model, model)
    else:
        law, style, tangential, *others = model.removeprefix("LAMMPS ").split(", ")
        known = [] if style == "viscoelastic" else [style]
        known += [] if tangential == "xt = 0" else [f"${tangential.replace('xt', 'x_t')}$"]
        label = ", ".join([law, *known, *others])
    steps = row.get(STEPS, USUAL_STEPS)
    return label if steps == USUAL_STEPS else f"{label}, {steps:g} steps"


def _draw_loss(
    axes: Axes, tables: Curves, loss: str, lines: Sequence[_Line], styles: Mapping[float, Any]
) -> None:
    places = {line.label: place for place, line in enumerate(lines) if not line.heading}
    for label, place in places.items():
        errors = {e: tables.get(f"{label}, {loss}, e = {e:g}") for e in styles}
        heights = {
            e: place + (i - (len(styles) - 1) / 2) * RESTITUTION_SPACING
            for i, e in enumerate(styles)
        }
        known = {e: table[ERROR][0] for e, table in errors.items() if table}
        points = list(known.values()), [heights[e] for e in known]
        axes.plot(*points, color=house_style.GREY, linewidth=0.6, zorder=1)
        for e, error, height in zip(known, *points, strict=True):
            marker = {"color": house_style.BLACK, "markeredgewidth": 0.8, **styles[e]}
            axes.plot(error, height, linestyle="none", **marker)
    axes.set_xscale("log")
    axes.set_xticks(TICKS, [f"{tick:g}" for tick in TICKS])
    axes.minorticks_off()
    for tick in TICKS:
        axes.axvline(tick, **house_style.GUIDE)


def write(
    curves: str, peers: str, settings: Settings, pictures: Sequence[str], errors: Sequence[str]
) -> None:
    """Draw both figures as SVG and PNG."""
    theirs = csv_tables.read(peers)
    drawn = [draw(csv_tables.read(curves), theirs, settings), draw_errors(theirs)]
    for (picture, _), (svg, png) in zip(drawn, (pictures, errors), strict=True):
        house_style.save(picture, svg, png)
