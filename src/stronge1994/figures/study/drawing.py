"""The parameter study: maps of the rebound over its two longest axes, slices of the others.

A study along one axis is a curve.
"""

import itertools
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import Normalize
from matplotlib.figure import Figure
from matplotlib.patches import Patch
from scipy import ndimage

from planarimpact.ground.arrays import Array, Booleans, Integers
from planarimpact.ground.results import Regime
from stronge1994.csv_tables import Columns, Curves
from stronge1994.figures.shared.drawing import house_style

Cell: TypeAlias = tuple[int, int]  # row and column

SYMBOLS = {
    "incidence": house_style.INCIDENCE,
    "mass_ratio": "$m_2/m_1$",
    "stiffness_ratio": r"$\zeta^2$",
    "restitution": "$e$",
}
LABELS = SYMBOLS | {"restitution": "restitution $e$"}
# At most so many slices are drawn.
SLICES = 6
# At most so many points along an axis are drawn: more could not be seen.
POINTS = 400
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
NAME |= {"bbox": PLATE, "label": house_style.NO_DATA}
LEADER = {"arrowstyle": "-|>", "mutation_scale": 6, "linewidth": 0.6, "color": house_style.BLACK}
LEADER |= {"shrinkA": 0, "shrinkB": 0}
# What words of the picture mean, see `shared.drawing.words`.
AXIS_MEANS = {
    "$m_2/m_1$": r": mass_ratio",
    r"$\zeta^2$": r": stiffness_ratio",
}


def slice_of(axes: Mapping[str, Array], velocity: Array, places: Mapping[str, int]) -> Columns:
    """All of a grid that has the given places on some of its axes."""
    cut = tuple(places.get(name, slice(None)) for name in axes)
    free = [values for name, values in axes.items() if name not in places]
    names = [name for name in axes if name not in places]
    grid = np.meshgrid(*free, indexing="ij")
    units = {"incidence": "mu v2(0)"}
    found = {f"{n} [{units.get(n, '1')}]": g.ravel() for n, g in zip(names, grid, strict=True)}
    return found | {"velocity [mu v2(0)]": velocity[cut].ravel()}


def draw(axes: Mapping[str, Array], velocity: Array, regime: Integers) -> tuple[Figure, Curves]:
    """Draw the velocity at separation in colours, where it is zero, and where regimes meet.

    `velocity` and `regime` have a dimension for each of the `axes`. Also returned are the tables of
    which the figure shows numbers.
    """
    names = list(axes)
    across, upright = sorted(sorted(names, key=lambda name: -len(axes[name]))[:2], key=names.index)
    if min(len(axes[across]), len(axes[upright])) < 2:
        return _curve(axes, velocity.ravel())
    others = [name for name in names if name not in (across, upright)]
    slices = list(itertools.product(*(range(len(axes[name])) for name in others)))
    shown = [slices[i] for i in _thinned(len(slices), SLICES)]
    columns = min(len(shown), 2)
    rows = -(-len(shown) // columns)
    figure = house_style.new(0.9 + 2.3 * rows)
    panels = figure.subplots(rows, columns, sharex=True, sharey=True, squeeze=False).ravel()
    limit = np.abs(velocity).max() or 1.0
    tables = {}
    for panel, places in zip(panels, shown, strict=False):
        cut: dict[str, Any] = dict(zip(others, places, strict=True))
        title = _place(axes, cut, others)
        tables[title] = slice_of(axes, velocity, cut)
        cut |= {name: _thinned(len(axes[name]), POINTS) for name in (across, upright)}
        grid = axes[across][cut[across]], axes[upright][cut[upright]]
        where = np.ix_(*(np.atleast_1d(cut[name]) for name in names))
        shape = len(grid[0]), len(grid[1])
        values, codes = (field[where].reshape(shape).T for field in (velocity, regime))
        colours = {"cmap": COLOURS, "norm": Normalize(-limit, limit)}
        # As pixels inside the SVG: a hundred thousand cells would be too many shapes.
        mesh = panel.pcolormesh(*grid, values, shading="nearest", rasterized=True, **colours)
        if values.min() < 0 < values.max():
            panel.contourf(*grid, values, [-limit, 0.0], colors="none", hatches=[NEGATIVE["hatch"]])
            panel.contour(*grid, values, [0.0], **ZERO)
        _draw_regimes(panel, grid, codes, values < 0)
        panel.set_title(title)
        panel.set(xlim=grid[0][[0, -1]], ylim=grid[1][[0, -1]])
        panel.set(xlabel=LABELS[across], ylabel=LABELS[upright])
        panel.label_outer()
    for panel in panels[len(shown) :]:
        panel.remove()
    bar = figure.colorbar(mesh, ax=panels[: len(shown)], aspect=30, pad=0.02)
    bar.set_label(house_style.REBOUND)
    entries = [
        house_style.key("zero", color=house_style.BLACK, linewidth=1.4),
        Patch(facecolor="none", label="negative", **NEGATIVE),
        house_style.key(
            "regimes meet", color=house_style.BLACK, linewidth=0.7, linestyle=(0, (4, 2))
        ),
    ]
    if len(shown) < len(slices):
        words = f"{len(shown)} of {len(slices)} slices"
        entries.append(house_style.key(words, linestyle="none"))
    figure.legend(handles=entries, loc="outside lower center", ncols=len(entries))
    return figure, tables


def _curve(axes: Mapping[str, Array], velocity: Array) -> tuple[Figure, Curves]:
    """Draw the velocity along the only axis that has more than one point."""
    across = max(axes, key=lambda name: len(axes[name]))
    figure = house_style.new(2.8)
    panel = figure.subplots()
    panel.axhline(0, **house_style.GUIDE)
    panel.plot(
        axes[across], velocity, color=house_style.BLACK, marker="." if len(velocity) < 9 else ""
    )
    others = [name for name in axes if name != across]
    cut = dict.fromkeys(others, 0)
    panel.set_title(_place(axes, cut, others))
    panel.set(xlabel=LABELS[across], ylabel=house_style.REBOUND)
    table = slice_of(axes, velocity.reshape([len(v) for v in axes.values()]), cut)
    return figure, {panel.get_title(): table}


def _place(axes: Mapping[str, Array], cut: Mapping[str, Any], others: Sequence[str]) -> str:
    """Where a slice lies."""
    return ", ".join(f"{SYMBOLS[name]} = {axes[name][cut[name]]:g}" for name in others)


def _thinned(count: int, most: int) -> Integers:
    """Up to `most` places of `count`, evenly spread, both ends among them."""
    return np.unique(np.linspace(0, count - 1, min(count, most)).round().astype(int))


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
        field = np.ma.masked_array(inside.astype(float), ~np.isin(codes, regimes) | (codes < code))
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
