"""Beyond the paper: five models of loss below e = 1, beside eleven measured pairs of materials."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import NullLocator
from scipy.optimize import linear_sum_assignment
from scipy.special import chdtri

from planarimpact.ground.arrays import Array
from stronge1994 import curve_names
from stronge1994.csv_tables import Columns, Curves
from stronge1994.figures.shared.drawing import house_style
from stronge1994.figures.shared.drawing.house_style import (
    Points,
    Series,
    Settings,
    Style,
)
from stronge1994.figures.shared.drawing.lossy import MODELS, Model
from stronge1994.goodness import ChiSquared, chi_squared

X, W = "incidence [mu v2(0)]", "velocity [mu v2(0)]"
E, BETA_0 = "restitution [1]", "tangential_restitution [1]"
PARAMETERS = f"{curve_names.EACH}pair's parameters"
CHI_SQUARED, OVER_LIMIT = "chi_squared [1]", "chi_squared_over_limit [1]"
# The pairs that decide most: the least elastic one, and the one farthest from all models.
SOFT, HARD = "polyurethane", "chrome steel"
# Distance of points of one restitution, which are drawn side by side.
PAIR_SPACING = 0.0055
# Pairs agree with a model if chance gives their chi-squared with at least this probability.
SIGNIFICANCE = 0.01


def drawn_series(name: str, series: Series) -> Series:
    """Points of nearly the same restitution side by side."""
    return series | {"x": side_by_side(series["x"]), "restitution": series["x"]}


def side_by_side(x: Array) -> Array:
    """Abscissae of points; those of nearly the same are moved apart a little, about their mean.

    >>> side_by_side(np.array([0.9, 0.97, 0.9])).round(3).tolist()
    [0.897, 0.97, 0.903]
    """
    moved, order = x.copy(), np.argsort(x, kind="stable")
    for same in np.split(order, np.flatnonzero(np.diff(x[order]) > PAIR_SPACING) + 1):
        moved[same] = x[same].mean() + PAIR_SPACING * (np.arange(len(same)) - (len(same) - 1) / 2)
    return moved


def drawn_curves(curves: Curves, settings: Settings, points: Points) -> Curves:
    """Chi-squared of each model in each trial."""
    series = points.get(settings["points"])
    if not series:
        return curves
    return curves | {
        f"{model}, {trial.name}": _columns_of(goodness(curves, model, series, trial))
        for model in MODELS
        for trial in trials(curves)
    }


def _columns_of(fit: ChiSquared) -> Columns:
    numbers = {CHI_SQUARED: fit.value, "p [1]": fit.p, OVER_LIMIT: over_limit(fit)}
    return {column: np.array([number]) for column, number in numbers.items()}


class Trial(NamedTuple):
    """One way to judge the pairs.

    `spread` is that of the impacts to which beta_0 is fitted, as the names of the curves spell it.
    The pairs in `without` are left out. All uncertainties are taken as a `share` of those stated.
    """

    name: str
    spread: str = ""
    without: Sequence[str] = ()
    share: float = 1.0


def trials(curves: Curves) -> list[Trial]:
    """The pairs as the verdicts judge them, and with one choice at a time changed.

    It is not known which incidences were measured, nor whether a printed uncertainty is one
    standard deviation or two. No model includes that unlike bodies spread differently under
    pressure.
    """
    start = f"{next(iter(MODELS))}, pairs, "
    names = [name for name in curves if name.startswith(start) and not curve_names.is_shifted(name)]
    spreads = [name.removeprefix(start) for name in names]
    pairs = curves[start.removesuffix(", ")]
    return [
        Trial("as judged"),
        *(Trial(f"fit {spread}", spread) for spread in spreads),
        Trial("the stated sigmas are two sigmas", share=0.5),
        Trial(f"without {SOFT}", without=[SOFT]),
        Trial(f"without {HARD}", without=[HARD]),
        Trial("without both", without=[SOFT, HARD]),
        Trial(
            "pairs of one material alone",
            without=list(pairs["pair"][pairs["body"] != pairs["other"]]),
        ),
    ]


def goodness(curves: Curves, model: str, series: Series, trial: Trial | None = None) -> ChiSquared:
    """Chi-squared of a model over the measured pairs; without a trial, that of the verdicts."""
    trial = trial or Trial("as judged")
    name = f"{model}, pairs" + (f", {trial.spread}" if trial.spread else "")
    sigma = series["sigma"][1] * trial.share
    place = {pair: row for row, pair in enumerate(curves[name]["pair"])}
    pairs = series["columns"]["pair"]
    rows = [place[pair] for pair in pairs]
    up, down = (
        curves[curve_names.shifted(name, PARAMETERS, sign)][BETA_0][rows] for sign in (1, -1)
    )
    distance = (series["y"] - curves[name][BETA_0][rows]) / sigma
    moved = trial.share * (up - down) / 2 / sigma
    kept = ~np.isin(pairs, list(trial.without))
    return chi_squared(distance[kept], np.diag(moved[kept]))


def over_limit(fit: ChiSquared) -> float:
    """Chi-squared over the largest that agrees.

    >>> round(over_limit(chi_squared([3.0, 1.0])), 2)
    1.09
    """
    return float(fit.value / chdtri(fit.degrees, SIGNIFICANCE))


def slope(series: Series, without: Sequence[str] = ()) -> tuple[float, float]:
    """Slope of beta_0 against restitution by weighted least squares, and its standard deviation."""
    kept = ~np.isin(series["columns"]["pair"], list(without))
    e, beta_0, sigma = (np.asarray(a)[kept] for a in (series["x"], series["y"], series["sigma"][1]))
    line: Array = np.stack([np.ones_like(e), e], axis=1) / sigma[:, None]
    covariance = np.linalg.inv(line.T @ line)
    return float((covariance @ line.T @ (beta_0 / sigma))[1]), float(np.sqrt(covariance[1, 1]))


MEASURED = {"color": house_style.BLACK, "marker": "o", "markersize": 3, "markerfacecolor": "white"}
# Height of a label, as a share of the axes.
LABEL_HEIGHT = 0.066
TICKS = (0.3, 1, 3, 10, 30)  # of chi-squared over its limit
# Distance of the models' points in one trial, over the height of its row.
MODEL_SPACING = 0.16
# A point this far from all others has its label beside it; the others have theirs at the right.
ISOLATED = 0.1


def draw(curves: Curves, settings: Settings, points: Points) -> Figure:
    """Draw (a) beta_0 against e, (b) one contact at all incidences, (c) chi-squared by trial."""
    series = points.get(settings["points"])
    figure = house_style.new(9.6 if series else 6.8)
    heights = [3.4, 2.1, 3.5] if series else [3.4, 2.1]
    grid = figure.add_gridspec(len(heights), 1, height_ratios=heights)
    # The names of the pairs stand in the second part.
    top = figure.add_subplot(grid[0].subgridspec(1, 2, width_ratios=[27, 10])[0])
    _draw_bands(top, curves, settings)
    contact = settings["contact"]
    _draw_contact(figure.add_subplot(grid[1]), curves, contact["restitution"])
    keys = [
        house_style.key(model.label, color=model.colour, linestyle=model.dashes)
        for model in MODELS.values()
    ]
    columns = {"(a), (b)": keys}
    if series:
        _draw_pairs(top, series)
        _draw_trials(figure.add_subplot(grid[2]), curves)
        columns["(c)"] = [house_style.key(model.label, **_dot(model)) for model in MODELS.values()]
    low, high = settings["poisson_ratio"]
    top.set_title(rf"(a) bands: $\nu = {low:g}$ to ${high:g}$; circles: measured")
    house_style.legend_below(figure, *columns.values(), titles=columns)
    return figure


def _draw_bands(axes: Axes, curves: Curves, settings: Settings) -> None:
    edges = [curve_names.name("nu", nu) for nu in settings["poisson_ratio"]]
    for place, (name, model) in enumerate(MODELS.items()):
        low, high = (curves[f"{name}, {edge}"] for edge in edges)
        order = np.argsort(low[E])
        e = low[E][order]
        both = low[BETA_0][order], high[BETA_0][order]
        shade = {"color": model.colour, "linewidth": 0, "zorder": 1 + place / 10}
        axes.fill_between(e, *both, alpha=0.13, **shade)
        for beta_0 in both:
            line = {"color": model.colour, "linestyle": model.dashes, "linewidth": 0.9}
            axes.plot(e, beta_0, **line)
    axes.set(xlabel="restitution $e$", ylabel=r"tangential restitution $\beta_0$")
    axes.set_xlim(min(settings["restitution"]), max(settings["restitution"]) + 0.03)


def _draw_pairs(axes: Axes, series: house_style.Series) -> None:
    """Draw the measured pairs with their errors, and their names at the right of the axes."""
    e, beside, beta_0 = series["restitution"], series["x"], series["y"]
    axes.errorbar(
        beside,
        beta_0,
        xerr=series["sigma"][0],
        yerr=series["sigma"][1],
        linestyle="none",
        elinewidth=0.6,
        capsize=1.2,
        markeredgewidth=0.8,
        zorder=3,
        **MEASURED,
    )
    low, high = axes.get_ylim()
    left, right = axes.get_xlim()
    names, gaps = series["columns"]["pair"], np.abs(e[:, None] - e) + np.eye(len(e))
    alone = gaps.min(axis=0) > ISOLATED
    for x, y, name in zip(
        e[alone], (beta_0 + series["sigma"][1])[alone], names[alone], strict=True
    ):
        place = {"ha": "center", "va": "bottom", "fontsize": house_style.NOTE}
        axes.annotate(name, (x, y), (0, 6), textcoords="offset points", **place)
    crowd = beside[~alone], beta_0[~alone]
    heights = spread(crowd[1], LABEL_HEIGHT * (high - low), low, high)
    heights = shortest_leaders(
        (right - crowd[0]) / (right - left), crowd[1] / (high - low), heights / (high - low)
    ) * (high - low)
    for x, y, height, name in zip(*crowd, heights, names[~alone], strict=True):
        bend = right + 0.015 * (right - left)
        axes.plot(
            [x, right - 0.006, bend],
            [y, height, height],
            color=house_style.BLACK,
            linewidth=0.3,
            clip_on=False,
            zorder=2.5,
        )
        text = axes.text(bend, height, f" {name}", fontsize=house_style.NOTE, va="center")
        text.set_in_layout(False)
    axes.set_ylim(low, high)


def spread(y: Array, apart: float, low: float, high: float) -> Array:
    """Heights of labels: near their points, in their order, at least so far apart.

    >>> spread(np.array([1.0, 1.0, 5.0]), 1.0, 0.0, 10.0).tolist()
    [0.5, 1.5, 5.0]
    """
    order = np.argsort(y, kind="stable")
    groups: list[list[float]] = []  # [centre, number] of labels that touch
    for value in y[order]:
        groups.append([float(value), 1])
        while len(groups) > 1 and _end(groups[-2], apart) > _start(groups[-1], apart):
            (first, m), (second, n) = groups[-2:]
            groups[-2:] = [[(first * m + second * n) / (m + n), m + n]]
    heights = np.empty(len(y))
    flat = [
        centre + apart * (i - (count - 1) / 2)
        for centre, count in groups
        for i in range(int(count))
    ]
    heights[order] = flat
    # If the outermost label lies outside, all are moved together.
    heights += max(0.0, low + apart / 2 - heights.min())
    heights -= max(0.0, heights.max() - high + apart / 2)
    return heights


def shortest_leaders(across: Array, y: Array, heights: Array) -> Array:
    """The heights, ordered so that straight leaders are shortest in sum: none crosses another.

    `across` is how far each point at `y` is from the labels.

    >>> shortest_leaders(np.array([9.0, 1.0]), np.array([1.0, 2.0]), np.array([5.0, 6.0])).tolist()
    [6.0, 5.0]
    """
    length = np.hypot(across[:, None], heights - y[:, None])
    return np.asarray(heights[linear_sum_assignment(length)[1]])


def _end(group: list[float], apart: float) -> float:
    return group[0] + group[1] * apart / 2


def _start(group: list[float], apart: float) -> float:
    return group[0] - group[1] * apart / 2


def _draw_contact(axes: Axes, curves: Curves, restitution: float) -> None:
    axes.axhline(0, **house_style.GUIDE)
    for name, model in MODELS.items():
        curve = curves[f"{name}, {curve_names.name('e', restitution)}"]
        axes.plot(curve[X], curve[W], color=model.colour, linestyle=model.dashes, linewidth=1.1)
    axes.set(xlabel=house_style.INCIDENCE, ylabel=house_style.REBOUND)
    axes.set_title(rf"(b) $e = {restitution:g}$")
    axes.set_xlim(curve[X].min(), curve[X].max())


def _draw_trials(axes: Axes, curves: Curves) -> None:
    """Chi-squared of each model, a row for each trial, over the largest that agrees."""
    trial_names = [trial.name for trial in trials(curves)]
    rows = np.arange(len(trial_names))
    for place, (name, model) in enumerate(MODELS.items()):
        beside = rows + MODEL_SPACING * (place - (len(MODELS) - 1) / 2)
        for trial, height in zip(trial_names, beside, strict=True):
            axes.plot(curves[f"{name}, {trial}"][OVER_LIMIT], [height], **_dot(model))
    axes.axvline(1.0, color=house_style.BLACK, linewidth=0.8, linestyle=house_style.DASHES[1])
    for edge in rows[1:] - 0.5:
        axes.axhline(edge, **house_style.GUIDE)
    axes.set(xscale="log", ylim=(rows[-1] + 0.5, -0.5))
    axes.set_xticks(TICKS, [f"{tick:g}" for tick in TICKS])
    axes.xaxis.set_minor_locator(NullLocator())
    axes.set_yticks(rows, trial_names, fontsize=house_style.NOTE)
    axes.tick_params(axis="y", length=0)
    axes.set_xlabel(rf"$\chi^2$ over its value at $p = {SIGNIFICANCE:g}$")
    axes.set_title("(c) what differs from the pairs: right of the line")


def _dot(model: Model) -> Style:
    face = model.colour if model.marker == "o" else "white"
    style = {"color": model.colour, "marker": model.marker, "markerfacecolor": face}
    return style | {"linestyle": "none", "markersize": 3.2, "markeredgewidth": 0.8}
