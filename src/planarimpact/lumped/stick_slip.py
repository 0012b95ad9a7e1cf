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
"""

from typing import NamedTuple

import numpy as np

from planarimpact.common import sliding
from planarimpact.common.angles import HALF_PI, sin_cos
from planarimpact.common.arrays import Array, Integers
from planarimpact.common.checks import ConvergenceError
from planarimpact.common.results import Regime
from planarimpact.lumped import slip_onset


class Impacts(NamedTuple):
    """Groups of impacts with incidence x >= 0, arrays of one shape (n,)."""

    x: Array
    beta: Array
    zeta2: Array
    e: Array

    def take(self, which: Integers) -> "Impacts":
        """The impacts with these indices."""
        return Impacts._make(field[which] for field in self)


class Outcome(NamedTuple):
    """Results of impacts, arrays of shape (n,), which the phases fill in place."""

    velocity: Array
    peak_friction: Array
    dissipation: Array
    regime: Integers


class Stick(NamedTuple):
    """Impacts, by index, in stick in restitution from `eta` on: T = side amplitude sin(theta).

    Arrays of their own, which may be changed in place.
    """

    which: Integers
    eta: Array
    theta: Array
    amplitude: Array
    side: Array


def solve(impacts: Impacts) -> Outcome:
    """Outcome of impacts."""
    x, beta, zeta2, e = impacts
    outcome = Outcome(
        sliding.velocity(x, beta, e),
        np.ones_like(x),
        sliding.work(x, beta, e),
        np.full(x.shape, Regime.SLIP_THROUGHOUT, np.uint8),
    )
    ever_sticks = x < sliding.limit(beta, zeta2, e)
    slips_first = x > zeta2
    initial = np.flatnonzero(ever_sticks & ~slips_first)
    early = np.flatnonzero(ever_sticks & slips_first & (x <= beta))
    late = np.flatnonzero(ever_sticks & slips_first & (x > beta))
    starts = (initial, _initial_stick), (early, _after_early_slip), (late, _after_late_slip)
    sticks = [start(which, impacts, outcome) for which, start in starts if which.size]
    if sticks:
        stick = Stick(*(np.concatenate(fields) for fields in zip(*sticks, strict=True)))
        _alternate(stick, impacts, outcome)
    # Rounding must not create energy.
    np.minimum(np.maximum(outcome.velocity, -x), x, out=outcome.velocity)
    np.maximum(outcome.dissipation, 0.0, out=outcome.dissipation)
    return outcome


def _tangent(slope: Array, gap: Array, rate: Array) -> tuple[Array, Array, Array]:
    """Stick that starts with T = N and T' = N' = slope: amplitude, theta and eta there.

    `gap` is 1 - |slope|, which the caller computes without cancellation.
    """
    square = gap * (1 + np.abs(slope))  # 1 - slope^2
    force, share = np.sqrt(square), slope / rate
    amplitude = np.sqrt(square + share * share)  # NumPy's hypot is ten times slower
    return amplitude, np.arctan2(rate * force, slope), np.arctan2(force, np.abs(slope))


def _initial_stick(which: Integers, impacts: Impacts, outcome: Outcome) -> Stick:
    """Stick from the start, with no force and T' = x/zeta^2, up to maximum compression.

    Contacts that end there, or slip before and to the end, get their outcome. The others are
    returned: they stick on in restitution.
    """
    x, beta, zeta2, _ = impacts = impacts.take(which)
    omega = np.sqrt(beta / zeta2)
    amplitude, theta = x / zeta2 / omega, omega * HALF_PI
    outcome.dissipation[which] = 0.0
    outcome.regime[which] = Regime.STICK_SLIP
    broken = np.flatnonzero((omega < 1) & (amplitude > 1))
    broken = broken[slip_onset.breaks_in_compression(amplitude[broken], theta[broken])]
    if broken.size:
        _break_in_compression(which[broken], impacts.take(broken), outcome)
        goes_on = np.delete(np.arange(which.size), broken)
        which, impacts = which[goes_on], impacts.take(goes_on)
        amplitude, theta = amplitude[goes_on], theta[goes_on]
    return _at_compression(which, impacts, amplitude, theta, outcome)


def _after_early_slip(which: Integers, impacts: Impacts, outcome: Outcome) -> Stick:
    """As `_initial_stick`, for stick after a first slip that ended in compression."""
    x, beta, zeta2, _ = impacts = impacts.take(which)
    omega = np.sqrt(beta / zeta2)
    # Slip has the velocity x - beta + (beta - zeta^2) cos(eta), so it ends where cos(eta) = slope.
    coefficient = beta - zeta2
    slope, gap = (beta - x) / coefficient, (x - zeta2) / coefficient
    amplitude, theta, eta = _tangent(slope, gap, omega)
    # The first slip has the normal impulse `gap`; its velocity falls from x - zeta^2 to 0.
    outcome.dissipation[which] = gap * gap * coefficient / 2
    outcome.regime[which] = Regime.SLIP_STICK_SLIP
    theta = theta + omega * (HALF_PI - eta)
    return _at_compression(which, impacts, amplitude, theta, outcome)


def _at_compression(
    which: Integers,
    impacts: Impacts,
    amplitude: Array,
    theta: Array,
    outcome: Outcome,
) -> Stick:
    """Stick at maximum compression; contacts that end there, or have x = 0, get their outcome.

    The strain energy of stick is lost at separation.
    """
    x, beta, zeta2, e = impacts
    last = (e == 0) | (x == 0)
    if last.any():
        ends, goes_on = np.flatnonzero(last), np.flatnonzero(~last)
        sine, cosine = sin_cos(theta[ends])
        ending, largest, ratio = which[ends], amplitude[ends], zeta2[ends]
        friction = largest * sine
        outcome.velocity[ending] = np.sqrt(beta[ends] / ratio) * ratio * largest * cosine
        outcome.peak_friction[ending] = np.where(theta[ends] < HALF_PI, friction, largest)
        outcome.dissipation[ending] += ratio * friction * friction / 2
        # No slip follows.
        sticks_first = outcome.regime[ending] == Regime.STICK_SLIP
        outcome.regime[ending] = np.where(sticks_first, Regime.STICK, Regime.SLIP_STICK)
        which, amplitude, theta = which[goes_on], amplitude[goes_on], theta[goes_on]
    return Stick(which, np.full_like(theta, HALF_PI), theta, amplitude, np.ones_like(theta))


def _break_in_compression(which: Integers, impacts: Impacts, outcome: Outcome) -> None:
    """Initial stick that breaks before maximum compression (omega < Omega) slips to the end."""
    x, beta, zeta2, e = impacts
    omega = np.sqrt(beta / zeta2)
    eta = slip_onset.in_compression(x, zeta2, omega)
    w_onset = x * np.cos(omega * eta)
    passed = 2 * np.sin(eta / 2) ** 2  # the normal impulse until then
    w_compressed = w_onset - beta * (1 - passed)
    w_final = w_onset - beta * (1 + e - passed)
    # Twice the work: normal impulse times both slip velocities at its ends. In compression the
    # impulse is 1 - passed; s' falls from zeta^2 (1 - passed) to 0. In restitution the impulse is
    # e; s' falls from 0 to -zeta^2/e.
    work = (1 - passed) * (w_onset - zeta2 * (1 - passed) + w_compressed)
    work += e * w_compressed + e * w_final + zeta2
    outcome.velocity[which] = w_final
    outcome.peak_friction[which] = 1.0
    outcome.dissipation[which] = work / 2
    outcome.regime[which] = Regime.STICK_SLIP


def _after_late_slip(which: Integers, impacts: Impacts, outcome: Outcome) -> Stick:
    """Stick after a first slip that ended in restitution, at cos(eta) = (x - beta)/K."""
    x, beta, zeta2, e = impacts.take(which)
    coefficient = sliding.restick_coefficient(beta, zeta2, e)
    slope, gap = (beta - x) / coefficient, (coefficient + (beta - x)) / coefficient
    # Twice the work. In compression the impulse is 1, and the slip velocity falls from x - zeta^2
    # to x - beta. In restitution the impulse is e cos(eta) = -e slope, and it falls to 0.
    work = x - zeta2 + (x - beta) + e * (beta - x) * slope
    outcome.dissipation[which] = work / 2
    outcome.regime[which] = Regime.SLIP_STICK_SLIP
    amplitude, theta, eta = _tangent(slope, gap, e * np.sqrt(beta / zeta2))
    return Stick(which, eta, theta, amplitude, np.ones_like(eta))


def _alternate(stick: Stick, impacts: Impacts, outcome: Outcome) -> None:
    """Slip and stick in turn until every impact slides to separation; adds to the outcome.

    Each turn of the loop takes a stick to its end, and the slip after it. Impacts whose slip lasts
    to separation leave. The loop ends since a stick and its slip together take about a half-wave of
    T, and a contact has room for fewer than `_most_sticks` of these.
    """
    count = 0
    while stick.which.size:
        which, amplitude = stick.which, stick.amplitude
        beta, zeta2, e = (field[which] for field in impacts[1:])
        omega = np.sqrt(beta / zeta2)
        rate = e * omega
        if count == 0:
            most = _most_sticks(rate)
        if count == most:
            raise ConvergenceError(f"{which.size} impacts stick more often than they can")
        # The end of stick: slip starts with the velocity `w_onset`. If it lasts to separation, it
        # ends with `w_final`. Both count in the direction of slip.
        eta, rho, wave = slip_onset.in_restitution(stick.eta, stick.theta, amplitude, rate)
        side = stick.side * (1 - 2 * (wave - 2 * np.floor(wave / 2)))
        w_onset = omega * zeta2 * amplitude * sin_cos(rho)[1]
        # N, and the normal impulse to come over e: from one tangent, the cheapest function.
        tangent = np.tan(eta / 2)
        force = 2 * tangent / (1 + tangent * tangent)
        ahead = tangent * force
        w_final = w_onset - beta * e * ahead
        outcome.velocity[which] = side * w_final
        if count == 0:  # N falls: no later stick or slip has more friction
            rising = (wave == 0) & (rho < HALF_PI)
            crest = np.where(rising, force, amplitude)
            slid = stick.eta < HALF_PI  # slip went through maximum compression, where N = 1
            outcome.peak_friction[which] = np.where(slid, 1.0, crest)
        # e times the slip velocity w_s = w + zeta^2 cos(eta)/e, at the onset and at separation.
        e_times_onset, e_times_final = e * w_onset + zeta2 * (1 - ahead), e * w_final + zeta2
        # Twice the work, if slip lasts to separation: the impulse is e times `ahead`.
        work = ahead * (e_times_onset + e_times_final)
        # If rate > 1, e w_s falls all the way: by e_k = e^2 beta - zeta^2 if cos(eta) grows by 1.
        # Where it would be negative at separation, slip ends before: when cos(eta) has grown by
        # e_times_onset/e_k. Then stick comes again.
        again = np.flatnonzero((rate > 1) & (e_times_final < 0))
        e_k = e[again] * (e[again] * beta[again]) - zeta2[again]
        work[again] = e_times_onset[again] * (e_times_onset[again] / e_k)
        outcome.dissipation[which] += work / 2
        # The slip of these impacts ends at cos(eta) = 1 - gap; their next stick starts there.
        gap = -e_times_final[again] / e_k
        amplitude, theta, eta = _tangent(gap - 1, gap, rate[again])
        stick = Stick(which[again], eta, theta, amplitude, side[again])
        outcome.regime[stick.which] = Regime.MULTIPLE
        count += 1


def _most_sticks(rate: Array) -> int:
    """A number of sticks in restitution that no impact reaches: the loop must end.

    In restitution the phase of T grows by rate pi/2, that is rate/2 half-waves. A stick and its
    slip together take about one. With a part of one at both ends there are some rate/2 + 2 sticks.
    The bound need not be sharp: it is about twice as large.
    """
    return int(rate.max()) + 3
