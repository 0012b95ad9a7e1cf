"""Compare the curves of one figure with reference data: a row a comparison, and one a point.

Always succeeds: what cannot be compared diverges, with the reason in `note`.
"""

import csv_tables
import job
import numpy as np
import reference_data
from verdict_table import COLUMNS

from planarimpact import comparison, landmarks
from planarimpact.comparison import Verdict

RESIDUALS = ["comparison", "quantity", "at", "distance [sigma]"]
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
        `residuals` holds rows of the table of residuals, the other keys are `COLUMNS`.
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
            gap = None
            if entry["metric"] == "landmark":
                quantity, residuals, gap, words = _landmark(entry, known, curves)
                facts |= words
            else:
                quantity, residuals = _residuals(entry, known, curves, series_paths)
            documented, distance = entry.get("documented"), residuals.summary()
            verdict = comparison.judge(distance, entry.get("agreement"), documented, gap)
            facts |= _numbers(distance, entry, known)
            points = zip(residuals.x.tolist(), residuals.sigmas.tolist(), strict=True)
            facts["residuals"] = [[name, quantity, *point] for point in points]
            note = _name(documented) if documented else ""
        except Exception as error:
            verdict, note = Verdict.DIVERGES, f"{error}"
        rows.append(_row(figure, name, verdict, note=note, **facts))
    return rows


def _name(documented):
    return f"ledger: {documented['entry']}" if "entry" in documented else documented["note"]


def _residuals(entry, known, curves, series_paths):
    """Residuals against a series, between two columns, or of one from zero; against what."""
    if entry["metric"] in ("balance", "largest"):
        return _residuals_of_columns(entry, curves)
    source, name = entry["reference"].split("/")
    series = csv_tables.read(series_paths[source])[name]
    x, y = (reference_data.column_name(known[axis]) for axis in ("x", "y"))
    sigma = _sigma(entry, known)
    low, high = _window(entry, known["x"])
    chosen = (series[x] >= low) & (series[x] <= high)
    if entry["metric"] == "distance":
        points = series[x][chosen], series[y][chosen]
        curve = _curve(curves, entry["curve"], x, y)
        return x, comparison.curve_residuals(points, curve, sigma, known.get("line", False))
    labels = known.get("labels", [])
    if "curve" in entry:
        curves = {entry["curve"]: _named(curves, entry["curve"])}
        if "curve" in labels:
            chosen &= series["curve"] == entry["curve"]
    points = series[x][chosen], series[y][chosen], _labels(series, labels, chosen)
    return x, comparison.vertex_residuals(points, _vertices(curves, x, y, labels), sigma)


def _sigma(entry, series):
    """Of both axes, with the allowance for the form of the model if the comparison has one."""
    sigma = series["x"]["sigma"], series["y"]["sigma"]
    allowance = entry.get("allowance")
    if allowance is None:
        return sigma
    return comparison.with_allowance(sigma, (allowance["x"], allowance["y"]))


def _window(entry, axis):
    """Ends of the window; one at the end of the axis' range lets in what lies just outside it."""
    low, high = entry.get("window", axis["range"])
    first, last = axis["range"]
    return low if low > first else -np.inf, high if high < last else np.inf


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
    """What a landmark is, its residual from a fact, signed difference, and both in words."""
    where = entry["landmark"]
    options = [where[key] for key in ("regime", "level", "at") if key in where]
    names = [where["x"], "regime" if "regime" in where else where["y"]]
    found = getattr(landmarks, where["kind"])(*_curve(curves, entry["curve"], *names), *options)
    unit = "" if fact["unit"] == "1" else f" {fact['unit']}"
    signs = {"value": "", "less_than": "< ", "greater_than": "> "}
    stated = "".join(f"{sign}{fact[key]:g}{unit}" for key, sign in signs.items() if key in fact)
    gap = found - fact["value"] if "value" in fact else None
    words = {"found": f"{found:.4g}", "stated": stated}
    quantity = names[1] if where["kind"] == "value_at" else names[0]
    return quantity, comparison.fact_residuals(found, fact), gap, words


def _residuals_of_columns(entry, curves):
    """Residuals of two columns that must be equal, or of one from zero, over all curves.

    Their points stand at the first column of the curves.
    """
    names = entry["balance"] if entry["metric"] == "balance" else [entry["largest"]]
    holders = [columns for columns in curves.values() if all(name in columns for name in names)]
    if not holders:
        raise ValueError(f"no curve has the columns {names}")
    quantity = next(iter(holders[0]))
    x, left, *right = (
        np.concatenate([columns[name] for columns in holders]) for name in (quantity, *names)
    )
    if right:
        return quantity, comparison.difference_residuals(x, left, right[0], BALANCE_SIGMA)
    return quantity, comparison.difference_residuals(x, left, np.zeros(len(left)), 1.0)


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


def _numbers(distance, entry, known):
    return {
        "points": distance.points,
        "rms [sigma]": f"{distance.rms:.3g}",
        "max [sigma]": f"{distance.max:.3g}",
        "rms [axis units]": f"{distance.plain_rms:.3g}",
        "allowed": _allowed(entry, known),
    }


def _allowed(entry, known):
    if "agreement" in entry:
        limits = ", ".join(f"{key} <= {limit:g}" for key, limit in entry["agreement"].items())
        return limits + (_unit_of_distance(entry, known) if "allowance" in entry else "")
    bounds = {k: v for k, v in entry["documented"].items() if k not in ("entry", "note")}
    return ", ".join(f"{low:g} <= {key} <= {high:g}" for key, (low, high) in bounds.items())


def _unit_of_distance(entry, series):
    """What a distance of 1 is in axis units, where it is not the sigma that source.yaml states."""
    axes = zip((series["x"], series["y"]), _sigma(entry, series), strict=True)
    words = ", ".join(f"{axis['column']} {size:.3g} {axis['unit']}" for axis, size in axes)
    return f"; 1 is {words}: allowance for the model and sigma together".replace("_", " ")


def _row(figure, name, verdict, **cells):
    row = dict.fromkeys(COLUMNS, "")
    return row | {"figure": figure, "comparison": name, "verdict": str(verdict)} | cells


def write(rows, verdicts, residuals):
    """Write both tables of the `rows` that `compare` gave."""
    csv_tables.write_rows(verdicts, COLUMNS, [[row[column] for column in COLUMNS] for row in rows])
    points = [point for row in rows for point in row.get("residuals", [])]
    csv_tables.write_rows(residuals, RESIDUALS, points)


if "snakemake" in globals():
    with job.recorded(snakemake):  # noqa: F821
        found = compare(
            snakemake.wildcards.figure,  # noqa: F821
            snakemake.params.comparisons,  # noqa: F821
            snakemake.params.references,  # noqa: F821
            snakemake.input.curves,  # noqa: F821
            dict(zip(snakemake.params.sources, snakemake.input.series, strict=True)),  # noqa: F821
        )
        write(found, snakemake.output.verdicts, snakemake.output.residuals)  # noqa: F821
