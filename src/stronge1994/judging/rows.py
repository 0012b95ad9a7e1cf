"""Rows of the verdict table, one for each comparison, and of the table of residuals.

A table of curves that cannot be read is an error. What cannot be compared in it diverges, with the
reason in `note`.
"""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, TypeAlias

import numpy as np

from stronge1994 import csv_tables, reference_data
from stronge1994.csv_tables import Curves
from stronge1994.formulas import plain
from stronge1994.judging.distances import rms_and_max
from stronge1994.judging.metrics import Measured, measure
from stronge1994.judging.points import Entry, Reference, is_published, kind, question
from stronge1994.judging.verdicts import chi_squared_of, judge
from stronge1994.verdict_tables.verdict_table import (
    COLUMNS,
    FAILED,
    FAILS,
    LEDGER,
    Verdict,
)

RESIDUALS = ["comparison", "quantity", "at", "distance [sigma]"]
# The cells of a row by `COLUMNS`. `residuals` holds rows of the table of residuals.
VerdictRow: TypeAlias = dict[str, Any]


def compare(
    name: str,
    path: str,
    comparisons: Mapping[str, Entry],
    references: Mapping[str, Reference],
    significance: float,
) -> list[VerdictRow]:
    """Rows of the verdict table, one for each comparison of the table of curves at `path`.

    `name` is that of a figure, or `scene_` and that of a scene. `references` has the series and
    facts of source.yaml under `source/entry`, each with the parameters of its source. Published
    points agree if p is above `significance`. Beside the cells of the table each row has
    `residuals`, its rows of the table of residuals.
    """
    curves, rows = read(path), []
    for title, entry in comparisons.items():
        reference = references.get(entry.get("reference", ""), {})
        cells: VerdictRow = {key: entry.get(key, "") for key in ("reference", "curve", "reason")}
        cells["question"] = question(entry, reference)
        if kind(reference) == "awaited":
            rows.append(_row(name, title, Verdict.AWAITED, note=reference["figure"], **cells))
            continue
        try:
            measured = measure(entry, reference, curves)
            verdict = judge(entry, reference, measured, significance)
            cells |= _numbers(entry, reference, measured, significance)
            x, sigmas, _ = (column.tolist() for column in measured.residuals)
            points = zip(x, sigmas, strict=True)
            cells["residuals"] = [[title, measured.quantity, *point] for point in points]
            note = _note(entry, measured, verdict)
        except Exception as error:
            verdict, note = FAILED[cells["question"]], f"{error}"
        rows.append(_row(name, title, verdict, note=note, **cells))
    return rows


def read(path: str) -> Curves:
    """Curves that are judged. A number that is not finite is an error.

    The table of a figure has its own curves. That of a scene becomes one curve `impacts`, whose
    rows are numbered.
    """
    if Path(path).parent.name == "scenes":
        rows = csv_tables.read_rows(path)
        columns = {name: csv_tables.values([row[name] for row in rows]) for name in rows[0]}
        curves = {"impacts": {"row [1]": np.arange(1.0, len(rows) + 1)} | columns}
    else:
        curves = csv_tables.read(path)
    csv_tables.refuse_not_finite(curves)
    return curves


def _note(entry: Entry, measured: Measured, verdict: Verdict) -> str:
    """The documented cause of a difference; of a new difference, where it is largest."""
    documented = entry.get("documented", {})
    recorded: str = (
        f"{LEDGER}{documented['entry']}" if "entry" in documented else documented.get("note", "")
    )
    sigmas = np.abs(measured.residuals.sigmas)
    if verdict not in FAILS or len(sigmas) == 1:
        return recorded
    worst = int(sigmas.argmax())
    at = f"{measured.quantity} = {measured.residuals.x[worst]:g}"
    place = f"largest for {measured.columns[worst]} at {at}"
    return "; ".join(part for part in (recorded, place) if part)


def _numbers(
    entry: Entry, reference: Reference, measured: Measured, significance: float
) -> VerdictRow:
    x, sigmas, plain = measured.residuals
    bounds = entry.get("regression", {}).items()
    cells: VerdictRow = {
        "points": len(x),
        "unit": _unit(reference),
        "allowed": _allowed(entry, reference, significance),
        "regression": ", ".join(f"{low:g} <= {key} <= {high:g}" for key, (low, high) in bounds),
    }
    for unit, distances in {"sigma": sigmas, "axis units": plain}.items():
        rms, largest = rms_and_max(distances)
        cells |= {f"rms [{unit}]": f"{rms:.3g}", f"max [{unit}]": f"{largest:.3g}"}
    if kind(reference) == "fact":
        cells |= {"found": f"{x[0]:.4g}", "stated": _stated(reference)}
    if is_published(reference):
        chi2 = chi_squared_of(reference, measured)
        cells |= {"chi^2": f"{chi2.value:.3g}", "degrees of freedom": chi2.degrees}
        cells["degrees of sigma"] = chi2.of_sigma or ""
        cells["p"] = f"{chi2.p:.2g}"
    return cells


def _stated(fact: Reference) -> str:
    """A stated value or inequality with its unit."""
    unit = "" if fact["unit"] == "1" else f" {fact['unit']}"
    signs = {"value": "", "less_than": "< ", "greater_than": "> "}
    return "".join(f"{sign}{fact[key]:g}{unit}" for key, sign in signs.items() if key in fact)


def _unit(reference: Reference) -> str:
    """Unit of the distances in axis units; empty for a law, and for several axes of other units."""
    if kind(reference) in ("law", "fact"):
        return f"{reference.get('unit', '')}"
    units = {axis["unit"] for axis in reference_data.ordinates(reference)}
    return units.pop() if len(units) == 1 else ""


def _allowed(entry: Entry, reference: Reference, significance: float) -> str:
    if "range" in entry:
        return "{:g} to {:g}".format(*entry["range"])
    if not is_published(reference):
        return f"max <= {entry.get('limit', 1.0):g}"
    criterion = f"p > {significance:g}"
    if "allowance" not in entry:
        return criterion
    sizes = (
        f"{reference[key]['column']} {size:g} {reference[key]['unit']}"
        for key, size in entry["allowance"].items()
    )
    return f"{criterion}; the model may be off by {', '.join(sizes)}".replace("_", " ")


def _row(figure: str, name: str, verdict: Verdict, **cells: Any) -> VerdictRow:
    row = dict.fromkeys(COLUMNS, "")
    row |= {"figure": figure, "comparison": name, "verdict": str(verdict)} | cells
    return row | {key: plain(row[key]) for key in ("note", "reason")}


def write(rows: Sequence[VerdictRow], verdicts: str, residuals: str) -> None:
    """Write both tables of the `rows` that `compare` gave."""
    csv_tables.write_table(verdicts, rows, COLUMNS)
    points = [point for row in rows for point in row.get("residuals", [])]
    csv_tables.write_rows(residuals, RESIDUALS, points)
