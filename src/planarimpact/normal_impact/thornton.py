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

# Halvings of the yield velocity, to the last bit of a number.
BISECTIONS = 60


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
    return np.sqrt(1.2 * np.sqrt(3) * (1 - square / 6)) * slowness**0.25


def yield_velocity(restitution_wanted: Array) -> Array:
    """Ratio of the yield velocity to the velocity of impact, the inverse of `restitution`.

    Parameters
    ----------
    restitution_wanted : ndarray
        0 to 1.

    Returns
    -------
    ndarray
        Of the same shape, to 1e-18.

    Examples
    --------
    >>> yield_velocity(np.array([1.0, 0.6586])).round(4)
    array([1. , 0.1])
    """
    low, high = np.zeros_like(restitution_wanted), np.ones_like(restitution_wanted)
    for _ in range(BISECTIONS):
        middle = (low + high) / 2
        below = restitution(middle) < restitution_wanted
        low, high = np.where(below, middle, low), np.where(below, high, middle)
    return high
