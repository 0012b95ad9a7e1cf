"""The accepted table, data/accepted/verdicts.csv: what somebody has looked at and found right.

A verdict says what a comparison found. Whether a run passes is another question, which this table
answers: a row must be as it was when a person accepted it. Then a known difference can neither grow
nor shrink unseen. `snakemake accept` writes the table; its changes are read in a diff of git.
"""

import math
from collections.abc import Iterator, Sequence

from stronge1994 import ledger_table, tables, verdict_table
from stronge1994.tables import Row, with_unit
from stronge1994.verdict_table import Verdict, Why

PATH = "data/accepted/verdicts.csv"
COLUMNS = ["name", "verdict", "why", "size", "unit", "points"]
# Sizes of other machines are alike up to this share of the larger, or up to this rounding.
SHARE, ROUNDING = 1e-3, 1e-12
ACCEPT = """\
Left of an arrow stands what was accepted, right of it what this run found.
To accept that: snakemake --cores 2 accept"""


def read(path: str = PATH) -> list[Row]:
    """Rows of the accepted table; a size that is no number is a `ValueError`."""
    rows = tables.read_rows(path, COLUMNS)
    for line, row in enumerate(rows, 2):
        try:
            float(row["size"] or 0)
        except ValueError:
            problem = f"{row['size']!a} is no number; was the table edited by hand?"
            raise ValueError(f"{path}, line {line}, column 'size': {problem}") from None
    return rows


def of_run(verdicts: Sequence[Row], ledger: Sequence[Row]) -> list[Row]:
    """Rows of the accepted table, from the tables of a run.

    The size of a comparison is its root mean square distance, that of a stated fact the value
    found. A law has a limit of its own, so neither size nor points stand here. Of an entry of the
    ledger it is the number found.

    >>> row = dict.fromkeys(COLUMNS, "") | {"comparison": "fig6-rebound", "size": "3.1e-16"}
    >>> of_run([row], [])[0]["size"]
    '0'
    """
    found = [{**row, "name": row["comparison"]} for row in verdicts]
    found += [
        {"name": row["entry"], "verdict": row["verdict"], "size": row["found"]} for row in ledger
    ]
    own = [{column: row.get(column, "") for column in COLUMNS} for row in found]
    for row in own:
        row["points"] = row["points"] if row["size"] else ""
        row["size"] = "0" if row["size"] and abs(float(row["size"])) < ROUNDING else row["size"]
    return own


def changes(verdicts: Sequence[Row], ledger: Sequence[Row], accepted: Sequence[Row]) -> list[str]:
    """Rows that are not as accepted, a line for each, but for those that fail.

    A comparison that nobody has accepted must not differ, nor one whose points were still awaited.
    Each entry of the ledger must have been accepted.
    Of a figure that has other settings nothing can be told: the gate says so by itself.

    >>> was = dict.fromkeys(COLUMNS, "") | {"name": "a", "verdict": "differs", "size": "1.5"}
    >>> now = was | {"figure": "fig6", "comparison": "a", "size": "1.6"}
    >>> changes([now], [], [was])
    ['changed: a: size 1.5 -> 1.6']
    """
    known = _known(accepted)
    full = {row["comparison"]: row for row in verdicts}
    others = {row["figure"] for row in verdicts if row["why"] == Why.SETTINGS}
    verdicts = [row for row in verdicts if row["figure"] not in others]
    ledger = [row for row in ledger if row["holds"] != "no"]
    told = []
    for row in of_run(verdicts, ledger):
        if row["verdict"] == Verdict.FAILS:
            continue
        if row["name"] in known:
            if changed := "; ".join(_changed(known[row["name"]], row)):
                told.append(f"changed: {row['name']}: {changed}")
        elif row["verdict"] == Verdict.DIFFERS:
            what = f"{row['name']}: {verdict_table.problem(full[row['name']])}"
            told.append(f"differs, and nobody has accepted it: {what}")
        elif row["name"] not in full:
            told.append(f"new, and nobody has accepted it: {row['name']}: {row['verdict']}")
    return told


def new(verdicts: Sequence[Row], accepted: Sequence[Row]) -> list[str]:
    """Names of comparisons that are made, fail no run, and that nobody has accepted yet.

    >>> new([{"comparison": "a", "verdict": "agrees"}], [])
    ['a']
    """
    known, others = _known(accepted), (Verdict.FAILS, Verdict.DIFFERS, Verdict.NOT_COMPARED)
    made = [row["comparison"] for row in verdicts if row["verdict"] not in others]
    return [name for name in made if name not in known]


def _known(accepted: Sequence[Row]) -> dict[str, Row]:
    """Accepted rows by name, but for those whose points were still awaited."""
    return {row["name"]: row for row in accepted if row["why"] != Why.AWAITED}


def _changed(was: Row, now: Row) -> Iterator[str]:
    """What of a row is not as accepted, in words."""
    before, after = map(verdict_table.outcome, (was, now))
    if before != after:
        yield f"{before} -> {after}"
    if was["points"] != now["points"]:
        yield f"points {was['points'] or 'none'} -> {now['points'] or 'none'}"
    sizes = [row["size"] and with_unit(float(row["size"]), row["unit"]) for row in (was, now)]
    if not _alike(was["size"], now["size"]) or was["unit"] != now["unit"]:
        yield f"size {sizes[0] or 'none'} -> {sizes[1] or 'none'}"


def _alike(was: str, now: str) -> bool:
    if was and now:
        return math.isclose(float(was), float(now), rel_tol=SHARE, abs_tol=ROUNDING)
    return was == now


def refused(verdicts: Sequence[Row], ledger: Sequence[Row]) -> list[str]:
    """Names of rows that nobody can accept: they fail, or are of a run with other settings."""
    bad = [row for row in verdicts if row["verdict"] == Verdict.FAILS or row["why"] == Why.SETTINGS]
    return [row["comparison"] for row in bad] + [
        row["entry"] for row in ledger_table.failing(ledger)
    ]


def write(verdicts: Sequence[Row], ledger: Sequence[Row]) -> None:
    """Accept what a run has found, if none of its rows is `refused`."""
    if bad := refused(verdicts, ledger):
        raise ValueError(
            f"{len(bad)} rows cannot be accepted, as they fail or are not compared with these "
            f"settings: {', '.join(bad[:4])}"
        )
    tables.write_rows(PATH, of_run(verdicts, ledger), COLUMNS)
