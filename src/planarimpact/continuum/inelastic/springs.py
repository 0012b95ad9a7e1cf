"""The springs of an inelastic contact, moved sideways from instant to instant."""

import numpy as np

from planarimpact.continuum.inelastic.normal_motion import NormalMotion
from planarimpact.ground.arrays import Array, Booleans


class SpringRow:
    """The springs of many contacts, innermost first, moved together from instant to instant.

    Attributes
    ----------
    stick_radius : ndarray, shape (n,)
        Radius inside which no spring slipped in the last step.
    """

    def __init__(self, motion: NormalMotion) -> None:
        self._motion = motion
        n = motion.tau.size
        # Memory c, limit L and tangential density of the springs that touch.
        self._memory, self._limit, self._density = np.zeros((3, 1, n))
        self._next = self._memory, self._limit, self._density

    def slide(self, k: int, which: Booleans, u: Array) -> None:
        """Put contacts in the state of gross slip at instant k, which is the last one."""
        velocity = self._motion.velocity[k]
        deflection = self._motion.sliding_deflection(
            self._motion.approach[k], velocity, len(self._memory)
        )
        limit = deflection + self._motion.tau * velocity
        for mine, new in zip(
            (self._memory, self._limit, self._density), (deflection - u, limit, limit), strict=True
        ):
            mine[:, which] = new[:, which]

    def move(
        self, k: int, step: Array, start: tuple[Array, Array], end: tuple[Array, Array]
    ) -> Array:
        """Tangential force at instant k if the body moves from one (u, u') to another; a trial.

        `step` is the time since the last instant, 0 for contacts that still slide from the start.
        """
        motion = self._motion
        limit = motion.density(k)
        pull, later = (u + motion.tau * rate for u, rate in (start, end))
        count = min(len(limit), len(self._memory))
        parts = self._memory[:count], self._limit[:count], limit[:count]
        if motion.viscous:
            memory, density = _relaxed(*parts, pull, later, step, motion.tau)
        else:
            wanted = self._turned(k, parts, step, start, end) + later
            density = np.clip(wanted, -limit[:count], limit[:count])
            memory = density - later
        if count < len(limit):  # a spring comes into contact, without deflection
            edge = np.clip(later - end[0], -limit[-1], limit[-1])
            memory, density = np.vstack([memory, -end[0]]), np.vstack([density, edge])
        self._next = memory, limit, density
        return self._sum(k)

    def _turned(
        self,
        k: int,
        parts: tuple[Array, Array, Array],
        step: Array,
        start: tuple[Array, Array],
        end: tuple[Array, Array],
    ) -> Array:
        """Memory after slip that ends within a step.

        Slip in direction g stops when g u less the limit is largest. Every slipped spring remembers
        that value. In the step it is a parabola, through its values at both ends and in the middle.
        A step over its top leaves an error that varies irregularly, which extrapolation cannot
        remove.
        """
        memory, limit, limit_after = parts
        motion, count = self._motion, len(memory)
        grown = limit_after[-1] - limit[-1]  # what the limit gains at the edge, and less inside
        pace, later_pace = motion.velocity[k - 1 : k + 1]
        slowing = (later_pace - pace) * step
        between: Array | None = None
        for side in (1.0, -1.0):
            early, late = (side * rate * step for _, rate in (start, end))
            bend = slowing + early - late
            # A spring turns if the rate of its limit lies between those of the body.
            turns = (early > np.minimum(grown, 0.0) - bend) & (late < np.maximum(grown, 0.0) + bend)
            which = np.flatnonzero(turns & (early > late))
            if not which.size:
                continue
            if between is None:
                since, until = motion.approach[k - 1 : k + 1]
                approach = cubic(0.5, since, until, step * pace, step * later_pace)
                between = motion.sliding_deflection(approach, (pace + later_pace) / 2, count)
                halfway = cubic(0.5, start[0], end[0], step * start[1], step * end[1])
                memory = memory.copy()
            c = parts[0][:, which]
            before = side * (c + start[0][which]) - limit[:, which]
            middle = side * (c + halfway[which]) - between[:, which]
            after = side * (c + end[0][which]) - limit_after[:, which]
            bulge = np.maximum(8 * middle - 4 * (before + after), 1e-300)
            part = np.clip(0.5 + (after - before) / bulge, 0.0, 1.0)
            top = before + part * (after - before + (1 - part) * bulge / 2)
            memory[:, which] -= side * np.maximum(top, 0.0)
        return memory

    def settle(self, k: int) -> Array:
        """Keep the last trial; return the work of friction over zeta^2 in its step."""
        memory, _, density = self._next
        count = min(len(memory), len(self._memory))
        slid = self._memory[:count] - memory[:count]
        mean = (self._density[:count] + density[:count]) / 2
        width = self._motion.width[:count]
        work = 2 * np.sum(width * mean * slid, axis=0)
        first = np.argmax(slid != 0, axis=0)
        column = np.arange(first.size)
        stuck = slid[first, column] == 0
        inner = self._motion.radius[np.where(stuck, len(density) - 1, first), column]
        self.stick_radius = inner
        self._memory, self._limit, self._density = self._next
        return work

    def strain(self) -> Array:
        """Strain energy over zeta^2 of elastic springs, whose density is their deflection."""
        width = self._motion.width[: len(self._density)]
        return np.sum(width * self._density**2, axis=0)

    def _sum(self, k: int) -> Array:
        """Friction at instant k: mu times the normal force times the share of the limits."""
        _, limit, density = self._next
        width = self._motion.width[: len(limit)].copy()
        width[-1] = self._motion.edge_width[len(limit) - 1]
        whole = np.sum(width * limit, axis=0)
        share = np.sum(width * density, axis=0) / np.where(whole > 0, whole, 1.0)
        return share * self._motion.force[k]


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
    wanted = memory + pull_after
    side = np.copysign(1.0, wanted)
    # What is beyond the limit before the step, and after it if nothing relaxed.
    before, after = side * (memory + pull) - limit, side * wanted - limit_after
    change = after - before
    with np.errstate(divide="ignore", invalid="ignore"):
        # From slip: exact. If it ends within the step, change is all that stick adds after that.
        slides = before * decay + change * gain
        slides = np.where(slides < 0, change * slides / (slides - before), slides)
        # From stick: exact for a crossing of the limit at either end of the step.
        begins = np.where(after > 0, after / (1 + (1 / gain - 1) * after / change), after)
    beyond = np.where(before > 0, slides, begins)
    density = side * (limit_after + np.minimum(beyond, 0.0))
    return side * (limit_after + beyond) - pull_after, density


def cubic(share: float, before: Array, after: Array, rise: Array, fall: Array) -> Array:
    """Cubic through two values with two changes by the step, at a share of the step."""
    change = after - before
    bend = 3 * change - 2 * rise - fall + share * (rise + fall - 2 * change)
    return before + share * (rise + share * bend)
