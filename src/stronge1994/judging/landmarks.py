"""Single numbers that characterise a curve: its peak, where it first reaches something, its value.

In every curve x ascends. A landmark that a curve does not have is a `ValueError`.
"""

from typing import Any

import numpy as np

from planarimpact.common.arrays import ArrayLike


def find(kind: str, x: ArrayLike, y: ArrayLike, at: Any = None) -> float:
    """A landmark of a curve, by its kind.

    `peak` is the place of the largest inner value; `value` is that of the polyline at x = `at`.
    `first` and `last` are the first and the last x where y is the word `at`, or has reached the
    number `at` up to rounding.

    >>> find("first", [0.0, 1.0, 2.0], [0.2, 1.0, 0.9], 1.0)
    1.0
    >>> find("last", [0.0, 1.0, 2.0], ["STICK", "STICK", "SLIP"], "STICK")
    1.0
    >>> find("value", [0.0, 2.0], [0.0, 1.0], 1.0)
    0.5
    """
    if kind == "peak":
        return peak(x, y)
    x, y = np.asarray(x, float), np.asarray(y)
    if kind == "value":
        if not x.min() <= at <= x.max():
            raise ValueError(f"{at} lies outside the curve, {x.min():g} to {x.max():g}")
        return float(np.interp(at, x, y))
    there = np.flatnonzero(y == at if isinstance(at, str) else y >= at * (1 - 1e-14))
    if not there.size:
        raise ValueError(f"the curve never reaches {at}")
    return float(x[there[0 if kind == "first" else -1]])


def peak(x: ArrayLike, y: ArrayLike) -> float:
    """Place of the largest inner value, refined by the parabola through its neighbours.

    >>> peak([0.0, 1.0, 3.0], [0.0, 1.0, -3.0])
    1.0
    """
    x, y = np.asarray(x, float), np.asarray(y, float)
    top = int(y.argmax())
    if top in (0, len(y) - 1):
        raise ValueError(f"the largest value stands at an end of the curve, x = {x[top]:g}")
    left, right = x[top] - x[top - 1], x[top + 1] - x[top]
    rise, fall = (y[top] - y[top - 1]) / left, (y[top + 1] - y[top]) / right
    if rise == fall:
        return float(x[top])
    # Slope of the parabola falls linearly from `rise` to `fall` between the two midpoints.
    return float(x[top] - left / 2 + (left + right) / 2 * rise / (rise - fall))
