"""Where stick ends: the first zero of several functions, each a sum of the two modes.

The search advances from the left only, in steps that cannot pass a zero. Two such steps are known,
and the longer one is taken.

- With |f''| <= M the step is the positive root h of f + f' h - M h^2/2.
- In stick every function obeys f'' + rate^2 f >= -load. So f lies above the solution of the
  equation as long as rate h < pi. The step goes to the zero of that solution, which is found by the
  tangent of half its angle. This step is long where f is small throughout, as mu N - F is where N
  and F fall together. For that function, the onset of slip in the direction g, rate^2 is
  b + g mu C, where b is that of the tangential element alone. The right-hand side is k N, where
  -k zeta^2 is the slope of `phases.Slip`.

A function counts as below zero only if it is so by more than a rounding error, `NOISE` of its size.
The search then takes the zero itself. So it leaves at once the double zero that f has where slip
has just ended (there k > 0, and no load), and does not come back to it in ever smaller steps.
"""

from typing import NamedTuple

import numpy as np

from planarimpact.ground.angles import sin_cos
from planarimpact.ground.arrays import Array, Booleans, Integers
from planarimpact.noncollinear.phases import Groups, Slip, State, Stick

NOISE = 1e-15
# Added to the noise, smaller than any force that matters: a function that is 0 throughout then has
# no zero.
NOTHING = 1e-50
# The search is quadratic: it is done after a step below this share of the faster mode's period.
LAST_STEP = 1e-9
STEPS = 5_000
# Contacts that are done leave the arrays when less than this share of them is not done.
KEEP = 0.7


class Functions(NamedTuple):
    """Functions constant + p_cos cos(rate_p t) + p_sin sin(rate_p t) + ...; arrays (5, n).

    Each with its noise, the square of its own rate, and its load.
    """

    constant: Array
    p_cos: Array
    p_sin: Array
    q_cos: Array
    q_sin: Array
    noise: Array
    square: Array
    load: Array
    rate_p: Array
    rate_q: Array

    def take(self, lanes: Booleans) -> "Functions":
        """These functions for some of the contacts."""
        return Functions._make(field[..., lanes] for field in self)


def functions(
    stick: Stick, state: State, groups: Groups, peak: Array, unloading: Booleans, rising: Booleans
) -> Functions:
    """The five whose first zero ends a phase of stick.

    mu N - F and mu N + F (slip begins); |V| (an extremum of F); y in compression, N in unloading
    (maximum compression, separation); in unloading -y (the force begins to rise again) or, where it
    is `rising`, what it lacks to the earlier peak.
    """
    beta, coupling, zeta2, mu, pace = groups
    cosine, sine, scale, zeta = stick.cosine, stick.sine, stick.scale, stick.zeta
    loading, falls = ~unloading, unloading & ~rising
    swing = np.where(
        state.velocity != 0, state.velocity, coupling * state.normal - beta * state.friction
    )
    ahead = np.where(swing < 0, -zeta, zeta)
    zero = np.zeros(state.normal.size)
    constant = np.stack([zero, zero, zero, zero, np.where(rising, peak, 1.0 * loading)])
    # Share of N, F scale, and of their rates in each.
    normal = np.stack([mu, mu, zero, 1.0 * unloading, -1.0 * rising])
    friction = np.stack([-1 / scale, 1 / scale, zero, zero, zero])
    normal_rate = np.stack([zero, zero, zero, 1.0 * loading, -1.0 * falls])
    friction_rate = np.stack([zero, zero, ahead, zero, zero])
    p_share, q_share = _modes(normal, friction, cosine, sine)
    p_rate, q_rate = _modes(normal_rate, friction_rate, cosine, sine)
    p_rate, q_rate = p_rate * stick.rate_p, q_rate * stick.rate_q
    (p_a, p_b), (q_a, q_b) = stick.p, stick.q
    p_size, q_size = stick.sizes
    noise = (np.abs(p_share) + np.abs(p_rate)) * p_size + (
        np.abs(q_share) + np.abs(q_rate)
    ) * q_size
    return Functions(
        constant,
        p_share * p_a + p_rate * p_b,
        p_share * p_b - p_rate * p_a,
        q_share * q_a + q_rate * q_b,
        q_share * q_b - q_rate * q_a,
        NOISE * noise + NOTHING,
        *_own_motion(stick, state, groups, unloading, rising),
        stick.rate_p,
        stick.rate_q,
    )


def _modes(normal: Array, friction: Array, cosine: Array, sine: Array) -> tuple[Array, Array]:
    """Shares of p and q, from those of N and F scale."""
    return normal * cosine - friction * sine, normal * sine + friction * cosine


def _own_motion(
    stick: Stick, state: State, groups: Groups, unloading: Booleans, rising: Booleans
) -> tuple[Array, Array]:
    """Square of each function's own rate, and its load."""
    beta, coupling, zeta2, mu, pace = groups
    p_size, q_size = stick.sizes
    across = np.abs(stick.sine)
    normal = stick.cosine * p_size + across * q_size
    friction = (across * p_size + stick.cosine * q_size) / stick.scale
    approach = stick.cosine * stick.rate_p * p_size + across * stick.rate_q * q_size
    velocity = stick.zeta * (across * stick.rate_p * p_size + stick.cosine * stick.rate_q * q_size)
    pull = np.abs(coupling)
    own, one = pace**2 * beta / zeta2, np.ones(mu.size)
    square = np.stack([own + mu * coupling, own - mu * coupling, own, one, one])
    slopes = [Slip.start(state, groups, side).slope for side in (1.0, -1.0)]
    turning = pull * pace / zeta2 * velocity  # of y'' + y
    load = np.stack(
        [
            np.maximum(slopes[0], 0.0) / zeta2 * normal,
            np.maximum(slopes[1], 0.0) / zeta2 * normal,
            pull * pace * approach,
            np.where(unloading, pull * friction, turning),
            np.where(rising, pull * friction, np.where(unloading, turning, 0.0)),
        ]
    )
    return square, load


def first_zero(which: Functions) -> tuple[Array, Integers]:
    """Time of the first zero of any of the functions, and which has it.

    Parameters
    ----------
    which : Functions

    Returns
    -------
    time : ndarray, shape (n,)
    index : ndarray of int, shape (n,)
        -1 where `STEPS` steps did not reach it.
    """
    lanes = np.arange(which.rate_p.size)
    found, index = np.zeros(lanes.size), np.full(lanes.size, -1)
    time, open_ = np.zeros(lanes.size), np.ones(lanes.size, bool)
    bend = _bend(which)
    for _ in range(STEPS):
        # A turn moves every contact by a step without a zero. The steps shrink towards the first
        # zero, quadratically. A contact is done when its step is below LAST_STEP; one that takes
        # more than STEPS steps keeps the index -1.
        value, slope = _values(which, time)
        step, nearest = _free_step(which, bend, value, slope)
        before, time = time, time + step
        # The search also ends where rounding of a large time swallows the step.
        done = (step * np.maximum(which.rate_p, which.rate_q) <= LAST_STEP) | (time == before)
        last = np.flatnonzero(done & open_)
        if last.size:
            place = nearest[last], last
            back = _to_zero(value[place], slope[place], bend[place])
            found[lanes[last]] = np.maximum(before[last] + back, 0.0)
            index[lanes[last]] = nearest[last]
            open_[last] = False
            # Contacts that are done leave the arrays when they are many.
            left = np.count_nonzero(open_)
            if not left:
                return found, index
            if left < KEEP * open_.size:
                lanes, time, bend = lanes[open_], time[open_], bend[:, open_]
                which = which.take(open_)
                open_ = np.ones(left, bool)
    return found, index


def _bend(which: Functions) -> Array:
    """Bound of the second derivative of each function."""
    p_size = np.hypot(which.p_cos, which.p_sin) * which.rate_p**2
    q_size = np.hypot(which.q_cos, which.q_sin) * which.rate_q**2
    return np.maximum(p_size + q_size, NOTHING**2)


def _values(which: Functions, time: Array) -> tuple[Array, Array]:
    """The functions and their slopes."""
    sin_p, cos_p = sin_cos(which.rate_p * time)
    sin_q, cos_q = sin_cos(which.rate_q * time)
    value = which.constant + which.p_cos * cos_p + which.p_sin * sin_p
    value += which.q_cos * cos_q + which.q_sin * sin_q
    slope = which.rate_p * (which.p_sin * cos_p - which.p_cos * sin_p)
    slope += which.rate_q * (which.q_sin * cos_q - which.q_cos * sin_q)
    return value, slope


def _free_step(which: Functions, bend: Array, value: Array, slope: Array) -> tuple[Array, Integers]:
    """Longest step without a zero, and the function that has the next one."""
    value = np.maximum(value + which.noise, 0.0)
    steps = (slope + np.sqrt(slope * slope + 2 * bend * value)) / bend
    own = _free_step_by_motion(value, slope, which.square, which.load)
    steps = np.maximum(steps, own)
    nearest = steps.argmin(axis=0)
    return np.take_along_axis(steps, nearest[None], axis=0)[0], nearest


def _to_zero(value: Array, slope: Array, bend: Array) -> Array:
    """Last step, to the zero itself or, where two zeros are close, surely not beyond the first.

    To stop at the end of the noise instead would leave errors that add up over many phases.
    """
    over = np.sqrt(slope * slope + 2 * bend * np.abs(value)) - slope
    return np.where(slope < 0, 2 * value / np.where(slope < 0, over, 1.0), 0.0)


def _free_step_by_motion(value: Array, slope: Array, square: Array, load: Array) -> Array:
    """The same from f'' + square f >= -load, by the tangent of half the angle over the rate."""
    bend = square * value + 2 * load
    root = slope * slope + bend * value
    rises, never = slope > 0, root < 0
    root = np.sqrt(np.where(never, 0.0, root))
    never |= rises & (bend <= 0)
    over = np.where(rises, bend, root - slope)
    half = np.where(rises, slope + root, value) / np.where(over > 0, over, 1.0)
    rate = np.sqrt(np.abs(square))
    angle = rate * half
    swings = square > 0
    step = np.arctan(angle)
    if not swings.all():
        never |= ~swings & (angle >= 1)
        step = np.where(swings, step, np.arctanh(np.where(swings | never, 0.0, angle)))
    divisor = np.where(rate > 0, rate, 1.0)
    step = np.where(angle > 1e-6, 2 * step / divisor, 2 * half)
    # The bound holds for half a period of a sinusoid and says nothing beyond.
    return np.where(never, np.where(swings, np.pi / divisor, np.inf), step)
