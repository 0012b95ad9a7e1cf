"""Residuals of a figure as strips, one for each curve and reference.

A strip shows what a row of the table of verdicts cannot: where points lie far from a curve, and on
which side.
"""

from collections.abc import Mapping, Sequence
from typing import Any, TypeAlias

from matplotlib.figure import Figure

from stronge1994.figures.shared.drawing import house_style
from stronge1994.tables import Row
from stronge1994.verdict_table import Question, Verdict, fails

# Inches: height of a strip with its title, and of the label of its x axis.
STRIP, LABEL = 0.56, 0.42


def _hollow(marker: str, colour: str) -> dict[str, Any]:
    style = {"color": colour, "marker": marker, "markersize": 2.4}
    return style | {"markerfacecolor": "white", "markeredgewidth": 0.7}


# Marks of verdicts. Other verdicts are not drawn: where a curve is right, all points lie within a
# sigma; where sigma is not known, or the curve was fitted to the points, sigmas have no meaning.
MARKS: dict[str, dict[str, Any]] = {
    Verdict.AGREES: {"color": house_style.BLACK, "marker": "o", "markersize": 2},
    Verdict.INCONCLUSIVE: _hollow("o", house_style.BLACK),
    Verdict.EXPLAINED: _hollow("s", house_style.BLUE),
    Verdict.UNEXPLAINED: _hollow("D", house_style.PURPLE),
    **{
        verdict: {"color": house_style.VERMILLION, "marker": "x", "markersize": 4}
        for verdict in Verdict
        if verdict.fails
    },
}
DISTANCE = "distance [sigma]"
# Curve, reference and quantity of a strip; and its points, x and distance, by their verdict.
Strip: TypeAlias = tuple[str, str, str]
Points: TypeAlias = dict[str, list[tuple[float, float]]]


def strips(residuals: Sequence[Row], verdicts: Mapping[str, Row]) -> dict[Strip, Points]:
    """Points of each strip; strips with the same axis follow each other.

    `verdicts` has the rows of the table of verdicts by their comparisons.
    """
    points: dict[Strip, Points] = {}
    for row in residuals:
        judged = verdicts[row["comparison"]]
        # A landmark is one point. Of printed equations the figure draws both curves.
        shows_more = not judged["found"] and judged["question"] != Question.PRINTED
        if judged["verdict"] in MARKS and (shows_more or fails(judged)):
            strip = judged["curve"] or "all curves", judged["reference"], row["quantity"]
            part = points.setdefault(strip, {}).setdefault(judged["verdict"], [])
            part.append((float(row["at"]), float(row[DISTANCE])))
    quantities = list(dict.fromkeys(quantity for _, _, quantity in points))
    return {
        strip: points[strip] for strip in sorted(points, key=lambda one: quantities.index(one[2]))
    }


def draw(strips: Mapping[Strip, Points]) -> Figure:
    """Draw the strips of one figure, as `strips` gives them."""
    # Of several strips with the same axis only the last has a label below it.
    axis = [quantity for _, _, quantity in strips]
    labelled = [i + 1 == len(axis) or axis[i + 1] != axis[i] for i in range(len(axis))]
    figure = house_style.new(STRIP * len(strips) + LABEL * sum(labelled) + 0.8)
    rows = figure.subplots(len(strips), squeeze=False)[:, 0]
    note = {"fontsize": house_style.NOTE}
    for axes, last, (strip, points) in zip(rows, labelled, strips.items(), strict=True):
        for verdict, places in points.items():
            axes.plot(*zip(*places, strict=True), linestyle="none", **MARKS[verdict])
        axes.axhline(0, **house_style.GUIDE)
        axes.set_title(f"{strip[0]}  -  {strip[1]}", loc="left", pad=3, **note)
        axes.margins(x=0.02, y=0.25)
        axes.tick_params(labelsize=house_style.NOTE, labelbottom=last)
        axes.set_xlabel(house_style.of_column(strip[2]), visible=last, **note)
    for axes, quantity in zip(rows, axis, strict=True):
        same = [a for a, q in zip(rows, axis, strict=True) if q == quantity]
        axes.set_xlim(min(a.get_xlim()[0] for a in same), max(a.get_xlim()[1] for a in same))
    figure.supylabel(house_style.of_column(DISTANCE), fontsize=house_style.NOTE + 1)
    drawn = {verdict for points in strips.values() for verdict in points}
    keys = [
        house_style.key(verdict, linestyle="none", **mark)
        for verdict, mark in MARKS.items()
        if verdict in drawn
    ]
    house_style.legend_below(figure, keys)
    return figure
