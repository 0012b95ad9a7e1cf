"""How the axes of a printed figure were found, and the errors that all points read there share.

A picture of a print is turned, sheared, and seen at an angle: a perspective maps values of its axes
to pixels. It rests on marks, places whose values the print states, and each mark is clicked with an
error. So the map has an error too, which moves all points together. With q, the values from -1 to
1 over both axes, and in units of half an axis, the map is off by

    d_x = B_x(q) p,    B_x = [1, q_x, q_y, 0, 0, 0, q_x^2, q_x q_y]
    d_y = B_y(q) p,    B_y = [0, 0, 0, 1, q_x, q_y, q_x q_y, q_y^2]

whose eight p have the covariance of least squares, N^-1: N sums B^T B / sigma^2 over both axes of
all marks. The last two p, the tilt of the paper against the picture, have a weak prior besides: a
standard deviation `tilt`. It is what a photo may have; so nobody chooses between a map with tilt
and one without.
"""

from typing import TypeAlias

import numpy as np
from pydantic.dataclasses import dataclass

from planarimpact.common.arrays import Array, ArrayLike

Pair: TypeAlias = tuple[float, float]
# Standard deviations of the tilt, per half an axis: of photos and of scans with a lid.
ANY, FLAT_BED = 0.1, 0.01
# A smaller singular value says that the marks leave an unknown of the map open.
LEAST_SINGULAR = 0.01


@dataclass(frozen=True)
class Calibration:
    """Marks of a picture, and how well each was clicked.

    `axes` are the first and the last value of x and of y in the print; `marks` are values of both;
    `sigma` is one standard deviation of a mark, in the units of x and y. Points of a printed line
    (`is_line`) may all lie beside what was meant, by one sigma of theirs: a draughtsman's error.
    """

    axes: tuple[Pair, Pair]
    marks: tuple[Pair, ...]
    sigma: Pair
    tilt: float = ANY
    is_line: bool = False

    def fixes(self, unknowns: int) -> bool:
        """Whether the marks fix so many unknowns without a prior: 6 without the tilt, or all 8.

        >>> axes, marks = ((0, 8), (-3, 1)), ((0, 0), (4, 0), (0, -2))
        >>> known = Calibration(axes, marks, (0.01, 0.01))
        >>> known.fixes(6), known.fixes(8), Calibration(axes, (*marks, (4, -2)), (1, 1)).fixes(8)
        (True, False, True)
        """
        rows = np.concatenate(self._bases(self.marks))[:, :unknowns]
        return bool(np.linalg.matrix_rank(rows, tol=LEAST_SINGULAR) == unknowns)

    def shifts(self, places: ArrayLike, directions: ArrayLike) -> Array:
        """How much distances change with one sigma of each error that they share: a row for each.

        Of each of n distances `places` has x and y, shape (n, 2), and `directions` how much it
        changes with x and with y, in sigmas for a unit of the axis.

        >>> marks = ((0, 0), (2, 0), (4, 0), (6, 0), (0, 1), (0, -1), (0, -2), (0, -3))
        >>> one = Calibration(((0, 8), (-3, 1)), marks, (0.5 / 100, 0.5 / 80))  # half a pixel
        >>> for axis in ((1, 0), (0, 1)):  # at the corner that has no mark
        ...     print(np.linalg.norm(one.shifts([[8, -3]], [axis])).round(5))
        0.04192
        0.01778
        """
        scaled = np.asarray(directions, float) * self._half
        bases = self._bases(places)
        moved = sum(scale[:, None] * rows for scale, rows in zip(scaled.T, bases, strict=True))
        shared = [(moved @ np.linalg.cholesky(self._covariance())).T]
        return np.concatenate([*shared, np.ones((1, len(scaled)))] if self.is_line else shared)

    @property
    def _half(self) -> Array:
        return np.diff(self.axes)[:, 0] / 2

    def _bases(self, places: ArrayLike) -> tuple[Array, Array]:
        """B_x and B_y, a row for each of some places."""
        x, y = ((np.asarray(places, float) - np.mean(self.axes, axis=1)) / self._half).T
        one, none = np.ones_like(x), np.zeros_like(x)
        return (
            np.stack([one, x, y, none, none, none, x * x, x * y], axis=1),
            np.stack([none, none, none, one, x, y, x * y, y * y], axis=1),
        )

    def _covariance(self) -> Array:
        weights = (self._half / self.sigma) ** 2
        both = zip(weights, self._bases(self.marks), strict=True)
        known = sum(weight * rows.T @ rows for weight, rows in both)
        return np.linalg.inv(known + np.diag([0.0] * 6 + [self.tilt**-2] * 2))
