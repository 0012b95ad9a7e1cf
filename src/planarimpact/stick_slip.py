"""The phases of a lumped contact, and the order in which they follow each other.

Units 1/Omega, |v2(0)|, mu |v2(0)| and m2 Omega |v2(0)| for time, normal and tangential velocity
and normal force, with friction T in mu times that; omega^2 = beta/zeta^2:

    w' = -beta T,   T = s/zeta^2,   stick: s' = w while |T| <= N,   slip: T = side N.

In stick T = A sin(theta) and w = sqrt(beta zeta^2) A cos(theta): a phase is its amplitude A and
its angle. Time runs as the angle `eta` of `planarimpact.normal`, in which theta has the rate
omega in compression and e omega in restitution. Slip ends in closed form; where it starts,
`planarimpact.slip_onset` finds.

Errors do not grow: any two solutions approach each other in the tangential energy
w^2/(2 beta) + zeta^2 T^2/2, and an event misplaced by epsilon moves the result by the order of
epsilon^2.
"""

from typing import NamedTuple

import numpy as np

from planarimpact import normal, slip_onset
from planarimpact.checks import ConvergenceError
from planarimpact.results import Regime
from planarimpact.slip_onset import HALF_PI, sin_cos


class Impacts(NamedTuple):
    """Groups of impacts with incidence x >= 0, arrays of one shape (n,)."""

    x: np.ndarray
    beta: np.ndarray
    zeta2: np.ndarray
    e: np.ndarray

    def take(self, lanes):
        """The impacts with these indices."""
        return Impacts(*(field[lanes] for field in self))


class Outcome(NamedTuple):
    """What is known of each impact so far, arrays of shape (n,), filled in place."""

    velocity: np.ndarray
    peak_friction: np.ndarray
    regime: np.ndarray


class Stick(NamedTuple):
    """Impacts, by index, in stick in restitution from `eta` on: T = side amplitude sin(theta)."""

    lanes: np.ndarray
    eta: np.ndarray
    theta: np.ndarray
    amplitude: np.ndarray
    side: np.ndarray


class Phase(NamedTuple):
    """Start of a phase of stick or slip within one half of the contact.

    `side` is the direction of slip, or the sign of T for sin(theta) > 0 in stick; `velocity`
    holds in slip, `amplitude` and `theta` in stick.
    """

    sticks: bool
    in_restitution: bool
    eta: np.ndarray
    side: np.ndarray
    velocity: np.ndarray = 0.0
    amplitude: np.ndarray = 0.0
    theta: np.ndarray = 0.0


def restick_coefficient(beta, zeta2, e):
    """K = e beta - zeta^2/e where positive, else 0.

    Slip in restitution has the velocity C - K cos(eta), C constant; it can end only if K > 0.
    """
    fast = e * e * beta > zeta2
    return np.where(fast, (e * e * beta - zeta2) / np.where(fast, e, 1.0), 0.0)


def slip_throughout_limit(beta, zeta2, e):
    """Incidence from which slip never ends."""
    return np.maximum(zeta2, beta + restick_coefficient(beta, zeta2, e))


def solve(impacts, trace=None):
    """Velocity, peak friction, regime and tangential impulse of impacts.

    Parameters
    ----------
    impacts : Impacts
    trace : list, optional
        For a single impact: its phases are appended in order.

    Returns
    -------
    Outcome
    impulse : ndarray
        Tangential impulse, which is (x - w)/beta.

    Examples
    --------
    >>> outcome, impulse = solve(Impacts(*np.array([[8.0], [3.5], [1.21], [1.0]])))
    >>> float(outcome.velocity[0]), float(impulse[0])
    (1.0, 2.0)
    """
    x, beta, zeta2, e = impacts
    outcome = Outcome(
        x - (1 + e) * beta, np.ones_like(x), np.full(x.shape, Regime.SLIP_THROUGHOUT, np.uint8)
    )
    sticks = x < slip_throughout_limit(beta, zeta2, e)
    slips_to_restitution = (x > beta) & (x > zeta2)
    early = np.flatnonzero(sticks & ~slips_to_restitution)
    late = np.flatnonzero(sticks & slips_to_restitution)
    if trace is not None and not early.size:
        trace += [Phase(False, False, 0.0, 1.0, x), Phase(False, True, HALF_PI, 1.0, x - beta)]
    if early.size:
        stick = _from_compression(early, impacts.take(early), outcome, trace)
        _alternate(stick, impacts, outcome, trace)
    if late.size:
        outcome.regime[late] = Regime.SLIP_STICK
        _alternate(_after_late_slip(late, impacts.take(late)), impacts, outcome, trace)
    return outcome, np.where(sticks, (x - outcome.velocity) / beta, 1 + e)


def state(phase, eta, beta, zeta2, e):
    """Friction and velocity of one phase at angles `eta` of its half.

    Returns
    -------
    friction, velocity : ndarray, shape of eta
    """
    if phase.sticks:
        rate = np.sqrt(beta / zeta2) * (e if phase.in_restitution else 1.0)
        sine, cosine = sin_cos(phase.theta + rate * np.abs(eta - phase.eta))
        force = phase.side * phase.amplitude
        return force * sine, np.sqrt(beta * zeta2) * force * cosine
    passed = np.abs(normal.impulse(eta) - normal.impulse(phase.eta))
    share = e if phase.in_restitution else 1.0
    return phase.side * normal.force(eta), phase.velocity - phase.side * beta * share * passed


def _tangent(slope, gap, rate):
    """Stick that starts with T = N and T' = N' = slope: amplitude, theta and eta there.

    `gap` is 1 - |slope|, free of cancellation.
    """
    force = np.sqrt(gap * (1 + np.abs(slope)))
    eta = np.arctan2(force, np.abs(slope))
    return np.hypot(force, slope / rate), np.arctan2(rate * force, slope), eta


def _from_compression(lanes, impacts, outcome, trace):
    """Stick from the start, or after slip in compression, up to maximum compression.

    Fills the outcome of contacts that end there or slip on; the others are returned.
    """
    x, beta, zeta2, e = impacts
    omega = np.sqrt(beta / zeta2)
    slips_first = x > zeta2
    # Initial stick is tangent in the same way, with no force and T/N = x/zeta^2.
    reach = np.where(slips_first, beta - zeta2, zeta2)
    slope = np.where(slips_first, beta - x, x) / reach
    gap = np.where(slips_first, x - zeta2, 0.0) / reach
    amplitude, theta, eta = _tangent(slope, gap, omega)
    if trace is not None:
        trace += [Phase(False, False, 0.0, 1.0, x)] if slips_first[0] else []
        trace.append(Phase(True, False, eta, 1.0, 0.0, amplitude, theta))
    theta = theta + omega * (HALF_PI - eta)
    sine, cosine = sin_cos(theta)
    friction = amplitude * sine
    outcome.velocity[lanes] = np.sqrt(beta * zeta2) * amplitude * cosine
    outcome.peak_friction[lanes] = np.where(theta < HALF_PI, friction, amplitude)
    outcome.regime[lanes] = np.where(slips_first, Regime.SLIP_STICK, Regime.STICK)

    broken = (omega < 1) & (friction > 1)
    if broken.any():
        where = np.flatnonzero(broken)
        _break_in_compression(lanes[where], impacts.take(where), outcome, trace)
    last = (e == 0) | (x == 0)
    if trace is not None and last[0] and not broken[0]:
        trace.append(Phase(True, True, HALF_PI, 1.0, 0.0, amplitude, theta))
    on = np.flatnonzero(~(broken | last))
    return Stick(lanes[on], np.full(on.size, HALF_PI), theta[on], amplitude[on], np.ones(on.size))


def _break_in_compression(lanes, impacts, outcome, trace):
    """Initial stick that breaks before maximum compression (omega < Omega) slips to the end."""
    x, beta, zeta2, e = impacts
    omega = np.sqrt(beta / zeta2)
    eta = slip_onset.in_compression(x, zeta2, omega)
    onset = x * np.cos(omega * eta)
    passed = normal.impulse(eta)
    outcome.velocity[lanes] = onset - beta * (1 + e - passed)
    outcome.peak_friction[lanes] = 1.0
    outcome.regime[lanes] = Regime.STICK_SLIP
    if trace is not None:
        trace.append(Phase(False, False, eta, 1.0, onset))
        trace.append(Phase(False, True, HALF_PI, 1.0, onset - beta * (1 - passed)))


def _after_late_slip(lanes, impacts):
    """Stick after a first slip that ended in restitution, at cos(eta) = (x - beta)/K."""
    x, beta, zeta2, e = impacts
    reach = restick_coefficient(beta, zeta2, e)
    slope, gap = (beta - x) / reach, (reach + (beta - x)) / reach
    amplitude, theta, eta = _tangent(slope, gap, e * np.sqrt(beta / zeta2))
    return Stick(lanes, eta, theta, amplitude, np.ones_like(eta))


def _alternate(stick, impacts, outcome, trace):
    """Slip and stick in turn until every impact slides to separation; fills the outcome."""
    first = True
    sticks_left = _most_sticks(stick, impacts)
    while stick.lanes.size:
        if not sticks_left:
            raise ConvergenceError(f"{stick.lanes.size} impacts stick more often than they can")
        sticks_left -= 1
        lanes, amplitude = stick.lanes, stick.amplitude
        _, beta, zeta2, e = impacts.take(lanes)
        rate = e * np.sqrt(beta / zeta2)
        eta, rho, wave = slip_onset.in_restitution(stick.eta, stick.theta, amplitude, rate)
        side = np.where(wave % 2 == 0, stick.side, -stick.side)
        onset = np.sqrt(beta * zeta2) * amplitude * np.cos(rho)
        final = onset - beta * e * normal.impulse(eta)  # in the direction of slip
        outcome.velocity[lanes] = side * final
        if trace is not None:
            trace.append(Phase(True, True, stick.eta, stick.side, 0.0, amplitude, stick.theta))
            trace.append(Phase(False, True, eta, side, side * onset))
        if first:
            rising = (wave == 0) & (rho < HALF_PI)
            crest = np.where(rising, normal.force(eta), amplitude)
            slid = stick.eta < HALF_PI  # slip went through maximum compression, where N = 1
            outcome.peak_friction[lanes] = np.where(slid, 1.0, crest)
            outcome.regime[lanes] += np.uint8(Regime.STICK_SLIP - Regime.STICK)
            first = False
        # Slip lasts to separation unless its velocity, final + zeta^2/e there, would turn round.
        again = np.flatnonzero((rate > 1) & (e * final < -zeta2))
        stick = _stick_again(stick, again, side, final, beta, zeta2, e, rate)
        outcome.regime[stick.lanes] = Regime.MULTIPLE


def _most_sticks(stick, impacts):
    """Each stick in restitution has a half-wave of T of its own, a part of it at the ends."""
    _, beta, zeta2, e = impacts.take(stick.lanes)
    return int(np.max(e * np.sqrt(beta / zeta2), initial=0.0)) + 3


def _stick_again(stick, again, side, final, beta, zeta2, e, rate):
    """Stick after a slip in restitution that ends at cos(eta) = C/K = 1 - gap."""
    beta, zeta2, e, rate = beta[again], zeta2[again], e[again], rate[again]
    gap = -(final[again] + zeta2 / e) / restick_coefficient(beta, zeta2, e)
    amplitude, theta, eta = _tangent(gap - 1, gap, rate)
    return Stick(stick.lanes[again], eta, theta, amplitude, side[again])
