"""Normal impact of elastic-plastic spheres by Thornton's law (J. Appl. Mech. 64 (1997) 383-386).

- **Loading** (`Loading`): Hertz's law holds until the largest pressure is p_y, at the approach d_y.
  From there the pressure is Hertz's, cut at p_y, so that F = F_y + pi p_y (d - d_y).
- **Unloading** (`unloading`) is elastic, with Hertz's law of the radius R_p = R F_e/F_max, where
  F_e is the force of Hertz's law at the largest approach.
- **What relaxes** (`Loading.flow`): the flow rule of Prandtl and Reuss relaxes every component of
  stress while metal yields. So deflections in shear decay by exp(-FLOW g) while the permanent
  approach grows by g d_y.

All else follows from these three: the coefficient of restitution, which depends on the ratio of the
yield velocity to the velocity alone, is the energy of unloading.

Units as in `normal_impact`.
"""

from functools import cache
from typing import Any, NamedTuple

import numpy as np
from numpy.polynomial import Chebyshev

from planarimpact.common import roots
from planarimpact.common.arrays import Array
from planarimpact.normal_impact import hertz

__all__ = ["largest_force", "restitution", "yield_velocity"]

# Fixed on finite elements with nu = 0.3, mu = 0.1, e = 0.46, 0.55 and 0.63 (data/finite_elements).
FLOW = 0.95
# Degree of the table of yield velocities, which is right to 2e-15.
DEGREE = 32
# Root of 1 - e below which the table has all digits that the restitution determines.
LITTLE = 0.03


class Loading(NamedTuple):
    """Compression of elastic-plastic spheres, elastic first and then harmonic; arrays (m,).

    Yield begins at the approach d_y. From there the approach is `centre` and `reach` times the sine
    of an angle that grows by `rate` in a unit of time.
    """

    yields: Array  # d_y
    rate: Array
    centre: Array
    reach: Array

    def take(self, which: Any) -> "Loading":
        """The loading of some impacts, by an index of them."""
        return Loading._make(field[which] for field in self)

    def largest_approach(self) -> Array:
        """Approach at the end of compression, shape (m,)."""
        return self.centre + self.reach

    def largest_force(self) -> Array:
        """Force there, shape (m,)."""
        return self.rate**2 * self.reach

    def share_of_hertz(self, depth: Array) -> Array:
        """Force over that of Hertz's law at an approach, and so at that radius, shape (..., m)."""
        hertzian = 4 / 3 * np.maximum(depth, self.yields) ** 1.5
        plastic = self.rate**2 * (depth - self.centre) / hertzian
        return np.where(depth > self.yields, plastic, 1.0)

    def flow(self, depth: Array) -> Array:
        """g at an approach: its permanent part over d_y, (..., m).

        The elastic part, which would spring back, is `share_of_hertz` times the approach.
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
        elastic, full = np.minimum(depth, self.yields), hertz.FULL
        time = full**0.4 * hertz.COMPRESSION * hertz.time(np.arcsin(np.sqrt(elastic) / full**0.2))
        start = np.arcsin((self.yields - self.centre) / self.reach)
        later = (np.arccos(self._harmonic(depth)) - start) / self.rate
        return np.where(depth > self.yields, time + later, time), *self.motion(depth)

    def motion(self, depth: Array) -> tuple[Array, Array]:
        """Velocity and force at an approach, shape (..., m), in less time than `at`."""
        elastic, plastic = np.minimum(depth, self.yields), depth > self.yields
        force = np.where(plastic, self.rate**2 * (depth - self.centre), 4 / 3 * elastic**1.5)
        flowing = self.rate * self.reach * self._harmonic(depth)
        return np.where(plastic, flowing, elastic_velocity(elastic)), force

    def _harmonic(self, depth: Array) -> Array:
        """Cosine of the plastic motion, exactly 0 at its end."""
        to_go = np.clip((self.largest_approach() - depth) / self.reach, 0.0, 1.0)
        return np.sqrt(to_go * (2 - to_go))

    def approach(self, velocity: Array) -> Array:
        """Approach at a velocity from 1 to 0, shape (m,)."""
        elastic = ((1 - np.clip(velocity, 0.0, 1.0) ** 2) / (2 * hertz.ENERGY)) ** 0.4
        return np.where(elastic > self.yields, self.plastic_approach(velocity), elastic)

    def plastic_approach(self, velocity: Array) -> Array:
        """Approach at a velocity in the plastic part, shape (m,)."""
        share = np.clip(velocity / (self.rate * self.reach), 0.0, 1.0)
        return self.centre + self.reach * np.sqrt((1 - share) * (1 + share))


class Unloading(NamedTuple):
    """Unloading along Hertz's law: at the share s of the largest radius the force is F s^3."""

    springs_back: Array  # the part of the approach that comes back; s^2 of it is still to come
    force: Array  # F at the end of loading

    def restitution(self) -> Array:
        """Coefficient of restitution: the root of twice the energy that comes back, shape (m,)."""
        return np.sqrt(2 / 2.5 * self.force * self.springs_back)

    def at(self, phase: Array, restitution: Array) -> tuple[Array, Array, Array, Array]:
        """Time since the end of loading, velocity, approach that came back, force; (..., m).

        At a phase of `hertz`, from pi/2 to pi, for a coefficient of restitution.
        """
        unit = self.springs_back / restitution * hertz.COMPRESSION
        share = np.sin(phase)
        return (
            unit * (hertz.time(phase) - 1),
            restitution * hertz.velocity(phase),
            self.springs_back * (1 - share * share),
            self.force * share**3,
        )

    def phase(self, velocity: Array, restitution: Array) -> Array:
        """Phase of `hertz` at a velocity, from 0 to -e; shape (m,)."""
        return np.pi - hertz.phase_at(np.clip(-velocity / restitution, 0.0, 1.0))

    def square(self, came_back: Array) -> Array:
        """s^2 when so much of the approach came back, shape (m,)."""
        return np.clip(1 - came_back / self.springs_back, 0.0, 1.0)


def unloading(loading: Loading) -> Unloading:
    """The law of unloading, from the state at the end of loading.

    Unloading is elastic, by Hertz's law of a flatter sphere, whose radius R_p belongs to the
    largest force and the largest radius of contact a: F = (4/3) a^3 R/R_p, and a^2 R/R_p springs
    back. By Thornton F = F_e R/R_p, with the force F_e of Hertz's law at the largest approach a^2.

    Restitution, its inverse and the motion of the springs follow from it. `Loading.flow` and
    `Loading.pull` take the same share of the approach for elastic: keep them in step.

    Examples
    --------
    >>> back = unloading(loading(np.array([0.8])))
    >>> back.springs_back.round(4), back.restitution().round(12)
    (array([0.7653]), array([0.8]))
    """
    sharpness = loading.share_of_hertz(loading.largest_approach())
    return Unloading(sharpness * loading.largest_approach(), loading.largest_force())


def loading(restitution: Array) -> Loading:
    """Loading of an impact with a coefficient of restitution, shape (m,).

    Examples
    --------
    >>> loading(np.array([0.8])).largest_approach().round(4)
    array([1.0493])
    """
    return _loading(yield_velocity(restitution))


def _loading(yield_velocity: Array) -> Loading:
    """Loading at a ratio of the yield velocity to the velocity of impact, above 0."""
    yields = (yield_velocity**2 / (2 * hertz.ENERGY)) ** 0.4
    rate = np.sqrt(2 * np.sqrt(yields))
    centre = yields / 3
    reach = np.hypot(yields - centre, elastic_velocity(yields) / rate)
    return Loading(yields, rate, centre, reach)


def elastic_velocity(depth: Array) -> Array:
    """Velocity in elastic loading at an approach up to d_y."""
    return np.sqrt(np.maximum(1 - 2 * hertz.ENERGY * depth**2.5, 0.0))


def largest_force(restitution: Array) -> Array:
    """Largest normal force, over that of an elastic impact (Hertz).

    It falls with restitution: spheres that yield are softer.

    Examples
    --------
    >>> largest_force(np.array([1.0, 0.8, 0.5])).round(3)
    array([1.   , 0.815, 0.551])
    """
    return loading(restitution).largest_force() / hertz.LARGEST_FORCE


def restitution(yield_velocity: Array) -> Array:
    """Coefficient of restitution at a ratio of the yield velocity to the velocity of impact.

    The ratio v_y/v is 0 to 1. With the unloading of Thornton (1997) it is his Eq. 44.

    Examples
    --------
    >>> restitution(np.array([1.0, 0.1, 0.0])).round(4)
    array([1.    , 0.6586, 0.    ])
    """
    yields = (yield_velocity > 0) & (yield_velocity < 1)
    law = _loading(np.where(yields, yield_velocity, 1.0))
    return np.where(yields, unloading(law).restitution(), yield_velocity)


def yield_velocity(coefficient: Array) -> Array:
    """Ratio of the yield velocity to the velocity of impact, the inverse of `restitution` to 1e-15.

    The coefficient of restitution is 0 to 1.

    Examples
    --------
    >>> yield_velocity(np.array([1.0, 0.6586])).round(4)
    array([1. , 0.1])
    >>> e = np.linspace(0.0, 1.0, 1001)
    >>> bool(np.abs(restitution(yield_velocity(e)) - e).max() < 1e-15)
    True
    """
    root, slope = _roots()
    loss = np.sqrt(1 - coefficient)
    of_e = np.clip(root(loss), 0.0, 1.0)
    # One step of Newton's method, but where rounding of the restitution would be all that is left.
    far = loss > LITTLE
    change = slope(loss) / (-2 * np.where(far, loss, 1.0))
    return (of_e + np.where(far, change * (coefficient - restitution(of_e**4)), 0.0)) ** 4


@cache
def _roots() -> tuple[Chebyshev, Chebyshev]:
    """Fourth root of the yield velocity against the root of 1 - e, and its derivative: smooth."""

    def solved(loss: Array) -> Array:
        wanted = 1 - loss * loss
        return roots.crossing(
            lambda which, root: (wanted[which] - restitution(root**4),),
            np.zeros_like(wanted),
            np.ones_like(wanted),
        )

    table = Chebyshev.interpolate(solved, DEGREE, [0.0, 1.0])
    return table, table.deriv()
