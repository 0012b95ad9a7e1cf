"""The ledger of the paper: its entries, checked, and the table of what running them found."""

import ast
from collections import Counter
from pathlib import Path

import reference_data
import yaml

CHECKS = Path(__file__).parents[2] / "src/planarimpact/ledger"
COLUMNS = [
    "kind", "entry", "holds", "verdict", "where", "says", "test", "found", "confirms", "between",
    "corrected", "problem", "reading", "range", "correction", "derivation", "why",
]  # fmt: skip


def load(path, schema):
    """Entries of a ledger, `{name: entry}`, each with its `kind` (equation or sentence).

    Raises
    ------
    SourceError
        Naming file, field, value and what is allowed.
    """
    try:
        ledger = yaml.safe_load(Path(path).read_text(encoding="utf-8"))
    except (OSError, yaml.YAMLError) as error:
        raise reference_data.SourceError(f"{path}: {error}") from None
    reference_data.refuse_invalid(ledger, schema, path)
    entries, known = {}, checks()
    for kind in ("equations", "sentences"):
        for name, entry in ledger[kind].items():
            where = f"{path}: {kind}.{name}"
            if name in entries:
                raise reference_data.SourceError(f"{where}: the name is taken by an equation")
            if entry.get("check", next(iter(known))) not in known:
                raise reference_data.SourceError(
                    f"{where}.check: '{entry['check']}' is no function of planarimpact.ledger"
                )
            low, high = entry.get("between", (0, 0))
            if low > high:
                raise reference_data.SourceError(
                    f"{where}.between = {entry['between']}: the first number must be the smaller"
                )
            entries[name] = {"kind": kind[:-1], **entry}
    return entries


def checks():
    """Checks of planarimpact.ledger: `{module.function: first line of its docstring}`."""
    found = {}
    for file in sorted(CHECKS.glob("*.py")):
        for node in ast.parse(file.read_text(encoding="utf-8")).body:
            if isinstance(node, ast.FunctionDef) and _is_check(node):
                words = " ".join((ast.get_docstring(node) or "").split())
                found[f"{file.stem}.{node.name}"] = words
    return found


def _is_check(node):
    arguments = node.args
    return not node.name.startswith("_") and not (arguments.args or arguments.kwonlyargs)


def failing(rows):
    """Rows whose recorded verdict no longer holds."""
    return [row for row in rows if row["holds"] == "no"]


def summary(rows):
    """Lines for a terminal: counts, and each entry that no longer holds with its reason."""
    counts = Counter(row["verdict"] for row in rows)
    bad = failing(rows)
    words = ", ".join(f"{count} {verdict}" for verdict, count in counts.items())
    lines = [f"ledger of the paper: {words}; {len(bad)} no longer hold"]
    for row in bad:
        lines.append(f"  no longer holds: {row['entry']} ({row['where']}): {row['problem']}")
    return "\n".join(lines)
