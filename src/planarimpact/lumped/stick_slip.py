"""The phases of a lumped contact, and the order in which they follow each other.

Units 1/Omega, |v2(0)|, mu |v2(0)| and m2 Omega |v2(0)| for time, normal and tangential velocity
and normal force, with friction T in mu times that; omega^2 = beta/zeta^2:

    w' = -beta T,   T = s/zeta^2,   stick: s' = w while |T| <= N,   slip: T = side N.

Both halves of the contact have one angle `eta` from 0 to pi/2, which vanishes with the force
(Table 1). In compression eta = Omega t grows from 0; in restitution eta = Omega (tf - t)/e falls to
0. So N = sin(eta) in both, and no digits are lost near separation, where both forces vanish.

In stick T = A sin(theta) and w = sqrt(beta zeta^2) A cos(theta): a phase is its amplitude A and
its angle theta, which has by eta the rate omega in compression and e omega in restitution. Slip
ends in closed form; `slip_onset` searches where it starts.

Errors do not grow: any two solutions approach each other in the tangential energy
w^2/(2 beta) + zeta^2 T^2/2, and an event misplaced by epsilon moves the result by the order of
epsilon^2.

While the contact slides, s = side zeta^2 N. So s' is side zeta^2 cos(eta) in compression and
-side zeta^2 cos(eta)/e in restitution. The slip velocity is w_s = w - s'. In each half of the
contact it is linear in the normal impulse (see `sliding`). So the work of friction in one half is
the normal impulse of the slip, times the mean of the slip velocities at its ends. The sum of
these, all positive, keeps its digits where x^2 - w^2 would lose them.

The formulas serve arrays, and `one_impact` in floats: `m` is as in `common.floats`.
"""

from typing import Any, NamedTuple

import numpy as np

from planarimpact.common import sliding
from planarimpact.common.arrays import Array, Integers
from planarimpact.common.checks import ConvergenceError
from planarimpact.common.floats import HALF_PI, sin_cos
from planarimpact.common.results import Regime
from planarimpact.lumped import slip_onset


class Impacts(NamedTuple):
    """Groups of impacts with incidence x >= 0, arrays of one shape (n,); or floats of one."""

    x: Any
    beta: Any
    zeta2: Any
    e: Any

    def take(self, which: slice | Integers) -> "Impacts":
        """The impacts with these indices."""
        return Impacts._make(field[which] for field in self)


class Outcome(NamedTuple):
    """Results of impacts, arrays of shape (n,), which the phases fill in place."""

    velocity: Array
    peak_friction: Array
    dissipation: Array
    regime: Integers


class Stick(NamedTuple):
    """Impacts, by index, in stick from `eta` on: T = side amplitude sin(theta).

    Stick from before maximum compression counts from there.
    """

    which: Any
    amplitude: Any
    theta: Any
    eta: Any
    side: Any


def solve(impacts: Impacts) -> Outcome:
    """Outcome of impacts."""
    x, beta, zeta2, e = impacts
    outcome = Outcome(
        sliding.velocity(x, beta, e),
        np.ones_like(x),
        sliding.work(x, beta, e),
        np.full(x.shape, Regime.SLIP_THROUGHOUT, np.uint8),
    )
    ever_sticks, slips_first, early = x < sliding.limit(beta, zeta2, e), x > zeta2, x <= beta
    conditions, sticks = (~slips_first, slips_first & early, slips_first & ~early), []
    for condition, (start, regime) in zip(conditions, STARTS, strict=True):
        which = np.flatnonzero(ever_sticks & condition)
        if which.size:
            *state, outcome.dissipation[which] = start(impacts.take(which), np)
            outcome.regime[which] = regime
            sticks.append((which, *state, np.ones(which.size)))
    if sticks:
        stick = Stick(*(np.concatenate(fields) for fields in zip(*sticks, strict=True)))
        _alternate(_in_restitution(stick, impacts, outcome), impacts, outcome)
    # Rounding must not create energy.
    np.minimum(np.maximum(outcome.velocity, -x), x, out=outcome.velocity)
    np.maximum(outcome.dissipation, 0.0, out=outcome.dissipation)
    return outcome


def _in_restitution(stick: Stick, impacts: Impacts, outcome: Outcome) -> Stick:
    """Sticks that go on in restitution; impacts that slip or end before get their outcome."""
    x, beta, zeta2, e = impacts
    breaks = (beta < zeta2)[stick.which] & (stick.amplitude > 1)
    ends = ((e == 0) | (x == 0))[stick.which]
    if not (breaks | ends).any():
        return stick
    omega = _omega(impacts.take(stick.which[breaks]), np)
    friction = stick.amplitude[breaks] * np.sin(stick.theta[breaks])
    breaks[breaks] = (omega < 1) & (friction > 1)
    which = stick.which[breaks]
    slip = slip_from_compression(impacts.take(which), np)
    outcome.velocity[which], outcome.dissipation[which] = slip
    ends &= ~breaks
    which = stick.which[ends]
    of_stick = stick.amplitude[ends], stick.theta[ends], impacts.take(which)
    ending = stick_to_separation(*of_stick, np)
    outcome.velocity[which], outcome.peak_friction[which], strain = ending
    outcome.dissipation[which] += strain
    slips_first = outcome.regime[which] == Regime.SLIP_STICK_SLIP
    outcome.regime[which] = np.where(slips_first, Regime.SLIP_STICK, Regime.STICK)
    goes_on = np.flatnonzero(~(breaks | ends))
    return Stick(*(field[goes_on] for field in stick))


def _alternate(stick: Stick, impacts: Impacts, outcome: Outcome) -> None:
    """Slip and stick in turn until every impact slides to separation; adds to the outcome.

    Each turn of the loop takes a stick to its end, and the slip after it. Impacts whose slip lasts
    to separation leave. The loop ends since a stick and its slip together take about a half-wave of
    T, and a contact has room for fewer than `most_sticks` of these.
    """
    count, own = 0, impacts.take(stick.which)
    while stick.which.size:
        which, amplitude, omega = stick.which, stick.amplitude, _omega(own, np)
        rate = own.e * omega
        if count == 0:
            most = most_sticks(rate.max())
        if count == most:
            raise ConvergenceError(f"{which.size} impacts stick more often than they can")
        eta, rho, wave = slip_onset.in_restitution(stick.eta, stick.theta, amplitude, rate, np)
        side = stick.side * (1 - 2 * (wave - 2 * np.floor(wave / 2)))
        slip = slip_to_separation(eta, rho, amplitude, omega, own, np)
        force, velocity, work, e_times_onset, e_times_final = slip
        outcome.velocity[which] = side * velocity
        if count == 0:  # N falls: no later stick or slip has more friction
            rising = (wave == 0) & (rho < HALF_PI)
            crest = np.where(rising, force, amplitude)
            slid = stick.eta < HALF_PI  # slip went through maximum compression, where N = 1
            outcome.peak_friction[which] = np.where(slid, 1.0, crest)
        again = np.flatnonzero((rate > 1) & (e_times_final < 0))
        if not again.size:
            outcome.dissipation[which] += work
            return
        own, which_again = own.take(again), which[again]
        ends = e_times_onset[again], e_times_final[again]
        amplitude, theta, eta, work[again] = stick_again(*ends, own, np)
        outcome.dissipation[which] += work
        outcome.regime[which_again] = Regime.MULTIPLE
        stick = Stick(which_again, amplitude, theta, eta, side[again])
        count += 1


def _omega(impacts: Impacts, m: Any) -> Any:
    """The frequency of stick, in that of the normal element."""
    return m.sqrt(impacts.beta / impacts.zeta2)


def _initial_stick(impacts: Impacts, m: Any) -> tuple[Any, Any, Any, Any]:
    """Stick from the start, with no force and T' = x/zeta^2.

    This and the other `STARTS` return amplitude, theta and eta of the stick, as `Stick` counts, and
    the work of the slip before.
    """
    omega = _omega(impacts, m)
    nothing = 0.0 * omega
    return impacts.x / impacts.zeta2 / omega, omega * HALF_PI, HALF_PI + nothing, nothing


def _after_early_slip(impacts: Impacts, m: Any) -> tuple[Any, Any, Any, Any]:
    """Stick after a first slip that ended in compression."""
    x, beta, zeta2, _ = impacts
    omega = _omega(impacts, m)
    # Slip has the velocity x - beta + (beta - zeta^2) cos(eta), so it ends where cos(eta) = slope.
    coefficient = beta - zeta2
    slope, gap = (beta - x) / coefficient, (x - zeta2) / coefficient
    amplitude, theta, eta = _tangent(slope, gap, omega, m)
    # The first slip has the normal impulse `gap`; its velocity falls from x - zeta^2 to 0.
    work = gap * gap * coefficient / 2
    return amplitude, theta + omega * (HALF_PI - eta), HALF_PI + 0.0 * omega, work


def _after_late_slip(impacts: Impacts, m: Any) -> tuple[Any, Any, Any, Any]:
    """Stick after a first slip that ended in restitution, at cos(eta) = (x - beta)/K."""
    x, beta, zeta2, e = impacts
    coefficient = sliding.restick_coefficient(beta, zeta2, e)
    slope, gap = (beta - x) / coefficient, (coefficient + (beta - x)) / coefficient
    # Twice the work. In compression the impulse is 1, and the slip velocity falls from x - zeta^2
    # to x - beta. In restitution the impulse is e cos(eta) = -e slope, and it falls to 0.
    work = x - zeta2 + (x - beta) + e * (beta - x) * slope
    return *_tangent(slope, gap, e * _omega(impacts, m), m), work / 2


# The ways to a first stick, with the regime: x up to zeta^2, then up to beta, then above both.
STARTS = (
    (_initial_stick, Regime.STICK_SLIP),
    (_after_early_slip, Regime.SLIP_STICK_SLIP),
    (_after_late_slip, Regime.SLIP_STICK_SLIP),
)


def _tangent(slope: Any, gap: Any, rate: Any, m: Any) -> tuple[Any, Any, Any]:
    """Stick that starts with T = N and T' = N' = slope: amplitude, theta and eta there.

    `gap` is 1 - |slope|, which the caller computes without cancellation.
    """
    square = gap * (1 + abs(slope))  # 1 - slope^2
    force, share = m.sqrt(square), slope / rate
    amplitude = m.sqrt(square + share * share)  # NumPy's hypot is ten times slower
    return amplitude, m.arctan2(rate * force, slope), m.arctan2(force, abs(slope))


def slip_from_compression(impacts: Impacts, m: Any) -> tuple[Any, Any]:
    """Initial stick that breaks before maximum compression (omega < Omega) slips to the end.

    Returns the velocity there, and the work. The largest friction is that of N = 1.
    """
    x, beta, zeta2, e = impacts
    omega = _omega(impacts, m)
    eta = slip_onset.in_compression(x, zeta2, omega, m)
    w_onset, half = x * m.cos(omega * eta), m.sin(eta / 2)
    passed = 2 * (half * half)  # the normal impulse until then
    w_compressed = w_onset - beta * (1 - passed)
    w_final = w_onset - beta * (1 + e - passed)
    # Twice the work: normal impulse times both slip velocities at its ends. In compression the
    # impulse is 1 - passed; s' falls from zeta^2 (1 - passed) to 0. In restitution the impulse is
    # e; s' falls from 0 to -zeta^2/e.
    work = (1 - passed) * (w_onset - zeta2 * (1 - passed) + w_compressed)
    work += e * w_compressed + e * w_final + zeta2
    return w_final, work / 2


def stick_to_separation(amplitude: Any, theta: Any, impacts: Impacts, m: Any) -> tuple[Any, ...]:
    """Stick that ends at maximum compression, as e = 0, or has no force, as x = 0.

    Returns the velocity there, the largest friction, and the strain energy, which is lost.
    """
    zeta2, (sine, cosine) = impacts.zeta2, sin_cos(theta, m)
    friction = amplitude * sine
    velocity = _omega(impacts, m) * zeta2 * amplitude * cosine
    largest = m.where(theta < HALF_PI, friction, amplitude)
    return velocity, largest, zeta2 * friction * friction / 2


def slip_to_separation(
    eta: Any, rho: Any, amplitude: Any, omega: Any, impacts: Impacts, m: Any
) -> tuple[Any, ...]:
    """Slip in restitution from an onset to separation, in the direction of slip.

    Returns N at the onset, the velocity at separation, the work, and e times the slip velocity
    w_s = w + zeta^2 cos(eta)/e at the onset and at separation. If the last one is negative and
    rate > 1, slip has ended before: `stick_again`.
    """
    _, beta, zeta2, e = impacts
    w_onset = omega * zeta2 * amplitude * sin_cos(rho, m)[1]
    # N, and the normal impulse to come over e: from one tangent, the cheapest function.
    tangent = m.tan(eta / 2)
    force = 2 * tangent / (1 + tangent * tangent)
    ahead = tangent * force
    w_final = w_onset - beta * e * ahead
    e_times_onset, e_times_final = e * w_onset + zeta2 * (1 - ahead), e * w_final + zeta2
    # The impulse is e times `ahead`.
    work = ahead * (e_times_onset + e_times_final) / 2
    return force, w_final, work, e_times_onset, e_times_final


def stick_again(
    e_times_onset: Any, e_times_final: Any, impacts: Impacts, m: Any
) -> tuple[Any, Any, Any, Any]:
    """Stick after a slip in restitution, as those of `STARTS`.

    If rate > 1, e w_s falls all the way: by e_k = e^2 beta - zeta^2 if cos(eta) grows by 1. So slip
    ends when cos(eta) has grown by e_times_onset/e_k, at cos(eta) = 1 - gap.
    """
    _, beta, zeta2, e = impacts
    e_k = e * (e * beta) - zeta2
    work, gap = e_times_onset * (e_times_onset / e_k), -e_times_final / e_k
    return *_tangent(gap - 1, gap, e * _omega(impacts, m), m), work / 2


def most_sticks(rate: float) -> int:
    """A number of sticks in restitution that no impact reaches: the loop must end.

    In restitution the phase of T grows by rate pi/2, that is rate/2 half-waves. A stick and its
    slip together take about one. With a part of one at both ends there are some rate/2 + 2 sticks.
    The bound need not be sharp: it is about twice as large.
    """
    return int(rate) + 3
