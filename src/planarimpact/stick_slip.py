"""The phases of a lumped contact and the order in which they follow each other.

Units 1/Omega, |v2(0)|, mu |v2(0)| and m2 Omega |v2(0)| for time, normal and tangential velocity
and normal force, with friction T in mu times that; omega^2 = beta/zeta^2:

    w' = -beta T,   T = s/zeta^2,   stick: s' = w while |T| <= N,   slip: T = side N.

In stick T = A sin(theta) and w = sqrt(beta zeta^2) A cos(theta) with theta' = omega: a phase is
its amplitude A and its angle. Time runs as the angle `eta` of `planarimpact.normal`, for which
the rate of theta is omega in compression and e omega in restitution.

Slip always ends in closed form. The onset of slip is a root, searched only where it is alone:

* While T and N have one sign, (T'N - TN')' = (nu^2 - rate^2) T N with nu = 1. So for rate > 1 the
  ratio T/N has at most one extremum in each half-wave of T, a maximum; for rate <= 1 a minimum.
* At slip -> stick T'N - TN' = 0. For rate > 1 the ratio then falls to the end of its half-wave:
  the double zero of |T| - N, where a root finder would chatter, is never searched. For
  rate <= 1 slip never turns into stick.
* In compression with omega > 1, T^2 + (T'/omega)^2 is constant in stick while N^2 + (N'/omega)^2
  grows, so slip cannot start there.
* Slip cannot start while N exceeds A.

Errors do not grow: any two solutions approach each other in the tangential energy
w^2/(2 beta) + zeta^2 T^2/2, and an event misplaced by epsilon moves the result by the order of
epsilon^2.
"""

from typing import NamedTuple

import numpy as np

from planarimpact import normal
from planarimpact.results import Regime

HALF_PI = np.pi / 2
# The root finder is cubic: after a step of this size the root is at rounding.
LAST_STEP = 1e-6


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


def sin_cos(angle):
    """Sine and cosine from one tangent, the cheapest function of the three.

    Examples
    --------
    >>> [round(float(value), 12) for value in sin_cos(np.pi / 6)]
    [0.5, 0.866025403784]
    """
    tangent = np.tan(angle / 2)
    double = 2 / (1 + tangent * tangent)
    return tangent * double, double - 1


def restick_coefficient(beta, zeta2, e):
    """K = e beta - zeta^2/e where positive, else 0.

    Slip in restitution has the velocity C - K cos(eta), C constant; it can end only if K > 0.
    """
    fast = e * e * beta > zeta2
    return np.where(fast, (e * e * beta - zeta2) / np.where(fast, e, 1.0), 0.0)


def slip_throughout_limit(beta, zeta2, e):
    """Incidence from which slip never ends."""
    return np.maximum(zeta2, beta + restick_coefficient(beta, zeta2, e))


def solve(x, beta, zeta2, e, trace=None):
    """Solve impacts of incidence x >= 0, all arrays of one shape (n,).

    With `trace`, a list, and n = 1 the phases are appended to it in order.

    Returns velocity, peak friction, tangential impulse and regime, each of shape (n,).
    """
    slides = x - (1 + e) * beta
    peak = np.ones_like(x)
    impulse = 1 + e
    regime = np.full(x.shape, Regime.SLIP_THROUGHOUT, np.uint8)
    rest = np.flatnonzero(x < slip_throughout_limit(beta, zeta2, e))
    if rest.size < x.size and trace is not None:
        trace += [Phase(False, False, 0.0, 1.0, x), Phase(False, True, HALF_PI, 1.0, x - beta)]
    if rest.size:
        x, beta = x[rest], beta[rest]
        velocity, peak[rest], regime[rest] = _with_stick(x, beta, zeta2[rest], e[rest], trace)
        slides[rest] = velocity
        impulse[rest] = (x - velocity) / beta
    return slides, peak, impulse, regime


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


def _with_stick(x, beta, zeta2, e, trace):
    """Impacts that stick at some time: velocity, peak friction, regime."""
    omega = np.sqrt(beta / zeta2)
    slips_first = x > zeta2
    late = slips_first & (x > beta)  # the first slip ends in restitution
    # Stick starts where N' = c, N = s; with initial stick T/N starts at c = x/zeta^2 and s = 0.
    reach = np.where(slips_first, beta - zeta2, zeta2)
    c = np.where(slips_first, beta - x, x) / reach
    gap = np.where(slips_first, x - zeta2, 0.0) / reach
    rate = omega
    if late.any():
        rate = np.where(late, e * omega, omega)
        reach = np.where(late, restick_coefficient(beta, zeta2, e), 1.0)
        c = np.where(late, (beta - x) / reach, c)
        gap = np.where(late, (reach + (beta - x)) / reach, gap)
    s = np.sqrt(gap * (1 + np.abs(c)))
    amplitude = np.hypot(s, c / rate)
    theta = np.arctan2(rate * s, c)
    lead = np.arctan2(np.abs(c), s)  # from the start of stick to maximum compression, or back
    eta = HALF_PI - np.where(late, lead, 0.0)
    if trace is not None:
        if slips_first[0]:
            trace.append(Phase(False, False, 0.0, 1.0, x))
        if late[0]:
            trace.append(Phase(False, True, HALF_PI, 1.0, x - beta))
        else:
            trace.append(Phase(True, False, HALF_PI - lead, 1.0, 0.0, amplitude, theta))
    theta = theta + np.where(late, 0.0, omega * lead)
    sine, cosine = sin_cos(theta)
    velocity = np.sqrt(beta * zeta2) * amplitude * cosine
    peak = np.where(late, 1.0, np.where(theta < HALF_PI, amplitude * sine, amplitude))
    regime = np.where(slips_first, Regime.SLIP_STICK, Regime.STICK).astype(np.uint8)

    slow = (omega < 1) & ~slips_first
    early = slow & (amplitude * np.sin(omega * HALF_PI) > 1)
    if early.any():
        lane = np.flatnonzero(early)
        velocity[lane] = _slip_from_compression(
            x[lane], beta[lane], zeta2[lane], e[lane], omega[lane], amplitude[lane], trace
        )
        peak[lane] = 1.0
        regime[lane] = Regime.STICK_SLIP

    lane = np.flatnonzero((e > 0) & (x > 0) & ~early)
    if lane.size:
        stick = _Stick(lane, eta[lane], theta[lane], amplitude[lane], np.ones(lane.size))
        _restitution(stick, late, beta, zeta2, e, e * omega, velocity, peak, regime, trace)
    elif trace is not None and not early.any():
        trace.append(Phase(True, True, eta, 1.0, 0.0, amplitude, theta))
    return velocity, peak, regime


class _Stick(NamedTuple):
    """Impacts (by index `lane`) in stick in restitution, T = side amplitude sin(theta)."""

    lane: np.ndarray
    eta: np.ndarray
    theta: np.ndarray
    amplitude: np.ndarray
    side: np.ndarray


def _restitution(stick, late, beta, zeta2, e, rates, velocity, peak, regime, trace):
    """Alternate slip and stick until every impact slides to separation; fills the results."""
    first = True
    while stick.lane.size:
        lane = stick.lane
        rate, beta_, zeta2_, e_ = rates[lane], beta[lane], zeta2[lane], e[lane]
        scale = np.sqrt(beta_ * zeta2_)
        eta, rho, wave = slip_onset(stick.eta, stick.theta, stick.amplitude, rate)
        side = np.where(wave % 2 == 0, stick.side, -stick.side)
        at_onset = scale * stick.amplitude * np.cos(rho)
        final = at_onset - beta_ * e_ * normal.impulse(eta)
        velocity[lane] = side * final
        if trace is not None:
            trace.append(Phase(True, True, stick.eta, stick.side, 0.0, stick.amplitude, stick.theta))
            trace.append(Phase(False, True, eta, side, side * at_onset))
        if first:
            rising = (wave == 0) & (rho < HALF_PI)
            crest = np.where(rising, normal.force(eta), stick.amplitude)
            peak[lane] = np.where(late[lane], 1.0, crest)
            regime[lane] += Regime.STICK_SLIP - Regime.STICK
            first = False
        again = np.flatnonzero((rate > 1) & (e_ * final < -zeta2_))
        if not again.size:
            return
        regime[lane[again]] = Regime.MULTIPLE
        # Slip ends at cos(eta) = C/K, with T = side N and T' = side N'.
        reach = restick_coefficient(beta_[again], zeta2_[again], e_[again])
        gap = -(final[again] + zeta2_[again] / e_[again]) / reach
        c = 1 - gap
        s = np.sqrt(gap * (1 + c))
        stick = _Stick(
            lane[again],
            np.arctan2(s, c),
            np.arctan2(rate[again] * s, -c),
            np.hypot(s, c / rate[again]),
            side[again],
        )


def slip_onset(eta, theta, amplitude, rate):
    """First eta' <= eta, falling, with sin(eta') = |amplitude sin(theta + rate (eta - eta'))|.

    For rate > 1 and theta < pi the ratio |T|/N must be past its maximum, as it is at every start
    of stick in this model and after compression: that half-wave is not searched.

    Returns
    -------
    eta : ndarray
        Angle at the onset.
    rho : ndarray
        theta there, from the start of its half-wave.
    wave : ndarray
        Number of the half-wave: T has the sign of sin(theta) = (-1)^wave.
    """
    rate = np.maximum(rate, np.finfo(float).tiny)
    reached = np.minimum(eta, np.arcsin(np.minimum(amplitude, 1.0)))  # N = A: no slip before
    theta_reached = theta + rate * (eta - reached)
    wave = np.floor(theta_reached / np.pi)
    rho = theta_reached - wave * np.pi
    fast = rate > 1
    # rate <= 1: one crossing, in the half-wave in which stick would end.
    last = np.maximum(wave, np.ceil((theta + rate * eta) / np.pi) - 1)
    (force, fall), (friction, swing) = sin_cos(reached), sin_cos(rho)
    falling = rate * swing * force + friction * fall <= 0
    passed = (wave == 0) | (falling & (rho > HALF_PI))
    dip = np.flatnonzero(fast & ~passed & (rho > HALF_PI))
    if dip.size:
        found, slid = _onset_behind_crest(reached[dip], rho[dip], amplitude[dip], rate[dip])
        passed[dip] = ~found
        reached[dip] -= slid
        theta_reached[dip] += rate[dip] * slid
    wave = np.where(fast, wave + passed, last)

    start = np.maximum(theta_reached, wave * np.pi)
    eta = np.maximum(reached - (start - theta_reached) / rate, 0.0)
    rho = start - wave * np.pi
    widest = np.where(fast, np.minimum(eta, (HALF_PI - rho) / rate), eta)
    advance = _crossing(eta, rho, amplitude, rate, np.maximum(widest, 0.0))
    return eta - advance, rho + rate * advance, wave


def _crossing(eta, rho, amplitude, rate, widest):
    """Single zero in [0, widest] of sin(eta - a) - amplitude sin(rho + rate a), guarded."""
    advance = np.zeros_like(eta)
    lane, low, high, trial = np.arange(eta.size), advance, widest, advance
    for _ in range(100):
        before = trial
        force, fall = sin_cos(eta - before)
        friction, swing = sin_cos(rho + rate * before)
        friction, swing = friction * amplitude, swing * amplitude * rate
        excess, descent = force - friction, fall + swing
        above = excess > 0
        low, high = np.where(above, before, low), np.where(above, high, before)
        # The nearer root of the Taylor parabola; good also where the descent vanishes.
        root = descent * descent - 2 * excess * (rate * rate * friction - force)
        with np.errstate(divide="ignore", invalid="ignore"):
            trial = before + 2 * excess / (descent + np.sqrt(np.maximum(root, 0.0)))
        inside = (trial >= low) & (trial <= high)
        trial = np.where(inside, trial, (low + high) / 2)
        moving = ~inside | (np.abs(trial - before) > LAST_STEP)
        moving &= high - low > LAST_STEP**2
        if moving.all():
            continue
        advance[lane] = trial
        lane = lane[moving]
        if not lane.size:
            break
        trial, low, high = trial[moving], low[moving], high[moving]
        eta, rho, amplitude, rate = eta[moving], rho[moving], amplitude[moving], rate[moving]
    return advance


def _onset_behind_crest(eta, rho, amplitude, rate):
    """Search a falling |T| whose ratio to N still rises: found or not, and the advance.

    Steps that provably jump no root: the second derivative of N - |T| is at least -N, and N
    falls. They stay in the half-wave of T, whose end the ratio cannot reach while it rises.
    """
    found = np.zeros(eta.shape, bool)
    advance = np.zeros_like(eta)
    for _ in range(200):
        force, fall = sin_cos(eta - advance)
        friction, swing = sin_cos(rho + rate * advance)
        friction, swing = friction * amplitude, swing * amplitude * rate
        rises = swing * force + friction * fall > 0
        excess = np.maximum(force - friction, 0.0)
        slope = fall + swing
        step = 2 * excess / (np.sqrt(slope * slope + 2 * force * excess) + slope)
        step = np.minimum(step, (np.pi - rho - rate * advance) / (2 * rate))
        small = step <= LAST_STEP**2 * eta
        found |= rises & small
        step = np.where(rises & ~small, step, 0.0)
        if not step.any():
            break
        advance += step
    return found, advance


def _slip_from_compression(x, beta, zeta2, e, omega, amplitude, trace):
    """Final velocity for omega < 1 where initial stick breaks before maximum compression.

    With u = eta^2, (T - N)/eta is increasing and concave in u, so Newton's iterates from
    the left rise to the root.
    """
    ratio = x / zeta2
    u = 6 * (1 - ratio) / (1 - ratio * omega * omega)
    for _ in range(60):
        eta = np.sqrt(u)
        wave = omega * eta
        excess = amplitude * np.sin(wave) - np.sin(eta)
        slope = amplitude * (wave * np.cos(wave) - np.sin(wave)) - eta * np.cos(eta) + np.sin(eta)
        with np.errstate(divide="ignore", invalid="ignore"):
            step = np.where(slope > 0, -2 * u * excess / slope, 0.0)
        u = np.clip(u + step, 0.0, HALF_PI**2)
        if np.abs(step).max() <= LAST_STEP**2:
            break
    eta = np.sqrt(u)
    onset = x * np.cos(omega * eta)
    if trace is not None:
        trace.append(Phase(False, False, eta, 1.0, onset))
        peak_velocity = onset - beta * (1 - normal.impulse(eta))
        trace.append(Phase(False, True, HALF_PI, 1.0, peak_velocity))
    return onset - beta * (1 + e - normal.impulse(eta))

