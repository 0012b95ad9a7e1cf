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
it bends where slip throughout begins (`Thornton.slides_from`). Spheres that lose much bend the
answer at one more incidence, which the table does not know: its error is larger there.
"""

import numpy as np

from planarimpact.continuum import inelastic
from planarimpact.continuum.inelastic.viscous import KelvinVoigt
from planarimpact.ground import sliding
from planarimpact.ground.arrays import Array, Booleans
from planarimpact.normal_impact import yielding

# Steps of the continuum, and impacts solved together.
STEPS, TOGETHER = 256, 256
HALVINGS = 30
# Of an incidence for which the continuum is solved each time.
FEW_HALVINGS = 14


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


def slides_at_the_end(b: Array, e: Array) -> Array:
    """Plastic: incidence from which friction is at its limit at the end of compression, shape (n,).

    Examples
    --------
    >>> slides_at_the_end(np.array([2.9, 2.9]), np.array([0.9, 0.45])).round(2)
    array([2.9 , 2.93])
    """
    one = np.ones_like(b)
    low, high = np.zeros_like(b), inelastic.slides_from(b, one, e, "plastic")
    for _ in range(FEW_HALVINGS):
        y, slides = (low + high) / 2, np.empty(b.size, dtype=bool)
        for start in range(0, b.size, TOGETHER):
            part = slice(start, start + TOGETHER)
            path = inelastic.path(y[part], b[part], one[part], e[part], "plastic", STEPS)
            end = STEPS // 2
            slides[part] = path.friction[end] >= inelastic.GROSS * path.normal[end]
        low, high = np.where(slides, low, y), np.where(slides, y, high)
    return high


def limits(b: Array) -> Array:
    """Plastic: two restitutions where what happens between y = 1 and slip throughout changes.

    Below the second, the middle of a contact with y = b sticks for a while before the end of
    compression. Below the first, that happens even where `limit_alike` says slip throughout.

    Parameters
    ----------
    b : ndarray, shape (n,)

    Returns
    -------
    ndarray, shape (2, n)

    Examples
    --------
    >>> limits(np.array([1.6, 3.5])).round(3)
    array([[0.692, 0.485],
           [0.831, 0.618]])
    """
    one = np.ones_like(b)

    def at_all(e: Array) -> Booleans:
        return inelastic.slides_from(b, one, e, "plastic") > sliding.limit_alike(b, one, e)

    def at_the_end(e: Array) -> Booleans:
        law = yielding.compression(e)
        return law.pull(law.largest_approach(), yielding.FLOW)[0] > b

    found = []
    for sticks in (at_all, at_the_end):
        low, high = np.full((2, b.size), [[0.3], [0.99]])
        for _ in range(HALVINGS):
            e = (low + high) / 2
            later = sticks(e)
            low, high = np.where(later, e, low), np.where(later, high, e)
        found.append(low)
    return np.stack(found)


def _slips_until(v: Array, b: Array) -> Array:
    """Incidence at which the first slip ends at a normal velocity."""
    return b - (b - 1) * v
