"""The verdicts of a run as one table with a row for each comparison."""

import textwrap
from collections.abc import Iterable, Sequence
from enum import StrEnum

from stronge1994 import tables
from stronge1994.tables import Row, with_unit

WIDTH = 80  # of a terminal
# Texts that may hold a comma stand last.
COLUMNS = [
    "figure", "comparison", "group", "verdict", "why", "points", "size", "rms", "max", "unit",
    "chi^2", "degrees of freedom", "degrees of sigma", "p", "would fail", "rms [sigma]",
    "max [sigma]", "found", "stated", "column", "entry", "reference", "model",
    "curve", "says", "allowed", "note", "reason",
]  # fmt: skip


class Verdict(StrEnum):
    """What a comparison found, worst first; whether a run passes is asked by the `gate`.

    DIFFERS is a difference from the paper or from others, and `Why` says what is known of it. FAILS
    is a check of our solver that has left its tolerance, or what cannot be compared. CANNOT_TELL is
    no evidence: published points would also agree with a curve that is a tenth too large, or their
    p is between agreement and difference, see `judging.verdicts`. CANNOT_JUDGE stands where an
    error of the points is not published: the distance is a number without a verdict. PASSED is a
    check of our solver by our own second codes, by 40 digits or by a law; such a check never agrees
    with anything.
    """

    FAILS = "FAILS"
    DIFFERS = "differs"
    CANNOT_TELL = "cannot tell"
    CANNOT_JUDGE = "cannot be judged"
    NOT_COMPARED = "not compared"
    AGREES = "agrees"
    PASSED = "passed"


class Why(StrEnum):
    """What is known of a difference, or why there is no comparison."""

    UNKNOWN = "cause unknown"
    KNOWN = "cause known"
    AWAITED = "points awaited"
    SETTINGS = "other settings"


class Group(StrEnum):
    """With what a curve is compared.

    These are statements of the paper, its printed curves, others, or our own second codes.
    """

    PAPER = "paper"
    PRINTED = "printed figure"
    OTHERS = "others"
    SOLVER = "solver checked"


def gather(paths: Iterable[str]) -> list[Row]:
    """Rows of several tables."""
    return [row for path in paths for row in tables.read_rows(path, COLUMNS)]


def outcome(row: Row) -> str:
    """The verdict of a row, and why.

    >>> outcome({"verdict": "differs", "why": "cause unknown"})
    'differs, cause unknown'
    """
    return ", ".join(part for part in (row["verdict"], row["why"]) if part)


def measured(row: Row) -> str:
    """How large the distance of a row is, in the unit of its axis, and of how many points."""
    if row["found"]:
        return f"{row['found']}, stated {row['stated']}" if row["stated"] else row["found"]
    if not row["points"]:
        return ""
    size = f"rms {row['rms']}, max {with_unit(float(row['max']), row['unit'])}"
    sigmas = f" (rms {row['rms [sigma]']} sigma)" if row["p"] else ""
    count = f"{row['points']} point" + ("" if row["points"] == "1" else "s")
    return f"{size}{sigmas}; {count}"


def chance(row: Row) -> str:
    """The test of published points; it says so where their sigma itself is an estimate.

    >>> row = {"chi^2": "242", "degrees of freedom": "5", "degrees of sigma": "4", "p": "0.0011"}
    >>> chance(row)
    'F test, sigma as good as from 4 values: p = 0.0011'
    """
    if not row["p"]:
        return ""
    if row["degrees of sigma"]:
        values = f"{row['degrees of sigma']} values"
        return f"F test, sigma as good as from {values}: p = {row['p']}"
    degrees, points = row["degrees of freedom"], row["points"]
    of = f"{degrees} points" if degrees == points else f"{degrees} degrees of freedom"
    return f"chi^2 {row['chi^2']} of {of}: p = {row['p']}"


def noticed(row: Row) -> str:
    """Which error of the curve a comparison would have found that found none.

    >>> noticed({"verdict": "agrees", "would fail": "a curve 2 % larger"})
    'a curve 2 % larger would have failed'
    """
    found_none = row["verdict"] in (Verdict.AGREES, Verdict.CANNOT_TELL)
    return f"{row['would fail']} would have failed" if found_none and row["would fail"] else ""


def problem(row: Row) -> str:
    """Why a row differs or fails: what was found, and what is allowed."""
    found = "; ".join(part for part in (measured(row), chance(row)) if part)
    limits = f"{found}; allowed is {row['allowed']}" if found else ""
    return ": ".join(part for part in (row["note"], limits) if part)


def text(rows: Sequence[Row]) -> str:
    """The rows of one figure for a terminal."""
    told = []
    for row in rows:
        of = (
            f"{row['reference']} and the curve {row['curve']}" if row["curve"] else row["reference"]
        )
        asked = f"to agree: {row['allowed']}" if row["p"] else ""
        of = of if row["reference"] else ""
        parts = [measured(row), of, chance(row), asked, noticed(row), row["why"], row["entry"]]
        told += lines(row["verdict"], row["comparison"], parts)
    return "\n".join(told)


def lines(verdict: str, name: str, parts: Iterable[str]) -> list[str]:
    """A verdict, and of whom or what it says what, in lines for a terminal of 80 columns.

    >>> lines("agrees", "Maw 1976", ["4 points", ""])
    [' agrees           Maw 1976: 4 points']
    """
    width = max(map(len, Verdict))
    told = f" {verdict:<{width}} {name}: {'; '.join(part for part in parts if part)}"
    return textwrap.wrap(told, WIDTH, subsequent_indent=" " * (width + 2), break_on_hyphens=False)
