"""Normal impact of Kelvin-Voigt spheres: the law of Kuwabara & Kono without attraction.

Let d be the approach, tau the relaxation time and D = d + tau d'. A contact does not pull. So

    F = (4/3) (d^(3/2) + (3/2) tau d^(1/2) d')  in compression (Kuwabara & Kono 1987),
    F = (4/3) D^(3/2)                           in restitution, until D = 0.

Everything depends on tau alone in the units of `normal_impact`, and so does the coefficient of
restitution, which falls from 1 at tau = 0 towards 0.

By a time sigma, with the radius of contact a, a^2 = d or D, and k = (4/3) tau a^2,

    a' = v,                  v' = -(8/3) a^2 (a^2 + (3/2) tau v),  t' = 2 a          in compression,
    a' = (v - k a)/(1 + k),  v' = -(8/3) a^4/(1 + k),              t' = 2 a/(1 + k)  in restitution.

So nothing is singular at contact and separation, and a method of fourth order keeps its order. With
1 + k its steps are short where the contact relaxes fast, at the rate k, and long where it is slow.
"""

from collections.abc import Callable
from copy import copy
from functools import cache, lru_cache, partial
from typing import Any

import numpy as np
from numpy.polynomial import Chebyshev

from planarimpact.common import cubics, roots
from planarimpact.common.arrays import Array, Integers
from planarimpact.normal_impact import hertz

__all__ = ["largest_force", "relaxation_time", "restitution", "series"]

# Steps of either half. They make restitution right to 1e-10.
STEPS = 512
# Largest relaxation time of the tables. Restitution is 0.0216 there.
SLOWEST = 8.0
# Degree of the tables. Restitution is right to 1e-10, the force to 1e-6 of Hertz's.
DEGREE = 48
# Newton's method doubles the digits. It starts with two of them or more.
NEWTON = 8
# Last terms of `series` below this one may be left out: it stays right to 1e-10.
SMALL_TERM = 1e-11


def restitution(relaxation_time: Array) -> Array:
    """Coefficient of restitution at a relaxation time from 0 to `SLOWEST`: 1 at 0, then falling.

    Examples
    --------
    >>> restitution(np.array([0.0, 0.5])).round(6)
    array([1.     , 0.46894])
    """
    e = np.minimum(series()(np.sqrt(relaxation_time)), 1.0)
    return np.where(relaxation_time > 0, e, 1.0)


def relaxation_time(restitution: Array) -> Array:
    """Relaxation time of a coefficient of restitution, the inverse of `restitution` to 1e-11.

    Examples
    --------
    >>> relaxation_time(np.array([0.8])).round(6)
    array([0.123491])
    """
    root = _roots()(_loss(restitution))
    return root * root


def largest_force(restitution: Array) -> Array:
    """Largest normal force, over that of an elastic impact (Hertz).

    It is least, 0.77, at e = 0.46, as damping shortens the approach. For smaller e the viscous
    force at the start of contact is the largest. It has no bound as e approaches 0.

    Examples
    --------
    >>> largest_force(np.array([1.0, 0.8, 0.5, 0.1])).round(3)
    array([1.   , 0.887, 0.773, 1.339])
    """
    return np.where(restitution < 1, _largest_forces()(_loss(restitution)), 1.0)


def _loss(restitution: Array) -> Array:
    """Root of -log(e), of which the root of the relaxation time is a smooth function."""
    return np.sqrt(-np.log(restitution))


@cache
def series() -> Chebyshev:
    """Restitution against the root of the relaxation time, from 0 to the root of `SLOWEST`.

    Examples
    --------
    >>> float(series()(0.5**0.5).round(5))
    0.46894
    """

    def restitution_at(root: Array) -> Array:
        return -_both_halves(root * root)[1].last[1]

    return Chebyshev.interpolate(restitution_at, DEGREE, [0.0, np.sqrt(SLOWEST)])


@cache
def _roots() -> Chebyshev:
    """Root of the relaxation time against `_loss`."""
    table = series()
    slope = table.deriv()

    def root_at(loss: Array) -> Array:
        e = np.exp(-loss * loss)
        root = np.sqrt((1 - e) / (2 * e))
        for _ in range(NEWTON):
            root = np.clip(root - (table(root) - e) / slope(root), 0.0, np.sqrt(SLOWEST))
        return root

    return Chebyshev.interpolate(root_at, DEGREE, [0.0, _loss(table(np.sqrt(SLOWEST)))])


@cache
def _largest_forces() -> Chebyshev:
    """Largest force over Hertz's, against `_loss`."""
    tau_roots = _roots()

    def force_at(loss: Array) -> Array:
        tau = tau_roots(loss) ** 2
        return at_largest_force(_both_halves(tau)[0], tau)[0] / hertz.LARGEST_FORCE

    return Chebyshev.interpolate(force_at, DEGREE, tau_roots.domain)


@lru_cache(maxsize=16)
def halves(restitution: tuple[float, ...]) -> tuple[Array, "Half", "Half"]:
    """Relaxation times, compression and restitution; cached for repeats with doubled steps."""
    tau = relaxation_time(np.array(restitution))
    return tau, *_both_halves(tau)


def _both_halves(tau: Array) -> tuple["Half", "Half"]:
    zero = np.zeros_like(tau)
    # A little longer than sigma lasts: 1.2378, and in restitution at most 1.4 tau^(7/9) more.
    compression = Half(partial(compress, tau=tau), np.stack([zero, 1 + zero, zero]), 1.25 + zero, 1)
    start = np.stack([compression.last[0], zero, zero])
    return compression, Half(partial(restore, tau=tau), start, 1.25 + 1.41 * tau ** (7 / 9), 0)


def compress(state: Array, tau: Array) -> Array:
    """Rates of radius, velocity and time in compression, by sigma."""
    radius, v, _ = state
    square = radius * radius
    return np.array([v, -(8 / 3) * square * (square + 1.5 * tau * v), 2 * radius])


def restore(state: Array, tau: Array) -> Array:
    """The same in restitution."""
    radius, v, _ = state
    square = radius * radius
    k = (4 / 3) * tau * square
    return np.array([v - k * radius, -(8 / 3) * square * square, 2 * radius]) / (1 + k)


def at_largest_force(compression: "Half", tau: Array) -> tuple[Array, Array]:
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


class Half:
    """Compression or restitution at even steps of sigma, by the method of Runge and Kutta.

    The state is radius, velocity, time; its `values` have the shape (STEPS + 1, 3, m). The half
    ends where the component `ends` is 0: at sigma = `end`, shape (m,), in the state `last`, (3, m).
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

    def taken(self, which: Integers) -> "Half":
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
        return np.stack([cubics.value(self._cubic(row, part), share) for part in range(3)])

    def crossing(self, part: int, level: Array, rises: bool = False) -> Array:
        """sigma where a component that falls, or `rises`, is at a level, shape (k, m)."""
        sign = -1.0 if rises else 1.0
        level = sign * level
        row = np.empty(level.shape, np.intp)
        for i in range(self._step.size):  # each column has its own falling values
            falling = np.minimum.accumulate(sign * self.values[:, part, i])
            row[:, i] = STEPS + 1 - np.searchsorted(falling[::-1], level[:, i], "right")
        row = np.clip(row - 1, 0, STEPS - 1)
        cubic = [sign * np.ravel(c) for c in self._cubic(row, part)]
        goal, zero = np.ravel(level), np.zeros(level.size)

        def margin(which: Any, share: Array) -> tuple[Array, Array, Array]:
            constant, linear, square, third = (c[which] for c in cubic)
            return (
                cubics.value((constant - goal[which], linear, square, third), share),
                linear + share * (2 * square + 3 * share * third),
                2 * square + 6 * share * third,
            )

        share = roots.crossing(margin, zero, zero + 1)
        return (row + share.reshape(level.shape)) * self._step

    def _cubic(self, row: Integers, part: int) -> tuple[Array, ...]:
        """Coefficients of the cubic through values and slopes at both ends of a step."""
        column = np.arange(self._step.size)
        before, after = (self.values[row + k, part, column] for k in (0, 1))
        rise, fall = (self._step * self._rates[row + k, part, column] for k in (0, 1))
        return cubics.coefficients(before, after, rise, fall)
