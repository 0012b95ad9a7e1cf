"""Models beside measured series: a panel for each series that the figure compares."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from planarimpact.ground.arrays import Array
from stronge1994 import curve_names
from stronge1994.csv_tables import Curves
from stronge1994.figures.shared.drawing import house_style
from stronge1994.figures.shared.drawing.house_style import (
    COLOURS,
    DASHES,
    Entries,
    Points,
    Series,
    Settings,
    Style,
)

MEASURED: Style = {"color": house_style.BLACK, "marker": "o", "markerfacecolor": "white"}
# Share of the span of the points that is left empty around them.
MARGIN = 0.08


def draw(curves: Curves, settings: Settings, points: Points) -> Figure:
    """Draw every series of `points` with the models; the legend has the names of both."""
    figure = house_style.new(1.2 + 2.4 * len(points))
    panels = figure.subplots(len(points), squeeze=False)[:, 0]
    models = [name for name in curves if not curve_names.is_shifted(name)]
    entries: Entries = []
    for panel, (name, series) in zip(panels, points.items(), strict=True):
        lines = _draw_models(panel, {model: curves[model] for model in models}, series)
        style = MEASURED | {"label": f"{name}: measured"}
        entries = [*entries, house_style.measured(panel, series, **style)]
    house_style.legend_below(figure, entries, lines)
    return figure


def _draw_models(axes: Axes, curves: Curves, series: Series) -> Entries:
    """Draw the models over the span of a series, and return entries of the legend."""
    x, y = series["axes"]
    axes.set(xlabel=house_style.of_column(x), ylabel=house_style.of_column(y))
    low, high = _span(series["x"], series["sigma"][0])
    lines, heights = [], [*_span(series["y"], series["sigma"][1])]
    for place, (name, curve) in enumerate(curves.items()):
        if missing := {x, y} - curve.keys():
            raise ValueError(f"no column '{min(missing)}'; the curves have {', '.join(curve)}")
        # Each time that the colours are through, the patterns are one further on.
        pattern = DASHES[(place + place // len(COLOURS)) % len(DASHES)]
        style = {"color": COLOURS[place % len(COLOURS)], "linestyle": pattern, "linewidth": 1.1}
        inside = (curve[x] >= low) & (curve[x] <= high)
        lines += axes.plot(curve[x][inside], curve[y][inside], label=name, **style)
        heights += [*curve[y][inside]]
    axes.set(xlim=(low, high), ylim=_span(np.array(heights), 0.0))
    return lines


def _span(values: Array, sigma: Array | float) -> tuple[float, float]:
    """From the lowest value, less its sigma, to the highest, with a margin."""
    low, high = float((values - sigma).min()), float((values + sigma).max())
    margin = MARGIN * (high - low)
    return low - margin, high + margin
