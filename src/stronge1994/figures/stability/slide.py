"""Slide of stability: digits of the lumped model's solution, beside those that are possible."""

from matplotlib.figure import Figure

from stronge1994.csv_tables import Curves
from stronge1994.figures.shared.drawing import house_style, slide
from stronge1994.figures.shared.drawing.house_style import Points, Settings
from stronge1994.figures.stability.drawing import LINES, MOST_DIGITS, OUTPUTS

ALLOWED, DIGITS = "digits_allowed [1]", "digits [1]"
ACROSS = "digits that the condition number allows"
UPRIGHT = "correct digits of the solution, a mark for each answer"


def draw(curves: Curves, settings: Settings, points: Points, ground: slide.Ground) -> Figure:
    """Draw the digits of every output against those that its condition allows."""
    impacts = curves["impacts"]
    worst = max(
        float((impacts[f"digits_allowed_{output} [1]"] - impacts[f"digits_{output} [1]"]).max())
        for output in OUTPUTS
    )
    title = (
        f"The worst answer of {len(impacts[next(iter(impacts))])} impacts has {worst:.1f} digits "
        "fewer than the condition number allows"
    )
    figure, axes = slide.new(title, "solved here, and in multiple precision", ground)
    mark = {"color": ground.blue, "markersize": slide.MARK / 2, "alpha": 0.35, "zorder": 2}
    for output in OUTPUTS:
        table = curves[f"digits of {output}"]
        axes.plot(table[ALLOWED], table[DIGITS], "o", markeredgewidth=0, **mark)
    colours = ground.ink, ground.vermillion
    names = zip(LINES.items(), colours, house_style.DASHES, strict=False)
    for (fewer, text), colour, dashes in names:
        line = curves[text]
        style = {"color": colour, "linestyle": dashes, "linewidth": slide.LINE}
        axes.plot(line[ALLOWED], line[DIGITS], **style)
        offset = (24, -14) if fewer else (-60, 24)
        place = line[ALLOWED], line[DIGITS], 7.0, offset, (colour, ground.paper)
        slide.name_curve(axes, text, *place)
    axes.set(xlim=(-0.4, MOST_DIGITS + 0.4), ylim=(-0.4, MOST_DIGITS + 0.6))
    axes.set(xticks=range(0, MOST_DIGITS + 1, 4), yticks=range(0, MOST_DIGITS + 1, 4))
    slide.name_axes(axes, ACROSS, UPRIGHT, ground)
    return figure
