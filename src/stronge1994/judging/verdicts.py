"""From distances to a verdict: chi-squared for published points, a tolerance for all others.

Published points that agree with a curve are evidence only if they could have disagreed. So the
verdict is computed again with all of them moved by `VISIBLE_SHIFT` sigmas.
"""

from collections.abc import Mapping
from enum import StrEnum

from stronge1994.goodness import ChiSquared, chi_squared
from stronge1994.judging.distances import rms_and_max
from stronge1994.judging.metrics import Measured
from stronge1994.judging.points import Entry, Reference, is_published, question
from stronge1994.verdict_table import QUESTIONS

# If all points lie this many sigmas on one side of a curve, a reader of the picture sees that the
# curve is wrong. A comparison that does not notice it says less than the picture.
VISIBLE_SHIFT = 2.0


class Verdict(StrEnum):
    """The outcome of one comparison; only DIVERGES and WRONG fail a run.

    RIGHT and WRONG answer the question whether our curve is solved right, which our own second
    codes and laws decide; AGREES and DIVERGES are kept for the paper and for others. UNCHANGED is
    the verdict of a check against an earlier result of this repository, or against points that the
    curve was fitted to. It guards against accidents and is evidence of nothing. INCONCLUSIVE does
    not count as evidence either: published points agree with the curve, but would also agree if
    they lay `VISIBLE_SHIFT` sigmas beside it. A known difference is EXPLAINED; or its cause is not
    known; or it is UNTESTED, because the reference does not state how much its values scatter.

    >>> print(Verdict.EXPLAINED)
    explained difference
    """

    AGREES = "agrees"
    INCONCLUSIVE = "inconclusive"
    EXPLAINED = "explained difference"
    UNTESTED = "untested difference"
    UNEXPLAINED = "unexplained difference"
    DIVERGES = "diverges"
    RIGHT = "right"
    WRONG = "wrong"
    AWAITED = "awaited"
    UNCHANGED = "as before"


def chi_squared_of(reference: Reference, measured: Measured) -> ChiSquared:
    """Chi-squared of measured distances from published points."""
    return chi_squared(measured.residuals.sigmas, measured.shifts, reference.get("sigma_values"))


def judge(entry: Entry, reference: Reference, measured: Measured, significance: float) -> Verdict:
    """Verdict on measured distances; published points agree if p is above `significance`."""
    outcome = _outcome(entry, reference, measured, significance)
    if outcome == Verdict.AGREES and entry.get("fitted"):
        return Verdict.UNCHANGED
    if outcome == Verdict.DIVERGES:
        return failed(question(entry, reference))
    if outcome == Verdict.AGREES and question(entry, reference) == QUESTIONS[0]:
        return Verdict.RIGHT
    if outcome == Verdict.AGREES and is_published(reference):
        for off in (VISIBLE_SHIFT, -VISIBLE_SHIFT):
            residuals = measured.residuals._replace(sigmas=measured.residuals.sigmas + off)
            moved = measured._replace(residuals=residuals)
            if _outcome(entry, reference, moved, significance) != Verdict.DIVERGES:
                return Verdict.INCONCLUSIVE
    return outcome


def failed(asked: str) -> Verdict:
    """The verdict that fails a run, by the question that a comparison answers.

    >>> print(failed("solved right"), failed("as printed"), sep="; ")
    wrong; diverges
    """
    return Verdict.WRONG if asked == QUESTIONS[0] else Verdict.DIVERGES


def _outcome(
    entry: Entry, reference: Reference, measured: Measured, significance: float
) -> Verdict:
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
    return verdict(good, entry.get("documented", {}).get("as", ""), unchanged)


def verdict(good: bool, known: str = "", unchanged: bool = True) -> Verdict:
    """Verdict on a comparison.

    `good` says that the curve meets its reference: p is large enough, or the distance is within the
    tolerance. `known` is empty, or says of a known difference `explained`, `unexplained` or
    `untested`; if there is no difference any more, that is a fault too. `unchanged` says that the
    measured distances lie within the bounds of the regression test, if there is one.

    >>> print(verdict(True), verdict(False), verdict(False, "explained"), sep="; ")
    agrees; diverges; explained difference
    >>> print(verdict(True, "explained"), verdict(True, unchanged=False), sep="; ")
    diverges; diverges
    """
    if not unchanged or good == bool(known):
        return Verdict.DIVERGES
    return Verdict.AGREES if good else Verdict(f"{known} difference")
