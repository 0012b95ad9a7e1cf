"""Incidences where the answer of a continuum bends, for spheres.

All of them are in y = x/zeta^2, as functions of b = beta/zeta^2 and e: the tangential motion of a
continuum, over zeta^2, depends on these three numbers alone. Up to y = 1 a contact sticks at first.
From there on it slides until its body is as slow as its springs, which is at the normal velocity
(b - y)/(b - 1). So slip lasts through compression from y = b on.

**Viscous spheres.** When that slip ends at the normal velocity v, friction changes at the rate
2 a (v - tau b F) + tau v^2/a, with the radius a and the force F: the springs that touch, and those
that come to touch with the velocity v of a dashpot. Friction is largest at the end of slip where
that rate is negative, and 1 where slip lasts to the largest force.

**Plastic spheres.** The answer bends where friction is at its limit everywhere at the end of
compression: it is largest from there on. A sphere that loses little slides until then; one that
loses much slides again at the end, when shear has flowed so far that the body still moves on. And
it bends where slip throughout begins (`PlasticMotion.slides_from`). Where spheres lose much, it
bends at one incidence more. The table has no edge there, so that its error is larger.
"""

from typing import Any

import numpy as np

from planarimpact.common import roots, sliding
from planarimpact.common.arrays import Array
from planarimpact.continuum import inelastic
from planarimpact.continuum.inelastic.plastic import PlasticMotion
from planarimpact.continuum.inelastic.viscous import ViscousMotion
from planarimpact.normal_impact import kelvin_voigt, yielding

# Steps of the continuum, and impacts solved together.
STEPS, TOGETHER = 256, 256
# Resolution of an incidence that is searched by solving the continuum.
COARSE = 2.0**-14


def friction_falls(b: Array, e: Array) -> Array:
    """Viscous: (y - 1)/(b - 1) from which friction falls as the first slip ends, shape (n,).

    Examples
    --------
    >>> float(friction_falls(np.array([2.5]), np.array([0.5]))[0].round(3))
    0.284
    """
    taus, compression, _ = kelvin_voigt.halves(tuple(e.tolist()))

    def fall(which: Any, v: Array) -> tuple[Array]:
        half, tau = compression.taken(which), taus[which]
        radius = half.at(half.crossing(1, v[None]))[0, 0]
        force = 4 / 3 * radius**3 + 2 * tau * radius * v
        return (tau * b[which] * force - v - tau * v**2 / (2 * radius**2),)

    v = roots.crossing(fall, ViscousMotion(e).velocity_at_largest_force, np.ones(e.size))
    return 1 - v


def lasts_to_largest_force(b: Array, e: Array) -> Array:
    """Viscous: (y - 1)/(b - 1) from which the first slip lasts to the largest force, shape (n,).

    Examples
    --------
    >>> float(lasts_to_largest_force(np.array([2.5]), np.array([0.5]))[0].round(3))
    0.608
    """
    return 1 - ViscousMotion(e).velocity_at_largest_force


def slides_at_the_end(b: Array, e: Array) -> Array:
    """Plastic: incidence from which friction is at its limit at the end of compression, shape (n,).

    Examples
    --------
    >>> slides_at_the_end(np.array([2.9, 2.9]), np.array([0.9, 0.45])).round(2)
    array([2.9 , 2.93])
    """
    one, end = np.ones_like(b), STEPS // 2

    def sticks(which: Any, y: Array) -> tuple[Array]:
        below_limit = np.empty(y.size)
        for start in range(0, y.size, TOGETHER):
            part = slice(start, start + TOGETHER)
            beta, zeta2, restitution = (a[which][part] for a in (b, one, e))
            path = inelastic.path(y[part], beta, zeta2, restitution, PlasticMotion, STEPS)
            below_limit[part] = inelastic.GROSS * path.normal[end] - path.friction_force[end]
        return (np.where(below_limit > 0, 1.0, -1.0),)

    return roots.crossing(sticks, np.zeros_like(b), slides_from(b, e), resolution=COARSE)


def limits(b: Array) -> Array:
    """Plastic: two restitutions, shape (2, n), at which the phases of contact change.

    Below the second, the middle of a contact with y = b sticks for a while before the end of
    compression. Below the first, that happens even where `limit_alike` says slip throughout.

    Examples
    --------
    >>> limits(np.array([1.6, 3.5])).round(3)
    array([[0.692, 0.485],
           [0.831, 0.618]])
    """
    low, high = np.full((2, b.size), [[0.3], [1 - 1e-9]])

    def at_all(which: Any, e: Array) -> tuple[Array]:
        alike = sliding.limit_alike(b[which], 1.0, e)
        return (np.where(slides_from(b[which], e) > alike, 1.0, -1.0),)

    def at_the_end(which: Any, e: Array) -> tuple[Array]:
        loading = yielding.loading(e)
        return (loading.pull(loading.largest_approach(), yielding.FLOW)[0] - b[which],)

    return np.stack([roots.crossing(sticks, low, high) for sticks in (at_all, at_the_end)])


def slides_from(b: Array, e: Array) -> Array:
    """Incidence from which plastic spheres slide throughout."""
    return PlasticMotion(e).slides_from(b, np.ones_like(b))
