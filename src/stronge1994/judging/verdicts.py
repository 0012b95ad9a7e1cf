"""From distances to a verdict: chi-squared for published points, a tolerance for all others.

Published points that agree with a curve are evidence only if they could have disagreed. So the
verdict is computed again with all of them moved by `VISIBLE_SHIFT` sigmas.
"""

from typing import NamedTuple

import numpy as np

from planarimpact.common.arrays import Array
from stronge1994.goodness import ChiSquared, chi_squared
from stronge1994.judging.comparisons import Comparison
from stronge1994.judging.metrics import Measured
from stronge1994.reference_data import Series
from stronge1994.verdict_table import Question, Verdict

# If all points lie this many sigmas on one side of a curve, a reader of the picture sees that the
# curve is wrong. A comparison that does not notice it says less than the picture.
VISIBLE_SHIFT = 2.0


class Judgement(NamedTuple):
    """A verdict, and the sizes on which it rests.

    `sigmas` and `plain` are the root mean square and the largest size of the distances; `chi2` is
    that of published points, None of all others.
    """

    verdict: Verdict
    sigmas: tuple[float, float]
    plain: tuple[float, float]
    chi2: ChiSquared | None


def judge(comparison: Comparison, measured: Measured, significance: float) -> Judgement:
    """Judge measured distances; published points agree if p is above `significance`."""
    found = _outcome(comparison, measured, significance)
    verdict = found.verdict
    if verdict == Verdict.DIVERGES:
        verdict = comparison.question.failed
    elif verdict == Verdict.AGREES and comparison.fitted:
        verdict = Verdict.UNCHANGED
    elif verdict == Verdict.AGREES and comparison.question == Question.SOLVED:
        verdict = Verdict.RIGHT
    elif verdict == Verdict.AGREES and comparison.is_published:
        for off in (VISIBLE_SHIFT, -VISIBLE_SHIFT):
            moved = measured._replace(sigmas=measured.sigmas + off)
            if _outcome(comparison, moved, significance).verdict != Verdict.DIVERGES:
                verdict = Verdict.INCONCLUSIVE
    return found._replace(verdict=verdict)


def _outcome(comparison: Comparison, measured: Measured, significance: float) -> Judgement:
    """AGREES or DIVERGES; or the known difference that the comparison documents.

    It diverges too if there is no difference any more, or if the difference has left its bounds.
    """
    sizes = _rms_and_max(measured.sigmas), _rms_and_max(measured.plain)
    (rms, largest), chi2 = sizes[0], None
    # The difference of a landmark is its value minus the stated one.
    numbers = {"rms": rms, "max": largest, "difference": -float(measured.plain[0])}
    good, known = largest <= comparison.limit, comparison.documented
    if isinstance(comparison.reference, Series) and comparison.is_published:
        number = comparison.reference.sigma_values
        chi2 = chi_squared(measured.sigmas, measured.shifts, number)
        good, numbers["chi2"] = chi2.p > significance, chi2.value
    bounds = comparison.regression.items()
    unchanged = all(low <= numbers[key] <= high for key, (low, high) in bounds)
    if not unchanged or good == bool(known):
        return Judgement(Verdict.DIVERGES, *sizes, chi2)
    return Judgement(known.verdict if known else Verdict.AGREES, *sizes, chi2)


def _rms_and_max(distances: Array) -> tuple[float, float]:
    return float(np.sqrt(np.mean(distances**2))), float(np.abs(distances).max())
