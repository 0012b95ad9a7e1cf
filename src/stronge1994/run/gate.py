"""Decide whether a run is good: files are as their jobs left them, and no table has a fault."""

from collections.abc import Collection, Iterable, Mapping, Sequence
from pathlib import Path

from stronge1994 import csv_tables
from stronge1994.csv_tables import Row
from stronge1994.run import record
from stronge1994.verdict_tables import verdict_table

TABLES = ("results/verdicts.csv", "results/ledger.csv")
PROBLEMS, REPORT = "results/problems.csv", "figures/report.html"


def faults_of_one(made: Iterable[str], table: str, comparisons: Mapping[str, bool]) -> list[str]:
    """Why one figure or scene must not pass, by the table of its verdicts, and the files `made`."""
    made = list(made)
    if messages := record.faults(made):
        return messages
    verdicts, comparisons = _rows(table, comparisons)
    return record.errors(made) + faults_of_tables(verdicts, [], comparisons, {}, table)


def faults(
    made: Iterable[str], comparisons: Mapping[str, bool], entries: Mapping[str, bool]
) -> list[str]:
    """Why the run must not pass, one line for each fault; `made` is every file of the run."""
    made = list(made)
    messages = record.faults(made)
    if messages:  # rows of a changed table prove nothing
        return messages
    # After a failed job the report lacks what the job should have made. Its own problems are errors
    # of its job.
    messages = record.errors(made) or [
        *faults_of_report(REPORT, comparisons),
        *(f"report: {row['problem']}" for row in _rows(PROBLEMS)[0]),
    ]
    (verdicts, comparisons), (ledger, entries) = map(_rows, TABLES, (comparisons, entries))
    return messages + faults_of_tables(verdicts, ledger, comparisons, entries)


def _rows(path: str, expected: Mapping[str, bool] = {}) -> tuple[list[Row], Mapping[str, bool]]:
    """Rows of a table and those that it must have; none if its job failed: `record.errors`."""
    try:
        return csv_tables.read_rows(path), expected
    except csv_tables.Failed:
        return [], {}


def faults_of_tables(
    verdicts: Sequence[Row],
    ledger: Sequence[Row],
    comparisons: Mapping[str, bool],
    entries: Mapping[str, bool],
    table: str = TABLES[0],
) -> list[str]:
    """Why a run must not pass, by its tables, one line for each fault; `table` is the first one.

    `comparisons` and `entries` name every row that the tables of verdicts and of the ledger must
    have. They say of a comparison whether its reference is awaited, and of an entry whether a run
    tests it.

    >>> row = {"comparison": "fig6-rebound", "verdict": "agrees"}
    >>> faults_of_tables([row], [], {"fig6-rebound": False, "fig6-printed": False}, {})
    ['results/verdicts.csv: 0 rows of fig6-printed where 1 belongs']
    """
    messages = _miscounted(table, "comparison", verdicts, comparisons)
    messages += _miscounted(TABLES[1], "entry", ledger, entries)
    for row in verdicts:
        name, verdict = row.get("comparison", ""), row.get("verdict")
        if verdict in verdict_table.FAILS:
            messages.append(f"{verdict}: {name}: {verdict_table.why(row)}")
        elif verdict not in verdict_table.ORDER or (verdict == "awaited") != comparisons.get(name):
            messages.append(f"{table}: {name} = {verdict!a} cannot be")
    for row in ledger:
        name, holds = row.get("entry", ""), row.get("holds")
        if holds == "no":
            messages.append(f"no longer holds: {name}: {row.get('problem')}")
        elif holds != ("yes" if entries.get(name) else ""):
            messages.append(f"{TABLES[1]}: {name}, holds = {holds!a} cannot be")
    return messages


def _miscounted(
    table: str, column: str, rows: Iterable[Row], expected: Collection[str]
) -> list[str]:
    names = [row.get(column) for row in rows]
    return [
        f"{table}: {names.count(name)} rows of {name} where {int(name in expected)} belongs"
        for name in dict.fromkeys([*expected, *names])
        if names.count(name) != (name in expected)
    ]


def faults_of_report(page: str, comparisons: Mapping[str, bool]) -> list[str]:
    """Comparisons that the report does not show, one line for each."""
    text = Path(page).read_text(encoding="utf-8")
    return [
        f"{page}: it does not show {name}" for name in comparisons if f'id="{name}"' not in text
    ]
