"""Run every entry of the ledger against the exact solver: one row for each entry.

This never fails: an entry whose check crashes no longer holds, with the reason in `problem`.
"""

import traceback
from collections.abc import Mapping

from stronge1994 import ledger
from stronge1994.csv_tables import Row
from stronge1994.ledger import entries, outcome
from stronge1994.ledger.entries import Entry


def check(every: Mapping[str, Entry]) -> list[Row]:
    """Rows of the ledger's table, one for each entry, in the order of the ledger."""
    tests = entries.checks()
    return [
        _row(name, entry, tests.get(entry.get("check", ""), "")) for name, entry in every.items()
    ]


def _row(name: str, entry: Entry, test: str) -> Row:
    row = dict.fromkeys(outcome.COLUMNS, "")
    row |= {key: entry[key] for key in row if key in entry and key not in ("confirms", "holds")}
    row |= {"entry": name, "test": test, "range": entry.get("holds", "")}
    if "check" not in entry:
        return row
    row["confirms"] = _words(entry["confirms"])
    row["between"] = " to ".join(f"{bound:g}" for bound in entry.get("between", []))
    try:
        finding = ledger.run(entry["check"])
        judgement = ledger.judge(finding, entry)
    except Exception as error:
        traceback.print_exc()
        return row | {"holds": "no", "problem": f"{type(error).__name__}: {error}"}
    corrected = "" if finding.corrected is None else f"{finding.corrected:.2g}"
    return row | {
        "holds": "yes" if judgement.holds else "no",
        "found": f"{finding.found:.6g}",
        "corrected": corrected,
        "problem": judgement.why,
    }


def _words(confirms: Mapping[str, float]) -> str:
    if "value" in confirms:
        return f"{confirms['value']:g} within {confirms['rounding']:g}"
    (word, bound), *_ = confirms.items()
    return f"{word.replace('_', ' ')} {bound:g}"
