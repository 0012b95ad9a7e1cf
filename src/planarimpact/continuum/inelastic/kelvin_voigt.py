"""Springs of viscous spheres: the law of `normal_impact.kelvin_voigt` with a row of springs.

The spring at radius r has the force density D - r^2, with D = d + tau d'. It touches where r^2 < d
while d grows. While d falls it touches where r^2 < D, as a contact does not pull.
"""

import numpy as np

from planarimpact.continuum.inelastic.normal_motion import NormalMotion
from planarimpact.ground.arrays import Array
from planarimpact.normal_impact import kelvin_voigt as law


class KelvinVoigt(NormalMotion):
    """Normal motions of viscous spheres.

    Parameters
    ----------
    restitution : ndarray, shape (m,)
        0.1 to 1, without 1.

    Examples
    --------
    >>> found = KelvinVoigt(np.array([0.8]))
    >>> found.stand(np.linspace(0.0, 1.0, 9)[:, None])
    >>> round(float(found.velocity[-1, 0]), 9)
    -0.8
    """

    viscous = True

    def __init__(self, restitution: Array) -> None:
        different, which = np.unique(restitution, return_inverse=True)
        tau, compression, after = law.halves(tuple(different.tolist()))
        at_largest = law.at_largest_force(compression, tau)
        self.tau = tau[which]
        self.largest_force, self.velocity_at_largest_force = (a[which] for a in at_largest)
        self._compression, self._after = compression.taken(which), after.taken(which)

    def place(self, velocity: Array) -> Array:
        """As in `NormalMotion`: the share of compression in sigma.

        Evenly spread over sigma, the radii are dense where the contact is largest, and the
        instants where it is smallest.
        """
        early = self._compression.crossing(1, np.maximum(velocity, 0.0)[None])
        edge = self._after.at(self._after.crossing(1, np.minimum(velocity, 0.0)[None]))[0]
        late = self._compression.crossing(0, edge, rises=True)
        found = np.where(velocity > 0, early, late)[0] / self._compression.end
        return np.minimum(found, 1.0)  # the radius, which is largest there, ends before it tells

    def stand(self, places: Array) -> None:
        """As in `NormalMotion`."""
        compression, after = self._compression, self._after
        self.radius, pace, begin = compression.at(places * compression.end)
        self.radius[0] = pace[-1] = 0.0
        self._weigh(places, pace * compression.end)
        back = self.radius[-2::-1]
        late = after.crossing(0, back)
        late[-1] = after.end
        _, fall, end = after.at(late)
        self.time = np.concatenate([begin, compression.last[2] + end])
        self.velocity = np.concatenate([pace, fall])
        self._depth = np.concatenate([self.radius**2 + self.tau * pace, back**2])
        self.approach = self._depth - self.tau * self.velocity
        edge = np.concatenate([self.radius, back])
        self.force = 2 * edge * (self._depth - edge * edge / 3)

    def density(self, instant: int) -> Array:
        """As in `NormalMotion`: D - r^2."""
        return self._depth[instant] - self.radius[: self.edge(instant) + 1] ** 2

    def sliding_deflection(self, approach: Array, velocity: Array, count: int) -> Array:
        """As in `NormalMotion`: d - r^2, as q + tau q' = D - r^2."""
        return approach - self.radius[:count] ** 2

    def compressed(self, velocity: Array) -> tuple[Array, Array]:
        """Approach and normal force at a velocity in compression, shape (m,)."""
        sigma = self._compression.crossing(1, velocity[None])
        radius = self._compression.at(sigma)[0, 0]
        return radius**2, 4 / 3 * radius**3 + 2 * self.tau * radius * velocity
