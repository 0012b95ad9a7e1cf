"""Names for the types of arguments and results.

A function that takes ArrayLike returns an array of the broadcast shape. Where all arguments were
scalars it returns one of numpy's scalars, which has the methods and operators of an array; to a
type checker it is an array in either case.
"""

from typing import TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

__all__ = ["Array", "ArrayLike", "Booleans", "Integers", "Numbers"]

Array: TypeAlias = NDArray[np.float64]
Integers: TypeAlias = NDArray[np.integer]
Booleans: TypeAlias = NDArray[np.bool_]
# In what takes part in formulas unchecked: a number, or an array of them.
Numbers: TypeAlias = float | Array
