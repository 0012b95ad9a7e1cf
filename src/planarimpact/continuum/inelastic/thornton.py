"""Springs of elastic-plastic spheres: the law of `normal_impact.thornton` with a row of springs.

Friction is at most mu times the pressure, so the pressure itself is needed. Thornton has two, and
at maximum compression they do not agree: the cut one, and that of Hertz with the radius R_p. If
the pressure jumped there, a contact that slides would stick for an instant, or springs would gain
energy. So here the pressure is Hertz's at all times, with the force and the radius of contact of
Thornton's law. Its density is b (a^2 - r^2), with the bluntness b = F/F_e(a). How much this choice
matters stands in the docstring of `continuum.rebound`.
"""

import numpy as np

from planarimpact.continuum.inelastic.normal_motion import NormalMotion
from planarimpact.ground.arrays import Array
from planarimpact.normal_impact import hertz
from planarimpact.normal_impact import thornton as law

# Places where the start of stick in plastic compression is sought before it is homed in.
PLACES = 33
# Halvings to the last bit of a number.
BISECTIONS = 60


class Thornton(NormalMotion):
    """Normal motions of elastic-plastic spheres.

    Parameters
    ----------
    restitution : ndarray, shape (m,)
        0.1 to 1, without 1.

    Examples
    --------
    >>> found = Thornton(np.array([0.8]))
    >>> found.stand(np.linspace(0.0, 1.0, 9)[:, None])
    >>> round(float(found.velocity[-1, 0]), 9)
    -0.8
    """

    viscous = False

    def __init__(self, restitution: Array) -> None:
        self._e = restitution
        self._law = law.compression(restitution)
        self.tau = np.zeros_like(restitution)
        self._largest = self._law.largest_approach()
        self.largest_force = self._law.largest_force()
        self.velocity_at_largest_force = np.zeros_like(self._largest)
        self._last_blunt = self._law.bluntness(self._largest)
        self._turn = self._law.at(self._largest)[0]
        self._unloading = self._last_blunt * self._largest / restitution * hertz.COMPRESSION

    @staticmethod
    def least_bluntness(restitution: Array) -> Array:
        """As in `NormalMotion`: at the end of compression."""
        compression = law.compression(restitution)
        return compression.bluntness(compression.largest_approach())

    def place(self, velocity: Array) -> Array:
        """As in `NormalMotion`: the angle whose sine is the radius, over a right angle."""
        depth = self._depth(velocity)
        angle = np.arctan2(np.sqrt(depth), np.sqrt(self._largest - depth))
        back = np.pi - hertz.phase_at(np.clip(velocity / self._e, -1.0, 0.0))
        return np.where(velocity > 0, angle, back) / (np.pi / 2)

    def stand(self, places: Array) -> None:
        """As in `NormalMotion`."""
        angle = places * (np.pi / 2)
        self.radius = np.sqrt(self._largest) * np.sin(angle)
        rate = np.sqrt(self._largest) * np.cos(angle) * (np.pi / 2)
        rate[-1] = 0.0
        self._weigh(places, rate)
        depth = self.radius**2
        depth[-1] = self._largest
        back = depth[-2::-1]
        time, velocity, force = self._law.at(depth)
        blunt = self._law.bluntness(depth)
        phase = np.pi - angle[-2::-1]
        later = self._turn + self._unloading * (hertz.time(phase) - 1)
        self.time = np.concatenate([time, later])
        self.velocity = np.concatenate([velocity, self._e * hertz.velocity(phase)])
        lost = self._last_blunt * (self._largest - back)
        self.approach = np.concatenate([depth, self._largest - lost])
        self.force = np.concatenate([force, 4 / 3 * self._last_blunt * back**1.5])
        self._blunt = np.concatenate([blunt, np.broadcast_to(self._last_blunt, back.shape)])

    def _depth(self, velocity: Array) -> Array:
        """Approach at a velocity in compression."""
        elastic = ((1 - np.clip(velocity, 0.0, 1.0) ** 2) / (2 * hertz.ENERGY)) ** 0.4
        plastic = self._law.plastic_approach(velocity)
        return np.minimum(np.where(elastic > self._law.yields, plastic, elastic), self._largest)

    def density(self, instant: int) -> Array:
        """As in `NormalMotion`: b (a^2 - r^2)."""
        square = self.radius[: self.edge(instant) + 1] ** 2
        return self._blunt[instant] * (square[-1] - square)

    def sliding_deflection(self, approach: Array, velocity: Array, count: int) -> Array:
        """As in `NormalMotion`: the density of the normal force."""
        depth, blunt = self._contact(approach, velocity)
        return blunt * np.maximum(depth - self.radius[:count] ** 2, 0.0)

    def force_at(self, approach: Array, velocity: Array) -> Array:
        """Normal force, shape (m,)."""
        depth, blunt = self._contact(approach, velocity)
        return 4 / 3 * blunt * depth**1.5

    def _contact(self, approach: Array, velocity: Array) -> tuple[Array, Array]:
        """Square of the radius of contact, and bluntness."""
        back = self._largest - (self._largest - approach) / self._last_blunt
        depth = np.clip(np.where(velocity > 0, approach, back), 0.0, self._largest)
        return depth, np.where(velocity > 0, self._law.bluntness(depth), self._last_blunt)

    def grip(self, x: Array, beta: Array, zeta2: Array) -> Array:
        """As in `NormalMotion`: where w = zeta^2 v, or zeta^2 b v in plastic compression."""
        alike = super().grip(x, beta, zeta2)
        plastic = np.sqrt(np.maximum(1 - 2 * hertz.ENERGY * self._law.yields**2.5, 0.0))
        # The springs at the edge gain most, b v. Look for the first time when the body is slower,
        # between the end of elastic compression and the time when the body stands still.
        latest = np.clip((beta - x) / beta, 0.0, plastic)
        places = plastic + np.linspace(0.0, 1.0, PLACES)[:, None] * (latest - plastic)

        def lead(velocity: Array) -> Array:
            return x - beta * (1 - velocity) - zeta2 * self._slowed(velocity) * velocity

        row = np.maximum(np.argmax(lead(places) <= 0, axis=0), 1)
        column = np.arange(x.size)
        high, low = places[row - 1, column], places[row, column]
        for _ in range(BISECTIONS):
            middle = (low + high) / 2
            ahead = lead(middle) > 0
            low, high = np.where(ahead, low, middle), np.where(ahead, middle, high)
        return np.where((alike < plastic) & (x < beta), low, alike)

    def _slowed(self, velocity: Array) -> Array:
        """Bluntness at a velocity in plastic compression."""
        share = np.clip(velocity / (self._law.rate * self._law.reach), 0.0, 1.0)
        return self._law.bluntness(
            self._law.centre + self._law.reach * np.sqrt((1 - share) * (1 + share))
        )
