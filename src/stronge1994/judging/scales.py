"""A scale that nobody states, such as that of force: fitted, so that the shape is compared.

Each curve of a comparison with a `scale` has a factor of its own, fitted to its points. Factors of
curves with the same scale must be alike, whatever its unit: their ratio is a comparison of its own,
of the metric `ratio`. So friction that is too large for its normal force is found.
"""

import numpy as np

from stronge1994.goodness import product
from stronge1994.judging import landmarks, metrics
from stronge1994.judging.comparisons import Comparison
from stronge1994.judging.metrics import Measured
from stronge1994.reference_data import Series
from stronge1994.tables import Table, select, with_unit

BOUNDS = 0.2, 5.0  # a factor outside is a wrong unit rather than an unknown modulus
STEPS = 5  # of the fit
RATIO = "ratio of factors [1]"


def measure(comparison: Comparison, curves: Table) -> Measured:
    """Distances of a comparison from its curve with the factor that has the least chi-squared.

    The first factor is that of the least squares of vertical distances; each step then solves the
    linear problem at the nearest places of the curve (Gauss and Newton).
    """
    read, own, x, y = _both(comparison, curves)
    solved = np.interp(read[x], own[x], own[y])
    factor = float(read[y] @ solved / (solved @ solved))
    for _ in range(STEPS):
        found = metrics.measure(comparison, curves.assign(**{y: factor * curves[y]}))
        along = found.larger
        explained = product(along, found.sigmas, found.shifts)
        factor *= 1.0 + explained / (product(along, along, found.shifts) or 1.0)
    if not BOUNDS[0] < factor < BOUNDS[1]:
        low, high = BOUNDS
        problem = f"is not between {low:g} and {high:g}; is the unit of the points right?"
        raise ValueError(f"the best scale of {comparison.scale}, {factor:.3g}, {problem}")
    return found._replace(factor=factor, note=_note(comparison, curves, factor))


def ratio(first: Comparison, second: Comparison, curves: Table) -> Measured:
    """The factor of the first curve over that of the second, which must be 1.

    Its variance is that of both fits. An allowance for the form of the model, which all points of a
    curve share, adds its share of their root mean square.
    """
    fits = [measure(one, curves) for one in (first, second)]
    variance = 0.0
    for one, fit in zip((first, second), fits, strict=True):
        variance += 1.0 / product(fit.larger, fit.larger, fit.shifts)
        variance += (one.allowed("y") / metrics.rms_and_max(fit.places[:, 1])[0]) ** 2
    factors = [fit.factor for fit in fits if fit.factor is not None]
    found, sigma = factors[0] / factors[1], float(np.sqrt(variance))
    known = [fit.of_sigma for fit in fits if fit.of_sigma is not None]
    return Measured(
        quantity=RATIO,
        at=np.array([found]),
        sigmas=np.array([np.log(found) / sigma]),
        plain=np.array([found - 1.0]),
        scales=np.array([sigma]),
        columns=[RATIO],
        of_sigma=min(known, default=None),
        places=np.ones((1, 2)),
        directions=np.array([[0.0, 1.0 / sigma]]),
        note=f"factors {factors[0]:.3g} and {factors[1]:.3g}: have both axes the right numbers?",
    )


def _both(comparison: Comparison, curves: Table) -> tuple[Table, Table, str, str]:
    """The points and the curve of a comparison, and their columns of x and y."""
    series = comparison.reference
    assert isinstance(series, Series)  # as the config is checked
    own = select(curves, **comparison.curve)
    return comparison.selected_points(series)[0], own, series.x.name, series.ordinates[0].name


def _note(comparison: Comparison, curves: Table, factor: float) -> str:
    """Fitted and assumed scale; and where points and curve have their peak, which has no scale."""
    points, own, x, y = _both(comparison, curves)
    series = comparison.reference
    assert isinstance(series, Series)
    of_x, of_y = series.x.unit, series.ordinates[0].unit
    top = own.loc[own[y].idxmax()]
    ours, assumed = (f"{size:#.3g}".rstrip(".") for size in (factor * top[y], top[y]))
    largest = f"{ours} {of_y} at {with_unit(top[x], of_x)}, {assumed} {of_y} assumed"
    told = f"{comparison.scale} scaled by {factor:.3g}: {largest}"
    (read, at_an_end), (solved, no_peak) = (_top(one, x, y) for one in (points, own))
    if no_peak:
        return told
    end = ", an end of theirs" if at_an_end else ""
    peaks = f"{read:.3g} {of_x}{end}, the curve at {solved:.3g} {of_x}"
    return f"{told}; the points are largest at {peaks}"


def _top(own: Table, x: str, y: str) -> tuple[float, bool]:
    """Where y is largest, between points by the parabola of `landmarks.peak`; if it is an end."""
    values = own.groupby(x)[y].mean()  # in order, each place once
    if values.idxmax() in values.index[[0, -1]]:
        return float(values.idxmax()), True
    return landmarks.peak(values.index, values), False
