"""How far a computed curve is from reference data.

A vertical residual is wrong near a kink or on a steep slope: there even a perfect curve may be
several per cent off. So both axes are scaled by the uncertainties of the reference. The
distance of a point is the shortest one to the polyline of the curve, in sigmas. Its ends are
continued a little, straight on: an error may put a point beyond them. Where the model itself is
only approximate, an allowance for its form is added to the uncertainties first. An uncertainty is
one number, or one for each point.
"""

import math
from collections.abc import Sequence
from typing import NamedTuple, TypeAlias

import numpy as np

from planarimpact.common.arrays import Array, ArrayLike
from stronge1994.reference_data import Fact

# Of each point the distance in sigmas of the reference, and the vertical one in units of the axis;
# positive where the reference lies above what was computed.
Distances: TypeAlias = tuple[Array, Array]

# By how many sigmas the ends of a curve are continued.
BEYOND_ENDS = 10.0


class FromCurve(NamedTuple):
    """`Distances` of n points from a curve, and along what they are measured.

    `places` of the curve are nearest to the points, and `directions` are how much each distance in
    sigmas changes if its point moves by one unit of an axis; both have the shape (n, 2), x and y.
    """

    sigmas: Array
    plain: Array
    places: Array
    directions: Array


def curve_residuals(
    points: Sequence[ArrayLike], curve: Sequence[ArrayLike], sigma: tuple[ArrayLike, ArrayLike]
) -> FromCurve:
    """Shortest distance of each point from the polyline of a curve, whose vertices stand in order.

    >>> line = ([0.0, 1.0, 2.0], [0.0, 5.0, 0.0])
    >>> found = curve_residuals(([1.0, -0.2], [4.0, -1.0]), line, (1.0, 1.0))
    >>> found.sigmas.round(3).tolist(), found.plain.tolist()
    ([-0.196, -0.0], [-1.0, -1.0])
    """
    (x, y), (line_x, line_y) = (
        [np.asarray(axis, float) for axis in axes] for axes in (points, curve)
    )
    if len(line_x) < 2:
        raise ValueError(f"a polyline needs two vertices, here {len(line_x)}")
    places, line = np.stack([x, y], 1), np.stack([line_x, line_y], 1)
    scales = np.stack(np.broadcast_arrays(*sigma, x)[:2], 1)
    order = np.argsort(line_x, kind="stable")
    above = y - np.interp(x, line_x[order], line_y[order])
    nearest, feet, directions = np.empty(len(x)), np.empty((len(x), 2)), np.empty((len(x), 2))
    for i, (point, scale) in enumerate(zip(places / scales, scales, strict=True)):
        own = _continued(line / scale)
        start, step = own[:-1], np.diff(own, axis=0)
        squared = np.maximum((step**2).sum(axis=1), np.finfo(float).tiny)
        share = np.clip(((point - start) * step).sum(axis=1) / squared, 0.0, 1.0)
        every = start + share[:, None] * step
        best = int(np.hypot(*(point - every).T).argmin())
        across = np.array([-step[best, 1], step[best, 0]])  # for a point on the curve
        nearest[i], directions[i] = _along(point - every[best], across, above[i])
        feet[i] = every[best]
    return FromCurve(nearest, above, feet * scales, directions / scales)


def _continued(line: Array) -> Array:
    """A polyline in sigmas, with a vertex beyond each end, straight on."""
    different = line[np.append(True, np.any(np.diff(line, axis=0) != 0.0, axis=1))]
    if len(different) < 2:
        return line
    ends = different[[0, -1]] - different[[1, -2]]
    beyond = different[[0, -1]] + BEYOND_ENDS * ends / np.hypot(*ends.T)[:, None]
    return np.concatenate([beyond[:1], line, beyond[1:]])


def _along(gap: Array, across: Array, above: float) -> tuple[float, Array]:
    """A distance with the sign of `above`, and its direction: `across` if it is 0 or infinite."""
    size = float(np.hypot(*gap))
    if 1e-9 < size < math.inf:
        return math.copysign(size, above), gap * math.copysign(1.0 / size, above)
    return math.copysign(size, above), across / max(float(np.hypot(*across)), np.finfo(float).tiny)


def vertex_residuals(
    points: Sequence[ArrayLike], vertices: Sequence[ArrayLike], sigma: tuple[ArrayLike, ArrayLike]
) -> FromCurve:
    """Distance of each point from the nearest vertex; the vertical one from those at its x.

    These are at most a sigma beside it. Where there is none the vertical distance is infinite.

    >>> vertex_residuals(([0.0], [1.0]), ([0.0, 9.0], [3.0, 1.0]), (1.0, 1.0))[:2]
    (array([-2.]), array([-2.]))
    >>> vertex_residuals(([0.0], [1.0]), ([0.0, 2.0], [9.0, 1.0]), (1.0, 1.0))[:2]
    (array([-2.]), array([-8.]))
    """
    (x, y), (vertex_x, vertex_y), scales = (
        [np.asarray(axis, float) for axis in axes] for axes in (points, vertices, sigma)
    )
    scale = np.stack([np.broadcast_to(one, x.shape) for one in scales], 1)
    sigmas, above = np.empty(len(x)), np.empty(len(x))
    nearest, directions = np.empty(len(x), int), np.empty((len(x), 2))
    for i in range(len(x)):
        gaps = np.stack([x[i] - vertex_x, y[i] - vertex_y], 1) / scale[i]
        at_x = gaps[np.abs(gaps[:, 0]) <= 1.0, 1] * scale[i, 1]
        above[i] = at_x[np.abs(at_x).argmin()] if at_x.size else np.inf
        nearest[i] = np.hypot(*gaps.T).argmin()
        sigmas[i], directions[i] = _along(gaps[nearest[i]], np.array([0.0, 1.0]), above[i])
    places = np.stack([vertex_x, vertex_y], 1)[nearest]
    return FromCurve(sigmas, above, places, directions / scale)


def fact_residuals(value: float, fact: Fact) -> Distances:
    """Distance of a landmark from a stated fact, in the fact's own tolerance.

    For an inequality the distance is 0 where it holds, else infinite.

    >>> fact_residuals(18.0, Fact("a/b", "deg", value=20.0, tolerance=5.0))
    (array([0.4]), array([2.]))
    >>> fact_residuals(0.5, Fact("a/b", "N", less_than=0.0))
    (array([-inf]), array([-0.5]))
    """
    stated = (fact.value, fact.less_than, fact.greater_than)
    gap = next(limit - value for limit in stated if limit is not None)
    if fact.tolerance is not None:
        return np.array([gap / fact.tolerance]), np.array([gap])
    holds = gap > 0 if fact.less_than is not None else gap < 0
    return np.array([0.0 if holds else math.copysign(math.inf, gap)]), np.array([gap])
