"""From distances to a verdict: chi-squared for published points, a tolerance for all others."""

from collections.abc import Mapping
from enum import StrEnum
from typing import Any, NamedTuple

import numpy as np
from scipy.special import chdtrc, fdtrc

from planarimpact.ground.arrays import ArrayLike
from stronge1994.judging.metrics import Measured
from stronge1994.judging.points import Entry, Reference, is_published


class Verdict(StrEnum):
    """The outcome of one comparison; only DIVERGES fails a run.

    UNCHANGED is the verdict of a check against an earlier result of this repository. It guards
    against accidents and is evidence of nothing.

    Examples
    --------
    >>> print(Verdict.DOCUMENTED)
    differs as documented
    """

    AGREES = "agrees"
    DOCUMENTED = "differs as documented"
    DIVERGES = "diverges"
    AWAITED = "awaited"
    UNCHANGED = "as before"


class ChiSquared(NamedTuple):
    """How well points fit a curve to which nothing was fitted.

    Attributes
    ----------
    value : float
        Sum of squares of the distances in sigmas, with their correlations.
    degrees : int
        Degrees of freedom: the number of points.
    of_sigma : int or None
        Number of independent values from which the sigmas were estimated; None if they are known.
    p : float
        Probability that chance alone gives a value as large. It follows the distribution of
        chi-squared, or that of F if the sigmas were estimated.
    """

    value: float
    degrees: int
    of_sigma: int | None
    p: float


def chi_squared(
    sigmas: ArrayLike, shifts: ArrayLike = (), of_sigma: int | None = None
) -> ChiSquared:
    """Chi-squared of distances, with the uncertainty of the curve's own parameters.

    An error of a parameter moves all points of the curve together. So the distances have the
    covariance 1 + sum of J J^T, with one J for each parameter. A fit of the parameters gives the
    same chi-squared, if it holds them to their stated values with their stated sigmas.

    Parameters
    ----------
    sigmas : array_like, shape (n,)
        Signed distances of the points, in their own sigmas.
    shifts : array_like, shape (k, n)
        How much each distance changes with one sigma of each of k independent parameters.
    of_sigma : int, optional
        Number of independent values from which the sigmas were estimated, if they were.

    Returns
    -------
    ChiSquared

    Raises
    ------
    ValueError
        If there are no points.

    Examples
    --------
    >>> found = chi_squared([1.0, 2.0])
    >>> found.value, found.degrees, round(found.p, 3)
    (5.0, 2, 0.082)
    >>> round(chi_squared([1.0, 1.0], [[3.0, 3.0]]).value, 3)  # one shift explains both
    0.105
    >>> round(chi_squared([1.0, 2.0], of_sigma=4).p, 3)  # the sigma itself may be too small
    0.198
    """
    distance = np.asarray(sigmas, float)
    if not len(distance):
        raise ValueError("no points")
    moved = np.asarray(shifts, float).reshape(-1, len(distance))
    covariance = np.eye(len(distance)) + moved.T @ moved
    value = float(distance @ np.linalg.solve(covariance, distance))
    degrees = len(distance)
    if of_sigma is None:
        return ChiSquared(value, degrees, None, float(chdtrc(degrees, value)))
    return ChiSquared(value, degrees, of_sigma, float(fdtrc(degrees, of_sigma, value / degrees)))


def chi_squared_of(known: Reference, found: Measured) -> ChiSquared:
    """Chi-squared of what `measure` found beside published points."""
    return chi_squared(found.residuals.sigmas, found.shifts, known.get("sigma_values"))


def judge(entry: Entry, known: Reference | None, found: Measured, significance: float) -> Verdict:
    """Verdict on what `measure` found.

    Parameters
    ----------
    entry : dict
        The comparison, from the config.
    known : dict or None
        Its reference.
    found : Measured
    significance : float
        Published points agree if their probability p is above it.

    Returns
    -------
    Verdict
    """
    distance = found.residuals.summary()
    measured: dict[str, Any] = {"rms": distance.rms, "max": distance.max, "difference": found.gap}
    if known is not None and is_published(known):
        chi2 = chi_squared_of(known, found)
        good, measured["chi2"] = chi2.p > significance, chi2.value
    else:
        good = distance.max <= entry.get("limit", 1.0)
    bounds: Mapping[str, tuple[float, float]] = entry.get("regression", {})
    unchanged = all(low <= measured[key] <= high for key, (low, high) in bounds.items())
    return verdict(good, "documented" in entry, unchanged)


def verdict(good: bool, documented: bool = False, unchanged: bool = True) -> Verdict:
    """Verdict on a comparison.

    Parameters
    ----------
    good : bool
        The curve meets its reference: the probability p is large enough, or the distance is within
        the tolerance.
    documented : bool
        A difference is known and explained. If there is none any more, that is a fault too.
    unchanged : bool
        What was found lies within the bounds of its regression test, if it has one.

    Returns
    -------
    Verdict

    Examples
    --------
    >>> print(verdict(True), verdict(False), verdict(False, documented=True), sep="; ")
    agrees; diverges; differs as documented
    >>> print(verdict(True, documented=True), verdict(True, unchanged=False), sep="; ")
    diverges; diverges
    """
    if not unchanged or good == documented:
        return Verdict.DIVERGES
    return Verdict.AGREES if good else Verdict.DOCUMENTED
