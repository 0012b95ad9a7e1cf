"""From distances to a verdict: chi-squared for published points, a tolerance for all others.

Published points that agree with a curve are evidence only if they could have disagreed. So each
comparison says which error of the curve it would have noticed, see `goodness.smallest_error`: of
its size or, where a factor was fitted that explains any size, of its length along x.

Where an error of the points is not published, such as the scatter of a measurement, sigma is too
small by an unknown amount. Then points can agree, as a larger sigma explains a distance all the
more. That they differ cannot be judged.
"""

from typing import NamedTuple

import numpy as np

from stronge1994.goodness import ChiSquared, chi_squared, smallest_error
from stronge1994.judging.comparisons import Comparison, Metric
from stronge1994.judging.metrics import Measured
from stronge1994.reference_data import Series
from stronge1994.verdict_table import Group, Verdict

# A p up to this many times the significance is no difference, and no agreement either.
DOUBT = 10
# A comparison that would not notice a curve that is larger by so much says nothing.
LARGEST_ERROR = 0.1


class Judged(NamedTuple):
    """A verdict; of published points also chi-squared, and the smallest error that differs."""

    verdict: Verdict
    chi2: ChiSquared | None = None
    error: float | None = None


def judge(comparison: Comparison, measured: Measured, significance: float) -> Judged:
    """Verdict on measured distances; published points differ if p is not above `significance`."""
    reference, solver = comparison.reference, comparison.group == Group.SOLVER
    if not (isinstance(reference, Series) and reference.is_published):
        if np.abs(measured.sigmas).max() <= 1.0:
            return Judged(Verdict.PASSED if solver else Verdict.AGREES)
        return Judged(Verdict.FAILS if solver else Verdict.DIFFERS)
    shared = measured.shifts, measured.of_sigma, measured.free
    chi2 = chi_squared(measured.sigmas, *shared)
    direction = measured.larger if measured.free is None else measured.wider
    error = smallest_error(direction, *shared, significance=significance)
    agrees = chi2.p > DOUBT * significance and error <= LARGEST_ERROR
    if reference.unpublished and not agrees and np.isfinite(chi2.p):
        return Judged(Verdict.CANNOT_JUDGE, chi2, error)
    if not chi2.p > significance:  # nor if it is nan
        return Judged(Verdict.DIFFERS, chi2, error)
    return Judged(Verdict.AGREES if agrees else Verdict.CANNOT_TELL, chi2, error)


def error_in_words(comparison: Comparison, measured: Measured, error: float | None) -> str:
    """Which error a comparison would have noticed, in words; empty if there is none.

    It would have given a p below the significance in nine of ten readings.
    """
    if error is None or not np.isfinite(error):
        return ""
    what = "wider" if measured.free is not None else "larger"
    what = "a ratio {} % larger" if comparison.metric == Metric.RATIO else f"a curve {{}} % {what}"
    return what.format(f"{float(f'{100 * error:.2g}'):g}")
