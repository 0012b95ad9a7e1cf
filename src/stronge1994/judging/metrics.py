"""Distances of curves from what a comparison names, by its metric."""

from collections.abc import Iterable, Iterator, Sequence
from typing import Any, NamedTuple

import numpy as np

from planarimpact.common.arrays import Array
from stronge1994 import tables
from stronge1994.judging import distances, landmarks
from stronge1994.judging.comparisons import Comparison, Metric
from stronge1994.names import PRINTED
from stronge1994.reference_data import Fact, Series
from stronge1994.tables import Table

# Both ends of a range lie within this many times the largest value: two digits are for the rounding
# of other machines, and a wider range tests nothing.
LARGEST_RANGE_RATIO = 100


class Measured(NamedTuple):
    """How far curves are from what a comparison names, at each of some points.

    `quantity` is the column of their positions `at`. `sigmas` and `plain` are `Distances`; of each
    one `scales` has the sigma in the unit of its axis, `columns` its column, and `curves` its
    curve, if that is not the only one. `shifts` has a row for each error that the points share: the
    change of all `sigmas` if it is of one sigma. `of_sigma` is the number of values from which the
    sigmas were estimated, None if they are known.

    `places` and `directions` are those of `distances.FromCurve`. `factor` is that of the curve if
    it was fitted, see `judging.scales`; `note` tells of the fit.
    """

    quantity: str
    at: Array
    sigmas: Array
    plain: Array
    scales: Array
    columns: list[str]
    curves: Sequence[str] = ()
    shifts: Array = np.zeros((0, 0))
    of_sigma: int | None = None
    places: Array = np.zeros((0, 2))
    directions: Array = np.zeros((0, 2))
    factor: float | None = None
    note: str = ""

    @property
    def wider(self) -> Array:
        """Change of all `sigmas` for a curve that is too long along x by its own length."""
        return self.places[:, 0] * self.directions[:, 0]

    @property
    def larger(self) -> Array:
        """Change of all `sigmas` for a curve that is too large along y by its own size."""
        return self.places[:, 1] * self.directions[:, 1]

    @property
    def free(self) -> Array | None:
        """The error that the fit of a factor takes away, see `goodness.chi_squared`."""
        return None if self.factor is None else self.larger

    @property
    def worst(self) -> int:
        """Place of the largest distance in sigmas."""
        return int(np.abs(self.sigmas).argmax())

    @property
    def sizes(self) -> tuple[float, float]:
        """Root mean square and largest distance in the unit of the axis.

        Columns of several units have none in common: these are of the one with the `worst`.
        """
        return rms_and_max(self.plain[np.array(self.columns) == self.columns[self.worst]])


def rms_and_max(distances: Array) -> tuple[float, float]:
    """Root mean square and largest size of distances."""
    return float(np.sqrt(np.mean(distances**2))), float(np.abs(distances).max())


def measure(comparison: Comparison, curves: Table) -> Measured:
    """Distances of one comparison; a `ValueError` says what is missing."""
    reference = comparison.reference
    if isinstance(reference, Series):
        return _from_points(comparison, reference, curves)
    if isinstance(reference, Fact):
        return _from_fact(comparison, reference, curves)
    return _LAWS[comparison.metric](comparison, curves)


def _from_points(comparison: Comparison, series: Series, curves: Table) -> Measured:
    points = comparison.selected_points(series)
    found = _distances(comparison, series, *points, curves)
    shifts: list[Array] = []
    for own, *both in _off_by_a_sigma(comparison, series, curves) if comparison.curve else ():
        up, down = (_distances(comparison, series, *points, off).sigmas for off in both)
        shift = (up - down) / 2
        # An error of a parameter moves all points together, unless each point has its own.
        shifts += list(np.diag(shift)) if own else [shift]
    if series.calibration:
        shifts += list(series.calibration.shifts(found.places, found.directions))
    every = np.reshape(shifts, (len(shifts), len(found.at)))
    return found._replace(shifts=every, of_sigma=series.sigma_values)


def _distances(
    comparison: Comparison, series: Series, points: Table, sigmas: list[Array], curves: Table
) -> Measured:
    """Distances of points from the curves, or from their vertices, that they select.

    A point selects by its labels, as far as the comparison does not.
    """
    fixed = {key: "" for key in tables.DEFAULTS if key in curves and key not in series.labels}
    chosen = curves[tables.where(curves, **fixed | comparison.curve)]
    if chosen.empty:
        raise tables.no_curve(curves, fixed | comparison.curve)
    labels = [key for key in series.labels if key in chosen and key not in comparison.curve]
    # A label such as the number of a run is no choice among curves that do not have it.
    empty = [key for key in labels if chosen[key].isin(["", np.nan]).all()]
    labels = [key for key in labels if key in tables.KEYS or key not in empty]
    _refuse_missing(chosen, [axis.name for axis in (series.x, *series.ordinates)])
    pairs = [[series.x.name, axis.name] for axis in series.ordinates]
    of_points, of_curves = (
        [table[pair].to_numpy(float) for pair in pairs] for table in (points, chosen)
    )
    rows_of, find = _rows_by_labels(chosen, labels), _FROM_POINTS[comparison.metric]
    curve_of = chosen[["curve"]]  # a row of all columns takes longer to pick
    parts: list[tuple[Array, ...]] = []
    columns: list[str] = []
    names: list[str] = []
    for values, at in _rows_by_labels(points, labels).items():
        wanted = dict(zip(labels, values, strict=True))
        if values not in rows_of:
            raise tables.no_curve(curves, fixed | wanted | comparison.curve)
        of = tables.only_curve(curve_of.take(rows_of[values]))
        for (_, y), places, lines, sigma in zip(pairs, of_points, of_curves, sigmas, strict=True):
            line = lines[rows_of[values]]
            line, there = line[~np.isnan(line[:, 1])], ~np.isnan(places[at, 1])
            if there.any() and not len(line):
                raise ValueError(f"{of} has no column {y!a}")
            if there.any():
                some, both = places[at][there], sigma[at][there].T
                parts.append((some[:, 0], both[1], *find(some.T, line.T, tuple(both))))
                columns += [y] * len(some)
                names += [of] * len(some)
    at_x, scales, *found = map(np.concatenate, zip(*parts, strict=True))
    near = distances.FromCurve(*found)
    own = Measured(series.x.name, at_x, near.sigmas, near.plain, scales, columns, names)
    return own._replace(places=near.places, directions=near.directions)


def _rows_by_labels(table: Table, labels: list[str]) -> dict[tuple[Any, ...], list[int]]:
    """Places of the rows with the same labels; all rows if there are no labels."""
    keys = table[labels].astype(object).fillna("")
    found: dict[tuple[Any, ...], list[int]] = {}
    for row, key in enumerate(zip(*(keys[label] for label in labels), strict=True)):
        found.setdefault(key, []).append(row)
    return found if labels else {(): list(range(len(table)))}


def _off_by_a_sigma(
    comparison: Comparison, series: Series, curves: Table
) -> Iterator[tuple[bool, Table, Table]]:
    """Tables with one uncertain parameter off by a sigma, up and down; whether it is each point's.

    Curves are solved again for a parameter that all points share.
    """
    own = tables.select(curves, **comparison.curve)
    scattered = {y.name: tables.sigma_name(y.name) for y in series.ordinates}
    scattered = {y: sigma for y, sigma in scattered.items() if sigma in own}
    if scattered:
        up, down = (
            curves.assign(**{y: curves[y] + sign * curves[sigma] for y, sigma in scattered.items()})
            for sign in (1, -1)
        )
        yield True, up, down
    if "shifted" in curves:
        wanted = {"variant": ""} | dict(comparison.curve)
        for parameter in curves["shifted"][tables.where(curves, **wanted)].unique():
            if parameter:
                up, down = (
                    curves[tables.where(curves, shifted=parameter, sigmas=sign)] for sign in (1, -1)
                )
                yield False, up.assign(shifted=""), down.assign(shifted="")


def _refuse_missing(curves: Table, columns: Iterable[str]) -> None:
    if missing := [column for column in columns if column not in curves]:
        raise ValueError(f"no such column: {', '.join(missing)}; there are {', '.join(curves)}")


def _from_fact(comparison: Comparison, fact: Fact, curves: Table) -> Measured:
    """A landmark against a stated fact."""
    sought = comparison.landmark
    assert sought is not None  # as `Comparison` asks
    own = tables.select(curves, **comparison.curve)
    tables.only_curve(own)
    _refuse_missing(own, (sought.x, sought.y))
    value = landmarks.find(sought.kind, own[sought.x], own[sought.y], sought.at)
    quantity = sought.y if sought.kind == "value" else sought.x
    scale = np.array([fact.tolerance or np.nan])  # an inequality has none
    found = distances.fact_residuals(value, fact)
    return Measured(quantity, np.array([value]), *found, scale, [quantity])


def _rows_of_law(comparison: Comparison, curves: Table) -> Table:
    """Rows of the curves that must obey a law and have all its columns.

    Without a selection these are all curves, but those off by a sigma and the printed equations.
    """
    if comparison.curve:
        curves = tables.select(curves, **comparison.curve)
    elif "model" in curves:
        curves = curves[curves["model"] != PRINTED]
        curves = curves[curves["shifted"] == ""] if "shifted" in curves else curves
    _refuse_missing(curves, comparison.columns)
    own = curves.dropna(subset=list(comparison.columns))
    return own.dropna(axis="columns", how="any")


def _of_law(comparison: Comparison, curves: Table) -> tuple[str, Array, Array]:
    """The columns of a law.

    First come name and values of the first quantity, which says where the points lie.
    """
    own = _rows_of_law(comparison, curves)
    first = next(filter(tables.is_quantity, own))
    return first, own[first].to_numpy(), own[list(comparison.columns)].to_numpy().T


def _law(quantity: str, at: Array, plain: Array, scale: float, columns: list[str]) -> Measured:
    return Measured(quantity, at, plain / scale, plain, np.full(len(at), scale), columns)


def _small(comparison: Comparison, curves: Table) -> Measured:
    """A column that must be small, or two that must be equal, up to the limit."""
    first, x, values = _of_law(comparison, curves)
    gap = values[0] - values[1] if len(values) == 2 else values[0]
    return _law(first, x, gap, comparison.limit, [comparison.columns[0]] * len(x))


def _range(comparison: Comparison, curves: Table) -> Measured:
    """Columns that must lie in a range: distances from its middle, in half its width."""
    assert comparison.range is not None  # as `Comparison` asks
    names, (low, high) = comparison.columns, comparison.range
    first, x, values = _of_law(comparison, curves)
    most = LARGEST_RANGE_RATIO * np.abs(values).max()
    if max(abs(low), abs(high)) >= most:
        raise ValueError(
            f"range {low:g} to {high:g}: allowed are ends nearer to 0 than {most:g}, "
            f"{LARGEST_RANGE_RATIO} times the largest value; a wider range tests nothing"
        )
    gap = values.ravel() - (low + high) / 2
    columns = np.repeat(names, len(x)).tolist()
    return _law(first, np.tile(x, len(names)), gap, (high - low) / 2, columns)


def _contraction(comparison: Comparison, curves: Table) -> Measured:
    """Largest excess of the distance of neighbours at departure over that at arrival, by place."""
    x, y = comparison.columns
    own = _rows_of_law(comparison, curves).sort_values(x, kind="stable")
    steps = own.groupby("curve", sort=False)[[x, y]].diff().abs().dropna()
    excess = (steps[y] - steps[x]).clip(lower=0.0).groupby(own[x]).max()
    places, largest = excess.index.to_numpy(), excess.to_numpy()
    return _law(x, places, largest, comparison.limit, [y] * len(places))


_FROM_POINTS = {
    Metric.DISTANCE: distances.curve_residuals,
    Metric.VERTICES: distances.vertex_residuals,
}
_LAWS = {Metric.SMALL: _small, Metric.RANGE: _range, Metric.CONTRACTION: _contraction}
