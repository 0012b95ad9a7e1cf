"""From distances to a verdict: chi-squared for published points, a tolerance for all others.

Published points that agree with a curve are evidence only if they could have disagreed. So the
verdict is computed again with all of them moved by `VISIBLE_SHIFT` sigmas.
"""

from stronge1994.goodness import ChiSquared, chi_squared
from stronge1994.judging.comparisons import Comparison
from stronge1994.judging.distances import rms_and_max
from stronge1994.judging.metrics import Measured
from stronge1994.reference_data import Series
from stronge1994.verdict_table import Question, Verdict

# If all points lie this many sigmas on one side of a curve, a reader of the picture sees that the
# curve is wrong. A comparison that does not notice it says less than the picture.
VISIBLE_SHIFT = 2.0


def chi_squared_of(comparison: Comparison, measured: Measured) -> ChiSquared | None:
    """Chi-squared of measured distances from published points; None of all others."""
    if not (comparison.is_published and isinstance(comparison.reference, Series)):
        return None
    number = comparison.reference.sigma_values
    return chi_squared(measured.sigmas, measured.shifts, number)


def judge(comparison: Comparison, measured: Measured, significance: float) -> Verdict:
    """Verdict on measured distances; published points agree if p is above `significance`."""
    outcome = _outcome(comparison, measured, significance)
    if outcome == Verdict.DIVERGES:
        return comparison.question.failed
    if outcome != Verdict.AGREES:
        return outcome
    if comparison.fitted:
        return Verdict.UNCHANGED
    if comparison.question == Question.SOLVED:
        return Verdict.RIGHT
    for off in (VISIBLE_SHIFT, -VISIBLE_SHIFT) if comparison.is_published else ():
        moved = measured._replace(sigmas=measured.sigmas + off)
        if _outcome(comparison, moved, significance) != Verdict.DIVERGES:
            return Verdict.INCONCLUSIVE
    return outcome


def _outcome(comparison: Comparison, measured: Measured, significance: float) -> Verdict:
    """AGREES or DIVERGES; or the known difference that the comparison documents.

    It diverges too if there is no difference any more, or if the difference has left its bounds.
    """
    rms, largest = rms_and_max(measured.sigmas)
    # The difference of a landmark is its value minus the stated one.
    difference = -float(measured.plain[0])
    numbers = {"rms": rms, "max": largest, "difference": difference}
    good, known = largest <= comparison.limit, comparison.documented
    if chi2 := chi_squared_of(comparison, measured):
        good, numbers["chi2"] = chi2.p > significance, chi2.value
    if known is None:
        return Verdict.AGREES if good else Verdict.DIVERGES
    unchanged = all(
        low <= numbers[key] <= high for key, (low, high) in comparison.regression.items()
    )
    return known.verdict if unchanged and not good else Verdict.DIVERGES
