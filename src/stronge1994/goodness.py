"""Goodness of fit: chi-squared of points beside a curve."""

from typing import NamedTuple

import numpy as np

from planarimpact.common.arrays import ArrayLike


class ChiSquared(NamedTuple):
    """How well points fit a curve.

    `value` is the sum of squares of the distances in sigmas, with their correlations; `degrees` is
    the number of points less that of fitted parameters, which need not be whole: several curves may
    share one. `of_sigma` is the number of independent values from which the sigmas were
    estimated, None if they are known. `p` is the probability that chance alone gives a value as
    large. It follows the distribution of chi-squared, or that of F if the sigmas were estimated.
    """

    value: float
    degrees: float
    of_sigma: int | None
    p: float


def chi_squared(
    sigmas: ArrayLike, shifts: ArrayLike = (), of_sigma: int | None = None, fitted: float = 0
) -> ChiSquared:
    """Chi-squared of distances, with the uncertainty of the curve's own parameters.

    An error of a parameter moves all points of the curve together. So the distances have the
    covariance 1 + sum of J J^T, with one J for each independent parameter: a row of `shifts`, which
    says how much each distance changes with one sigma of the parameter. A fit of the parameters
    gives the same chi-squared, if it holds them to their stated values with their stated sigmas.
    `of_sigma` is as in `ChiSquared`; `fitted` is the number of parameters fitted to the points. As
    many parameters as points explain everything: p is 1.

    >>> fit = chi_squared([1.0, 2.0])
    >>> fit.value, fit.degrees, round(fit.p, 3)
    (5.0, 2, 0.082)
    >>> round(chi_squared([1.0, 1.0], [[3.0, 3.0]]).value, 3)  # one shift explains both
    0.105
    >>> round(chi_squared([1.0, 2.0], of_sigma=4).p, 3)  # the sigma itself may be too small
    0.198
    """
    from scipy.special import chdtrc, fdtrc  # slow to load, and only published points need it

    distance = np.asarray(sigmas, float)
    if not len(distance):
        raise ValueError("no points")
    moved = np.asarray(shifts, float).reshape(-1, len(distance))
    covariance = np.eye(len(distance)) + moved.T @ moved
    value = float(distance @ np.linalg.solve(covariance, distance))
    degrees = len(distance) - fitted
    if degrees <= 0:
        return ChiSquared(value, degrees, of_sigma, 1.0)
    if of_sigma is None:
        return ChiSquared(value, degrees, None, float(chdtrc(degrees, value)))
    return ChiSquared(value, degrees, of_sigma, float(fdtrc(degrees, of_sigma, value / degrees)))
