"""Curves of the printed equations, where they differ from a curve of the paper's model."""

import numpy as np

from planarimpact.common.arrays import ArrayLike, Booleans
from stronge1994.csv_tables import Columns, Curves
from stronge1994.curve_names import AS_PRINTED, NO_SOLUTION

# A smaller difference is rounding.
SAME = 1e-9


def beside(name: str, curve: Columns, printed: ArrayLike) -> Curves:
    """Curves of the printed equations beside one curve of the paper's model.

    The first column of `curve` is its axis, the second the quantity; its `name` is empty if it is
    the only curve. `printed` is the quantity as printed, nan where the printed equations have no
    solution. `as printed, NAME` holds the places where they differ, and `no solution as printed,
    NAME` those where they have none, with the model's quantity. A curve without places is left out.

    >>> exact = {"x": np.arange(4), "w": np.arange(4)}
    >>> named = beside("e = 1", exact, [0, 1, 5, np.nan])
    >>> {name: columns["x"].tolist() for name, columns in named.items()}
    {'as printed, e = 1': [1, 2], 'no solution as printed, e = 1': [2, 3]}
    """
    (axis, x), (column, exact) = list(curve.items())[:2]
    printed = np.asarray(printed)
    missing = np.isnan(printed)
    differs = ~missing & (np.abs(printed - exact) > SAME)
    ending = f", {name}" if name else ""
    named = {}
    if differs.any():
        # With the last point in common, at which the two curves part.
        kept = _with_neighbours(differs) & ~missing
        named[f"{AS_PRINTED}{ending}"] = {axis: x[kept], column: printed[kept]}
    if missing.any():
        kept = _with_neighbours(missing, after=False)
        named[f"{NO_SOLUTION}{ending}"] = {axis: x[kept], column: exact[kept]}
    return named


def _with_neighbours(chosen: Booleans, after: bool = True) -> Booleans:
    grown = chosen.copy()
    grown[:-1] |= chosen[1:]
    if after:
        grown[1:] |= chosen[:-1]
    return grown
