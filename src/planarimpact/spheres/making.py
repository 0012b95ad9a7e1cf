"""How the table of spheres is made: the continuum is solved at nodes, and cells are fitted to it.

Each patch has nodes evenly over s, t and u. A cubic spline through them is fitted by a polynomial
in each cell. The continuum is solved with a fixed number of steps and with twice as many, and
extrapolated: then neighbours have neighbouring errors.

With plastic loss the answer also bends between the kinds of `table.kind_of`. No formula gives
these incidences, so they are searched. Cells near them are fitted to impacts of their own, once for
each kind.
"""

from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np
from scipy.interpolate import make_interp_spline

from planarimpact import continuum
from planarimpact.continuum import inelastic
from planarimpact.ground.arrays import Array, Integers
from planarimpact.spheres import table, thresholds
from planarimpact.spheres.table import EVEN, LEFT, RIGHT, Panel, Table

# Steps of the continuum, and impacts solved together.
STEPS, TOGETHER = 192, 128
# Intervals of t and u over which edges are interpolated.
EDGES_OVER_E, EDGES_OVER_B = 128, 64
# Friction of an impact with no incidence has no shape: this one is solved instead.
LEAST_INCIDENCE = 1e-6
# An impact nearer to e = 1 than this is elastic.
ELASTIC = 1 - 1e-9
# The largest restitution for which viscous spheres have edges of their own.
VISCOUS = 1 - 1e-13


# Functions at a node: velocity, peak friction, a third one, and the kind.
KIND, KINDS = 3, 4
# A cell is near another kind if there is a node of one within so many nodes.
NEAR = 1.5
# Points over each variable of such a cell, and the weight of those of other kinds.
POINTS, BEYOND = 4, 1e-3
# Parts each way that such a cell is split into, and the errors of velocity from which it is so.
SPLITS, WORSE = (1, 2), (5e-4,)
# Cells whose velocity is off by more than `MENDED` at one of so many impacts, a third of them next
# to an edge, are fitted anew: to more points, and with more weight for those of other kinds.
MENDED, TRIED, ROUNDS = 3e-4, 60_000, 2
MORE_POINTS, MORE_BEYOND = 6, 0.05
# Incidences over which a change is sought, and halvings that find it.
PLACES, HALVINGS = 48, 12


# Cells and nodes over each variable of the two tables, as a share of those below.
SHARES = {"fine": 1.0, "coarse": 0.4}


class Patch(NamedTuple):
    """Where s has its root, cells and nodes, whether kinds may change, and errors as in `WORSE`."""

    root: int
    cells: tuple[int, ...]
    nodes: tuple[int, ...]
    changes: bool = False
    worse: tuple[float, ...] = WORSE

    def coarser(self, share: float) -> "Patch":
        """The same with a share of its cells and nodes each way."""
        # Of cubic polynomials in cells that are so much larger, no more can be asked.
        return self._replace(
            cells=tuple(max(2, round(share * count)) for count in self.cells),
            nodes=tuple(max(5, round(share * count)) for count in self.nodes),
            worse=tuple(error / share**3 for error in self.worse),
        )


PATCHES = {
    "viscous": [
        Patch(EVEN, (9, 13, 9), (19, 23, 19)),
        Patch(LEFT, (11, 16, 9), (25, 33, 19)),
        Patch(EVEN, (6, 13, 8), (13, 29, 17)),
        Patch(EVEN, (5, 10, 5), (9, 19, 11)),
        Patch(RIGHT, (9, 10, 6), (19, 19, 13)),
    ],
    "plastic_low": [
        Patch(EVEN, (14, 20, 10), (27, 41, 19), True),
        Patch(LEFT, (17, 21, 10), (31, 45, 21), True),
        Patch(EVEN, (3, 19, 9), (7, 41, 21), True),
        Patch(EVEN, (20, 21, 10), (37, 45, 21), True),
        Patch(RIGHT, (6, 10, 6), (13, 19, 13)),
    ],
    "plastic_high": [
        Patch(EVEN, (7, 10, 7), (17, 25, 17), True),
        Patch(LEFT, (11, 14, 9), (25, 31, 19), True),
        Patch(LEFT, (14, 14, 9), (31, 31, 19), True),
        Patch(RIGHT, (8, 10, 6), (15, 17, 13)),
    ],
}


def make(share: float = 1.0, say: Callable[[str], None] = print) -> Table:
    """Make the table; takes half an hour.

    Parameters
    ----------
    share : float
        Of the cells and nodes over each variable, 0 to 1.
    say : callable
        Is told of each patch that is done.

    Returns
    -------
    Table
    """
    u = np.linspace(0.0, 1.0, EDGES_OVER_B + 1)
    limit = thresholds.early_limit(b_at(u))
    panels = {}
    for name in table.PANELS:
        patches = [patch.coarser(share) for patch in PATCHES[name]]
        panel = _panel(name, patches, limit, say)
        if share == 1:
            for turn in range(ROUNDS):
                panel = mended(panel, limit, patches, turn, say)
        panels[name] = panel
    return Table(limit, panels)


def b_at(u: Array) -> Array:
    """b = beta/zeta^2 at u."""
    return table.B_LEAST + u * (table.B_MOST - table.B_LEAST)


def e_at(name: str, t: Array, limit: Array) -> Array:
    """Restitution at t, the inverse of `table.over_e`."""
    if name == "viscous":
        return table.E_LEAST + t * (1 - table.E_LEAST)
    if name == "plastic_low":
        return table.E_LEAST / (1 - (1 - (1 - t) ** 2) * (1 - table.E_LEAST / limit))
    return 1 - t**4 * (1 - limit)


def _panel(name: str, patches: Sequence[Patch], limit: Array, say: Callable[[str], None]) -> Panel:
    panel = Panel(name, _edges(name, limit), *np.zeros((7, 0)))  # its edges are all that is needed
    sizes = [int(np.prod(patch.cells)) for patch in patches]
    first, total = np.cumsum([0, *sizes[:-1]]), sum(sizes)
    twins, split = np.tile(np.arange(total), (KINDS, 1)), np.ones(total, int)
    fits, extra = [], []
    for number, patch in enumerate(patches):
        values = nodes_of(panel, limit, patch, number)
        fit = fitted(values[:KIND], patch.cells)
        if patch.changes:
            near = _near_a_change(values[KIND], patch)
            fit[:2, :, near] = 0.0  # each kind has cells of its own
            parts = _parts(panel, limit, patch, number, near)
            split[first[number] + near] = parts
            for share in SPLITS:
                some = near[parts == share]
                own, counts = _by_kind(panel, limit, patch, number, some, share)
                here = first[number] + some
                block = share**3
                usual = np.argmax(counts, axis=0)
                for kind in range(KINDS):
                    present = np.flatnonzero(counts[kind])
                    twins[kind, here[present]] = total + block * np.arange(present.size)
                    total += block * present.size
                    extra.append(own[kind][..., present, :].reshape(*own.shape[1:3], -1))
                for kind in range(KINDS):
                    absent = np.flatnonzero(counts[kind] == 0)
                    twins[kind, here[absent]] = twins[usual[absent], here[absent]]
        fits.append(fit)
        say(f"{name}, patch {number + 1} of {len(patches)}: {values[0].size} nodes")
    functions = 3 if name == "viscous" else 2
    return panel._replace(
        roots=np.array([patch.root for patch in patches]),
        shapes=np.array([patch.cells for patch in patches]),
        first=first,
        coefficients=np.concatenate([fit[:functions] for fit in (*fits, *extra)], axis=2),
        reversed=fits[0][2] if name == "plastic_low" else np.zeros((len(table.POWERS), 0)),
        twins=twins if extra else np.zeros((KINDS, 0), int),
        split=split if extra else np.zeros(0, int),
    )


def mended(
    panel: Panel, limit: Array, patches: Sequence[Patch], seed: int, say: Callable[[str], None]
) -> Panel:
    """A panel whose worst cells are fitted anew."""
    coefficients = panel.coefficients.copy()
    for number, patch in enumerate(patches):
        if not patch.changes:
            continue
        at = np.random.default_rng([seed, number]).random((3, TRIED // len(patches)))
        near = at[0] < 1 / 3  # then at one of both ends, from 1e-6 to 1e-1 away
        far = 10 ** (-1 - 15 * at[0])
        at[0] = np.where(near, np.where(at[1] < 0.5, far, 1 - far), at[0])
        y, b, e = impacts(panel, limit, patch, number, *at)
        wanted = solved(panel.name, y, b, e, both_ways(panel, number))
        base, part, kind, cell, place = _where(panel, patch, number, at, y, b, e)
        found = table.polynomial(coefficients[0], cell, list(place))
        bad = np.abs(found - wanted[0]) > MENDED
        _, chosen = np.unique(cell[bad], return_index=True)
        rows = np.flatnonzero(bad)[chosen]
        for row in rows:
            own = kind[row]
            fit = _fit_of_part(panel, limit, patch, number, base[row], part[row], own)
            coefficients[:2, :, cell[row]] = fit
        say(f"{panel.name}, patch {number + 1}: {rows.size} cells fitted anew")
    return panel._replace(coefficients=coefficients)


def _where(
    panel: Panel, patch: Patch, number: int, at: Array, y: Array, b: Array, e: Array
) -> tuple[Integers, Integers, Integers, Integers, Array]:
    """Of places in a patch: cell, its part, kind, the cell that answers and the place there."""
    place = at * np.array(patch.cells)[:, None]
    index = np.minimum(place.astype(int), np.array(patch.cells)[:, None] - 1)
    base = panel.first[number] + np.ravel_multi_index(tuple(index), patch.cells)
    _, varying = table.edges_of(panel, at[1], at[2], b, e)
    kind = table.kind_of(y, varying)
    split = panel.split[base]
    place = (place - index) * split
    inner = np.minimum(place.astype(int), split - 1)
    part = (inner[0] * split + inner[1]) * split + inner[2]
    return base, part, kind, panel.twins[kind, base] + part, place - inner


def _fit_of_part(
    panel: Panel, limit: Array, patch: Patch, number: int, base: int, part: int, own: int
) -> Array:
    """Polynomials of a part of a cell for one kind, shape (2, 20)."""
    place, monomials = _points(MORE_POINTS)
    share = int(panel.split[base])
    corner = np.unravel_index(base - panel.first[number], patch.cells)
    inner = np.unravel_index(part, (share, share, share))
    at = np.array(corner)[:, None] + (np.array(inner)[:, None] + place) / share
    at = at / np.array(patch.cells)[:, None]
    y, b, e = impacts(panel, limit, patch, number, *at)
    values = solved(panel.name, y, b, e, both_ways(panel, number))
    _, varying = table.edges_of(panel, at[1], at[2], b, e)
    weight = np.where(table.kind_of(y, varying) == own, 1.0, MORE_BEYOND)
    return _least_squares(weight, monomials, values[:2]).T


def _near_a_change(kinds: Array, patch: Patch) -> Integers:
    """Cells of a patch with more than one kind at the nodes in and next to them."""
    least, most = kinds, kinds
    for axis, (cells, nodes) in enumerate(zip(patch.cells, patch.nodes, strict=True)):
        low = np.arange(cells) / cells * (nodes - 1) - NEAR
        high = low + 2 * NEAR + (nodes - 1) / cells
        spans = [
            range(max(int(np.floor(one)), 0), min(int(np.ceil(other)), nodes - 1) + 1)
            for one, other in zip(low, high, strict=True)
        ]
        least = np.stack([least.take(span, axis).min(axis) for span in spans], axis)
        most = np.stack([most.take(span, axis).max(axis) for span in spans], axis)
    return np.flatnonzero(least != most)


def _parts(panel: Panel, limit: Array, patch: Patch, number: int, cells: Integers) -> Integers:
    """Into how many parts each way cells are split, by the error of the polynomials of one."""
    own, _ = _by_kind(panel, limit, patch, number, cells, 1)
    place, monomials = _points(POINTS - 1)
    values = _solved_in(panel, limit, patch, number, cells, 1, place)[:, :, 0]
    guess = np.einsum("kfic,pi->kfcp", own[..., 0], monomials)
    kind = values[KIND].astype(int)
    found = np.take_along_axis(guess[:, 0], kind[None], axis=0)[0]
    error = np.abs(found - values[0]).max(axis=1)
    return np.array(SPLITS)[np.searchsorted(patch.worse, error)]


def _by_kind(
    panel: Panel, limit: Array, patch: Patch, number: int, cells: Integers, share: int
) -> tuple[Array, Integers]:
    """Polynomials of cells, split into `share` parts each way, for each kind.

    Returns
    -------
    coefficients : ndarray, shape (kinds, functions, 20, cells, parts)
    counts : ndarray of int, shape (kinds, cells)
        How many points are of a kind.
    """
    place, monomials = _points(POINTS)
    values = _solved_in(panel, limit, patch, number, cells, share, place)
    found, counts = [], []
    for kind in range(KINDS):
        own = values[KIND] == kind
        fit = _least_squares(np.where(own, 1.0, BEYOND), monomials, values[:2])
        found.append(fit.transpose(3, 2, 0, 1))
        counts.append(own.sum(axis=(1, 2)))
    return np.stack(found), np.stack(counts)


def _least_squares(weight: Array, monomials: Array, values: Array) -> Array:
    """Coefficients (..., 20, functions) of values (functions, ..., points) with weights."""
    square = np.einsum("...p,pi,pj->...ij", weight, monomials, monomials)
    right = np.einsum("...p,pi,f...p->...if", weight, monomials, values)
    return np.linalg.solve(square, right)


def _points(count: int) -> tuple[Array, Array]:
    """Points of a cell, shape (3, points), and their monomials."""
    along = (1 - np.cos(np.pi * (np.arange(count) + 0.5) / count)) / 2
    place = np.stack([a.ravel() for a in np.meshgrid(along, along, along, indexing="ij")])
    return place, _monomials(*place)


def _solved_in(
    panel: Panel,
    limit: Array,
    patch: Patch,
    number: int,
    cells: Integers,
    share: int,
    place: Array,
) -> Array:
    """Functions at points of each part of cells, shape (4, cells, parts, points)."""
    corner = np.stack(np.unravel_index(cells, patch.cells))[:, :, None, None]
    part = np.stack(np.unravel_index(np.arange(share**3), (share, share, share)))
    inside = (part[:, None, :, None] + place[:, None, None]) / share
    at = (corner + inside) / np.array(patch.cells)[:, None, None, None]
    y, b, e = impacts(panel, limit, patch, number, *at.reshape(3, -1))
    values = solved(panel.name, y, b, e, both_ways(panel, number))
    return values.reshape(len(values), *at.shape[1:])


def _edges(name: str, limit: Array) -> Array:
    t, u = np.meshgrid(
        np.linspace(0.0, 1.0, EDGES_OVER_E + 1), np.linspace(0.0, 1.0, limit.size), indexing="ij"
    )
    b = b_at(u).ravel()
    e = e_at(name, t, limit).ravel()
    if name == "viscous":
        e = np.minimum(e, VISCOUS)
        found = [thresholds.friction_falls(b, e), thresholds.lasts_to_largest_force(b, e)]
    elif name == "plastic_low":
        middle, whole = thresholds.middle_slips(b, e)
        whole = np.where(whole < 1, _slips_twice(b, e, middle, whole), whole)
        found = [np.minimum(middle, 1.0), thresholds.lasts_to_yield(b, e), whole]
    else:
        found = [thresholds.middle_slips_again(b, e)]
    found = [edge.reshape(t.shape) for edge in found]
    if name != "viscous":  # they need less accuracy: every other one is enough
        coarse = tuple(grid.reshape(t.shape)[::2, ::2] for grid in (b, e))
        sought = _changes(*(grid.ravel() for grid in coarse))
        found += [_doubled(edge.reshape(coarse[0].shape)) for edge in sought]
    return np.stack(found)


def _slips_twice(b: Array, e: Array, low: Array, high: Array) -> Array:
    """Incidence from which `inelastic` calls it gross slip, as friction is so near to its limit."""
    for _ in range(HALVINGS):
        middle = (low + high) / 2
        twice = np.empty(b.size, dtype=bool)
        for start in range(0, b.size, TOGETHER):
            part = slice(start, start + TOGETHER)
            one = np.ones_like(b[part])
            path = inelastic.path(middle[part], b[part], one, e[part], "plastic", 2 * STEPS)
            gross = (np.abs(path.friction) >= inelastic.GROSS * path.normal)[1:-1]
            twice[part] = np.sum(gross[1:] & ~gross[:-1], axis=0) > 1
        low, high = np.where(twice, low, middle), np.where(twice, middle, high)
    return high


def _doubled(grid: Array) -> Array:
    """A grid with the means of neighbours between them."""
    for _ in range(2):
        fine = np.repeat(grid, 2, axis=0)[:-1]
        fine[1::2] = (grid[1:] + grid[:-1]) / 2
        grid = fine.T
    return grid


def nodes_of(panel: Panel, limit: Array, patch: Patch, number: int) -> Array:
    """Velocity, peak friction and a third function at the nodes of a patch.

    The third function is the work of friction with viscous loss; with plastic loss it is the
    largest friction against the first direction, and the second that in the first direction, where
    the contact sticks until its middle slips; else 0.

    Parameters
    ----------
    panel : Panel
        Its name and edges.
    limit : ndarray, shape (nu + 1,)
    patch : Patch
    number : int
        Of the patch, from 0.

    Returns
    -------
    ndarray, shape (4, s, t, u)
        The last is the kind, as `table.kind_of` has it.
    """
    s, t, u = np.meshgrid(*(np.linspace(0.0, 1.0, count) for count in patch.nodes), indexing="ij")
    y, b, e = impacts(panel, limit, patch, number, s.ravel(), t.ravel(), u.ravel())
    return solved(panel.name, y, b, e, both_ways=both_ways(panel, number)).reshape(4, *patch.nodes)


def both_ways(panel: Panel, number: int) -> bool:
    """Whether a patch keeps the largest friction of each direction."""
    return panel.name == "plastic_low" and number == 0


def impacts(
    panel: Panel, limit: Array, patch: Patch, number: int, s: Array, t: Array, u: Array
) -> tuple[Array, Array, Array]:
    """y, b and e at places of a patch."""
    b = b_at(u)
    e = e_at(panel.name, t, np.interp(u, np.linspace(0.0, 1.0, limit.size), limit))
    edges, _ = table.edges_of(panel, t, u, b, e)
    low, high = edges[number : number + 2]
    share = {EVEN: s, LEFT: s**2, RIGHT: 1 - (1 - s) ** 2}[patch.root]
    return low + (high - low) * share, b, e


def solved(name: str, y: Array, b: Array, e: Array, both_ways: bool) -> Array:
    """The functions of `nodes_of`, shape (4, n)."""
    loss = name.partition("_")[0]
    found = np.empty((4, y.size))
    y = np.maximum(y, LEAST_INCIDENCE)
    elastic = e >= ELASTIC
    result = continuum.rebound(y[elastic], b[elastic], 1.0, tolerance=1e-6)
    found[:KIND, elastic] = result.velocity, result.peak_friction, result.dissipation
    found[KIND, elastic] = _kinds(y[elastic], b[elastic], e[elastic], loss)
    rest = np.flatnonzero(~elastic)
    rest = rest[np.lexsort((b[rest], e[rest]))]  # the same e is solved once
    for start in range(0, rest.size, TOGETHER):
        rows = rest[start : start + TOGETHER]
        coarse, fine = (
            _functions(
                inelastic.path(y[rows], b[rows], np.ones(rows.size), e[rows], loss, steps),
                loss,
                both_ways,
            )
            for steps in (STEPS, 2 * STEPS)
        )
        found[:, rows] = fine + (fine - coarse) / 3
        found[KIND, rows] = fine[KIND]
    return found


def _functions(path: inelastic.Path, loss: str, both_ways: bool) -> Array:
    velocity = path.velocity[-1]
    if loss == "viscous":
        return np.stack([velocity, path.peak, path.work, _kind(path)])
    if both_ways:
        forward, back = (_largest(path.time, side * path.friction) for side in (1.0, -1.0))
        return np.stack([velocity, forward, back, _kind(path)])
    return np.stack([velocity, path.peak, np.zeros_like(velocity), _kind(path)])


def _kind(path: inelastic.Path) -> Array:
    """As `table.kind_of`."""
    returns = path.velocity[len(path.velocity) // 2] < 0
    return 2.0 * returns + (path.friction[-2] <= 0)


def _kinds(y: Array, b: Array, e: Array, loss: str) -> Array:
    found, e = np.empty(y.size), np.minimum(e, ELASTIC)
    for start in range(0, y.size, TOGETHER):
        part = slice(start, start + TOGETHER)
        one = np.ones_like(y[part])
        found[part] = _kind(inelastic.path(y[part], b[part], one, e[part], loss, STEPS))
    return found


def _changes(b: Array, e: Array) -> list[Array]:
    """Incidences between which the last slip is forward, and between which the contact returns."""
    every = np.arange(b.size)
    y = np.linspace(0.0, 1.0, PLACES + 1)[:, None] * b
    kinds = _kinds(y[1:].ravel(), np.tile(b, PLACES), np.tile(e, PLACES), "plastic")
    kinds = kinds.reshape(PLACES, -1)
    found: list[Array] = []
    for is_so in (lambda kind: kind % 2 == 0, lambda kind: kind >= 2):
        so = is_so(kinds)
        last = PLACES - 1 - np.argmax(so[::-1], axis=0)
        # The first of those next to the last one.
        other = np.where(~so & (np.arange(PLACES)[:, None] < last), np.arange(PLACES)[:, None], -1)
        first = other.max(axis=0) + 1
        for place, ahead in ((first, False), (last + 1, True)):
            low, high = y[place, every], y[np.minimum(place + 1, PLACES), every]
            for _ in range(HALVINGS):
                middle = (low + high) / 2
                same = is_so(_kinds(middle, b, e, "plastic")) == ahead
                low, high = np.where(same, middle, low), np.where(same, high, middle)
            found.append(np.where(so.any(axis=0), (low + high) / 2, 0.0))
        found[-2] = np.where(first == 0, 0.0, found[-2])
    return found


def _largest(time: Array, force: Array) -> Array:
    """Largest force, by the parabola through the largest instant and its neighbours."""
    top = np.clip(np.argmax(force, axis=0), 1, len(force) - 2)
    column = np.arange(top.size)
    (t0, f0), (t1, f1), (t2, f2) = (
        (time[top + k, column], force[top + k, column]) for k in (-1, 0, 1)
    )
    rise, fall = (f1 - f0) / (t1 - t0), (f2 - f1) / (t2 - t1)
    bend = np.minimum((fall - rise) / (t2 - t0), -1e-300)
    at = np.clip((t0 + t1) / 2 - rise / (2 * bend), t0, t2)
    return f0 + (at - t0) * (rise + bend * (at - t1))


def fitted(values: Array, cells: tuple[int, ...]) -> Array:
    """Polynomials of cells, from values at nodes that are spread evenly over a patch.

    Parameters
    ----------
    values : ndarray, shape (functions, s, t, u)
    cells : tuple of int
        Over s, t and u.

    Returns
    -------
    ndarray, shape (functions, 20, cells)

    Examples
    --------
    >>> nodes = np.linspace(0.0, 1.0, 5)
    >>> s, t, u = np.meshgrid(nodes, nodes, nodes, indexing="ij")
    >>> fit = fitted((s**3 + t * u)[None], (2, 1, 1))[0]
    >>> place = [np.array([0.5]), np.array([0.5]), np.array([0.2])]
    >>> float(table.polynomial(fit, np.array([1]), place)[0].round(6))  # s = 0.75
    0.521875
    """
    count = table.DEGREE + 2
    places = (1 - np.cos(np.pi * (np.arange(count) + 0.5) / count)) / 2
    for axis, number in enumerate(cells, start=1):
        nodes = np.linspace(0.0, 1.0, values.shape[axis])
        fine = ((np.arange(number)[:, None] + places) / number).ravel()
        values = make_interp_spline(nodes, values, k=3, axis=axis)(fine)
    split = [size for number in cells for size in (number, count)]
    values = values.reshape(-1, *split).transpose(0, 1, 3, 5, 2, 4, 6)
    values = values.reshape(len(values), np.prod(cells), count**3)
    monomials = _monomials(*(a.ravel() for a in np.meshgrid(*3 * [places], indexing="ij")))
    return (values @ np.linalg.pinv(monomials).T).transpose(0, 2, 1)


def _monomials(s: Array, t: Array, u: Array) -> Array:
    return np.stack([s**i * t**j * u**k for i, j, k in table.POWERS], axis=1)
