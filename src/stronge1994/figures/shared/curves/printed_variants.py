"""What the printed equations give, where that differs from a curve of the paper's model."""

from typing import Any

import numpy as np

from planarimpact.common.arrays import ArrayLike, Booleans
from stronge1994 import tables
from stronge1994.names import NO_SOLUTION, PRINTED
from stronge1994.tables import Table

# A smaller difference is rounding.
SAME = 1e-9


def printed_variants(
    columns: dict[str, Any], printed: ArrayLike, **parameters: float
) -> list[Table]:
    """Curves of the printed equations, for one curve of the paper's model with its parameters.

    The first of its `columns` is its axis, the second the quantity. `printed` is the quantity as
    printed, nan where the printed equations have no solution. One curve of the model `PRINTED` has
    the places where the two differ; its variant `NO_SOLUTION` has the places without a solution,
    with the quantity of the paper's model. A curve without places is left out.

    >>> exact = {"x [1]": np.arange(4.0), "w [1]": np.arange(4.0)}
    >>> for own in printed_variants(exact, [0, 1, 5, np.nan], e=1.0):
    ...     print(own["curve"].iloc[0], own["x [1]"].tolist())
    printed, e = 1 [1.0, 2.0]
    printed, no solution, e = 1 [2.0, 3.0]
    """
    (axis, x), (column, exact) = list(columns.items())[:2]
    printed = np.asarray(printed)
    missing = np.isnan(printed)
    differs = ~missing & (np.abs(printed - exact) > SAME)
    found: dict[str, tuple[Any, Booleans]] = {}
    if differs.any():
        # With the last point in common, at which the two curves part.
        found[""] = printed, _with_neighbours(differs) & ~missing
    if missing.any():
        found[NO_SOLUTION] = exact, _with_neighbours(missing, after=False)
    return [
        tables.curve({axis: x[kept], column: values[kept]}, PRINTED, variant, **parameters)
        for variant, (values, kept) in found.items()
    ]


def _with_neighbours(chosen: Booleans, after: bool = True) -> Booleans:
    grown = chosen.copy()
    grown[:-1] |= chosen[1:]
    if after:
        grown[1:] |= chosen[:-1]
    return grown
