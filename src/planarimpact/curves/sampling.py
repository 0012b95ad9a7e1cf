"""Where curves have their vertices."""

from collections.abc import Sequence

import numpy as np

from planarimpact.arrays import Array, ArrayLike, Integers
from planarimpact.curves import Column
from planarimpact.results import Regime


def vertices(span: Sequence[float], samples: int, *extra: ArrayLike) -> Array:
    """Evenly spread samples of `span` with `extra` points inside it, sorted, each once.

    Parameters
    ----------
    span : (float, float)
        First and last point.
    samples : int
        Number of evenly spread points, both ends included.
    *extra : array_like
        Points that a curve must pass through: thresholds, incidences of a reference table.

    Returns
    -------
    ndarray, sorted

    Examples
    --------
    >>> vertices((0.0, 2.0), 3, 1.21, [5.0]).tolist()
    [0.0, 1.0, 1.21, 2.0]
    """
    low, high = span
    more = [np.ravel(np.asarray(points, dtype=float)) for points in extra]
    points = np.concatenate([np.linspace(low, high, samples), *more])
    return np.unique(points[(points >= low) & (points <= high)])


def name(symbol: str, value: float) -> str:
    """Name of a curve by a parameter, the same in curves and in reference data.

    Examples
    --------
    >>> name("e", 0.50)
    'e = 0.5'
    """
    return f"{symbol} = {value:g}"


def regime_names(codes: Integers) -> Column:
    """Names of an array of `Regime` codes.

    Examples
    --------
    >>> regime_names(np.array([2, 4])).tolist()
    ['STICK_SLIP', 'SLIP_THROUGHOUT']
    """
    return np.array([regime.name for regime in Regime])[codes]
