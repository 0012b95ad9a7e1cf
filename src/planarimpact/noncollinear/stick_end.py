"""Where stick ends: the first zero of several functions, each a sum of the two modes.

The search advances from the left only, in steps that cannot pass a zero. Two lower bounds of a
function f give such steps, and the longer one is taken.

- With |f''| <= M the step is the positive root h of f + f' h - M h^2/2. M is `curvature`.
- In stick every function obeys f'' + rate^2 f >= -load. So f lies above the solution of
  f'' + rate^2 f = -load as long as rate h < pi. The step h goes to the zero of that solution; half
  its angle follows from a tangent. This step is long where f is small throughout, as mu N - F is
  where N and F fall together. For that function, the onset of slip in the direction g, rate^2 is
  time_scale^2 beta/zeta^2 + g mu C, and f'' + rate^2 f = k N, where -k zeta^2 is the slope of
  `phases.Slip`.

A function counts as negative only if it is below zero by more than a rounding error, `NOISE` of its
size. The search then goes to the zero itself. So it passes the double zero that f has where slip
has just ended (there k > 0, and load = 0) in one step instead of many small ones.

Symbols as in `phases`.
"""

from typing import NamedTuple

import numpy as np

from planarimpact.common.angles import sin_cos
from planarimpact.common.arrays import Array, Booleans, Integers
from planarimpact.noncollinear.phases import Groups, Slip, State, Stick, rotated

NOISE = 1e-15
# Added to the noise, smaller than any force that matters: so a function that is 0 throughout has no
# zero.
LEAST_NOISE = 1e-50
# The search converges quadratically. It ends after a step with less than this angle [rad] of the
# faster mode.
LAST_ANGLE = 1e-9
MOST_STEPS = 5_000
# Contacts that are done leave the arrays when less than this share of them is still searched.
LEAST_SEARCHED = 0.7


class Functions(NamedTuple):
    """Functions constant + p_cos cos(rate_p t) + p_sin sin(rate_p t) + ... of n contacts.

    Arrays of shape (5, n); the rates of the modes have shape (n,). `noise` is the rounding error of
    a function, `square` and `load` are rate^2 and load of its second lower bound.
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

    def take(self, chosen: Booleans) -> "Functions":
        """These functions for the chosen contacts."""
        return Functions._make(field[..., chosen] for field in self)


def functions_of(
    stick: Stick, state: State, groups: Groups, peak: Array, unloading: Booleans, rising: Booleans
) -> Functions:
    """The five functions whose first zero ends a phase of stick.

    mu N - F and mu N + F (slip begins); |V| (an extremum of F); y in compression, N in unloading
    (maximum compression, separation); in unloading -y (the force begins to rise again) or, where it
    is `rising`, peak - N (the force reaches its earlier peak).
    """
    beta, coupling, _, mu, _ = groups
    cosine, sine, scale, zeta = stick.cosine, stick.sine, stick.scale, stick.zeta
    loading, falls = ~unloading, unloading & ~rising
    # The sign of V, or of V' where V = 0.
    moves = np.where(
        state.velocity != 0, state.velocity, coupling * state.normal - beta * state.friction
    )
    signed_zeta = np.where(moves < 0, -zeta, zeta)
    zero = np.zeros(state.normal.size)
    constant = np.stack([zero, zero, zero, zero, np.where(rising, peak, 1.0 * loading)])
    # Coefficients of N, F scale, and of their derivatives in each function.
    normal = np.stack([mu, mu, zero, 1.0 * unloading, -1.0 * rising])
    friction = np.stack([-1 / scale, 1 / scale, zero, zero, zero])
    normal_rate = np.stack([zero, zero, zero, 1.0 * loading, -1.0 * falls])
    friction_rate = np.stack([zero, zero, signed_zeta, zero, zero])
    # The same of the modes, and of their derivatives over the rate.
    in_p, in_q = rotated(normal, friction, cosine, sine)
    in_p_rate, in_q_rate = rotated(normal_rate, friction_rate, cosine, sine)
    in_p_rate, in_q_rate = in_p_rate * stick.rate_p, in_q_rate * stick.rate_q
    (p_cos, p_sin), (q_cos, q_sin) = stick.p, stick.q
    p_size, q_size = stick.sizes
    size = (np.abs(in_p) + np.abs(in_p_rate)) * p_size + (np.abs(in_q) + np.abs(in_q_rate)) * q_size
    return Functions(
        constant,
        in_p * p_cos + in_p_rate * p_sin,
        in_p * p_sin - in_p_rate * p_cos,
        in_q * q_cos + in_q_rate * q_sin,
        in_q * q_sin - in_q_rate * q_cos,
        NOISE * size + LEAST_NOISE,
        *_square_and_load(stick, state, groups, unloading, rising),
        stick.rate_p,
        stick.rate_q,
    )


def _square_and_load(
    stick: Stick, state: State, groups: Groups, unloading: Booleans, rising: Booleans
) -> tuple[Array, Array]:
    """rate^2 and load of each function, from bounds of |N|, |F|, |y| and |V|."""
    beta, coupling, zeta2, mu, time_scale = groups
    p_size, q_size = stick.sizes
    cosine, sine = stick.cosine, np.abs(stick.sine)
    normal = cosine * p_size + sine * q_size
    friction = (sine * p_size + cosine * q_size) / stick.scale
    approach = cosine * stick.rate_p * p_size + sine * stick.rate_q * q_size
    velocity = stick.zeta * (sine * stick.rate_p * p_size + cosine * stick.rate_q * q_size)
    tangential, one = time_scale**2 * beta / zeta2, np.ones(mu.size)
    square = np.stack(
        [tangential + mu * coupling, tangential - mu * coupling, tangential, one, one]
    )
    slopes = [Slip.start(state, groups, side).slope for side in (1.0, -1.0)]
    normal_load = np.abs(coupling) * friction  # of N'' + N
    approach_load = np.abs(coupling) * time_scale / zeta2 * velocity  # of y'' + y
    load = np.stack(
        [
            np.maximum(slopes[0], 0.0) / zeta2 * normal,
            np.maximum(slopes[1], 0.0) / zeta2 * normal,
            np.abs(coupling) * time_scale * approach,
            np.where(unloading, normal_load, approach_load),
            np.where(rising, normal_load, np.where(unloading, approach_load, 0.0)),
        ]
    )
    return square, load


def first_zero(functions: Functions) -> tuple[Array, Integers]:
    """Time (n,) of the first zero of each contact's functions, and which one has it (n,).

    Its index is -1 where `MOST_STEPS` steps did not reach a zero.
    """
    count = functions.rate_p.size
    zero_time, zero_index = np.zeros(count), np.full(count, -1)
    # The contacts in the arrays: their number, their time so far, and which are still searched.
    contact, time, searched = np.arange(count), np.zeros(count), np.ones(count, bool)
    curvature = _curvature(functions)
    for _ in range(MOST_STEPS):
        # Every contact advances by a step without a zero.
        value, slope = _values(functions, time)
        step, nearest = _free_step(functions, curvature, value, slope)
        before, time = time, time + step
        # The search also ends where rounding of a large time swallows the step.
        angle = step * np.maximum(functions.rate_p, functions.rate_q)
        done = np.flatnonzero(((angle <= LAST_ANGLE) | (time == before)) & searched)
        if done.size:
            place = nearest[done], done
            to_zero = _to_zero(value[place], slope[place], curvature[place])
            zero_time[contact[done]] = np.maximum(before[done] + to_zero, 0.0)
            zero_index[contact[done]] = nearest[done]
            searched[done] = False
            number = np.count_nonzero(searched)
            if not number:
                break
            if number < LEAST_SEARCHED * searched.size:
                contact, time, curvature = contact[searched], time[searched], curvature[:, searched]
                functions = functions.take(searched)
                searched = np.ones(number, bool)
    return zero_time, zero_index


def _curvature(functions: Functions) -> Array:
    """Bound of the second derivative of each function."""
    p_size = np.hypot(functions.p_cos, functions.p_sin) * functions.rate_p**2
    q_size = np.hypot(functions.q_cos, functions.q_sin) * functions.rate_q**2
    return np.maximum(p_size + q_size, LEAST_NOISE**2)


def _values(functions: Functions, time: Array) -> tuple[Array, Array]:
    """The functions and their slopes."""
    sin_p, cos_p = sin_cos(functions.rate_p * time)
    sin_q, cos_q = sin_cos(functions.rate_q * time)
    value = functions.constant + functions.p_cos * cos_p + functions.p_sin * sin_p
    value += functions.q_cos * cos_q + functions.q_sin * sin_q
    slope = functions.rate_p * (functions.p_sin * cos_p - functions.p_cos * sin_p)
    slope += functions.rate_q * (functions.q_sin * cos_q - functions.q_cos * sin_q)
    return value, slope


def _free_step(
    functions: Functions, curvature: Array, value: Array, slope: Array
) -> tuple[Array, Integers]:
    """Longest step without a zero, and the function that allows no longer one."""
    value = np.maximum(value + functions.noise, 0.0)
    by_curvature = (slope + np.sqrt(slope * slope + 2 * curvature * value)) / curvature
    by_oscillation = _oscillation_step(value, slope, functions.square, functions.load)
    steps = np.maximum(by_curvature, by_oscillation)
    nearest = steps.argmin(axis=0)
    return np.take_along_axis(steps, nearest[None], axis=0)[0], nearest


def _to_zero(value: Array, slope: Array, curvature: Array) -> Array:
    """Last step, to the zero itself or, where two zeros are close, not beyond the first.

    With a step to the end of the noise instead, errors would add up over many phases.
    """
    divisor = np.sqrt(slope * slope + 2 * curvature * np.abs(value)) - slope
    return np.where(slope < 0, 2 * value / np.where(slope < 0, divisor, 1.0), 0.0)


def _oscillation_step(value: Array, slope: Array, square: Array, load: Array) -> Array:
    """Step without a zero by f'' + square f >= -load, from tan(half the angle)/rate."""
    restoring = square * value + 2 * load
    discriminant = slope * slope + restoring * value
    rises, no_zero = slope > 0, discriminant < 0
    root = np.sqrt(np.where(no_zero, 0.0, discriminant))
    no_zero |= rises & (restoring <= 0)
    divisor = np.where(rises, restoring, root - slope)
    half = np.where(rises, slope + root, value) / np.where(divisor > 0, divisor, 1.0)
    rate = np.sqrt(np.abs(square))
    tangent = rate * half
    oscillates = square > 0
    half_angle = np.arctan(tangent)
    if not oscillates.all():  # hyperbolic functions
        no_zero |= ~oscillates & (tangent >= 1)
        hyperbolic = np.arctanh(np.where(oscillates | no_zero, 0.0, tangent))
        half_angle = np.where(oscillates, half_angle, hyperbolic)
    divisor = np.where(rate > 0, rate, 1.0)
    step = np.where(tangent > 1e-6, 2 * half_angle / divisor, 2 * half)
    # The bound holds for half a period of a sinusoid and says nothing beyond.
    return np.where(no_zero, np.where(oscillates, np.pi / divisor, np.inf), step)
