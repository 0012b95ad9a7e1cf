"""The table: how it divides the impacts, and how it is read and evaluated.

In y = x/zeta^2, b = beta/zeta^2 and e the answer is smooth between edges, see `thresholds`. A panel
is a loss, or a part of it, with the same edges throughout. Its impacts are mapped to u and t, from
0 to 1 over b and e, and s, from 0 to 1 between two edges. That is a patch. It is divided evenly
into cells, and in each cell velocity, peak friction and work are polynomials of degree 3. Edges are
interpolated linearly in t and u, when the table is made as when it is used: so a small error of an
edge bends the answer a little late, and no more.
"""

from functools import cache
from importlib import resources
from itertools import pairwise
from typing import IO, Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from planarimpact.ground.arrays import Array, Booleans, Integers

Bytes: TypeAlias = NDArray[np.uint8]

# Bounds of b and e: those of spheres, with room for rounding and for what is next to them.
B_LEAST, B_MOST, E_LEAST = 1.55, 3.55, 0.295
DEGREE = 3
# Powers of s, t and u of each coefficient, in the order of Horner's rule.
POWERS = [
    (i, j, k)
    for i in range(DEGREE, -1, -1)
    for j in range(DEGREE - i, -1, -1)
    for k in range(DEGREE - i - j, -1, -1)
]
# Where s has its root: nowhere, at the left edge of a patch, or at its right edge. The answer bends
# there like a power 3/2 of the distance.
EVEN, LEFT, RIGHT = range(3)
# Fields of a panel that are stored as whole numbers, of at least 2^-FINE.
PACKED = "edges", "coefficients", "reversed"
FINE = 20
PANELS = "viscous", "plastic_low", "plastic_high"


class Panel(NamedTuple):
    """Impacts with the same edges.

    Attributes
    ----------
    name : str
        One of `PANELS`.
    edges : ndarray, shape (edges, nt + 1, nu + 1)
        Those that vary, over t and u: in y, ascending where they are edges of patches. With
        plastic loss four more, see `kind_of`.
    roots : ndarray of int, shape (patches,)
        EVEN, LEFT or RIGHT.
    shapes : ndarray of int, shape (patches, 3)
        Cells in s, t and u.
    first : ndarray of int, shape (patches,)
        Number of the first cell of each patch.
    coefficients : ndarray, shape (functions, 20, cells)
        Of velocity over zeta^2, peak friction, and with viscous loss work of friction over zeta^2,
        by `POWERS` of the place within a cell, 0 to 1 each way.
    reversed : ndarray, shape (20, cells of the first patch) or (20, 0)
        Of the largest friction against the first direction.
    twins : ndarray of int, shape (4, cells) or (4, 0)
        The first of the cells that answer in place of a cell for each kind of `kind_of`; most often
        itself.
    split : ndarray of int, shape (cells,) or (0,)
        Into how many parts each way a cell is split; most often 1.
    """

    name: str
    edges: Array
    roots: Integers
    shapes: Integers
    first: Integers
    coefficients: Array
    reversed: Array
    twins: Integers
    split: Integers


class Table(NamedTuple):
    """All panels, and the restitution between the two plastic ones, evenly over u."""

    limit: Array
    panels: dict[str, Panel]


@cache
def shipped(name: str = "fine") -> Table:
    """A table of this package: "fine", or "coarse", which is small and good enough for pictures."""
    with resources.files(__package__).joinpath(f"{name}.npz").open("rb") as file:
        return read(file)


def read(file: IO[bytes]) -> Table:
    """Read a table that `write` wrote."""
    with np.load(file) as arrays:
        panels = {}
        for name in PANELS:
            fields = {field: arrays[f"{name}.{field}"] for field in Panel._fields[1:]}
            for field in PACKED:
                unit = 2.0 ** -arrays[f"{name}.{field}.exponent"].astype(float)
                fields[field] = _together(fields[field]) * unit[..., None]
            panels[name] = Panel(name, **fields)
        return Table(arrays["limit"], panels)


def write(file: IO[bytes], table: Table) -> None:
    """Write a table, compressed; `packed` says how real numbers are stored."""
    arrays: dict[str, Any] = {"limit": table.limit}
    for name, panel in table.panels.items():
        for field in Panel._fields[1:]:
            values = getattr(panel, field)
            if field in PACKED:
                whole, arrays[f"{name}.{field}.exponent"] = packed(values)
                values = _apart(whole)
            arrays[f"{name}.{field}"] = values
    np.savez_compressed(file, **arrays)


def packed(values: Array) -> tuple[Integers, Integers]:
    """Real numbers as whole numbers of a power of 1/2.

    Coefficients of degree 2 and 3 are whole numbers of the least unit with which they fit into 16
    bits, 3e-5 of the largest of their kind. The others, and edges, are whole numbers of 2^-FINE.

    Parameters
    ----------
    values : ndarray, shape (..., 20, cells), or of edges

    Returns
    -------
    whole : ndarray of int32
        Of the same shape.
    exponent : ndarray of int8
        Of that shape without the last dimension. A value is `whole` times 2^-exponent.

    Examples
    --------
    >>> whole, exponent = packed(np.full((len(POWERS), 1), 0.75))
    >>> (whole[:, 0] / 2.0**exponent).tolist() == [0.75] * 20, exponent[[0, -1]].tolist()
    (True, [15, 20])
    """
    exponent = np.full(values.shape[:-1], FINE, dtype=np.int8)
    if values.shape[-2] == len(POWERS):
        largest = np.max(np.abs(values), axis=-1, initial=2.0**-FINE)
        fit = np.minimum(np.floor(np.log2(32767 / largest)), FINE)
        exponent = np.where([sum(powers) > 1 for powers in POWERS], fit, FINE).astype(np.int8)
    unit = 2.0 ** -exponent.astype(float)
    return np.rint(values / unit[..., None]).astype(np.int32), exponent


def _apart(whole: Integers) -> Bytes:
    """The four bytes of whole numbers in four arrays: those alike side by side are compressed."""
    return np.moveaxis(whole.astype("<i4")[..., None].view(np.uint8), -1, 0)


def _together(parts: Bytes) -> Integers:
    return np.ascontiguousarray(np.moveaxis(parts, 0, -1)).view("<i4")[..., 0]


class Answer(NamedTuple):
    """Velocity and work over zeta^2, peak friction, and whether a contact sticks more than once.

    The work is NaN with plastic loss, where it follows from the velocity.
    """

    velocity: Array
    peak: Array
    work: Array
    multiple: Booleans


def evaluate(table: Table, y: Array, b: Array, e: Array, plastic: Booleans) -> Answer:
    """Answers to impacts that do not slide throughout.

    Parameters
    ----------
    table : Table
    y, b, e : ndarray, shape (n,)
        y >= 0.
    plastic : ndarray of bool, shape (n,)

    Returns
    -------
    Answer
    """
    u = over_b(b)
    limit = _between(table.limit, u)
    velocity, peak, work = np.empty((3, y.size))
    found = Answer(velocity, peak, work, np.zeros(y.size, dtype=bool))
    early = plastic & (e < limit)
    for name, rows in zip(PANELS, (~plastic, early, plastic & ~early), strict=True):
        which = np.flatnonzero(rows)
        if which.size:
            part = y[which], b[which], e[which], u[which], limit[which]
            for whole, some in zip(found, _answer(table.panels[name], *part), strict=True):
                whole[which] = some
    return found


def over_b(b: Array) -> Array:
    """u, from 0 to 1 over b."""
    return (b - B_LEAST) / (B_MOST - B_LEAST)


def over_e(name: str, e: Array, limit: Array) -> Array:
    """t, from 0 to 1 over e.

    Plastic spheres that lose much oscillate faster: even in 1/e they do so alike. Next to the limit
    the middle slips within a range of y that shrinks to nothing. Yield begins at a velocity that
    falls with the fourth root of 1 - e as e approaches 1.
    """
    if name == "viscous":
        return (e - E_LEAST) / (1 - E_LEAST)
    if name == "plastic_low":
        return 1 - np.sqrt(np.maximum(E_LEAST / e - E_LEAST / limit, 0.0) / (1 - E_LEAST / limit))
    return np.sqrt(np.sqrt((1 - e) / (1 - limit)))


def edges_of(
    panel: Panel, t: Array, u: Array, b: Array, e: Array
) -> tuple[list[Array], list[Array]]:
    """Edges of the patches, from 0 to slip throughout, and the edges that vary."""
    varying = _over_both(panel.edges, t, u)
    zero, one = np.zeros_like(b), np.ones_like(b)
    inner = {
        "viscous": lambda: [one, varying[0], varying[1]],
        "plastic_low": lambda: [varying[0], one, varying[1]],
        "plastic_high": lambda: [one, varying[0]],
    }[panel.name]()
    return [zero, *inner, b, b + e * (b - 1)], varying


def _answer(panel: Panel, y: Array, b: Array, e: Array, u: Array, limit: Array) -> Answer:
    t = over_e(panel.name, e, limit)
    edges, varying = edges_of(panel, t, u, b, e)
    patch = np.zeros(y.size, dtype=np.intp)
    low, high = edges[:2]
    for edge, following in pairwise(edges[1:]):
        beyond = y >= edge
        patch += beyond
        low, high = np.where(beyond, edge, low), np.where(beyond, following, high)
    width = high - low
    s = np.clip((y - low) / np.where(width > 0, width, 1.0), 0.0, 1.0)
    root = panel.roots.take(patch)
    right = root == RIGHT
    bent = np.sqrt(np.where(right, 1 - s, s))
    s = np.where(root == EVEN, s, np.where(right, 1 - bent, bent))
    cell: Integers = np.zeros(y.size, dtype=np.intp)
    place = []
    for axis, value in enumerate((s, t, u)):
        count = panel.shapes[:, axis].take(patch)
        at = value * count
        index = np.clip(at.astype(np.intp), 0, count - 1)
        cell = cell * count + index
        place.append(at - index)
    cell += panel.first.take(patch)
    early = panel.name == "plastic_low"
    first = np.flatnonzero(patch == 0) if early else np.zeros(0, dtype=np.intp)
    back = polynomial(panel.reversed, cell[first], [at[first] for at in place]) if early else 0.0
    if panel.twins.size:
        cell = _finer(panel, kind_of(y, varying), cell, place)
    velocity, peak, *work = (polynomial(c, cell, place) for c in panel.coefficients)
    multiple = np.zeros(y.size, dtype=bool)
    if early:
        peak[first] = np.maximum(peak[first], back)
        multiple = (y >= varying[2]) & (y <= 1)
    return Answer(velocity, peak, work[0] if work else np.full(y.size, np.nan), multiple)


def _finer(panel: Panel, kind: Integers, cell: Integers, place: list[Array]) -> Integers:
    """The cell of a kind, or the part of one that is split; places are then those in the part."""
    parts = panel.split.take(cell)
    cell = panel.twins[kind, cell]
    some = np.flatnonzero(parts > 1)
    count, within = parts[some], np.zeros(some.size, dtype=np.intp)
    for at in place:
        fine = at[some] * count
        index = np.clip(fine.astype(np.intp), 0, count - 1)
        at[some] = fine - index
        within = within * count + index
    cell[some] += within
    return cell


def kind_of(y: Array, varying: list[Array]) -> Integers:
    """Kind of a plastic impact: the answer bends from one to another.

    Two things are told: whether the last slip is forward, between the incidences `varying[-4]` and
    `varying[-3]`; and whether the contact point moves back at maximum compression, between
    `varying[-2]` and `varying[-1]`. Kinds are 0 and 1, forward and backward in the end, and the
    same plus 2 where it moves back at maximum compression.
    """
    forward = (y >= varying[-4]) & (y < varying[-3])
    returns = (y >= varying[-2]) & (y < varying[-1])
    return 2 * returns.astype(np.intp) + ~forward


def polynomial(coefficients: Array, cell: Integers, place: list[Array]) -> Array:
    """Polynomials of cells, by Horner's rule.

    Parameters
    ----------
    coefficients : ndarray, shape (20, cells)
        In the order of `POWERS`.
    cell : ndarray of int, shape (n,)
    place : list of ndarray, shape (n,)
        Of each place within its cell.

    Returns
    -------
    ndarray, shape (n,)
    """
    s, t, u = place
    rows = iter(coefficients)
    for i in range(DEGREE, -1, -1):
        for j in range(DEGREE - i, -1, -1):
            inner = next(rows).take(cell, mode="clip")
            for _ in range(DEGREE - i - j):
                inner *= u
                inner += next(rows).take(cell, mode="clip")
            if j == DEGREE - i:
                middle = inner
            else:
                middle *= t
                middle += inner
        if i == DEGREE:
            value = middle
        else:
            value *= s
            value += middle
    return value


def _between(values: Array, u: Array) -> Array:
    """Linear interpolation between values that are spread evenly over u."""
    index, part = _places(u, values.size - 1)
    return (1 - part) * values.take(index) + part * values.take(index + 1)


def _over_both(grids: Array, t: Array, u: Array) -> list[Array]:
    """Linear interpolation of grids over t and u."""
    _, rows, columns = grids.shape
    i, over = _places(t, rows - 1)
    j, across = _places(u, columns - 1)
    corner = i * columns + j
    found = []
    for grid in grids.reshape(len(grids), -1):
        before = (1 - across) * grid.take(corner) + across * grid.take(corner + 1)
        after = (1 - across) * grid.take(corner + columns) + across * grid.take(
            corner + columns + 1
        )
        found.append((1 - over) * before + over * after)
    return found


def _places(value: Array, count: int) -> tuple[Integers, Array]:
    """Which of so many intervals a value from 0 to 1 is in, and where."""
    at = value * count
    index = np.clip(at.astype(np.intp), 0, count - 1)
    return index, at - index
