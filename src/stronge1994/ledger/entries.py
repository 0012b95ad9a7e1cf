"""The entries of the ledger; those that cannot be run are refused before any work."""

import re
import string
from collections.abc import Mapping
from pathlib import Path
from typing import Any, TypeAlias

from stronge1994 import ledger, reference_data
from stronge1994.ledger.finding import MODELS

Entry: TypeAlias = dict[str, Any]

REFERENCE = re.compile(r"\bsee ([a-z0-9]+(?:-[a-z0-9.]*[a-z0-9])+)")


def load(path: str | Path, schema: Mapping[str, Any]) -> dict[str, Entry]:
    """Entries of a ledger, `{name: entry}`, with defaults filled in.

    Each has its `kind` (equation or sentence). A wrong one has also `because`, the text of its
    cause. A `fact` of the source.yaml beside the ledger is replaced by its value and tolerance. A
    `SourceError` names file, field and value. What contradicts itself otherwise, such as bounds
    in the wrong order, no longer holds when it is run.
    """
    read = reference_data.load_yaml(path)
    reference_data.refuse_invalid(read, schema, path)
    entries: dict[str, Entry] = {}
    facts = _facts(path)
    for kind in ("equations", "sentences"):
        for name, entry in read[kind].items():
            where = f"{path}: {kind}.{name}"
            if name in entries:
                raise reference_data.SourceError(f"{where}: the name is taken by an equation")
            _refuse_unknown_checks(where, entry)
            entries[name] = {"kind": kind[:-1], **_with_fact(where, entry, facts)}
    _explain(path, entries, read["causes"])
    for name, entry in entries.items():
        texts = entry | {"in_nature": entry.get("in_nature", {}).get("says")}
        for key, text in texts.items():
            _refuse_dangling(f"{path}: {name}.{key}", text, entries)
    return entries


def _facts(path: str | Path) -> dict[str, dict[str, float]]:
    """Stated values of the source.yaml beside a ledger, with tolerances: `{name: confirms}`."""
    facts = reference_data.load_yaml(Path(path).with_name("source.yaml")).get("facts", {})
    return {
        name: {"value": fact["value"], "rounding": fact["tolerance"]}
        for name, fact in facts.items()
        if {"value", "tolerance"} <= set(fact)
    }


def _with_fact(where: str, entry: Entry, facts: Mapping[str, dict[str, float]]) -> Entry:
    """An entry with value and tolerance in place of the fact that it names."""
    name = entry.get("confirms", {}).get("fact")
    if name is None:
        return entry
    if name not in facts:
        raise reference_data.SourceError(
            f"{where}.confirms.fact = '{name}': allowed are the facts of source.yaml with value "
            f"and tolerance: {', '.join(facts)}"
        )
    return entry | {"confirms": facts[name]}


def _explain(path: str | Path, entries: dict[str, Entry], causes: Mapping[str, str]) -> None:
    """Add to wrong entries the text of their cause; refuse unknown causes, and unused ones."""
    for name, entry in entries.items():
        if "cause" in entry:
            if entry["cause"] not in causes:
                raise reference_data.SourceError(
                    f"{path}: {name}.cause = '{entry['cause']}': allowed are the causes at the "
                    f"head: {', '.join(causes)}"
                )
            entry["because"] = causes[entry["cause"]]
    for cause in set(causes) - {entry.get("cause") for entry in entries.values()}:
        raise reference_data.SourceError(f"{path}: causes.{cause}: no entry has this cause")


def _refuse_unknown_checks(where: str, entry: Entry) -> None:
    claim = entry.get("in_nature", {})
    asked = {
        ".check": [entry["check"]] if "check" in entry else [],
        ".in_nature.check": [f"nature.{claim['check']}"] if "check" in claim else [],
        ".in_nature.says": [".".join(("nature", *n)) for n in numbers_in(claim.get("says", ""))],
    }
    known = {*ledger.checks(), *(f"{name}.{m}" for name in ledger.checks() for m in MODELS)}
    for field, names in asked.items():
        for name in names:
            if name not in known:
                raise reference_data.SourceError(
                    f"{where}{field}: '{name}' is no function of stronge1994.ledger"
                )


def numbers_in(text: str) -> list[tuple[str, str]]:
    """Checks of `nature`, each with its model, of which a text asks for the number.

    >>> numbers_in("{peak_spread.viscous:.2f} mu v2(0)")
    [('peak_spread', 'viscous')]
    """
    fields = [name for _, name, _, _ in string.Formatter().parse(text) if name is not None]
    return [(name, model) for name, _, model in (field.partition(".") for field in fields)]


def is_run(entry: Entry) -> bool:
    """Whether a run tests something of an entry: a verdict by the equations, or one in nature."""
    return "check" in entry or "check" in entry.get("in_nature", {})


def _refuse_dangling(where: str, text: Any, entries: dict[str, Entry]) -> None:
    for name in REFERENCE.findall(text) if isinstance(text, str) else ():
        if name not in entries:
            raise reference_data.SourceError(f"{where}: 'see {name}': there is no such entry")
