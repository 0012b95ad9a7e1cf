"""Springs of spheres that yield: the law of `normal_impact.yielding` with a row of springs.

Friction is at most mu times the pressure, so the pressure itself is needed. Thornton has two, and
at maximum compression they do not agree: the cut one, and that of Hertz with the radius R_p. If
the pressure jumped there, a contact that slides would stick for an instant, or springs would gain
energy. So here the pressure is Hertz's at all times, with the force and the radius a of contact of
the law. Its density is h (a^2 - r^2), where h = F/F_e(a) is the force over that of Hertz's law at
the same radius.

Thornton's sphere is elastic in shear, but metal that yields is not: the flow rule of Prandtl and
Reuss relaxes every component of stress, the small tangential ones too. So while the approach d
grows, the deflection q of a spring decays, q' = u' - q k (d_p/d_y)', at most L. Here d_p is the
permanent part of the approach, d less what would spring back, h d; d_y is where yield begins, and
k is a constant. A contact that slides stays in slip where u' exceeds L' + L k (d_p/d_y)'. That is
largest in the middle, where L = h d, or at the edge, where it is h d'.
"""

from collections.abc import Iterator
from typing import Any

import numpy as np

from planarimpact.common import cubics, roots, sliding
from planarimpact.common.arrays import Array, Booleans, Integers
from planarimpact.continuum import refinement
from planarimpact.continuum.inelastic import peaks
from planarimpact.continuum.inelastic.motion import NormalMotion, Springs
from planarimpact.normal_impact import yielding as law

# Places among which the start of stick in plastic compression is first sought.
PLACES = 33
# Flow in a step below which two terms of a series are exact enough.
SMALL = 1e-5
# Flow in a step up to which a parabola tells where slip stops within it, and the error is known.
MOST_FLOW = 0.5
# Instants at which friction is worked out soon after the first slip, and for how long: two instants
# and this share of the steps.
INSTANTS, AFTER = 24, 1 / 48


class PlasticMotion(NormalMotion):
    """Normal motions of elastic-plastic spheres."""

    dashpots = False

    def __init__(self, restitution: Array) -> None:
        self.restitution = restitution
        self._loading = law.loading(restitution)
        self._unloading = law.unloading(self._loading)
        self._largest = self._loading.largest_approach()
        self.largest_force = self._unloading.force
        self.velocity_at_largest_force = np.zeros_like(self._largest)
        self._last_share = self._loading.share_of_hertz(self._largest)

    def springs(self) -> Springs:
        """Springs without deflection, which flow while the contact yields."""
        return PlasticSprings(self)

    def steps_needed(self, beta: Array, zeta2: Array) -> Array:
        """Steps that resolve the oscillation and the last flow of compression.

        In a step of the angle a, at the end of compression, the approach grows by its share a^2.
        Where all of that flows at once, springs do not load, and the body may slide only after it.
        """
        oscillation = refinement.steps_needed(beta, zeta2, self._last_share)
        most_flow = law.FLOW * self._largest / self._loading.yields
        return np.maximum(oscillation, np.pi * np.sqrt(most_flow / MOST_FLOW))

    def place(self, velocity: Array) -> Array:
        """Angle over pi/2, whose sine is the radius at a velocity over the largest radius."""
        depth = np.minimum(self._loading.approach(velocity), self._largest)
        angle = np.arctan2(np.sqrt(depth), np.sqrt(self._largest - depth))
        back = self._unloading.phase(np.minimum(velocity, 0.0), self.restitution)
        return np.where(velocity > 0, angle, np.pi - back) / (np.pi / 2)

    def put_springs(self, places: Array) -> None:
        """Put springs, and instants, at the places: shares of pi/2, whose sine is the radius."""
        angle = places * (np.pi / 2)
        self.radius = np.sqrt(self._largest) * np.sin(angle)
        rate = np.sqrt(self._largest) * np.cos(angle) * (np.pi / 2)
        rate[-1] = 0.0
        self._set_weights(places, rate)
        depth = self.radius**2
        depth[-1] = self._largest
        time, velocity, force = self._loading.at(depth)
        phase = np.pi - angle[-2::-1]
        later, return_velocity, came_back, return_force = self._unloading.at(
            phase, self.restitution
        )
        self.time = np.concatenate([time, time[-1] + later])
        self.velocity = np.concatenate([velocity, return_velocity])
        self.approach = np.concatenate([depth, self._largest - came_back])
        self.force = np.concatenate([force, return_force])
        share = self._loading.share_of_hertz(depth)
        self._share = np.concatenate([share, np.broadcast_to(self._last_share, return_force.shape)])

    def density(self, instant: int) -> Array:
        """Normal force density h (a^2 - r^2) of the springs that touch."""
        square = self.radius[: self.edge(instant) + 1] ** 2
        return self._share[instant] * (square[-1] - square)

    def limit_at(self, approach: Array, velocity: Array, count: int) -> Array:
        """Density of the normal force of the innermost springs, shape (count, m)."""
        square, share = self._contact(approach, velocity)
        return share * np.maximum(square - self.radius[:count] ** 2, 0.0)

    def flowed(self, approach: Array) -> Array:
        """Flow in shear up to an approach in compression, see `Loading.flow`."""
        return law.FLOW * self._loading.flow(np.clip(approach, 0.0, self._largest))

    def force_at(self, approach: Array, velocity: Array) -> Array:
        """Normal force, shape (m,)."""
        square, share = self._contact(approach, velocity)
        return 4 / 3 * share * square**1.5

    def _contact(self, approach: Array, velocity: Array) -> tuple[Array, Array]:
        """Square of the radius of contact, and the share of Hertz's law."""
        back = self._largest * self._unloading.square(self._largest - approach)
        square = np.where(velocity > 0, np.clip(approach, 0.0, self._largest), back)
        share = self._loading.share_of_hertz(square)
        return square, np.where(velocity > 0, share, self._last_share)

    def instants_after_slip(self, steps: int) -> int:
        """Instants after first slip, where friction grows on, turns and falls within a step."""
        return 2 + int(steps * AFTER)

    def peak_after_slip(self, knots: Array) -> Array:
        """Largest friction soon after the first slip, while one spring after the other sticks.

        Approach and displacement are cubics between the knots.
        """
        count = len(self.radius)
        density, displaced = self.limit_at(knots[0, 1], knots[0, 2], count), knots[0, 3]
        flowed = self.flowed(knots[0, 1])
        times, forces = [knots[0, 0]], [self.force_at(knots[0, 1], knots[0, 2])]
        for left, right in zip(knots, knots[1:], strict=False):
            step = right[0] - left[0]
            for share in np.linspace(0.0, 1.0, 1 + max(2, INSTANTS // len(knots)))[1:]:
                approach = cubics.between(left[1], right[1], step * left[2], step * right[2], share)
                velocity = left[2] + share * (right[2] - left[2])
                u = cubics.between(left[3], right[3], step * left[4], step * right[4], share)
                limit, flow = self.limit_at(approach, velocity, count), self.flowed(approach)
                half = np.where(velocity > 0, np.exp((flowed - flow) / 2), 1.0)
                density = np.minimum(limit, (density * half + u - displaced) * half)
                displaced, flowed = u, flow
                whole = np.sum(self.width * limit, axis=0)
                below_limit = np.sum(self.width * (limit - density), axis=0)
                force = self.force_at(approach, velocity)
                times.append(left[0] + share * step)
                forces.append(force * (1 - below_limit / np.where(whole > 0, whole, 1.0)))
        return peaks.highest(np.stack(times), np.stack(forces))

    def _pull(self, loading: law.Loading, velocity: Array) -> Array:
        """How fast a spring must be pulled to slide, over v, while the contact yields.

        The largest of that at the edge, h, and that in the middle, where the spring flows most.
        """
        depth = loading.plastic_approach(velocity)
        return np.maximum(loading.share_of_hertz(depth), loading.pull(depth, law.FLOW)[0])

    def _pull_of_unloading(self) -> Array:
        """The same in unloading, where it does not change: the limit of friction falls."""
        return self._last_share * self._largest / self._unloading.springs_back

    def end_of_first_slip(self, x: Array, beta: Array, zeta2: Array) -> Array:
        """Normal velocity where w is zeta^2 v times the pull of a spring that slides: slip ends."""
        elastic = super().end_of_first_slip(x, beta, zeta2)
        unloading = super().end_of_first_slip(x, beta, zeta2 * self._pull_of_unloading())
        end = np.where(elastic > 0, elastic, np.minimum(unloading, 0.0))
        # Look for the first time when the body is slower than a spring, between the velocity at
        # yield and that at which the body stands still.
        start = law.elastic_velocity(self._loading.yields)
        latest = np.clip((beta - x) / beta, 0.0, start)
        velocities = start + np.linspace(0.0, 1.0, PLACES)[:, None] * (latest - start)

        def slip_velocity(which: Any, minus_velocity: Array) -> tuple[Array]:
            loading, v = self._loading.take(which), -minus_velocity
            pull = self._pull(loading, v)
            return (x[which] - beta[which] * (1 - v) - zeta2[which] * pull * v,)

        sticks = slip_velocity(slice(None), -velocities)[0] <= 0
        row, column = np.maximum(np.argmax(sticks, axis=0), 1), np.arange(x.size)
        ends = np.flatnonzero((elastic < start) & sticks[row, column])
        before, after = -velocities[row - 1, column], -velocities[row, column]
        end[ends] = -roots.crossing(
            lambda which, v: slip_velocity(ends[which], v), before[ends], after[ends]
        )
        return end

    def slides_from(self, beta: Array, zeta2: Array) -> Array:
        """Incidence from which a contact slides throughout, which may stick while it yields.

        It does not stick if w = x - beta (1 - v) is never below zeta^2 v times the pull in the
        middle. So the limit is the largest value of beta - v (beta - zeta^2 pull), if larger than
        that at the end of unloading. The derivative of this value changes sign once.
        """
        at_end = sliding.limit_alike(beta, zeta2 * self._pull_of_unloading(), self.restitution)
        limit = np.maximum(zeta2, at_end)
        # The pull grows to the end of loading.
        sticks = np.flatnonzero(zeta2 * self._loading.pull(self._largest, law.FLOW)[0] > beta)
        if not sticks.size:
            return limit
        loading, beta, zeta2 = self._loading.take(sticks), beta[sticks], zeta2[sticks]

        def rise(which: Any, depth: Array) -> tuple[Array]:
            chosen = loading.take(which)
            v, force = chosen.motion(depth)
            pull, change = chosen.pull(depth, law.FLOW)
            return (zeta2[which] * change * v**2 - force * (zeta2[which] * pull - beta[which]),)

        depth = roots.crossing(rise, loading.yields, loading.largest_approach())
        v, _ = loading.motion(depth)
        in_loading = beta - v * (beta - zeta2 * loading.pull(depth, law.FLOW)[0])
        limit[sticks] = np.maximum(limit[sticks], in_loading)
        return limit


class PlasticSprings(Springs):
    """Springs that flow while the contact yields: q' = u' - q times the rate of flow, at most L."""

    _motion: PlasticMotion

    def slide(self, k: int, which: Booleans, u: Array) -> None:
        """Put contacts in the state of gross slip: the density of each spring is at its limit."""
        limit = self._motion.density(k)
        for values in (self._limit, self._density):
            values[:, which] = limit[:, which]

    def move(
        self, k: int, step: Array, start: tuple[Array, Array], end: tuple[Array, Array]
    ) -> Array:
        """Tangential force at instant k by springs that flow while the contact yields; a trial.

        Without slip the density of a spring follows q' = u' - q times the rate of flow. In the
        direction g the spring slips while g times that density exceeds the limit more and more.
        Slip takes away the largest excess of the step, which decays to the end of the step as q
        does: `_density`, the density at the end of the step, is less by it. In the step the excess
        is a parabola, through its values at both ends and in the middle. A step over its top leaves
        an error that varies irregularly, which extrapolation cannot remove.
        """
        motion, limit = self._motion, self._motion.density(k)
        count = min(len(limit), len(self._density))
        limits = self._limit[:count], limit[:count]
        early, late = (rate * step for _, rate in (start, end))
        pace, later_pace = motion.velocity[k - 1 : k + 1]
        since, until = motion.approach[k - 1 : k + 1]
        approach = cubics.between(since, until, step * pace, step * later_pace, 0.5)
        first, last = flow = self._flow(k, approach)
        # The density without slip, half a step later and at the end of the step.
        halfway = _trial(self._density[:count], first, early, (early + late) / 2)
        unlimited = _trial(halfway, last, (early + late) / 2, late)
        slips = np.zeros(unlimited.shape, dtype=bool)
        between: Array | None = None
        slowing = (later_pace - pace) * step
        for side, which in _turning(early, late, slowing, limits, flow):
            if between is None:
                between = motion.limit_at(approach, (pace + later_pace) / 2, count)
            decay, half_decay = np.exp(-(first + last)[which]), np.exp(-last[which])
            at_start = decay * (side * self._density[:count, which] - limits[0][:, which])
            at_middle = half_decay * (side * halfway[:, which] - between[:, which])
            at_end = side * unlimited[:, which] - limits[1][:, which]
            top = _top(at_start, at_middle, at_end)
            unlimited[:, which] -= side * np.maximum(top, 0.0)
            slips[:, which] |= top > 0
        density = np.clip(unlimited, -limits[1], limits[1])
        self._slips = slips | (density != unlimited)
        if count < len(limit):  # a spring comes into contact, without deflection
            density = np.vstack([density, np.zeros_like(step)])
        self._tried = limit, density
        return self._sum(k)

    def _flow(self, k: int, halfway: Array) -> Array:
        """Flow in the halves of the step to instant k, (2, m); `halfway` is the approach there."""
        motion = self._motion
        if k >= len(motion.radius):  # unloading
            return np.zeros((2, halfway.size))
        since, until = motion.approach[k - 1 : k + 1]
        return np.diff(motion.flowed(np.stack([since, halfway, until])), axis=0)

    def settle(self, k: int) -> Array:
        """Keep the last trial; return 0, as the work follows from the velocity at the end."""
        self._keep(self._slips)
        return np.zeros_like(self.stick_radius)


def _turning(
    early: Array, late: Array, slowing: Array, limits: tuple[Array, Array], flow: Array
) -> Iterator[tuple[float, Integers]]:
    """The contacts in which a spring may turn within a step, by the direction in which it slips.

    A spring turns if the rate of its limit lies between those of the body, `early` and `late`. That
    rate differs from the edge, where the limit grows most, to the middle, where most has flowed.
    `slowing` is the change of the normal velocity. All are multiplied by the length of the step.
    """
    (before, after), flowed = limits, flow[0] + flow[1]
    grown = after[-1] - before[-1]
    most = np.maximum(grown, after[0] - before[0] + flowed * after[0])
    for side in (1.0, -1.0):
        bend = slowing + side * (early - late)
        turns = side * early > np.minimum(grown, 0.0) - bend
        turns &= flowed < MOST_FLOW
        turns &= (side * late < np.maximum(most, 0.0) + bend) & (side * early > side * late)
        which = np.flatnonzero(turns)
        if which.size:
            yield side, which


def _top(at_start: Array, middle: Array, at_end: Array) -> Array:
    """Largest value within a step of a parabola through these three."""
    bulge = np.maximum(8 * middle - 4 * (at_start + at_end), 1e-300)
    part = np.clip(0.5 + (at_end - at_start) / bulge, 0.0, 1.0)
    return at_start + part * (at_end - at_start + (1 - part) * bulge / 2)


def _trial(density: Array, flow: Array, early: Array, late: Array) -> Array:
    """Density without slip half a step later, for rates of displacement at its ends."""
    if not flow.any():  # so in all of unloading
        return density + (early * 0.5 + late * 0.5) / 2
    return np.exp(-flow) * density + _gain(flow, early, late) / 2


def _gain(flow: Array, early: Array, late: Array) -> Array:
    """Deflection after a time in which its rate goes from `early` to `late` while it decays.

    It decays at a constant rate, by exp(-flow) in all.
    """
    small = flow < SMALL
    safe = np.where(small, 1.0, flow)
    mean = np.where(small, 1 - flow / 2, -np.expm1(-safe) / safe)
    first = np.where(small, 0.5 - flow / 3, (1 - np.exp(-safe) * (1 + safe)) / safe**2)
    return early * first + late * (mean - first)
