"""Normal impact of elastic-plastic spheres by Thornton's law (J. Appl. Mech. 64 (1997) 383-386).

Hertz's law holds until the largest pressure is p_y, at the approach d_y. From there the pressure is
Hertz's, cut at p_y, so that F = F_y + pi p_y (d - d_y). Unloading is elastic, with Hertz's law of
the radius R_p = R F_e/F_max, where F_e is the force of Hertz's law at the largest approach. The
coefficient of restitution depends on the ratio of the yield velocity to the velocity alone.

Units as in `normal_impact`.
"""

from typing import NamedTuple

import numpy as np

from planarimpact.ground.arrays import Array
from planarimpact.normal_impact import hertz

__all__ = ["largest_force", "restitution", "yield_velocity"]

# The equation of `yield_velocity` in the tangent t: t at e = 1, what is added to t, and its largest
# coefficient.
_AT_YIELD, _ADDED, _LARGEST = 1 / np.sqrt(5), 2 / np.sqrt(5), 1 / 4.32
# Deflections in shear decay by exp(-FLOW g) while the permanent approach grows by g d_y. Fixed on
# finite elements with nu = 0.3, mu = 0.1, e = 0.46, 0.55 and 0.63 (data/finite_elements).
FLOW = 0.95
# Newton's method doubles the digits. It starts with an error of 0.005 in e.
NEWTON = 4


class Compression(NamedTuple):
    """Compression of elastic-plastic spheres, elastic first and then harmonic.

    Attributes
    ----------
    yields : ndarray, shape (m,)
        Approach d_y where yield begins.
    rate, centre, reach : ndarray, shape (m,)
        From there the approach is `centre` and `reach` times the sine of an angle that grows by
        `rate` in a unit of time.
    """

    yields: Array
    rate: Array
    centre: Array
    reach: Array

    def largest_approach(self) -> Array:
        """Approach at the end of compression, shape (m,)."""
        return self.centre + self.reach

    def largest_force(self) -> Array:
        """Force there, shape (m,)."""
        return self.rate**2 * self.reach

    def bluntness(self, depth: Array) -> Array:
        """Force over that of Hertz's law at an approach, and so at that radius, shape (..., m)."""
        hertzian = 4 / 3 * np.maximum(depth, self.yields) ** 1.5
        plastic = self.rate**2 * (depth - self.centre) / hertzian
        return np.where(depth > self.yields, plastic, 1.0)

    def flow(self, depth: Array) -> Array:
        """How much shear has flowed at an approach: the plastic part of it, over d_y, (..., m).

        The elastic part is what would spring back: that of Hertz's law with the radius R_p, which
        is `bluntness` times the approach.
        """
        share = np.maximum(depth / self.yields, 1.0)
        return share - 1.5 * np.sqrt(share) + 0.5 / np.sqrt(share)

    def pull(self, depth: Array, flow: float) -> tuple[Array, Array]:
        """How fast a sliding contact must be pulled not to stick in its middle, (..., m).

        Over the rate of the approach, in the unit of the elastic part; `flow` is a factor. And the
        derivative of that by the approach. In the middle the limit of friction is the elastic part
        of the approach, which grows while the deflection flows.
        """
        root = 1 / np.sqrt(np.maximum(depth / self.yields, 1.0))
        part = 1.5 / root - 0.5 * root  # the elastic part over d_y
        rate = 0.75 * root + 0.25 * root**3
        bend = -0.375 * root**3 * (1 + root**2)
        pull = rate + flow * (1 - rate) * part
        change = bend * (1 - flow * part) + flow * (1 - rate) * rate
        return pull, np.where(depth > self.yields, change, 0.0) / self.yields

    def at(self, depth: Array) -> tuple[Array, Array, Array]:
        """Time, velocity and force at an approach, shape (..., m)."""
        elastic = np.minimum(depth, self.yields)
        v = np.sqrt(1 - 2 * hertz.ENERGY * elastic**2.5)
        full = hertz.FULL
        time = full**0.4 * hertz.COMPRESSION * hertz.time(np.arcsin(np.sqrt(elastic) / full**0.2))
        plastic = depth > self.yields
        over = np.clip((depth - self.centre) / self.reach, 0.0, 1.0)
        harmonic = np.sqrt((1 - over) * (1 + over))
        start = np.arcsin((self.yields - self.centre) / self.reach)
        later = (np.arccos(harmonic) - start) / self.rate
        force = np.where(plastic, self.rate**2 * (depth - self.centre), 4 / 3 * elastic**1.5)
        v = np.where(plastic, self.rate * self.reach * harmonic, v)
        return np.where(plastic, time + later, time), v, force

    def plastic_approach(self, velocity: Array) -> Array:
        """Approach at a velocity in the plastic part, shape (m,)."""
        share = np.clip(velocity / (self.rate * self.reach), 0.0, 1.0)
        return self.centre + self.reach * np.sqrt((1 - share) * (1 + share))


def compression(restitution: Array) -> Compression:
    """Compression of an impact with a coefficient of restitution, shape (m,).

    Examples
    --------
    >>> compression(np.array([0.8])).largest_approach().round(4)
    array([1.0493])
    """
    yields = (yield_velocity(restitution) ** 2 / (2 * hertz.ENERGY)) ** 0.4
    rate = np.sqrt(2 * np.sqrt(yields))
    centre = yields / 3
    at_yield = np.sqrt(np.maximum(1 - 2 * hertz.ENERGY * yields**2.5, 0.0))  # the velocity
    return Compression(yields, rate, centre, np.hypot(yields - centre, at_yield / rate))


def largest_force(restitution: Array) -> Array:
    """Largest normal force, over that of an elastic impact (Hertz).

    Parameters
    ----------
    restitution : ndarray, shape (m,)
        From `normal_impact.LEAST_RESTITUTION` to 1.

    Returns
    -------
    ndarray, shape (m,)
        It falls with restitution: what yields is softer.

    Examples
    --------
    >>> largest_force(np.array([1.0, 0.8, 0.5])).round(3)
    array([1.   , 0.815, 0.551])
    """
    return compression(restitution).largest_force() / hertz.LARGEST_FORCE


def restitution(yield_velocity: Array) -> Array:
    """Coefficient of restitution at a ratio of the yield velocity to the velocity of impact.

    Parameters
    ----------
    yield_velocity : ndarray
        v_y/v, 0 to 1.

    Returns
    -------
    ndarray
        Of the same shape.

    Notes
    -----
    Thornton (1997), Eq. 44: the energy of unloading over that of the impact.

    Examples
    --------
    >>> restitution(np.array([1.0, 0.1])).round(4)
    array([1.    , 0.6586])
    """
    square = yield_velocity**2
    slowness = yield_velocity / (yield_velocity + 2 * np.sqrt(1.2 - square / 5))
    return np.sqrt(1.2 * np.sqrt(3) * (1 - square / 6) * np.sqrt(slowness))


def yield_velocity(restitution_wanted: Array) -> Array:
    """Ratio of the yield velocity to the velocity of impact, the inverse of `restitution`.

    Parameters
    ----------
    restitution_wanted : ndarray
        0 to 1.

    Returns
    -------
    ndarray
        Of the same shape. `restitution` makes of it what was wanted, to 1e-15.

    Notes
    -----
    With the tangent t of the angle whose sine is v_y/(6^(1/2) v), the fourth power of Eq. 44 is
    e^4/4.32 = t/((t + 2/5^(1/2)) (1 + t^2)^2). The root is the smaller one of two. They meet at
    e = 1, so that t is smooth as a function of (1 - e^4)^(1/2). Newton's method starts from a
    parabola in it.

    Examples
    --------
    >>> yield_velocity(np.array([1.0, 0.6586])).round(4)
    array([1. , 0.1])
    >>> e = np.linspace(0.0, 1.0, 1001)
    >>> bool(np.abs(restitution(yield_velocity(e)) - e).max() < 1e-15)
    True
    """
    e = np.minimum(restitution_wanted, np.nextafter(1.0, 0.0))  # at 1 the slope below is 0
    square = e * e
    lost = np.sqrt((1 - e) * (1 + e) * (1 + square))
    share = _LARGEST * square * square
    # The parabola is right at both ends, its slope too where e = 0.
    t = (1 - lost) * (_AT_YIELD - (_AT_YIELD - 2 * _ADDED * _LARGEST) * lost)
    for _ in range(NEWTON):
        one = 1 + t * t
        excess = share * (t + _ADDED) * one * one - t
        slope = share * one * (one + 4 * t * (t + _ADDED)) - 1
        t = t - excess / slope
    found = np.minimum(np.sqrt(6) * t / np.sqrt(1 + t * t), 1.0)
    return np.where(restitution_wanted < 1, found, 1.0)
