"""The normal motion of an inelastic contact at the instants where its edge is at a given radius."""

from abc import ABC, abstractmethod

import numpy as np

from planarimpact.ground.arrays import Array


class NormalMotion(ABC):
    """Normal motions, one a column, in the units E* = 1, R = 1, m2 = 1, |v2(0)| = 1.

    The instants are those when the edge of the contact is at one of the radii. So the edge never
    lies between two springs, and all springs that touch stay in order.

    Attributes
    ----------
    viscous : bool
        Whether springs relax.
    tau : ndarray, shape (m,)
        Relaxation time, 0 for none.
    radius : ndarray, shape (n + 1, m)
        Radius of contact at the n + 1 instants of compression, from 0 to its largest value. The n
        instants of restitution have the same radii in reverse order.
    width : ndarray, shape (n + 1, m)
        Weight of each radius in an integral over the radius by the trapezoidal rule.
    time, velocity, approach, force : ndarray, shape (2 n + 1, m)
        At these instants. The velocity falls from 1 to -e.
    largest_force, velocity_at_largest_force : ndarray, shape (m,)
    """

    viscous: bool
    tau: Array
    radius: Array
    width: Array
    time: Array
    velocity: Array
    approach: Array
    force: Array
    largest_force: Array
    velocity_at_largest_force: Array

    @abstractmethod
    def density(self, instant: int) -> Array:
        """Normal force density of the springs that touch, innermost first, shape (edge + 1, m)."""

    @abstractmethod
    def sliding_deflection(self, approach: Array, velocity: Array, count: int) -> Array:
        """Deflection over zeta^2 of the innermost springs in slip from the start, (count, m)."""

    @abstractmethod
    def when(self, velocity: Array) -> tuple[Array, Array, Array]:
        """Time, approach and normal force at a velocity from 1 to -e, shape (m,)."""

    def grip(self, x: Array, beta: Array, zeta2: Array) -> Array:
        """Normal velocity where gross slip from the start ends, for x > zeta^2, shape (m,).

        There the body is as slow as the springs, w = zeta^2 v, while w = x - beta (1 - v).
        """
        slips = x > zeta2
        return np.where(slips, (beta - x) / np.where(slips, beta - zeta2, 1.0), 1.0)

    def edge(self, instant: int) -> int:
        """Index of the radius where the edge of the contact is at an instant."""
        last = len(self.radius) - 1
        return min(instant, 2 * last - instant)
