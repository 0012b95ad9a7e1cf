"""Models and measured series: a panel for each series that the figure compares."""

from matplotlib.figure import Figure

from stronge1994 import tables
from stronge1994.figures.shared.drawing import house_style
from stronge1994.figures.shared.drawing.house_style import (
    COLOURS,
    DASHES,
    Entries,
    Points,
    Settings,
)
from stronge1994.figures.shared.drawing.model_lines import POINT
from stronge1994.tables import Table


def draw(curves: Table, settings: Settings, points: Points) -> Figure:
    """Draw every series of `points` with the models; the legend has the names of both."""
    figure = house_style.new(1.2 + 2.4 * len(points))
    panels = figure.subplots(len(points), squeeze=False)[:, 0]
    entries: Entries = []
    for axes, (series_name, series) in zip(panels, points.items(), strict=True):
        label = f"{series.legend or series_name}: measured"
        entries.append(house_style.measured(axes, series, label=label, **POINT))
        low, high = axes.get_xlim()
        lines, (x, y) = [], series.axes
        if missing := {x, y} - {*curves}:
            raise ValueError(f"no column {min(missing)!a}; the curves have {', '.join(curves)}")
        for place, (_, curve) in enumerate(tables.each(curves, "curve")):
            # Each time that the colours are through, the patterns are one further on.
            pattern = DASHES[(place + place // len(COLOURS)) % len(DASHES)]
            style = {"color": COLOURS[place % len(COLOURS)], "linestyle": pattern}
            inside = curve[x].between(low, high)
            lines.append(house_style.line(axes, curve, x, y, inside, **style))
        axes.set_xlim(low, high)
    house_style.legend_below(figure, entries, lines)
    return figure
