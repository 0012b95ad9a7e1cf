"""The second verdict of an entry, "in nature", by two continua.

One continuum loses its energy in a viscous material, the other in one that yields. A sentence
stands if it is true for both, and fails if it is false for both. If they disagree, it depends on
the loss. It is open where neither can decide. This verdict never changes that of the equations, nor
the reverse.
"""

import ast
import string
from collections.abc import Collection, Mapping, Sequence
from functools import cache
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from stronge1994.csv_tables import Row
from stronge1994.ledger import nature
from stronge1994.ledger.finding import CONFIRMED, Judgement, verdict
from stronge1994.ledger.nature_models import LOSSES, MODELS, model

STANDS, FAILS, DEPENDS, OPEN = "stands", "fails", "depends on the loss", "open"
VERDICTS = (STANDS, FAILS, DEPENDS, OPEN)
# Columns of the table of measures.
COLUMNS = ["measure", "what", *MODELS]


class Values(NamedTuple):
    """Values of one measure for each of `nature_models.MODELS`."""

    paper: float
    unloading_stiffness: float
    viscous: float
    plastic: float


NOTHING = Values(*[np.nan] * len(MODELS))


def measure(name: str) -> Values:
    """Values of a measure of `nature` for each model.

    >>> round(measure("limit_half").paper, 3)
    3.5
    """
    return Values(*(getattr(nature, name)(model(kind)) for kind in MODELS))


@cache
def measures() -> dict[str, str]:
    """All measures: `{name: its docstring in one line}`."""
    tree = ast.parse(Path(nature.__file__ or "").read_text(encoding="utf-8"))
    return {
        node.name: " ".join((ast.get_docstring(node) or "").split())
        for node in tree.body
        if isinstance(node, ast.FunctionDef) and not node.name.startswith("_")
    }


def unknown_numbers(text: str) -> list[str]:
    """Numbers that a text asks for, as `{measure.model:.2f}`, and that nothing measures.

    >>> unknown_numbers("{peak_spread.viscous:.2f} of {peak_spread.water} and {nothing}")
    ['peak_spread.water', 'nothing']
    """
    asked = [name for _, name, _, _ in string.Formatter().parse(text) if name is not None]
    known = {f"{measured}.{kind}" for measured in measures() for kind in MODELS}
    return [name for name in asked if name not in known]


def with_numbers(text: str, values: Mapping[str, Values]) -> str:
    """A text with the values of the measures that it names in braces.

    >>> with_numbers("by {peak_spread.viscous:.2f}", {"peak_spread": Values(0, 0.2, 0.123, 0.3)})
    'by 0.12'
    """
    return text.format_map(values)


def judge(claim: Mapping[str, Any], measured: Mapping[str, Values]) -> Judgement:
    """Judge whether the recorded verdict on a sentence in nature still holds.

    A claim has `says`, `verdict`, and unless it is open `check` and `confirms`; where the sentence
    does not stand also `between`, for each loss the bounds of the measured number.

    >>> claim = {"check": "duration", "says": "", "verdict": "fails", "confirms": {"at_most": 0.01},
    ...          "between": {"viscous": [0.1, 0.2], "plastic": [0.2, 0.3]}}
    >>> judge(claim, {"duration": Values(0.0, 0.2, 0.15, 0.25)}).holds
    True
    >>> print(judge(claim, {"duration": Values(0.0, 0.2, 0.0, 0.25)}).why)
    in nature: recorded as fails, found depends on the loss
    """
    not_finite = [name for name in needed([claim]) if not np.all(np.isfinite(measured[name]))]
    if not_finite:
        return Judgement("", False, f"in nature: {', '.join(not_finite)} found no number")
    if claim["verdict"] == OPEN:
        return Judgement(OPEN, True, "")
    values = {loss: getattr(measured[claim["check"]], loss) for loss in LOSSES}
    truths = {verdict(number, claim["confirms"]) == CONFIRMED for number in values.values()}
    supported = DEPENDS if len(truths) > 1 else STANDS if truths == {True} else FAILS
    complaints = []
    if supported != claim["verdict"]:
        complaints.append(f"recorded as {claim['verdict']}, found {supported}")
    for loss, number in values.items():
        low, high = claim.get("between", {}).get(loss, (-np.inf, np.inf))
        if not complaints and not low <= number <= high:
            complaints.append(f"{loss}: {number:.4g} lies outside {low:g} to {high:g}")
    why = "in nature: " + "; ".join(complaints) if complaints else ""
    return Judgement(supported, not complaints, why)


def cells(claim: Mapping[str, Any], confirms: str, measured: Mapping[str, Values]) -> Row:
    """Cells of the ledger's table for one claim."""
    row = {"in_nature": claim["verdict"], "nature": with_numbers(claim["says"], measured)}
    if claim["verdict"] == OPEN:
        return row
    values = measured[claim["check"]]._asdict()
    return row | {
        "nature_test": measures()[claim["check"]],
        "nature_true_if": confirms,
        "nature_found": ", ".join(
            f"{kind.replace('_', ' ')} {number:.3g}" for kind, number in values.items()
        ),
    }


def rows(measured: Mapping[str, Values]) -> list[Row]:
    """Rows of the table of measures."""
    return [
        {"measure": name, "what": measures()[name]}
        | {kind: f"{number:.12g}" for kind, number in values._asdict().items()}
        for name, values in measured.items()
    ]


def read(table: Sequence[Row]) -> dict[str, Values]:
    """Values of the measures, from the rows of their table."""
    return {row["measure"]: Values(*(float(row[kind]) for kind in MODELS)) for row in table}


def needed(claims: Collection[Mapping[str, Any]]) -> list[str]:
    """Measures that decide claims, or that the texts of claims quote."""
    names = [claim["check"] for claim in claims if "check" in claim]
    for claim in claims:
        fields = [name for _, name, _, _ in string.Formatter().parse(claim["says"]) if name]
        names += [name.partition(".")[0] for name in fields]
    return list(dict.fromkeys(names))
