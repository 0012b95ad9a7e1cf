"""Single numbers that characterise a curve: peaks, limits of regimes, levels reached.

In every curve x ascends. A landmark that a curve does not have is a `ValueError`.
"""

import numpy as np

from planarimpact.ground.arrays import ArrayLike, Integers


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


def regime_start(x: ArrayLike, regimes: ArrayLike, regime: str) -> float:
    """First x at which the curve is in `regime`.

    >>> regime_start([0.0, 1.0, 2.0], ["STICK", "STICK_SLIP", "STICK_SLIP"], "STICK_SLIP")
    1.0
    """
    return float(np.asarray(x, float)[_in_regime(regimes, regime)[0]])


def regime_end(x: ArrayLike, regimes: ArrayLike, regime: str) -> float:
    """Last x at which the curve is in `regime`.

    >>> regime_end([0.0, 1.0, 2.0], ["STICK", "STICK_SLIP", "STICK_SLIP"], "STICK")
    0.0
    """
    return float(np.asarray(x, float)[_in_regime(regimes, regime)[-1]])


def _in_regime(regimes: ArrayLike, regime: str) -> Integers:
    inside = np.flatnonzero(np.asarray(regimes) == regime)
    if not inside.size:
        raise ValueError(f"the curve is nowhere in the regime {regime}")
    return inside


def first_reaching(x: ArrayLike, y: ArrayLike, level: float) -> float:
    """First x at which y reaches `level`, to rounding.

    >>> first_reaching([0.0, 1.0, 2.0], [0.2, 0.9, 1.0], 1.0)
    2.0
    """
    reached = np.flatnonzero(np.asarray(y, float) >= level * (1 - 1e-14))
    if not reached.size:
        raise ValueError(f"the curve never reaches {level:g}")
    return float(np.asarray(x, float)[reached[0]])


def value_at(x: ArrayLike, y: ArrayLike, at: float) -> float:
    """Value of the polyline at x = `at`.

    >>> value_at([0.0, 2.0], [0.0, 1.0], 1.0)
    0.5
    """
    x = np.asarray(x, float)
    if not x.min() <= at <= x.max():
        raise ValueError(f"{at:g} lies outside the curve, {x.min():g} to {x.max():g}")
    return float(np.interp(at, x, np.asarray(y, float)))
