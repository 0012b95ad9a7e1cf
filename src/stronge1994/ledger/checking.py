"""Run every entry of the ledger against the paper's model: one row for each entry.

This never fails: an entry whose check crashes no longer holds, with the reason in `problem`.
"""

import traceback
from collections.abc import Mapping

from stronge1994 import ledger
from stronge1994.csv_tables import Row
from stronge1994.ledger import entries, in_nature, outcome
from stronge1994.ledger.entries import Entry
from stronge1994.ledger.in_nature import Values


def check(every: Mapping[str, Entry], measured: Mapping[str, Values] | None = None) -> list[Row]:
    """Rows of the ledger's table, one for each entry, in the order of the ledger.

    `measured` is what `measure` returns; without it the measures are taken here.
    """
    tests = entries.checks()
    measured = measure(every) if measured is None else measured
    return [
        _with_nature(_row(name, entry, tests.get(entry.get("check", ""), "")), entry, measured)
        for name, entry in every.items()
    ]


def measure(every: Mapping[str, Entry]) -> dict[str, Values]:
    """Values of the measures that the claims in nature need; nan where a measure crashes."""
    claims = [entry["in_nature"] for entry in every.values() if "in_nature" in entry]
    values = {}
    for name in in_nature.needed(claims):
        try:
            values[name] = in_nature.measure(name)
        except Exception:
            traceback.print_exc()
            values[name] = in_nature.NOTHING
    return values


def _row(name: str, entry: Entry, test: str) -> Row:
    row = dict.fromkeys(outcome.COLUMNS, "")
    same = set(entry) - {"confirms", "holds", "between", "in_nature"}
    row |= {key: entry[key] for key in row if key in same}
    row |= {"entry": name, "test": test, "range": entry.get("holds", "")}
    if "check" not in entry:
        return row
    row["confirms"] = _criterion(entry["confirms"])
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
        "found": f"{finding.value:.6g}",
        "corrected": corrected,
        "problem": judgement.why,
    }


def _with_nature(row: Row, entry: Entry, measured: Mapping[str, Values]) -> Row:
    """A row with the verdict in nature; the entry holds if each of its verdicts holds."""
    if "in_nature" not in entry:
        return row
    claim = entry["in_nature"]
    row = row | in_nature.cells(claim, _criterion(claim.get("confirms", {})), measured)
    judgement = in_nature.judge(claim, measured)
    if "check" in claim and judgement.holds:
        return row | {"holds": row["holds"] or "yes"}
    if judgement.holds:
        return row
    problems = [row["problem"], judgement.why]
    return row | {"holds": "no", "problem": "; ".join(filter(None, problems))}


def _criterion(confirms: Mapping[str, float]) -> str:
    """When a statement counts as true, as a text."""
    if "value" in confirms:
        return f"{confirms['value']:g} within {confirms['rounding']:g}"
    if not confirms:
        return ""
    (bound_kind, bound), *_ = confirms.items()
    return f"{bound_kind.replace('_', ' ')} {bound:g}"
