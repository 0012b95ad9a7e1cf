"""Residuals of a figure as strips, one for each curve and reference. What is allowed is shaded."""

from collections.abc import Collection, Mapping

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from stronge1994.csv_tables import Column, Curves
from stronge1994.figures.shared.drawing import derived, house_style, words
from stronge1994.figures.shared.drawing.derived import ALL, DISTANCE, RMS, RMS_ALLOWED, Strip

# Inches: height of a strip with its title, and of the label of its x axis.
STRIP, LABEL = 0.56, 0.42
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
ALL_AREA = {"color": house_style.PALE, "linewidth": 0, "zorder": 0.5}
RMS_AREA = {"color": house_style.GREEN, "alpha": 0.35, "linewidth": 0, "zorder": 0.6}
RMS_LINE = {"color": house_style.GREEN, "linewidth": 0.9, "linestyle": "-", "zorder": 1.9}


def draw(strips: Mapping[Strip, Curves]) -> Figure:
    """Draw strips of the comparisons of one figure, as `derived.strips` gives them."""
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
        axes.set_title(derived.title(strip), loc="left", pad=3, **note)
        axes.margins(x=0.02, y=0.25)
        axes.tick_params(labelsize=house_style.NOTE, labelbottom=last)
        axes.set_xlabel(words.of_column(strip[2]), visible=last, **note)
        axes.set_ylabel(words.of_column(DISTANCE), visible=False)
    for axes, quantity in zip(rows, axis, strict=True):
        same = [a for a, q in zip(rows, axis, strict=True) if q == quantity]
        axes.set_xlim(min(a.get_xlim()[0] for a in same), max(a.get_xlim()[1] for a in same))
    figure.supylabel(words.of_column(DISTANCE), fontsize=house_style.NOTE + 1)
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
