"""The verdicts of a run as one table, the worst first, for files and for the terminal."""

from collections import Counter
from collections.abc import Iterable, Sequence
from pathlib import Path

from tabulate import tabulate

from stronge1994 import csv_tables
from stronge1994.csv_tables import Row

COLUMNS = [
    "figure", "comparison", "verdict", "evidence", "reference", "points", "chi^2",
    "degrees of freedom", "degrees of sigma", "p", "rms [sigma]", "max [sigma]",
    "rms [axis units]", "found", "stated", "allowed", "regression", "note", "reason",
]  # fmt: skip
DIFFERENCES = ["unexplained difference", "untested difference", "explained difference"]
ORDER = ["diverges", *DIFFERENCES, "awaited", "inconclusive", "agrees", "as before"]


def gather(paths: Iterable[str]) -> list[Row]:
    """Rows of several tables, the worst verdict first; an unknown one before all others.

    In place of a table that was not made stands one row that diverges.
    """
    rows = [row for path in paths for row in _rows(path)]
    rank = {verdict: place for place, verdict in enumerate(ORDER)}
    return sorted(rows, key=lambda row: rank.get(row["verdict"], -1))


def _rows(path: str) -> list[Row]:
    try:
        return csv_tables.read_rows(path, COLUMNS)
    except csv_tables.Failed as error:
        name = Path(path).stem
        cells = {"figure": name, "comparison": f"{name}-solved", "verdict": "diverges"}
        return [dict.fromkeys(COLUMNS, "") | cells | {"note": f"{error}"}]


def failing(rows: Iterable[Row]) -> list[Row]:
    """Rows that fail a run."""
    return [row for row in rows if row["verdict"] == "diverges"]


def why(row: Row) -> str:
    """Why a row fails."""
    measured = _measured(row)
    limits = f"{measured}; allowed is {_allowed(row)}" if measured else ""
    return ": ".join(part for part in (row["note"], limits) if part)


def _allowed(row: Row) -> str:
    """The bound of a row; with a documented difference, that it stays as before."""
    if not row["regression"]:
        return row["allowed"]
    return f"a difference, and as before {row['regression']}"


def text(rows: Sequence[Row]) -> str:
    """The table for a terminal, and how many rows have each verdict."""
    cells = [
        [row["verdict"], row["comparison"], _measured(row), _allowed(row), row["note"]]
        for row in rows
    ]
    counts = Counter(row["verdict"] for row in rows)
    headers = ["verdict", "comparison", "measured", "allowed", "note"]
    table = tabulate(cells, headers, disable_numparse=True)
    table = "\n".join(line.rstrip() for line in table.splitlines())
    return f"{table}\n\n" + ", ".join(f"{counts[v]} {v}" for v in ORDER if counts[v])


def _measured(row: Row) -> str:
    if row["found"]:
        return f"{row['found']} (stated {row['stated']})"
    if row["p"]:
        return f"chi^2 {row['chi^2']} of {row['degrees of freedom']}, p = {row['p']}"
    return f"rms {row['rms [sigma]']}, max {row['max [sigma]']}" if row["points"] else ""
