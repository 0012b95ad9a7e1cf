"""Two Kelvin-Voigt elements in closed form: the normal motion, and the tangential one in stick.

Units 1/Omega, |v2(0)| and m2 Omega |v2(0)| for time, velocity and force; a tangential quantity has
the factor mu. The damping ratio is xi, and both elements have the relaxation time tau = 2 xi.

**Normal.** The compression u obeys u'' + tau u' + u = 0, u(0) = 0, u'(0) = 1. The force is
N = u + tau u' = -u'', so u' falls by the normal impulse. Contact ends where N = 0 (Schwager and
Poeschel 2007, DOI 10.1007/s10035-007-0065-z). With xi = cos(delta), a frequency sin(delta) and the
time to go a,

    N = e exp(xi a) sin(omega a)/omega,   omega = sin(delta),
    u' the same at the phase omega a - delta,   -N' at omega a + delta:

each derivative by the time shifts the phase by delta and turns the sign. So

    duration = 2 delta/sin(delta),   e = exp(-2 delta cot(delta)),

and u' = 0 at half of the duration. For xi > 1, delta is imaginary: put sinh for sin and coth for
cot. For xi = 1, e = exp(-2).

**Tangential, in stick.** The velocity w and the force T obey

    w' = -beta T,   T' = w/zeta^2 - tau (beta/zeta^2) T,

an oscillator of the stiffness b = beta/zeta^2 and the decay gamma = xi b. It is overdamped for
b xi^2 > 1.

Both elements may be underdamped or overdamped. Impacts are solved together only where this is the
same for all, so that each formula is one expression.
"""

from typing import NamedTuple

import numpy as np

from planarimpact.ground.angles import sin_cos
from planarimpact.ground.arrays import Array, Booleans, Integers

# A frequency of 0 counts as this one: sin(omega t)/omega is then t to all digits.
LEAST_FREQUENCY = 1e-150
# For every e, three steps of Newton's method leave an error of delta^2 below 3e-12 (1 + |delta^2|).
# The fourth reaches rounding; the fifth is a reserve.
TURNS = 5
# Below this delta^2 the derivative of delta cot(delta) is taken from its series.
SERIES = 1e-4
# The impulse of a time shorter than this is taken from a series, of which TERMS suffice.
SHORT, TERMS = 1.0, 17


def phase_angle(restitution: Array) -> tuple[Array, Booleans]:
    """Angle delta with e = exp(-2 delta cot(delta)), or delta/i, and whether it is delta.

    It is delta, 0 to pi/2, where the normal element is underdamped, e > exp(-2). The function
    delta cot(delta) = 1 - delta^2/3 - delta^4/45 - ... of delta^2 falls, and has a negative second
    derivative, for all delta^2 below pi^2. Newton's method in delta^2 therefore converges from
    every start, and delta^2 has all its digits through xi = 1, where it changes its sign.

    Examples
    --------
    >>> angle, under = phase_angle(np.array([0.5, 0.01]))
    >>> under.tolist()
    [True, False]
    >>> e = np.exp(-2 * np.array([angle[0] / np.tan(angle[0]), angle[1] / np.tanh(angle[1])]))
    >>> [round(float(value), 14) for value in e]
    [0.5, 0.01]
    """
    goal = -np.log(restitution) / 2
    under = goal < 1
    short = 1 - goal
    # The start: the first terms of the inverse series, and a form that also fits strong damping.
    delta2 = np.where(under, short * (3 - 0.6 * short), short * (goal + 2))
    for _ in range(TURNS):
        angle = np.sqrt(np.abs(delta2))
        angle = np.maximum(angle, LEAST_FREQUENCY)
        tangent = np.where(under, np.tan(np.where(under, angle, 1.0)), np.tanh(angle))
        value = angle / tangent
        # The derivative by delta^2: (value - delta^2/sin^2)/(2 delta^2), where delta^2/sin^2 is
        # value^2 + delta^2; sinh for sin where overdamped.
        with np.errstate(divide="ignore", invalid="ignore"):
            slope = (value - value * value - delta2) / (2 * delta2)
        slope = np.where(np.abs(delta2) < SERIES, -1 / 3 - 2 * delta2 / 45, slope)
        delta2 = delta2 - (value - goal) / slope
        delta2 = np.where(under, np.clip(delta2, 0.0, (np.pi / 2) ** 2), np.minimum(delta2, 0.0))
    return np.maximum(np.sqrt(np.abs(delta2)), LEAST_FREQUENCY), under


class Elements(NamedTuple):
    """Both elements of impacts that are alike: arrays of shape (n,), but for the two flags.

    Attributes
    ----------
    normal_under, tangential_under : bool
        Whether the element is underdamped, in all of these impacts.
    e, beta, zeta2 : ndarray
        Groups of the impacts.
    xi : ndarray
        Damping ratio of the normal element; tau is 2 xi.
    angle, frequency : ndarray
        delta and sin(delta) of the normal element, or those of delta/i and sinh.
    duration : ndarray
        Time from contact to separation.
    b, gamma, rate : ndarray
        The tangential element: stiffness beta/zeta^2, decay, and frequency of stick.
    """

    normal_under: bool
    tangential_under: bool
    e: Array
    beta: Array
    zeta2: Array
    xi: Array
    angle: Array
    frequency: Array
    duration: Array
    b: Array
    gamma: Array
    rate: Array

    def take(self, which: Integers | Booleans) -> "Elements":
        """The impacts with these indices."""
        return Elements(self[0], self[1], *(field[which] for field in self[2:]))

    def motion(self, ahead: Array) -> tuple[Array, Array]:
        """Normal force N and rate of compression v = u' at a time `ahead` of separation."""
        if self.normal_under:
            sine, cosine = sin_cos(self.frequency * ahead)
            share = self.e * np.exp(self.xi * ahead)
            force = share * sine / self.frequency
            return force, self.xi * force - share * cosine
        # sinh(omega a) and sinh(omega a - delta), without large numbers that cancel.
        growth = self.frequency * ahead
        share = self.e * np.exp((self.xi + self.frequency) * ahead) / (2 * self.frequency)
        velocity = -np.exp(-self.angle) * share * np.expm1(2 * (self.angle - growth))
        return -share * np.expm1(-2 * growth), velocity

    def impulse_ahead(self, ahead: Array, velocity: Array) -> Array:
        """Normal impulse still to come, v + e: from the series of N where the sum would cancel."""
        impulse = velocity + self.e
        tau = 2 * self.xi
        short = np.flatnonzero(ahead * np.maximum(tau, 1.0) < SHORT)
        if short.size:
            time, tau = ahead[short], tau[short]
            # With the time a to go, N'' = tau N' - N. A term of N is e n a^k/k!; the impulse has
            # e n a^(k+1)/(k+1)!.
            before, now = np.zeros_like(time), np.ones_like(time)
            power, total = time, np.zeros_like(time)
            for order in range(2, TERMS + 2):
                power = power * time / order
                total += now * power
                before, now = now, tau * now - before
            impulse[short] = self.e[short] * total
        return impulse

    def crest_ahead(self) -> Array:
        """Time from the largest normal force to separation: the whole duration for xi >= 1/2.

        N' vanishes at the phase pi - delta.
        """
        if self.normal_under:
            return np.minimum((np.pi - self.angle) / self.frequency, self.duration)
        return self.duration

    def turn_ahead(self) -> Array:
        """Time from t_M to separation, where N + tau N' vanishes and then stays negative.

        It vanishes at the phase pi - 2 delta. For xi >= 1/sqrt(2) it is negative throughout.
        """
        if self.normal_under:
            return np.minimum(2 * np.arcsin(self.xi) / self.frequency, self.duration)
        return self.duration

    def waves(self, time: Array) -> tuple[Array, Array]:
        """exp(-gamma t) times cos(rate t), and times sin(rate t)/rate; cosh and sinh if over."""
        if self.tangential_under:
            sine, cosine = sin_cos(self.rate * time)
            share = np.exp(-self.gamma * time)
            return share * cosine, share * sine / self.rate
        share = np.exp(-self.b / (self.gamma + self.rate) * time)
        half = -0.5 * np.expm1(-2 * self.rate * time)
        return share * (1 - half), share * half / self.rate

    def stick(self, friction: Array, velocity: Array, time: Array) -> tuple[Array, Array]:
        """Friction T and velocity w, a time after they were `friction` and `velocity`."""
        even, odd = self.waves(time)
        later = friction * even + (velocity / self.zeta2 - self.gamma * friction) * odd
        return later, velocity * even + (self.gamma * velocity - self.beta * friction) * odd


def elements_of(normal_under: bool, tangential_under: bool, groups: tuple[Array, ...]) -> Elements:
    """Elements of impacts with the groups beta, zeta^2, e and the angle of `phase_angle`.

    Examples
    --------
    >>> e = np.array([0.5])
    >>> both = elements_of(True, True, (np.array([3.5]), np.array([1.21]), e, phase_angle(e)[0]))
    >>> [round(float(value[0]), 12) for value in both.motion(both.duration)]  # tau, 1
    [0.510551275297, 1.0]
    """
    beta, zeta2, e, angle = groups
    frequency = np.sin(angle) if normal_under else np.sinh(angle)
    xi = damping_ratio(e, angle, frequency)
    b = beta / zeta2
    gamma = xi * b
    rate = np.maximum(np.sqrt(np.abs(b - gamma * gamma)), LEAST_FREQUENCY)
    return Elements(
        normal_under,
        tangential_under,
        e,
        beta,
        zeta2,
        xi,
        angle,
        frequency,
        2 * angle / frequency,
        b,
        gamma,
        rate,
    )


def damping_ratio(e: Array, angle: Array, frequency: Array) -> Array:
    """cos(delta), from e = exp(-2 delta cot(delta)): so it has all its digits near e = 1 too."""
    return -np.log(e) / 2 * (frequency / angle)
