"""Stronge (1994), equation by equation and sentence by sentence: the ledger of the paper.

Each entry stands beside its check, which compares one statement of the paper, as printed, with the
paper's own model and returns a number. The model is solved to rounding by `planarimpact.lumped`:
"exact" means that solution, not nature. How an entry is made says `entry.entry`. `SECTIONS` follow
the paper; `words` has symbols and causes, `contact` solves. What is printed stands in the check, or
as a function `eq_...` beside it if several checks use it, or in `stronge1994.printed` if figures
draw it. A run checks every entry (`checking`), and fails if a recorded verdict no longer holds, in
either direction.
"""

from collections.abc import Mapping
from dataclasses import replace
from importlib import import_module
from typing import Any

from stronge1994.ledger_table import EntryError
from stronge1994.paper.entry import LEDGER, REFERENCE, Entry
from stronge1994.paper.words import CAUSES, SYMBOLS

__all__ = ["CAUSES", "SECTIONS", "SYMBOLS", "Entry", "EntryError", "entries"]

# Each module has the entries of one section, and imports none of a later one.
SECTIONS = (
    "introduction", "dynamics", "slip", "rebound", "peak_force", "dissipation", "conclusions",
)  # fmt: skip


def entries(facts: Mapping[str, Mapping[str, Any]]) -> dict[str, Entry]:
    """All entries by their names: first equations, then sentences, each in the order of the paper.

    `facts` are those of data/stronge1994/source.yaml, `{name: {"value": ..., "tolerance": ...}}`.
    An `EntryError` names an entry that cannot be checked.
    """
    ordered = sorted(LEDGER.values(), key=lambda it: it.kind)
    for unused in sorted(set(CAUSES) - {it.words.get("cause") for it in ordered}):
        raise EntryError(f"causes.{unused}: no entry has this cause")
    for it in ordered:
        if not it.check and it.criterion:
            raise EntryError(f"{it.name}: no check stands below it")
        for other in REFERENCE.findall(" ".join([it.says, *it.words.values()])):
            if other not in LEDGER:
                raise EntryError(f"{it.name}: {f'see {other}'!a} is no entry")
    return {it.name: _with_fact(it, facts) for it in ordered}


def _with_fact(it: Entry, facts: Mapping[str, Mapping[str, Any]]) -> Entry:
    """An entry with value and tolerance in place of the fact that it names."""
    if "fact" not in it.criterion:
        return it
    fact = facts.get(it.criterion["fact"], {})
    if not {"value", "tolerance"} <= set(fact):
        raise EntryError(
            f"{it.name}: fact = {it.criterion['fact']!a}: data/stronge1994/source.yaml has no such "
            "fact with value and tolerance"
        )
    return replace(it, criterion={"value": fact["value"], "rounding": fact["tolerance"]})


# An entry is made when its module is imported.
for section in SECTIONS:
    import_module(f"stronge1994.paper.{section}")
