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
from stronge1994.figures.shared.drawing.house_style import Entries, Points, Scatter, Settings
from stronge1994.figures.shared.drawing.model_lines import POINT, STYLES
from stronge1994.names import MODELS
from stronge1994.studies.inelastic.trials import BETA_0, SIGNIFICANCE, E, goodness, trials
from stronge1994.tables import Table

X, W = "incidence [mu v2(0)]", "velocity [mu v2(0)]"
# Distance of points of one restitution, which are drawn side by side.
PAIR_SPACING = 0.0055
# Distance of the models' marks in one trial, over the height of its row.
MODEL_SPACING = 0.16


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
    figure = house_style.new(9.9)
    grid = figure.add_gridspec(3, height_ratios=[3.4, 2.1, 3.6])
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
    pairs = _draw_pairs(bands, series)
    bands.set_title(rf"(a) $\beta_0$, bands: $\nu = {low:g}$ to ${high:g}$; circles: measured")
    e = settings["contact"]["restitution"]
    contact.axhline(0, **house_style.GUIDE)
    model_lines.draw(contact, tables.select(curves, e=e), X, W)
    contact.set(xlim=settings["incidence"], title=rf"(b) $e = {e:g}$")
    _draw_trials(judged, curves, series.columns)
    entries = [*(house_style.key(**STYLES[model]) for model in MODELS), *pairs]
    house_style.legend_below(figure, entries[: len(entries) // 2], entries[len(entries) // 2 :])
    return figure


def _draw_pairs(axes: Axes, series: Scatter) -> Entries:
    """Draw the measured pairs with their numbers, and return the entries of the legend."""
    moved = replace(series, x=side_by_side(series.x))
    entries = []
    for row, pair in enumerate(series.columns["pair"]):
        one = moved.at([row])
        entries.append(house_style.measured(axes, one, label=f"{row + 1}  {pair}", **POINT))
        place = {"textcoords": "offset points", "fontsize": house_style.NOTE}
        axes.annotate(f"{row + 1}", (moved.x[row], moved.y[row]), (3, 2), **place)
    return entries


def _draw_trials(axes: Axes, curves: Table, measured: Table) -> None:
    """Chi-squared of each model, a row for each trial, over the largest that agrees."""
    names = trials(curves)
    for place, model in enumerate(MODELS):
        fits = [goodness(curves, model, measured, trial) for trial in names.values()]
        over_limit = [fit.value / chdtri(fit.degrees, SIGNIFICANCE) for fit in fits]
        rows = np.arange(len(fits)) + MODEL_SPACING * (place - (len(MODELS) - 1) / 2)
        axes.plot(over_limit, rows, **STYLES[model] | {"linestyle": "none"})
    axes.axvline(1.0, color=house_style.BLACK, linewidth=0.8, linestyle=house_style.DASHES[1])
    for row in range(1, len(names)):
        axes.axhline(row - 0.5, **house_style.GUIDE)
    axes.set(xscale="log", ylim=(len(names) - 0.5, -0.5))
    ticks = (0.3, 1, 3, 10, 30)
    axes.set_xticks(ticks, [f"{tick:g}" for tick in ticks])
    axes.xaxis.set_minor_locator(NullLocator())
    axes.set_yticks(range(len(names)), names, fontsize=house_style.NOTE)
    axes.tick_params(axis="y", length=0)
    axes.set_xlabel(rf"$\chi^2$ over its value at $p = {SIGNIFICANCE:g}$")
    axes.set_title("(c) what differs from the pairs: right of the line")
