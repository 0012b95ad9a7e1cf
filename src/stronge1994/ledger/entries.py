"""The entries of the ledger; those that cannot be run are refused before any work."""

import ast
import re
from collections.abc import Collection, Mapping
from pathlib import Path
from typing import Any, TypeAlias

from stronge1994 import reference_data
from stronge1994.ledger import in_nature

Entry: TypeAlias = dict[str, Any]

PACKAGE = Path(__file__).parent
# These modules hold the checks.
MODULES = ("dynamics", "slip", "rebound", "peak_force", "dissipation")
KINDS = ({"at_most"}, {"at_least"}, {"value", "rounding"}, {"fact"})
REFERENCE = re.compile(r"\bsee ([a-z0-9]+(?:-[a-z0-9.]*[a-z0-9])+)")


def load(path: str | Path, schema: Mapping[str, Any]) -> dict[str, Entry]:
    """Entries of a ledger, `{name: entry}`, with defaults filled in.

    Each has its `kind` (equation or sentence). A wrong one has also `because`, the text of its
    cause. A `fact` of the source.yaml beside the ledger is replaced by its value and tolerance. A
    `SourceError` names file, field, value and what is allowed.
    """
    ledger = reference_data.load_yaml(path)
    reference_data.refuse_invalid(ledger, schema, path)
    entries, known, facts = {}, checks(), _facts(path)
    for kind in ("equations", "sentences"):
        for name, entry in ledger[kind].items():
            where = f"{path}: {kind}.{name}"
            if name in entries:
                raise reference_data.SourceError(f"{where}: the name is taken by an equation")
            _refuse_contradiction(where, entry, known)
            _refuse_unmeasured(f"{where}.in_nature", entry.get("in_nature"))
            entries[name] = {"kind": kind[:-1], **_with_fact(where, entry, facts)}
    _explain(path, entries, ledger["causes"])
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


def _refuse_contradiction(where: str, entry: Entry, known: Collection[str]) -> None:
    """Refuse an entry whose fields do not go together."""
    problem = None
    if entry["verdict"] == "not testable":
        if {"check", "confirms", "between"} & set(entry):
            problem = ".verdict = 'not testable' goes with a `why` alone, without check or bounds"
    elif entry["check"] not in known:
        problem = f".check: '{entry['check']}' is no function of stronge1994.ledger"
    elif set(entry["confirms"]) not in KINDS:
        problem = (
            f".confirms = {entry['confirms']}: allowed are at_most, or at_least, or value with "
            "rounding, or fact"
        )
    elif entry["verdict"] == "confirmed within rounding" and not (
        {"value", "fact"} & set(entry["confirms"])
    ):
        problem = f".confirms = {entry['confirms']}: rounding is that of a `value`"
    elif "between" in entry and entry["between"][0] > entry["between"][1]:
        problem = f".between = {entry['between']}: the first number must be the smaller"
    if problem:
        raise reference_data.SourceError(where + problem)


def _refuse_unmeasured(where: str, claim: Mapping[str, Any] | None) -> None:
    """Refuse a verdict in nature without a measure, or with bounds that cannot be met."""
    if claim is None:
        return
    problem = None
    unknown = in_nature.unknown_numbers(claim["says"])
    if unknown:
        problem = f".says: '{unknown[0]}' is no measure of stronge1994.ledger.nature with a model"
    elif "check" in claim and claim["check"] not in in_nature.measures():
        problem = f".check: '{claim['check']}' is no measure of stronge1994.ledger.nature"
    elif len(claim.get("confirms", {"": 0})) != 1:
        problem = f".confirms = {claim['confirms']}: allowed are at_most, or at_least"
    for loss, (low, high) in claim.get("between", {}).items():
        if low > high:
            problem = f".between.{loss} = [{low}, {high}]: the first number must be the smaller"
    if problem:
        raise reference_data.SourceError(where + problem)


def is_run(entry: Entry) -> bool:
    """Whether a run tests something of an entry: a verdict by the equations, or one in nature."""
    return "check" in entry or "check" in entry.get("in_nature", {})


def _refuse_dangling(where: str, text: Any, entries: dict[str, Entry]) -> None:
    for name in REFERENCE.findall(text) if isinstance(text, str) else ():
        if name not in entries:
            raise reference_data.SourceError(f"{where}: 'see {name}': there is no such entry")


def checks() -> dict[str, str]:
    """All checks of this room: `{module.function: its docstring in one line}`."""
    docstrings = {}
    for module in MODULES:
        for node in ast.parse((PACKAGE / f"{module}.py").read_text(encoding="utf-8")).body:
            if isinstance(node, ast.FunctionDef) and _is_check(node):
                docstring = " ".join((ast.get_docstring(node) or "").split())
                docstrings[f"{module}.{node.name}"] = docstring
    return docstrings


def _is_check(node: ast.FunctionDef) -> bool:
    arguments = node.args
    return not node.name.startswith("_") and not (arguments.args or arguments.kwonlyargs)
