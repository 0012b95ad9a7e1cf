"""A scale that nobody states, such as that of the force: fitted, so that the shapes are compared.

All comparisons that name one scale share one factor of the y of their curves. It is fitted to the
points of all of them together, and each then is judged with it.
"""

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy as np
import pandas as pd

from stronge1994.goodness import chi_squared
from stronge1994.judging import landmarks, metrics
from stronge1994.judging.comparisons import Comparison
from stronge1994.judging.metrics import Measured
from stronge1994.reference_data import Series
from stronge1994.tables import Table, select, with_unit

BOUNDS = 0.2, 5.0  # a factor outside is a wrong unit rather than an unknown modulus
STEPS = 21  # of a first search, a sixth each, between which the minimum is found


def sharing(
    comparison: Comparison, every: Iterable[Comparison], settings: Mapping[str, Any]
) -> list[Comparison]:
    """All comparisons that have its scale, and points for these settings; none without a scale."""
    return [
        one
        for one in every
        if comparison.scale
        and one.scale == comparison.scale
        and isinstance(one.reference, Series)
        and one.reference.path
        and not one.other_settings(settings)
    ]


def measure(
    comparison: Comparison, curves: Table, together: Sequence[Comparison]
) -> tuple[Measured, str]:
    """Distances from curves with the best scale, in units of the points; and a note of the scale.

    `together` are all that share the scale. The fitted factor costs one degree of freedom, of which
    each comparison bears a part by its number of points.
    """
    if not comparison.scale:
        return metrics.measure(comparison, curves), ""
    factor = fit(together, curves)
    counts = [len(metrics.measure(one, curves).at) for one in together]
    found = metrics.measure(comparison, scaled(comparison, curves, factor))
    found = found._replace(fitted=len(found.at) / sum(counts))
    return found, _in_words(comparison, curves, factor) + _tops(comparison, curves)


def fit(together: Sequence[Comparison], curves: Table) -> float:
    """The factor of the curves with the least chi-squared of all points, by the same distances."""
    from scipy.optimize import minimize_scalar  # slow to load, and few figures need it

    def loss(factor: float) -> float:
        found = [metrics.measure(one, scaled(one, curves, factor)) for one in together]
        return sum(chi_squared(one.sigmas, one.shifts).value for one in found)

    factors = np.geomspace(*BOUNDS, STEPS)
    best = int(np.argmin([loss(factor) for factor in factors]))
    if best in (0, STEPS - 1):
        low, high = BOUNDS
        raise ValueError(
            f"the best scale of {together[0].scale} is not between {low:g} and {high:g}; is the "
            "unit of the points right?"
        )
    around = factors[best - 1], factors[best + 1]
    return float(minimize_scalar(loss, bounds=around, options={"xatol": 1e-6}).x)


def scaled(comparison: Comparison, curves: Table, factor: float) -> Table:
    """Curves whose y, as this comparison has it, is this many times as large."""
    assert isinstance(comparison.reference, Series)  # as the schema has it
    columns = [axis.name for axis in comparison.reference.ordinates if axis.name in curves]
    return curves.assign(**{column: factor * curves[column] for column in columns})


def _in_words(comparison: Comparison, curves: Table, factor: float) -> str:
    """The fitted scale and the assumed one, where the y of the curves is largest."""
    assert isinstance(comparison.reference, Series)
    x, y = comparison.reference.x, comparison.reference.ordinates[0]
    top = curves.loc[curves[y.name].idxmax()]
    ours, assumed = (f"{size:#.3g}".rstrip(".") for size in (factor * top[y.name], top[y.name]))
    at = with_unit(top[x.name], x.unit)
    return (
        f"{comparison.scale} scaled by {factor:.3g}: {ours} {y.unit} at {at}, {assumed} {y.unit} "
        "assumed"
    )


def _tops(comparison: Comparison, curves: Table) -> str:
    """Where points and curve are largest, which has no scale; empty for a curve without a peak."""
    assert isinstance(comparison.reference, Series)
    x, y = comparison.reference.x, comparison.reference.ordinates[0].name
    points, _ = comparison.selected_points(comparison.reference)
    read, solved = (
        table.groupby(x.name)[y].mean() for table in (points, select(curves, **comparison.curve))
    )
    (of_points, at_end), (of_curve, without_peak) = _top(read), _top(solved)
    if without_peak:
        return ""
    end = ", an end of theirs" if at_end else ""
    return (
        f"; the points are largest at {of_points:.3g} {x.unit}{end}, the curve at "
        f"{of_curve:.3g} {x.unit}"
    )


def _top(values: "pd.Series[float]") -> tuple[float, bool]:
    """Where values are largest, by the parabola as `landmarks.peak`; whether that is an end."""
    if values.idxmax() in values.index[[0, -1]]:
        return float(values.idxmax()), True
    return landmarks.peak(values.index, values), False
