"""The verdicts of a run as one table with a row for each comparison."""

from collections import Counter
from collections.abc import Iterable, Sequence
from enum import StrEnum

from stronge1994 import tables
from stronge1994.tables import Row

COLUMNS = [
    "figure", "comparison", "question", "verdict", "reference", "points", "chi^2",
    "degrees of freedom", "degrees of sigma", "p", "rms [sigma]", "max [sigma]",
    "rms [axis units]", "max [axis units]", "unit", "curve", "model", "found", "stated", "allowed",
    "regression", "note", "reason",
]  # fmt: skip
LEDGER = "ledger: "  # a note that begins so names an entry of the ledger


class Verdict(StrEnum):
    """The outcome of one comparison, worst first; only WRONG and DIVERGES fail a run.

    RIGHT and WRONG answer the question whether our curve is solved right, which our own second
    codes and laws decide; AGREES and DIVERGES are kept for the paper and for others. UNCHANGED is
    the verdict of a check against an earlier result of this repository, or against points that the
    curve was fitted to. It guards against accidents and is evidence of nothing. INCONCLUSIVE does
    not count as evidence either: published points agree with the curve, but would also agree if
    they lay `judging.verdicts.VISIBLE_SHIFT` sigmas beside it. A known difference is EXPLAINED; or
    its cause is not known; or it is UNTESTED, because the reference does not state how much its
    values scatter.

    >>> print(Verdict.EXPLAINED)
    explained difference
    """

    WRONG = "wrong"
    DIVERGES = "diverges"
    UNEXPLAINED = "unexplained difference"
    UNTESTED = "untested difference"
    EXPLAINED = "explained difference"
    AWAITED = "awaited"
    INCONCLUSIVE = "inconclusive"
    AGREES = "agrees"
    RIGHT = "right"
    UNCHANGED = "as before"

    @property
    def fails(self) -> bool:
        """Whether it fails a run."""
        return self in (Verdict.WRONG, Verdict.DIVERGES)

    @property
    def differs(self) -> bool:
        """Whether it is that of a known difference."""
        return self in (Verdict.UNEXPLAINED, Verdict.UNTESTED, Verdict.EXPLAINED)


class Question(StrEnum):
    """The question that a comparison answers.

    SOLVED: is the curve that of our model? PRINTED: do the model and the paper state the same?
    OTHERS: what do measurements and other authors find?
    """

    SOLVED = "solved right"
    PRINTED = "as printed"
    OTHERS = "beside others"

    @property
    def failed(self) -> Verdict:
        """The verdict of a comparison that fails."""
        return Verdict.WRONG if self == Question.SOLVED else Verdict.DIVERGES


def fails(row: Row) -> bool:
    """Whether a row fails a run."""
    return Verdict(row["verdict"]).fails


def gather(paths: Iterable[str]) -> list[Row]:
    """Rows of several tables."""
    return [row for path in paths for row in tables.read_rows(path, COLUMNS)]


def why(row: Row) -> str:
    """Why a row fails: its bound, or with a documented difference that it was to stay as before."""
    found, bound = measured(row), row["allowed"]
    if row["regression"]:
        bound = f"a difference, and as before {row['regression']}"
    limits = f"{found}; allowed is {bound}" if found else ""
    return ": ".join(part for part in (row["note"], limits) if part)


def text(rows: Sequence[Row]) -> str:
    """The rows of one figure for a terminal."""
    from tabulate import tabulate  # no job needs it

    cells = [[row["comparison"], measured(row), row["verdict"]] for row in rows]
    table = tabulate(cells, ["comparison", "measured", "verdict"], disable_numparse=True)
    return "\n".join(line.rstrip() for line in table.splitlines())


def counts(rows: Sequence[Row]) -> str:
    """How many rows have each verdict, in one line for each question.

    >>> print(counts([{"question": "as printed", "verdict": "agrees"}]))
    as printed: 1 agrees
    """
    numbers = Counter((row["question"], row["verdict"]) for row in rows)
    lines = []
    for question in Question:
        parts = [
            f"{numbers[question, verdict]} {verdict.removesuffix(' difference')}"
            for verdict in Verdict
            if numbers[question, verdict]
        ]
        lines += [f"{question}: {', '.join(parts)}"] if parts else []
    return "\n".join(lines)


def measured(row: Row) -> str:
    """How large the distance of a row is."""
    if row["found"]:
        return f"{row['found']} (stated {row['stated']})"
    if row["p"]:
        return f"chi^2 {row['chi^2']} of {row['degrees of freedom']}, p = {row['p']}"
    if row["points"] and row["question"] == Question.PRINTED:  # sigma is that of a printed formula
        return f"rms {row['rms [axis units]']}, max {row['max [axis units]']} {row['unit']}"
    return f"rms {row['rms [sigma]']}, max {row['max [sigma]']} sigma" if row["points"] else ""
