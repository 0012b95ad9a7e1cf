"""What a check of the ledger returns, and the judgement of an entry on it."""

from collections.abc import Iterable, Mapping
from typing import Any, NamedTuple

import numpy as np

# Numbers nearer than this are equal. It leaves room for the rounding of a few hundred operations,
# and for the error of quadrature.
EXACT = 1e-9

CONFIRMED, ROUNDED, WRONG = "confirmed", "confirmed within rounding", "wrong"


class Finding(NamedTuple):
    """The result of a check.

    For an equation `value` is the largest distance of the printed formula from the paper's model
    among the samples, in the unit that the check names; between the samples it may be larger. For a
    sentence it is the number that decides it. `corrected` is the same for the corrected formula,
    where the printed one is wrong.
    """

    value: float
    corrected: float | None = None


class Judgement(NamedTuple):
    """The verdict that a finding supports, whether the entry holds, and why if it does not."""

    verdict: str
    holds: bool
    why: str


def largest(values: Iterable) -> float:
    """Largest absolute value of numbers and arrays; nan stays nan.

    >>> largest([np.array([1.0, -3.0]), 2.0])
    3.0
    """
    return float(np.max([np.max(np.abs(value), initial=0) for value in values]))


def verdict(value: float, confirms: Mapping[str, float]) -> str:
    """Verdict that a number supports; `confirms` has `at_most`, `at_least`, or `value`, `rounding`.

    >>> verdict(1.7007, {"value": 1.7, "rounding": 0.05})
    'confirmed within rounding'
    >>> verdict(0.2, {"at_most": 0.05})
    'wrong'
    """
    if "value" in confirms:
        # `rounding` is half a unit of the last figure, or what the sentence leaves open.
        gap = abs(value - confirms["value"])
        if gap <= EXACT:
            return CONFIRMED
        return ROUNDED if gap <= confirms["rounding"] else WRONG
    above = "at_least" in confirms
    good = value >= confirms["at_least"] if above else value <= confirms["at_most"]
    return CONFIRMED if good else WRONG


def judge(finding: Finding, entry: Mapping[str, Any]) -> Judgement:
    """Judge whether an entry of the ledger still holds.

    The entry has `verdict`, `confirms`, and where the verdict is wrong `between`, bounds of
    `value` on both sides. Where there is a corrected formula it must be exact.

    >>> entry = {"verdict": "wrong", "confirms": {"at_most": 1e-9}, "between": [1.1, 1.3]}
    >>> judge(Finding(1.2, 1e-14), entry).holds
    True
    >>> print(judge(Finding(0.0, 1e-14), entry).why)
    recorded as wrong, found confirmed
    """
    supported = verdict(finding.value, entry["confirms"])
    complaints = []
    if supported != entry["verdict"]:
        complaints.append(f"recorded as {entry['verdict']}, found {supported}")
    low, high = entry.get("between", (-np.inf, np.inf))
    if not complaints and not low <= finding.value <= high:
        complaints.append(f"{finding.value:.4g} lies outside {low:g} to {high:g}")
    if finding.corrected is not None and not finding.corrected <= EXACT:
        complaints.append(f"the corrected formula is off by {finding.corrected:.2g}")
    return Judgement(supported, not complaints, "; ".join(complaints))
