"""Incidences where the answer of a continuum bends, for spheres.

All of them are in y = x/zeta^2, as functions of b = beta/zeta^2 and e: the tangential motion of a
continuum, over zeta^2, depends on these three numbers alone. Up to y = 1 a contact sticks at first.
From there on it slides until its body is as slow as its springs, which is at the normal velocity
(b - y)/(b - 1). So slip lasts through compression from y = b on.

**Viscous spheres.** When that slip ends at the normal velocity v, friction changes at the rate
2 a (v - tau b F) + tau v^2/a, with the radius a and the force F: the springs that touch, and those
that come to touch with the velocity v of a dashpot. Friction is largest at the end of slip where
that rate is negative, and 1 where slip lasts to the largest force.

**Plastic spheres.** The density of the limit of friction is q (a^2 - r^2) with the bluntness q,
which is 1 until yield and falls from then on (`continuum.inelastic.thornton`). A spring at r that
has stuck from touch on is stretched by u(t) - u(t_r). If every spring sticks, the middle is the
first to reach its limit, where u = q a^2, and all of them slip where u' = q v. The displacement u
of a contact that sticks is in proportion to y.
"""

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from planarimpact.continuum.inelastic.kelvin_voigt import KelvinVoigt
from planarimpact.ground.arrays import Array, Booleans
from planarimpact.normal_impact import hertz, thornton

# Steps of a compression, of the method of Runge and Kutta. With twice as many no threshold moves
# by more than 1e-6.
STEPS = 2000
# No compression lasts longer (Hertz': 1.47 in these units, and yield makes it longer by a third).
LONGEST = 2.2
HALVINGS = 30


def friction_falls(b: Array, e: Array) -> Array:
    """Viscous: incidence from which friction falls as soon as the first slip ends, shape (n,).

    Examples
    --------
    >>> float(friction_falls(np.array([2.5]), np.array([0.5]))[0].round(3))
    1.426
    """
    motion = KelvinVoigt(e)
    low, high = motion.velocity_at_largest_force.copy(), np.ones(e.size)
    for _ in range(HALVINGS):
        v = (low + high) / 2
        approach, force = motion.compressed(v)
        rises = v + motion.tau * v**2 / (2 * approach) > motion.tau * b * force
        low, high = np.where(rises, low, v), np.where(rises, v, high)
    return _slips_until(low, b)


def lasts_to_largest_force(b: Array, e: Array) -> Array:
    """Viscous: incidence from which the first slip lasts to the largest force, shape (n,).

    Examples
    --------
    >>> float(lasts_to_largest_force(np.array([2.5]), np.array([0.5]))[0].round(3))
    1.912
    """
    return _slips_until(KelvinVoigt(e).velocity_at_largest_force, b)


def lasts_to_yield(b: Array, e: Array) -> Array:
    """Plastic: incidence from which the first slip lasts to yield, shape (n,).

    Examples
    --------
    >>> float(lasts_to_yield(np.array([2.5]), np.array([0.8]))[0].round(3))
    1.041
    """
    yields = thornton.compression(e).yields
    return _slips_until(np.sqrt(np.maximum(1 - 2 * hertz.ENERGY * yields**2.5, 0.0)), b)


def middle_slips(b: Array, e: Array) -> tuple[Array, Array]:
    """Plastic: incidences from which the middle slips, and all slips, in compression.

    The contact sticks at first and then everywhere: incidences above 1 have no meaning.

    Parameters
    ----------
    b, e : ndarray, shape (n,)

    Returns
    -------
    middle, whole : ndarray, shape (n,)

    Examples
    --------
    >>> [float(y[0].round(3)) for y in middle_slips(np.array([2.5]), np.array([0.5]))]
    [0.496, 0.62]
    """
    zero, one = np.zeros(e.size), np.ones(e.size)
    middle, whole = np.full((2, e.size), np.inf)
    for now in _compression(b, e, _State(zero, one, zero, one, zero)):
        middle = np.where(now.counts, np.minimum(middle, now.blunt * now.depth / now.u), middle)
        whole = np.where(now.counts, np.minimum(whole, now.blunt * now.v / now.w), whole)
    return middle, whole


def middle_slips_again(b: Array, e: Array) -> Array:
    """Plastic: incidence above 1 from which the middle slips again in compression, shape (n,).

    Examples
    --------
    >>> float(middle_slips_again(np.array([1.6]), np.array([0.95]))[0].round(3))
    1.092
    """
    low, high = np.ones(e.size), lasts_to_yield(b, e)
    for _ in range(HALVINGS):
        y = (low + high) / 2
        again = _again(y, b, e)
        low, high = np.where(again, low, y), np.where(again, y, high)
    return low


def early_limit(b: Array) -> Array:
    """Plastic: restitution below which the middle slips already at y = 1, shape (n,).

    Examples
    --------
    >>> early_limit(np.array([1.6, 3.5])).round(3)
    array([0.899, 0.799])
    """
    low, high = np.full(b.size, 0.5), np.full(b.size, 0.99)
    for _ in range(HALVINGS):
        e = (low + high) / 2
        late = middle_slips(b, e)[0] >= 1
        low, high = np.where(late, low, e), np.where(late, e, high)
    return low


def _slips_until(v: Array, b: Array) -> Array:
    """Incidence at which the first slip ends at a normal velocity."""
    return b - (b - 1) * v


class _State(NamedTuple):
    """Approach and normal velocity, friction, velocity and displacement of the body over zeta^2."""

    depth: Array
    v: Array
    friction: Array
    w: Array
    u: Array


class _Instant(NamedTuple):
    """A state after yield while the body moves on, where `counts`."""

    depth: Array
    v: Array
    w: Array
    u: Array
    blunt: Array
    counts: Booleans


def _compression(b: Array, e: Array, state: _State) -> Iterator[_Instant]:
    """Compression of a plastic contact that sticks everywhere, with friction 2 a u'."""
    law = thornton.compression(e)
    step = LONGEST / STEPS

    def rates(s: Array) -> Array:
        depth, v, friction, w, _ = s
        elastic = 4 / 3 * np.maximum(depth, 0.0) ** 1.5
        force = np.where(depth > law.yields, law.rate**2 * (depth - law.centre), elastic)
        return np.stack([v, -force, 2 * np.sqrt(np.maximum(depth, 0.0)) * w, -b * friction, w])

    s, moves = np.stack(state), np.ones(e.size, dtype=bool)
    while moves.any():
        first = rates(s)
        second = rates(s + step / 2 * first)
        third = rates(s + step / 2 * second)
        s = s + step / 6 * (first + 2 * second + 2 * third + rates(s + step * third))
        depth, v, _, w, u = s
        moves = moves & (v > 0) & (w > 0)
        hertzian = 4 / 3 * np.maximum(depth, law.yields) ** 1.5
        blunt = law.rate**2 * (depth - law.centre) / hertzian
        yield _Instant(depth, v, w, u, blunt, moves & (depth > law.yields))


def _again(y: Array, b: Array, e: Array) -> Booleans:
    """Whether the middle slips in compression once more after a first slip that ended in it."""
    v = (b - y) / (b - 1)
    depth = ((1 - v**2) / (2 * hertz.ENERGY)) ** 0.4
    again = np.zeros(e.size, dtype=bool)
    for now in _compression(b, e, _State(depth, v, 4 / 3 * depth**1.5, v, np.zeros(e.size))):
        again |= now.counts & (now.blunt * now.depth - depth < now.u)
    return again
