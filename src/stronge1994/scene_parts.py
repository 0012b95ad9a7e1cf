"""A scene in many tables: one is solved at a time, then all are counted together."""

import json
import re
import shutil
from collections import Counter
from collections.abc import Sequence
from pathlib import Path

from planarimpact.scene import files
from stronge1994 import csv_tables

ALL = "all"  # in the place of a table's name: the line with the sums
UNFINISHED = "unfinished"  # folder beside that of the results
COUNTS = ("rows", "bad_rows")
# A line of `Solver.explain` that says how many impacts a model took.
TAKEN = re.compile(r" *(\d+) {2}(\S+(?: \S+)*) {2,}\S.*")


def solve(
    table: str, result: str, account: str, tolerance: float, loss: str | None, skip_bad: bool
) -> None:
    """Solve one table, and write an account of it.

    Parameters
    ----------
    table, result : str
        As `source` and `target` of `planarimpact.scene.files.solve`.
    account : str
        JSON: `rows`, how many the table has; `bad`, `[[row, problem], ...]` of those left out;
        `models`, how many impacts each took; `assumed`, whether a loss was taken that nobody gave.
    tolerance, loss, skip_bad
        As there.

    Raises
    ------
    InputError, ConvergenceError
        As there.
    """
    # A job that is killed leaves a part of its result, and each job a list of bad rows, which its
    # account has too. Neither may lie among the results.
    unfinished = Path(result).parents[1] / UNFINISHED / Path(result).name
    unfinished.parent.mkdir(exist_ok=True)
    solver = files.solve(table, unfinished, tolerance, skip_bad, loss=loss)
    words = solver.explain()
    models: Counter[str] = Counter()
    for line in filter(None, map(TAKEN.fullmatch, words.splitlines())):
        models[line[2]] += int(line[1])
    if models.total() != solver.rows - len(solver.bad):
        raise RuntimeError(f"{models.total()} impacts counted where these belong: {words}")
    found = {
        "rows": solver.rows,
        "bad": solver.bad,
        "models": models,
        "assumed": solver.assumed,
    }
    Path(account).write_text(json.dumps(found), encoding="utf-8")
    unfinished.replace(result)
    print(words)


def gather(results: Sequence[str], accounts: Sequence[str], summary: str, bad_rows: str) -> None:
    """Count all tables together, and list all bad rows.

    Parameters
    ----------
    results, accounts : sequence of str
        Of each table, in the same order.
    summary : str
        A line for each table and one for all of them: rows, bad rows, how many impacts each model
        took, and whether a loss was assumed.
    bad_rows : str
        Table, row and problem.
    """
    names = [Path(result).name for result in results]
    parts = [json.loads(Path(account).read_text(encoding="utf-8")) for account in accounts]
    models: Counter[str] = Counter()
    for part in parts:
        models.update(part["models"])
    ordered = [model for model, _ in models.most_common()]

    def line(name: str, rows: int, bad: int, taken: Counter[str], assumed: bool) -> list[str | int]:
        return [name, rows, bad, *(taken[model] for model in ordered), "yes" if assumed else "no"]

    lines = [
        line(name, part["rows"], len(part["bad"]), Counter(part["models"]), part["assumed"])
        for name, part in zip(names, parts, strict=True)
    ]
    rows, bad = (sum(int(row[column]) for row in lines) for column in (1, 2))
    lines.append(line(ALL, rows, bad, models, any(part["assumed"] for part in parts)))
    csv_tables.write_rows(summary, ["table", *COUNTS, *ordered, "loss_assumed"], lines)
    listed = [
        [name, row, problem]
        for name, part in zip(names, parts, strict=True)
        for row, problem in part["bad"]
    ]
    csv_tables.write_rows(bad_rows, ["table", "row", "problem"], listed)
    shutil.rmtree(Path(summary).parent / UNFINISHED, ignore_errors=True)


def words(summary: str) -> str:
    """What a summary says of all tables together.

    Parameters
    ----------
    summary : str
        As `gather` writes it.

    Returns
    -------
    str
        A line for the rows, and one for each model.
    """
    *tables, total = csv_tables.read_rows(summary)
    assumed = total.pop("loss_assumed") == "yes"
    del total["table"]
    rows, bad = (int(total.pop(count)) for count in COUNTS)
    lines = [f"{len(tables)} tables, {rows} rows, {bad} of them bad and left out"]
    lines += [f"{count:>12}  {model}" for model, count in total.items()]
    return "\n".join(lines + ([files.ASSUMED] if assumed else []))
