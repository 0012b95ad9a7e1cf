"""Where slip starts: the first instant of stick at which |T| reaches N.

T = A sin(theta) and N = sin(eta), with the angle `eta` of `normal`. A prime is the derivative with
respect to the time, counted as `eta`: eta' = 1 in compression and -1 in restitution, where `eta`
falls to 0; theta' = rate. A half-wave of T lies between two zeros of T.

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

from planarimpact.ground.angles import HALF_PI, sin_cos
from planarimpact.ground.arrays import Array, Booleans, Integers
from planarimpact.ground.checks import ConvergenceError

# A step is the last if it is below LAST_STEP of the bracket, and its cubic term below LAST_CUBIC.
# What is left is then below rounding: it is like the fourth power of the step, and where two zeros
# are close, like the square of the cubic term over the step.
LAST_STEP = 1e-4
LAST_CUBIC = 1e-12
# Rounding may put a root at the very end of the bracket beyond it, by less than this share.
BEYOND = 1e-6
# Steps without a bracket. They find nearly every root.
FREE_STEPS = 3
# Above this rate the onset is close to the crest of |T|: a second zero lies just behind the crest.
# The steps then start from the crest, the end of the bracket.
HIGH_RATE = 10.0
# The cubic term may lengthen a step by this share at most. It is far smaller near the root.
LONGEST_CORRECTION = 0.5
# After FREE_TURNS turns every other turn halves the bracket: 40 halvings leave LAST_CUBIC of it.
FREE_TURNS = 8
MOST_TURNS = 100
# The distance of two subnormal neighbours: there is no number left between them.
SMALLEST = float(np.finfo(float).smallest_subnormal)
# Above this phase of an oscillation rounding hides the place within its period.
LARGEST_PHASE = 1e15


def in_restitution(
    eta: Array, theta: Array, amplitude: Array, rate: Array
) -> tuple[Array, Array, Array]:
    """Where slip starts in restitution: stick starts at `eta`, and |T| reaches N at an angle below.

    T has the angle `theta` at the start. `eta` falls by the advance a, and `theta` grows by rate a.
    The advance found is the first with sin(eta - a) = |amplitude sin(theta + rate a)|.

    For rate > 1 and theta < pi the ratio |T|/N must be past its maximum. It is so at every start
    of stick in this model, and after compression. So that half-wave is not searched.

    Returns
    -------
    eta : ndarray
        Angle at the onset.
    rho : ndarray
        theta there, from the start of its half-wave.
    wave : ndarray
        Number of the half-wave: T has the sign of sin(theta) = (-1)^wave.
    """
    # No slip starts while N exceeds the largest |T|: go on at once to where N has fallen to it.
    rate = np.maximum(rate, np.finfo(float).tiny)
    fast = rate > 1
    highest = amplitude
    slow = np.flatnonzero(~fast)
    if slow.size:
        end = theta[slow] + rate[slow] * eta[slow]
        highest = amplitude.copy()  # a T that still rises at separation stays below A
        highest[slow] *= np.sin(np.minimum(end, HALF_PI))
    reached = np.minimum(eta, np.arcsin(np.minimum(highest, 1.0)))
    theta_reached = theta + rate * (eta - reached)
    if theta_reached.max() > LARGEST_PHASE:  # any place within the period is as good
        lost = theta_reached > LARGEST_PHASE
        theta_reached = np.where(lost, 2 * np.pi + theta_reached % (2 * np.pi), theta_reached)
    # For rate > 1 the half-wave of the onset is the present one or the next. It is the next where
    # |T|/N is past its maximum (`passed`): in the first half-wave always, later where it falls.
    present = np.floor(theta_reached / np.pi)
    rho = theta_reached - present * np.pi
    passed = present == 0
    # Behind the crest of |T|, where |T| falls, |T|/N may fall too. If it still rises, |T| may meet
    # N in this half-wave or miss it.
    dip = np.flatnonzero(fast & ~passed & (rho > HALF_PI))
    if dip.size:
        (force, fall), (friction, swing) = sin_cos(reached[dip]), sin_cos(rho[dip])
        falling = rate[dip] * swing * force + friction * fall <= 0  # (|T|'N - |T|N')/A; N' = -fall
        passed[dip[falling]] = True
        dip = dip[~falling]
    if dip.size:
        met, latest = _meets_behind_crest(reached[dip], rho[dip], amplitude[dip], rate[dip])
        passed[dip] = ~met
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
    if dip.size:
        widest[dip[met]] = latest[met]
    advance = _crossing(eta, rho, amplitude, rate, np.maximum(widest, 0.0))
    advance = np.minimum(advance, eta)  # rounding may put a root at separation behind it
    return eta - advance, rho + rate * advance, wave


def _crossing(eta: Array, rho: Array, amplitude: Array, rate: Array, widest: Array) -> Array:
    """The one zero a in [0, widest] of N - |T| = sin(eta - a) - amplitude sin(rho + rate a)."""
    advance = np.where(rate > HIGH_RATE, widest, 0.0)
    with np.errstate(all="ignore"):  # a step to infinity is no root
        for _ in range(FREE_STEPS):
            _, descent, step, last = _step(advance, eta, rho, amplitude, rate, widest)
            advance = np.minimum(np.maximum(advance + step, 0.0), widest)
    rest = np.flatnonzero(~(last & (descent > 0)))  # N - |T| falls at its zero
    if rest.size:
        advance[rest] = _bracketed(*(a[rest] for a in (eta, rho, amplitude, rate, widest)))
    return advance


def _step(
    advance: Array, eta: Array, rho: Array, amplitude: Array, rate: Array, widest: Array
) -> tuple[Array, Array, Array, Booleans]:
    """The step from an advance to the zero of the margin N - |T|.

    Returns
    -------
    margin, descent, step : ndarray
        The margin, how fast it falls, and the step.
    last : ndarray of bool
        Whether the zero is then exact to rounding.
    """
    force, fall = sin_cos(eta - advance)
    friction, swing = sin_cos(rho + rate * advance)
    friction, swing = friction * amplitude, swing * (amplitude * rate)
    margin, descent = force - friction, fall + swing
    # The nearer root of the Taylor parabola. It exists also where the slope vanishes.
    square = rate * rate
    root = descent * descent - 2 * margin * (square * friction - force)
    root = np.sqrt(np.maximum(root, 0.0))
    step = 2 * margin / (descent + root)
    # The cubic term, over the slope of the parabola at its root.
    reach = step * step  # first, as rate^3 leaves the range of numbers
    correction = (reach * square * swing + reach * fall) / (6 * root)
    cubic = step * np.minimum(correction, LONGEST_CORRECTION)
    last = (np.abs(step) <= LAST_STEP * widest) & (np.abs(cubic) <= LAST_CUBIC * widest)
    return margin, descent, step + cubic, last


def _bracketed(eta: Array, rho: Array, amplitude: Array, rate: Array, widest: Array) -> Array:
    """As `_crossing`, slower, for every lane."""
    advance = np.zeros_like(eta)
    lane, low, high, trial = np.arange(eta.size), advance, widest * (1 + BEYOND), advance
    for turn in range(MOST_TURNS):
        # A turn moves one end of the bracket to the trial, and takes the next trial. A contact (a
        # lane) is done when its step is small enough.
        before = trial
        with np.errstate(all="ignore"):
            margin, descent, step, last = _step(before, eta, rho, amplitude, rate, widest)
            trial = before + step
        ahead = margin > 0
        if turn == 0:  # while the margin grows the root is ahead: a negative value is rounding
            ahead |= descent < 0
        low, high = np.where(ahead, before, low), np.where(ahead, high, before)
        inside = (trial >= low) & (trial <= high)
        # Halve the bracket instead if the trial lies outside, and in every other late turn:
        # rounding can throw the trial to and fro. The halvings end the loop in any case.
        if turn >= FREE_TURNS and turn % 2:
            inside[:] = False
        trial = np.where(inside, trial, (low + high) / 2)
        open_ = high - low > np.maximum(LAST_CUBIC * widest, SMALLEST)
        # Lanes that are done keep this trial, and leave the arrays.
        advance[lane] = trial
        on = np.flatnonzero(open_ & ~(inside & last))
        if not on.size:
            return advance
        lane, trial, low, high = lane[on], trial[on], low[on], high[on]
        eta, rho, amplitude, rate, widest = (a[on] for a in (eta, rho, amplitude, rate, widest))
    raise _lost(lane)


def _meets_behind_crest(
    eta: Array, rho: Array, amplitude: Array, rate: Array
) -> tuple[Booleans, Array]:
    """Whether a falling |T| whose ratio to N still rises meets N in this half-wave, for rate > 1.

    |T| = A sin(theta), where theta counts from the start of the half-wave, lies behind the crest:
    it grows from `rho` > pi/2 to pi. The ratio |T|/N is at most 1 at the start. It rises while

        rise = (|T|'N - |T|N')/A > 0.

    1. The rise falls all along, since rise' = (1 - rate^2) |T| N/A < 0.
    2. The contact may end before the half-wave does. There N = 0, so the rise is still positive:
       the ratio rises all the way, without bound. So |T| meets N.
    3. Else the half-wave ends first. There T = 0 and |T|' < 0, so the rise is negative: it has one
       zero before, where the ratio is largest. |T| meets N if the ratio is 1 or more there.
    4. That zero is searched by Newton's method. Both |T| and N fall, so rise' grows: the rise is
       convex. A tangent of a convex curve lies below it. So no step of Newton goes past the zero,
       and at every trial the ratio has only risen so far. If N <= |T| at a trial, there is one
       onset before it, and the trial is the end of the bracket for `_crossing`.

    The search moves theta. It ends when rounding hides a step in theta: the next trial would be the
    same.

    Newton's method is slow where the half-wave ends just before the contact does. There T and N are
    nearly proportional to the time to go, so rise' is like its square, and the rise is like its
    cube plus a small constant. A step then takes a third of the time to go. The constant, or
    rounding of the rise, ends the search long before `MOST_TURNS`.

    Returns
    -------
    met : ndarray of bool
        Whether |T| meets N.
    latest : ndarray
        Where it does: an advance at or behind the onset.
    """
    met, latest = rate * eta <= np.pi - rho, eta.copy()
    open_ = np.flatnonzero(~met)
    if not open_.size:
        return met, latest
    eta, rho, amplitude, rate = eta[open_], rho[open_], amplitude[open_], rate[open_]
    theta = rho
    for _ in range(MOST_TURNS):
        # One Newton step towards the zero of the rise, for lanes that have not met N and whose
        # ratio still rises. `theta` never falls, so the loop ends when no lane moves.
        advance = (theta - rho) / rate
        force, fall = sin_cos(eta - advance)
        friction, swing = sin_cos(theta)
        meets = force <= amplitude * friction
        rise = rate * swing * force + friction * fall
        descent = (rate - 1 / rate) * friction * force  # minus the derivative of rise by theta
        moving = ~meets & (rise > 0) & (descent > 0)
        step = np.divide(rise, descent, out=np.zeros_like(rise), where=moving)
        before, theta = theta, np.minimum(theta + step, np.pi)
        if (theta == before).all():
            met[open_], latest[open_] = meets, advance
            return met, latest
    raise _lost(theta)


def _lost(lanes: Array | Integers) -> ConvergenceError:
    return ConvergenceError(f"{lanes.size} impacts: no onset of slip after {MOST_TURNS} turns")


def in_compression(x: Array, zeta2: Array, rate: Array) -> Array:
    """First eta > 0 with x/(zeta^2 rate) sin(rate eta) = sin(eta), for rate < 1.

    T must exceed N at maximum compression. With u = eta^2, (T - N)/eta is increasing and concave in
    u: its tangents lie above it. So Newton's iterates that start left of the root rise to it. The
    first one starts from u = 0. The first iterate that does not rise has reached the rounding of u,
    or of T - N where T and N are close all along.

    Parameters
    ----------
    x, zeta2, rate : ndarray
        Incidence up to zeta^2, stiffness ratio, omega/Omega below 1.

    Returns
    -------
    ndarray
        Angle at the onset, 0 for x = zeta^2.

    Examples
    --------
    >>> eta = in_compression(np.array([1.9]), np.array([2.0]), np.array([0.5]))
    >>> bool(abs(1.9 * np.sin(eta / 2) - np.sin(eta))[0] < 1e-14)
    True
    """
    amplitude, ratio = x / (zeta2 * rate), x / zeta2
    # The zero of the tangent at u = 0.
    u = np.minimum(6 * (1 - ratio) / (1 - ratio * rate * rate), HALF_PI**2)
    for _ in range(MOST_TURNS):
        # One Newton step in u, which never falls: the loop ends when no u rises any more.
        eta = np.sqrt(u)
        (friction, swing), (force, fall) = sin_cos(rate * eta), sin_cos(eta)
        lead = amplitude * friction - force  # T - N
        # 2 eta^3 times the derivative of (T - N)/eta by u.
        slope_eta3 = amplitude * (rate * eta * swing - friction) - eta * fall + force
        step = np.divide(-2 * u * lead, slope_eta3, out=np.zeros_like(u), where=slope_eta3 > 0)
        before, u = u, np.clip(u + step, u, HALF_PI**2)
        if (u == before).all():
            return eta
    raise _lost(u)
