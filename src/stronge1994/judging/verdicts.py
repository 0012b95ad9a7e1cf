"""From distances to a verdict: chi-squared for published points, a tolerance for all others.

Published points that agree with a curve are evidence only if they could have disagreed. So the
verdict is computed again with all of them moved by `VISIBLE_SHIFT` sigmas.
"""

from collections.abc import Mapping

from stronge1994.goodness import ChiSquared, chi_squared
from stronge1994.judging.distances import rms_and_max
from stronge1994.judging.metrics import Measured
from stronge1994.judging.points import Entry, Reference, is_published, question
from stronge1994.verdict_tables.verdict_table import FAILED, QUESTIONS, Verdict

# If all points lie this many sigmas on one side of a curve, a reader of the picture sees that the
# curve is wrong. A comparison that does not notice it says less than the picture.
VISIBLE_SHIFT = 2.0


def chi_squared_of(reference: Reference, measured: Measured) -> ChiSquared:
    """Chi-squared of measured distances from published points."""
    return chi_squared(measured.residuals.sigmas, measured.shifts, reference.get("sigma_values"))


def judge(entry: Entry, reference: Reference, measured: Measured, significance: float) -> Verdict:
    """Verdict on measured distances; published points agree if p is above `significance`."""
    outcome, asked = _outcome(entry, reference, measured, significance), question(entry, reference)
    if outcome == Verdict.DIVERGES:
        return FAILED[asked]
    if outcome != Verdict.AGREES:
        return outcome
    if entry.get("fitted"):
        return Verdict.UNCHANGED
    if asked == QUESTIONS[0]:
        return Verdict.RIGHT
    for off in (VISIBLE_SHIFT, -VISIBLE_SHIFT) if is_published(reference) else ():
        residuals = measured.residuals._replace(sigmas=measured.residuals.sigmas + off)
        moved = measured._replace(residuals=residuals)
        if _outcome(entry, reference, moved, significance) != Verdict.DIVERGES:
            return Verdict.INCONCLUSIVE
    return outcome


def _outcome(
    entry: Entry, reference: Reference, measured: Measured, significance: float
) -> Verdict:
    """AGREES or DIVERGES; or the known difference that the comparison documents.

    It diverges too if there is no difference any more, or if the difference has left the bounds of
    its regression test.
    """
    rms, largest = rms_and_max(measured.residuals.sigmas)
    # The difference of a landmark is its value minus the stated one.
    difference = -float(measured.residuals.plain[0])
    numbers = {"rms": rms, "max": largest, "difference": difference}
    if is_published(reference):
        chi2 = chi_squared_of(reference, measured)
        good, numbers["chi2"] = chi2.p > significance, chi2.value
    else:
        good = largest <= entry.get("limit", 1.0)
    bounds: Mapping[str, tuple[float, float]] = entry.get("regression", {})
    unchanged = all(low <= numbers[key] <= high for key, (low, high) in bounds.items())
    known = entry.get("documented", {}).get("as")
    if not unchanged or good == bool(known):
        return Verdict.DIVERGES
    return Verdict.AGREES if good else Verdict(f"{known} difference")
