"""Two Kelvin-Voigt elements in closed form: the normal motion, and the tangential one in stick.

Units 1/Omega, |v2(0)| and m2 Omega |v2(0)| for time, velocity and force; a tangential quantity has
the factor mu. The damping ratio is xi, and both elements have the relaxation time tau = 2 xi.
Times count from separation, so the contact lasts from -`duration` to 0: both forces keep their
digits where they vanish.

**Normal.** The compression u obeys u'' + tau u' + u = 0 and starts with u = 0, u' = 1. The force is
N = u + tau u' = -u'', so the rate of compression v = u' falls by the normal impulse. Contact ends
where N = 0 (Schwager and Poeschel 2007, DOI 10.1007/s10035-007-0065-z). With xi = cos(delta) and
the frequency omega = sin(delta),

    N = -e exp(-xi t) sin(omega t)/omega,   v = -e exp(-xi t) sin(omega t + delta)/omega.

N' has the phase omega t - delta: each derivative shifts the phase by -delta and turns the sign. So

    duration = 2 delta/sin(delta),   e = exp(-2 delta cot(delta)),

and v = 0 at half of the duration. For xi > 1, delta is imaginary: put sinh for sin and coth for
cot. For xi = 1, e = exp(-2).

**Tangential, in stick.** The velocity w and the force T obey

    w' = -beta T,   T' = w/zeta^2 - tau (beta/zeta^2) T,

an oscillator of the stiffness b = beta/zeta^2 and the decay gamma = xi b. It is overdamped for
b xi^2 > 1.

Both elements may be underdamped or overdamped. Impacts are solved together only where this is the
same for all, so that each formula is one expression.
"""

from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy as np

from planarimpact.common import roots
from planarimpact.common.angles import HALF_PI, sin_cos
from planarimpact.common.arrays import Array, Integers

# Restitution of a critically damped element, xi = 1.
CRITICAL = np.exp(-2)
# A frequency of 0 counts as this one: sin(omega t)/omega is then t to all digits.
LEAST_FREQUENCY = 1e-150


def phase_angle(restitution: Array, under: bool) -> Array:
    """Angle delta with e = exp(-2 delta cot(delta)), or delta/i where not `under`damped.

    delta is 0 to pi/2, and underdamped means e > exp(-2). The search is for |delta|^2: then
    delta cot(delta) = 1 - delta^2/3 - ... has a slope that does not vanish.

    Examples
    --------
    >>> angle = float(phase_angle(np.array([0.5]), True)[0])
    >>> round(float(np.exp(-2 * angle / np.tan(angle))), 14)
    0.5
    """
    goal = -np.log(restitution) / 2
    tangent, sign = (np.tan, 1.0) if under else (np.tanh, -1.0)

    def surplus(which: Any, square: Array) -> tuple[Array, Array]:
        angle = np.maximum(np.sqrt(square), LEAST_FREQUENCY)
        value = angle / tangent(angle)
        slope = sign * (value - value * value) / (2 * angle * angle) - 0.5
        return sign * (value - goal[which]), slope

    largest = np.full_like(goal, HALF_PI**2) if under else goal * goal
    # Within a fifth, and exact next to 0, where rounding hides the slope.
    start = np.abs(1 - goal) * (goal + 2)
    square = roots.crossing(surplus, np.zeros_like(goal), largest, start=start, unguarded=4)
    return np.maximum(np.sqrt(square), LEAST_FREQUENCY)


class Elements(NamedTuple):
    """Both elements of impacts that are alike: arrays of shape (n,), but for the two flags.

    Attributes
    ----------
    normal_under, tangential_under : bool
        Whether the element is underdamped, in all of these impacts.
    e, beta, zeta2 : ndarray
        Groups of the impacts.
    angle, frequency, xi : ndarray
        delta, sin(delta) and cos(delta) of the normal element; where it is overdamped delta/i,
        sinh and cosh. tau is 2 xi.
    b, gamma, rate : ndarray
        The tangential element: stiffness beta/zeta^2, decay, and frequency of stick.
    """

    normal_under: bool
    tangential_under: bool
    e: Array
    beta: Array
    zeta2: Array
    angle: Array
    frequency: Array
    xi: Array
    b: Array
    gamma: Array
    rate: Array

    def take(self, which: Integers) -> "Elements":
        """The impacts with these indices."""
        return Elements(self[0], self[1], *(field[which] for field in self[2:]))

    def contact(self) -> Array:
        """The time of contact, -`duration`."""
        return -2 * self.angle / self.frequency

    def shifted_zero(self, shifts: int) -> Array:
        """When the phase omega t - `shifts` delta is -pi, or at contact if not after it.

        With one shift N' vanishes, so the normal force is largest, and with two N + tau N'. After
        this time they are negative.
        """
        if not self.normal_under:
            return self.contact()
        return np.maximum((shifts * self.angle - np.pi) / self.frequency, self.contact())

    def motion(self, time: Array) -> tuple[Array, Array]:
        """Normal force N and rate of compression v."""
        share = self.e * np.exp(-self.xi * time)
        if self.normal_under:
            sine, cosine = sin_cos(self.frequency * time)
            force = -share * sine / self.frequency
            return force, self.xi * force - share * cosine
        share, phase = share / self.frequency, self.frequency * time
        return -share * np.sinh(phase), -share * np.sinh(phase + self.angle)

    def stick(self, friction: Array, velocity: Array, span: Array) -> tuple[Array, Array]:
        """Friction T and velocity w, a span of time after they were `friction` and `velocity`."""
        # exp(-gamma span) times the cosine of rate span, and times its sine over the rate.
        if self.tangential_under:
            sine, cosine = sin_cos(self.rate * span)
            share = np.exp(-self.gamma * span)
            even, odd = share * cosine, share * sine / self.rate
        else:
            share = np.exp(-self.b / (self.gamma + self.rate) * span)
            half = -0.5 * np.expm1(-2 * self.rate * span)
            even, odd = share * (1 - half), share * half / self.rate
        later = friction * even + (velocity / self.zeta2 - self.gamma * friction) * odd
        return later, velocity * even + (self.gamma * velocity - self.beta * friction) * odd

    def first_zero(self, value: Array, slope: Array) -> Array:
        """Span from a `value` > 0 to the first zero, infinite where there is none.

        Of T in stick, or any of its derivatives, which all obey one equation.
        """
        growth = slope + self.gamma * value
        if self.tangential_under:
            return np.arctan2(value * self.rate, -growth) / self.rate
        with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
            share = value * self.rate / -growth
            return np.where((growth < 0) & (share < 1), np.arctanh(share) / self.rate, np.inf)

    def half_wave(self) -> Array:
        """Span from each zero of T to the next."""
        return np.pi / self.rate if self.tangential_under else np.full_like(self.rate, np.inf)


def alike(beta: Array, zeta2: Array, e: Array) -> Iterator[tuple[Integers, Elements]]:
    """Indices of impacts of which both elements are alike, with these elements.

    Examples
    --------
    >>> groups = np.array([3.5]), np.array([1.21]), np.array([0.5])
    >>> [(which, both)] = alike(*groups)
    >>> [round(float(value[0]), 12) for value in both.motion(both.contact())]  # tau, 1
    [0.510551275297, 1.0]
    """
    for normal_under in (True, False):
        part = np.flatnonzero((e > CRITICAL) == normal_under)
        if not part.size:
            continue
        angle = phase_angle(e[part], normal_under)
        frequency = np.sin(angle) if normal_under else np.sinh(angle)
        # cos(delta), from the restitution: so it has all its digits near e = 1 too.
        xi = -np.log(e[part]) / 2 * (frequency / angle)
        b = beta[part] / zeta2[part]
        gamma = xi * b
        square = b - gamma * gamma
        rate = np.maximum(np.sqrt(np.abs(square)), LEAST_FREQUENCY)
        groups = e[part], beta[part], zeta2[part], angle, frequency, xi, b, gamma, rate
        for tangential_under in (True, False):
            which = np.flatnonzero((square > 0) == tangential_under)
            if which.size:
                fields = (field[which] for field in groups)
                yield part[which], Elements(normal_under, tangential_under, *fields)
