"""Rows of the verdict table, one for each comparison, and of the table of residuals.

A table of curves that cannot be read is an error. What cannot be compared in it fails, with the
reason in `note`.
"""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, TypeAlias

import numpy as np
import pandas as pd

from stronge1994 import tables
from stronge1994.formulas import plain
from stronge1994.judging import scales
from stronge1994.judging.comparisons import Comparison, Metric
from stronge1994.judging.metrics import Measured, measure, rms_and_max
from stronge1994.judging.verdicts import error_in_words, judge
from stronge1994.reference_data import Fact, Series
from stronge1994.tables import Table, with_unit
from stronge1994.verdict_table import COLUMNS, Verdict, Why

RESIDUALS = ["comparison", "of curve", "quantity", "at", "distance [sigma]"]
# The cells of a row by `COLUMNS`. `residuals` has its part of the table of residuals.
VerdictRow: TypeAlias = dict[str, Any]


def compare(
    name: str,
    path: str,
    comparisons: Sequence[Comparison],
    significance: float,
    settings: Mapping[str, Any],
) -> list[VerdictRow]:
    """Rows of the verdict table, one for each comparison of the table of curves at `path`.

    `name` is that of a figure, or `scene_` and that of a scene; `settings` are those that its
    curves were solved with. Published points agree if p is above `significance`. Beside the cells
    of the table each row has `residuals`, its part of the table of residuals.
    """
    curves = read(path)
    common = dict.fromkeys(COLUMNS, "") | {"figure": name}
    return [
        common | _row(one, _parts(one, comparisons), curves, significance, settings)
        for one in comparisons
    ]


def _parts(comparison: Comparison, every: Sequence[Comparison]) -> list[Comparison]:
    """What a comparison measures: itself; or the two of a ratio, that of its reference first."""
    if comparison.metric != Metric.RATIO:
        return [comparison]
    alike = [one for one in every if (one.scale, one.metric) == (comparison.scale, Metric.DISTANCE)]
    return sorted(alike, key=lambda one: one.reference != comparison.reference)


def read(path: str) -> Table:
    """Curves of a figure, or the impacts of a scene with their numbers; all finite."""
    if Path(path).parent.name != "scenes":
        return tables.read(path)
    table = tables.read(path, "impacts")
    table.insert(1, "row [1]", np.arange(1.0, len(table) + 1))
    return table


def _row(
    comparison: Comparison,
    parts: Sequence[Comparison],
    curves: Table,
    significance: float,
    settings: Mapping[str, Any],
) -> VerdictRow:
    """Cells of one comparison: what was measured, and the verdict on it."""
    reference, known = comparison.reference, comparison.differs
    cells: VerdictRow = {
        "comparison": comparison.name,
        "group": comparison.group,
        "says": comparison.says,
        "reference": reference.name if reference else "",
        "curve": tables.curve_name(comparison.curve),
        "model": comparison.curve.get("model", ""),
        "reason": plain(comparison.reason),
    }
    none = {"verdict": Verdict.NOT_COMPARED}
    for series in [one.reference for one in parts]:
        if isinstance(series, Series) and series.kind == "awaited":
            return cells | none | {"why": Why.AWAITED, "note": series.figure}
    if others := "; ".join(filter(None, (one.other_settings(settings) for one in parts))):
        what = "reference" if reference else "law"
        return cells | none | {"why": Why.SETTINGS, "note": f"the {what} is for {others}"}
    try:
        measured = _measured(comparison, parts, curves)
        verdict, numbers = _judged(comparison, measured, significance)
    except Exception as error:
        return cells | {"verdict": Verdict.FAILS, "note": plain(f"{error}")}
    notes = [measured.note]
    if verdict == Verdict.DIFFERS and known:
        cells |= {"why": known.why, "entry": known.entry}
        notes = [plain(known.note), *notes]
    elif verdict in (Verdict.DIFFERS, Verdict.FAILS):
        cells |= {"why": Why.UNKNOWN} if verdict == Verdict.DIFFERS else {}
        notes += [_place(measured)] if len(measured.at) > 1 else []
    elif verdict == Verdict.CANNOT_JUDGE and isinstance(reference, Series):
        notes = [f"not published: {reference.unpublished}", *notes]
    cells |= numbers | {"verdict": verdict, "note": "; ".join(filter(None, notes))}
    of = measured.curves or cells["curve"]
    own = comparison.name, of, measured.quantity, measured.at, measured.sigmas
    return cells | {"residuals": pd.DataFrame(dict(zip(RESIDUALS, own, strict=True)))}


def _measured(comparison: Comparison, parts: Sequence[Comparison], curves: Table) -> Measured:
    if comparison.metric == Metric.RATIO:
        if len(parts) != 2:
            raise ValueError(f"a ratio needs two comparisons with its scale, here {len(parts)}")
        return scales.ratio(parts[0], parts[1], curves)
    return (scales.measure if comparison.scale else measure)(comparison, curves)


def _place(measured: Measured) -> str:
    """Where a distance is largest."""
    worst = measured.worst
    of = f" of {measured.curves[worst]}" if measured.curves else ""
    at = f"{measured.quantity} = {measured.at[worst]:g}"
    return f"largest for {measured.columns[worst]}{of} at {at}"


def _judged(
    comparison: Comparison, measured: Measured, significance: float
) -> tuple[Verdict, VerdictRow]:
    """The verdict, and the cells of numbers; sizes are in the unit of the axis."""
    verdict, chi2, error = judge(comparison, measured, significance)
    quantity, _, unit = measured.columns[measured.worst].rstrip("]").partition(" [")
    sizes = *measured.sizes, *rms_and_max(measured.sigmas)
    numbers = dict(zip(("rms", "max", "rms [sigma]", "max [sigma]"), sizes, strict=True))
    cells: VerdictRow = {key: f"{number:.3g}" for key, number in numbers.items()}
    cells |= {"size": f"{numbers['rms']:.6g}"}
    cells |= {"points": len(measured.at), "column": quantity, "unit": unit}
    cells |= {"allowed": _allowed(comparison, measured, unit, significance)}
    if isinstance(comparison.reference, Fact):
        cells |= {"found": f"{measured.at[0]:.4g}", "stated": comparison.reference.stated}
        cells |= {"size": f"{measured.at[0]:.6g}"}
    elif comparison.reference is None:
        cells["size"] = ""  # a law has its own limit
    if comparison.metric == Metric.RATIO:
        cells["found"] = f"ratio {measured.at[0]:.3g}"
    if comparison.range:
        values = measured.plain + sum(comparison.range) / 2
        cells["found"] = f"{values.min():.3g} to {values.max():.3g}"
    if chi2:
        cells |= {"chi^2": f"{chi2.value:.3g}", "degrees of freedom": chi2.degrees}
        cells |= {"degrees of sigma": chi2.of_sigma or "", "p": f"{chi2.p:.2g}"}
        cells |= {"would fail": error_in_words(comparison, measured, error)}
    return verdict, cells


def _allowed(comparison: Comparison, measured: Measured, unit: str, significance: float) -> str:
    """What a distance must meet, in the unit of the axis."""
    reference, allowed = comparison.reference, comparison.allowance
    if comparison.range:
        return "{:g} to {:g}".format(*comparison.range)
    if isinstance(reference, Fact) and reference.tolerance is None:
        return reference.stated
    if not (isinstance(reference, Series) and reference.is_published):
        size = float(f"{measured.scales[measured.worst]:.3g}")
        return f"max <= {with_unit(size, unit)}"
    criterion = f"p > {significance:g}"
    if allowed is None:
        return criterion
    both = (reference.x, allowed.x), (reference.ordinates[0], allowed.y)
    sizes = [f"{axis.column} {with_unit(size, axis.unit)}" for axis, size in both]
    return f"{criterion}; the model may be off by {', '.join(sizes)}".replace("_", " ")


def write(rows: Sequence[VerdictRow], verdicts: str, residuals: str) -> None:
    """Write both tables of the `rows` that `compare` gave."""
    tables.write_rows(verdicts, rows, COLUMNS)
    points = [row["residuals"] for row in rows if "residuals" in row]
    every = pd.concat([pd.DataFrame(columns=RESIDUALS), *points])
    every.to_csv(residuals, index=False, lineterminator="\n")
