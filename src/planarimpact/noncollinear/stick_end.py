"""Where stick ends: the first zero of several functions, each a sum of the two modes.

The finder of `common.roots` needs a bracket with a single zero, and here none is known before the
steps below have come so close to the first zero that nothing is left to refine. So the search
advances from the left only, in steps that cannot pass a zero. Two lower bounds of a function f give
such steps, and the longer one is taken.

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
from planarimpact.noncollinear.phases import Groups, Mode, Slip, State, Stick, rotated, taken

# What ends a phase of stick; each is the row of a function in `Functions`. A half of the contact
# ends at maximum compression or at separation. In unloading the force may begin to rise again, and
# if it does, reach its earlier peak.
FORWARD_SLIP, BACKWARD_SLIP, EXTREMUM_OF_FRICTION, END_OF_HALF, FORCE_RISES = range(5)
NOT_FOUND = -1  # the search gave up
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
    """The functions of n contacts, as the constant plus the modes p and q.

    Arrays of shape (5, n); the rates of the modes have shape (n,). `noise` is the rounding error of
    a function, `square` and `load` are rate^2 and load of its second lower bound.
    """

    constant: Array
    p: Mode
    q: Mode
    noise: Array
    square: Array
    load: Array


def functions_of(
    stick: Stick, state: State, groups: Groups, peak: Array, unloading: Booleans, rising: Booleans
) -> Functions:
    """The functions whose first zero ends a phase of stick."""
    beta, coupling, zeta2, mu, time_scale = groups
    bound, pull = stick.bounds(), np.abs(coupling)
    # The sign of V, or of V' where V = 0.
    moves = np.where(
        state.velocity != 0, state.velocity, coupling * state.normal - beta * state.friction
    )
    tangential = time_scale**2 * beta / zeta2
    forward, backward = (Slip.start(state, groups, side).slope for side in (1.0, -1.0))
    normal_load = pull * bound.friction  # of N'' + N
    approach_load = pull * time_scale / zeta2 * bound.velocity  # of y'' + y
    # Each function is a constant, and N, F, y and V with factors.
    table = np.zeros((7, 5, mu.size))
    constant, normal, friction, approach, velocity, square, load = table
    # mu N - F: slip begins
    normal[FORWARD_SLIP], friction[FORWARD_SLIP] = mu, -1.0
    square[FORWARD_SLIP] = tangential + mu * coupling
    load[FORWARD_SLIP] = np.maximum(forward, 0.0) / zeta2 * bound.normal
    # mu N + F: slip begins
    normal[BACKWARD_SLIP], friction[BACKWARD_SLIP] = mu, 1.0
    square[BACKWARD_SLIP] = tangential - mu * coupling
    load[BACKWARD_SLIP] = np.maximum(backward, 0.0) / zeta2 * bound.normal
    # |V|: an extremum of F
    velocity[EXTREMUM_OF_FRICTION] = np.where(moves < 0, -1.0, 1.0)
    square[EXTREMUM_OF_FRICTION] = tangential
    load[EXTREMUM_OF_FRICTION] = pull * time_scale * bound.approach
    # y in compression, N in unloading
    normal[END_OF_HALF], approach[END_OF_HALF] = unloading, ~unloading
    square[END_OF_HALF] = 1.0
    load[END_OF_HALF] = np.where(unloading, normal_load, approach_load)
    # In unloading -y (the force begins to rise) or, where it is `rising`, peak - N (it reaches its
    # earlier peak); in compression 1.
    constant[FORCE_RISES] = np.where(rising, peak, ~unloading)
    normal[FORCE_RISES], approach[FORCE_RISES] = -1.0 * rising, -1.0 * (unloading & ~rising)
    square[FORCE_RISES] = 1.0
    load[FORCE_RISES] = np.where(rising, normal_load, np.where(unloading, approach_load, 0.0))
    # In the modes, and in their derivatives over the rate.
    cosine, sine, p, q = stick.cosine, stick.sine, stick.p, stick.q
    in_p, in_q = rotated(normal, friction / stick.scale, cosine, sine)
    in_p_rate, in_q_rate = rotated(approach, stick.zeta * velocity, cosine, sine)
    in_p_rate, in_q_rate = in_p_rate * p.rate, in_q_rate * q.rate
    p_size, q_size = stick.sizes
    size = (np.abs(in_p) + np.abs(in_p_rate)) * p_size + (np.abs(in_q) + np.abs(in_q_rate)) * q_size
    return Functions(
        constant,
        Mode(p.rate, in_p * p.cosine + in_p_rate * p.sine, in_p * p.sine - in_p_rate * p.cosine),
        Mode(q.rate, in_q * q.cosine + in_q_rate * q.sine, in_q * q.sine - in_q_rate * q.cosine),
        NOISE * size + LEAST_NOISE,
        square,
        load,
    )


def first_zero(functions: Functions) -> tuple[Array, Integers]:
    """Time (n,) of the first zero of each contact's functions, and which one has it (n,)."""
    count = functions.p.rate.size
    zero_time, zero_index = np.zeros(count), np.full(count, NOT_FOUND)
    # The contacts in the arrays: their number, their time so far, and which are still searched.
    contact, time, searched = np.arange(count), np.zeros(count), np.ones(count, bool)
    curvature = _curvature(functions)
    for _ in range(MOST_STEPS):
        # Every contact advances by a step without a zero.
        value, slope = _values(functions, time)
        step, nearest = _free_step(functions, curvature, value, slope)
        before, time = time, time + step
        # The search also ends where rounding of a large time swallows the step.
        angle = step * np.maximum(functions.p.rate, functions.q.rate)
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
                functions = taken(functions, np.flatnonzero(searched))
                searched = np.ones(number, bool)
    return zero_time, zero_index


def _curvature(functions: Functions) -> Array:
    """Bound of the second derivative of each function."""
    p_size, q_size = (
        np.hypot(mode.cosine, mode.sine) * mode.rate**2 for mode in (functions.p, functions.q)
    )
    return np.maximum(p_size + q_size, LEAST_NOISE**2)


def _values(functions: Functions, time: Array) -> tuple[Array, Array]:
    """The functions and their slopes."""
    p, p_slope = functions.p.turned(*sin_cos(functions.p.rate * time))
    q, q_slope = functions.q.turned(*sin_cos(functions.q.rate * time))
    return functions.constant + p + q, p_slope + q_slope


def _free_step(
    functions: Functions, curvature: Array, value: Array, slope: Array
) -> tuple[Array, Integers]:
    """Longest step without a zero, and the function that allows no longer one."""
    value = np.maximum(value + functions.noise, 0.0)
    by_curvature = (slope + np.sqrt(slope * slope + 2 * curvature * value)) / curvature
    by_oscillation = _oscillation_step(value, slope, functions.square, functions.load)
    steps = np.maximum(by_curvature, by_oscillation)
    return steps.min(axis=0), steps.argmin(axis=0)


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
