"""Beyond the paper: digits of the lumped model's solution, beside those that are possible."""

import itertools
from collections.abc import Mapping

import matplotlib
import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import QuadMesh
from matplotlib.colors import BoundaryNorm
from matplotlib.figure import Figure

from stronge1994.csv_tables import Columns, Curves
from stronge1994.figures.shared.drawing import house_style
from stronge1994.figures.shared.drawing.house_style import Entries, Points, Settings

OUTPUTS = {
    "velocity": "velocity",
    "peak_friction": "peak friction",
    "dissipation": "dissipation",
}
MARK = {"linestyle": "none", "marker": "o", "markersize": 1.8, "markeredgewidth": 0.4}
MARK |= {"color": house_style.BLUE, "markerfacecolor": "none"}
LINE = {"color": house_style.BLACK, "linewidth": 0.7, "zorder": 3}
COLOURS = matplotlib.colormaps["cividis"]
PLATE = {"facecolor": "white", "edgecolor": "none", "pad": 1.5}
OMEGA = "omega [Omega]"
KINDS = {"digits": "correct digits found", "digits_allowed": "allowed by the condition"}
MOST_DIGITS = 16
LEVELS = np.arange(0, MOST_DIGITS + 1, 2)
# Digits that may be lost, see the comparison `stability-digits`.
LOST_DIGITS_ALLOWED = 2
LINES = {0: "as many as allowed", LOST_DIGITS_ALLOWED: f"{LOST_DIGITS_ALLOWED} digits fewer"}
ACROSS, MEDIAN = "omega [cell]", "median [1]"
# Lower edges of the cells, each with its label. The first cell has none: it holds all below.
OMEGAS = {10.0**k: f"$10^{{{k}}}$" if k % 3 == 0 else "" for k in range(-5, 7)}
OMEGAS[1.0] = "1"
RESTITUTIONS = {5e-324: "", 1e-16: "$10^{-16}$", 1e-8: "$10^{-8}$", 1e-4: "$10^{-4}$"}
RESTITUTIONS |= {0.01: "0.01", 0.1: "0.1", 0.5: "0.5", 1.0: ""}
INCIDENCES = {5e-324: ""}
INCIDENCES |= {10.0**k: f"$10^{{{k}}}$" for k in (-16, -8, -4, -2, 0, 2, 4, 8)}
INCIDENCES[1.0] = "1"
UPRIGHT = {"restitution [1]": RESTITUTIONS, "incidence [mu v2(0)]": INCIDENCES}


def drawn_curves(curves: Curves, settings: Settings, points: Points) -> Curves:
    """Medians of the digits in cells of the parameters; pairs of digits that occur, to a tenth.

    The least number of a cell would mislead: in every cell an output passes through zero.
    """
    impacts = curves["impacts"]
    tables = dict(curves)
    for (name, edges), (kind, label) in itertools.product(UPRIGHT.items(), KINDS.items()):
        digits = np.min([impacts[f"{kind}_{output} [1]"] for output in OUTPUTS], axis=0)
        column, row = (
            np.digitize(impacts[OMEGA], list(OMEGAS)),
            np.digitize(impacts[name], list(edges)),
        )
        cells = np.full((len(edges) + 1, len(OMEGAS) + 1), np.nan)
        for cell in set(zip(row, column, strict=True)):
            cells[cell] = np.median(digits[(row == cell[0]) & (column == cell[1])])
        rows, columns = np.indices(cells.shape) + 0.5
        places = {ACROSS: columns.ravel(), in_cells(name): rows.ravel()}
        tables[f"{label}, {name}"] = places | {MEDIAN: cells.ravel()}
    for output in OUTPUTS:
        pairs = np.stack([impacts[f"{kind}_{output} [1]"] for kind in ("digits_allowed", "digits")])
        allowed, digits = np.unique(np.round(pairs, 1), axis=1)
        tables[f"digits of {output}"] = {"digits_allowed [1]": allowed, "digits [1]": digits}
    ends = np.array([0.0, MOST_DIGITS])
    for fewer, label in LINES.items():
        tables[label] = {"digits_allowed [1]": ends, "digits [1]": ends - fewer}
    return tables


def in_cells(column: str) -> str:
    """Name of a column that counts cells of another.

    >>> in_cells("restitution [1]")
    'restitution [cell]'
    """
    return f"{column.partition(' [')[0]} [cell]"


def draw(curves: Curves, settings: Settings, points: Points) -> Figure:
    """Draw (a) to (d) digits in cells of the parameters, (e) on digits found against allowed."""
    figure = house_style.new(7.0)
    grid = figure.add_gridspec(3, 2, height_ratios=[9, 12, 9])
    maps = [[figure.add_subplot(grid[row, column]) for column in (0, 1)] for row in (0, 1)]
    labels = "restitution $e$", house_style.INCIDENCE
    for row, (name, edges) in enumerate(UPRIGHT.items()):
        kinds = KINDS.values()
        for axes, kind, letter in zip(maps[row], kinds, "abcd"[2 * row :], strict=False):
            mesh = _draw_map(axes, curves[f"{kind}, {name}"], edges)
            axes.set_xlabel(r"$\omega/\Omega$", visible=row == 1)
            axes.set_ylabel(labels[row], visible=axes is maps[row][0])
            place = {"va": "top", "transform": axes.transAxes, "bbox": PLATE}
            axes.text(0.04, 0.955, f"({letter})", **place)
            axes.tick_params(labelbottom=row == 1, labelleft=axes is maps[row][0])
    for axes, title in zip(maps[0], KINDS.values(), strict=True):
        axes.set_title(title)
    maps[0][0].set_yticks(*_with_ends(maps[0][0], "0", "1"))
    maps[1][0].set_yticks(*_with_ends(maps[1][0], "0", ""))
    bar = figure.colorbar(mesh, ax=sum(maps, []), ticks=LEVELS, aspect=40, pad=0.02)
    bar.set_label("digits of the worst output, median of a cell")
    panels = grid[2, :].subgridspec(1, len(OUTPUTS)).subplots(sharey=True)
    for axes, letter, (name, title) in zip(panels, "efg", OUTPUTS.items(), strict=True):
        lines = _draw_scatter(axes, curves, curves[f"digits of {name}"])
        axes.set_xlabel("digits allowed by the condition", visible=letter == "f")
        axes.set_title(f"({letter}) {title}")
    panels[0].set_ylabel("digits found")
    house_style.legend_below(figure, lines[:1], lines[1:])
    return figure


def _draw_map(axes: Axes, table: Columns, edges: Mapping[float, str]) -> QuadMesh:
    """Draw the median of the digits in each cell; cells without impacts are hatched."""
    shape = len(edges) + 1, len(OMEGAS) + 1
    cells = table[MEDIAN].reshape(shape)
    axes.patch.set(hatch="//////", edgecolor="0.7")
    norm = BoundaryNorm(LEVELS, COLOURS.N)
    seamless = {"edgecolors": "face", "linewidth": 0.3}
    mesh = axes.pcolormesh(np.ma.masked_invalid(cells), cmap=COLOURS, norm=norm, **seamless)
    axes.set_xticks(range(1, shape[1]), OMEGAS.values())
    axes.set_yticks(range(1, shape[0]), edges.values())
    axes.tick_params(direction="out", length=2.5)
    return mesh


def _with_ends(axes: Axes, first: str, last: str) -> tuple[list[float], list[str]]:
    """Ticks of a map, with labels for its first and last row, which hold one number each."""
    labels = [label.get_text() for label in axes.get_yticklabels()]
    places = axes.get_yticks().tolist()
    return [0.5, *places, places[-1] + 0.5], [first, *labels, last]


def _draw_scatter(axes: Axes, curves: Curves, table: Columns) -> Entries:
    """Draw a mark for each pair of digits that occurs; entries of the legend."""
    axes.plot(table["digits_allowed [1]"], table["digits [1]"], **MARK)
    lines = []
    for label, dashes in house_style.patterned(LINES.values()):
        x, y = curves[label]["digits_allowed [1]"], curves[label]["digits [1]"]
        lines += axes.plot(x, y, label=label, linestyle=dashes, **LINE)
    axes.set(xlim=(-0.8, 16.8), ylim=(-0.8, 16.8), xticks=LEVELS[::2], yticks=LEVELS[::2])
    return lines
