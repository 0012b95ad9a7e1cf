"""Residuals of a figure as strips, one for each curve and reference.

A strip shows what a row of the table of verdicts cannot: where points lie far from a curve, and on
which side.
"""

from collections.abc import Sequence
from typing import Any

import pandas as pd
from matplotlib.figure import Figure

from stronge1994.figures.shared.drawing import house_style
from stronge1994.tables import Row, Table
from stronge1994.verdict_table import COLUMNS, Group, Verdict, Why, outcome

# Inches: height of a strip with its title, and of the label of its x axis.
STRIP, LABEL = 0.56, 0.42


def _hollow(marker: str, colour: str) -> dict[str, Any]:
    style = {"color": colour, "marker": marker, "markersize": 2.4}
    return style | {"markerfacecolor": "white", "markeredgewidth": 0.7}


# Marks of outcomes. Others are not drawn: where a check passed, all points lie within a sigma, and
# where their scatter is not published, sigmas have no meaning.
MARKS: dict[str, dict[str, Any]] = {
    Verdict.AGREES: {"color": house_style.BLACK, "marker": "o", "markersize": 2},
    Verdict.CANNOT_TELL: _hollow("o", house_style.BLACK),
    f"{Verdict.DIFFERS}, {Why.KNOWN}": _hollow("s", house_style.BLUE),
    f"{Verdict.DIFFERS}, {Why.UNKNOWN}": _hollow("D", house_style.PURPLE),
    Verdict.FAILS: {"color": house_style.VERMILLION, "marker": "x", "markersize": 4},
}
DISTANCE = "distance [sigma]"


def strips(residuals: Table, verdicts: Sequence[Row]) -> list[Table]:
    """Points of each strip, with their verdict; strips with the same axis follow each other.

    `verdicts` has the rows of the table of verdicts for the comparisons of `residuals`.
    """
    judged = pd.DataFrame(verdicts, columns=COLUMNS).assign(outcome=list(map(outcome, verdicts)))
    every = residuals.merge(judged, on="comparison")
    # A landmark is one point. Of printed equations the figure draws both curves.
    shows_more = (every["found"] == "") & (every["group"] != Group.PAPER)
    shown = every[every["outcome"].isin(MARKS) & (shows_more | (every["verdict"] == Verdict.FAILS))]
    return [
        strip
        for _, of_axis in shown.groupby("quantity", sort=False)
        for _, strip in of_axis.groupby(["curve", "reference"], sort=False)
    ]


def draw(strips: Sequence[Table]) -> Figure:
    """Draw the strips of one figure, as `strips` gives them."""
    # Of several strips with the same axis only the last has a label below it.
    axis = [strip["quantity"].iloc[0] for strip in strips]
    labelled = [i + 1 == len(axis) or axis[i + 1] != axis[i] for i in range(len(axis))]
    figure = house_style.new(STRIP * len(strips) + LABEL * sum(labelled) + 0.8)
    rows = figure.subplots(len(strips), squeeze=False)[:, 0]
    note = {"fontsize": house_style.NOTE}
    for axes, last, strip, quantity in zip(rows, labelled, strips, axis, strict=True):
        for name, points in strip.groupby("outcome", sort=False):
            axes.plot(points["at"], points[DISTANCE], linestyle="none", **MARKS[name])
        axes.axhline(0, **house_style.GUIDE)
        curve, reference = strip[["curve", "reference"]].iloc[0]
        axes.set_title(f"{curve or 'all curves'}  -  {reference}", loc="left", pad=3, **note)
        axes.margins(x=0.02, y=0.25)
        axes.tick_params(labelsize=house_style.NOTE, labelbottom=last)
        axes.set_xlabel(house_style.of_column(quantity), visible=last, **note)
    for axes, quantity in zip(rows, axis, strict=True):
        same = [a for a, q in zip(rows, axis, strict=True) if q == quantity]
        axes.set_xlim(min(a.get_xlim()[0] for a in same), max(a.get_xlim()[1] for a in same))
    figure.supylabel(house_style.of_column(DISTANCE), fontsize=house_style.NOTE + 1)
    drawn = {name for strip in strips for name in strip["outcome"]}
    marks = [(name, mark) for name, mark in MARKS.items() if name in drawn]
    keys = [house_style.key(name, linestyle="none", **mark) for name, mark in marks]
    house_style.legend_below(figure, keys)
    return figure
