"""Beyond the paper: digits of the lumped model's solution, beside those that are possible."""

from typing import TypeAlias

import matplotlib
import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import QuadMesh
from matplotlib.colors import BoundaryNorm
from matplotlib.figure import Figure

from planarimpact.ground.arrays import Array
from stronge1994.csv_tables import Columns, Curves
from stronge1994.drawings import house_style
from stronge1994.drawings.house_style import Entries, Points, Settings

# Values of all impacts, and the lower edges of the cells with what stands at them.
Cells: TypeAlias = tuple[Array, dict[float, str]]

INCIDENCE, RESTITUTION, OMEGA = "incidence [mu v2(0)]", "restitution [1]", "omega [Omega]"
KINDS = {"digits": "correct digits found", "digits_allowed": "allowed by the condition"}
OUTPUTS = {
    "velocity": "velocity",
    "peak_friction": "peak friction",
    "dissipation": "dissipation",
}
MARK = {"linestyle": "none", "marker": "o", "markersize": 1.8, "markeredgewidth": 0.4}
MARK |= {"color": house_style.BLUE, "markerfacecolor": "none"}
LINE = {"color": house_style.BLACK, "linewidth": 0.7, "zorder": 3}
# Lower edges of the cells, each with its label. The first cell has none: it holds all below.
OMEGAS = {10.0**k: f"$10^{{{k}}}$" if k % 3 == 0 else "" for k in range(-5, 7)}
OMEGAS[1.0] = "1"
RESTITUTIONS = {5e-324: "", 1e-16: "$10^{-16}$", 1e-8: "$10^{-8}$", 1e-4: "$10^{-4}$"}
RESTITUTIONS |= {0.01: "0.01", 0.1: "0.1", 0.5: "0.5", 1.0: ""}
INCIDENCES = {5e-324: ""}
INCIDENCES |= {10.0**k: f"$10^{{{k}}}$" for k in (-16, -8, -4, -2, 0, 2, 4, 8)}
INCIDENCES[1.0] = "1"

LEVELS = np.arange(0, 17, 2)
COLOURS = matplotlib.colormaps["cividis"]
PLATE = {"facecolor": "white", "edgecolor": "none", "pad": 1.5}
# So many digits may be lost, see the comparison `stability-digits`.
WORSE = 2


def draw(curves: Curves, settings: Settings, points: Points) -> Figure:
    """Draw (a) to (d) digits in cells of the parameters, (e) on digits found against allowed."""
    impacts = curves["impacts"]
    figure = house_style.new(7.0)
    grid = figure.add_gridspec(3, 2, height_ratios=[9, 12, 9])
    maps = [[figure.add_subplot(grid[row, column]) for column in (0, 1)] for row in (0, 1)]
    for row, name, edges in ((0, RESTITUTION, RESTITUTIONS), (1, INCIDENCE, INCIDENCES)):
        for axes, kind, letter in zip(maps[row], KINDS, "abcd"[2 * row :], strict=False):
            digits = np.min([impacts[f"{kind}_{output} [1]"] for output in OUTPUTS], axis=0)
            mesh = _draw_map(axes, digits, (impacts[OMEGA], OMEGAS), (impacts[name], edges))
            place = {"va": "top", "transform": axes.transAxes, "bbox": PLATE}
            axes.text(0.04, 0.955, f"({letter})", **place)
            axes.tick_params(labelbottom=row == 1, labelleft=axes is maps[row][0])
    for axes, words in zip(maps[0], KINDS.values(), strict=True):
        axes.set_title(words)
    for axes in maps[1]:
        axes.set_xlabel(r"$\omega/\Omega$")
    maps[0][0].set_ylabel("restitution $e$")
    maps[0][0].set_yticks(*_with_ends(maps[0][0], "0", "1"))
    maps[1][0].set_ylabel(house_style.INCIDENCE)
    maps[1][0].set_yticks(*_with_ends(maps[1][0], "0", ""))
    bar = figure.colorbar(mesh, ax=sum(maps, []), ticks=LEVELS, aspect=40, pad=0.02)
    bar.set_label("digits of the worst output, median of a cell")
    panels = grid[2, :].subgridspec(1, len(OUTPUTS)).subplots(sharey=True)
    for axes, letter, (name, words) in zip(panels, "efg", OUTPUTS.items(), strict=True):
        lines = _draw_scatter(axes, impacts, name)
        axes.set_title(f"({letter}) {words}")
    panels[0].set_ylabel("digits found")
    panels[1].set_xlabel("digits allowed by the condition")
    house_style.legend_below(figure, lines[:1], lines[1:])
    return figure


def _draw_map(axes: Axes, digits: Array, across: Cells, upright: Cells) -> QuadMesh:
    """Draw the median of the digits in each cell; cells without impacts are hatched.

    The least would be misleading: in every cell some output passes through zero.
    """
    column, row = (np.digitize(values, list(edges)) for values, edges in (across, upright))
    shape = len(upright[1]) + 1, len(across[1]) + 1
    cells = np.full(shape, np.nan)
    for cell in set(zip(row, column, strict=True)):
        here = (row == cell[0]) & (column == cell[1])
        cells[cell] = np.median(digits[here])
    axes.patch.set(hatch="//////", edgecolor="0.7")
    norm = BoundaryNorm(LEVELS, COLOURS.N)
    seamless = {"edgecolors": "face", "linewidth": 0.3}
    mesh = axes.pcolormesh(np.ma.masked_invalid(cells), cmap=COLOURS, norm=norm, **seamless)
    axes.set_xticks(range(1, shape[1]), across[1].values())
    axes.set_yticks(range(1, shape[0]), upright[1].values())
    axes.tick_params(direction="out", length=2.5)
    return mesh


def _with_ends(axes: Axes, first: str, last: str) -> tuple[list[float], list[str]]:
    """Ticks of a map, with labels for its first and last row, which hold one number each."""
    labels = [label.get_text() for label in axes.get_yticklabels()]
    places = axes.get_yticks().tolist()
    return [0.5, *places, places[-1] + 0.5], [first, *labels, last]


def _draw_scatter(axes: Axes, impacts: Columns, output: str) -> Entries:
    """Draw a mark for each pair of digits that occurs, to a tenth; entries of the legend."""
    pairs = np.stack([impacts[f"{kind}_{output} [1]"] for kind in ("digits_allowed", "digits")])
    axes.plot(*np.unique(np.round(pairs, 1), axis=1), **MARK)
    ends = np.array([0, LEVELS[-1]])
    lines = axes.plot(ends, ends, label="as many as allowed", **LINE)
    dashed = LINE | {"linestyle": house_style.DASHES[1]}
    lines += axes.plot(ends, ends - WORSE, label=f"{WORSE} digits fewer", **dashed)
    axes.set(xlim=(-0.8, 16.8), ylim=(-0.8, 16.8), xticks=LEVELS[::2], yticks=LEVELS[::2])
    return lines
