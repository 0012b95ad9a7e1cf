"""The interface of a law for the steps of an inelastic contact: normal motion and springs.

`viscous` and `plastic` implement it, each for one law of `planarimpact.normal_impact`.
"""

from abc import ABC, abstractmethod

import numpy as np

from planarimpact.common import sliding
from planarimpact.common.arrays import Array, Booleans, Integers
from planarimpact.continuum import refinement

MOST_STEPS = 2**13
# The instants of compression are divided into this many parts, and slip ends between two of them.
# So the number of instants on both sides of the end of slip doubles with the steps.
PARTS = 16
# Slip that ends nearer than this to either end of compression ends there. Friction falls from its
# limit only gradually then, so that the error is of the order of the square of this.
NEAR = 1e-4


def places(intervals: int, slip_ends: Array) -> tuple[Array, Integers]:
    """Places of instants in compression, from 0 to 1, and the number of that where slip ends, (m,).

    Before the end of slip the places, shape (intervals + 1, m), are spread evenly, and after it
    too. `slip_ends` is 0 where there is no slip. If slip ended between two instants, its error
    would not change when doubled steps leave it between the same two, and so it would not show.

    Examples
    --------
    >>> place, number = places(16, np.array([0.0, 0.97]))
    >>> number.tolist(), place[[1, 14, 15], 1].round(3).tolist()
    ([0, 14], [0.069, 0.97, 0.985])
    """
    inside = (slip_ends > NEAR) & (slip_ends < 1 - NEAR)
    parts = np.where(inside, np.clip(np.rint(PARTS * slip_ends), 1, PARTS - 2), 0)
    number = np.rint(parts * (intervals / PARTS)).astype(np.intp)
    number = np.where(inside, np.clip(number, 1, intervals - 1), 0)
    count = np.arange(intervals + 1)[:, None]
    before = slip_ends * count / np.maximum(number, 1)
    after = 1 - (1 - np.where(inside, slip_ends, 0.0)) * (intervals - count) / (intervals - number)
    place = np.where(count < number, before, after)
    return place, np.where(slip_ends < 1 - NEAR, number, intervals)


class Springs(ABC):
    """The springs of many contacts, innermost first, moved together from instant to instant.

    `stick_radius`, shape (n,), is the radius inside which no spring slipped in the last step.
    """

    def __init__(self, motion: "NormalMotion") -> None:
        self._motion = motion
        # Limit L and tangential density of the springs that touch.
        self._limit = motion.density(0)
        self._density = np.zeros_like(self._limit)
        self._tried = self._limit, self._density

    @abstractmethod
    def slide(self, k: int, which: Booleans, u: Array) -> None:
        """Put contacts in the state of gross slip at instant k, which is the last one."""

    @abstractmethod
    def move(
        self, k: int, step: Array, start: tuple[Array, Array], end: tuple[Array, Array]
    ) -> Array:
        """Tangential force at instant k if the body moves from one (u, u') to another; a trial.

        `step` is the time since the last instant, 0 for contacts that still slide from the start.
        """

    @abstractmethod
    def settle(self, k: int) -> Array:
        """Keep the last trial; return the work of friction over zeta^2 in its step, if known."""

    def _keep(self, slid: Booleans) -> None:
        """Keep the last trial, where each spring `slid` or not, innermost first."""
        first = np.argmax(slid, axis=0)
        column = np.arange(first.size)
        self._limit, self._density = self._tried
        edge = len(self._density) - 1
        self.stick_radius = self._motion.radius[np.where(slid[first, column], first, edge), column]

    def _sum(self, k: int) -> Array:
        """Friction at instant k: mu times the normal force times the share of the limits."""
        limit, density = self._tried
        width = self._motion.width[: len(limit)].copy()
        width[-1] = self._motion.edge_width[len(limit) - 1]
        whole = np.sum(width * limit, axis=0)
        share = np.sum(width * density, axis=0) / np.where(whole > 0, whole, 1.0)
        return share * self._motion.force[k]


class NormalMotion(ABC):
    """Normal motions, one a column, in the units E* = 1, R = 1, m2 = 1, |v2(0)| = 1.

    The instants are those when the edge of the contact is at one of the radii. So the edge never
    lies between two springs, and all springs that touch stay in order. `put_springs` chooses the
    radii.
    """

    # Whether springs have dashpots: then friction depends on the velocity, and some strain is left
    # at separation.
    dashpots: bool
    # Arrays of shape (m,).
    restitution: Array
    largest_force: Array
    velocity_at_largest_force: Array
    # Radius of contact at the n + 1 instants of compression, from 0 to its largest value, shape
    # (n + 1, m). The n instants of restitution have the same radii in reverse order.
    radius: Array
    # Weight of each radius in an integral over the radius by the trapezoidal rule, and its weight
    # where the integral ends there.
    width: Array
    edge_width: Array
    # At all instants, shape (2 n + 1, m). The velocity falls from 1 to -e.
    time: Array
    velocity: Array
    approach: Array
    force: Array

    @abstractmethod
    def __init__(self, restitution: Array) -> None:
        """Motions with these coefficients of restitution, from 0.1 to below 1, shape (m,)."""

    @abstractmethod
    def springs(self) -> Springs:
        """Springs for this motion, without deflection."""

    @abstractmethod
    def place(self, velocity: Array) -> Array:
        """Place, from 0 to 1, where compression has the radius of contact of a velocity, (m,)."""

    @abstractmethod
    def put_springs(self, places: Array) -> None:
        """Put a spring, and an instant of each half of the contact, at each place."""

    @abstractmethod
    def density(self, instant: int) -> Array:
        """Normal force density of the springs that touch, innermost first, shape (edge + 1, m)."""

    def steps_needed(self, beta: Array, zeta2: Array) -> Array:
        """Steps that resolve all that happens to the springs in a contact, shape (m,)."""
        return refinement.steps_needed(beta, zeta2)

    def end_of_first_slip(self, x: Array, beta: Array, zeta2: Array) -> Array:
        """Normal velocity where slip from contact ends, which it has for x > zeta^2, shape (m,).

        There the body is as slow as the springs, w = zeta^2 v, while w = x - beta (1 - v). For
        beta <= zeta^2 it never is.
        """
        slows = beta > zeta2
        velocity = np.where(slows, (beta - x) / np.where(slows, beta - zeta2, 1.0), -np.inf)
        return np.where(x > zeta2, velocity, 1.0)

    def slides_from(self, beta: Array, zeta2: Array) -> Array:
        """Incidence from which the contact slides throughout, shape (m,)."""
        return sliding.limit_alike(beta, zeta2, self.restitution)

    def work_of_first_slip(self, x: Array, beta: Array, zeta2: Array, velocity: Array) -> Array:
        """Work of friction in slip from contact to a normal velocity, shape (m,)."""
        if self.dashpots:
            return sliding.viscous_work(x, beta, zeta2, -velocity)
        return sliding.work(x, beta, -velocity)

    def instants_after_slip(self, steps: int) -> int:
        """Instants after the first slip for which `peak_after_slip` looks between the instants."""
        return 0

    def peak_after_slip(self, knots: Array) -> Array:
        """Largest friction between the instants soon after the first slip, shape (m,).

        `knots` are those instants: time, approach, normal velocity, displacement over zeta^2 and
        its rate, shape (knots, 5, m).
        """
        return np.zeros_like(self.largest_force)

    def edge(self, instant: int) -> int:
        """Index of the radius where the edge of the contact is at an instant."""
        last = len(self.radius) - 1
        return min(instant, 2 * last - instant)

    def _set_weights(self, places: Array, rate: Array) -> None:
        """Set the weights of the radii, which grow by `rate` with the place."""
        left = np.diff(places, axis=0, prepend=places[:1])
        right = np.diff(places, axis=0, append=places[-1:])
        self.width, self.edge_width = rate * (left + right) / 2, rate * left / 2
