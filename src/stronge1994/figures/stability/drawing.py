"""Beyond the paper: digits of the lumped model's solution, beside those that are possible."""

import matplotlib
import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import QuadMesh
from matplotlib.colors import BoundaryNorm
from matplotlib.figure import Figure

from planarimpact.ground.arrays import Array
from stronge1994.csv_tables import Columns, Curves
from stronge1994.figures.shared.drawing import house_style
from stronge1994.figures.shared.drawing.house_style import Points, Settings, Style

OUTPUTS = {
    "velocity": "velocity",
    "peak_friction": "peak friction",
    "dissipation": "dissipation",
}
MARK: Style = {"linestyle": "none", "marker": "o", "markersize": 1.8, "markeredgewidth": 0.4}
MARK |= {"color": house_style.BLUE, "markerfacecolor": "none", "label": "output of an impact"}
COLOURS = matplotlib.colormaps["cividis"]
OMEGA = "omega [Omega]"
KINDS = {"digits": "correct digits found", "digits_allowed": "allowed by the condition"}
LEVELS = np.arange(0, 17, 2)
# Digits fewer than allowed; see the comparison `stability-digits` for the second.
LINES = {"as many as allowed": (0, "-"), "2 digits fewer": (2, house_style.DASHES[1])}
# Lower edges of the cells, each with its label. The first cell has none: it holds all below.
OMEGAS = {10.0**k: f"$10^{{{k}}}$" if k % 3 == 0 else "" for k in range(-5, 7)}
RESTITUTIONS = {5e-324: "", 1e-16: "$10^{-16}$", 1e-8: "$10^{-8}$", 1e-4: "$10^{-4}$"}
RESTITUTIONS |= {0.01: "0.01", 0.1: "0.1", 0.5: "0.5", 1.0: "1"}
INCIDENCES = {5e-324: ""}
INCIDENCES |= {10.0**k: f"$10^{{{k}}}$" for k in (-16, -8, -4, -2, 0, 2, 4, 8)}
UPRIGHT = {"restitution [1]": RESTITUTIONS, "incidence [mu v2(0)]": INCIDENCES}


def draw(curves: Curves, settings: Settings, points: Points) -> Figure:
    """Draw (a) to (d) digits in cells of the parameters, (e) on digits found against allowed."""
    impacts = curves["impacts"]
    figure = house_style.new(7.2)
    grid = figure.add_gridspec(2, 1, height_ratios=[21, 9])
    maps = grid[0].subgridspec(2, 2).subplots(sharex=True, sharey="row")
    for row, (name, edges) in enumerate(UPRIGHT.items()):
        for axes, (kind, title) in zip(maps[row], KINDS.items(), strict=True):
            digits = np.min([impacts[f"{kind}_{output} [1]"] for output in OUTPUTS], axis=0)
            mesh = _draw_map(axes, impacts, name, list(edges), digits)
            axes.set_yticks(range(1, len(edges) + 1), edges.values())
            axes.set(xlabel=r"$\omega/\Omega$", ylabel=house_style.of_column(name))
            axes.set_title(f"({'abcd'[2 * row + (axes is maps[row][1])]}) {title}")
            axes.label_outer()
    bar = figure.colorbar(mesh, ax=maps, ticks=LEVELS, aspect=40, pad=0.02)
    bar.set_label("digits of the worst output, median of a cell")
    panels = grid[1].subgridspec(1, len(OUTPUTS)).subplots(sharey=True)
    for axes, letter, (name, title) in zip(panels, "efg", OUTPUTS.items(), strict=True):
        columns = f"digits_allowed_{name} [1]", f"digits_{name} [1]"
        # As pixels inside the SVG: thousands of marks would be too many shapes.
        house_style.line(axes, curves, "impacts", *columns, rasterized=True, **MARK)
        for label, (fewer, dashes) in LINES.items():
            style = {"color": house_style.BLACK, "linewidth": 0.7, "linestyle": dashes, "zorder": 3}
            axes.axline((0, -fewer), slope=1, label=label, **style)
        axes.set(xlim=(-0.8, 16.8), ylim=(-0.8, 16.8), xticks=LEVELS[::2], yticks=LEVELS[::2])
        axes.set(xlabel="digits allowed", ylabel="digits found", title=f"({letter}) {title}")
        axes.label_outer()
    house_style.legend_below(figure, *([entry] for entry in axes.lines))
    return figure


def _draw_map(
    axes: Axes, impacts: Columns, name: str, edges: list[float], digits: Array
) -> QuadMesh:
    """Draw the median of the digits in each cell; cells without impacts are hatched.

    The least number of a cell would mislead: in every cell an output passes through zero.
    """
    column, row = np.digitize(impacts[OMEGA], list(OMEGAS)), np.digitize(impacts[name], edges)
    cells = np.full((len(edges) + 1, len(OMEGAS) + 1), np.nan)
    for cell in set(zip(row, column, strict=True)):
        cells[cell] = np.median(digits[(row == cell[0]) & (column == cell[1])])
    axes.patch.set(hatch="//////", edgecolor="0.7")
    norm = BoundaryNorm(LEVELS, COLOURS.N)
    seamless = {"edgecolors": "face", "linewidth": 0.3}
    axes.set_xticks(range(1, len(OMEGAS) + 1), OMEGAS.values())
    axes.tick_params(direction="out", length=2.5)
    return axes.pcolormesh(np.ma.masked_invalid(cells), cmap=COLOURS, norm=norm, **seamless)
