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
one extremum at most. If it falls where the piece starts and rises where it ends, it is lowest
between; else it is lowest at the end, as it is known not to be negative at the start. If it is
negative where it is lowest, it passes zero once before, and the phase ends there. Else the next
piece follows. N = 0 at separation, so stick ends there if not before; slip may last. Few minima of
stick need a search: T^2 + T'^2/b does not grow, so |T| often cannot reach N after a zero of T.

**The first piece.** Between slip and stick s' has no jump, so T' in stick is N' + tau w_s'/zeta^2
with w_s' in slip. Where slip stops w_s' <= 0: the margin of stick starts from 0 and does not fall.
Where stick breaks W >= 0, so w_s' >= 0: the same holds of slip. At contact W has the sign of 1 - b
in stick, and w_s' = -k N in slip has one sign all along.

No search needs the place where a phase starts with a margin of 0. But rounding may make it
negative, so a phase ends only where its margin falls below what rounding takes from it.
"""

from typing import Any, NamedTuple, TypeVar

import numpy as np

from planarimpact.common import roots
from planarimpact.common.arrays import Array, Booleans, Integers
from planarimpact.lumped.viscous.elements import Elements

# What rounding may take from a margin, as a share of its terms.
ROUNDING = 1e-15
# The margin where it is lowest errs by the square of the error of the place, a share of the piece.
LOWEST = 1e-6

_Phase = TypeVar("_Phase", bound="Stick | Slip")


class Course(NamedTuple):
    """A margin with two derivatives, its descent with one, and what rounding may take from it."""

    margin: Array
    rate: Array
    bend: Array
    descent: Array
    descent_rate: Array
    rounding: Array


MARGIN, DESCENT = slice(0, 3), slice(3, 5)


class Stick(NamedTuple):
    """Stick of some impacts, from friction T > 0 and velocity w at the start on.

    Arrays of shape (n,). T and w are positive in the direction `side` of the incidence.
    """

    elements: Elements
    start: Array
    side: Array
    friction: Array
    velocity: Array

    def tangential(self, time: Array) -> tuple[Array, Array]:
        """T and w at these times."""
        return self.elements.stick(self.friction, self.velocity, time - self.start)

    def state(self, time: Array) -> tuple[Array, Array, Array, Array]:
        """N, T, w and s at these times."""
        force, _ = self.elements.motion(time)
        friction, velocity = self.tangential(time)
        spring = self.elements.zeta2 * friction - 2 * self.elements.xi * velocity
        return force, friction, velocity, spring

    def slope(self, friction: Array, velocity: Array) -> Array:
        """T'."""
        return velocity / self.elements.zeta2 - 2 * self.elements.gamma * friction

    def first_piece(self) -> tuple[Array, Booleans]:
        """When T first vanishes, infinite if never, and whether the margin falls at the start."""
        elements = self.elements
        slope = self.slope(self.friction, self.velocity)
        falls = (self.start <= elements.contact()) & (elements.b < 1)
        return self.start + elements.first_zero(self.friction, slope), falls

    def first_crest(self) -> Array:
        """When T' first vanishes, so |T| is largest; infinite if never."""
        elements = self.elements
        slope = self.slope(self.friction, self.velocity)
        bend = -2 * elements.gamma * slope - elements.b * self.friction
        sign = np.where(slope < 0, -1.0, 1.0)
        return self.start + elements.first_zero(sign * slope, sign * bend)

    def course(self, sign: Array, time: Array) -> Course:
        """The margin N - |T|, where T has this sign, with the descent W.

        Friction is in units of mu, so Coulomb's limit is the normal force itself.
        """
        elements, tau, decay = self.elements, 2 * self.elements.xi, 2 * self.elements.gamma
        force, v = elements.motion(time)
        friction, velocity = self.tangential(time)
        force_rate, friction_rate = v - tau * force, sign * self.slope(friction, velocity)
        friction = sign * friction
        descent = friction_rate * force - friction * force_rate
        return Course(
            force - friction,
            force_rate - friction_rate,
            decay * friction_rate + elements.b * friction - tau * force_rate - force,
            descent,
            -decay * descent - (elements.b - 1) * friction * (force + tau * force_rate),
            ROUNDING * force,
        )


class Slip(NamedTuple):
    """Slip of some impacts from velocity w on, with w_s = `constant` + k v + `transient` y.

    Arrays of shape (n,). w is positive in the direction `side` of the incidence.
    """

    elements: Elements
    start: Array
    side: Array
    velocity: Array
    constant: Array
    transient: Array

    def decay(self, time: Array) -> Array:
        """y = exp(-t/tau), with t from the start."""
        return np.exp((self.start - time) / (2 * self.elements.xi))

    def state(self, time: Array) -> tuple[Array, Array, Array, Array]:
        """N, T, w and s at these times; T is N, as the contact slips."""
        tau, zeta2 = 2 * self.elements.xi, self.elements.zeta2
        force, v = self.elements.motion(time)
        spring = zeta2 * (force - tau * v) + tau * self.transient * self.decay(time)
        return force, force, self.constant + self.elements.beta * v, spring

    def first_piece(self) -> tuple[Array, Booleans]:
        """Infinity, as T never vanishes; False, as w_s falls all along if it falls at first."""
        return np.full_like(self.start, np.inf), np.zeros(self.start.size, bool)

    def slip_velocity(self, v: Array, time: Array) -> Array:
        """w_s, from the rate of compression."""
        k = self.elements.beta - self.elements.zeta2
        return self.constant + k * v + self.transient * self.decay(time)

    def course(self, _: Array, time: Array) -> Course:
        """The margin w_s, with the descent -w_s'."""
        elements, tau = self.elements, 2 * self.elements.xi
        k = elements.beta - elements.zeta2
        force, v = elements.motion(time)
        rest = self.transient * self.decay(time)
        rounding = ROUNDING * (elements.beta + elements.zeta2 + np.abs(self.constant))
        descent = k * force + rest / tau
        growth = k * (v - tau * force) - rest / (tau * tau)
        margin = self.constant + k * v + rest
        return Course(margin, -descent, -growth, descent, growth, rounding)


def take(phase: _Phase, which: Integers) -> _Phase:
    """The impacts with these indices, which are in order and different."""
    if which.size == phase.start.size:
        return phase
    fields: Any = (field[which] for field in phase[1:])
    return type(phase)(phase.elements.take(which), *fields)


def phase_end(phase: Stick | Slip) -> tuple[Array, Array]:
    """When phases end, at separation if not before, and the sign of T in stick there."""
    turn, half_wave = phase.elements.shifted_zero(2), phase.elements.half_wave()
    end, end_sign = np.zeros_like(phase.start), np.ones_like(phase.start)
    which, low, sign = np.arange(end.size), phase.start, end_sign
    zero, falls = phase.first_piece()
    margin, rise = np.zeros_like(end), np.full_like(end, np.inf)
    while which.size:
        # The next piece, from `low` to `high`, and where the margin is lowest in it.
        high = np.minimum(zero, 0.0)
        high = np.where(low < turn, np.minimum(high, turn), high)
        part = take(phase, which)
        course, lowest = part.course(sign, high), high.copy()
        ends, rises = course.margin <= -course.rounding, course.descent < 0
        # N is least at an end of a piece. At a zero of T it is the margin, and W is |T|' N.
        least = np.minimum(margin, course.margin)
        may_end = least * margin * np.sqrt(part.elements.b) < rise
        between = np.flatnonzero(falls & rises & ~ends & may_end)
        if between.size:
            lowest[between] = _crossing(DESCENT, part, between, sign, low, high)
            dip = take(part, between).course(sign[between], lowest[between])
            ends[between] = dip.margin <= -dip.rounding
        found = np.flatnonzero(ends)
        end[which[found]] = _crossing(MARGIN, part, found, sign, low, lowest)
        end_sign[which] = sign
        # At a zero T turns its sign, and the margin over N starts to fall.
        follows = np.flatnonzero(~ends & (high < 0))
        at_zero = (high == zero)[follows]
        falls = at_zero | ~rises[follows]
        sign = np.where(at_zero, -1.0, 1.0) * sign[follows]
        turn, half_wave, zero = turn[follows], half_wave[follows], zero[follows]
        zero = zero + np.where(at_zero, half_wave, 0.0)
        which, low = which[follows], high[follows]
        margin, rise = course.margin[follows], np.where(at_zero, -course.descent[follows], np.inf)
    return end, end_sign


def _crossing(
    what: slice, phase: Stick | Slip, which: Integers, sign: Array, low: Array, high: Array
) -> Array:
    """Where MARGIN or DESCENT of some of the impacts passes zero between bounds."""
    phase, sign = take(phase, which), sign[which]

    def function(index: Integers, time: Array) -> tuple[Array, ...]:
        return tuple(take(phase, index).course(sign[index], time))[what]

    resolution = roots.ROUNDING if what is MARGIN else LOWEST
    return roots.crossing(function, low[which], high[which], resolution=resolution)
