"""Where phases end: the first instant at which stick breaks, and at which slip stops.

All times count from the start of the phase. Directions are mirrored so that T > 0 where a phase
starts: stick with T of either sign follows slip in direction +1.

**Stick breaks** where |T| reaches N. With b = beta/zeta^2, W = |T|'N - |T|N' is the slope of |T|/N
times N^2, and

    (exp(2 gamma t) W)' = -(b - 1) |T| (N + tau N') exp(2 gamma t).

N + tau N' is positive before an instant t_M and negative after it. So between two zeros of T (a
half-wave), exp(2 gamma t) W falls before t_M and rises after it for b > 1, and the other way round
for b < 1. At a zero of T that starts a half-wave W > 0; at one that ends it W < 0; at separation,
where N = 0 and N' < 0, W > 0. This leaves few cases:

1. Stick starts with |T| <= N. There W <= 0 after slip, and for b > 1 also at contact. For b > 1 the
   ratio |T|/N then falls to the end of its half-wave. If separation comes first, the ratio rises at
   last: there is one onset. For b < 1 slip can turn into stick only after t_M, and the ratio falls.
2. A half-wave that starts with W > 0 and lasts to separation. For b < 1 the ratio rises
   throughout: one onset. For b > 1 it does so if W >= 0 at t_M. Else it rises, falls and rises. The
   first onset lies before the first maximum of the ratio if that is 1 or more, else behind it.
3. A half-wave that starts with W > 0 and ends before separation: the ratio has one maximum. There
   is one onset before it if the maximum is 1 or more, else none.

The maximum is the only zero of W between bounds that are known. No search needs the start of a
phase, where |T| = N: chatter cannot occur.

**Slip stops** where the slip velocity D = A + k v + B y vanishes, with k = beta - zeta^2, the rate
of compression v, and y = exp(-t/tau); see `planarimpact.lumped.viscous`. At the start D = 0 and
D' >= 0, and

    D' = y (C - k N/y),   C = -B/tau,   (N/y)' = (N + tau N')/(tau y):

N/y rises before t_M and falls after. For k <= 0, D rises and may fall later: it vanishes
once if D < 0 at separation, else not at all. For k > 0 it rises, falls, and rises again after t_M.
If D <= 0 at separation, or else at the minimum, it vanishes once before.
"""

import numpy as np

from planarimpact.ground import roots
from planarimpact.ground.arrays import Array, Booleans, Integers
from planarimpact.ground.roots import Function
from planarimpact.ground.sliding import stick_limit
from planarimpact.lumped.viscous.elements import Elements

# A slip velocity that falls below 0 by less, as a share of its terms, is rounding. Where b is next
# to 1, the forces of stick and slip differ by rounding only, and nothing else tells them apart.
ROUNDING = 1e-15


class Stick:
    """Stick of some impacts, from friction T > 0 and velocity w on, `ahead` of separation."""

    def __init__(self, pair: Elements, ahead: Array, friction: Array, velocity: Array) -> None:
        self.pair, self.ahead, self.friction, self.velocity = pair, ahead, friction, velocity

    def take(self, lanes: Integers | Booleans) -> "Stick":
        """The impacts with these indices."""
        fields = self.ahead, self.friction, self.velocity
        return Stick(self.pair.take(lanes), *(field[lanes] for field in fields))

    def first_zero(self) -> Array:
        """Time of the first zero of T; infinite where there is none."""
        pair = self.pair
        growth = self.velocity / pair.zeta2 - pair.gamma * self.friction
        if pair.tangential_under:
            return np.arctan2(self.friction * pair.rate, -growth) / pair.rate
        with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
            ratio = self.friction * pair.rate / -growth
            time = np.arctanh(ratio) / pair.rate
        return np.where((growth < 0) & (ratio < 1), time, np.inf)

    def crest_after_zero(self) -> Array:
        """Time from a zero of T to the next crest of |T|."""
        pair = self.pair
        if pair.tangential_under:
            return np.arctan2(pair.rate, pair.gamma) / pair.rate
        return np.arctanh(pair.rate / pair.gamma) / pair.rate

    def first_crest(self, zero: Array) -> Array:
        """Time of the first crest of |T|: in this half-wave if T rises, else in the next."""
        pair = self.pair
        rise = self.velocity / pair.zeta2 - 2 * pair.gamma * self.friction
        fall = pair.gamma * rise + pair.b * self.friction
        rises = rise > 0
        rise, fall = np.where(rises, rise, 0.0), np.where(rises, fall, 1.0)
        if pair.tangential_under:
            here = np.arctan2(rise * pair.rate, fall) / pair.rate
        else:
            with np.errstate(divide="ignore"):
                here = np.arctanh(np.minimum(rise * pair.rate / fall, 1.0)) / pair.rate
        return np.where(rises, here, zero + self.crest_after_zero())

    def swing(self, sign: Array, time: Array) -> tuple[Array, Array]:
        """`sign` T, and its rate, at these times."""
        pair = self.pair
        friction, velocity = pair.stick(self.friction, self.velocity, time)
        return sign * friction, sign * (velocity / pair.zeta2 - 2 * pair.gamma * friction)

    def forces(self, sign: Array, time: Array) -> tuple[Array, Array, Array, Array]:
        """`sign` T, its rate, N, and v at these times."""
        return *self.swing(sign, time), *self.pair.motion(self.ahead - time)

    def margin(self, sign: Array) -> Function:
        """N - |T|, in a half-wave where T has this sign; the time is minus the time to separation.

        So it keeps its digits near separation, where both forces vanish.
        """

        def function(lanes: Integers, time: Array) -> tuple[Array, Array, Array]:
            part, pair = _part(self, lanes)
            friction, swing = part.swing(sign[lanes], part.ahead + time)
            force, v = pair.motion(-time)
            tau = 2 * pair.xi
            fall = v - tau * force
            limit, falls, bends = (stick_limit(a) for a in (force, fall, -tau * fall - force))
            bend = 2 * pair.gamma * swing + pair.b * friction + bends
            return limit - friction, falls - swing, bend

        return function

    def rise(self, sign: Array) -> Function:
        """W: it has the sign of the slope of |T|/N."""

        def function(lanes: Integers, time: Array) -> tuple[Array, Array]:
            part, pair = _part(self, lanes)
            friction, swing, force, v = part.forces(sign[lanes], time)
            tau = 2 * pair.xi
            fall = v - tau * force
            value = swing * force - friction * fall
            slope = -2 * pair.gamma * value - (pair.b - 1) * friction * (force + tau * fall)
            # W falls through its zero for b > 1 before t_M, and for b < 1 after it.
            return value, slope

        return function


def _part(stick: Stick, lanes: Integers) -> tuple[Stick, Elements]:
    part = stick if lanes.size == stick.ahead.size else stick.take(lanes)
    return part, part.pair


def stick_end(stick: Stick, at_contact: bool) -> tuple[Array, Array]:
    """Time to separation when |T| first reaches N, and the sign of T there.

    Parameters
    ----------
    stick : Stick
    at_contact : bool
        Whether stick starts at contact; else it follows slip.

    Returns
    -------
    ahead, sign : ndarray
    """
    pair, ahead = stick.pair, stick.ahead
    low, high, sign = np.zeros_like(ahead), ahead.copy(), np.ones_like(ahead)
    start, end = np.zeros_like(ahead), stick.first_zero()
    turn = ahead - pair.turn_ahead()
    stiff = pair.b >= 1
    # Case 1: the present half-wave is done with, if it ends before separation.
    falls = stiff if at_contact else np.ones_like(stiff)
    lanes = np.flatnonzero((end < ahead) | ~falls)
    if lanes.size:
        passed = falls[lanes]
        parity = np.where(passed, -1.0, 1.0)
        half = np.pi / pair.rate if pair.tangential_under else np.full_like(ahead, np.inf)
        start[lanes] = np.where(passed, end[lanes], 0.0)
        end[lanes] = np.where(passed, end[lanes] + half[lanes], end[lanes])
        sign[lanes] = parity
    while lanes.size:
        # Case 2, where the ratio rises throughout.
        last = end[lanes] >= ahead[lanes]
        rising = np.where(stiff[lanes], turn[lanes] <= start[lanes], last)
        low[lanes] = start[lanes]
        lanes = lanes[~rising]
        if not lanes.size:
            break
        met, unmet_low, top = _before_highest(
            stick.take(lanes), sign[lanes], start[lanes], end[lanes], turn[lanes]
        )
        high[lanes] = np.where(met, top, ahead[lanes])
        low[lanes] = np.where(met, start[lanes], unmet_low)
        # No onset up to the maximum: the search goes on behind it, or in the next half-wave.
        lanes = lanes[~met & (end[lanes] < ahead[lanes])]
        start[lanes] = end[lanes]
        end[lanes] += half[lanes]
        sign[lanes] *= -1
    return np.maximum(-roots.crossing(stick.margin(sign), low - ahead, high - ahead), 0.0), sign


def _before_highest(
    stick: Stick, sign: Array, start: Array, end: Array, turn: Array
) -> tuple[Booleans, Array, Array]:
    """Whether |T| meets N up to the first maximum of |T|/N, in a half-wave of cases 2 and 3.

    Returns
    -------
    met : ndarray of bool
        True also where the ratio turns out to rise to separation.
    low : ndarray
        Where it is not met: a place at or behind the maximum, before any other onset.
    high : ndarray
        Where it is met: a place at or behind the onset, before any other.
    """
    pair, ahead = stick.pair, stick.ahead
    stiff = pair.b >= 1
    # The maximum lies between these bounds.
    below = np.where(stiff, start, np.maximum(start, turn))
    above = np.minimum(end, ahead)
    above = np.where(stiff, np.minimum(above, turn), above)
    friction, swing, force, v = stick.forces(sign, above)
    least = force
    met, high = stick_limit(force) <= friction, above.copy()
    fall = v - 2 * pair.xi * force
    # W >= 0 at t_M: the ratio rises on to separation.
    rises = stiff & (turn < end) & (swing * force - friction * fall >= 0) & ~met
    high[rises] = ahead[rises]
    met |= rises
    # The crest of |T| is close to the maximum. |T| is nowhere larger in this half-wave.
    open_ = np.flatnonzero(~met)
    if open_.size:
        part = stick.take(open_)
        crest = part.first_crest(part.first_zero())
        later = start[open_] > 0
        crest = np.where(later, start[open_] + part.crest_after_zero(), crest)
        crest = np.where(crest < end[open_], crest, start[open_])  # |T| falls from contact on
        largest, _ = part.pair.stick(part.friction, part.velocity, crest)
        at_start, _ = part.pair.motion(part.ahead - start[open_])
        # N is nowhere smaller, up to `above`, than at the ends.
        near = np.abs(largest) >= stick_limit(np.minimum(at_start, least[open_]))
        inside = near & (crest > start[open_]) & (crest < above[open_])
        force, _ = part.pair.motion(part.ahead - np.where(inside, crest, 0.0))
        at_crest = inside & (np.abs(largest) >= stick_limit(force))
        met[open_[at_crest]], high[open_[at_crest]] = True, crest[at_crest]
        open_ = open_[near & ~at_crest]
    if open_.size:
        part, side = stick.take(open_), sign[open_]
        top = roots.crossing(part.rise(side), below[open_], above[open_])
        friction, _, force, _ = part.forces(side, top)
        reached = friction >= stick_limit(force)
        met[open_[reached]], high[open_[reached]] = True, top[reached]
    return met, above, high


class Slip:
    """Slip of some impacts from velocity w on, `ahead` of separation, in direction +1.

    D = A + k v + B y, with y = exp(-t/tau): see the head of this module.
    """

    def __init__(self, pair: Elements, ahead: Array, constant: Array, layer: Array) -> None:
        self.pair, self.ahead, self.constant, self.layer = pair, ahead, constant, layer
        self.k = pair.beta - pair.zeta2

    def take(self, lanes: Integers | Booleans) -> "Slip":
        """The impacts with these indices."""
        return Slip(
            self.pair.take(lanes), self.ahead[lanes], self.constant[lanes], self.layer[lanes]
        )

    def fade(self, time: Array) -> Array:
        """y = exp(-t/tau)."""
        return np.exp(-time / (2 * self.pair.xi))

    def velocity(self, lanes: Integers, time: Array) -> tuple[Array, Array, Array]:
        """D, D' and D''."""
        part = self if lanes.size == self.ahead.size else self.take(lanes)
        tau = 2 * part.pair.xi
        force, v = part.pair.motion(part.ahead - time)
        layer = part.layer * part.fade(time)
        value = part.constant + part.k * v + layer
        pull = layer / tau
        return value, -part.k * force - pull, -part.k * (v - tau * force) + pull / tau

    def fall(self, lanes: Integers, time: Array) -> tuple[Array, Array, Array]:
        """-D' and its derivatives."""
        part = self if lanes.size == self.ahead.size else self.take(lanes)
        tau = 2 * part.pair.xi
        force, v = part.pair.motion(part.ahead - time)
        pull = part.layer * part.fade(time) / tau
        rate = v - tau * force
        bend = -part.k * (tau * rate + force) + pull / tau / tau
        return part.k * force + pull, part.k * rate - pull / tau, bend


def slip_end(slip: Slip) -> tuple[Integers, Array]:
    """Impacts whose slip stops before separation, and the time of that."""
    pair, ahead = slip.pair, slip.ahead
    high = ahead.copy()
    end = slip.constant - slip.k * pair.e + slip.layer * slip.fade(ahead)
    stops = end < -ROUNDING * (pair.beta + pair.zeta2 + np.abs(slip.constant))
    # Else it may stop and would start again before separation, if it falls at t_M.
    turn = ahead - pair.turn_ahead()
    dips = ~stops & (slip.k > 0) & (turn > 0) & (slip.layer < 0)
    if dips.any():
        open_ = np.flatnonzero(dips)
        part, at_turn = slip.take(open_), turn[open_]
        # From t_M on D is at least its value at separation, less all that B y has still to fall.
        layer = part.layer * part.fade(at_turn)
        close = end[open_] + layer <= 0
        open_, at_turn = open_[close], at_turn[close]
        if open_.size:
            part = slip.take(open_)
            value, slope, _ = part.velocity(np.arange(open_.size), at_turn)
            lowest = at_turn.copy()
            falls = np.flatnonzero((value > 0) & (slope < 0))
            if falls.size:
                dip = part.take(falls)
                lowest[falls] = roots.crossing(dip.fall, at_turn[falls], dip.ahead)
                value[falls] = dip.velocity(np.arange(falls.size), lowest[falls])[0]
            reached = value <= 0
            stops[open_[reached]], high[open_[reached]] = True, lowest[reached]
    lanes = np.flatnonzero(stops)
    part = slip.take(lanes)
    return lanes, roots.crossing(part.velocity, np.zeros(lanes.size), high[lanes])
