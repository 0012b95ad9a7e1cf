"""The kinds of metric: what a comparison measures, and against what.

Against a series of points: `distance` from a curve, or from its `vertices`. Against a stated fact:
a `landmark` of a curve. Against a law, without a reference: a column that must be `small`, or two
that must be equal; columns whose values have a `range`; or neighbours that must not leave further
apart than they arrive (`contraction`).
"""

from collections.abc import Callable, Iterable
from typing import NamedTuple, TypeAlias

import numpy as np

from planarimpact.ground.arrays import Array
from stronge1994 import curve_names, reference_data
from stronge1994.csv_tables import Column, Columns, Curves
from stronge1994.judging import distances, landmarks
from stronge1994.judging.distances import Residuals
from stronge1994.judging.points import Entry, Reference, points, rows_of, sigma

# Two ways to compute one energy agree to this; see the reason of the comparison.
BALANCE_SIGMA = 1e-12
# Both ends of a range lie within this many times the largest value: two digits are for the rounding
# of other machines, and a wider range tests nothing.
LARGEST_RANGE_RATIO = 100


class Measured(NamedTuple):
    """How far curves are from what a comparison names.

    `quantity` is the column of the points' positions; `columns` names the column of each residual.
    `shifts` has a row for each uncertain parameter: the change of all residuals if it is off by one
    sigma.
    """

    quantity: str
    residuals: Residuals
    columns: list[str]
    shifts: Array = np.zeros((0, 0))


def measure(entry: Entry, reference: Reference, curves: Curves) -> Measured:
    """Distances of one comparison; a `ValueError` says what is missing."""
    if entry["metric"] in _LAWS:
        return _LAWS[entry["metric"]](entry, curves)
    if entry["metric"] == "landmark":
        return _landmark(entry, reference, curves)
    find = _from_curve if entry["metric"] == "distance" else _from_vertices
    series = points(entry, reference)
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
    owners = np.full(len(series[x]), entry["curve"]) if "curve" in entry else series["curve"]
    parts: list[Residuals] = []
    columns: list[str] = []
    for name in dict.fromkeys(owners.tolist()):
        for axis in reference_data.ordinates(reference):
            y = reference_data.column_name(axis)
            chosen = rows_of(series, (owners == name) & ~np.isnan(series[y]))
            if len(chosen[y]):
                polyline = _columns_of(curves, name, x, y)
                scale = sigma(entry, (reference["x"], axis), chosen)
                parts.append(distances.curve_residuals((chosen[x], chosen[y]), polyline, scale))
                columns += [f"{y} of {name}"] * len(chosen[y])
    return _joined(parts), columns


def _from_vertices(
    entry: Entry, reference: Reference, curves: Curves, series: Columns
) -> _ResidualsAndColumns:
    """Distances from the vertices with the same labels."""
    x, names = reference_data.column_name(reference["x"]), reference.get("labels", [])
    named = [
        own | {"curve": np.full(len(own[x]), name)}
        for name, own in _selected_curves(entry, curves).items()
        if x in own
    ]
    parts: list[Residuals] = []
    columns: list[str] = []
    for axis in reference_data.ordinates(reference):
        y = reference_data.column_name(axis)
        chosen = rows_of(series, ~np.isnan(series[y]))
        if len(chosen[y]):
            holders = [own for own in named if {y, *names} <= set(own)]
            if not holders:
                raise ValueError(f"no curve has the columns '{x}' and '{y}'")
            labels = _labels(chosen, names)
            vertices = (
                np.concatenate([own[x] for own in holders]),
                np.concatenate([own[y] for own in holders]),
                [label for own in holders for label in _labels(own, names)],
            )
            scale = sigma(entry, (reference["x"], axis), chosen)
            points_there = chosen[x], chosen[y], labels
            parts.append(distances.vertex_residuals(points_there, vertices, scale))
            columns += [f"{y} of {label}" if label else y for label in labels]
    return _joined(parts), columns


def _joined(parts: Iterable[Residuals]) -> Residuals:
    return Residuals(*(np.concatenate(arrays) for arrays in zip(*parts, strict=True)))


def _labels(columns: Columns, label_columns: Iterable[str]) -> list[str]:
    """A label for each row: its entries in the label columns, else empty."""
    if not label_columns:
        return [""] * len(next(iter(columns.values())))
    rows = zip(*(columns[name] for name in label_columns), strict=True)
    return [", ".join(map(str, row)) for row in rows]


def _landmark(entry: Entry, fact: Reference, curves: Curves) -> Measured:
    """A landmark against a stated fact."""
    kind, x, y = (entry["landmark"][key] for key in ("kind", "x", "y"))
    places, values = _columns_of(curves, entry["curve"], x, y)
    value = landmarks.find(kind, places, values, entry["landmark"].get("at"))
    quantity = y if kind == "value" else x
    return Measured(quantity, distances.fact_residuals(value, fact), [quantity])


def _of_all_curves(entry: Entry, curves: Curves) -> tuple[str, Array, Array]:
    """The columns of a law, one curve that has them after the other.

    First come name and values of the first column of numbers, which says where the points lie.
    """
    names = entry["columns"]
    holders = [own for own in _selected_curves(entry, curves).values() if {*names} <= set(own)]
    if not holders:
        raise ValueError(f"no curve has the columns {names}")
    first = next(name for name, values in holders[0].items() if values.dtype.kind == "f")
    x, *values = (np.concatenate([own[name] for own in holders]) for name in (first, *names))
    return first, x, np.array(values)


def _small(entry: Entry, curves: Curves) -> Measured:
    """A column that must be small, or two that must be equal up to `BALANCE_SIGMA`."""
    first, x, values = _of_all_curves(entry, curves)
    gap, scale = (values[0] - values[1], BALANCE_SIGMA) if len(values) == 2 else (values[0], 1.0)
    return Measured(first, Residuals(x, gap / scale, gap), [entry["columns"][0]] * len(x))


def _range(entry: Entry, curves: Curves) -> Measured:
    """Columns that must lie in a range: distances from its middle, in half its width."""
    names, (low, high) = entry["columns"], entry["range"]
    first, x, values = _of_all_curves(entry, curves)
    most = LARGEST_RANGE_RATIO * np.abs(values).max()
    if max(abs(low), abs(high)) >= most:
        raise ValueError(
            f"range {low:g} to {high:g}: allowed are ends nearer to 0 than {most:g}, "
            f"{LARGEST_RANGE_RATIO} times the largest value; a wider range tests nothing"
        )
    gap = values.ravel() - (low + high) / 2
    residuals = Residuals(np.tile(x, len(names)), gap / ((high - low) / 2), gap)
    return Measured(first, residuals, np.repeat(names, len(x)).tolist())


def _contraction(entry: Entry, curves: Curves) -> Measured:
    """Largest excess of the distance of neighbours at departure over that at arrival, by place."""
    x, y = entry["columns"]
    parts = []
    for name, columns in curves.items():
        # The printed equations need not obey this law.
        obeys = not (curve_names.AS_PRINTED in name or curve_names.is_shifted(name))
        if obeys and name.startswith(entry.get("beginning", "")) and {x, y} <= set(columns):
            order = np.argsort(columns[x], kind="stable")
            arrive, leave = (np.abs(np.diff(columns[axis][order])) for axis in (x, y))
            parts.append((columns[x][order][1:], np.maximum(leave - arrive, 0.0)))
    if not parts:
        raise ValueError(f"no curve has the columns {entry['columns']}")
    at, excesses = (np.concatenate(arrays) for arrays in zip(*parts, strict=True))
    places, place_of = np.unique(at, return_inverse=True)
    excess = np.zeros(len(places))
    np.maximum.at(excess, place_of, excesses)
    return Measured(x, Residuals(places, excess, excess), [y] * len(places))


_LAWS: dict[str, Callable[[Entry, Curves], Measured]] = {
    "small": _small,
    "range": _range,
    "contraction": _contraction,
}


def _selected_curves(entry: Entry, curves: Curves) -> Curves:
    """The one curve that the comparison names, or all of them."""
    if "curve" not in entry:
        return curves
    return {entry["curve"]: _named(curves, entry["curve"])}


def _named(curves: Curves, name: str) -> Columns:
    if name not in curves:
        raise ValueError(f"no curve '{name}'; the figure has {', '.join(curves)}")
    return curves[name]


def _columns_of(curves: Curves, name: str, *columns: str) -> list[Column]:
    curve = _named(curves, name)
    missing = [column for column in columns if column not in curve]
    if missing:
        raise ValueError(f"curve '{name}' has no column '{missing[0]}'")
    return [curve[column] for column in columns]
