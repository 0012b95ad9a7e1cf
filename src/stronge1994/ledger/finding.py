"""What a check of the ledger returns, how it is made of comparisons, and the judgement of it."""

from collections.abc import Callable, Iterable, Iterator, Mapping
from functools import wraps
from typing import Any, NamedTuple, TypeVar

import numpy as np

from planarimpact.common.arrays import Array, ArrayLike

# Numbers nearer than this are equal. It leaves room for the rounding of a few hundred operations,
# and for the error of quadrature.
EXACT = 1e-9

CONFIRMED, ROUNDED, WRONG = "confirmed", "confirmed within rounding", "wrong"
# The models of which a statement on restitution is also asked, and the verdicts in nature.
LOSSES = VISCOUS, PLASTIC = "viscous", "plastic"
PAPER, UNLOADING_STIFFNESS = "paper", "unloading_stiffness"
MODELS = (PAPER, UNLOADING_STIFFNESS, *LOSSES)
STANDS, FAILS, DEPENDS, OPEN = "stands", "fails", "depends on the loss", "open"

# What a comparison yields at one place.
Gaps = Iterator[ArrayLike]
_Place = TypeVar("_Place")


class Finding(NamedTuple):
    """What a run of a check finds.

    For an equation `value` is the largest distance of the printed formula from the paper's model
    among the samples, in the unit that the check names; between the samples it may be larger. For a
    sentence it is the number that decides it. `corrected` is the same for the corrected formula,
    where the printed one is wrong.
    """

    value: float
    corrected: float | None = None


def largest(values: Iterable[ArrayLike]) -> float:
    """Largest absolute value of numbers and arrays; nan stays nan.

    >>> largest([np.array([1.0, -3.0]), 2.0])
    3.0
    """
    return float(np.max([np.max(np.abs(value), initial=0) for value in values]))


def over(
    places: Callable[[], Iterable[_Place]],
) -> Callable[[Callable[[_Place], Gaps]], Callable[[], float]]:
    """Make a check of a function that yields its distances at one place: the largest counts.

    >>> @over(lambda: [1.0, 2.0])
    ... def square_root(place):
    ...     yield place**0.5 - 1
    >>> round(square_root(), 3)
    0.414
    """

    def check_of(gaps: Callable[[_Place], Gaps]) -> Callable[[], float]:
        @wraps(gaps)
        def check() -> float:
            return largest(gap for place in places() for gap in gaps(place))

        return check

    return check_of


def corrected_over(
    places: Callable[[], Iterable[_Place]],
) -> Callable[[Callable[[_Place], tuple[ArrayLike, float]]], Callable[[], Finding]]:
    """Make a check of a function that returns its distances at one place, printed and corrected.

    The printed formula may have several readings; the one that comes nearest counts.

    >>> @corrected_over(lambda: [1.0, 2.0])
    ... def twice(place):
    ...     return [place - 3, place + 3], 0.0
    >>> twice()
    Finding(value=2.0, corrected=0.0)
    """

    def check_of(gaps: Callable[[_Place], tuple[ArrayLike, float]]) -> Callable[[], Finding]:
        @wraps(gaps)
        def check() -> Finding:
            printed, corrected = zip(*map(gaps, places()), strict=True)
            readings: Array = np.max(np.abs(printed), axis=0)
            return Finding(float(np.min(readings)), largest(corrected))

        return check

    return check_of


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


def judge(finding: Finding, entry: Mapping[str, Any]) -> str:
    """Why an entry of the ledger no longer holds; empty if it does.

    The entry has `verdict` and `confirms`. Where there is a corrected formula it must be exact.

    >>> entry = {"verdict": "wrong", "confirms": {"at_most": 1e-9}}
    >>> judge(Finding(1.2, 1e-14), entry)
    ''
    >>> judge(Finding(0.0, 1e-14), entry)
    'recorded as wrong, found confirmed'
    """
    if np.isnan(finding.value):
        return "it found no number"
    complaints = [_complaint(entry, verdict(finding.value, entry["confirms"]))]
    if finding.corrected is not None and not finding.corrected <= EXACT:
        complaints.append(f"the corrected formula is off by {finding.corrected:.2g}")
    return "; ".join(filter(None, complaints))


def judge_in_nature(values: Mapping[str, float], claim: Mapping[str, Any]) -> str:
    """Why the recorded verdict on a statement in nature no longer holds; empty if it does.

    It stands if it is true for both losses, fails if it is false for both, and otherwise depends
    on the loss. `values` has what the claim's check finds with each loss.

    >>> claim = {"verdict": "fails", "confirms": {"at_most": 0.01}}
    >>> judge_in_nature({"viscous": 0.15, "plastic": 0.25}, claim)
    ''
    >>> judge_in_nature({"viscous": 0.0, "plastic": 0.25}, claim)
    'recorded as fails, found depends on the loss'
    """
    truths = {verdict(values[loss], claim["confirms"]) == CONFIRMED for loss in LOSSES}
    return _complaint(claim, DEPENDS if len(truths) > 1 else STANDS if truths == {True} else FAILS)


def _complaint(recorded: Mapping[str, Any], supported: str) -> str:
    """That a recorded verdict is another one; empty if it is not."""
    known = recorded["verdict"]
    return "" if supported == known else f"recorded as {known}, found {supported}"
