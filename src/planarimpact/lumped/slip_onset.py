"""Where slip starts: the first instant of stick at which friction |T| reaches its limit.

The limit is Coulomb's: the normal force N, as friction is in units of mu.
T = A sin(theta) and N = sin(eta), with the angle `eta` of `stick_slip`. A prime is the derivative
with respect to the time, counted as `eta`: eta' = 1 in compression and -1 in restitution, where
`eta` falls to 0; theta' = rate. A half-wave of T lies between two zeros of T.

The root is searched only where it is alone:

* While T and N have one sign, (T'N - TN')' = (1 - rate^2) T N. So for rate > 1 the ratio T/N has
  at most one extremum in each half-wave of T, a maximum; for rate <= 1 at most one, a minimum.
* At slip -> stick T'N - TN' = 0. For rate > 1 the ratio then falls to the end of its half-wave:
  the double zero of |T| - N, where a root finder would chatter, is never searched. For
  rate <= 1 slip never turns into stick.
* In compression with rate > 1, T^2 + (T'/rate)^2 is constant in stick while N^2 + (N'/rate)^2
  grows, so slip cannot start there.
* Slip cannot start while N exceeds A.
"""

from collections.abc import Callable
from typing import Any

import numpy as np

from planarimpact.common import floats, roots
from planarimpact.common.floats import HALF_PI, sin_cos

# Rounding may put an onset at the very end of its bracket beyond it, by less than this share.
BEYOND = 1 + 1e-6
# Steps without a bracket. They find nearly every onset.
FREE_STEPS = 3
# Above this rate the onset is close to the crest of |T|: a second zero lies just behind the crest.
# The search then starts from the crest, the end of the bracket.
HIGH_RATE = 10.0
# The ratio |T|/N is level at its largest value: half of the digits of its place are enough.
LEVEL = 1e-8


def in_restitution(eta: Any, theta: Any, amplitude: Any, rate: Any, m: Any) -> tuple[Any, Any, Any]:
    """Where slip starts in restitution: stick starts at `eta`, and |T| reaches N at an angle below.

    T has the angle `theta` at the start. `eta` falls by the advance a, and `theta` grows by rate a.
    The onset is at the smallest a with sin(eta - a) = |amplitude sin(theta + rate a)|.

    For rate > 1 and theta < pi the ratio |T|/N must be past its maximum. It is so at every start
    of stick in this model, and after compression. So that half-wave is not searched.

    Returns eta at the onset; rho, which is theta there, counted from the start of its half-wave;
    and the number of that half-wave, in which T has the sign of sin(theta) = (-1)^wave.
    """
    # No slip starts while N exceeds the largest |T|: go on at once to where N has fallen to it. For
    # rate <= 1 a T that still rises at separation stays below A.
    fast, highest = rate > 1, amplitude
    all_fast = m.all(fast)
    if not all_fast:
        rises = m.sin(m.minimum(theta + rate * eta, HALF_PI))
        highest = m.where(fast, amplitude, amplitude * rises)
    reached = m.minimum(eta, m.arcsin(m.minimum(highest, 1.0)))
    theta_reached = theta + rate * (eta - reached)
    # For rate > 1 the half-wave of the onset is the present one or the next. It is the next where
    # |T|/N is past its maximum: in the first half-wave always, later where it falls.
    present = m.floor(theta_reached / np.pi)
    rho = theta_reached - present * np.pi
    behind_crest = fast & (present > 0) & (rho > HALF_PI)
    at_start = reached, rho, amplitude, rate
    met, latest = _among(behind_crest, _meets_behind_crest, at_start, m)
    wave = present + ((present == 0) | (behind_crest & (met == 0)))
    if not all_fast:
        # For rate <= 1 slip starts in the half-wave in which stick would reach separation. Where
        # stick or a half-wave starts, |T|/N is at most 1; its only extremum after is a minimum. If
        # the half-wave ends before separation, T = 0 there: the ratio has stayed below 1. In the
        # half-wave of separation N vanishes first: the ratio grows without bound, so it crosses 1
        # once.
        last = m.ceil((theta_reached + rate * reached) / np.pi) - 1
        wave = m.where(fast, wave, m.maximum(present, last))

    # For rate > 1 the crossing lies before the crest of that half-wave, where |T| = A exceeds N.
    start = m.maximum(theta_reached, wave * np.pi)
    eta = m.maximum(reached - (start - theta_reached) / rate, 0.0)
    rho = start - wave * np.pi
    widest = m.where(fast, m.minimum(eta, (HALF_PI - rho) / rate), eta)
    widest = m.maximum(m.where(met, latest, widest), 0.0)
    # The one advance from 0 to `widest` at which |T| reaches its limit.
    ends = 0.0 * widest, widest * BEYOND
    first = m.where(rate > HIGH_RATE, widest, 0.0)
    state = eta, rho, amplitude, rate, amplitude * rate, rate * rate
    advance = _crossing(_margin, state, ends, m, start=first, unguarded=FREE_STEPS)
    advance = m.minimum(advance, eta)  # rounding may put a root at separation behind it
    return eta - advance, rho + rate * advance, wave


def _crossing(
    margin: Callable[..., tuple[Any, ...]], state: Any, ends: Any, m: Any, **options: Any
) -> Any:
    """The place between two ends where a margin(place, *state, m) falls through zero."""
    if m is floats:
        return roots.crossing_of_one(lambda place: margin(place, *state, m), *ends, **options)
    return roots.crossing(
        lambda which, place: margin(place, *(field[which] for field in state), m), *ends, **options
    )


def _among(condition: Any, function: Callable[..., Any], state: Any, m: Any) -> tuple[Any, Any]:
    """What a function(*state, m) returns where a condition holds; elsewhere False and 0."""
    if not m.any(condition):
        return False, 0.0
    if m is floats:
        return function(*state, m)
    found, which = (np.zeros(condition.size, bool), np.zeros(condition.size)), condition.nonzero()
    found[0][which], found[1][which] = function(*(field[which] for field in state), m)
    return found


def _margin(
    advance: Any, eta: Any, rho: Any, amplitude: Any, rate: Any, swings: Any, square: Any, m: Any
) -> tuple[Any, ...]:
    """N - |T| after an advance, with two derivatives."""
    force, fall = sin_cos(eta - advance, m)
    friction, swing = sin_cos(rho + rate * advance, m)
    friction = friction * amplitude
    slope = -(fall + swing * swings)
    return force - friction, slope, square * friction - force


def _meets_behind_crest(eta: Any, rho: Any, amplitude: Any, rate: Any, m: Any) -> tuple[Any, Any]:
    """Whether a falling |T| meets its limit in this half-wave.

    Where it does, the second result is an advance at or behind the onset, before any other onset.

    The rate is above 1. |T| = A sin(theta), where theta counts from the start of the half-wave,
    lies behind the crest: it grows from `rho` > pi/2 to pi. The ratio |T|/N rises while

        rise = (|T|'N - |T|N')/A > 0.

    1. The rise falls all along, since rise' = (1 - rate^2) |T| N/A < 0. If it is not positive at
       first, |T| stays below its limit.
    2. The contact may end before the half-wave does. There N = 0, so the rise is still positive:
       the ratio rises all the way, without bound. So |T| meets its limit.
    3. Else the half-wave ends first. There T = 0 and |T|' < 0, so the rise is negative: it has one
       zero before, where the ratio is largest. |T| meets its limit if it is at or above it there.
    """
    state = eta, rho, amplitude, rate
    (force, fall), (friction, swing) = sin_cos(eta, m), sin_cos(rho, m)
    rises = rate * swing * force + friction * fall > 0  # N' = -fall
    undecided = rises & (rate * eta > np.pi - rho)
    met, latest = _among(undecided, _meets_where_level, state, m)
    return m.where(undecided, met, rises), m.where(undecided, latest, eta)


def _meets_where_level(eta: Any, rho: Any, amplitude: Any, rate: Any, m: Any) -> tuple[Any, Any]:
    """The third case of `_meets_behind_crest`."""
    ends = rho, np.pi + 0.0 * rho
    top = _crossing(_rise, (eta, rho, rate), ends, m, start=rho, resolution=LEVEL)
    force, friction = sin_cos(eta - (top - rho) / rate, m)[0], sin_cos(top, m)[0]
    return amplitude * friction >= force, (top - rho) / rate


def _rise(theta: Any, eta: Any, rho: Any, rate: Any, m: Any) -> tuple[Any, ...]:
    """The rise where T has the angle theta, and two derivatives."""
    (force, fall), (friction, swing) = sin_cos(eta - (theta - rho) / rate, m), sin_cos(theta, m)
    falls = 1 / rate - rate
    bend = falls * (swing * force - friction * fall / rate)
    return rate * swing * force + friction * fall, falls * friction * force, bend


def in_compression(x: Any, zeta2: Any, rate: Any, m: Any) -> Any:
    """First eta > 0 with x/(zeta^2 rate) sin(rate eta) at the limit of friction, for rate < 1.

    T must be above its limit at maximum compression. With u = eta^2, (T - N)/eta is increasing and
    concave in u. So the search starts from the zero of the tangent at u = 0, which lies before the
    onset. For x = zeta^2 it is 0.
    """
    amplitude, ratio = x / (zeta2 * rate), x / zeta2
    first = m.minimum(6 * (1 - ratio) / (1 - ratio * rate * rate), HALF_PI**2)
    ends = first, HALF_PI**2 + 0.0 * first
    return m.sqrt(_crossing(_margin_in_compression, (amplitude, rate), ends, m, start=first))


def _margin_in_compression(u: Any, amplitude: Any, rate: Any, m: Any) -> tuple[Any, ...]:
    """(N - T)/eta where eta^2 = u, with its derivative."""
    eta = m.sqrt(u)
    (friction, swing), (force, fall) = sin_cos(rate * eta, m), sin_cos(eta, m)
    friction, swing = amplitude * friction, amplitude * swing * rate
    safe = eta + (eta == 0)
    slope = (eta * (fall - swing) - (force - friction)) / (2 * m.power(safe, 3))
    return (force - friction) / safe, slope
