"""A jump over many phases of a lumped contact, in a time that does not depend on their number.

Where the tangential oscillator is fast, nu = e omega/Omega large, an impact in restitution sticks
and slips once in every half-wave. Stick that follows slip is known by its angle `eta` alone
(T = N and T' = N'), so a half-wave is a map of `eta`. With phases of the tangential oscillator,

    a    from its crest to the start of stick,   tan(a) = cot(eta)/nu,
    phi  from the end of stick to the next crest,
    psi  of slip,

a half-wave advances the phase nu eta by pi + delta with delta = psi - phi - a, of the order of
(cot(eta)/nu)^(3/2). The half-waves between two angles are counted without following them:
with m the middle of a half-wave and k their count,

    nu (eta_0 - eta_k) = k pi + sum of delta(m),

and the midpoint rule of Euler and Maclaurin turns the sum into the integral of delta dk,
dk = nu d(eta)/(pi + delta), and a term at the ends, of the slope of delta. The next term is below
rounding of nu down to `last_phase`; from there on the phases are followed.
"""

import numpy as np

from planarimpact.common.arrays import Array, Booleans, Numbers

# The least number of phases that a skip must save. It takes the time of some fifty half-waves.
LEAST_GAIN = 200.0

# Panels of the integral over log(cot(eta)), whose integrand is analytic to a distance of pi/2.
PANEL = 2.0
NODES, WEIGHTS = np.polynomial.legendre.leggauss(16)
# Half-waves with a smaller cot(eta)/nu add less to the sum than rounding of nu.
LEAST_DECLINE = 1e-20


def last_phase(rate: Numbers) -> Array:
    """Phase nu eta at which a skip ends.

    At this phase the count of half-waves has the error 6e-13 (1000/phase)^4. It must not exceed
    the rounding of nu by much.
    """
    return np.clip(1000 * (6e3 / rate) ** 0.25, 100.0, 1000.0)


def worth_skipping(eta: Array, rate: Numbers) -> Booleans:
    """Whether stick that starts at `eta`, after a slip, is far from separation."""
    return rate * eta > last_phase(rate) + LEAST_GAIN


def skip(eta: Array, rate: Array) -> tuple[Array, Array]:
    """Angle where a stick about `last_phase` before separation starts, and half-waves until then.

    `eta` is where stick starts after slip in restitution; `worth_skipping`, and some half-waves
    below pi/2, where delta is not smooth. Each half-wave turns the sign of T.
    """
    end = last_phase(rate) / rate
    count = half_waves(eta, end, rate)
    whole = np.floor(count)
    # Two steps of Newton's method: the count is almost linear, so its error is then below rounding.
    goal = end
    for _ in range(2):
        count_error = count - whole - half_waves(goal, end, rate)
        goal = goal + count_error * (np.pi + excess_phase(goal, rate)) / rate
    return goal, whole


def half_waves(start: Array, end: Numbers, rate: Array) -> Array:
    """How many half-waves lie between two angles, start >= end; a real number."""
    low = np.log(np.maximum(1 / np.tan(start), LEAST_DECLINE * rate))
    high = np.log(1 / np.tan(end))
    panels = int(np.max((high - low) / PANEL)) + 1
    half = (high - low) / (2 * panels)
    total = np.zeros_like(half)
    for panel in range(panels):
        cot = np.exp((low + (2 * panel + 1) * half)[:, None] + half[:, None] * NODES)
        delta = excess_phase(np.arctan(1 / cot), rate[:, None])
        total += half * ((delta / (np.pi + delta) * cot / (1 + cot * cot)) @ WEIGHTS)
    slopes = _excess_slope(start, rate) - _excess_slope(end, rate)
    return rate * (start - end - total) / np.pi + slopes / 24


def _excess_slope(eta: Numbers, rate: Array) -> Array:
    """Derivative of delta to the phase, over a half-wave."""
    step = np.pi / rate
    return (excess_phase(eta + step, rate) - excess_phase(eta - step, rate)) / (2 * np.pi)


def excess_phase(middle: Numbers, rate: Numbers) -> Array:
    """delta of the half-wave from the start of stick to the next, by the angle in its middle.

    phi and psi depend on each other through delta. Each turn of the loop computes them anew from
    the last delta. Where a skip goes, a turn reduces the error to a twelfth or less: eight turns
    leave 4e-15 at the last half-waves, and less before. All sums have positive terms only.
    """
    ratio = 1 / (rate * np.tan(middle))
    phi = psi = np.sqrt(2 * np.pi * ratio)
    delta = np.zeros_like(ratio)
    for _ in range(8):
        half = (np.pi + delta) / (2 * rate)
        eta = middle + half
        force, fall = np.sin(eta), np.cos(eta) / rate
        a = np.arctan2(fall, force)
        amplitude = np.hypot(force, fall)
        # amplitude cos(phi) = N at the onset of slip, where N has fallen for the time of stick.
        stick = (np.pi - a - phi) / (2 * rate)
        short = fall * fall / (amplitude + force) + 2 * np.cos(eta - stick) * np.sin(stick)
        phi = 2 * np.arcsin(np.sqrt(short / (2 * amplitude)))
        # Slip ends when K (cos(eta) - cos(onset)) is the slip velocity at the onset.
        onset = middle - half + psi / rate
        slip = amplitude * np.sin(phi) + np.cos(onset) / rate
        slip /= (1 - 1 / rate) * (1 + 1 / rate) * 2 * rate
        psi = 2 * rate * np.arcsin(slip / np.sin(onset - psi / (2 * rate)))
        delta = psi - phi - a
    return delta
