"""The table: how it divides the impacts, and how it is read and evaluated.

In y = x/zeta^2, b = beta/zeta^2 and e the answer is smooth between edges, where it bends. A panel
is a loss, or a part of it, with the same edges throughout. Its impacts are mapped to t and u, from
0 to 1 over e and b, and s, from 0 to 1 between two edges. That is a patch. In a patch velocity,
peak friction and work are cubic splines in s, t and u: sums of products of uniform B-splines. In
the first patch, where y < 1, velocity and peak friction are over y, and work over y^2: they vanish
there with y, and errors with them. All patches of a panel have the same B-splines over t and u, so
that neighbours agree at their common edge. Edges are interpolated linearly in t and u, when the
table is made as when it is used: so with a small error of an edge the answer bends at a slightly
wrong y, but it does not jump.
"""

from collections.abc import Sequence
from functools import cache
from itertools import pairwise
from math import sqrt
from typing import IO, Any, NamedTuple

import numpy as np

from planarimpact.common import checks
from planarimpact.common.arrays import Array, Booleans, Integers, Number
from planarimpact.normal_impact import hertz, kelvin_voigt, yielding

# Where s has its root: nowhere, at the left edge of a patch, or at its right edge. The answer bends
# there like a power 3/2 of the distance.
EVEN, LEFT, RIGHT = range(3)
ROOTS = {
    "viscous": (RIGHT, LEFT, EVEN, EVEN, RIGHT),
    "plastic_low": (EVEN, LEFT, RIGHT, RIGHT),
    "plastic_middle": (EVEN, LEFT, RIGHT, RIGHT),
    "plastic_high": (EVEN, LEFT, RIGHT, RIGHT),
}
# By loss the bounds of b, and the least e: wider than those that `spheres` admits.
SPANS = {"viscous": (1.01, 4.1, 0.095), "plastic": (1.05, 3.55, 0.295)}
# Slip throughout begins at this share of its threshold, because of rounding.
NEARLY = 1 - 2.0**-50
# B-splines that are not zero within an interval.
ORDER = 4


class Panel(NamedTuple):
    """Impacts with the same edges.

    A spline over n intervals has n + 3 coefficients. Those of all patches follow each other over s.
    """

    name: str  # one of `ROOTS`
    intervals: Integers  # how many the splines over s have, shape (patches,)
    # y of the edges that vary with t and u, ascending, with viscous loss (y - 1)/(b - 1); shape
    # (edges, nt + 1, nu + 1).
    edges: Array
    # Coefficients, shape (s, t, u): of velocity over zeta^2, and of peak friction; of both over y
    # in the first patch.
    velocity: Array
    peak: Array
    work: Array  # of friction over zeta^2, over y^2 in the first patch; with viscous loss alone


# Fields of a panel that are stored as whole numbers.
PACKED = Panel._fields[2:]


class Table(NamedTuple):
    """All panels, their unit, and the restitutions between the plastic ones, evenly over u.

    Numbers of the panels are multiples of 2^-exponent.
    """

    exponent: int
    limits: Array
    panels: dict[str, Panel]


@cache
def shipped(name: str = "fine") -> Table:
    """A table of this package: "fine", or "coarse", which is small and good enough for pictures."""
    from importlib import resources  # here, as it takes longer to import than this module

    with resources.files(__package__).joinpath(f"{name}.npz").open("rb") as file:
        table = read(file)
    for values in (table.limits, *(part for panel in table.panels.values() for part in panel[1:])):
        values.setflags(write=False)  # all that ask for it have the same
    return table


def laws() -> list[str]:
    """What the laws of normal impact say of one state, with nothing solved: a table states it."""
    state, tau = np.array([1.0, 0.5, 0.0]), np.array(1.0)
    compression, restitution = kelvin_voigt.compress(state, tau), kelvin_voigt.restore(state, tau)
    loading, depth = yielding.Loading(*np.ones(4)), np.array(2.0)
    numbers = {
        "elastic time": hertz.FULL**0.4 * hertz.COMPRESSION,
        "viscous force": -compression[1] / compression[2],
        "viscous relaxation": restitution[1] / restitution[0],
        "plastic restitution": yielding.restitution(np.array(0.1)),
        "FLOW": yielding.FLOW,
        "plastic flow": loading.flow(depth),
        "plastic pull": loading.pull(depth, yielding.FLOW)[0],
    }
    return [f"{name} {number:.9g}" for name, number in numbers.items()]


def read(file: IO[bytes]) -> Table:
    """Read a table of this package; one that was made from other laws is refused."""
    with np.load(file) as arrays:
        if (made := arrays.get("laws", np.empty(0)).tolist()) != laws():
            words = f"table of spheres: it was made from laws with {made}; allowed are {laws()}, or"
            raise checks.InputError(
                f"{words} a new one, made by tests/package_tables/spheres_tables.py"
            )
        exponent, panels = int(arrays["exponent"]), {}
        for name in ROOTS:
            packed = (real(_summed(arrays[f"{name}.{key}"]), exponent) for key in PACKED)
            # They index: on 32 bits NumPy does not cast int64 to its own type of index.
            intervals = arrays[f"{name}.intervals"].astype(np.intp)
            panels[name] = Panel(name, intervals, *packed)
        return Table(exponent, arrays["limits"], panels)


def whole(values: Array, exponent: int) -> Integers:
    """The nearest multiples of 2^-exponent, as whole numbers."""
    return np.rint(values * 2.0**exponent).astype(np.int32)


def real(whole: Integers, exponent: int) -> Array:
    """Whole numbers of 2^-exponent as real ones."""
    return whole.astype(float) * 2.0**-exponent


def steps(values: Integers) -> Integers:
    """Differences of neighbours along every axis in turn: small where values are smooth.

    Examples
    --------
    >>> steps(np.array([[5, 6, 7], [15, 16, 18]])).tolist()
    [[5, 1, 1], [10, 0, 1]]
    """
    for axis in range(values.ndim):
        values = np.diff(values, axis=axis, prepend=0)
    return values


def _summed(parts: Any) -> Integers:
    """The whole numbers of `steps`, from the bytes that are written."""
    values = np.ascontiguousarray(np.moveaxis(parts, 0, -1)).view("<i4")[..., 0]
    for axis in range(values.ndim):
        values = np.cumsum(values, axis=axis, dtype=np.int32)
    return values


class Answer(NamedTuple):
    """Velocity and work over zeta^2, peak friction, and whether a contact slides throughout.

    The work is NaN with plastic loss, where it follows from the velocity.
    """

    velocity: Array
    peak: Array
    work: Array
    slides: Booleans


def evaluate(
    table: Table, y: Array, b: Array, e: Array, plastic: Booleans, forces: bool = True
) -> Answer:
    """Answers to impacts with y >= 0; those of impacts that slide throughout have no meaning.

    Without `forces` peak friction and work are NaN.
    """
    limits = limits_at(table, b)
    velocity, peak, work = np.empty((3, y.size))
    answer = Answer(velocity, peak, work, np.zeros(y.size, dtype=bool))
    below = e < limits
    panels = ~plastic, plastic & below[0], plastic & ~below[0] & below[1], plastic & ~below[1]
    for panel, rows in zip(table.panels.values(), panels, strict=True):
        which = np.flatnonzero(rows)
        if which.size:
            part = _answer(panel, *(a[..., which] for a in (y, b, e, limits)), forces=forces)
            for values, panel_values in zip(answer, part, strict=True):
                values[which] = panel_values
    return answer


def limits_at(table: Table, b: Array) -> Array:
    """Restitutions between the plastic panels at b, shape (2, n)."""
    index, part = _places(over_b("plastic", b), table.limits.shape[1] - 1)
    return np.stack([_between(limit, index, part) for limit in table.limits])


def over_b(loss: str, b: Number) -> Number:
    """u, from 0 to 1 over b."""
    least, most, _ = SPANS[loss]
    return (b - least) / (most - least)


def loss_of(name: str) -> str:
    """The loss of a panel."""
    return name.partition("_")[0]


def over_e(name: str, e: Any, limits: Any) -> Any:
    """t, from 0 to 1 over e.

    Plastic spheres that lose much oscillate faster: even in 1/e they do so alike. Next to the lower
    limit the last stick lasts within a range of y that shrinks to nothing. Yield begins at a
    velocity that falls with the fourth root of 1 - e as e approaches 1.
    """
    (low, high), (*_, least) = limits, SPANS[loss_of(name)]
    if name == "viscous":
        return (e - least) / (1 - least)
    if name == "plastic_low":
        return 1 - np.sqrt(np.maximum(least / e - least / low, 0.0) / (1 - least / low))
    if name == "plastic_middle":
        return (e - low) / (high - low)
    return np.sqrt(np.sqrt((1 - e) / (1 - high)))


def edges_of(name: str, varying: Sequence[Any], b: Any, e: Any) -> list[Any]:
    """Edges of a panel's patches, from 0 to slip throughout; arrays, or floats of one impact."""
    if name == "viscous":
        inner = [*(1 + (b - 1) * share for share in varying), b]
    else:
        slides = b if name == "plastic_high" else varying[0]
        inner = [(1 + slides) / 2, slides]
    last = varying[1] if name == "plastic_low" else b + e * (b - 1)
    return [0.0, 1.0, *inner, last]


def of_one(table: Table, y: float, b: float, e: float, plastic: bool) -> tuple[str, float, float]:
    """One impact: its panel, y from which it slides throughout, and else velocity over zeta^2.

    As `evaluate`, in Python's floats: an operation of NumPy takes a microsecond, however few the
    numbers. A block of coefficients is multiplied by its weights, axis by axis.
    """
    name, low, high, u = "viscous", 0.0, 0.0, over_b("plastic" if plastic else "viscous", b)
    # Plastic limits have the intervals of the edges.
    count = table.panels["plastic_low" if plastic else "viscous"].edges.shape[2] - 1
    column, part = _place(u, count)
    over_u = 1 - part, part
    if plastic:
        low, high = (table.limits[:, column : column + 2] @ over_u).tolist()
        name = f"plastic_{'low' if e < low else 'middle' if e < high else 'high'}"
    panel, t = table.panels[name], float(over_e(name, e, (low, high)))
    row, part = _place(t, panel.edges.shape[1] - 1)
    corners = panel.edges[:, row : row + 2, column : column + 2]
    edges = edges_of(name, ((1 - part, part) @ corners @ over_u).tolist(), b, e)
    slides_from = float(edges[-1]) * NEARLY
    if y >= slides_from:
        return name, slides_from, 0.0
    patch = max(k for k, edge in enumerate(edges[:-1]) if y >= edge)
    start, end = edges[patch : patch + 2]
    s = (y - start) / (end - start)
    root = ROOTS[name][patch]
    s = sqrt(s) if root == LEFT else 1 - sqrt(1 - s) if root == RIGHT else s
    _, count_t, count_u = panel.velocity.shape
    i, part_s = _place(s, int(panel.intervals[patch]))
    i += sum(panel.intervals[:patch].tolist()) + patch * (ORDER - 1)
    j, part_t = _place(t, count_t - ORDER + 1)
    k, part_u = _place(u, count_u - ORDER + 1)
    block = panel.velocity[i : i + ORDER, j : j + ORDER, k : k + ORDER]
    share = _weights(part_s) @ (block @ _weights(part_u) @ _weights(part_t))
    return name, slides_from, float(share) * (1.0 if patch else y)


def _place(value: float, count: int) -> tuple[int, float]:
    """As `_places`, of a float."""
    at = value * count
    index = min(int(at), count - 1)
    return index, at - index


def _answer(panel: Panel, y: Array, b: Array, e: Array, limits: Array, *, forces: bool) -> Answer:
    t, u = over_e(panel.name, e, limits), over_b(loss_of(panel.name), b)
    edges = edges_of(panel.name, varying_edges(panel.edges, t, u), b, e)
    patch = np.zeros(y.size, dtype=np.intp)
    low, high = edges[:2]
    for edge, following in pairwise(edges[1:]):
        beyond = y >= edge
        patch += beyond
        low, high = np.where(beyond, edge, low), np.where(beyond, following, high)
    width = high - low
    s = np.clip((np.minimum(y, high) - low) / np.where(width > 0, width, 1.0), 0.0, 1.0)
    root = np.array(ROOTS[panel.name]).take(patch)
    right = root == RIGHT
    bent = np.sqrt(np.where(right, 1 - s, s))
    s = np.where(root == EVEN, s, np.where(right, 1 - bent, bent))
    first = np.cumsum(panel.intervals + ORDER - 1) - (panel.intervals + ORDER - 1)
    row, part = _places(s, panel.intervals.take(patch))
    weights = [_weights(part)]
    base = first.take(patch) + row
    for value, size in zip((t, u), panel.velocity.shape[1:], strict=True):
        index, part = _places(value, size - ORDER + 1)
        weights.append(_weights(part))
        base = base * size + index
    scale = np.where(patch == 0, y, 1.0)
    velocity = spline(panel.velocity, base, weights) * scale
    peak, work = np.full((2, y.size), np.nan)
    if forces:
        peak = spline(panel.peak, base, weights) * scale
        work = spline(panel.work, base, weights) * scale * scale if panel.work.size else work
    return Answer(velocity, peak, work, y >= edges[-1] * NEARLY)


def spline(coefficients: Array, base: Integers, weights: Sequence[Sequence[Array]]) -> Array:
    """Sums of products of B-splines over s, t and u, whose weights have the shape (3, 4, n).

    `base` numbers, in the order of memory, the first of the 64 coefficients of each place.
    """
    _, rows, columns = coefficients.shape
    flat = coefficients.reshape(-1)
    over_s, over_t, over_u = weights
    outer, middle, inner, term = np.empty((4, base.size))
    for i in range(ORDER):
        for j in range(ORDER):
            for k in range(ORDER):
                into = term if k else inner
                flat[(i * rows + j) * columns + k :].take(base, out=into, mode="clip")
                into *= over_u[k]
                if k:
                    inner += term
            inner *= over_t[j]
            if j:
                middle += inner
            else:
                middle[:] = inner
        middle *= over_s[i]
        if i:
            outer += middle
        else:
            outer[:] = middle
    return outer


def _weights(x: Number) -> list[Number]:
    """The four B-splines of an interval at x, from 0 to 1 in it."""
    left = 1 - x
    return [
        left * left * left / 6,
        (x * x * (x - 2) * 3 + 4) / 6,
        (left * left * (left - 2) * 3 + 4) / 6,
        x * x * x / 6,
    ]


def _between(values: Array, index: Integers, part: Array) -> Array:
    """Linear interpolation between a value and the next one."""
    return (1 - part) * values.take(index) + part * values.take(index + 1)


def varying_edges(grids: Array, t: Array, u: Array) -> list[Array]:
    """Edges of a panel that vary, interpolated linearly over t and u."""
    _, rows, columns = grids.shape
    i, over = _places(t, rows - 1)
    j, across = _places(u, columns - 1)
    corner = i * columns + j
    values = []
    for grid in grids.reshape(len(grids), rows * columns):
        before, after = (_between(grid, at, across) for at in (corner, corner + columns))
        values.append((1 - over) * before + over * after)
    return values


def _places(value: Array, count: int | Integers) -> tuple[Integers, Array]:
    """The interval, one of `count`, that a value from 0 to 1 is in, and the place in it."""
    at = value * count
    index = np.clip(at.astype(np.intp), 0, count - 1)
    return index, at - index
