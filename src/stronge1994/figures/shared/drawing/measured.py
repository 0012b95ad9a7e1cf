"""Models beside measured series: a panel for each series that the figure compares."""

from matplotlib.figure import Figure

from stronge1994 import curve_names
from stronge1994.csv_tables import Curves
from stronge1994.figures.shared.drawing import house_style
from stronge1994.figures.shared.drawing.beside import POINT
from stronge1994.figures.shared.drawing.house_style import (
    COLOURS,
    DASHES,
    Entries,
    Points,
    Settings,
)


def draw(curves: Curves, settings: Settings, points: Points) -> Figure:
    """Draw every series of `points` with the models; the legend has the names of both."""
    figure = house_style.new(1.2 + 2.4 * len(points))
    panels = figure.subplots(len(points), squeeze=False)[:, 0]
    models = [name for name in curves if not curve_names.is_shifted(name)]
    entries: Entries = []
    for axes, (series_name, series) in zip(panels, points.items(), strict=True):
        label = f"{series_name}: measured"
        entries.append(house_style.measured(axes, series, label=label, **POINT))
        low, high = axes.get_xlim()
        lines, (x, y) = [], series["axes"]
        for place, name in enumerate(models):
            if missing := {x, y} - curves[name].keys():
                known = ", ".join(curves[name])
                raise ValueError(f"no column {min(missing)!a}; the curves have {known}")
            # Each time that the colours are through, the patterns are one further on.
            pattern = DASHES[(place + place // len(COLOURS)) % len(DASHES)]
            style = {"color": COLOURS[place % len(COLOURS)], "linestyle": pattern}
            inside = (curves[name][x] >= low) & (curves[name][x] <= high)
            lines.append(house_style.line(axes, curves, name, x, y, inside, **style))
        axes.set_xlim(low, high)
    house_style.legend_below(figure, entries, lines)
    return figure
