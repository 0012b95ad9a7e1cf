"""Where curves have their vertices."""

from collections.abc import Iterable, Mapping, Sequence
from types import MappingProxyType
from typing import TypeAlias

import numpy as np

from planarimpact.ground.arrays import Array, ArrayLike

# Points of reference tables, through which curves must pass: `{axis without its unit: points}`.
Nodes: TypeAlias = Mapping[str, ArrayLike]
NO_NODES: Nodes = MappingProxyType({})
SIGNS = {1: "+", -1: "-"}


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


def shifted(curve: str, parameter: str, sign: int) -> str:
    """Name of a curve whose parameter is off by its uncertainty.

    Examples
    --------
    >>> shifted("lumped, experiment", "friction", 1)
    'lumped, experiment; friction + 1 sigma'
    """
    return f"{curve}; {parameter} {SIGNS[sign]} 1 sigma"


def shifted_by(curve: str | None, names: Iterable[str]) -> list[tuple[str, str]]:
    """Names of curves that differ from `curve` by the uncertainty of a parameter, up and down.

    Examples
    --------
    >>> names = ["a", "b", "b; friction + 1 sigma", "b; friction - 1 sigma"]
    >>> shifted_by("a", names), shifted_by("b", names)
    ([], [('b; friction + 1 sigma', 'b; friction - 1 sigma')])
    """
    start, end = f"{curve}; ", f" {SIGNS[1]} 1 sigma"
    own = [name for name in names if name.startswith(start) and name.endswith(end)]
    parameters = [name.removeprefix(start).removesuffix(end) for name in own]
    return [
        (shifted(f"{curve}", parameter, 1), shifted(f"{curve}", parameter, -1))
        for parameter in parameters
    ]
