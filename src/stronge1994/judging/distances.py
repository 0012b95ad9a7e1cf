"""How far a computed curve is from reference data.

A vertical residual is wrong near a kink or on a steep slope: there even a perfect curve may be
several per cent off. So both axes are scaled by the uncertainties of the reference. The distance of
a point is the shortest one to the polyline of the curve, in sigmas. Where the model itself is only
approximate, an allowance for its form is added to the uncertainties first. An uncertainty is one
number, or one for each point.
"""

import math
from collections.abc import Sequence
from typing import TypeAlias

import numpy as np

from planarimpact.common.arrays import Array, ArrayLike
from stronge1994.reference_data import Fact

# Of each point the distance in sigmas of the reference, and the vertical one in units of the axis;
# positive where the reference lies above what was computed.
Distances: TypeAlias = tuple[Array, Array]


def curve_residuals(
    points: Sequence[ArrayLike], curve: Sequence[ArrayLike], sigma: tuple[ArrayLike, ArrayLike]
) -> Distances:
    """Shortest distance of each point from the polyline of a curve, whose vertices stand in order.

    >>> line = ([0.0, 1.0, 2.0], [0.0, 5.0, 0.0])
    >>> curve_residuals(([0.0, 2.0], [-1.0, 0.0]), line, (1.0, 1.0))[0].tolist()
    [-1.0, 0.0]
    """
    (x, y), (line_x, line_y) = (
        [np.asarray(axis, float) for axis in axes] for axes in (points, curve)
    )
    if len(line_x) < 2:
        raise ValueError(f"a polyline needs two vertices, here {len(line_x)}")
    places, line = np.stack([x, y], 1), np.stack([line_x, line_y], 1)
    scales = np.stack(np.broadcast_arrays(*sigma, x)[:2], 1)
    nearest = np.empty(len(x))
    for i, (point, scale) in enumerate(zip(places / scales, scales, strict=True)):
        start, step = line[:-1] / scale, np.diff(line / scale, axis=0)
        squared = np.maximum((step**2).sum(axis=1), np.finfo(float).tiny)
        share = np.clip(((point - start) * step).sum(axis=1) / squared, 0.0, 1.0)
        nearest[i] = np.hypot(*(point - start - share[:, None] * step).T).min()
    order = np.argsort(line_x, kind="stable")
    above = y - np.interp(x, line_x[order], line_y[order])
    return np.copysign(nearest, above), above


def vertex_residuals(
    points: Sequence[ArrayLike], vertices: Sequence[ArrayLike], sigma: tuple[ArrayLike, ArrayLike]
) -> Distances:
    """Distance of each point from the nearest vertex; the vertical one from those at its x.

    These are at most a sigma beside it. Where there is none the vertical distance is infinite.

    >>> vertex_residuals(([0.0], [1.0]), ([0.0, 9.0], [3.0, 1.0]), (1.0, 1.0))
    (array([-2.]), array([-2.]))
    >>> vertex_residuals(([0.0], [1.0]), ([0.0, 2.0], [9.0, 1.0]), (1.0, 1.0))
    (array([-2.]), array([-8.]))
    """
    (x, y), (vertex_x, vertex_y), scales = (
        [np.asarray(axis, float) for axis in axes] for axes in (points, vertices, sigma)
    )
    scale_x, scale_y = (np.broadcast_to(scale, x.shape) for scale in scales)
    sigmas, above = np.empty(len(x)), np.empty(len(x))
    for i in range(len(x)):
        dx, dy = (x[i] - vertex_x) / scale_x[i], y[i] - vertex_y
        at_x = dy[np.abs(dx) <= 1.0]
        above[i] = at_x[np.abs(at_x).argmin()] if at_x.size else np.inf
        sigmas[i] = np.copysign(np.hypot(dx, dy / scale_y[i]).min(), above[i])
    return sigmas, above


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
