"""An entry of the ledger: where the paper says what, and beside it the check that decides it.

>>> from stronge1994.paper import entry
>>> @entry.entry("two-squared", "p. 440, Eq. 0", "The square of 2 is 4")
... def two_squared():
...     '''The square of 2, less 4.'''
...     return 2.0**2 - 4
>>> added = entry.LEDGER.pop("two-squared")  # no entry of the paper
>>> added.test, added.run(), added.judge(added.run())
('The square of 2, less 4.', Finding(value=0.0, corrected=None), '')
"""

import inspect
import re
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, replace
from typing import Any, NamedTuple, TypeVar

import numpy as np

from planarimpact.common.arrays import ArrayLike
from stronge1994.ledger_table import (
    CONFIRMED,
    GRADES,
    NOT_TESTABLE,
    ROUNDED,
    VERDICTS,
    WRONG,
    EntryError,
)
from stronge1994.paper.words import CAUSES

# Numbers nearer than this are equal. It leaves room for the rounding of a few hundred operations,
# and for the error of quadrature.
EXACT = 1e-9

CHANGES = next(iter(GRADES))
VIEWS = ("velocity", "forces", "energy")
EQUATION = re.compile(r"(eq|formula|table)-")
REFERENCE = re.compile(r"\bsee ([a-z0-9]+(?:-[a-z0-9.]*[a-z0-9])+)")

_Check = TypeVar("_Check", bound=Callable[..., Any])


class Finding(NamedTuple):
    """What a run of a check finds.

    For an equation `value` is the largest distance of the printed formula from the paper's model
    among the samples, in the unit that the check names; between the samples it may be larger. For a
    sentence it is the number that decides it. `corrected` is the same for the corrected formula,
    where the printed one is wrong.
    """

    value: float
    corrected: float | None = None


@dataclass(frozen=True)
class Entry:
    """One equation, or one sentence that can be checked. `entry` says what each field holds."""

    name: str
    where: str
    says: str
    kind: str
    verdict: str
    criterion: Mapping[str, Any]
    words: Mapping[str, str]
    explorer: Mapping[str, Any] | None
    given: Mapping[str, Any]
    check: Callable[..., Finding] | None = None
    values: Callable[[float], tuple[str, str]] | None = None
    test: str = ""
    code: str = ""  # where the check is

    @property
    def criterion_in_words(self) -> str:
        """When the statement counts as true."""
        if not self.check:
            return ""
        if "value" in self.criterion:
            return f"{self.criterion['value']:g} within {self.criterion['rounding']:g}"
        ((kind, bound),) = self.criterion.items()
        return f"{kind.replace('_', ' ')} {bound:g}"

    def run(self) -> Finding:
        """What the check finds."""
        return self.check(**self.given) if self.check else Finding(np.nan)

    def judge(self, found: Finding) -> str:
        """Why the recorded verdict no longer holds; empty if it does.

        Where there is a corrected formula it must be exact.
        """
        if np.isnan(found.value):
            return "it found no number"
        supported = verdict(found.value, self.criterion)
        complaints = []
        if supported != self.verdict:
            complaints.append(f"recorded as {self.verdict}, found {supported}")
        if found.corrected is not None and not found.corrected <= EXACT:
            complaints.append(f"the corrected formula is off by {found.corrected:.2g}")
        return "; ".join(complaints)


def verdict(value: float, criterion: Mapping[str, float]) -> str:
    """Verdict that a number supports, by `at_most`, by `at_least`, or by `value` and `rounding`.

    >>> verdict(1.7007, {"value": 1.7, "rounding": 0.05})
    'confirmed within rounding'
    >>> verdict(0.2, {"at_most": 0.05})
    'wrong'
    """
    if "value" in criterion:
        gap = abs(value - criterion["value"])
        return CONFIRMED if gap <= EXACT else ROUNDED if gap <= criterion["rounding"] else WRONG
    above = "at_least" in criterion
    good = value >= criterion["at_least"] if above else value <= criterion["at_most"]
    return CONFIRMED if good else WRONG


LEDGER: dict[str, Entry] = {}


def entry(
    name: str,
    where: str,
    says: str,
    *,
    verdict: str = CONFIRMED,
    at: Callable[[], Iterable[Any]] | None = None,
    given: Mapping[str, Any] | None = None,
    at_most: float | None = None,
    at_least: float | None = None,
    value: float | None = None,
    rounding: float | None = None,
    fact: str | None = None,
    kind: str | None = None,
    explorer: Mapping[str, Any] | None = None,
    values: Callable[[float], tuple[str, str]] | None = None,
    **words: str,
) -> Callable[[_Check], _Check]:
    """Enter a statement of the paper into the ledger, with the function that checks it.

    Parameters
    ----------
    name : str
        Its name; it begins with eq-, formula- or table- if it is an equation, as `kind` may say
        otherwise.
    where : str
        Page of the paper, and equation or heading and sentence. A sentence is counted from a
        heading, from an equation or from the top of a page, because our copy does not show where
        paragraphs begin. A caption is counted without the words "FIG. 2."
    says : str
        What stands there, in our words and the `SYMBOLS` of `words`. Every text is understood
        without the others: it names the entry, equation or number that it speaks of.
    verdict : str
        As recorded: confirmed, confirmed within rounding, wrong, or not testable. A run fails if
        the check no longer supports it, in either direction. An entry that is not testable has no
        check: the call alone enters it.
    at : callable, optional
        Returns the places at which the check compares, one at a time. A check that yields finds the
        largest of all that it yields. One that returns gives the distance of the printed formula,
        of several readings of which the one that comes nearest counts, and of the corrected one.
        Without places the check returns the number.
    given : dict, optional
        Arguments of the check, which stand in braces in its docstring.
    at_most, at_least, value, rounding, fact : float, str, optional
        The statement is true if the number is at most or at least this, or `value` within
        `rounding` (half a unit of the last figure stated, or what the words leave open). A `fact`
        of data/stronge1994/source.yaml has value and tolerance. If none is given, the number is at
        most `EXACT`.
    explorer : dict, optional
        An impact of the paper's sphere that shows it, and the view of the explorer.
    values : callable, optional
        Where a result is changed: takes the number found, and returns what the paper prints and
        what its model gives, in the words of a terminal. `quantity` says of what.
    **words : str
        reading (what our copy, a scanned text, or the sentence leaves open: which reading is
        judged, and what another one would change); holds (where the statement is right
        nevertheless, or what bounds it); only_if (of what is confirmed: a condition that the paper
        does not ask for where `where` points, to stand behind "right only if"); why (not testable).
        For what is wrong: correction, derivation, cause (one of `CAUSES`), quantity if a result is
        changed (of what the `values` are), and grade, how much
        hangs on it. "changes a result": a limit, a formula or a number that a reader would take
        from the paper is another one, under every fair reading; an angle that the paper places is
        one, if more than 5 deg off. "sign or misprint": one sign, digit or word, perhaps lost or
        garbled by the scan; the paper has it right elsewhere, or asks for it. "matter of
        judgement": approximate words, or a sentence that stands under another fair reading.

    Returns
    -------
    record : callable
        It takes the check and returns it as it is. Several entries may share one check. Its
        docstring says against what it compares.

    Raises
    ------
    EntryError
        If the entry is not complete, or contradicts itself.

    Notes
    -----
    Texts have LaTeX between dollars; `stronge1994.formulas` sets it. Our copy is a scan. A sign,
    root or factor that it has lost is read as the rest of the paper asks. Of readings that are
    equally near the one by which the paper is right is judged; where another fair one, less near,
    would make a wrong entry right, `reading` names it and the grade is not "changes a result".
    Where the verdict "wrong" would hang on one character of the scan, it is "not testable". Of the
    figures our copy has captions and scattered labels, no curve: an entry may say what the text
    says of a figure, not what the figure shows.
    """
    bounds = {"at_most": at_most, "at_least": at_least, "value": value, "rounding": rounding}
    criterion = {key: bound for key, bound in {**bounds, "fact": fact}.items() if bound is not None}
    is_equation = kind == "equation" if kind else EQUATION.match(name)
    made = Entry(
        name,
        where,
        says,
        "equation" if is_equation else "sentence",
        verdict,
        criterion or ({} if verdict == NOT_TESTABLE else {"at_most": EXACT}),
        words,
        explorer,
        given or {},
        values=values,
    )
    for fault in _faults(made, criterion):
        raise EntryError(f"{name}: {fault}")
    LEDGER[name] = made

    def record(check: _Check) -> _Check:
        test = " ".join((inspect.getdoc(check) or "").split())
        code = f"{check.__module__.replace('.', '/')}.py: {check.__name__}"
        if made.verdict == NOT_TESTABLE:
            raise EntryError(f"{name}: an entry that is not testable has no check, as {code}")
        if not test:
            raise EntryError(f"{name}: {code} has no docstring: against what does it compare?")
        for key, argument in made.given.items():
            test = test.replace(f"{{{key}}}", str(argument).strip("[]"))
        LEDGER[name] = replace(made, check=finding_of(check, at), test=test, code=f"src/{code}")
        return check

    return record


def _faults(made: Entry, criterion: Mapping[str, Any]) -> Iterable[str]:
    """What is wrong with an entry."""
    of_wrong = {"correction", "derivation", "cause", "grade"}
    changed = {"quantity"} if made.words.get("grade") == CHANGES else set()
    allowed = {
        NOT_TESTABLE: {"why", "reading", "holds"},
        WRONG: {*of_wrong, *changed, "reading", "holds"},
    }.get(made.verdict, {"only_if", "reading", "holds"})
    needed = {NOT_TESTABLE: {"why"}, WRONG: of_wrong}.get(made.verdict, set())
    if made.verdict == WRONG:
        needed = needed | (changed or {"reading"})
    if made.name in LEDGER:
        yield "the name is taken"
    if not re.fullmatch(r"[a-z][a-z0-9.-]*", made.name):
        yield "a name has small letters, digits, dots and hyphens"
    if not re.match(r"pp?[.] [0-9]", made.where):
        yield f"where is {made.where!r}: it begins with a page, such as p. 440"
    for key, value, values in (
        ("verdict", made.verdict, VERDICTS),
        ("grade", made.words.get("grade", CHANGES), GRADES),
        ("cause", made.words.get("cause", next(iter(CAUSES))), CAUSES),
        ("view", (made.explorer or {"view": VIEWS[0]})["view"], VIEWS),
    ):
        if value not in values:
            yield f"{key} is {value!r}: allowed are {', '.join(values)}"
    for key in sorted(needed - set(made.words)):
        yield f"no {key}: {made.verdict!r} needs it"
    for key in sorted(set(made.words) - allowed):
        if key not in {*of_wrong, "quantity", "only_if", "why"}:
            yield f"{key}: `entry` takes no such argument"
        yield f"{key}: allowed beside {made.verdict!r} are {', '.join(sorted(allowed))}"
    if bool(changed) != bool(made.values):
        yield f"values: allowed and needed beside the grade {CHANGES!r}"
    if made.verdict == NOT_TESTABLE and criterion:
        yield f"{next(iter(criterion))}: an entry that is not testable has no check"
    if set(criterion) not in (set(), {"value", "rounding"}) and not (
        len(criterion) == 1 and not {"value", "rounding"} & set(criterion)
    ):
        yield "allowed is one of at_most, at_least, fact, or value with rounding"
    if not all(np.isfinite(b) for b in criterion.values() if not isinstance(b, str)):
        yield "a bound is a finite number"


def finding_of(
    check: Callable[..., Any], at: Callable[[], Iterable[Any]] | None
) -> Callable[..., Finding]:
    """The check as a function that returns a `Finding`, whatever it is like: see `entry`."""

    def found(**given: Any) -> Finding:
        if at is None:
            return Finding(float(check(**given)))
        if inspect.isgeneratorfunction(check):
            return Finding(largest(gap for place in at() for gap in check(place, **given)))
        printed, corrected = zip(*(check(place, **given) for place in at()), strict=True)
        return Finding(float(np.min(np.max(np.abs(printed), axis=0))), largest(corrected))

    return found


def largest(values: Iterable[ArrayLike]) -> float:
    """Largest absolute value of numbers and arrays; nan stays nan.

    >>> largest([np.array([1.0, -3.0]), 2.0])
    3.0
    """
    return float(np.max([np.max(np.abs(value), initial=0) for value in values]))
