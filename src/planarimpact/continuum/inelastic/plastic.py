"""Springs of elastic-plastic spheres: the law of `normal_impact.yielding` with a row of springs.

Friction is at most mu times the pressure, so the pressure itself is needed. Thornton has two, and
at maximum compression they do not agree: the cut one, and that of Hertz with the radius R_p. If
the pressure jumped there, a contact that slides would stick for an instant, or springs would gain
energy. So here the pressure is Hertz's at all times, with the force and the radius of contact of
Thornton's law. Its density is b (a^2 - r^2), with the bluntness b = F/F_e(a).

Thornton's sphere is elastic in shear, but metal that yields is not: the flow rule of Prandtl and
Reuss relaxes every component of stress, the small tangential ones too. So while the approach d
grows, the deflection q of a spring decays, q' = u' - q k (d_p/d_y)', at most L. Here d_p is the
permanent part of the approach, d less what would spring back, b d; d_y is where yield begins, and
k is a constant. A contact that slides stays in slip where u' exceeds L' + L k (d_p/d_y)'. That is
largest in the middle, where L = b d, or at the edge, where it is b d'.
"""

import numpy as np

from planarimpact.continuum.inelastic.motion import NormalMotion
from planarimpact.continuum.inelastic.springs import SpringRow
from planarimpact.ground.arrays import Array, Booleans
from planarimpact.normal_impact import hertz
from planarimpact.normal_impact import yielding as law

# Places where the start of stick in plastic compression is sought before it is homed in.
PLACES = 33
# Halvings to the last bit of a number.
BISECTIONS = 60
# Flow in a step below which two terms of a series are exact enough.
SMALL = 1e-5
# Flow in a step up to which a parabola tells where slip stops within it.
MOST_FLOW = 0.5


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
    # Factor of the flow in shear.
    flows = law.FLOW

    def __init__(self, restitution: Array) -> None:
        self.restitution = restitution
        self._law = law.compression(restitution)
        self._largest = self._law.largest_approach()
        self.largest_force = self._law.largest_force()
        self.velocity_at_largest_force = np.zeros_like(self._largest)
        self._last_blunt = self._law.bluntness(self._largest)
        self._turn = self._law.at(self._largest)[0]
        self._unloading = self._last_blunt * self._largest / restitution * hertz.COMPRESSION

    def row(self) -> SpringRow:
        """Springs for this motion, without deflection."""
        return PlasticRow(self)

    @staticmethod
    def least_bluntness(restitution: Array) -> Array:
        """As in `NormalMotion`: at the end of compression."""
        compression = law.compression(restitution)
        return compression.bluntness(compression.largest_approach())

    def place(self, velocity: Array) -> Array:
        """As in `NormalMotion`: the angle whose sine is the radius, over a right angle."""
        depth = self._depth(velocity)
        angle = np.arctan2(np.sqrt(depth), np.sqrt(self._largest - depth))
        back = np.pi - hertz.phase_at(np.clip(velocity / self.restitution, -1.0, 0.0))
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
        self.velocity = np.concatenate([velocity, self.restitution * hertz.velocity(phase)])
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

    def limit_at(self, approach: Array, velocity: Array, count: int) -> Array:
        """Density of the normal force of the innermost springs, shape (count, m)."""
        depth, blunt = self._contact(approach, velocity)
        return blunt * np.maximum(depth - self.radius[:count] ** 2, 0.0)

    def flowed(self, approach: Array) -> Array:
        """Flow in shear up to an approach in compression, see `Compression.flow`."""
        return self.flows * self._law.flow(np.clip(approach, 0.0, self._largest))

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
        """As in `NormalMotion`: where w = zeta^2 v, while it yields zeta^2 v times the `_pace`."""
        alike = super().grip(x, beta, zeta2)
        # Look for the first time when the body is slower than a spring, between the end of elastic
        # compression and the time when the body stands still.
        plastic = np.sqrt(np.maximum(1 - 2 * hertz.ENERGY * self._law.yields**2.5, 0.0))
        latest = np.clip((beta - x) / beta, 0.0, plastic)
        places = plastic + np.linspace(0.0, 1.0, PLACES)[:, None] * (latest - plastic)

        def lead(velocity: Array) -> Array:
            return x - beta * (1 - velocity) - zeta2 * self._pace(velocity) * velocity

        behind = lead(places) <= 0
        row = np.maximum(np.argmax(behind, axis=0), 1)
        column = np.arange(x.size)
        high, low = places[row - 1, column], places[row, column]
        for _ in range(BISECTIONS):
            middle = (low + high) / 2
            ahead = lead(middle) > 0
            low, high = np.where(ahead, low, middle), np.where(ahead, middle, high)
        return np.where((alike < plastic) & behind[row, column], low, alike)

    def slides_from(self, beta: Array, zeta2: Array) -> Array:
        """As in `NormalMotion`: a contact that yields may stick in the middle for a while.

        It does not if w = x - beta (1 - v) is never below zeta^2 v times the pull in the middle. So
        the limit is the largest value of beta - v (beta - zeta^2 pull), if that is larger than what
        `sliding.limit_alike` says. Its derivative changes sign once.
        """
        found = super().slides_from(beta, zeta2)
        sticks = zeta2 * self._law.pull(self._largest, self.flows)[0] > beta  # it grows to the end
        if not sticks.any():
            return found
        some = law.Compression(*(a[sticks] for a in self._law))
        beta, zeta2 = beta[sticks], zeta2[sticks]
        low, high = some.yields, some.largest_approach()
        for _ in range(BISECTIONS):
            depth = (low + high) / 2
            _, v, force = some.at(depth)
            pull, change = some.pull(depth, self.flows)
            rises = zeta2 * change * v**2 > force * (zeta2 * pull - beta)
            low, high = np.where(rises, depth, low), np.where(rises, high, depth)
        _, v, _ = some.at(low)
        in_compression = beta - v * (beta - zeta2 * some.pull(low, self.flows)[0])
        found[sticks] = np.maximum(found[sticks], in_compression)
        return found

    def _pace(self, velocity: Array) -> Array:
        """How fast a spring must be pulled to slide, over v, in plastic compression.

        The largest of that at the edge, b, and that in the middle, where the spring flows most.
        """
        share = np.clip(velocity / (self._law.rate * self._law.reach), 0.0, 1.0)
        depth = self._law.centre + self._law.reach * np.sqrt((1 - share) * (1 + share))
        return np.maximum(self._law.bluntness(depth), self._law.pull(depth, self.flows)[0])


class ElasticInShear(Thornton):
    """Thornton's own sphere, which forgets no shear while it yields."""

    flows = 0.0


class PlasticRow(SpringRow):
    """Springs that flow while the contact yields: q' = u' - q times the rate of flow, at most L."""

    _motion: Thornton

    def slide(self, k: int, which: Booleans, u: Array) -> None:
        """As in `SpringRow`."""
        limit = self._motion.density(k)
        for mine in (self._limit, self._density):
            mine[:, which] = limit[:, which]

    def move(
        self, k: int, step: Array, start: tuple[Array, Array], end: tuple[Array, Array]
    ) -> Array:
        """As in `SpringRow`.

        Slip in direction g stops when g q less the limit, without slip, is largest; what has flowed
        since is taken from it as from q. Every slipped spring remembers that value. In the step it
        is a parabola, through its values at both ends and in the middle. A step over its top leaves
        an error that varies irregularly, which extrapolation cannot remove.
        """
        motion, limit = self._motion, self._motion.density(k)
        count = min(len(limit), len(self._density))
        before, after = self._limit[:count], limit[:count]
        held = self._density[:count]
        pace, later_pace = motion.velocity[k - 1 : k + 1]
        since, until = motion.approach[k - 1 : k + 1]
        approach = cubic(0.5, since, until, step * pace, step * later_pace)
        early, late = (rate * step for _, rate in (start, end))
        loads = k < len(motion.radius)
        if loads:
            flowed = motion.flowed(np.stack([since, approach, until]))
            first, last = np.diff(flowed, axis=0)
        else:
            first = last = np.zeros_like(step)
        # Without slip, half a step later and at its end.
        halfway = np.exp(-first) * held + _gain(first, early, (early + late) / 2) / 2
        wanted = np.exp(-last) * halfway + _gain(last, (early + late) / 2, late) / 2
        slips = np.zeros(held.shape, dtype=bool)
        # A spring turns if the rate of its limit lies between those of the body. That rate differs
        # from the edge, where the limit grows most, to the middle, where most has flowed.
        grown = after[-1] - before[-1]
        most = np.maximum(grown, after[0] - before[0] + (first + last) * after[0])
        slowing = (later_pace - pace) * step
        between: Array | None = None
        for side in (1.0, -1.0):
            bend = slowing + side * (early - late)
            turns = side * early > np.minimum(grown, 0.0) - bend
            turns &= first + last < MOST_FLOW
            turns &= (side * late < np.maximum(most, 0.0) + bend) & (side * early > side * late)
            which = np.flatnonzero(turns)
            if not which.size:
                continue
            if between is None:
                between = motion.limit_at(approach, (pace + later_pace) / 2, count)
            fade, rest = np.exp(-(first + last)[which]), np.exp(-last[which])
            at_start = fade * (side * held[:, which] - before[:, which])
            middle = rest * (side * halfway[:, which] - between[:, which])
            at_end = side * wanted[:, which] - after[:, which]
            bulge = np.maximum(8 * middle - 4 * (at_start + at_end), 1e-300)
            part = np.clip(0.5 + (at_end - at_start) / bulge, 0.0, 1.0)
            top = at_start + part * (at_end - at_start + (1 - part) * bulge / 2)
            wanted[:, which] -= side * np.maximum(top, 0.0)
            slips[:, which] |= top > 0
        density = np.clip(wanted, -after, after)
        self._slips = slips | (density != wanted)
        if count < len(limit):  # a spring comes into contact, without deflection
            density = np.vstack([density, np.zeros_like(step)])
        self._tried = limit, density
        return self._sum(k)

    def settle(self, k: int) -> Array:
        """As in `SpringRow`; the work follows from the velocity at the end."""
        self._keep(self._slips)
        return np.zeros_like(self.stick_radius)


def _gain(flow: Array, early: Array, late: Array) -> Array:
    """Deflection after a time in which its rate goes from `early` to `late` while it decays.

    It decays at a constant rate, by exp(-flow) in all.
    """
    small = flow < SMALL
    safe = np.where(small, 1.0, flow)
    mean = np.where(small, 1 - flow / 2, -np.expm1(-safe) / safe)
    first = np.where(small, 0.5 - flow / 3, (1 - np.exp(-safe) * (1 + safe)) / safe**2)
    return early * first + late * (mean - first)


def cubic(share: float, before: Array, after: Array, rise: Array, fall: Array) -> Array:
    """Cubic through two values with two changes by the step, at a share of the step."""
    change = after - before
    bend = 3 * change - 2 * rise - fall + share * (rise + fall - 2 * change)
    return before + share * (rise + share * bend)
