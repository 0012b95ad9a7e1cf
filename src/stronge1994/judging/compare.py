"""Compare one table of a run with reference data: a row a comparison, and one a point.

Always succeeds: what cannot be compared diverges, with the reason in `note`.
"""

from typing import NamedTuple

import numpy as np

from stronge1994 import csv_tables, reference_data
from stronge1994.curves.sampling import shifted_by
from stronge1994.judging import comparison, judged_tables, landmarks
from stronge1994.judging.comparison import Residuals, Verdict
from stronge1994.judging.verdict_table import COLUMNS

RESIDUALS = ["comparison", "quantity", "at", "distance [sigma]"]
# Two ways to one energy agree to this share of it; see the comparison's reason.
BALANCE_SIGMA = 1e-12
# What a row rests on, by the kind of its reference.
EVIDENCE = {
    "digitised": "published points",
    "awaited": "published points",
    "computed": "independent computation",
    "fact": "stated value",
    "law": "law or limit",
    "itself": "none: regression",
}


class Measured(NamedTuple):
    """How far curves are from what a comparison names.

    Attributes
    ----------
    quantity : str
        Column at which the points stand.
    residuals : Residuals
    columns : list of str
        The column that each residual is of.
    shifts : ndarray, shape (k, n)
        Change of the residuals with one sigma of each uncertain parameter.
    gap : float or None
        Of a landmark: found less stated.
    words : dict
        Of a landmark: both in words.
    """

    quantity: str
    residuals: Residuals
    columns: list
    shifts: np.ndarray = np.zeros((0, 0))
    gap: float | None = None
    words: dict = {}


def compare(name, comparisons, references, path, series_paths, significance):
    """Rows of the verdict table, the first on the table itself.

    Parameters
    ----------
    name : str
        Of a figure, `scene_` and that of a scene, or `study`.
    comparisons : dict
        `{name: entry of the config}`.
    references : dict
        `{source/entry: series or fact of source.yaml, with the source's parameters}`.
    path : str
        The table.
    series_paths : dict
        `{source: table of its series}`.
    significance : float
        Published points agree if p is above it.

    Returns
    -------
    list of dict
        `residuals` holds rows of the table of residuals, the other keys are `COLUMNS`.
    """
    rows = []
    try:
        curves = judged_tables.read(path)
        problem = None
    except Exception as error:
        problem = f"no curves: {error}"
    solved = Verdict.DIVERGES if problem else Verdict.UNCHANGED
    facts = {"evidence": EVIDENCE["itself"], "reason": "it must run"}
    rows.append(_row(name, f"{name}-solved", solved, note=problem or "", **facts))
    for title, entry in comparisons.items():
        known = references.get(entry.get("reference"))
        facts = {"reference": entry.get("reference", ""), "reason": entry["reason"]}
        facts["evidence"] = EVIDENCE[_kind(known)]
        if _kind(known) == "awaited" and not known["path"]:
            rows.append(_row(name, title, Verdict.AWAITED, note=known["figure"], **facts))
            continue
        try:
            if problem:
                raise ValueError(problem)
            found = measure(entry, known, curves, series_paths)
            verdict = judge(entry, known, found, significance)
            facts |= _numbers(entry, known, found, significance) | found.words
            points = zip(found.residuals.x.tolist(), found.residuals.sigmas.tolist(), strict=True)
            facts["residuals"] = [[title, found.quantity, *point] for point in points]
            note = _note(entry, found, verdict)
        except Exception as error:
            verdict, note = Verdict.DIVERGES, f"{error}"
        rows.append(_row(name, title, verdict, note=note, **facts))
    return rows


def measure(entry, known, curves, series_paths):
    """Distances of one comparison.

    Parameters
    ----------
    entry : dict
        Of the config.
    known : dict or None
        Its reference.
    curves : dict
        As `judged_tables.read` gives them.
    series_paths : dict
        `{source: table of its series}`.

    Returns
    -------
    Measured

    Raises
    ------
    ValueError
        Saying what is missing.
    """
    if entry["metric"] in ("balance", "largest", "range"):
        return _columns_alone(entry, curves)
    if entry["metric"] == "contraction":
        return _expansion(entry, curves)
    if entry["metric"] == "landmark":
        return _landmark(entry, known, curves)
    points = _points(entry, known, series_paths)
    find = _from_curve if entry["metric"] == "distance" else _from_vertices
    residuals, columns = find(entry, known, curves, points)
    shifts = [
        (upper[0].sigmas - lower[0].sigmas) / 2
        for upper, lower in (
            [find(entry | {"curve": name}, known, curves, points) for name in pair]
            for pair in shifted_by(entry.get("curve"), curves)
        )
    ]
    x = reference_data.column_name(known["x"])
    return Measured(x, residuals, columns, np.reshape(shifts, (len(shifts), len(columns))))


def judge(entry, known, found, significance):
    """Verdict on what `measure` found."""
    distance = found.residuals.summary()
    if _is_published(known):
        chi2 = _chi_squared(known, found)
        good, measured = chi2.p > significance, {"chi2": chi2.value}
    else:
        good, measured = distance.max <= entry.get("limit", 1.0), {}
    measured |= {"rms": distance.rms, "max": distance.max, "difference": found.gap}
    bounds = entry.get("regression", {})
    unchanged = all(low <= measured[key] <= high for key, (low, high) in bounds.items())
    return comparison.judge(good, "documented" in entry, unchanged)


def _chi_squared(known, found):
    sigmas, shifts = found.residuals.sigmas, found.shifts
    return comparison.chi_squared(sigmas, shifts, known.get("sigma_values"))


def _kind(known):
    """Kind of a reference: of a series its own; `fact`; without a reference a `law`."""
    return "law" if known is None else known.get("kind", "fact")


def _is_published(known):
    return _kind(known) in ("digitised", "awaited")


def _points(entry, known, series_paths):
    """Columns of the reference in the regime and with the labels that the comparison asks for."""
    source, name = entry["reference"].split("/")
    series = csv_tables.read(series_paths[source])[name]
    x = series[reference_data.column_name(known["x"])]
    low, high = _window(entry, known)
    chosen = (x >= low) & (x < high)
    for label, word in entry.get("points", {}).items():
        chosen &= series[label] == word
    if "curve" in entry and "curve" in known.get("labels", []):
        chosen &= series["curve"] == entry["curve"]
    if not chosen.any():
        raise ValueError("the reference has no such points")
    return {column: values[chosen] for column, values in series.items()}


def _window(entry, known):
    """Where a regime begins and ends on the axis of the reference, by its source's parameters."""
    if "regime" not in entry:
        return -np.inf, np.inf
    stated = known["parameters"]
    keys = ("mass_ratio", "stiffness_ratio", "restitution")
    limits = comparison.limits_of_regimes(*(stated[key] for key in keys))
    if known["x"]["column"] == "angle":
        limits = np.degrees(np.arctan(stated["friction"] * limits))
    ends = [-np.inf, *limits, np.inf]
    place = ["initial stick", "slip and stick", "slip throughout"].index(entry["regime"])
    return ends[place], ends[place + 1]


def _from_curve(entry, known, curves, points):
    """Distances from the polyline of the named curve, or of each point's own."""
    x = reference_data.column_name(known["x"])
    parts, columns = [], []
    names = [entry["curve"]] if "curve" in entry else dict.fromkeys(points["curve"])
    for name in names:
        own = slice(None) if "curve" in entry else points["curve"] == name
        for axis in reference_data.ordinates(known):
            y = reference_data.column_name(axis)
            at, value = points[x][own], points[y][own]
            there = ~np.isnan(value)
            if there.any():
                line = _curve(curves, name, x, y)
                where = at[there], value[there]
                sigma = _sigma(entry, known["x"], axis)
                part = comparison.curve_residuals(where, line, sigma, known.get("line", False))
                parts.append(part)
                columns += [f"{y} of {name}"] * len(part.x)
    return _joined(parts), columns


def _from_vertices(entry, known, curves, points):
    """Distances from the vertices with the same labels."""
    x, labels = reference_data.column_name(known["x"]), known.get("labels", [])
    if "curve" in entry:
        curves = {entry["curve"]: _named(curves, entry["curve"])}
    labelled = [
        (columns, _labels(columns | {"curve": np.full(len(columns[x]), name)}, labels))
        for name, columns in curves.items()
        if x in columns
    ]
    words, parts, columns = _labels(points, labels), [], []
    for axis in reference_data.ordinates(known):
        y = reference_data.column_name(axis)
        there = ~np.isnan(points[y])
        if there.any():
            own = [word for word, inside in zip(words, there, strict=True) if inside]
            sigma = _sigma(entry, known["x"], axis)
            where = points[x][there], points[y][there], own
            parts.append(comparison.vertex_residuals(where, _vertices(labelled, x, y), sigma))
            columns += [f"{y} of {word}" if word else y for word in own]
    return _joined(parts), columns


def _joined(parts):
    return Residuals(*(np.concatenate(arrays) for arrays in zip(*parts, strict=True)))


def _sigma(entry, x, y):
    """Of both axes, with the allowance for the form of the model if the comparison has one."""
    sigma, allowance = (x["sigma"], y["sigma"]), entry.get("allowance")
    if allowance is None:
        return sigma
    return comparison.with_allowance(sigma, (allowance["x"], allowance["y"]))


def _vertices(labelled, x, y):
    """Vertices of all curves that have both columns: x, y, labels."""
    holders = [(columns, words) for columns, words in labelled if y in columns]
    if not holders:
        raise ValueError(f"no curve has the columns '{x}' and '{y}'")
    return (
        np.concatenate([columns[x] for columns, _ in holders]),
        np.concatenate([columns[y] for columns, _ in holders]),
        [word for _, words in holders for word in words],
    )


def _labels(columns, labels):
    if not labels:
        return [""] * len(next(iter(columns.values())))
    return [", ".join(map(str, words)) for words in zip(*(columns[k] for k in labels), strict=True)]


def _landmark(entry, fact, curves):
    """A landmark against a stated fact."""
    where = entry["landmark"]
    options = [where[key] for key in ("regime", "level", "at") if key in where]
    names = [where["x"], "regime" if "regime" in where else where["y"]]
    found = getattr(landmarks, where["kind"])(*_curve(curves, entry["curve"], *names), *options)
    unit = "" if fact["unit"] == "1" else f" {fact['unit']}"
    signs = {"value": "", "less_than": "< ", "greater_than": "> "}
    stated = "".join(f"{sign}{fact[key]:g}{unit}" for key, sign in signs.items() if key in fact)
    gap = found - fact["value"] if "value" in fact else None
    quantity = names[1] if where["kind"] == "value_at" else names[0]
    words = {"found": f"{found:.4g}", "stated": stated}
    residuals = comparison.fact_residuals(found, fact)
    return Measured(quantity, residuals, [quantity], gap=gap, words=words)


def _columns_alone(entry, curves):
    """Two columns that must be equal, one that must be small, or some that have a range.

    Their points stand at the first column of numbers.
    """
    metric = entry["metric"]
    names = [entry["largest"]] if metric == "largest" else entry["columns"]
    if "curve" in entry:
        curves = {entry["curve"]: _named(curves, entry["curve"])}
    holders = [columns for columns in curves.values() if all(name in columns for name in names)]
    if not holders:
        raise ValueError(f"no curve has the columns {names}")
    places = [_first_of_numbers(columns) for columns in holders]
    x = np.concatenate([columns[name] for columns, name in zip(holders, places, strict=True)])
    values = [np.concatenate([columns[name] for columns in holders]) for name in names]
    if metric == "range":
        low, high = entry["range"]
        x, found = np.tile(x, len(names)), np.concatenate(values)
        middle = np.full(len(found), (low + high) / 2)
        residuals = comparison.difference_residuals(x, found, middle, (high - low) / 2)
        return Measured(places[0], residuals, np.repeat(names, len(values[0])).tolist())
    other, sigma = (values[1], BALANCE_SIGMA) if metric == "balance" else (np.zeros(len(x)), 1.0)
    residuals = comparison.difference_residuals(x, values[0], other, sigma)
    return Measured(places[0], residuals, [names[0]] * len(x))


def _expansion(entry, curves):
    """How much further apart neighbours of a curve leave than they arrive, at most at each place.

    The printed equations need not keep to that.
    """
    x, y = entry["columns"]
    parts = []
    for name, columns in curves.items():
        drawn = not any(word in name for word in ("as printed", "1 sigma"))
        if drawn and x in columns and y in columns:
            keys = [columns[label] for label in reversed(entry.get("labels", []))]
            order = np.lexsort([columns[x], *keys])
            same = np.ones(len(order) - 1, bool)
            for key in keys:
                same &= key[order][1:] == key[order][:-1]
            arrive, leave = (np.abs(np.diff(columns[axis][order]))[same] for axis in (x, y))
            excess = np.maximum(leave - arrive, 0.0)
            parts.append(Residuals(columns[x][order][1:][same], excess, excess))
    if not parts:
        raise ValueError(f"no curve has the columns {entry['columns']}")
    places, where = np.unique(np.concatenate([part.x for part in parts]), return_inverse=True)
    excess = np.zeros(len(places))
    np.maximum.at(excess, where, np.concatenate([part.plain for part in parts]))
    return Measured(x, Residuals(places, excess, excess), [y] * len(places))


def _first_of_numbers(columns):
    return next(name for name, values in columns.items() if values.dtype.kind == "f")


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


def _note(entry, found, verdict):
    """What is known of a difference; of a new one, where it is largest."""
    documented = entry.get("documented", {})
    known = (
        f"ledger: {documented['entry']}" if "entry" in documented else documented.get("note", "")
    )
    sigmas = np.abs(found.residuals.sigmas)
    if verdict != Verdict.DIVERGES or len(sigmas) == 1:
        return known
    worst = int(sigmas.argmax())
    place = f"largest for {found.columns[worst]} at {found.quantity} = {found.residuals.x[worst]:g}"
    return "; ".join(words for words in (known, place) if words)


def _numbers(entry, known, found, significance):
    distance = found.residuals.summary()
    cells = {
        "points": distance.points,
        "rms [sigma]": f"{distance.rms:.3g}",
        "max [sigma]": f"{distance.max:.3g}",
        "rms [axis units]": f"{distance.plain_rms:.3g}",
        "allowed": _allowed(entry, known, significance),
        "regression": ", ".join(
            f"{low:g} <= {key} <= {high:g}"
            for key, (low, high) in entry.get("regression", {}).items()
        ),
    }
    if _is_published(known):
        chi2 = _chi_squared(known, found)
        cells |= {"chi^2": f"{chi2.value:.3g}", "degrees of freedom": chi2.degrees}
        cells["degrees of sigma"] = chi2.of_sigma or ""
        cells["p"] = f"{chi2.p:.2g}"
    return cells


def _allowed(entry, known, significance):
    if "range" in entry:
        return "{:g} to {:g}".format(*entry["range"])
    if not _is_published(known):
        return f"max <= {entry.get('limit', 1.0):g}"
    words = f"p > {significance:g}"
    if "allowance" not in entry:
        return words
    axes = known["x"], known["y"]
    sizes = zip(axes, _sigma(entry, *axes), strict=True)
    unit = ", ".join(f"{axis['column']} {size:.3g} {axis['unit']}" for axis, size in sizes)
    return f"{words}; 1 is {unit}: allowance for the model and sigma together".replace("_", " ")


def _row(figure, name, verdict, **cells):
    row = dict.fromkeys(COLUMNS, "")
    return row | {"figure": figure, "comparison": name, "verdict": str(verdict)} | cells


def write(rows, verdicts, residuals):
    """Write both tables of the `rows` that `compare` gave."""
    csv_tables.write_rows(verdicts, COLUMNS, [[row[column] for column in COLUMNS] for row in rows])
    points = [point for row in rows for point in row.get("residuals", [])]
    csv_tables.write_rows(residuals, RESIDUALS, points)
