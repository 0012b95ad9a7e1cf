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

import numpy as np

from planarimpact.common import roots
from planarimpact.common.angles import HALF_PI, sin_cos
from planarimpact.common.arrays import Array, Booleans, Integers

# Rounding may put an onset at the very end of its bracket beyond it, by less than this share.
BEYOND = 1 + 1e-6
# Steps without a bracket. They find nearly every onset.
FREE_STEPS = 3
# Above this rate the onset is close to the crest of |T|: a second zero lies just behind the crest.
# The search then starts from the crest, the end of the bracket.
HIGH_RATE = 10.0


def in_restitution(
    eta: Array, theta: Array, amplitude: Array, rate: Array
) -> tuple[Array, Array, Array]:
    """Where slip starts in restitution: stick starts at `eta`, and |T| reaches N at an angle below.

    T has the angle `theta` at the start. `eta` falls by the advance a, and `theta` grows by rate a.
    The onset is at the smallest a with sin(eta - a) = |amplitude sin(theta + rate a)|.

    For rate > 1 and theta < pi the ratio |T|/N must be past its maximum. It is so at every start
    of stick in this model, and after compression. So that half-wave is not searched.

    Returns eta at the onset; rho, which is theta there, counted from the start of its half-wave;
    and the number of that half-wave, in which T has the sign of sin(theta) = (-1)^wave.
    """
    # No slip starts while N exceeds the largest |T|: go on at once to where N has fallen to it.
    fast = rate > 1
    highest = amplitude
    slow = np.flatnonzero(~fast)
    if slow.size:
        end = theta[slow] + rate[slow] * eta[slow]
        highest = amplitude.copy()  # a T that still rises at separation stays below A
        highest[slow] *= np.sin(np.minimum(end, HALF_PI))
    reached = np.minimum(eta, np.arcsin(np.minimum(highest, 1.0)))
    theta_reached = theta + rate * (eta - reached)
    # For rate > 1 the half-wave of the onset is the present one or the next. It is the next where
    # |T|/N is past its maximum (`passed`): in the first half-wave always, later where it falls.
    present = np.floor(theta_reached / np.pi)
    rho = theta_reached - present * np.pi
    passed = present == 0
    behind_crest = np.flatnonzero(fast & ~passed & (rho > HALF_PI))
    if behind_crest.size:
        met, latest = _meets_behind_crest(
            reached[behind_crest], rho[behind_crest], amplitude[behind_crest], rate[behind_crest]
        )
        passed[behind_crest] = ~met
    wave = present + passed
    if slow.size:
        # For rate <= 1 slip starts in the half-wave in which stick would reach separation. Where
        # stick or a half-wave starts, |T|/N is at most 1; its only extremum after is a minimum. If
        # the half-wave ends before separation, T = 0 there: the ratio has stayed below 1. In the
        # half-wave of separation N vanishes first: the ratio grows without bound, so it crosses 1
        # once.
        end = theta_reached[slow] + rate[slow] * reached[slow]
        wave[slow] = np.maximum(present[slow], np.ceil(end / np.pi) - 1)

    # For rate > 1 the crossing lies before the crest of that half-wave, where |T| = A exceeds N.
    start = np.maximum(theta_reached, wave * np.pi)
    eta = np.maximum(reached - (start - theta_reached) / rate, 0.0)
    rho = start - wave * np.pi
    widest = np.where(fast, np.minimum(eta, (HALF_PI - rho) / rate), eta)
    if behind_crest.size:
        widest[behind_crest[met]] = latest[met]
    advance = _onset(eta, rho, amplitude, rate, np.maximum(widest, 0.0))
    advance = np.minimum(advance, eta)  # rounding may put a root at separation behind it
    return eta - advance, rho + rate * advance, wave


def _onset(eta: Array, rho: Array, amplitude: Array, rate: Array, widest: Array) -> Array:
    """The one advance a from 0 to `widest` at which |T| reaches its limit.

    There N is sin(eta - a) and |T| is amplitude sin(rho + rate a).
    """
    square, swings = rate * rate, amplitude * rate

    def margin(which: Integers | slice, advance: Array) -> tuple[Array, Array, Array]:
        force, fall = sin_cos(eta[which] - advance)
        friction, swing = sin_cos(rho[which] + rate[which] * advance)
        friction = friction * amplitude[which]
        slope = -(fall + swing * swings[which])
        return force - friction, slope, square[which] * friction - force

    start, low = np.where(rate > HIGH_RATE, widest, 0.0), np.zeros_like(widest)
    return roots.crossing(margin, low, widest * BEYOND, start=start, unguarded=FREE_STEPS)


def _meets_behind_crest(
    eta: Array, rho: Array, amplitude: Array, rate: Array
) -> tuple[Booleans, Array]:
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
    (force, fall), (friction, swing) = sin_cos(eta), sin_cos(rho)
    rises = rate * swing * force + friction * fall > 0  # N' = -fall
    met, latest = rises & (rate * eta <= np.pi - rho), eta.copy()
    undecided = np.flatnonzero(rises & ~met)
    if not undecided.size:
        return met, latest
    eta, rho, amplitude, rate = (
        eta[undecided],
        rho[undecided],
        amplitude[undecided],
        rate[undecided],
    )

    def forces(which: Integers | slice, theta: Array) -> tuple[Array, Array, Array, Array]:
        force, fall = sin_cos(eta[which] - (theta - rho[which]) / rate[which])
        return force, fall, *sin_cos(theta)

    def rise(which: Integers, theta: Array) -> tuple[Array, ...]:
        force, fall, friction, swing = forces(which, theta)
        rates = rate[which]
        falls = 1 / rates - rates
        bend = falls * (swing * force - friction * fall / rates)
        return rates * swing * force + friction * fall, falls * friction * force, bend

    # The ratio is level at its largest value: half of the digits of the place are enough.
    top = roots.crossing(rise, rho, np.full_like(rho, np.pi), start=rho, resolution=1e-8)
    force, _, friction, _ = forces(slice(None), top)
    met[undecided] = amplitude * friction >= force
    latest[undecided] = (top - rho) / rate
    return met, latest


def breaks_in_compression(amplitude: Array, theta: Array) -> Booleans:
    """Whether stick with T = amplitude sin(theta) at the end has broken before, for rate < 1."""
    return amplitude * np.sin(theta) > 1


def in_compression(x: Array, zeta2: Array, rate: Array) -> Array:
    """First eta > 0 with x/(zeta^2 rate) sin(rate eta) at the limit of friction, for rate < 1.

    T must be above its limit at maximum compression. With u = eta^2, (T - N)/eta is increasing and
    concave in u. So the search starts from the zero of the tangent at u = 0, which lies before the
    onset. For x = zeta^2 it is 0.
    """
    amplitude, ratio = x / (zeta2 * rate), x / zeta2
    first = np.minimum(6 * (1 - ratio) / (1 - ratio * rate * rate), HALF_PI**2)

    def margin(which: Integers, u: Array) -> tuple[Array, Array]:
        eta, rates = np.sqrt(u), rate[which]
        (friction, swing), (force, fall) = sin_cos(rates * eta), sin_cos(eta)
        friction, swing = amplitude[which] * friction, amplitude[which] * swing * rates
        safe = np.where(eta > 0, eta, 1.0)
        slope = (eta * (fall - swing) - (force - friction)) / (2 * safe**3)
        return (force - friction) / safe, slope

    end = np.full_like(first, HALF_PI**2)
    return np.sqrt(roots.crossing(margin, first, end, start=first))
