"""Names for the types of arguments and results.

A function that takes ArrayLike returns an array of the broadcast shape. If all arguments are
scalars, it returns a scalar of NumPy, which has the methods and operators of an array. For a type
checker both are arrays, but for those that `results.of_groups` decorates.
"""

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any, TypeAlias, TypeVar

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:  # without the texts of the public one
    from numpy._typing import _ArrayLikeFloat_co as ArrayLike
else:
    from numpy.typing import ArrayLike

__all__ = ["Array", "ArrayLike", "Booleans", "Integers", "Number", "Numbers", "SMALLEST"]
__all__ += ["in_parts"]

Array: TypeAlias = NDArray[np.float64]
Integers: TypeAlias = NDArray[np.integer]
Booleans: TypeAlias = NDArray[np.bool_]
# Arguments of formulas that do not check them: a number, or an array of numbers.
Numbers: TypeAlias = float | Array
# The same, of formulas that return what they take.
Number = TypeVar("Number", float, Array)
# The least number above 0.
SMALLEST = float(np.finfo(float).smallest_subnormal)


def in_parts(count: int, together: int, solve: Callable[[slice], Sequence[Any]]) -> list[Any]:
    """Arrays whose last axis are `count` impacts, solved `together` at a time: they fit a cache.

    `solve` returns such arrays of a part of the impacts.
    """
    starts = range(0, max(count, 1), together)
    fields = zip(*(solve(slice(start, start + together)) for start in starts), strict=True)
    return [np.concatenate(field, axis=-1) for field in fields]
