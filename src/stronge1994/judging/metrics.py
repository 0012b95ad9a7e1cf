"""The kinds of metric: what a comparison measures, and against what.

Against a series of points: `distance` from a curve, or from its `vertices`. Against a stated fact:
a `landmark` of a curve. Against a law, without a reference: two columns that must be equal
(`balance`), one that must be small (`largest`), columns whose values have a `range`, or neighbours
that must not leave further apart than they arrive (`contraction`).
"""

from collections.abc import Callable, Iterable
from typing import NamedTuple, TypeAlias

import numpy as np

from planarimpact.ground.arrays import Array, Booleans
from stronge1994 import curve_names, reference_data
from stronge1994.csv_tables import Column, Columns, Curves
from stronge1994.judging import distances, landmarks
from stronge1994.judging.distances import Residuals
from stronge1994.judging.points import Entry, Reference, points, sigma

# Two ways to compute one energy agree to this; see the reason of the comparison.
BALANCE_SIGMA = 1e-12
# Both ends of a range lie within this many times the largest value: two digits are for the rounding
# of other machines, and a wider range tests nothing.
LARGEST_RANGE_RATIO = 100


class Measured(NamedTuple):
    """How far curves are from what a comparison names.

    `quantity` is the column of the points' positions; `columns` names the column of each residual.
    `shifts` has a row for each uncertain parameter: the change of all residuals if it is off by one
    sigma. Only a landmark has a `gap`, its value minus the stated one, and `texts`, both values as
    a page shows them.
    """

    quantity: str
    residuals: Residuals
    columns: list[str]
    shifts: Array = np.zeros((0, 0))
    gap: float | None = None
    texts: dict[str, str] = {}


def measure(entry: Entry, reference: Reference | None, curves: Curves) -> Measured:
    """Distances of one comparison; a `ValueError` says what is missing."""
    if entry["metric"] in _LAWS:
        return _LAWS[entry["metric"]](entry, curves)
    if reference is None:
        raise ValueError("the reference is not there")
    if entry["metric"] == "landmark":
        return _landmark(entry, reference, curves)
    find = _from_curve if entry["metric"] == "distance" else _from_vertices
    series = points(entry, reference)
    if "curve" in reference.get("labels", []):
        _refuse_other_curves(series["curve"].tolist(), curves, "reference")
    residuals, columns = find(entry, reference, curves, series)
    # The curve is solved again with each uncertain parameter off by one sigma, up and down.
    shifts = []
    for up, down in curve_names.shifted_by(entry.get("curve"), curves):
        upper, _ = find({**entry, "curve": up}, reference, curves, series)
        lower, _ = find({**entry, "curve": down}, reference, curves, series)
        shift = (upper.sigmas - lower.sigmas) / 2
        # An error of a parameter moves all points together, unless each point has its own.
        shifts += list(np.diag(shift)) if curve_names.EACH in up else [shift]
    x = reference_data.column_name(reference["x"])
    return Measured(x, residuals, columns, np.reshape(shifts, (len(shifts), len(columns))))


# Distances, and the column of each.
_ResidualsAndColumns: TypeAlias = tuple[Residuals, list[str]]


def _from_curve(
    entry: Entry, reference: Reference, curves: Curves, series: Columns
) -> _ResidualsAndColumns:
    """Distances from the polyline of the named curve, or of the curve that each point names."""
    x = reference_data.column_name(reference["x"])
    parts: list[Residuals] = []
    columns: list[str] = []
    names = [entry["curve"]] if "curve" in entry else dict.fromkeys(series["curve"])
    for name in names:
        own = np.ones(len(series[x]), bool) if "curve" in entry else series["curve"] == name
        for axis in reference_data.ordinates(reference):
            y = reference_data.column_name(axis)
            chosen = _rows(series, own & ~np.isnan(series[y]))
            if len(chosen[y]):
                polyline = _columns_of(curves, name, x, y)
                part = distances.curve_residuals(
                    (chosen[x], chosen[y]),
                    polyline,
                    sigma(entry, (reference["x"], axis), chosen),
                    both_ways=reference.get("line", False),
                )
                parts.append(part)
                columns += [f"{y} of {name}"] * len(part.x)
    return _joined(parts), columns


def _from_vertices(
    entry: Entry, reference: Reference, curves: Curves, series: Columns
) -> _ResidualsAndColumns:
    """Distances from the vertices with the same labels."""
    x, label_columns = reference_data.column_name(reference["x"]), reference.get("labels", [])
    needed = {x, *label_columns} - {"curve"}
    labelled = [
        (columns, _labels(columns | {"curve": np.full(len(columns[x]), name)}, label_columns))
        for name, columns in _selected_curves(entry, curves).items()
        if needed <= set(columns)
    ]
    labels = _labels(series, label_columns)
    parts: list[Residuals] = []
    columns: list[str] = []
    for axis in reference_data.ordinates(reference):
        y = reference_data.column_name(axis)
        present = ~np.isnan(series[y])
        if present.any():
            own = [label for label, inside in zip(labels, present, strict=True) if inside]
            chosen = _rows(series, present)
            labelled_points, vertices = (chosen[x], chosen[y], own), _vertices(labelled, x, y)
            scale = sigma(entry, (reference["x"], axis), chosen)
            parts.append(distances.vertex_residuals(labelled_points, vertices, scale))
            columns += [f"{y} of {label}" if label else y for label in own]
    return _joined(parts), columns


def _rows(series: Columns, chosen: Booleans) -> Columns:
    return {column: values[chosen] for column, values in series.items()}


def _joined(parts: Iterable[Residuals]) -> Residuals:
    return Residuals(*(np.concatenate(arrays) for arrays in zip(*parts, strict=True)))


def _vertices(
    labelled: Iterable[tuple[Columns, list[str]]], x: str, y: str
) -> tuple[Array, Array, list[str]]:
    """Vertices of all curves that have both columns: x, y, labels."""
    holders = [(columns, labels) for columns, labels in labelled if y in columns]
    if not holders:
        raise ValueError(f"no curve has the columns '{x}' and '{y}'")
    return (
        np.concatenate([columns[x] for columns, _ in holders]),
        np.concatenate([columns[y] for columns, _ in holders]),
        [label for _, labels in holders for label in labels],
    )


def _labels(columns: Columns, label_columns: Iterable[str]) -> list[str]:
    """A label for each row: its entries in the label columns, else empty."""
    if not label_columns:
        return [""] * len(next(iter(columns.values())))
    rows = zip(*(columns[name] for name in label_columns), strict=True)
    return [", ".join(map(str, row)) for row in rows]


def _landmark(entry: Entry, fact: Reference, curves: Curves) -> Measured:
    """A landmark against a stated fact."""
    landmark = entry["landmark"]
    options = [landmark[key] for key in ("regime", "level", "at") if key in landmark]
    names = [landmark["x"], "regime" if "regime" in landmark else landmark["y"]]
    find = getattr(landmarks, landmark["kind"])
    value = find(*_columns_of(curves, entry["curve"], *names), *options)
    unit = "" if fact["unit"] == "1" else f" {fact['unit']}"
    signs = {"value": "", "less_than": "< ", "greater_than": "> "}
    stated = "".join(f"{sign}{fact[key]:g}{unit}" for key, sign in signs.items() if key in fact)
    gap = value - fact["value"] if "value" in fact else None
    quantity = names[1] if landmark["kind"] == "value_at" else names[0]
    texts = {"found": f"{value:.4g}", "stated": stated}
    residuals = distances.fact_residuals(value, fact)
    return Measured(quantity, residuals, [quantity], gap=gap, texts=texts)


class _Table(NamedTuple):
    """The same columns of all curves that have them, one curve after the other."""

    first: str  # the first column of numbers, which says where the points lie
    x: Array  # its values
    values: list[Array]  # of the columns asked for


def _concatenated(entry: Entry, curves: Curves, names: list[str]) -> _Table:
    holders = [
        columns
        for columns in _selected_curves(entry, curves).values()
        if all(name in columns for name in names)
    ]
    if not holders:
        raise ValueError(f"no curve has the columns {names}")
    places = [_first_of_numbers(columns) for columns in holders]
    x = np.concatenate([columns[name] for columns, name in zip(holders, places, strict=True)])
    values = [np.concatenate([columns[name] for columns in holders]) for name in names]
    return _Table(places[0], x, values)


def _balance(entry: Entry, curves: Curves) -> Measured:
    """Two columns that must be equal."""
    names = entry["columns"]
    first, x, (left, right) = _concatenated(entry, curves, names)
    residuals = distances.difference_residuals(x, left, right, BALANCE_SIGMA)
    return Measured(first, residuals, [names[0]] * len(x))


def _largest(entry: Entry, curves: Curves) -> Measured:
    """A column that must be small."""
    name = entry["largest"]
    first, x, (values,) = _concatenated(entry, curves, [name])
    residuals = distances.difference_residuals(x, values, np.zeros(len(x)), 1.0)
    return Measured(first, residuals, [name] * len(x))


def _range(entry: Entry, curves: Curves) -> Measured:
    """Columns that must lie in a range: distances from its middle, in half its width."""
    names, (low, high) = entry["columns"], entry["range"]
    first, x, values = _concatenated(entry, curves, names)
    joined = np.concatenate(values)
    most = LARGEST_RANGE_RATIO * np.abs(joined).max()
    if max(abs(low), abs(high)) >= most:
        raise ValueError(
            f"range {low:g} to {high:g}: allowed are ends nearer to 0 than {most:g}, "
            f"{LARGEST_RANGE_RATIO} times the largest value; a wider range tests nothing"
        )
    middle = np.full(len(joined), (low + high) / 2)
    at = np.tile(x, len(names))
    residuals = distances.difference_residuals(at, joined, middle, (high - low) / 2)
    return Measured(first, residuals, np.repeat(names, len(x)).tolist())


def _contraction(entry: Entry, curves: Curves) -> Measured:
    """Largest excess of the distance of neighbours at departure over that at arrival, by place."""
    x, y = entry["columns"]
    beginning = entry.get("beginning", "")
    parts = []
    for name, columns in curves.items():
        # The printed equations need not obey this law.
        drawn = not (curve_names.is_printed(name) or curve_names.is_shifted(name))
        drawn &= name.startswith(beginning)
        if drawn and x in columns and y in columns:
            keys = [columns[label] for label in reversed(entry.get("labels", []))]
            order = np.lexsort([columns[x], *keys])
            # Only rows with the same labels are neighbours.
            same = np.ones(len(order) - 1, bool)
            for key in keys:
                same &= key[order][1:] == key[order][:-1]
            arrive, leave = (np.abs(np.diff(columns[axis][order]))[same] for axis in (x, y))
            excess = np.maximum(leave - arrive, 0.0)
            parts.append(Residuals(columns[x][order][1:][same], excess, excess))
    if not parts:
        raise ValueError(f"no curve has the columns {entry['columns']}")
    places, place_of = np.unique(np.concatenate([part.x for part in parts]), return_inverse=True)
    excess = np.zeros(len(places))
    np.maximum.at(excess, place_of, np.concatenate([part.plain for part in parts]))
    return Measured(x, Residuals(places, excess, excess), [y] * len(places))


_LAWS: dict[str, Callable[[Entry, Curves], Measured]] = {
    "balance": _balance,
    "largest": _largest,
    "range": _range,
    "contraction": _contraction,
}


def _first_of_numbers(columns: Columns) -> str:
    return next(name for name, values in columns.items() if values.dtype.kind == "f")


def _selected_curves(entry: Entry, curves: Curves) -> Curves:
    """The one curve that the comparison names, or all of them."""
    if "curve" not in entry:
        return curves
    return {entry["curve"]: _named(curves, entry["curve"])}


def _refuse_other_curves(asked: Iterable[str], curves: Curves, of: str) -> None:
    """Refuse curves that lack one of those that are `asked` for, and say which values both have."""
    asked = list(asked)
    missing = [name for name in asked if name not in curves]
    if missing:
        own = curve_names.values(curves)
        for symbol, values in curve_names.values(asked).items():
            known = own.get(symbol, [])
            if known and not set(values) <= set(known):
                both = f"{symbol} = {', '.join(values)}; the figure has {', '.join(known)}"
                raise ValueError(f"the {of} has {both}")
        raise ValueError(f"no curve '{missing[0]}'; the figure has {', '.join(curves)}")


def _named(curves: Curves, name: str) -> Columns:
    _refuse_other_curves([name], curves, "comparison")
    return curves[name]


def _columns_of(curves: Curves, name: str, *columns: str) -> list[Column]:
    curve = _named(curves, name)
    missing = [column for column in columns if column not in curve]
    if missing:
        raise ValueError(f"curve '{name}' has no column '{missing[0]}'")
    return [curve[column] for column in columns]
