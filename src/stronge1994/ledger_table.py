"""The table of the ledger's results: its columns and its summary."""

import textwrap
from collections import Counter
from collections.abc import Sequence

from stronge1994.tables import Row

VERDICTS = ("confirmed", "confirmed within rounding", "wrong", "not testable")
CONFIRMED, ROUNDED, WRONG, NOT_TESTABLE = VERDICTS
# Grades of wrong entries, the gravest first, each with a text to stand after its number.
GRADES = {
    "changes a result": "change a result",
    "sign or misprint": "are signs or misprints (perhaps the scan's)",
    "matter of judgement": "are matters of judgement",
}
COLUMNS = [
    "kind", "entry", "holds", "verdict", "only_if", "grade", "cause", "where", "says", "test",
    "found", "confirms", "corrected", "problem", "reading", "range", "correction",
    "derivation", "because", "why", "code", "quantity", "printed", "by model",
]  # fmt: skip


class EntryError(Exception):
    """An entry that is not complete, or contradicts itself; the message names it."""


def failing(rows: Sequence[Row]) -> list[Row]:
    """Rows whose recorded verdict no longer holds."""
    return [row for row in rows if row["holds"] == "no"]


def grades(rows: Sequence[Row]) -> dict[str, int]:
    """How many wrong entries have each grade, the gravest first: `{grade: number}`."""
    counts = Counter(row.get("grade") for row in rows)
    return {grade: counts[grade] for grade in GRADES if counts[grade]}


def sentence_of_grades(rows: Sequence[Row]) -> str:
    """The numbers of `grades` as a part of a sentence.

    >>> sentence_of_grades([{"grade": "changes a result"}, {"grade": ""}])
    '1 change a result'
    """
    return ", ".join(f"{count} {GRADES[grade]}" for grade, count in grades(rows).items())


def conditional(rows: Sequence[Row]) -> int:
    """How many entries are right only under a condition that the paper does not ask for."""
    return sum(bool(row.get("only_if")) for row in rows)


def summary(rows: Sequence[Row]) -> str:
    """Lines for a terminal: counts, and each entry that no longer holds with its reason."""
    counts = Counter(row["verdict"] for row in rows)
    bad, under, graded = failing(rows), conditional(rows), sentence_of_grades(rows)
    asides = {
        "confirmed": f", {under} of them only under a condition" if under else "",
        "wrong": f" ({graded})" if graded else "",
    }
    parts = [f"{count} {verdict}{asides.get(verdict, '')}" for verdict, count in counts.items()]
    told = "; ".join([*parts, f"{len(bad)} no longer hold"])
    head = f"{len(rows)} equations and sentences of the paper"
    lines = textwrap.wrap(f"{head}: {told}", 79, subsequent_indent="  ")
    for row in bad:
        lines.append(f"  no longer holds: {row['entry']} ({row['where']}): {row['problem']}")
    return "\n".join(lines)
