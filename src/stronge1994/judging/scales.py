"""A scale that nobody states, such as that of force: fitted, so that shapes are compared.

All comparisons that name one scale share one factor of the y of their curves. It is fitted to the
points of all of them together, and each is judged with it.
"""

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy as np

from stronge1994.goodness import chi_squared
from stronge1994.judging import landmarks, metrics
from stronge1994.judging.comparisons import Comparison
from stronge1994.judging.metrics import Measured
from stronge1994.reference_data import Series
from stronge1994.tables import Table, select, with_unit

BOUNDS = 0.2, 5.0  # a factor outside is a wrong unit rather than an unknown modulus
STEPS = 21  # of a first search, a sixth each, between which the minimum is found


def sharing(
    scale: str, every: Iterable[Comparison], settings: Mapping[str, Any]
) -> list[Comparison]:
    """All comparisons that have this scale, and points for these settings."""
    alike = (one for one in every if one.scale == scale)
    at_hand = (one for one in alike if getattr(one.reference, "path", None))
    return [one for one in at_hand if not one.other_settings(settings)]


def measure(together: Sequence[Comparison], curves: Table) -> dict[str, Measured]:
    """Distances of comparisons from their curves with the best scale, and notes of it, by name.

    The factor costs one degree of freedom, which all bear by their numbers of points.
    """
    factor = fit(together, curves)
    found = [metrics.measure(one, scaled(one, curves, factor)) for one in together]
    points = sum(len(own.at) for own in found)
    return {
        one.name: own._replace(fitted=len(own.at) / points, note=_note(one, curves, factor))
        for one, own in zip(together, found, strict=True)
    }


def fit(together: Sequence[Comparison], curves: Table) -> float:
    """The factor of the curves with the least chi-squared of all points, by the same distances."""
    from scipy.optimize import minimize_scalar  # slow to load, and few figures need it

    def loss(factor: float) -> float:
        found = (metrics.measure(one, scaled(one, curves, factor)) for one in together)
        return sum(chi_squared(one.sigmas, one.shifts).value for one in found)

    factors = np.geomspace(*BOUNDS, STEPS)
    best = int(np.argmin([loss(factor) for factor in factors]))
    if best in (0, STEPS - 1):
        low, high = BOUNDS
        problem = f"is not between {low:g} and {high:g}; is the unit of the points right?"
        raise ValueError(f"the best scale of {together[0].scale} {problem}")
    around = factors[best - 1], factors[best + 1]
    return float(minimize_scalar(loss, bounds=around, options={"xatol": 1e-6}).x)


def scaled(comparison: Comparison, curves: Table, factor: float) -> Table:
    """Curves whose y, as this comparison has it, is this many times as large."""
    assert isinstance(comparison.reference, Series)  # as the config is checked
    y = comparison.reference.ordinates[0].name
    return curves.assign(**{y: factor * curves[y]}) if y in curves else curves


def _note(comparison: Comparison, curves: Table, factor: float) -> str:
    """Fitted and assumed scale; and where points and curve have their peak, which has no scale."""
    series = comparison.reference
    assert isinstance(series, Series)
    x, y = series.x, series.ordinates[0]
    top = curves.loc[curves[y.name].idxmax()]
    ours, assumed = (f"{size:#.3g}".rstrip(".") for size in (factor * top[y.name], top[y.name]))
    largest = f"{ours} {y.unit} at {with_unit(top[x.name], x.unit)}, {assumed} {y.unit} assumed"
    told = f"{comparison.scale} scaled by {factor:.3g}: {largest}"
    both = comparison.selected_points(series)[0], select(curves, **comparison.curve)
    (read, at_an_end), (solved, no_peak) = (_top(own, x.name, y.name) for own in both)
    if no_peak:
        return told
    end = ", an end of theirs" if at_an_end else ""
    peaks = f"{read:.3g} {x.unit}{end}, the curve at {solved:.3g} {x.unit}"
    return f"{told}; the points are largest at {peaks}"


def _top(own: Table, x: str, y: str) -> tuple[float, bool]:
    """Where y is largest, between points by the parabola of `landmarks.peak`; if it is an end."""
    values = own.groupby(x)[y].mean()  # in order, each place once
    if values.idxmax() in values.index[[0, -1]]:
        return float(values.idxmax()), True
    return landmarks.peak(values.index, values), False
