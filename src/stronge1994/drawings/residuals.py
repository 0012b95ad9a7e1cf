"""Residuals of a figure as strips, one for each curve and reference. What is allowed is shaded."""

from collections import Counter
from collections.abc import Collection, Mapping, Sequence
from typing import Any, TypeAlias

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from planarimpact.ground.arrays import Array
from stronge1994.csv_tables import Row
from stronge1994.drawings import house_style
from stronge1994.drawings.house_style import Style

# Curve, reference and quantity of a strip.
Strip: TypeAlias = tuple[str, str, str]
Bounds: TypeAlias = dict[str, tuple[float, float]]
Entry: TypeAlias = Mapping[str, Any]  # a comparison of the config

# A comparison with more points is left out: it would be a block of ink, and a large file.
MOST_POINTS = 1000
# Inches: height of a strip with its title, and of the label of its x axis.
STRIP, LABEL = 0.56, 0.42
# Units in mathematical letters; others are written as they are.
UNITS = {
    "mu v2(0)": r"$\mu v_2(0)$",
    "v2(0)/Omega": r"$v_2(0)/\Omega$",
    "1/Omega": r"$1/\Omega$",
    "t_c": "$t_c$",
}
MARKS = {
    "agrees": {"color": house_style.BLACK, "marker": "o", "markersize": 2},
    "inconclusive": {
        "color": house_style.BLACK,
        "marker": "o",
        "markersize": 2.4,
        "markerfacecolor": "white",
        "markeredgewidth": 0.7,
    },
    "differs as documented": {
        "color": house_style.BLUE,
        "marker": "s",
        "markersize": 2.4,
        "markerfacecolor": "white",
        "markeredgewidth": 0.7,
    },
    "diverges": {"color": house_style.VERMILLION, "marker": "x", "markersize": 4},
}
ALL_ALLOWED = {"color": house_style.PALE, "linewidth": 0, "zorder": 0.5}
RMS_ALLOWED = {"color": house_style.GREEN, "alpha": 0.35, "linewidth": 0, "zorder": 0.6}
RMS = {"color": house_style.GREEN, "linewidth": 0.9, "linestyle": "-", "zorder": 1.9}


def draw(
    residuals: Sequence[Row], comparisons: Mapping[str, Entry], verdicts: Mapping[str, Row]
) -> Figure | None:
    """Draw strips of the comparisons of one figure that have a residual for each point.

    Parameters
    ----------
    residuals : list of dict
        Rows of results/residuals/FIGURE.csv.
    comparisons : dict
        `{name: entry of the config}`.
    verdicts : dict
        `{name: row of results/verdicts.csv}`.

    Returns
    -------
    Figure or None
        None where there are none to draw.
    """
    strips = _strips(residuals, comparisons)
    if not strips:
        return None
    # Of several strips with the same axis only the last has a label below it.
    axis = [quantity for _, _, quantity in strips]
    labelled = [i + 1 == len(axis) or axis[i + 1] != axis[i] for i in range(len(axis))]
    figure = house_style.new(STRIP * len(strips) + LABEL * sum(labelled) + 0.8)
    rows = figure.subplots(len(strips), squeeze=False)[:, 0]
    for axes, last, ((curve, reference, quantity), parts) in zip(
        rows, labelled, strips.items(), strict=True
    ):
        for name, (x, distance) in parts.items():
            bounds = _bounds(comparisons[name], verdicts[name])
            _draw_comparison(axes, bounds, x, distance, MARKS[verdicts[name]["verdict"]])
        axes.axhline(0, **house_style.GUIDE)
        axes.set_title(f"{curve}  -  {reference}", fontsize=house_style.NOTE, loc="left", pad=3)
        axes.margins(x=0.02, y=0.25)
        axes.tick_params(labelsize=house_style.NOTE, labelbottom=last)
        if last:
            name, _, unit = quantity.rstrip("]").partition(" [")
            end = "" if unit == "1" else f" [{UNITS.get(unit, unit)}]"
            axes.set_xlabel(name.replace("_", " ") + end, fontsize=house_style.NOTE)
    for axes, quantity in zip(rows, axis, strict=True):
        same = [a for a, q in zip(rows, axis, strict=True) if q == quantity]
        axes.set_xlim(min(a.get_xlim()[0] for a in same), max(a.get_xlim()[1] for a in same))
    figure.supylabel(r"distance [$\sigma$]", fontsize=house_style.NOTE + 1)
    shown = {name for parts in strips.values() for name in parts}
    limits = {key for name in shown for key in _bounds(comparisons[name], verdicts[name])}
    _add_legend(figure, {verdicts[name]["verdict"] for name in shown}, limits)
    return figure


def words(quantity: str) -> str:
    """Name of a column for a reader.

    Examples
    --------
    >>> words("rebound_angle [deg]"), words("velocity [mu v2(0)]"), words("time [t_c]")
    ('rebound angle [deg]', 'velocity [µ v2(0)]', 'time [t_c]')
    """
    name, bracket, unit = quantity.partition(" [")
    return name.replace("_", " ") + bracket + unit.replace("mu ", "µ ")


def _strips(
    residuals: Sequence[Row], comparisons: Mapping[str, Entry]
) -> dict[Strip, dict[str, Array]]:
    """Points by strip and comparison. Strips with the same axis follow each other."""
    found: dict[Strip, dict[str, list[tuple[float, float]]]] = {}
    counts = Counter(row["comparison"] for row in residuals)
    for row in residuals:
        entry = comparisons[row["comparison"]]
        if entry["metric"] in ("distance", "vertices") and counts[row["comparison"]] <= MOST_POINTS:
            key = entry.get("curve", "all curves"), entry["reference"], row["quantity"]
            part = found.setdefault(key, {}).setdefault(row["comparison"], [])
            part.append((float(row["at"]), float(row["distance [sigma]"])))
    quantities = list(dict.fromkeys(quantity for _, _, quantity in found))
    return {
        key: {name: np.transpose(points) for name, points in found[key].items()}
        for key in sorted(found, key=lambda key: quantities.index(key[2]))
    }


def _draw_comparison(axes: Axes, bounds: Bounds, x: Array, distance: Array, mark: Style) -> None:
    span = np.array([x.min(), x.max()])
    span = span if span[0] < span[1] else span + [-0.5, 0.5]
    if "max" in bounds:
        axes.fill_between(span, -bounds["max"][1], bounds["max"][1], **ALL_ALLOWED)
    if "rms" in bounds:
        low, high = bounds["rms"]
        rms = np.sqrt(np.mean(distance**2))
        for side in (-1, 1):
            axes.fill_between(span, side * low, side * high, **RMS_ALLOWED)
            axes.plot(span, [side * rms, side * rms], **RMS)
    axes.plot(x, distance, linestyle="none", **mark)


def _bounds(entry: Entry, row: Row) -> Bounds:
    """Bounds of `rms` and `max`. Chi-squared gives none: it judges all points together."""
    known = entry.get("regression", {} if row["p"] else {"max": (0.0, 1.0)})
    return {key: span for key, span in known.items() if key in ("rms", "max")}


def _add_legend(figure: Figure, verdicts: Collection[str], bounds: Collection[str]) -> None:
    points = [
        house_style.key(verdict, linestyle="none", **mark)
        for verdict, mark in MARKS.items()
        if verdict in verdicts
    ]
    if "max" in bounds:
        points.append(Patch(label="allowed for all", **ALL_ALLOWED))
    columns = {"points": points}
    if "rms" in bounds:
        allowed = Patch(label="allowed for it", **RMS_ALLOWED)
        columns["root mean square"] = [house_style.key("of the points", **RMS), allowed]
    house_style.legend_below(figure, *columns.values(), titles=columns)
