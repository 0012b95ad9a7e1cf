"""A scene in many tables: one is solved at a time, then all are counted together."""

import json
import shutil
from collections import Counter
from collections.abc import Sequence
from pathlib import Path

from planarimpact.scene import files
from stronge1994 import csv_tables

ALL = "all"  # in the place of a table's name: the line with the sums
UNFINISHED = "unfinished"  # folder beside that of the results
COUNTS = ("rows", "bad_rows")


def solve(
    table: str, result: str, account: str, tolerance: float, loss: str | None, skip_bad: bool
) -> None:
    """Solve one table, and write an account of it.

    The account is JSON: `rows`, how many the table has; `bad`, `[[row, problem], ...]` of those
    left out; `models`, how many impacts each took; `assumed`, whether a loss was taken that nobody
    gave. All else is as in `planarimpact.scene.files.solve`, its errors too.
    """
    # A job that is killed leaves a part of its result, and each job a list of bad rows, which its
    # account has too. Neither may lie among the results.
    unfinished = Path(result).parents[1] / UNFINISHED / Path(result).name
    unfinished.parent.mkdir(exist_ok=True)
    solver = files.solve(table, unfinished, tolerance, skip_bad, loss=loss)
    models: Counter[str] = Counter()
    for (rung, _), count in solver.report().taken.items():
        models[rung.name] += count
    found = {
        "rows": solver.rows,
        "bad": solver.bad,
        "models": models,
        "assumed": solver.assumed,
    }
    Path(account).write_text(json.dumps(found), encoding="utf-8")
    unfinished.replace(result)
    print(solver.explain())


def gather(results: Sequence[str], accounts: Sequence[str], summary: str, bad_rows: str) -> None:
    """Count all tables together, and list all bad rows.

    The results and the accounts have the same order. The summary has a line for each table and one
    for all of them: rows, bad rows, how many impacts each model took, and whether a loss was
    assumed. The list of bad rows has table, row and problem.
    """
    parts = {
        Path(result).name: json.loads(Path(account).read_text(encoding="utf-8"))
        for result, account in zip(results, accounts, strict=True)
    }
    total = {
        "rows": sum(part["rows"] for part in parts.values()),
        "bad": [[name, *row] for name, part in parts.items() for row in part["bad"]],
        "models": sum((Counter(part["models"]) for part in parts.values()), Counter()),
        "assumed": any(part["assumed"] for part in parts.values()),
    }
    models = [model for model, _ in total["models"].most_common()]
    lines = [
        [
            name,
            part["rows"],
            len(part["bad"]),
            *(part["models"].get(model, 0) for model in models),
            "yes" if part["assumed"] else "no",
        ]
        for name, part in {**parts, ALL: total}.items()
    ]
    csv_tables.write_rows(summary, ["table", *COUNTS, *models, "loss_assumed"], lines)
    csv_tables.write_rows(bad_rows, ["table", "row", "problem"], total["bad"])
    shutil.rmtree(Path(summary).parent / UNFINISHED, ignore_errors=True)


def words(summary: str) -> str:
    """What a summary says of all tables: a line for the rows, and one for each model."""
    *tables, total = csv_tables.read_rows(summary)
    assumed = total.pop("loss_assumed") == "yes"
    del total["table"]
    rows, bad = (int(total.pop(count)) for count in COUNTS)
    lines = [f"{len(tables)} tables, {rows} rows, {bad} of them bad and left out"]
    lines += [f"{count:>12}  {model}" for model, count in total.items()]
    return "\n".join(lines + ([files.ASSUMED] if assumed else []))
