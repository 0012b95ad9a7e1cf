"""The kinds of metric: what a comparison measures, and against what.

Against a series of points: `distance` from a curve, or from its `vertices`. Against a stated fact:
a `landmark` of a curve. Against a law, without a reference: a column that must be `small`, or two
that must be equal; columns whose values have a `range`; or neighbours that must not leave further
apart than they arrive (`contraction`).
"""

from collections.abc import Callable, Iterable, Sequence
from typing import NamedTuple

import numpy as np

from planarimpact.common.arrays import Array
from stronge1994 import curve_names, reference_data
from stronge1994.csv_tables import Columns, Curves
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
    series = points(entry, reference)
    residuals, columns = _from_series(entry, reference, curves, series)
    # The curve is solved again with each uncertain parameter off by one sigma, up and down.
    shifts = []
    for up, down in curve_names.shifted_by(entry.get("curve"), curves):
        upper, _ = _from_series({**entry, "curve": up}, reference, curves, series)
        lower, _ = _from_series({**entry, "curve": down}, reference, curves, series)
        shift = (upper.sigmas - lower.sigmas) / 2
        # An error of a parameter moves all points together, unless each point has its own.
        shifts += list(np.diag(shift)) if curve_names.EACH in up else [shift]
    x = reference_data.column_name(reference["x"])
    return Measured(x, residuals, columns, np.reshape(shifts, (len(shifts), len(columns))))


def _from_series(
    entry: Entry, reference: Reference, curves: Curves, series: Columns
) -> tuple[Residuals, list[str]]:
    """Distances of points from a curve or from vertices, and the column of each.

    The curve is the named one, or that which each point names.
    """
    x, labels = reference_data.column_name(reference["x"]), reference.get("labels", [])
    of_curves = entry["metric"] == "distance"
    owners = series["curve"] if of_curves and "curve" not in entry else np.full(len(series[x]), "")
    parts: list[Residuals] = []
    columns: list[str] = []
    for owner in dict.fromkeys(owners.tolist()):
        for axis in reference_data.ordinates(reference):
            y, name = reference_data.column_name(axis), owner or entry.get("curve")
            chosen = rows_of(series, (owners == owner) & ~np.isnan(series[y]))
            if not len(chosen[y]):
                continue
            scale = sigma(entry, (reference["x"], axis), chosen)
            if of_curves:
                line = _columns_of(curves, name, [x, y])
                polyline = line[x], line[y]
                parts.append(distances.curve_residuals((chosen[x], chosen[y]), polyline, scale))
                columns += [f"{y} of {name}"] * len(chosen[y])
            else:
                own = _columns_of(curves, name, [x, y, *labels])
                found, vertices = (
                    (some[x], some[y], _labels(some, labels)) for some in (chosen, own)
                )
                parts.append(distances.vertex_residuals(found, vertices, scale))
                columns += [f"{y} of {label}" if label else y for label in found[2]]
    joined = (np.concatenate(arrays) for arrays in zip(*parts, strict=True))
    return Residuals(*joined), columns


def _labels(columns: Columns, label_columns: Iterable[str]) -> list[str]:
    """A label for each row: its entries in the label columns, else empty."""
    if not label_columns:
        return [""] * len(next(iter(columns.values())))
    rows = zip(*(columns[name] for name in label_columns), strict=True)
    return [", ".join(map(str, row)) for row in rows]


def _landmark(entry: Entry, fact: Reference, curves: Curves) -> Measured:
    """A landmark against a stated fact."""
    kind, x, y = (entry["landmark"][key] for key in ("kind", "x", "y"))
    own = _columns_of(curves, entry["curve"], [x, y])
    value = landmarks.find(kind, own[x], own[y], entry["landmark"].get("at"))
    quantity = y if kind == "value" else x
    return Measured(quantity, distances.fact_residuals(value, fact), [quantity])


def _of_law(entry: Entry, curves: Curves) -> tuple[str, Array, Array]:
    """The columns of a law, in all curves that have them.

    First come name and values of the first column of numbers, which says where the points lie.
    """
    own = _columns_of(curves, entry.get("curve"), entry["columns"])
    first = next(name for name, values in own.items() if values.dtype.kind == "f")
    return first, own[first], np.array([own[name] for name in entry["columns"]])


def _small(entry: Entry, curves: Curves) -> Measured:
    """A column that must be small, or two that must be equal up to `BALANCE_SIGMA`."""
    first, x, values = _of_law(entry, curves)
    gap, scale = (values[0] - values[1], BALANCE_SIGMA) if len(values) == 2 else (values[0], 1.0)
    return Measured(first, Residuals(x, gap / scale, gap), [entry["columns"][0]] * len(x))


def _range(entry: Entry, curves: Curves) -> Measured:
    """Columns that must lie in a range: distances from its middle, in half its width."""
    names, (low, high) = entry["columns"], entry["range"]
    first, x, values = _of_law(entry, curves)
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


def _columns_of(curves: Curves, name: str | None, needed: Sequence[str]) -> Columns:
    """Columns of the named curve, or of all curves that have the `needed` ones, joined.

    `curve` has the name of each row's curve.
    """
    if name is not None and name not in curves:
        raise ValueError(f"no curve {name!a}; the figure has {', '.join(curves)}")
    holders = [
        own | {"curve": np.full(len(next(iter(own.values()))), key)}
        for key, own in (curves if name is None else {name: curves[name]}).items()
        if {*needed} <= {"curve", *own}
    ]
    if not holders:
        which = "no curve has" if name is None else f"curve {name!a} does not have"
        raise ValueError(f"{which} the columns {', '.join(needed)}")
    shared = [key for key in holders[0] if all(key in own for own in holders)]
    return {key: np.concatenate([own[key] for own in holders]) for key in shared}
