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

**Slip stops** where the slip velocity w_s = A + k v + B y vanishes, with k = beta - zeta^2, the
rate of compression v, and y = exp(-t/tau); see `planarimpact.lumped.viscous`. At the start w_s = 0
and w_s' >= 0, and

    w_s' = y (C - k N/y),   C = -B/tau,   (N/y)' = (N + tau N')/(tau y):

N/y rises before t_M and falls after. For k <= 0, w_s rises and may fall later: it vanishes once if
w_s < 0 at separation, else not at all. For k > 0 it rises, falls, and rises again after t_M. If
w_s <= 0 at separation, or else at the minimum, it vanishes once before.
"""

import numpy as np

from planarimpact.ground import roots
from planarimpact.ground.arrays import Array, Booleans, Integers
from planarimpact.ground.roots import Function
from planarimpact.lumped.viscous.elements import Elements

# A slip velocity that falls below 0 by less than this share of its terms counts as 0: where b is
# next to 1, the forces of stick and slip differ by rounding only.
ROUNDING = 1e-15


class Stick:
    """Stick of some impacts, from friction T > 0 and velocity w on, `ahead` of separation."""

    def __init__(self, elements: Elements, ahead: Array, friction: Array, velocity: Array) -> None:
        self.elements, self.ahead = elements, ahead
        self.friction, self.velocity = friction, velocity

    def take(self, which: Integers | Booleans) -> "Stick":
        """The impacts with these indices."""
        fields = self.ahead, self.friction, self.velocity
        return Stick(self.elements.take(which), *(field[which] for field in fields))

    def first_zero(self) -> Array:
        """Time of the first zero of T; infinite where there is none."""
        elements = self.elements
        growth = self.velocity / elements.zeta2 - elements.gamma * self.friction
        if elements.tangential_under:
            return np.arctan2(self.friction * elements.rate, -growth) / elements.rate
        with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
            ratio = self.friction * elements.rate / -growth
            time = np.arctanh(ratio) / elements.rate
        return np.where((growth < 0) & (ratio < 1), time, np.inf)

    def crest_after_zero(self) -> Array:
        """Time from a zero of T to the next crest of |T|."""
        elements = self.elements
        if elements.tangential_under:
            return np.arctan2(elements.rate, elements.gamma) / elements.rate
        return np.arctanh(elements.rate / elements.gamma) / elements.rate

    def first_crest(self, zero: Array) -> Array:
        """Time of the first crest of |T|: in this half-wave if T rises, else in the next."""
        elements = self.elements
        rise = self.velocity / elements.zeta2 - 2 * elements.gamma * self.friction
        fall = elements.gamma * rise + elements.b * self.friction
        rises = rise > 0
        rise, fall = np.where(rises, rise, 0.0), np.where(rises, fall, 1.0)
        if elements.tangential_under:
            here = np.arctan2(rise * elements.rate, fall) / elements.rate
        else:
            with np.errstate(divide="ignore"):
                here = np.arctanh(np.minimum(rise * elements.rate / fall, 1.0)) / elements.rate
        return np.where(rises, here, zero + self.crest_after_zero())

    def swing(self, sign: Array, time: Array) -> tuple[Array, Array]:
        """`sign` T, and its rate, at these times."""
        elements = self.elements
        friction, velocity = elements.stick(self.friction, self.velocity, time)
        return sign * friction, sign * (velocity / elements.zeta2 - 2 * elements.gamma * friction)

    def forces(self, sign: Array, time: Array) -> tuple[Array, Array, Array, Array]:
        """`sign` T, its rate, N, and v at these times."""
        return *self.swing(sign, time), *self.elements.motion(self.ahead - time)

    def margin(self, sign: Array) -> Function:
        """N - |T|, in a half-wave where T has this sign; the time is minus the time to separation.

        So it keeps its digits near separation, where both forces vanish.
        """

        def function(which: Integers, time: Array) -> tuple[Array, Array, Array]:
            part, elements = _part(self, which)
            friction, swing = part.swing(sign[which], part.ahead + time)
            force, v = elements.motion(-time)
            tau = 2 * elements.xi
            fall = v - tau * force
            bend = 2 * elements.gamma * swing + elements.b * friction - tau * fall - force
            return force - friction, fall - swing, bend

        return function

    def rise(self, sign: Array) -> Function:
        """W: it has the sign of the slope of |T|/N."""

        def function(which: Integers, time: Array) -> tuple[Array, Array]:
            part, elements = _part(self, which)
            friction, swing, force, v = part.forces(sign[which], time)
            tau = 2 * elements.xi
            fall = v - tau * force
            value = swing * force - friction * fall
            slope = -2 * elements.gamma * value - (elements.b - 1) * friction * (force + tau * fall)
            # W falls through its zero for b > 1 before t_M, and for b < 1 after it.
            return value, slope

        return function


def _part(stick: Stick, which: Integers) -> tuple[Stick, Elements]:
    part = stick if which.size == stick.ahead.size else stick.take(which)
    return part, part.elements


def stick_end(stick: Stick, at_contact: bool) -> tuple[Array, Array]:
    """Time to separation when |T| first reaches N, and the sign of T there.

    Stick starts at contact, or it follows slip.
    """
    elements, ahead = stick.elements, stick.ahead
    low, high, sign = np.zeros_like(ahead), ahead.copy(), np.ones_like(ahead)
    start, end = np.zeros_like(ahead), stick.first_zero()
    turn = ahead - elements.turn_ahead()
    stiff = elements.b >= 1
    # Case 1: there is no onset in the present half-wave, if it ends before separation.
    falls = stiff if at_contact else np.ones_like(stiff)
    which = np.flatnonzero((end < ahead) | ~falls)
    if which.size:
        passed = falls[which]
        parity = np.where(passed, -1.0, 1.0)
        half = np.pi / elements.rate if elements.tangential_under else np.full_like(ahead, np.inf)
        start[which] = np.where(passed, end[which], 0.0)
        end[which] = np.where(passed, end[which] + half[which], end[which])
        sign[which] = parity
    while which.size:
        # Case 2, where the ratio rises throughout.
        last = end[which] >= ahead[which]
        rising = np.where(stiff[which], turn[which] <= start[which], last)
        low[which] = start[which]
        which = which[~rising]
        if not which.size:
            break
        met, unmet_low, top = _before_highest(
            stick.take(which), sign[which], start[which], end[which], turn[which]
        )
        high[which] = np.where(met, top, ahead[which])
        low[which] = np.where(met, start[which], unmet_low)
        # No onset up to the maximum: the search goes on behind it, or in the next half-wave.
        which = which[~met & (end[which] < ahead[which])]
        start[which] = end[which]
        end[which] += half[which]
        sign[which] *= -1
    return np.maximum(-roots.crossing(stick.margin(sign), low - ahead, high - ahead), 0.0), sign


def _before_highest(
    stick: Stick, sign: Array, start: Array, end: Array, turn: Array
) -> tuple[Booleans, Array, Array]:
    """Whether |T| meets N up to the first maximum of |T|/N, in a half-wave of cases 2 and 3.

    It does too where the ratio rises to separation. If it does not, the second result is a place at
    or behind the maximum, before any other onset; if it does, the third is a place at or behind the
    onset, before any other.
    """
    elements, ahead = stick.elements, stick.ahead
    stiff = elements.b >= 1
    # The maximum lies between these bounds.
    below = np.where(stiff, start, np.maximum(start, turn))
    above = np.minimum(end, ahead)
    above = np.where(stiff, np.minimum(above, turn), above)
    friction, swing, force, v = stick.forces(sign, above)
    least = force
    met, high = force <= friction, above.copy()
    fall = v - 2 * elements.xi * force
    # W >= 0 at t_M: the ratio rises on to separation.
    rises = stiff & (turn < end) & (swing * force - friction * fall >= 0) & ~met
    high[rises] = ahead[rises]
    met |= rises
    # The crest of |T| is close to the maximum. |T| is nowhere larger in this half-wave.
    undecided = np.flatnonzero(~met)
    if undecided.size:
        part = stick.take(undecided)
        crest = part.first_crest(part.first_zero())
        later = start[undecided] > 0
        crest = np.where(later, start[undecided] + part.crest_after_zero(), crest)
        crest = np.where(
            crest < end[undecided], crest, start[undecided]
        )  # |T| falls from contact on
        largest, _ = part.elements.stick(part.friction, part.velocity, crest)
        at_start, _ = part.elements.motion(part.ahead - start[undecided])
        # N is nowhere smaller, up to `above`, than at the ends.
        may_meet = np.abs(largest) >= np.minimum(at_start, least[undecided])
        inside = may_meet & (crest > start[undecided]) & (crest < above[undecided])
        force, _ = part.elements.motion(part.ahead - np.where(inside, crest, 0.0))
        at_crest = inside & (np.abs(largest) >= force)
        met[undecided[at_crest]], high[undecided[at_crest]] = True, crest[at_crest]
        undecided = undecided[may_meet & ~at_crest]
    if undecided.size:
        part, side = stick.take(undecided), sign[undecided]
        top = roots.crossing(part.rise(side), below[undecided], above[undecided])
        friction, _, force, _ = part.forces(side, top)
        reached = friction >= force
        met[undecided[reached]], high[undecided[reached]] = True, top[reached]
    return met, above, high


class Slip:
    """Slip of some impacts from velocity w on, `ahead` of separation, in direction +1.

    w_s = `constant` + k v + `transient` y, with y = exp(-t/tau).
    """

    def __init__(self, elements: Elements, ahead: Array, constant: Array, transient: Array) -> None:
        self.elements, self.ahead = elements, ahead
        self.constant, self.transient = constant, transient
        self.k = elements.beta - elements.zeta2

    def take(self, which: Integers | Booleans) -> "Slip":
        """The impacts with these indices."""
        fields = self.ahead, self.constant, self.transient
        return Slip(self.elements.take(which), *(field[which] for field in fields))

    def decay(self, time: Array) -> Array:
        """y = exp(-t/tau)."""
        return np.exp(-time / (2 * self.elements.xi))

    def velocity(self, which: Integers, time: Array) -> tuple[Array, Array, Array]:
        """w_s, w_s' and w_s''."""
        part = self if which.size == self.ahead.size else self.take(which)
        tau = 2 * part.elements.xi
        force, v = part.elements.motion(part.ahead - time)
        transient = part.transient * part.decay(time)
        value = part.constant + part.k * v + transient
        transient_rate = transient / tau
        return (
            value,
            -part.k * force - transient_rate,
            -part.k * (v - tau * force) + transient_rate / tau,
        )

    def fall(self, which: Integers, time: Array) -> tuple[Array, Array, Array]:
        """-w_s' and its derivatives."""
        part = self if which.size == self.ahead.size else self.take(which)
        tau = 2 * part.elements.xi
        force, v = part.elements.motion(part.ahead - time)
        transient_rate = part.transient * part.decay(time) / tau
        rate = v - tau * force
        bend = -part.k * (tau * rate + force) + transient_rate / tau / tau
        return part.k * force + transient_rate, part.k * rate - transient_rate / tau, bend


def slip_end(slip: Slip) -> tuple[Integers, Array]:
    """Impacts whose slip stops before separation, and when it stops."""
    elements, ahead = slip.elements, slip.ahead
    high = ahead.copy()
    end = slip.constant - slip.k * elements.e + slip.transient * slip.decay(ahead)
    stops = end < -ROUNDING * (elements.beta + elements.zeta2 + np.abs(slip.constant))
    # Else it may stop and would start again before separation, if it falls at t_M.
    turn = ahead - elements.turn_ahead()
    dips = ~stops & (slip.k > 0) & (turn > 0) & (slip.transient < 0)
    if dips.any():
        undecided = np.flatnonzero(dips)
        part, at_turn = slip.take(undecided), turn[undecided]
        # From t_M on w_s is at least its value at separation plus the B y of t_M, which is below 0.
        transient = part.transient * part.decay(at_turn)
        may_stop = end[undecided] + transient <= 0
        undecided, at_turn = undecided[may_stop], at_turn[may_stop]
        if undecided.size:
            part = slip.take(undecided)
            value, slope, _ = part.velocity(np.arange(undecided.size), at_turn)
            lowest = at_turn.copy()
            falls = np.flatnonzero((value > 0) & (slope < 0))
            if falls.size:
                dip = part.take(falls)
                lowest[falls] = roots.crossing(dip.fall, at_turn[falls], dip.ahead)
                value[falls] = dip.velocity(np.arange(falls.size), lowest[falls])[0]
            reached = value <= 0
            stops[undecided[reached]], high[undecided[reached]] = True, lowest[reached]
    which = np.flatnonzero(stops)
    part = slip.take(which)
    return which, roots.crossing(part.velocity, np.zeros(which.size), high[which])
