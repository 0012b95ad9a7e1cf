"""Run every entry of the ledger: one row for each entry, and the numbers in nature.

This never fails: an entry whose check crashes no longer holds, with the reason in `problem`.
"""

import traceback
from collections.abc import Mapping
from typing import Any, TypeAlias

import numpy as np

from stronge1994 import ledger
from stronge1994.ledger import entries, finding, outcome
from stronge1994.ledger.entries import Entry
from stronge1994.ledger.finding import MODELS
from stronge1994.tables import Row

# What the checks of `nature` find, by check, written as a call, and model.
Measured: TypeAlias = dict[str, dict[str, float]]


def measure(every: Mapping[str, Entry]) -> Measured:
    """What the checks find that the claims in nature need; nan where one crashes."""
    claims = [entry["in_nature"] for entry in every.values() if "in_nature" in entry]
    names = [name for claim in claims for name in entries.needed(claim)]
    return {name: _of_models(name) for name in dict.fromkeys(names)}


def _of_models(name: str) -> dict[str, float]:
    try:
        return {model: ledger.run(f"nature.{name}", model=model).value for model in MODELS}
    except Exception:
        traceback.print_exc()
        return dict.fromkeys(MODELS, np.nan)


def check(every: Mapping[str, Entry], measured: Measured | None = None) -> list[Row]:
    """Rows of the ledger's table, one for each entry, in the order of the ledger.

    `measured` is what `measure` returns; without it the checks of `nature` are run here.
    """
    measured = measure(every) if measured is None else measured
    return [_with_nature(_row(name, entry), entry, measured) for name, entry in every.items()]


def _row(name: str, entry: Entry) -> Row:
    row = dict.fromkeys(outcome.COLUMNS, "")
    same = set(entry) - {"confirms", "holds", "in_nature"}
    row |= {key: entry[key] for key in row if key in same}
    row |= {"entry": name, "range": entry.get("holds", "")}
    if "check" not in entry:
        return row
    row["test"] = ledger.docstring(entry["check"])
    row["confirms"] = _criterion(entry["confirms"])
    try:
        found = ledger.run(entry["check"])
        problem = finding.judge(found, entry)
    except Exception as error:
        traceback.print_exc()
        return row | {"holds": "no", "problem": f"{type(error).__name__}: {error}"}
    return row | {
        "holds": "no" if problem else "yes",
        "found": f"{found.value:.6g}",
        "corrected": "" if found.corrected is None else f"{found.corrected:.2g}",
        "problem": problem,
    }


def _with_nature(row: Row, entry: Entry, measured: Measured) -> Row:
    """A row with the verdict in nature; the entry holds if each of its verdicts holds."""
    if "in_nature" not in entry:
        return row
    claim = entry["in_nature"]
    says = entries.NUMBER.sub(lambda n: format(measured[n[1]][n[2]], n[3]), claim["says"])
    row |= {"in_nature": claim["verdict"], "nature": says}
    problem = judge(claim, measured)
    if "check" in claim:
        values = measured[claim["check"]]
        row |= {
            "holds": row["holds"] or "yes",
            "nature_test": ledger.docstring(f"nature.{claim['check']}"),
            "nature_true_if": _criterion(claim["confirms"]),
            "nature_found": ", ".join(
                f"{model.replace('_', ' ')} {value:.3g}" for model, value in values.items()
            ),
        }
    if problem:
        row |= {"holds": "no", "problem": "; ".join(filter(None, [row["problem"], problem]))}
    return row


def judge(claim: Mapping[str, Any], measured: Measured) -> str:
    """Why the recorded verdict on a claim in nature no longer holds; empty if it does."""
    found = {name: list(measured[name].values()) for name in entries.needed(claim)}
    crashed = [name for name, values in found.items() if not np.isfinite(values).all()]
    if crashed:
        return f"in nature: {', '.join(crashed)} found no number"
    if "check" not in claim:
        return ""
    problem = finding.judge_in_nature(measured[claim["check"]], claim)
    return f"in nature: {problem}" if problem else ""


def _criterion(confirms: Mapping[str, float]) -> str:
    """When a statement counts as true, as a text."""
    if "value" in confirms:
        return f"{confirms['value']:g} within {confirms['rounding']:g}"
    (bound_kind, bound), *_ = confirms.items()
    return f"{bound_kind.replace('_', ' ')} {bound:g}"


def table_of(measured: Measured) -> list[Row]:
    """Rows of the table of what the checks of `nature` find, by `outcome.OF_NATURE`."""
    return [
        {"measure": name, "what": ledger.docstring(f"nature.{name}")}
        | {model: f"{value:.12g}" for model, value in values.items()}
        for name, values in measured.items()
    ]
