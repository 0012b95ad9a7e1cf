"""The ledger of the paper: its entries, refused before any work where they cannot be run."""

import ast
import re
from pathlib import Path

import reference_data

PACKAGE = Path(__file__).parents[2] / "src/planarimpact/ledger"
MODULES = ("dynamics", "slip", "rebound", "peak_force", "dissipation")  # those that hold checks
KINDS = ({"at_most"}, {"at_least"}, {"value", "rounding"})
REFERENCE = re.compile(r"\bsee ([a-z0-9]+(?:-[a-z0-9.]*[a-z0-9])+)")


def load(path, schema):
    """Entries of a ledger, `{name: entry}`, each with its `kind` (equation or sentence).

    Raises
    ------
    SourceError
        Naming file, field, value and what is allowed.
    """
    ledger = reference_data.load_yaml(path)
    reference_data.refuse_invalid(ledger, schema, path)
    entries, known = {}, checks()
    for kind in ("equations", "sentences"):
        for name, entry in ledger[kind].items():
            where = f"{path}: {kind}.{name}"
            if name in entries:
                raise reference_data.SourceError(f"{where}: the name is taken by an equation")
            _refuse_contradiction(where, entry, known)
            entries[name] = {"kind": kind[:-1], **entry}
    for name, entry in entries.items():
        for key, text in entry.items():
            _refuse_dangling(f"{path}: {name}.{key}", text, entries)
    return entries


def _refuse_contradiction(where, entry, known):
    """Refuse an entry whose fields do not go together."""
    problem = None
    if entry["verdict"] == "not testable":
        if {"check", "confirms", "between"} & set(entry):
            problem = ".verdict = 'not testable' goes with a `why` alone, without check or bounds"
    elif entry["check"] not in known:
        problem = f".check: '{entry['check']}' is no function of planarimpact.ledger"
    elif set(entry["confirms"]) not in KINDS:
        problem = (
            f".confirms = {entry['confirms']}: allowed are at_most, or at_least, or value with "
            "rounding"
        )
    elif entry["verdict"] == "confirmed within rounding" and "value" not in entry["confirms"]:
        problem = f".confirms = {entry['confirms']}: rounding is that of a `value`"
    elif "between" in entry and entry["between"][0] > entry["between"][1]:
        problem = f".between = {entry['between']}: the first number must be the smaller"
    if problem:
        raise reference_data.SourceError(where + problem)


def _refuse_dangling(where, text, entries):
    for name in REFERENCE.findall(text) if isinstance(text, str) else ():
        if name not in entries:
            raise reference_data.SourceError(f"{where}: 'see {name}': there is no such entry")


def checks():
    """Checks of planarimpact.ledger: `{module.function: its docstring in one line}`."""
    found = {}
    for module in MODULES:
        for node in ast.parse((PACKAGE / f"{module}.py").read_text(encoding="utf-8")).body:
            if isinstance(node, ast.FunctionDef) and _is_check(node):
                words = " ".join((ast.get_docstring(node) or "").split())
                found[f"{module}.{node.name}"] = words
    return found


def _is_check(node):
    arguments = node.args
    return not node.name.startswith("_") and not (arguments.args or arguments.kwonlyargs)
