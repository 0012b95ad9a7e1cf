"""Beyond the paper: five models of loss below e = 1, beside eleven measured pairs of materials."""

from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from planarimpact.ground.arrays import Array
from stronge1994 import curve_names
from stronge1994.csv_tables import Curves
from stronge1994.figures.shared.drawing import house_style
from stronge1994.figures.shared.drawing.house_style import Dashes, Points, Series, Settings
from stronge1994.goodness import ChiSquared, chi_squared

X, W = "incidence [mu v2(0)]", "velocity [mu v2(0)]"
E, BETA_0 = "restitution [1]", "tangential_restitution [1]"
PARAMETERS = "each pair's parameters"
CHI_SQUARED = "chi_squared [1]"
# Points of one restitution are drawn side by side, so far apart.
APART = 0.0055
# What words of the picture mean, see `shared.drawing.words`.
AXIS_MEANS = {
    r"tangential restitution $\beta_0$": r": tangential_restitution \[1\]",
    r"$\chi^2$ of pairs": r": chi_squared \[1\]",
}


def shown_series(name: str, series: Series) -> Series:
    """Points of nearly the same restitution side by side."""
    return series | {"x": side_by_side(series["x"]), "restitution": series["x"]}


def side_by_side(x: Array) -> Array:
    """Abscissae of points; those of nearly the same are moved apart a little, about their mean.

    >>> side_by_side(np.array([0.9, 0.97, 0.9])).round(3).tolist()
    [0.897, 0.97, 0.903]
    """
    moved, order = x.copy(), np.argsort(x, kind="stable")
    for same in np.split(order, np.flatnonzero(np.diff(x[order]) > APART) + 1):
        moved[same] = x[same].mean() + APART * (np.arange(len(same)) - (len(same) - 1) / 2)
    return moved


def shown(curves: Curves, settings: Settings, points: Points) -> Curves:
    """Chi-squared of each model."""
    series = points.get(settings["points"])
    models = [name.removesuffix(", pairs") for name in curves if name.endswith(", pairs")]
    fits = {model: goodness(curves, model, series) for model in models} if series else {}
    return curves | {
        f"chi-squared of {model}": {CHI_SQUARED: np.array([fit.value]), "p [1]": np.array([fit.p])}
        for model, fit in fits.items()
    }


def goodness(curves: Curves, model: str, series: Series) -> ChiSquared:
    """Chi-squared of a model over the measured pairs, with the uncertainty of their parameters.

    It is that of the verdicts.
    """
    name, sigma = f"{model}, pairs", series["sigma"][1]
    place = {pair: row for row, pair in enumerate(curves[name]["pair"])}
    rows = [place[pair] for pair in series["columns"]["pair"]]
    up, down = (
        curves[curve_names.shifted(name, PARAMETERS, sign)][BETA_0][rows] for sign in (1, -1)
    )
    distance = (series["y"] - curves[name][BETA_0][rows]) / sigma
    return chi_squared(distance, np.diag((up - down) / 2 / sigma))


class Model(NamedTuple):
    """How a model is drawn, and what it is called."""

    words: str
    colour: str
    dashes: Dashes
    hatch: str


# A colour for each cause of loss: black for the normal element of the paper, vermillion for plastic
# flow, blue for viscosity.
MODELS = {
    name: Model(words, colour, dashes, hatch)
    for (name, words, colour, hatch), dashes in house_style.patterned(
        (
            ("lumped", "lumped, as in the paper", house_style.BLACK, ""),
            ("lumped.plastic", "lumped, repaired", house_style.VERMILLION, "xxxxx"),
            ("lumped.viscous", "lumped, Kelvin–Voigt", house_style.BLUE, "\\\\\\\\\\"),
            ("continuum.plastic", "continuum, elastic-plastic", house_style.VERMILLION, "-----"),
            ("continuum.viscous", "continuum, viscoelastic", house_style.BLUE, "/////"),
        )
    )
}
MEASURED = {"color": house_style.BLACK, "marker": "o", "markersize": 3, "markerfacecolor": "white"}
# Left end of the axis of chi-squared.
LEAST = 3.0
# Height of a label, as a share of the axes.
LINE = 0.062
# A point so far from all others has its label beside it; the others have theirs at the right.
ALONE = 0.1


def draw(curves: Curves, settings: Settings, points: Points) -> Figure:
    """Draw (a) beta_0 against e, (b) one contact at all incidences, (c) chi-squared."""
    figure = house_style.new(6.8)
    grid = figure.add_gridspec(2, 2, height_ratios=[4, 2.6], width_ratios=[5, 4])
    # The names of the pairs stand in the second part.
    top = figure.add_subplot(grid[0, :].subgridspec(1, 2, width_ratios=[27, 10])[0])
    _draw_bands(top, curves, settings)
    series = points.get(settings["points"])
    if series:
        _draw_pairs(top, series)
    contact = settings["contact"]
    _draw_contact(figure.add_subplot(grid[1, 0]), curves, contact["restitution"])
    if series:
        _draw_chi_squared(figure.add_subplot(grid[1, 1]), curves, len(series["x"]))
    low, high = settings["poisson_ratio"]
    top.set_title(rf"(a) bands: $\nu = {low:g}$ to ${high:g}$; circles: measured")
    keys = [
        house_style.key(model.words, color=model.colour, linestyle=model.dashes)
        for model in MODELS.values()
    ]
    house_style.legend_below(figure, keys[:3], keys[3:])
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
    alone = gaps.min(axis=0) > ALONE
    for x, y, name in zip(
        e[alone], (beta_0 + series["sigma"][1])[alone], names[alone], strict=True
    ):
        place = {"ha": "center", "va": "bottom", "fontsize": house_style.NOTE}
        axes.annotate(name, (x, y), (0, 6), textcoords="offset points", **place)
    crowd = beside[~alone], beta_0[~alone]
    heights = spread(crowd[1], LINE * (high - low), low, high)
    for x, y, height, name in zip(*crowd, heights, names[~alone], strict=True):
        bend = right + 0.015 * (right - left)
        axes.plot(
            [x, right - 0.006, bend],
            [y, height, height],
            color=house_style.BLACK,
            linewidth=0.3,
            clip_on=False,
            zorder=2.5,
            label=house_style.NO_DATA,
        )
        words = axes.text(bend, height, f" {name}", fontsize=house_style.NOTE, va="center")
        words.set_in_layout(False)
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
    # What sticks out is moved inside as a whole.
    heights += max(0.0, low + apart / 2 - heights.min())
    heights -= max(0.0, heights.max() - high + apart / 2)
    return heights


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


def _draw_chi_squared(axes: Axes, curves: Curves, degrees: int) -> None:
    tables = {name: curves[f"chi-squared of {name}"] for name in MODELS}
    found = {name: (fit[CHI_SQUARED][0], fit["p [1]"][0]) for name, fit in tables.items()}
    largest = max(value for value, _ in found.values())
    note = {"fontsize": house_style.NOTE, "va": "center"}
    for row, (name, (value, p)) in enumerate(found.items()):
        model = MODELS[name]
        style = {"facecolor": "white", "edgecolor": model.colour, "hatch": model.hatch}
        axes.barh(row, value, height=0.42, linewidth=1.0, **style)
        axes.text(degrees * 1.15, row - 0.42, model.words, **note)
        axes.text(value * 1.15, row, words_of(p), **note)
    axes.axvline(degrees, color=house_style.BLACK, linewidth=0.7, linestyle=house_style.DASHES[1])
    axes.set(xscale="log", xlim=(LEAST, largest * 50), yticks=[], ylim=(len(found) - 0.6, -0.75))
    axes.set_xlabel(rf"$\chi^2$ of {degrees} pairs")
    axes.set_title("(c) models against pairs")


def words_of(p: float) -> str:
    """Probability in a few letters.

    >>> print(words_of(0.224), words_of(3.6e-26))
    $p = 0.22$ $p = 4 \\times 10^{-26}$
    """
    if p >= 1e-3:
        return f"$p = {p:.2g}$"
    digit, power = f"{p:.0e}".split("e")
    return rf"$p = {digit} \times 10^{{{int(power)}}}$"
