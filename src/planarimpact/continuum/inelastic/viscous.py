"""Springs of viscous spheres: the law of `normal_impact.kelvin_voigt` with a row of springs.

With the approach d and the relaxation time tau, the spring at radius r has the force density
D - r^2, D = d + tau d'. It touches where r^2 < d while d grows. While d falls it touches where
r^2 < D, as a contact does not pull.
"""

import numpy as np

from planarimpact.common.arrays import Array, Booleans
from planarimpact.continuum.inelastic.motion import MOST_STEPS, NormalMotion, Springs
from planarimpact.normal_impact import kelvin_voigt as law


class ViscousMotion(NormalMotion):
    """Normal motions of viscous spheres."""

    dashpots = True

    def __init__(self, restitution: Array) -> None:
        different, which = np.unique(restitution, return_inverse=True)
        tau, compression, after = law.halves(tuple(different.tolist()))
        at_largest = law.at_largest_force(compression, tau)
        self.restitution, self.tau = restitution, tau[which]
        self.largest_force, self.velocity_at_largest_force = (a[which] for a in at_largest)
        self._compression, self._after = compression.taken(which), after.taken(which)

    def place(self, velocity: Array) -> Array:
        """Share of compression in sigma at the radius of contact of a velocity.

        Evenly spread over sigma, the radii are dense where the contact is largest, and the
        instants where it is smallest.
        """
        early = self._compression.crossing(1, np.maximum(velocity, 0.0)[None])
        edge = self._after.at(self._after.crossing(1, np.minimum(velocity, 0.0)[None]))[0]
        late = self._compression.crossing(0, edge, rises=True)
        share = np.where(velocity > 0, early, late)[0] / self._compression.end
        return np.minimum(share, 1.0)  # near 1 the radius hardly changes

    def put_springs(self, places: Array) -> None:
        """Put springs, and instants, at the places: shares of compression in sigma."""
        compression, after = self._compression, self._after
        self.radius, pace, begin = compression.at(places * compression.end)
        self.radius[0] = pace[-1] = 0.0
        self._set_weights(places, pace * compression.end)
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

    def springs(self) -> Springs:
        """Springs with dashpots, without deflection."""
        return ViscousSprings(self)

    def steps_needed(self, beta: Array, zeta2: Array) -> Array:
        """Steps that resolve the oscillation and the fastest damping by the dashpots.

        Heun's method is unstable if a step is twice the time of damping; here it is at most that
        time. It may be longer where slip frees the springs, so that damping refuses no impact.
        """
        duration = self._compression.last[2] + self._after.last[2]
        damping = 2 * self.tau * self._compression.last[0] * duration * (beta / zeta2)
        return np.maximum(super().steps_needed(beta, zeta2), np.minimum(damping, MOST_STEPS))

    def density(self, instant: int) -> Array:
        """Normal force density D - r^2 of the springs that touch."""
        return self._depth[instant] - self.radius[: self.edge(instant) + 1] ** 2


class ViscousSprings(Springs):
    """Springs that relax: what is beyond the limit does so with the relaxation time tau."""

    _motion: ViscousMotion

    def __init__(self, motion: ViscousMotion) -> None:
        super().__init__(motion)
        self._memory = np.zeros_like(self._limit)
        self._next = self._memory

    def slide(self, k: int, which: Booleans, u: Array) -> None:
        """Put contacts in the state of gross slip: q + tau q' = D - r^2, so that q = d - r^2."""
        motion = self._motion
        deflection = motion.approach[k] - motion.radius[: len(self._memory)] ** 2
        limit = deflection + motion.tau * motion.velocity[k]
        for values, new in zip(
            (self._memory, self._limit, self._density), (deflection - u, limit, limit), strict=True
        ):
            values[:, which] = new[:, which]

    def move(
        self, k: int, step: Array, start: tuple[Array, Array], end: tuple[Array, Array]
    ) -> Array:
        """Tangential force at instant k by springs that relax beyond their limit; a trial."""
        tau, limit = self._motion.tau, self._motion.density(k)
        pull, later = (u + tau * rate for u, rate in (start, end))
        count = min(len(limit), len(self._memory))
        parts = self._memory[:count], self._limit[:count], limit[:count]
        memory, density = _relaxed(*parts, pull, later, step, tau)
        if count < len(limit):  # a spring comes into contact, without deflection
            edge = np.clip(later - end[0], -limit[-1], limit[-1])
            memory, density = np.vstack([memory, -end[0]]), np.vstack([density, edge])
        self._next, self._tried = memory, (limit, density)
        return self._sum(k)

    def settle(self, k: int) -> Array:
        """Keep the last trial; return the work of friction over zeta^2 in its step."""
        memory, (_, density) = self._next, self._tried
        count = min(len(memory), len(self._memory))
        slid = self._memory[:count] - memory[:count]
        mean = (self._density[:count] + density[:count]) / 2
        work = 2 * np.sum(self._motion.width[:count] * mean * slid, axis=0)
        self._memory = memory
        self._keep(slid != 0)
        return work


def _relaxed(
    memory: Array,
    limit: Array,
    limit_after: Array,
    pull: Array,
    pull_after: Array,
    step: Array,
    tau: Array,
) -> tuple[Array, Array]:
    """Memory and density after a step in which pull and limit are straight lines in time."""
    ratio = step / tau
    decay = np.exp(-ratio)
    gain = np.where(ratio > 0, -np.expm1(-ratio) / np.where(ratio > 0, ratio, 1.0), 1.0)
    unlimited = memory + pull_after
    side = np.copysign(1.0, unlimited)
    # The part of the density beyond the limit: before the step, and after it if nothing relaxed.
    before, after = side * (memory + pull) - limit, side * unlimited - limit_after
    change = after - before
    with np.errstate(divide="ignore", invalid="ignore"):
        # From slip: exact. If it ends within the step, change is all that stick adds after that.
        slides = before * decay + change * gain
        slides = np.where(slides < 0, change * slides / (slides - before), slides)
        # From stick: exact for a crossing of the limit at either end of the step.
        begins = np.where(after > 0, after / (1 + (1 / gain - 1) * after / change), after)
    beyond = np.where(before > 0, slides, begins)
    density = side * (limit_after + np.minimum(beyond, 0.0))
    # A spring that sticks has forgotten nothing: taking the limit away and adding it again would
    # leave no digit of a small density.
    sticks = (before <= 0) & (after <= 0)
    new_memory = np.where(sticks, memory, side * (limit_after + beyond) - pull_after)
    return new_memory, np.where(sticks, unlimited, density)
