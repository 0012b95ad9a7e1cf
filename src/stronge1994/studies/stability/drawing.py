"""Beyond the paper: digits of the lumped model's solution, beside those that are possible."""

import numpy as np
from matplotlib import colormaps
from matplotlib.colors import ListedColormap, LogNorm
from matplotlib.figure import Figure

from stronge1994 import tables
from stronge1994.figures.shared.drawing import house_style
from stronge1994.figures.shared.drawing.house_style import Points, Settings
from stronge1994.tables import Table

OUTPUTS = {
    "velocity": "velocity",
    "peak_friction": "peak friction",
    "dissipation": "dissipation",
}
OMEGA = "omega [Omega]"
# Thousands of outputs are counted in cells, since their marks would cover each other. The palest
# colour is still seen: a single output counts.
DENSITY = ListedColormap(colormaps["Blues"](np.linspace(0.3, 1, 64)))
CELLS = 34
# Digits fewer than allowed; see the comparison `stability-digits` for the second.
LINES = {"as many as allowed": (0, "-"), "2 digits fewer": (2, house_style.DASHES[1])}
DIGITS = range(0, 17, 4)


def draw(curves: Table, settings: Settings, points: Points) -> Figure:
    """Draw digits found (a) to (c) against the ratio of frequencies, (d) to (f) against allowed."""
    impacts = tables.select(curves, variant="impacts")
    figure = house_style.new(5.8)
    panels = figure.subplots(2, len(OUTPUTS), sharey=True)
    columns = zip(panels.T, "abc", "def", OUTPUTS.items(), strict=True)
    decades = np.log10(impacts[OMEGA])
    across = np.linspace(np.floor(decades.min()), np.ceil(decades.max()), CELLS + 1)
    digits = np.linspace(-0.25, 16.25, CELLS + 1)
    scale = LogNorm(1, len(impacts))
    for (above, below), first, second, (name, title) in columns:
        found, allowed = f"digits_{name} [1]", f"digits_allowed_{name} [1]"
        for axes, x, edges in ((above, decades, across), (below, impacts[allowed], digits)):
            counts, *_ = np.histogram2d(x, impacts[found], (edges, digits))
            cells = np.ma.masked_equal(counts.T, 0)
            places = 10**edges if axes is above else edges
            area = axes.pcolormesh(places, digits, cells, norm=scale, cmap=DENSITY, rasterized=True)
            axes.set(ylim=(-0.8, 16.8), yticks=DIGITS)
        for label, (fewer, dashes) in LINES.items():
            style = {"color": house_style.BLACK, "linewidth": 0.7, "linestyle": dashes, "zorder": 3}
            below.axline((0, -fewer), slope=1, label=label, **style)
        above.set(xscale="log", xlabel=r"$\omega/\Omega$", title=f"({first}) {title}")
        above.set_xticks(10.0 ** np.array([-5, 0, 4]), ["$10^{-5}$", "1", "$10^4$"])
        below.set(xlim=(-0.8, 16.8), xticks=DIGITS, xlabel="digits allowed")
        below.set_title(f"({second}) {title}")
    for axes in panels[:, 0]:
        axes.set_ylabel("digits found")
    figure.colorbar(area, ax=panels, orientation="horizontal", aspect=40, label="outputs in a cell")
    house_style.legend_below(figure, *([entry] for entry in below.lines))
    return figure
