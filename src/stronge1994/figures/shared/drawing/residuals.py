"""Residuals of a figure as strips, one for each curve and reference; allowed ranges are shaded."""

from collections.abc import Collection, Iterator, Mapping, Sequence
from typing import Any, TypeAlias

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from stronge1994.csv_tables import Column, Columns, Curves, Row
from stronge1994.figures.shared.drawing import house_style

# Inches: height of a strip with its title, and of the label of its x axis.
STRIP, LABEL = 0.56, 0.42


def _hollow(marker: str, colour: str) -> dict[str, Any]:
    style = {"color": colour, "marker": marker, "markersize": 2.4}
    return style | {"markerfacecolor": "white", "markeredgewidth": 0.7}


# Marks of verdicts. Other verdicts are not drawn: where sigma is not known, or the curve was fitted
# to the points, distances in sigmas have no meaning.
MARKS = {
    **dict.fromkeys(
        ("agrees", "right"), {"color": house_style.BLACK, "marker": "o", "markersize": 2}
    ),
    "inconclusive": _hollow("o", house_style.BLACK),
    "explained difference": _hollow("s", house_style.BLUE),
    "unexplained difference": _hollow("D", house_style.PURPLE),
    **dict.fromkeys(
        ("wrong", "diverges"), {"color": house_style.VERMILLION, "marker": "x", "markersize": 4}
    ),
}
ALL_AREA = {"color": house_style.PALE, "linewidth": 0, "zorder": 0.5}
RMS_AREA = {"color": house_style.GREEN, "alpha": 0.35, "linewidth": 0, "zorder": 0.6}
RMS_LINE = {"color": house_style.GREEN, "linewidth": 0.9, "linestyle": "-", "zorder": 1.9}
DISTANCE = "distance [sigma]"
# A comparison with more points is left out: its points would overlap, and the file be large.
MOST_POINTS = 1000
# A comparison that agrees this closely is left out: all its points would lie on the line at zero.
ON_THE_LINE = 0.01  # sigma

Entry: TypeAlias = Mapping[str, Any]  # a comparison of the config
# Curve, reference and quantity of a strip.
Strip: TypeAlias = tuple[str, str, str]
ALL, RMS_ALLOWED, RMS = "allowed for all", "allowed for it", "of the points"


def title(strip: Strip) -> str:
    """Title of a strip."""
    return f"{strip[0]}  -  {strip[1]}"


def strips(
    residuals: Sequence[Row], comparisons: Mapping[str, Entry], verdicts: Mapping[str, Row]
) -> dict[Strip, Curves]:
    """Tables of each strip; strips with the same axis follow each other.

    The points of a comparison are called "COMPARISON, VERDICT". Its allowed range and its root mean
    square are called "COMPARISON, " and one of the constants above: the lower line, then the upper
    one.
    """
    rows_of: dict[str, list[Row]] = {}
    for row in residuals:
        rows_of.setdefault(row["comparison"], []).append(row)
    points_of: dict[Strip, dict[str, list[tuple[float, float]]]] = {}
    for comparison, rows in rows_of.items():
        entry = comparisons[comparison]
        if not _is_drawn(rows, entry, verdicts[comparison]["verdict"]):
            continue
        for row in rows:
            key = entry.get("curve", "all curves"), entry["reference"], row["quantity"]
            part = points_of.setdefault(key, {}).setdefault(comparison, [])
            part.append((float(row["at"]), float(row[DISTANCE])))
    quantities = list(dict.fromkeys(quantity for _, _, quantity in points_of))
    return {
        key: {
            name: table
            for comparison, points in points_of[key].items()
            for name, table in _strip(
                key[2], comparison, points, comparisons[comparison], verdicts[comparison]
            )
        }
        for key in sorted(points_of, key=lambda key: quantities.index(key[2]))
    }


def _is_drawn(rows: Sequence[Row], entry: Entry, verdict: str) -> bool:
    """Whether points of a comparison, drawn, show more than its row in the table of verdicts."""
    if verdict not in MARKS or entry["metric"] not in ("distance", "vertices"):
        return False
    if entry.get("as_printed"):  # the figure draws both curves
        return False
    largest = max(abs(float(row[DISTANCE])) for row in rows)
    return len(rows) <= MOST_POINTS and (
        verdict not in ("agrees", "right") or largest >= ON_THE_LINE
    )


def _strip(
    quantity: str, name: str, points: Sequence[tuple[float, float]], entry: Entry, row: Row
) -> Iterator[tuple[str, Columns]]:
    x, distance = np.transpose(points)
    span = np.array([x.min(), x.max()])
    span = span if span[0] < span[1] else span + [-0.5, 0.5]

    def lines(*heights: float) -> Columns:
        return {quantity: np.tile(span, len(heights)), DISTANCE: np.repeat(heights, 2)}

    yield f"{name}, {row['verdict']}", {quantity: x, DISTANCE: distance}
    # Chi-squared gives no bounds: it judges all points together.
    bounds = entry.get("regression", {} if row["p"] else {"max": (0.0, 1.0)})
    if "max" in bounds:
        yield f"{name}, {ALL}", lines(-bounds["max"][1], bounds["max"][1])
    if "rms" in bounds:
        low, high = bounds["rms"]
        rms = float(np.sqrt(np.mean(distance**2)))
        yield f"{name}, {RMS_ALLOWED}", lines(-low, -high, low, high)
        yield f"{name}, {RMS}", lines(-rms, rms)


def tables_of_strips(strips: Mapping[Strip, Curves]) -> Curves:
    """All tables of all strips, each with the title of its strip before its name."""
    return {
        f"{title(strip)}: {name}": table
        for strip, parts in strips.items()
        for name, table in parts.items()
    }


def draw(strips: Mapping[Strip, Curves]) -> Figure:
    """Draw strips of the comparisons of one figure, as `strips` gives them."""
    # Of several strips with the same axis only the last has a label below it.
    axis = [quantity for _, _, quantity in strips]
    labelled = [i + 1 == len(axis) or axis[i + 1] != axis[i] for i in range(len(axis))]
    figure = house_style.new(STRIP * len(strips) + LABEL * sum(labelled) + 0.8)
    rows = figure.subplots(len(strips), squeeze=False)[:, 0]
    note = {"fontsize": house_style.NOTE}
    for axes, last, (strip, tables) in zip(rows, labelled, strips.items(), strict=True):
        for name, table in tables.items():
            _draw_table(axes, name.rpartition(", ")[2], table[strip[2]], table[DISTANCE])
        axes.axhline(0, **house_style.GUIDE)
        axes.set_title(title(strip), loc="left", pad=3, **note)
        axes.margins(x=0.02, y=0.25)
        axes.tick_params(labelsize=house_style.NOTE, labelbottom=last)
        axes.set_xlabel(house_style.of_column(strip[2]), visible=last, **note)
        axes.set_ylabel(house_style.of_column(DISTANCE), visible=False)
    for axes, quantity in zip(rows, axis, strict=True):
        same = [a for a, q in zip(rows, axis, strict=True) if q == quantity]
        axes.set_xlim(min(a.get_xlim()[0] for a in same), max(a.get_xlim()[1] for a in same))
    figure.supylabel(house_style.of_column(DISTANCE), fontsize=house_style.NOTE + 1)
    _add_legend(figure, {name.rpartition(", ")[2] for part in strips.values() for name in part})
    return figure


def _draw_table(axes: Axes, kind: str, x: Column, y: Column) -> None:
    """Draw points, or lines that follow each other or bound areas."""
    if kind in MARKS:
        axes.plot(x, y, linestyle="none", **MARKS[kind])
        return
    for i in range(0, len(x), 4):
        if kind == RMS:
            axes.plot(x[i : i + 2], y[i : i + 2], **RMS_LINE)
            axes.plot(x[i + 2 : i + 4], y[i + 2 : i + 4], **RMS_LINE)
        else:
            shade = ALL_AREA if kind == ALL else RMS_AREA
            axes.fill_between(x[i : i + 2], y[i : i + 2], y[i + 2 : i + 4], **shade)


def _add_legend(figure: Figure, kinds: Collection[str]) -> None:
    points = [
        house_style.key(verdict, linestyle="none", **mark)
        for verdict, mark in MARKS.items()
        if verdict in kinds
    ]
    if ALL in kinds:
        points.append(Patch(label=ALL, **ALL_AREA))
    columns = {"points": points}
    if RMS in kinds:
        allowed = Patch(label=RMS_ALLOWED, **RMS_AREA)
        columns["root mean square"] = [house_style.key(RMS, **RMS_LINE), allowed]
    house_style.legend_below(figure, *columns.values(), titles=columns)
