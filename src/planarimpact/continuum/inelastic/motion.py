"""The normal motion of an inelastic contact at the instants where its edge is at a given radius."""

from abc import ABC, abstractmethod

import numpy as np

from planarimpact.ground import sliding
from planarimpact.ground.arrays import Array, Integers

# Slip ends after a whole number of these parts of the instants of compression. So that number
# doubles with the steps, and both sides of the end of slip are resolved at every level.
PARTS = 16
# Slip that ends nearer than this to either end of compression ends there. Friction falls from its
# limit only gradually then, so that the error is of the order of the square of this.
NEAR = 1e-4


def places(intervals: int, slip_ends: Array) -> tuple[Array, Integers]:
    """Places of instants in compression, from 0 to 1, one of them where slip ends.

    Before the end of slip they are spread evenly, and after it too. Steps displace an event that
    lies between two instants, and they do so alike however many there are as long as it stays
    between the same two: then doubling them shows no error.

    Parameters
    ----------
    intervals : int
    slip_ends : ndarray, shape (m,)
        The place where slip ends; 0 where there is none.

    Returns
    -------
    places : ndarray, shape (intervals + 1, m)
    number : ndarray of int, shape (m,)
        Of the place where slip ends.

    Examples
    --------
    >>> found, number = places(16, np.array([0.0, 0.97]))
    >>> number.tolist(), found[[1, 14, 15], 1].round(3).tolist()
    ([0, 14], [0.069, 0.97, 0.985])
    """
    inside = (slip_ends > NEAR) & (slip_ends < 1 - NEAR)
    parts = np.where(inside, np.clip(np.rint(PARTS * slip_ends), 1, PARTS - 2), 0)
    number = np.rint(parts * (intervals / PARTS)).astype(np.intp)
    number = np.where(inside, np.clip(number, 1, intervals - 1), 0)
    count = np.arange(intervals + 1)[:, None]
    before = slip_ends * count / np.maximum(number, 1)
    after = 1 - (1 - np.where(inside, slip_ends, 0.0)) * (intervals - count) / (intervals - number)
    found = np.where(count < number, before, after)
    return found, np.where(slip_ends < 1 - NEAR, number, intervals)


class NormalMotion(ABC):
    """Normal motions, one a column, in the units E* = 1, R = 1, m2 = 1, |v2(0)| = 1.

    The instants are those when the edge of the contact is at one of the radii. So the edge never
    lies between two springs, and all springs that touch stay in order. `stand` chooses the radii.

    Attributes
    ----------
    viscous : bool
        Whether springs relax.
    restitution : ndarray, shape (m,)
    largest_force, velocity_at_largest_force : ndarray, shape (m,)
    radius : ndarray, shape (n + 1, m)
        Radius of contact at the n + 1 instants of compression, from 0 to its largest value. The n
        instants of restitution have the same radii in reverse order.
    width, edge_width : ndarray, shape (n + 1, m)
        Weight of each radius in an integral over the radius by the trapezoidal rule, and its weight
        where the integral ends there.
    time, velocity, approach, force : ndarray, shape (2 n + 1, m)
        At these instants. The velocity falls from 1 to -e.
    """

    viscous: bool
    restitution: Array
    largest_force: Array
    velocity_at_largest_force: Array
    radius: Array
    width: Array
    edge_width: Array
    time: Array
    velocity: Array
    approach: Array
    force: Array

    @staticmethod
    def least_bluntness(restitution: Array) -> Array:
        """Least force over that of Hertz's law at the same radius of contact, shape (m,)."""
        return np.ones_like(restitution)

    @abstractmethod
    def place(self, velocity: Array) -> Array:
        """Place, from 0 to 1, where compression has the radius of contact of a velocity, (m,)."""

    @abstractmethod
    def stand(self, places: Array) -> None:
        """Put a spring, and an instant of each half of the contact, at each place."""

    @abstractmethod
    def density(self, instant: int) -> Array:
        """Normal force density of the springs that touch, innermost first, shape (edge + 1, m)."""

    def grip(self, x: Array, beta: Array, zeta2: Array) -> Array:
        """Normal velocity where gross slip from the start ends, for x > zeta^2, shape (m,).

        There the body is as slow as the springs, w = zeta^2 v, while w = x - beta (1 - v). For
        beta <= zeta^2 it never is.
        """
        slips, slows = x > zeta2, beta > zeta2
        with np.errstate(over="ignore"):  # also where it hardly is
            last = np.where(slows, (beta - x) / np.where(slows, beta - zeta2, 1.0), -np.inf)
        return np.where(slips, last, 1.0)

    def slides_from(self, beta: Array, zeta2: Array) -> Array:
        """Incidence from which the contact slides throughout, shape (m,)."""
        return sliding.limit_alike(beta, zeta2, self.restitution)

    def edge(self, instant: int) -> int:
        """Index of the radius where the edge of the contact is at an instant."""
        last = len(self.radius) - 1
        return min(instant, 2 * last - instant)

    def _weigh(self, places: Array, rate: Array) -> None:
        """Set the weights of the radii, which grow by `rate` with the place."""
        left = np.diff(places, axis=0, prepend=places[:1])
        right = np.diff(places, axis=0, append=places[-1:])
        self.width, self.edge_width = rate * (left + right) / 2, rate * left / 2
