"""One loop for every contact that is linear between its events, n contacts at once.

**The method.** Between two events the state z of a contact obeys

    z' = A z.                                                   (1)

An event is where a row, a linear form of z, falls through zero:

    r.z + r0 = 0.                                               (2)

A phase is the time between two events. Within one step h of a phase z is its Taylor series,

    z(t h) = sum of c[k] t^k,   0 <= t <= 1,                    (3)
    c[0] = z,   c[k] = h A c[k - 1]/k.                          (4)

TERMS terms give z to rounding if h |A| is at most REACH. By (3) a row is a polynomial of t,

    p(t) = sum of (r.c[k]) t^k + r0,                            (5)

and its first zero is found by a march that cannot pass it (`_first_zero`). With the least of these
zeros, t1 <= 1, the step ends at z(t1 h); without one it ends at t1 = 1. Impulses and work follow
from the same series:

    integral of z = h sum of c[k] t1^(k + 1)/(k + 1),           (6)
    work = integral of p q, by Gauss's nodes on 0 to t1,        (7)

where p is a force and q the velocity on which it acts, both rows. At an event the contact says in
which phase it goes on. It also sets what is zero or equal there to the last digit.

**Ties.** A row often starts at zero: where slip has just stopped, mu N - F is zero, and so is its
rate. A coefficient of (5) counts as zero if it is a rounding error of its own terms. The first one
that is not decides. If it is negative, the row falls: the event is now. If it is positive, the
row rises and must fall again first. Its zero at the start, which is no event, is divided out with
the power of t that the zeros leave. A row that is zero throughout never falls.

`off_centre`, `closed` and `viscous` are contacts of this kind; `runs` makes the history of one.
Arrays have the contacts last: states (d, n), matrices (d, d, n), rows (m, d + 1, n) with r0 last.
"""

from typing import Any, NamedTuple, Protocol, Self, TypeVar

import numpy as np

from planarimpact.common.arrays import Array, Booleans, Integers

# Terms of a series, and its step times the rate of the fastest motion: REACH^TERMS/TERMS! is less
# than a rounding error.
TERMS, REACH = 24, 2.0
# Coefficients below this share of their terms count as zero. If as many as DECIDING do, all do.
TIE, DECIDING = 1e-14, 8
# Contacts that take a step together: their series fit a cache. And that are followed together:
# plans of more would take too much memory, some kilobyte each.
BLOCK, CHUNK = 1024, 32768
# A contact that takes more steps is given up; one with omega/Omega = 1e4 takes some 15 000.
MOST_STEPS = 40_000
# No step is longer than that of this rate.
SLOWEST = 0.1
# Steps of a march, the relative step that ends it, and what no divisor is less than.
MOST_IN_MARCH, LAST, LEAST = 300, 4e-16, 1e-300
# Steps from a node to a largest value; their error falls from 0.1 rad as its third power.
NEWTON_STEPS = 4
DEGREE = np.arange(TERMS)[:, None]
FACTORIAL = np.cumprod(np.maximum(DEGREE, 1.0))[:, None, None]
# Gauss's nodes on 0 to 1 and both ends, with their powers (nodes, TERMS). By the weights the
# integral of a product of two series is exact to rounding.
NODES, WEIGHTS = np.polynomial.legendre.leggauss(10)
NODES, WEIGHTS = np.array([0.0, *(1 + NODES) / 2, 1.0]), np.array([0.0, *WEIGHTS / 2, 0.0])
NODE_POWERS = (NODES**DEGREE).T

_Fields = TypeVar("_Fields", bound=tuple[Any, ...])


class Contacts(Protocol):
    """What `follow` asks of n contacts. `who` are the indices of some of them, k in number.

    A contact may be there alone, or twice. Sum over no axis in these methods, as NumPy does that
    for one contact in another order than for many: its last bits would depend on the others. A
    contact may count the time of a phase in a unit of its own; what has passed is in that unit.
    """

    def matrix(self, who: Integers) -> Array:
        """A of the phases that these contacts are in, shape (d, d, k)."""

    def rows(self, who: Integers) -> Array:
        """Rows of their events, shape (m, d + 1, k). A row not in use is a positive constant."""

    def power(self, who: Integers) -> Array:
        """Rows of a force and of the velocity on which it acts, shape (2, d + 1, k)."""

    def switch(self, who: Integers, z: Array, event: Integers, passed: "Passed") -> Booleans:
        """Begin their next phases after these events: change z (d, k); return which have ended."""

    def phase(self) -> Any:
        """Of a single contact: what tells its present phase from the one before and after."""


class Passed(NamedTuple):
    """What a phase has summed up, arrays whose last axis are the contacts."""

    time: Array  # its duration, shape (n,)
    work: Array  # integral of force times velocity, shape (n,)
    largest: Array  # size of the force, shape (n,)
    integral: Array  # of each state over the time, shape (d, n)

    @classmethod
    def nothing(cls, states: int, n: int) -> Self:
        """Before a phase."""
        return cls(np.zeros(n), np.zeros(n), np.zeros(n), np.zeros((states, n)))


class Step(NamedTuple):
    """A step of one contact: its series (TERMS, d), its length, and the share of it that was taken.

    `phase` is what the contact says of the phase that it is in.
    """

    phase: Any
    series: Array
    length: float
    share: float


def follow(
    contacts: Contacts, z: Array, who: Integers | None = None, steps: list[Step] | None = None
) -> Integers:
    """Follow contacts to their end: changes the states z (d, n) of all, or of those in `who`.

    A list `steps` gets those of a single contact, which has a `phase`. Returns the indices of the
    contacts that are given up after MOST_STEPS.

    Examples
    --------
    A mass between two springs strikes with unit velocity: contact ends after half a period.

    >>> class Spring:
    ...     def matrix(self, who):
    ...         return np.stack([[[0.0, 1.0], [-1.0, 0.0]]] * who.size, axis=-1)
    ...     def rows(self, who):
    ...         return np.stack([[[1.0, 0.0, 0.0]]] * who.size, axis=-1)  # the deflection
    ...     def power(self, who):
    ...         return np.zeros((2, 3, who.size))
    ...     def switch(self, who, z, event, passed):
    ...         self.time = float(passed.time[0])
    ...         return who >= 0
    >>> spring, z = Spring(), np.array([[0.0], [1.0]])
    >>> follow(spring, z).size, round(spring.time, 14) == round(np.pi, 14)
    (0, True)
    """
    who = _not_alone(np.arange(z.shape[1]) if who is None else who)
    if who.size > CHUNK:
        parts = np.split(who, range(CHUNK, who.size, CHUNK))
        return np.concatenate([follow(contacts, z, part) for part in parts])
    plan = _Plan.of(contacts, who)
    passed = Passed.nothing(len(z), who.size)
    for _ in range(MOST_STEPS):
        if not who.size:
            break
        blocks = [slice(start, start + BLOCK) for start in range(0, who.size, BLOCK)]
        ends = [
            _advance(_views(plan, b), z.take(who[b], axis=1), _views(passed, b)) for b in blocks
        ]
        if steps is not None:
            [(series, share, *_)] = ends
            step = series[..., 0], float(plan.length[0]), float(share[0])
            steps.append(Step(contacts.phase(), *step))
        z[:, who] = np.concatenate([end.z for end in ends], axis=1)
        event = np.concatenate([end.event for end in ends])
        hit = np.flatnonzero(event >= 0)
        if not hit.size:
            continue
        at_event = z.take(who[hit], axis=1)
        ended = contacts.switch(who[hit], at_event, event[hit], _taken(passed, hit))
        z[:, who[hit]] = at_event
        for total in passed:
            total[..., hit] = 0.0
        going = hit[~ended]
        if going.size:
            for field, fresh in zip(plan, _Plan.of(contacts, who[going]), strict=True):
                field[..., going] = fresh
        if ended.any():
            left = _not_alone(np.delete(np.arange(who.size), hit[ended]))
            who, plan, passed = who[left], _taken(plan, left), _taken(passed, left)
    return np.unique(who)


def _not_alone(which: Integers) -> Integers:
    """Indices, twice if it is one: NumPy sums over one contact in another order than over more."""
    return np.repeat(which, 2) if which.size == 1 else which


class _Plan(NamedTuple):
    """The present phases: matrices times the length of a step, rows, power, and that length."""

    matrix: Array
    rows: Array
    power: Array
    length: Array

    @classmethod
    def of(cls, contacts: Contacts, who: Integers) -> Self:
        """Of the phases that these contacts are in."""
        matrix = contacts.matrix(who)
        # |A^4|^(1/4) comes close to the fastest rate, whatever the units of the states.
        square = np.einsum("ijn,jkn->ikn", matrix, matrix)
        fourth = np.abs(np.einsum("ijn,jkn->ikn", square, square)).sum(axis=1).max(axis=0)
        length = REACH / np.maximum(fourth, SLOWEST**4) ** 0.25
        return cls(matrix * length, contacts.rows(who), contacts.power(who), length)


class _End(NamedTuple):
    """The end of a step: its series, the share that was taken, states, and event, -1 for none."""

    series: Array
    share: Array
    z: Array
    event: Integers


def _taken(fields: _Fields, which: Integers) -> _Fields:
    """Some of the contacts of a tuple of arrays, in the order in memory that is fast."""
    return type(fields)(*(field.take(which, axis=-1) for field in fields))


def _views(fields: _Fields, part: slice) -> _Fields:
    """A part of the contacts of a tuple of arrays, which can be written to."""
    return type(fields)(*(field[..., part] for field in fields))


def _advance(plan: _Plan, z: Array, passed: Passed) -> _End:
    """Take a step, or go to the first event in it; adds to `passed`, where that is a view."""
    series = _series(plan.matrix, z, TERMS)
    share, event = _first_event(plan, series)
    powers = _powers(share)
    taken = plan.length * share
    passed.time[...] += taken
    passed.integral[...] += taken * np.einsum("kn,kdn->dn", powers / (DEGREE + 1), series)
    factors = _polynomials(plan.power, series) * powers[:, None]
    force, velocity = np.einsum("qk,kmn->mqn", NODE_POWERS, factors)
    passed.work[...] += taken * np.einsum("q,qn->n", WEIGHTS, force * velocity)
    largest = np.where(share > 0, _largest(factors[:, 0], force), 0.0)
    passed.largest[...] = np.maximum(passed.largest, largest)
    return _End(series, share, np.einsum("kn,kdn->dn", powers, series), event)


def _series(matrix: Array, z: Array, terms: int) -> Array:
    """Coefficients (terms, d, n) of the states over one step."""
    series = np.empty((terms, *z.shape))
    series[0] = z
    for k in range(1, terms):
        np.einsum("ijn,jn->in", matrix, series[k - 1], out=series[k])
    series /= FACTORIAL[:terms]
    return series


def _polynomials(rows: Array, series: Array) -> Array:
    """Coefficients (TERMS, m, n) of rows."""
    polynomials = np.einsum("mdn,kdn->kmn", rows[:, :-1], series)
    polynomials[0] += rows[:, -1]
    return polynomials


def _powers(t: Array) -> Array:
    """t^k, shape (TERMS, n)."""
    powers = np.ones((TERMS, t.size))
    powers[1:] = t
    return np.multiply.accumulate(powers, axis=0, out=powers)


def _first_event(plan: _Plan, series: Array) -> tuple[Array, Integers]:
    """Share of the step at which the first row of each contact falls through zero, and which.

    Where none does they are 1 and -1.
    """
    polynomials = _polynomials(plan.rows, series)
    start = polynomials[0]
    floor = start + np.minimum(polynomials[1:], 0.0).sum(axis=0)  # a lower bound, as t <= 1
    sizes = np.abs(plan.rows)
    size = np.einsum("mdn,dn->mn", sizes[:, :-1], np.abs(series[0])) + sizes[:, -1]
    at_zero = np.abs(start) <= TIE * size
    row, contact = np.divmod(_not_alone(np.flatnonzero((floor <= 0) | at_zero)), start.shape[1])
    if not row.size:
        return np.ones(start.shape[1]), np.full(start.shape[1], -1)
    falling = polynomials[:, row, contact]
    tied = _not_alone(np.flatnonzero(at_zero[row, contact]))
    if tied.size:
        which = contact[tied]
        matrix, z = plan.matrix.take(which, axis=-1), series[0].take(which, axis=-1)
        terms = _series(np.abs(matrix), np.abs(z), DECIDING)
        own = np.ascontiguousarray(sizes[row[tied], :-1, which].T)
        noise = np.einsum("dn,kdn->kn", own, terms)
        noise[0] = size[row[tied], which]
        falling[:, tied] = _decided(falling[:, tied], TIE * noise)
    zeros = np.full(start.shape, np.inf)
    zeros[row, contact] = _first_zero(falling)
    nearest = zeros.min(axis=0)
    return np.minimum(nearest, 1.0), np.where(nearest <= 1, zeros.argmin(axis=0), -1)


def _largest(polynomials: Array, values: Array) -> Array:
    """Largest size on 0 to 1 of polynomials (TERMS, n), with their values at NODES.

    Newton's method goes from each node with a size as large as at its neighbours to the zero of the
    slope beside it. An end is such a node if the slope there leads inward.
    """
    sizes, end_slope = np.abs(values), (DEGREE * polynomials).sum(axis=0)
    before = np.where(np.sign(polynomials[1]) == np.sign(values[0]), 0.0, np.inf)
    after = np.where(np.sign(end_slope) == -np.sign(values[-1]), 0.0, np.inf)
    tops = (sizes >= np.vstack([before, sizes[:-1]])) & (sizes >= np.vstack([sizes[1:], after]))
    largest = sizes.max(axis=0)
    node, which = np.divmod(_not_alone(np.flatnonzero(tops)), largest.size)
    if which.size:
        derivatives, t = _derivatives(polynomials.take(which, axis=1), 3), NODES[node]
        for _ in range(NEWTON_STEPS):
            _, slope, bend = np.einsum("kn,bkn->bn", _powers(t), derivatives)
            t = np.clip(t - slope / np.where(bend == 0, 1.0, bend), 0.0, 1.0)
        value = (_powers(t) * derivatives[0]).sum(axis=0)
        np.maximum.at(largest, which, np.abs(value))
    return largest


def _derivatives(polynomials: Array, count: int) -> Array:
    """Coefficients (count, TERMS, n) of polynomials (TERMS, n) and of their derivatives."""
    derivatives = np.zeros((count, *polynomials.shape))
    derivatives[0] = polynomials
    for k in range(1, count):
        derivatives[k, :-1] = DEGREE[1:] * derivatives[k - 1, 1:]
    return derivatives


def _decided(polynomials: Array, noise: Array) -> Array:
    """Polynomials that start at zero, over the power of t that makes them start elsewhere."""
    is_zero = np.abs(polynomials[:DECIDING]) <= noise
    zeros = np.logical_and.accumulate(is_zero, axis=0).sum(axis=0)
    padded = np.concatenate([polynomials, np.zeros_like(polynomials)])
    decided = np.take_along_axis(padded, DEGREE + zeros, axis=0)
    decided[:, zeros == DECIDING] = 1.0  # any that never falls
    return decided


def _first_zero(polynomials: Array) -> Array:
    """First zero in 0 to 1 of polynomials (TERMS, n); infinite where there is none.

    If |p''| <= bend within a window from t on, p + p' h - bend h^2/2 is a lower bound of p there.
    The march steps from zero to zero of this bound, and comes to a zero of p from below:
    quadratically, or linearly to a double or triple one. Where p starts below zero, that is at 0.
    """
    largest = np.abs(polynomials).max(axis=0)  # of order 1 no square leaves the range of numbers
    derivatives = _derivatives(polynomials / np.where(largest > 0, largest, 1.0), 5)
    largest, derivatives = np.abs(derivatives[4]).sum(axis=0) / 2, derivatives[:4]
    zero, left = np.full(largest.size, np.inf), np.arange(largest.size)
    t, window = np.zeros(left.size), np.ones(left.size)
    for _ in range(MOST_IN_MARCH):
        value, slope, second, third = np.einsum("kn,bkn->bn", _powers(t), derivatives)
        bend = np.abs(second) + window * (np.abs(third) + window * largest) + LEAST
        root = np.sqrt(slope * slope + 2 * bend * np.maximum(value, 0.0))
        step = np.where(slope > 0, (slope + root) / bend, 2 * value / (root - slope + LEAST))
        step = np.where(value > 0, np.minimum(step, window), 0.0)
        # The zero is at most bend step^2/root farther than the next t.
        t, window = t + step, 2 * step
        found = bend * step * step <= LAST * t * root
        zero[left[found]] = t[found]
        going = ~found & (t <= 1)
        if not going.all():
            going = _not_alone(np.flatnonzero(going))
            left, t, window, largest = left[going], t[going], window[going], largest[going]
            derivatives = derivatives.take(going, axis=-1)
            if not left.size:
                break
    zero[left] = t  # a zero of higher order
    return zero
