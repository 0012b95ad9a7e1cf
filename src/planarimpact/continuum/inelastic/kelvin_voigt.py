"""Normal impact of Kelvin-Voigt spheres: the law of Kuwabara & Kono until the contact falls off.

By the method of dimensionality reduction the spring at radius r has the force density D - r^2, with
D = d + tau d'. Here d is the approach and tau the relaxation time. The spring touches where
r^2 < d while d grows. While d falls it touches where r^2 < D, as a contact does not pull. So

    F = (4/3) (d^(3/2) + (3/2) tau d^(1/2) d')  in compression (Kuwabara & Kono 1987),
    F = (4/3) D^(3/2)                           in restitution, until D = 0.

Everything depends on tau alone in the units of `normal_motion`, and so does the coefficient of
restitution, which falls from 1 at tau = 0 towards 0.

The time sigma, dt = 2 a dsigma with the radius of contact a, makes both halves polynomial:

    a' = v,                  v' = -(8/3) a^2 (a^2 + (3/2) tau v)  in compression, where d = a^2,
    a' = v - (4/3) tau a^3,  v' = -(8/3) a^4                      in restitution, where D = a^2.

So nothing is singular at contact and separation, and a method of fourth order keeps its order.
"""

from collections.abc import Callable
from copy import copy
from functools import cache, lru_cache

import numpy as np
from numpy.polynomial import Chebyshev

from planarimpact.continuum.inelastic.normal_motion import NormalMotion
from planarimpact.ground.arrays import Array, Integers

# Steps of either half. They make restitution right to 1e-10.
STEPS = 512
# Relaxation times that are tabulated: restitution 1 to 0.02.
SLOWEST = 8.0
# Degree of restitution as a polynomial in the root of tau: it is right to rounding.
DEGREE = 48
# Newton's method doubles the digits. It starts with two of them or more.
NEWTON = 8
# Halvings of a step, to the last bit of a number.
BISECTIONS = 52


class KelvinVoigt(NormalMotion):
    """Normal motions of viscous spheres.

    Parameters
    ----------
    restitution : ndarray, shape (m,)
        0.1 to 1, without 1.
    intervals : int
        n of `NormalMotion`.

    Examples
    --------
    >>> found = KelvinVoigt(np.array([0.8]), 8)
    >>> round(float(found.velocity[-1, 0]), 9)
    -0.8
    """

    viscous = True

    def __init__(self, restitution: Array, intervals: int) -> None:
        different, which = np.unique(restitution, return_inverse=True)
        tau, compression, after = _halves(tuple(different.tolist()))
        # Evenly spread over sigma, the radii are dense where the contact is largest, and the
        # instants where it is smallest.
        share = np.linspace(0.0, 1.0, intervals + 1)[:, None]
        radius, pace, begin = compression.at(share * compression.end)
        radius[0] = pace[-1] = 0.0
        back = radius[-2::-1]
        late = after.crossing(0, back)
        late[-1] = after.end
        _, fall, end = after.at(late)
        depth = np.concatenate([radius**2 + tau * pace, back**2])
        edge = np.concatenate([radius, back])
        self.tau, self.radius = tau[which], radius[:, which]
        self.width = (pace * compression.end / intervals)[:, which]
        self.time = np.concatenate([begin, compression.last[2] + end])[:, which]
        self.velocity = np.concatenate([pace, fall])[:, which]
        self._depth = depth[:, which]
        self.approach = self._depth - self.tau * self.velocity
        self.force = (2 * edge * (depth - edge * edge / 3))[:, which]
        at_largest = _largest_force(compression, tau)
        self.largest_force, self.velocity_at_largest_force = (a[which] for a in at_largest)
        self._halves = compression.taken(which), after.taken(which)

    def density(self, instant: int) -> Array:
        """As in `NormalMotion`: D - r^2."""
        return self._depth[instant] - self.radius[: self.edge(instant) + 1] ** 2

    def sliding_deflection(self, approach: Array, velocity: Array, count: int) -> Array:
        """As in `NormalMotion`: d - r^2, as q + tau q' = D - r^2."""
        return approach - self.radius[:count] ** 2

    def when(self, velocity: Array) -> tuple[Array, Array, Array]:
        """As in `NormalMotion`."""
        compression, after = self._halves
        radius, _, time = compression.at(compression.crossing(1, velocity[None]))[:, 0]
        edge, _, later = after.at(after.crossing(1, velocity[None]))[:, 0]
        growing = 4 / 3 * radius**3 + 2 * self.tau * radius * velocity
        early = velocity >= 0
        return (
            np.where(early, time, compression.last[2] + later),
            np.where(early, radius**2, edge**2 - self.tau * velocity),
            np.where(early, growing, 4 / 3 * edge**3),
        )


def restitution(relaxation_time: Array) -> Array:
    """Coefficient of restitution at a relaxation time.

    Examples
    --------
    >>> restitution(np.array([0.0, 0.5])).round(6)
    array([1.     , 0.46894])
    """
    _, after = _both(relaxation_time)
    return -after.last[1]


def relaxation_time(restitution: Array) -> Array:
    """Relaxation time of a coefficient of restitution, the inverse of `restitution`.

    Examples
    --------
    >>> relaxation_time(np.array([0.8])).round(6)
    array([0.123491])
    """
    table = _table()
    slope = table.deriv()
    root = np.sqrt((1 - restitution) / (2 * restitution))
    for _ in range(NEWTON):
        root = np.clip(root - (table(root) - restitution) / slope(root), 1e-12, np.sqrt(SLOWEST))
    return root * root


@cache
def _table() -> Chebyshev:
    """Restitution against the root of the relaxation time."""
    return Chebyshev.interpolate(lambda y: restitution(y * y), DEGREE, [0.0, np.sqrt(SLOWEST)])


@lru_cache(maxsize=16)
def _halves(restitution: tuple[float, ...]) -> tuple[Array, "_Half", "_Half"]:
    """Relaxation times, compression and restitution; remembered, as steps are doubled."""
    tau = relaxation_time(np.array(restitution))
    return tau, *_both(tau)


def _both(tau: Array) -> tuple["_Half", "_Half"]:
    none = np.zeros_like(tau)

    def compress(state: Array) -> Array:
        radius, v, _ = state
        square = radius * radius
        return np.stack([v, -(8 / 3) * square * (square + 1.5 * tau * v), 2 * radius])

    def restore(state: Array) -> Array:
        radius, v, _ = state
        cube = radius * radius * radius
        return np.stack([v - (4 / 3) * tau * cube, -(8 / 3) * radius * cube, 2 * radius])

    # Longer than sigma lasts: 1.2378 in compression and, with little loss, in restitution.
    compression = _Half(compress, np.stack([none, 1 + none, none]), 1.25 + none, 1)
    start = np.stack([compression.last[0], none, none])
    return compression, _Half(restore, start, 1.26 + tau, 0)


def _largest_force(compression: "_Half", tau: Array) -> tuple[Array, Array]:
    """Largest normal force and the velocity there, by a parabola through the largest values."""
    radius, v, _ = compression.values.swapaxes(0, 1)
    force = (4 / 3) * radius**3 + 2 * tau * radius * v
    column = np.arange(tau.size)
    top = np.clip(np.argmax(force, axis=0), 1, STEPS - 1)
    before, at, after = (force[top + k, column] for k in (-1, 0, 1))
    bend = 2 * at - before - after
    share = (after - before) / (2 * bend)
    slope = (v[top + 1, column] - v[top - 1, column]) / 2
    return at + bend * share**2 / 2, v[top, column] + share * slope


class _Half:
    """Compression or restitution at even steps of sigma, by the method of Runge and Kutta.

    The state is radius, velocity, time. The half ends where the component `ends` of it is 0.

    Attributes
    ----------
    values : ndarray, shape (STEPS + 1, 3, m)
    end : ndarray, shape (m,)
        sigma at the end.
    last : ndarray, shape (3, m)
        State there.
    """

    def __init__(
        self, slopes: Callable[[Array], Array], start: Array, longest: Array, ends: int
    ) -> None:
        self._step = step = longest / STEPS
        self.values, self._rates = np.empty((2, STEPS + 1, *start.shape))
        for n in range(STEPS + 1):
            self.values[n], self._rates[n] = start, slopes(start)
            second = slopes(start + step / 2 * self._rates[n])
            third = slopes(start + step / 2 * second)
            last = slopes(start + step * third)
            start = start + step / 6 * (self._rates[n] + 2 * (second + third) + last)
        self.end = self.crossing(ends, np.zeros((1, step.size)))[0]
        self.last = self.at(self.end[None])[:, 0]

    def taken(self, which: Integers) -> "_Half":
        """A half with the columns `which`."""
        half = copy(self)
        half.values, half._rates, half.last = (
            a[..., which] for a in (self.values, self._rates, self.last)
        )
        half._step, half.end = self._step[which], self.end[which]
        return half

    def at(self, sigma: Array) -> Array:
        """State at sigma, shape (3, ...)."""
        row = np.clip((sigma / self._step).astype(np.intp), 0, STEPS - 1)
        share = sigma / self._step - row
        return np.stack([_value(self._cubic(row, part), share) for part in range(3)])

    def crossing(self, part: int, level: Array) -> Array:
        """sigma where a component that falls is at a level, shape (k, m)."""
        row = np.empty(level.shape, np.intp)
        for i in range(self._step.size):  # each column has its own falling values
            falling = np.minimum.accumulate(self.values[:, part, i])
            row[:, i] = STEPS + 1 - np.searchsorted(falling[::-1], level[:, i], "right")
        row = np.clip(row - 1, 0, STEPS - 1)
        cubic = self._cubic(row, part)
        low, high = np.zeros(level.shape), np.ones(level.shape)
        for _ in range(BISECTIONS):
            middle = (low + high) / 2
            above = _value(cubic, middle) > level
            low, high = np.where(above, middle, low), np.where(above, high, middle)
        return (row + high) * self._step

    def _cubic(self, row: Integers, part: int) -> tuple[Array, ...]:
        """Coefficients of the cubic through values and slopes at both ends of a step."""
        column = np.arange(self._step.size)
        before, after = (self.values[row + k, part, column] for k in (0, 1))
        rise, fall = (self._step * self._rates[row + k, part, column] for k in (0, 1))
        change = after - before
        return before, rise, 3 * change - 2 * rise - fall, rise + fall - 2 * change


def _value(cubic: tuple[Array, ...], share: Array) -> Array:
    constant, linear, square, third = cubic
    return constant + share * (linear + share * (square + share * third))
