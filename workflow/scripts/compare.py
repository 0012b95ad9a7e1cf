"""Compare the curves of one figure with reference data: one row a comparison.

Always succeeds: what cannot be compared diverges, with the reason in `note`.
"""

import csv_tables
import job
import numpy as np
import reference_data

from planarimpact import comparison, landmarks
from planarimpact.comparison import Verdict

COLUMNS = [
    "figure", "comparison", "verdict", "reference", "points", "rms [sigma]", "max [sigma]",
    "rms [axis units]", "found", "stated", "allowed", "note", "reason",
]  # fmt: skip
# Two ways to one energy agree to this share of it; see the comparison's reason.
BALANCE_SIGMA = 1e-12


def compare(figure, comparisons, references, curves_path, series_paths):
    """Rows of the verdict table, the first on the curves themselves.

    Parameters
    ----------
    figure : str
    comparisons : dict
        `{name: entry of the config}`.
    references : dict
        `{source/entry: series or fact of source.yaml}`.
    curves_path : str
    series_paths : dict
        `{source: table of its series}`.

    Returns
    -------
    list of dict
    """
    rows = []
    try:
        curves = csv_tables.read(curves_path)
        _refuse_not_finite(curves)
        problem = None
    except Exception as error:
        problem = f"no curves: {error}"
    solved = Verdict.DIVERGES if problem else Verdict.AGREES
    rows.append(_row(figure, f"{figure}-solved", solved, note=problem or "", reason="it must run"))
    for name, entry in comparisons.items():
        facts = dict(reference=entry.get("reference", ""), reason=entry["reason"])
        known = references.get(entry.get("reference"))
        if known is not None and known.get("kind") == "awaited" and not known["path"]:
            rows.append(_row(figure, name, Verdict.AWAITED, note=known["figure"], **facts))
            continue
        try:
            if problem:
                raise ValueError(problem)
            if entry["metric"] == "landmark":
                distance, gap, words = _landmark(entry, known, curves)
                facts |= words
            else:
                distance, gap = _distance(entry, known, curves, series_paths), None
            documented = entry.get("documented")
            verdict = comparison.judge(distance, entry.get("agreement"), documented, gap)
            facts |= _numbers(distance, entry)
            note = _name(documented) if documented else ""
        except Exception as error:
            verdict, note = Verdict.DIVERGES, f"{error}"
        rows.append(_row(figure, name, verdict, note=note, **facts))
    return rows


def _name(documented):
    return f"ledger: {documented['entry']}" if "entry" in documented else documented["note"]


def _distance(entry, known, curves, series_paths):
    """Distance of one comparison from a series, between two columns, or of one from zero."""
    if entry["metric"] == "balance":
        return comparison.difference_distance(*_columns(entry["balance"], curves), BALANCE_SIGMA)
    if entry["metric"] == "largest":
        return comparison.difference_distance(*_columns([entry["largest"]], curves), 0.0, 1.0)
    source, name = entry["reference"].split("/")
    series = csv_tables.read(series_paths[source])[name]
    x, y = (reference_data.column_name(known[axis]) for axis in ("x", "y"))
    sigma = known["x"]["sigma"], known["y"]["sigma"]
    low, high = entry.get("window", (-np.inf, np.inf))
    chosen = (series[x] >= low) & (series[x] <= high)
    if entry["metric"] == "distance":
        points = series[x][chosen], series[y][chosen]
        curve = _curve(curves, entry["curve"], x, y)
        return comparison.curve_distance(points, curve, sigma, known.get("line", False))
    labels = known.get("labels", [])
    if "curve" in entry:
        curves = {entry["curve"]: _named(curves, entry["curve"])}
        if "curve" in labels:
            chosen &= series["curve"] == entry["curve"]
    points = series[x][chosen], series[y][chosen], _labels(series, labels, chosen)
    return comparison.vertex_distance(points, _vertices(curves, x, y, labels), sigma)


def _vertices(curves, x, y, labels):
    """Vertices of all curves that have both columns: x, y, labels."""
    found = [], [], []
    for name, columns in curves.items():
        if x in columns and y in columns:
            named = {**columns, "curve": np.full(len(columns[x]), name)}
            found[0].extend(columns[x])
            found[1].extend(columns[y])
            found[2].extend(_labels(named, labels))
    return found


def _labels(columns, labels, chosen=slice(None)):
    if not labels:
        return [""] * len(next(iter(columns.values()))[chosen])
    return [", ".join(words) for words in zip(*(columns[k][chosen] for k in labels), strict=True)]


def _landmark(entry, fact, curves):
    """Distance of a landmark from a fact, signed difference, and both in words."""
    where = entry["landmark"]
    options = [where[key] for key in ("regime", "level", "at") if key in where]
    names = [where["x"], "regime" if "regime" in where else where["y"]]
    found = getattr(landmarks, where["kind"])(*_curve(curves, entry["curve"], *names), *options)
    unit = "" if fact["unit"] == "1" else f" {fact['unit']}"
    signs = {"value": "", "less_than": "< ", "greater_than": "> "}
    stated = "".join(f"{sign}{fact[key]:g}{unit}" for key, sign in signs.items() if key in fact)
    gap = found - fact["value"] if "value" in fact else None
    words = {"found": f"{found:.4g}", "stated": stated}
    return comparison.fact_distance(found, fact), gap, words


def _columns(names, curves):
    """Columns of all curves that have them all, one after the other."""
    found = [
        [columns[name] for name in names]
        for columns in curves.values()
        if all(name in columns for name in names)
    ]
    if not found:
        raise ValueError(f"no curve has the columns {names}")
    return [np.concatenate(same) for same in zip(*found, strict=True)]


def _named(curves, name):
    if name not in curves:
        raise ValueError(f"no curve '{name}'; the figure has {', '.join(curves)}")
    return curves[name]


def _curve(curves, name, *columns):
    curve = _named(curves, name)
    missing = [column for column in columns if column not in curve]
    if missing:
        raise ValueError(f"curve '{name}' has no column '{missing[0]}'")
    return [curve[column] for column in columns]


def _refuse_not_finite(curves):
    for name, columns in curves.items():
        for column, values in columns.items():
            if values.dtype.kind == "f" and not np.isfinite(values).all():
                raise ValueError(f"curve '{name}', column '{column}' is not finite")


def _numbers(distance, entry):
    return {
        "points": distance.count,
        "rms [sigma]": f"{distance.rms:.3g}",
        "max [sigma]": f"{distance.max:.3g}",
        "rms [axis units]": f"{distance.plain_rms:.3g}",
        "allowed": _allowed(entry),
    }


def _allowed(entry):
    if "agreement" in entry:
        return ", ".join(f"{key} <= {limit:g}" for key, limit in entry["agreement"].items())
    bounds = {k: v for k, v in entry["documented"].items() if k not in ("entry", "note")}
    return ", ".join(f"{low:g} <= {key} <= {high:g}" for key, (low, high) in bounds.items())


def _row(figure, name, verdict, **cells):
    row = dict.fromkeys(COLUMNS, "")
    return row | {"figure": figure, "comparison": name, "verdict": str(verdict)} | cells


if "snakemake" in globals():
    with job.log_to(snakemake.log[0]):  # noqa: F821
        found = compare(
            snakemake.wildcards.figure,  # noqa: F821
            snakemake.params.comparisons,  # noqa: F821
            snakemake.params.references,  # noqa: F821
            snakemake.input.curves,  # noqa: F821
            dict(zip(snakemake.params.sources, snakemake.input.series, strict=True)),  # noqa: F821
        )
        csv_tables.write_rows(
            snakemake.output[0],  # noqa: F821
            COLUMNS,
            [[row[column] for column in COLUMNS] for row in found],
        )
