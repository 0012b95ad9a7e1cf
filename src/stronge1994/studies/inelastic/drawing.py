"""Beyond the paper: five models of loss below e = 1, and eleven measured pairs of materials."""

from dataclasses import replace

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import NullLocator
from scipy.special import chdtri

from planarimpact.common.arrays import Array
from stronge1994 import tables
from stronge1994.figures.shared.drawing import house_style, model_lines
from stronge1994.figures.shared.drawing.house_style import Points, Scatter, Settings, Style
from stronge1994.figures.shared.drawing.model_lines import POINT, STYLES
from stronge1994.names import MODELS
from stronge1994.studies.inelastic.trials import BETA_0, SIGNIFICANCE, E, Trial, goodness, trials
from stronge1994.tables import Table

X, W = "incidence [mu v2(0)]", "velocity [mu v2(0)]"
# A measured pair is a circle with its number.
CIRCLE: Style = POINT | {"markersize": 11.5, "zorder": 4}
# Distance of points of one restitution, which are drawn side by side.
PAIR_SPACING = 0.0055
# Distance of the models' marks in one trial, over the height of its row.
MODEL_SPACING = 0.16
# Trials in plain words. Those that change only the impacts to which beta_0 is fitted share a row.
FIT, OF_FIT = "fit ", "other impacts fitted"
WORDS = {
    "the stated sigmas are two sigmas": "half the uncertainty",
    "pairs of one material alone": "equal bodies alone",
}


def side_by_side(x: Array) -> Array:
    """Abscissae of points; those of nearly the same are moved apart a little.

    >>> side_by_side(np.array([0.9, 0.97, 0.9])).round(3).tolist()
    [0.897, 0.97, 0.903]
    """
    same = np.abs(x[:, None] - x) <= PAIR_SPACING
    place, count = np.tril(same, -1).sum(axis=1), same.sum(axis=1)
    return np.asarray(x + PAIR_SPACING * (place - (count - 1) / 2))


def draw(curves: Table, settings: Settings, points: Points) -> Figure:
    """Draw (a) beta_0 against e, (b) one contact at all incidences, (c) chi-squared by trial."""
    series = points[settings["points"]]
    figure = house_style.new(9.0)
    grid = figure.add_gridspec(3, height_ratios=[4.2, 2.1, 2.9])
    # Each panel is as wide as its own labels allow.
    parts = [grid[row].subgridspec(1, 1) for row in range(3)]
    bands, contact, judged = (figure.add_subplot(part[0]) for part in parts)
    edges = dict(tables.each(curves, "nu"))
    for edge in edges.values():
        model_lines.draw(bands, edge, E, BETA_0)
    for model in MODELS:
        below, above = (tables.select(edge, model=model) for edge in edges.values())
        shade = {"color": STYLES[model]["color"], "alpha": 0.13, "linewidth": 0}
        bands.fill_between(below[E], below[BETA_0], above[BETA_0], **shade)
    low, high = edges
    _draw_pairs(bands, series)
    bands.set_title(rf"(a) bands: models, $\nu = {low:g}$ to ${high:g}$; circles: measured")
    bands.set_ylabel(r"tangential restitution $\beta_0$")
    e = settings["contact"]["restitution"]
    contact.axhline(0, **house_style.GUIDE)
    model_lines.draw(contact, tables.select(curves, e=e), X, W)
    contact.set(xlim=settings["incidence"], title=rf"(b) $e = {e:g}$")
    _draw_trials(judged, curves, series.columns)
    entries = [house_style.key(**STYLES[model]) for model in MODELS]
    house_style.legend_below(figure, entries[:3], entries[3:])
    return figure


def _draw_pairs(axes: Axes, series: Scatter) -> None:
    """Draw the measured pairs with their numbers, and name these above them."""
    moved = replace(series, x=side_by_side(series.x))
    names = []
    for row, pair in enumerate(series.columns["pair"]):
        house_style.measured(axes, moved.at([row]), label="_", **CIRCLE)
        place = {"ha": "center", "va": "center_baseline", "fontsize": 8.5, "zorder": 5}
        axes.text(moved.x[row], moved.y[row], f"{row + 1}", **place)
        names.append(house_style.key(f"{row + 1}  {pair}", linestyle="none"))
    low, high = axes.get_ylim()
    axes.set_ylim(low, high + 0.45 * (high - low))
    style = {"handlelength": 0, "handletextpad": 0, "fontsize": house_style.NOTE}
    axes.legend(handles=names, ncols=3, loc="upper center", columnspacing=1.2, **style)


def _draw_trials(axes: Axes, curves: Table, measured: Table) -> None:
    """Chi-squared of each model, a row for each trial, over the largest that agrees.

    A row that several trials share has the least and the largest, and a line between them.
    """
    rows: dict[str, list[Trial]] = {}
    for name, trial in trials(curves).items():
        words = OF_FIT if name.startswith(FIT) else WORDS.get(name, name)
        rows.setdefault(words, []).append(trial)
    for place, model in enumerate(MODELS):
        for row, tried in enumerate(rows.values()):
            fits = [goodness(curves, model, measured, trial) for trial in tried]
            over_limit = [fit.value / chdtri(fit.degrees, SIGNIFICANCE) for fit in fits]
            ends = sorted({min(over_limit), max(over_limit)})
            height = row + MODEL_SPACING * (place - (len(MODELS) - 1) / 2)
            axes.plot(ends, [height] * len(ends), **STYLES[model] | {"linestyle": "-"})
    axes.axvline(1.0, color=house_style.BLACK, linewidth=0.8, linestyle=house_style.DASHES[1])
    for row in range(1, len(rows)):
        axes.axhline(row - 0.5, **house_style.GUIDE)
    axes.set(xscale="log", ylim=(len(rows) - 0.5, -0.5))
    ticks = (0.3, 1, 3, 10, 30)
    axes.set_xticks(ticks, [f"{tick:g}" for tick in ticks])
    axes.xaxis.set_minor_locator(NullLocator())
    axes.set_yticks(range(len(rows)), rows)
    axes.tick_params(axis="y", length=0)
    axes.set_xlabel(rf"$\chi^2$ over its value at $p = {SIGNIFICANCE:g}$")
    axes.set_title("(c) models right of the line differ from the pairs")
