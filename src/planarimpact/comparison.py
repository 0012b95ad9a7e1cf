"""A computed curve against reference data: distances, landmarks, verdicts.

A vertical residual is wrong near a kink or on a steep slope, where a perfect curve may seem
several per cent off. So both axes are scaled by the uncertainties of the reference, and a
point's distance is the shortest one to the polyline of the curve, in sigmas.
"""

import math
from enum import StrEnum
from typing import NamedTuple

import numpy as np


class Verdict(StrEnum):
    """The outcome of one comparison; only DIVERGES fails a run.

    Examples
    --------
    >>> print(Verdict.DOCUMENTED)
    differs as documented
    """

    AGREES = "agrees"
    DOCUMENTED = "differs as documented"
    DIVERGES = "diverges"
    AWAITED = "awaited"


class Distance(NamedTuple):
    """Distances of `count` points: in sigmas, and root mean square in units of the y axis."""

    rms: float
    max: float
    plain_rms: float
    count: int


def distances_to_polyline(x, y, line_x, line_y, sigma_x, sigma_y):
    """Shortest distance from each point to a polyline, in sigmas.

    Parameters
    ----------
    x, y : array_like, shape (n,)
        Points.
    line_x, line_y : array_like, shape (m,), m >= 2
        Vertices of the polyline, in order.
    sigma_x, sigma_y : float
        Uncertainties that scale the axes, above 0.

    Returns
    -------
    ndarray, shape (n,)

    Raises
    ------
    ValueError
        If the polyline has fewer than two vertices or a coordinate is not finite.

    Examples
    --------
    >>> distances_to_polyline([1.0], [1.0], [0.0, 2.0], [0.0, 0.0], 1.0, 0.5).tolist()
    [2.0]
    """
    points = np.stack([np.asarray(x, float) / sigma_x, np.asarray(y, float) / sigma_y], axis=1)
    line = np.stack([np.asarray(line_x, float) / sigma_x, np.asarray(line_y, float) / sigma_y], 1)
    if len(line) < 2:
        raise ValueError(f"a polyline needs two vertices, here {len(line)}")
    if not (np.isfinite(points).all() and np.isfinite(line).all()):
        raise ValueError("a coordinate is not finite")
    start, step = line[:-1], np.diff(line, axis=0)
    squared = np.maximum((step**2).sum(axis=1), np.finfo(float).tiny)
    nearest = np.empty(len(points))
    for i, point in enumerate(points):
        share = np.clip(((point - start) * step).sum(axis=1) / squared, 0.0, 1.0)
        nearest[i] = np.hypot(*(point - start - share[:, None] * step).T).min()
    return nearest


def curve_distance(points, curve, sigma, both_ways=False):
    """Distance of points from a curve, and with `both_ways` of the curve from the points' line.

    Parameters
    ----------
    points, curve : (array_like, array_like)
        x and y.
    sigma : (float, float)
        Uncertainties of the points.
    both_ways : bool
        The points are a dense line: each vertex of the curve within their span must lie near it
        too, so that a spike of the curve between two points is seen.

    Returns
    -------
    Distance
        `plain_rms` is the vertical one.

    Examples
    --------
    >>> line = ([0.0, 1.0, 2.0], [0.0, 5.0, 0.0])
    >>> curve_distance(([0.0, 2.0], [0.0, 0.0]), line, (1.0, 1.0)).max
    0.0
    >>> curve_distance(([0.0, 2.0], [0.0, 0.0]), line, (1.0, 1.0), both_ways=True).max
    5.0
    """
    x, y = (np.asarray(axis, float) for axis in points)
    line_x, line_y = (np.asarray(axis, float) for axis in curve)
    found = distances_to_polyline(x, y, line_x, line_y, *sigma)
    if both_ways:
        order = np.argsort(x)
        inside = (line_x >= x.min()) & (line_x <= x.max())
        back = distances_to_polyline(line_x[inside], line_y[inside], x[order], y[order], *sigma)
        found = np.concatenate([found, back])
    order = np.argsort(line_x, kind="stable")
    vertical = y - np.interp(x, line_x[order], line_y[order])
    return _summary(found, vertical)


def vertex_distance(points, vertices, sigma):
    """Distance of each point from the nearest vertex with the same label.

    Parameters
    ----------
    points, vertices : (array_like, array_like, array_like)
        x, y and a label each; a tuple of words will do.
    sigma : (float, float)
        Uncertainties of the points.

    Returns
    -------
    Distance

    Raises
    ------
    ValueError
        If a point's label has no vertex.

    Examples
    --------
    >>> vertex_distance(([0.0], [1.0], ["slip"]), ([0.0], [3.0], ["slip"]), (1.0, 1.0)).max
    2.0
    """
    x, y, labels = points
    vertex_x, vertex_y, vertex_labels = vertices
    of_label = {}
    for index, label in enumerate(vertex_labels):
        of_label.setdefault(label, []).append(index)
    found, vertical = [], []
    for px, py, label in zip(x, y, labels, strict=True):
        if label not in of_label:
            raise ValueError(f"the curves have no vertex '{label}'")
        dx, dy = (
            np.asarray(v, float)[of_label[label]] - p for v, p in ((vertex_x, px), (vertex_y, py))
        )
        distance = np.hypot(dx / sigma[0], dy / sigma[1])
        found.append(distance.min())
        vertical.append(dy[distance.argmin()])
    return _summary(np.array(found), np.array(vertical))


def difference_distance(left, right, sigma):
    """Distance of two columns that must be equal, in units of `sigma`.

    Examples
    --------
    >>> difference_distance([1.0, 2.0], [1.0, 2.5], 0.5).max
    1.0
    """
    gap = np.asarray(left, float) - np.asarray(right, float)
    return _summary(np.abs(gap) / sigma, gap)


def fact_distance(found, fact):
    """Distance of a landmark from a stated fact, in the fact's own tolerance.

    Parameters
    ----------
    found : float
        The landmark.
    fact : dict
        `value` and `tolerance`, or `less_than`, or `greater_than`.

    Returns
    -------
    Distance
        For an inequality 0 where it holds, else infinite.

    Examples
    --------
    >>> fact_distance(18.0, {"value": 20.0, "tolerance": 5.0}).max
    0.4
    >>> fact_distance(0.5, {"less_than": 0.0}).max
    inf
    """
    if "value" in fact:
        gap = found - fact["value"]
        return _summary(np.array([abs(gap) / fact["tolerance"]]), np.array([gap]))
    less, bound = "less_than" in fact, fact.get("less_than", fact.get("greater_than"))
    holds = found < bound if less else found > bound
    return _summary(np.array([0.0 if holds else math.inf]), np.array([found - bound]))


def _summary(found, gap):
    if not len(found):
        raise ValueError("no points in the window")
    rms = float(np.sqrt(np.mean(found**2)))
    return Distance(rms, float(found.max()), float(np.sqrt(np.mean(gap**2))), len(found))


def judge(distance, agreement=None, documented=None, difference=None):
    """Verdict on a distance.

    Parameters
    ----------
    distance : Distance
        What was measured.
    agreement : dict, optional
        Largest `rms` and `max`, in sigmas.
    documented : dict, optional
        A known difference instead: bounds [low, high] of `rms` or `max` in sigmas, or of
        `difference` in axis units. Outside them, on either side, the curve diverges.
    difference : float, optional
        Signed difference of a landmark, for `documented`.

    Returns
    -------
    Verdict

    Examples
    --------
    >>> print(judge(Distance(0.5, 1.0, 0.01, 9), {"rms": 1.0, "max": 3.0}))
    agrees
    >>> print(judge(Distance(0.5, 1.0, 0.01, 9), documented={"rms": [2.0, 3.0]}))
    diverges
    """
    measured = {"rms": distance.rms, "max": distance.max, "difference": difference}
    if documented is not None:
        bounds = {key: documented[key] for key in measured if key in documented}
        good = bool(bounds) and all(low <= measured[k] <= high for k, (low, high) in bounds.items())
        return Verdict.DOCUMENTED if good else Verdict.DIVERGES
    good = bool(agreement) and all(measured[key] <= limit for key, limit in agreement.items())
    return Verdict.AGREES if good else Verdict.DIVERGES
