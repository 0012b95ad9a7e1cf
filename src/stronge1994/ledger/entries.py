"""The entries of the ledger; those that cannot be run are refused before any work."""

import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any, TypeAlias

from stronge1994 import ledger, reference_data
from stronge1994.ledger.finding import MODELS

Entry: TypeAlias = dict[str, Any]

# A number that a text quotes: a check of `nature`, model and format, `{duration.viscous:.2f}`.
NUMBER = re.compile(r"\{([^{}]+)\.([a-z_]+):?([^{}]*)\}")
REFERENCE = re.compile(r"\bsee ([a-z0-9]+(?:-[a-z0-9.]*[a-z0-9])+)")


def load(path: str | Path, schema: Mapping[str, Any]) -> dict[str, Entry]:
    """Entries of a ledger, `{name: entry}`, with defaults filled in.

    Each has its `kind` (equation or sentence). A wrong one has also `because`, the text of its
    cause. A `fact` of the source.yaml beside the ledger is replaced by its value and tolerance. A
    `SourceError` names file, field and value.
    """
    read = reference_data.load_yaml(path)
    reference_data.refuse_invalid(read, schema, path)
    facts = reference_data.load_yaml(Path(path).with_name("source.yaml")).get("facts", {})
    entries: dict[str, Entry] = {}
    for kind in ("equations", "sentences"):
        for name, entry in read[kind].items():
            where = f"{path}: {kind}.{name}"
            if name in entries:
                raise reference_data.SourceError(f"{where}: the name is taken by an equation")
            _refuse_unknown_checks(where, entry)
            entries[name] = {"kind": kind[:-1], **_with_fact(where, entry, facts)}
    _explain(path, entries, read["causes"])
    for name, entry in entries.items():
        for other in REFERENCE.findall(" ".join(map(str, entry.values()))):
            if other not in entries:
                raise reference_data.SourceError(f"{path}: {name}: {f'see {other}'!a} is no entry")
    return entries


def _refuse_unknown_checks(where: str, entry: Entry) -> None:
    claim = entry.get("in_nature", {"says": ""})
    checks = [entry["check"]] if "check" in entry else []
    try:
        for check in [*checks, *(f"nature.{name}" for name in needed(claim))]:
            ledger.called(check)
    except (LookupError, TypeError) as error:
        raise reference_data.SourceError(f"{where}: {error}") from None
    for _, model, _ in NUMBER.findall(claim["says"]):
        if model not in MODELS:
            raise reference_data.SourceError(f"{where}: {model!a} is no model")


def _with_fact(where: str, entry: Entry, facts: Mapping[str, Mapping[str, Any]]) -> Entry:
    """An entry with value and tolerance in place of the fact that it names."""
    name = entry.get("confirms", {}).get("fact")
    if name is None:
        return entry
    fact = facts.get(name, {})
    if not {"value", "tolerance"} <= set(fact):
        raise reference_data.SourceError(
            f"{where}.confirms.fact = {name!a}: source.yaml has no such fact with value and "
            "tolerance"
        )
    return entry | {"confirms": {"value": fact["value"], "rounding": fact["tolerance"]}}


def _explain(path: str | Path, entries: dict[str, Entry], causes: Mapping[str, str]) -> None:
    """Add to wrong entries the text of their cause; refuse unknown causes, and unused ones."""
    for name, entry in entries.items():
        if "cause" in entry:
            if entry["cause"] not in causes:
                raise reference_data.SourceError(
                    f"{path}: {name}.cause = {entry['cause']!a}: allowed are the causes at the "
                    f"head: {', '.join(causes)}"
                )
            entry["because"] = causes[entry["cause"]]
    for cause in set(causes) - {entry.get("cause") for entry in entries.values()}:
        raise reference_data.SourceError(f"{path}: causes.{cause}: no entry has this cause")


def needed(claim: Mapping[str, Any]) -> list[str]:
    """Checks of `nature` that decide a claim, or whose numbers its text quotes.

    >>> needed({"check": "duration", "says": "{reversal(0.5).viscous:.2f} mu v2(0)"})
    ['duration', 'reversal(0.5)']
    """
    names = [claim["check"]] if "check" in claim else []
    return names + [check for check, _, _ in NUMBER.findall(claim["says"])]
