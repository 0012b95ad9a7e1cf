"""Rows of the verdict table, one for each comparison, and of the table of residuals.

A table of curves that cannot be read is an error. What cannot be compared in it diverges, with the
reason in `note`.
"""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, TypeAlias

import numpy as np
import pandas as pd

from stronge1994 import tables
from stronge1994.formulas import plain
from stronge1994.judging.comparisons import Comparison
from stronge1994.judging.metrics import Measured, measure
from stronge1994.judging.verdicts import Judgement, judge
from stronge1994.reference_data import Fact, Series
from stronge1994.tables import Table
from stronge1994.verdict_table import COLUMNS, LEDGER, Verdict

RESIDUALS = ["comparison", "quantity", "at", "distance [sigma]"]
# The cells of a row by `COLUMNS`. `residuals` has its part of the table of residuals.
VerdictRow: TypeAlias = dict[str, Any]


def compare(
    name: str,
    path: str,
    comparisons: Mapping[str, Mapping[str, Any]],
    references: Mapping[str, Mapping[str, Any]],
    significance: float,
) -> list[VerdictRow]:
    """Rows of the verdict table, one for each comparison of the table of curves at `path`.

    `name` is that of a figure, or `scene_` and that of a scene. `references` has the series and
    facts of source.yaml under `source/entry`, each with the parameters of its source. Published
    points agree if p is above `significance`. Beside the cells of the table each row has
    `residuals`, its part of the table of residuals.
    """
    curves = read(path)
    every = [Comparison.of(title, entry, references) for title, entry in comparisons.items()]
    return [
        dict.fromkeys(COLUMNS, "") | {"figure": name} | _row(one, curves, significance)
        for one in every
    ]


def read(path: str) -> Table:
    """Curves of a figure, or the impacts of a scene with their numbers; all finite."""
    if Path(path).parent.name != "scenes":
        return tables.read(path)
    table = tables.read(path, "impacts")
    table.insert(1, "row [1]", np.arange(1.0, len(table) + 1))
    return table


def _row(comparison: Comparison, curves: Table, significance: float) -> VerdictRow:
    """Cells of one comparison: what was measured, and the verdict on it."""
    reference = comparison.reference
    cells: VerdictRow = {
        "comparison": comparison.name,
        "question": comparison.question,
        "reference": reference.name if reference else "",
        "curve": tables.curve_name(comparison.curve),
        "model": comparison.curve.get("model", ""),
        "reason": plain(comparison.reason),
    }
    if isinstance(reference, Series) and reference.kind == "awaited":
        return cells | {"verdict": Verdict.AWAITED, "note": reference.figure}
    try:
        measured = measure(comparison, curves)
        judged = judge(comparison, measured, significance)
        cells |= _numbers(comparison, measured, judged, significance)
        own = comparison.name, measured.quantity, measured.at, measured.sigmas
        cells["residuals"] = pd.DataFrame(dict(zip(RESIDUALS, own, strict=True)))
        verdict, note = judged.verdict, _note(comparison, measured, judged.verdict)
    except Exception as error:
        verdict, note = comparison.question.failed, f"{error}"
    return cells | {"verdict": verdict, "note": plain(note)}


def _note(comparison: Comparison, measured: Measured, verdict: Verdict) -> str:
    """The documented cause of a difference; of a new difference, where it is largest."""
    known = comparison.documented
    cause = (f"{LEDGER}{known.entry}" if known.entry else known.note) if known else ""
    sigmas = np.abs(measured.sigmas)
    if not verdict.fails or len(sigmas) == 1:
        return cause
    worst = int(sigmas.argmax())
    at = f"{measured.quantity} = {measured.at[worst]:g}"
    place = f"largest for {measured.columns[worst]} at {at}"
    return "; ".join(part for part in (cause, place) if part)


def _numbers(
    comparison: Comparison, measured: Measured, judged: Judgement, significance: float
) -> VerdictRow:
    bounds = comparison.regression.items()
    cells: VerdictRow = {
        "points": len(measured.at),
        "unit": _unit(comparison.reference),
        "allowed": _allowed(comparison, significance),
        "regression": ", ".join(f"{low:g} <= {key} <= {high:g}" for key, (low, high) in bounds),
    }
    for unit, (rms, largest) in {"sigma": judged.sigmas, "axis units": judged.plain}.items():
        cells |= {f"rms [{unit}]": f"{rms:.3g}", f"max [{unit}]": f"{largest:.3g}"}
    if isinstance(comparison.reference, Fact):
        cells |= {"found": f"{measured.at[0]:.4g}", "stated": _stated(comparison.reference)}
    if chi2 := judged.chi2:
        cells |= {"chi^2": f"{chi2.value:.3g}", "degrees of freedom": chi2.degrees}
        cells |= {"degrees of sigma": chi2.of_sigma or "", "p": f"{chi2.p:.2g}"}
    return cells


def _stated(fact: Fact) -> str:
    """A stated value or inequality with its unit."""
    unit = "" if fact.unit == "1" else f" {fact.unit}"
    stated = {"": fact.value, "< ": fact.less_than, "> ": fact.greater_than}
    return "".join(f"{sign}{value:g}{unit}" for sign, value in stated.items() if value is not None)


def _unit(reference: Series | Fact | None) -> str:
    """Unit of the distances in axis units; empty for a law, and for several axes of other units."""
    if not isinstance(reference, Series):
        return reference.unit if reference else ""
    units = {axis.unit for axis in reference.ordinates}
    return units.pop() if len(units) == 1 else ""


def _allowed(comparison: Comparison, significance: float) -> str:
    reference = comparison.reference
    if comparison.range:
        return "{:g} to {:g}".format(*comparison.range)
    if not (isinstance(reference, Series) and reference.is_published):
        return f"max <= {comparison.limit:g}"
    criterion = f"p > {significance:g}"
    if comparison.allowance is None:
        return criterion
    allowed = comparison.allowance
    sizes = (
        f"{axis.column} {size:g} {axis.unit}"
        for axis, size in ((reference.x, allowed.x), (reference.ordinates[0], allowed.y))
    )
    return f"{criterion}; the model may be off by {', '.join(sizes)}".replace("_", " ")


def write(rows: Sequence[VerdictRow], verdicts: str, residuals: str) -> None:
    """Write both tables of the `rows` that `compare` gave."""
    tables.write_rows(verdicts, rows, COLUMNS)
    points = [row["residuals"] for row in rows if "residuals" in row]
    every = pd.concat([pd.DataFrame(columns=RESIDUALS), *points])
    every.to_csv(residuals, index=False, lineterminator="\n")
