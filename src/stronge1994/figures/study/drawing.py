"""Maps of the velocity at separation over incidence and restitution, one for each spring."""

from collections.abc import Mapping
from typing import NamedTuple, TypeAlias

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import Normalize
from matplotlib.figure import Figure
from matplotlib.patches import Patch
from scipy import ndimage

from planarimpact.ground.arrays import Array, Booleans, Integers
from planarimpact.ground.results import Regime
from stronge1994 import curve_names
from stronge1994.csv_tables import Column, Columns, Curves
from stronge1994.figures.shared.drawing import house_style
from stronge1994.figures.shared.drawing.house_style import Points, Settings

Cell: TypeAlias = tuple[int, int]  # row and column

X, E = "incidence [mu v2(0)]", "restitution [1]"
VELOCITY = "velocity [mu v2(0)]"
# Most maps beside each other.
COLUMNS = 2
COLOURS = "RdBu_r"
ZERO = {"colors": house_style.BLACK, "linewidths": 1.4}
BOUNDARY = {"colors": house_style.BLACK, "linewidths": 0.7, "linestyles": [(0, (4, 2))]}
# A regime is shown if it takes this share of a map: the edge of the grid does not count.
LEAST = 0.02
# A regime is named if a circle of this radius fits into it, in units of a panel.
ROOM = 0.03
# Width of a letter, height of a line and border of a name, in units of a panel.
LETTER, LINE, BORDER = 0.027, 0.07, 0.03
# Negative velocities are hatched, because blue and red look alike in grey.
NEGATIVE = {"hatch": "////", "edgecolor": "0.7", "linewidth": 0}
PLATE = {"facecolor": "white", "alpha": 0.75, "edgecolor": "none", "pad": 1.0}
NAME = {
    "ha": "center",
    "va": "center",
    "fontsize": house_style.NOTE,
    "linespacing": house_style.LINES,
}
NAME |= {"bbox": PLATE}
LEADER = {"arrowstyle": "-|>", "mutation_scale": 6, "linewidth": 0.6, "color": house_style.BLACK}
LEADER |= {"shrinkA": 0, "shrinkB": 0}


def drawn_curves(curves: Curves, settings: Settings, points: Points) -> Curves:
    """The curves by the titles of their maps, so that each map is looked up in its own table."""
    return {
        _title(settings["mass_ratio"], zeta2): curves[curve_names.name("zeta^2", zeta2)]
        for zeta2 in settings["stiffness_ratio"]
    }


def _title(mass_ratio: float, stiffness_ratio: float) -> str:
    return rf"$m_2/m_1$ = {mass_ratio:g}, $\zeta^2$ = {stiffness_ratio:g}"


def draw(curves: Curves, settings: Settings, points: Points) -> Figure:
    """Draw the velocity at separation in colours, where it is zero, and where regimes meet."""
    columns = min(len(curves), COLUMNS)
    rows = -(-len(curves) // columns)
    figure = house_style.new(0.9 + 2.3 * rows)
    panels = figure.subplots(rows, columns, sharex=True, sharey=True, squeeze=False).ravel()
    limit = max(np.abs(curve[VELOCITY]).max() for curve in curves.values()) or 1.0
    for panel, (title, curve) in zip(panels, curves.items(), strict=False):
        grid = np.unique(curve[X]), np.unique(curve[E])
        values, regimes = (_map(curve, column) for column in (VELOCITY, "regime"))
        colours = {"cmap": COLOURS, "norm": Normalize(-limit, limit)}
        # As pixels inside the SVG: tens of thousands of cells would be too many shapes.
        mesh = panel.pcolormesh(*grid, values, shading="nearest", rasterized=True, **colours)
        if values.min() < 0 < values.max():
            panel.contourf(*grid, values, [-limit, 0.0], colors="none", hatches=[NEGATIVE["hatch"]])
            panel.contour(*grid, values, [0.0], **ZERO)
        codes = np.array([[Regime[regime] for regime in row] for row in regimes])
        _draw_regimes(panel, grid, codes, values < 0)
        panel.set_title(title)
        panel.set(xlim=grid[0][[0, -1]], ylim=grid[1][[0, -1]])
        panel.set(xlabel=house_style.INCIDENCE, ylabel="restitution $e$")
        panel.label_outer()
    for panel in panels[len(curves) :]:
        panel.remove()
    bar = figure.colorbar(mesh, ax=panels[: len(curves)], aspect=30, pad=0.02)
    bar.set_label(house_style.REBOUND)
    entries = [
        house_style.key("zero", color=house_style.BLACK, linewidth=1.4),
        Patch(facecolor="none", label="negative", **NEGATIVE),
        house_style.key(
            "regimes meet", color=house_style.BLACK, linewidth=0.7, linestyle=(0, (4, 2))
        ),
    ]
    figure.legend(handles=entries, loc="outside lower center", ncols=len(entries))
    return figure


def _map(curve: Columns, column: str) -> Column:
    """A column of a grid as a map: a row for each restitution, the incidence runs along it."""
    return curve[column].reshape(len(np.unique(curve[E])), -1)


def _draw_regimes(
    panel: Axes, grid: tuple[Array, Array], codes: Integers, negative: Booleans
) -> None:
    """Draw lines where regimes meet, and their names; none for regimes at the edge of the grid."""
    regimes = [code for code in np.unique(codes) if _is_large(codes == code)]
    named = {}
    for code in regimes:
        inside = codes == code
        if _room(inside) >= ROOM and (inside.all() or len(regimes) > 1):
            named[Regime(code).words.replace(" - ", "-")] = inside
        # Each line is drawn once, by the regime with the smaller code: two lines on top of each
        # other would fill the gaps between their dashes.
        visible = np.isin(codes, regimes) & (codes >= code)
        # Smoothed, a slanted line has no steps from cell to cell.
        share, whole = (ndimage.gaussian_filter(1.0 * part, 1) for part in (inside, visible))
        field = np.ma.masked_array(share, ~visible) / whole
        if field.min() < field.max():
            panel.contour(*grid, field, [0.5], **BOUNDARY)
    lines = _edges(negative) | _edges(np.where(np.isin(codes, regimes), codes, -1))
    for name in _names(named, lines):
        at = [(grid[0][column], grid[1][row]) for row, column in (name.target, name.place)]
        panel.annotate(
            name.words,
            *at,
            rotation=name.rotation,
            arrowprops=LEADER if name.place != name.target else None,
            **NAME,
        )


def _edges(values: Booleans | Integers) -> Booleans:
    """Cells whose neighbour to the right or above has another value."""
    edges = np.zeros(values.shape, bool)
    edges[:-1] |= values[1:] != values[:-1]
    edges[:, :-1] |= values[:, 1:] != values[:, :-1]
    return edges


class _Name(NamedTuple):
    """Name of a regime, where it stands, and the cell that it names."""

    words: str
    rotation: int
    place: Cell
    target: Cell


def _names(named: Mapping[str, Booleans], lines: Booleans) -> list[_Name]:
    """Names of regions, where they cover no line and no other name.

    A name stands in its region, upright if it is narrow. If there is no room, the name stands as
    near as possible and points at the middle of the region; if that fails too, it is left out.
    """
    taken, found = lines.copy(), {}
    for rotation, elsewhere in ((0, False), (90, False), (0, True)):
        for name, inside in named.items():
            words = name if rotation else name.replace("-", "-\n").replace(" ", "\n")
            size = _size(words, rotation, taken.shape)
            # What lies beyond the frame is taken.
            free = ~ndimage.maximum_filter(taken, size=size, mode="constant", cval=1)
            region = free if elsewhere else free & inside
            if name in found or not region.any():
                continue
            middle = _middle(inside if elsewhere else region)
            place = _nearest(np.argwhere(region), middle, region.shape)
            found[name] = _Name(words, rotation, place, middle)
            covered = np.zeros(taken.shape, bool)
            covered[place] = True
            taken |= ndimage.maximum_filter(covered, size=size)
    return list(found.values())


def _size(words: str, rotation: int, shape: tuple[int, ...]) -> tuple[int, int]:
    """Rows and columns of cells that words cover."""
    lines = words.split("\n")
    high, wide = LINE * len(lines) + BORDER, LETTER * max(map(len, lines)) + BORDER
    if rotation:
        high, wide = wide, high
    return int(np.ceil(high * shape[0])), int(np.ceil(wide * shape[1]))


def _middle(inside: Booleans) -> Cell:
    """Cell in the middle of those that are far from what is outside of a region."""
    depth = _depth(inside)
    cells = np.argwhere(depth > 0.8 * depth.max())
    return _nearest(cells, tuple(cells.mean(axis=0)), inside.shape)


def _nearest(cells: Integers, target: tuple[float, float], shape: tuple[int, ...]) -> Cell:
    """The one of some cells that is nearest to a place in the map."""
    apart = ((cells - np.array(target)) / shape) ** 2
    row, column = cells[apart.sum(axis=1).argmin()]
    return int(row), int(column)


def _is_large(inside: Booleans) -> bool:
    """Whether a region takes its share, and is more than one row or column of cells."""
    thick = inside[1:, 1:] & inside[:-1, 1:] & inside[1:, :-1] & inside[:-1, :-1]
    return bool(thick.any() and inside.mean() >= LEAST)


def _room(inside: Booleans) -> float:
    """Radius of the largest circle in a region, in panels."""
    return _depth(inside).max()


def _depth(inside: Booleans) -> Array:
    """Distance of each cell to what is outside of a region, in panels."""
    cell = 1 / np.array(inside.shape)
    return ndimage.distance_transform_edt(np.pad(inside, 1), sampling=cell)[1:-1, 1:-1]
