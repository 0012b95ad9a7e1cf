"""Where curves have their vertices."""

from collections.abc import Mapping, Sequence
from types import MappingProxyType
from typing import TypeAlias

import numpy as np

from planarimpact.common.arrays import Array, ArrayLike

# Curves must pass through these points of reference tables: `{axis without its unit: points}`.
Nodes: TypeAlias = Mapping[str, ArrayLike]
NO_NODES: Nodes = MappingProxyType({})


def vertices(span: Sequence[float], samples: int, *extra: ArrayLike) -> Array:
    """Evenly spread samples of `span` with `extra` points inside it, sorted, each once.

    Both ends of the span are among the `samples`. Extra are points that a curve must pass through:
    thresholds, incidences of a reference table.

    >>> vertices((0.0, 2.0), 3, 1.21, [5.0]).tolist()
    [0.0, 1.0, 1.21, 2.0]
    """
    low, high = span
    more = [np.ravel(np.asarray(points, dtype=float)) for points in extra]
    points = np.concatenate([np.linspace(low, high, samples), *more])
    return np.unique(points[(points >= low) & (points <= high)])
