"""Goodness of fit: chi-squared of points beside a curve, and which error it would notice."""

import functools
from typing import NamedTuple

import numpy as np

from planarimpact.common.arrays import Array, ArrayLike

# How often `smallest_error` would be noticed.
POWER = 0.9


class ChiSquared(NamedTuple):
    """How well points fit a curve.

    `value` is the sum of squares of the distances in sigmas, with their correlations; `degrees` is
    the number of points less one for a fitted factor. `of_sigma` is the number of independent
    values from which the sigmas were estimated, None if they are known. `p` is the probability that
    chance alone gives a value as large. It follows the distribution of chi-squared, or that of F if
    the sigmas were estimated.
    """

    value: float
    degrees: int
    of_sigma: int | None
    p: float


def chi_squared(
    sigmas: ArrayLike,
    shifts: ArrayLike = (),
    of_sigma: int | None = None,
    free: ArrayLike | None = None,
) -> ChiSquared:
    """Chi-squared of distances, with errors that the points share.

    An error that they share, of a parameter of the curve or of the axes of a picture, moves all of
    them together. So the distances have the covariance S = 1 + sum of J J^T, with one J for each
    independent error: a row of `shifts`, which says how much each distance changes with one sigma
    of the error. A fit of the errors gives the same chi-squared, if it holds them to 0 with their
    sigmas. An error of any size, that of a fitted factor, is a row `free`; it costs one degree of
    freedom. `of_sigma` is as in `ChiSquared`.

    >>> fit = chi_squared([1.0, 2.0])
    >>> fit.value, fit.degrees, round(fit.p, 3)
    (5.0, 2, 0.082)
    >>> round(chi_squared([1.0, 1.0], [[3.0, 3.0]]).value, 3)  # one shift explains both
    0.105
    >>> fit = chi_squared([2.0, 2.1], free=[1.0, 1.0])  # a fitted factor explains nearly all
    >>> round(fit.value, 6), fit.degrees
    (0.005, 1)
    >>> round(chi_squared([1.0, 2.0], of_sigma=4).p, 3)  # the sigma itself may be too small
    0.198
    """
    from scipy.special import chdtrc, fdtrc  # slow to load, and only published points need it

    distance = np.asarray(sigmas, float)
    if not len(distance):
        raise ValueError("no points")
    value = _size(distance, shifts, free)
    degrees = len(distance) - (free is not None)
    if not degrees:
        return ChiSquared(value, 0, of_sigma, 1.0)
    if of_sigma is None:
        return ChiSquared(value, degrees, None, float(chdtrc(degrees, value)))
    return ChiSquared(value, degrees, of_sigma, float(fdtrc(degrees, of_sigma, value / degrees)))


def smallest_error(
    direction: ArrayLike,
    shifts: ArrayLike = (),
    of_sigma: int | None = None,
    free: ArrayLike | None = None,
    *,
    significance: float,
) -> float:
    """The error that would give a p below `significance` in nine of ten readings.

    `direction` is how much each distance changes with an error of 1, in sigmas. Chi-squared of
    points that are off by an error follows the noncentral distribution, with the noncentrality
    g^T S^-1 g times its square. Infinite if no error would be noticed.

    >>> round(smallest_error([1.0], significance=0.001), 3)  # 3.29 + 1.28 sigmas
    4.572
    """
    degrees = len(np.asarray(direction)) - (free is not None)
    seen = _size(np.asarray(direction, float), shifts, free)
    # What rounding leaves of an error that a free one explains.
    if not degrees or seen <= 1e-12 * float(np.sum(np.square(direction))):
        return np.inf
    return float(np.sqrt(noncentrality(degrees, of_sigma, significance) / seen))


@functools.cache
def noncentrality(degrees: int, of_sigma: int | None, significance: float) -> float:
    """The noncentrality with which p is below `significance` in nine of ten cases.

    >>> round(noncentrality(9, None, 0.001), 2), round(noncentrality(9, 34, 0.001), 2)
    (34.08, 50.88)
    """
    from scipy.special import chdtri, chndtrinc, fdtri, ncfdtrinc

    if of_sigma is None:
        return float(chndtrinc(chdtri(degrees, significance), degrees, 1 - POWER))
    limit = fdtri(degrees, of_sigma, 1 - significance)
    return float(ncfdtrinc(degrees, of_sigma, 1 - POWER, limit))


def product(a: Array, b: Array, shifts: ArrayLike) -> float:
    """The product a^T S^-1 b, with S as in `chi_squared`."""
    moved = np.asarray(shifts, float).reshape(-1, len(a))
    return float(a @ np.linalg.solve(np.eye(len(a)) + moved.T @ moved, b))


def _size(distance: Array, shifts: ArrayLike, free: ArrayLike | None) -> float:
    """The square of a vector by S^-1, without what lies along `free`."""
    whole = product(distance, distance, shifts)
    if free is None:
        return whole
    along = np.asarray(free, float)
    squared = product(along, along, shifts)
    return whole - product(along, distance, shifts) ** 2 / squared if squared else whole
