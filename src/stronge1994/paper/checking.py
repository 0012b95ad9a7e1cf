"""Check every entry of the ledger: one row for each.

This never fails: an entry whose check crashes no longer holds, with the reason in `problem`.
"""

import traceback
from collections.abc import Iterable

from stronge1994 import ledger_table
from stronge1994.formulas import mathematical
from stronge1994.paper.entry import Entry
from stronge1994.paper.words import CAUSES
from stronge1994.tables import Row


def check(entries: Iterable[Entry]) -> list[Row]:
    """Rows of the ledger's table, by `ledger_table.COLUMNS`, in the order of the entries."""
    return [_row(entry) | _outcome(entry) for entry in entries]


def _row(entry: Entry) -> Row:
    """What an entry says."""
    row = dict.fromkeys(ledger_table.COLUMNS, "") | dict(entry.words)
    row |= {"range": row.pop("holds"), "because": CAUSES.get(row["cause"], ""), "holds": ""}
    row |= {"entry": entry.name, "kind": entry.kind, "where": entry.where, "says": entry.says}
    row |= {"verdict": entry.verdict, "test": entry.test, "code": entry.code}
    row["confirms"] = entry.criterion_in_words
    return row


def _outcome(entry: Entry) -> Row:
    """What its check finds, if it has one; an entry whose formulas cannot be set does not hold."""
    try:
        for text in (entry.says, entry.test, *entry.words.values()):
            mathematical(text)
        if not entry.check:
            return {}
        found = entry.run()
        problem = entry.judge(found)
        values = entry.values(found.value) if entry.values else ("", "")
    except Exception as error:
        traceback.print_exc()
        return {"holds": "no", "problem": f"{type(error).__name__}: {error}"}
    return {
        "printed": values[0],
        "by model": values[1],
        "holds": "no" if problem else "yes",
        "found": f"{found.value:.6g}",
        "corrected": "" if found.corrected is None else f"{found.corrected:.2g}",
        "problem": problem,
    }
