"""From distances to a verdict: chi-squared for published points, a tolerance for all others.

Published points that agree with a curve are evidence only if they could have disagreed. So the
verdict is computed again with all of them moved by `VISIBLE_SHIFT` sigmas. A fitted scale stays as
it was for them: it would follow any shift that looks like another scale, and the question is
whether the test notices differences of that size in the shape, which no scale explains.
"""

import numpy as np

from stronge1994.goodness import ChiSquared, chi_squared
from stronge1994.judging.comparisons import Comparison
from stronge1994.judging.metrics import Measured
from stronge1994.reference_data import Series
from stronge1994.verdict_table import Group, Verdict

# If all points lie this many sigmas on one side of a curve, a reader of the picture sees that the
# curve is wrong. A comparison that does not notice it says less than the picture.
VISIBLE_SHIFT = 2.0
# Values from which sigmas are as good as known: the F test has the p of chi-squared.
ALL_KNOWN = 1000


def judge(
    comparison: Comparison, measured: Measured, significance: float
) -> tuple[Verdict, ChiSquared | None]:
    """Verdict on measured distances, and chi-squared of published points, None of all others.

    Published points agree if p is above `significance`. A known difference fails if there is no
    difference any more, and if it has left its bounds.
    """
    good, chi2 = _is_good(comparison, measured, significance)
    if comparison.differs:
        sizes, bounds = measured.sizes, comparison.bounds.items()
        kept = all(low <= sizes[key] <= high for key, (low, high) in bounds)
        return (Verdict.DIFFERS if kept and not good else Verdict.FAILS), chi2
    if not good:
        return Verdict.FAILS, chi2
    if comparison.group == Group.SOLVER:
        return Verdict.PASSED, chi2
    for off in (VISIBLE_SHIFT, -VISIBLE_SHIFT) if chi2 else ():
        moved = measured._replace(sigmas=measured.sigmas + off)
        if _is_good(comparison, moved, significance)[0]:
            return Verdict.CANNOT_TELL, chi2
    return Verdict.AGREES, chi2


def judge_print(
    comparison: Comparison, verdict: Verdict, of_printed: Measured, significance: float
) -> tuple[Verdict, str]:
    """Verdict on a printed curve, and what it follows: the model, the printed equations, none.

    `verdict` is that beside the model.
    """
    other = comparison.or_printed
    assert other is not None
    follows, _ = _is_good(comparison, of_printed, significance)
    if verdict != Verdict.FAILS:
        alike = f"it cannot tell the model from {other.equations} as printed"
        return verdict, alike if follows else f"the print follows the model, not {other.equations}"
    if follows:
        return Verdict.DIFFERS, f"the print follows {other.equations} as printed"
    return verdict, f"the print follows neither {other.equations} as printed nor the model"


def _is_good(
    comparison: Comparison, measured: Measured, significance: float
) -> tuple[bool, ChiSquared | None]:
    """Whether distances are small enough, and chi-squared of published points."""
    reference = comparison.reference
    if isinstance(reference, Series) and reference.is_published:
        values = _values_of_sigma(comparison, measured, reference.sigma_values)
        chi2 = chi_squared(measured.sigmas, measured.shifts, values, measured.fitted)
        return chi2.p > significance, chi2
    return bool(np.abs(measured.sigmas).max() <= 1.0), None


def _values_of_sigma(comparison: Comparison, measured: Measured, values: int | None) -> int | None:
    """From how many values the sigmas are as good as estimated, None if as good as known.

    An allowance is known, and only the rest of the variance was estimated: so they are as good as
    from more values (Welch 1947, Satterthwaite 1946).
    """
    if values is None or comparison.allowance is None:
        return values
    estimated = 1.0 - (comparison.allowance.y / measured.scales) ** 2
    effective = values / max(float(np.mean(estimated**2)), values / ALL_KNOWN)
    return round(effective) if effective < ALL_KNOWN else None
