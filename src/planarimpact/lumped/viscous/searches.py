"""Where phases end: the first instant at which stick breaks, and at which slip stops.

Directions are mirrored so that T > 0 where a phase starts: stick with T of either sign follows slip
in direction +1. A phase has a margin, and ends where that passes from positive to negative: in
stick N - |T|, in slip the slip velocity w_s. One search finds this place for both. It needs to know
where the margin is lowest, and this is how.

**Stick.** With b = beta/zeta^2, W = |T|'N - |T|N' is the slope of |T|/N times N^2, and

    (exp(2 gamma t) W)' = -(b - 1) |T| (N + tau N') exp(2 gamma t).

N + tau N' is positive before an instant t_M and negative after it. So in a piece of time that
holds neither t_M nor a zero of T, exp(2 gamma t) W only rises or only falls: W has one zero at
most. At a zero of T that starts a piece W > 0, and at one that ends it W < 0.

**Slip.** w_s = A + k v + B y with k = beta - zeta^2, the rate of compression v, and
y = exp(-t/tau); see `planarimpact.lumped.viscous`. So

    w_s' = -y (k N/y + B/tau),   (N/y)' = (N + tau N')/(tau y).

In a piece that does not hold t_M, N/y only rises or only falls: w_s' has one zero at most.

**The search** goes through these pieces in order. In each of them the margin, over N in stick, has
one extremum at most. If it falls at the start of the piece and rises at the end, it is lowest
between; else it is lowest at an end, and at the start it is known to be positive. If it is negative
where it is lowest, it passes zero once before, and the phase ends there. Else the next piece
follows. N = 0 at separation, so stick ends there if not before; slip may last.

A phase starts where its margin is 0, but in the first instants of contact. Rounding must not end it
there, so a margin is enlarged by what rounding may take from it.
"""

from typing import NamedTuple, TypeAlias, TypeVar

import numpy as np

from planarimpact.ground import roots
from planarimpact.ground.arrays import Array, Integers
from planarimpact.lumped.viscous.elements import Elements

# What rounding may take from a margin, as a share of its terms.
ROUNDING = 1e-14

_Phase = TypeVar("_Phase", "Stick", "Slip")
# N, v, T, w and s of a phase at some times.
State: TypeAlias = tuple[Array, Array, Array, Array, Array]


class Stick(NamedTuple):
    """Stick of some impacts, from friction T > 0 and velocity w at the start on.

    Arrays of shape (n,). T and w are positive in the direction `side` of the incidence.
    """

    elements: Elements
    start: Array
    side: Array
    friction: Array
    velocity: Array

    def state(self, time: Array) -> State:
        """N, v, T, w and s at these times."""
        elements = self.elements
        friction, velocity = elements.stick(self.friction, self.velocity, time - self.start)
        spring = elements.zeta2 * friction - 2 * elements.xi * velocity
        return *elements.motion(time), friction, velocity, spring

    def slope(self, friction: Array, velocity: Array) -> Array:
        """T'."""
        return velocity / self.elements.zeta2 - 2 * self.elements.gamma * friction

    def first_zero(self) -> Array:
        """When T first vanishes; infinite if never."""
        slope = self.slope(self.friction, self.velocity)
        return self.start + self.elements.first_zero(self.friction, slope)

    def first_crest(self) -> Array:
        """When T' first vanishes, so |T| is largest; infinite if never."""
        elements = self.elements
        slope = self.slope(self.friction, self.velocity)
        bend = -2 * elements.gamma * slope - elements.b * self.friction
        sign = np.where(slope < 0, -1.0, 1.0)
        return self.start + elements.first_zero(sign * slope, sign * bend)

    def margin(self, sign: Array, time: Array) -> tuple[Array, Array]:
        """N - |T| where T has this sign, and its rate.

        Friction is in units of mu, so Coulomb's limit is the normal force itself.
        """
        force, v, friction, velocity, _ = self.state(time)
        rate = v - 2 * self.elements.xi * force
        margin_rate = (1 + ROUNDING) * rate - sign * self.slope(friction, velocity)
        return (1 + ROUNDING) * force - sign * friction, margin_rate

    def descent(self, sign: Array, time: Array) -> tuple[Array, Array]:
        """W, positive where N/|T| falls, and its rate."""
        elements, tau = self.elements, 2 * self.elements.xi
        force, v, friction, velocity, _ = self.state(time)
        rate = v - tau * force
        value = sign * (self.slope(friction, velocity) * force - friction * rate)
        growth = (elements.b - 1) * sign * friction * (force + tau * rate)
        return value, -2 * elements.gamma * value - growth


class Slip(NamedTuple):
    """Slip of some impacts in direction `side`, with w_s = `constant` + k v + `transient` y.

    Arrays of shape (n,). The margin does not depend on the sign of T.
    """

    elements: Elements
    start: Array
    side: Array
    constant: Array
    transient: Array

    def decay(self, time: Array) -> Array:
        """y = exp(-t/tau), with t from the start."""
        return np.exp((self.start - time) / (2 * self.elements.xi))

    def state(self, time: Array) -> State:
        """N, v, T, w and s at these times."""
        tau, zeta2 = 2 * self.elements.xi, self.elements.zeta2
        force, v = self.elements.motion(time)
        spring = zeta2 * (force - tau * v) + tau * self.transient * self.decay(time)
        return force, v, force, self.constant + self.elements.beta * v, spring

    def first_zero(self) -> Array:
        """Infinite: T does not vanish."""
        return np.full_like(self.start, np.inf)

    def margin(self, _: Array, time: Array) -> tuple[Array, Array]:
        """w_s, and its rate."""
        elements = self.elements
        k = elements.beta - elements.zeta2
        force, v = elements.motion(time)
        rest = self.transient * self.decay(time)
        rounding = ROUNDING * (elements.beta + elements.zeta2 + np.abs(self.constant))
        value = self.constant + k * v + rest + rounding
        return value, -k * force - rest / (2 * elements.xi)

    def descent(self, _: Array, time: Array) -> tuple[Array, Array]:
        """-w_s', and its rate."""
        elements, tau = self.elements, 2 * self.elements.xi
        k = elements.beta - elements.zeta2
        force, v = elements.motion(time)
        rest = self.transient * self.decay(time) / tau
        return k * force + rest, k * (v - tau * force) - rest / tau


def take(phase: _Phase, which: Integers) -> _Phase:
    """The impacts with these indices, which are in order and different."""
    if which.size == phase.start.size:
        return phase
    return type(phase)(phase.elements.take(which), *(field[which] for field in phase[1:]))


def phase_end(phase: Stick | Slip) -> tuple[Array, Array]:
    """When phases end, at separation if not before, and the sign of T in stick there."""
    turn, half_wave = phase.elements.shifted_zero(2), phase.elements.half_wave()
    end, end_sign = np.zeros_like(phase.start), np.ones_like(phase.start)
    which, low, sign, zero = np.arange(end.size), phase.start, end_sign, phase.first_zero()
    falls = phase.descent(sign, low)[0] > 0
    while which.size:
        # The next piece, and where the margin is lowest in it.
        high = np.minimum(zero, 0.0)
        high = np.where(low < turn, np.minimum(high, turn), high)
        part = take(phase, which)
        rises = part.descent(sign, high)[0] < 0
        lowest = high.copy()
        between = np.flatnonzero(falls & rises)
        lowest[between] = _crossing(part, "descent", between, sign, low, high)
        ends = part.margin(sign, lowest)[0] <= 0
        found = np.flatnonzero(ends)
        end[which[found]] = _crossing(part, "margin", found, sign, low, lowest)
        end_sign[which] = sign
        # T turns its sign at a zero, where the margin over N starts to fall.
        follows = np.flatnonzero(~ends & (high < 0))
        at_zero = (high == zero)[follows]
        falls = at_zero | ~rises[follows]
        sign = np.where(at_zero, -1.0, 1.0) * sign[follows]
        turn, half_wave, zero = turn[follows], half_wave[follows], zero[follows]
        zero = zero + np.where(at_zero, half_wave, 0.0)
        which, low = which[follows], high[follows]
    return end, end_sign


def _crossing(
    phase: Stick | Slip, name: str, which: Integers, sign: Array, low: Array, high: Array
) -> Array:
    """Where the method of this name, of some of the impacts, passes zero between bounds."""
    part, sign = take(phase, which), sign[which]

    def function(index: Integers, time: Array) -> tuple[Array, Array]:
        value: tuple[Array, Array] = getattr(take(part, index), name)(sign[index], time)
        return value

    return roots.crossing(function, low[which], high[which])
