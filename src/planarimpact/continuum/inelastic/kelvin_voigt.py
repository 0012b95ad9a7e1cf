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
    intervals : int
        n of `NormalMotion`.

    Examples
    --------
    >>> found = KelvinVoigt(np.array([0.8]), 8)
    >>> round(float(found.velocity[-1, 0]), 9)
    -0.8
    """

    viscous = True

    def __init__(self, restitution: Array, intervals: int) -> None:
        different, which = np.unique(restitution, return_inverse=True)
        tau, compression, after = law.halves(tuple(different.tolist()))
        # Evenly spread over sigma, the radii are dense where the contact is largest, and the
        # instants where it is smallest.
        share = np.linspace(0.0, 1.0, intervals + 1)[:, None]
        radius, pace, begin = compression.at(share * compression.end)
        radius[0] = pace[-1] = 0.0
        back = radius[-2::-1]
        late = after.crossing(0, back)
        late[-1] = after.end
        _, fall, end = after.at(late)
        depth = np.concatenate([radius**2 + tau * pace, back**2])
        edge = np.concatenate([radius, back])
        self.tau, self.radius = tau[which], radius[:, which]
        self.width = (pace * compression.end / intervals)[:, which]
        self.time = np.concatenate([begin, compression.last[2] + end])[:, which]
        self.velocity = np.concatenate([pace, fall])[:, which]
        self._depth = depth[:, which]
        self.approach = self._depth - self.tau * self.velocity
        self.force = (2 * edge * (depth - edge * edge / 3))[:, which]
        at_largest = law.at_largest_force(compression, tau)
        self.largest_force, self.velocity_at_largest_force = (a[which] for a in at_largest)
        self._halves = compression.taken(which), after.taken(which)

    def density(self, instant: int) -> Array:
        """As in `NormalMotion`: D - r^2."""
        return self._depth[instant] - self.radius[: self.edge(instant) + 1] ** 2

    def sliding_deflection(self, approach: Array, velocity: Array, count: int) -> Array:
        """As in `NormalMotion`: d - r^2, as q + tau q' = D - r^2."""
        return approach - self.radius[:count] ** 2

    def when(self, velocity: Array) -> tuple[Array, Array, Array]:
        """As in `NormalMotion`."""
        compression, after = self._halves
        radius, _, time = compression.at(compression.crossing(1, velocity[None]))[:, 0]
        edge, _, later = after.at(after.crossing(1, velocity[None]))[:, 0]
        growing = 4 / 3 * radius**3 + 2 * self.tau * radius * velocity
        early = velocity >= 0
        return (
            np.where(early, time, compression.last[2] + later),
            np.where(early, radius**2, edge**2 - self.tau * velocity),
            np.where(early, growing, 4 / 3 * edge**3),
        )
