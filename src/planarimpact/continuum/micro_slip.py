"""Partial slip of Hertz contact by the method of dimensionality reduction (Popov & Hess).

The contact is mapped to a row of independent springs. The spring at radius r has the normal force
density (3/4)(d - r^2) and the tangential one (3/4)(u + c). Here u is the tangential displacement of
the body, and c is what the spring remembers: c stays while the spring sticks, and changes when it
slides, at |u + c| = d - r^2. So c is confined to the cone

    d - r^2 >= |u + c|,

whose tip is at r^2 = d, c = -u. Over r^2 the cone has edges of slope 1 and -1. As the tip
moves, every c outside the cone is brought to the nearer edge. Where the contact grows without slip,
the tip itself draws c. After any motion in straight steps c is therefore a chain of straight pieces
in r^2. This module keeps the vertices of that chain. The row is not divided into springs, so the
answer to a path in straight steps is exact. Only an outer annulus can slip.

Units: radius a_max, approach d_max, force its largest normal value (times mu for friction), and
tangential displacement zeta^2 mu d_max, so that a contact of approach d slips as a whole when
u has changed by d.
"""

from __future__ import annotations

import numpy as np

from planarimpact.common import checks
from planarimpact.common.arrays import Array, ArrayLike, Integers, Numbers


class ElasticSprings:
    """The springs of many elastic contacts, moved together at most `steps` times.

    They start at u = 0 with every spring at the limit of friction, u + c = d - r^2: gross slip, or
    no contact yet where the radius, shape (n,), is 0.
    """

    def __init__(self, radius: Array, steps: int) -> None:
        n = radius.size
        self._column = np.arange(n)
        self._top = np.ones(n, dtype=np.intp)  # index of each tip
        # Vertices, innermost first: radius, c, and the integral of c over the radius up to there.
        self._radius, self._memory, self._integral = np.zeros((3, steps + 2, n))
        self._memory[0] = self._radius[1] = radius
        self._memory[0] *= radius
        self._integral[1] = _integral(0.0, self._memory[0], radius, 0.0)
        self.stick_radius = np.zeros(n)

    @property
    def centre(self) -> Array:
        """What the springs in the middle remember, which changes in gross slip alone."""
        return self._memory[0]

    def move(
        self, radius: Array, displacement: Array, which: slice | Integers = slice(None)
    ) -> Array:
        """Move the tips of some contacts in one straight step (in r^2, u); return the forces.

        `radius` and `displacement` are those at the end of the step. Afterwards `stick_radius`
        is the radius inside which nothing slipped in this step.
        """
        # The new cone has its tip at c = -u. Vertices inside it stay; those outside have slipped.
        column, top, memory = self._column[which], self._top[which], -displacement
        highest, lowest = radius**2 + memory, memory - radius**2  # of c + r^2, of c - r^2
        last = self._last_inside(column, top, highest, lowest)
        slips, gross = last < top, last < 0
        kept = np.maximum(last, 0)
        outside = np.minimum(last + 1, top)  # the innermost vertex outside, if there is one
        r, c, integral = (a[kept, column] for a in (self._radius, self._memory, self._integral))
        edge_r, edge_c = _crossing(
            r, c, self._radius[outside, column], self._memory[outside, column], highest, lowest
        )
        # In gross slip no vertex stays: the chain starts anew on the edge of the cone, at r = 0.
        edge_r[gross] = 0.0
        edge_c[gross] = np.clip(c, lowest, highest)[gross]
        edge_r = np.where(slips, np.minimum(edge_r, radius), r)
        edge_c = np.where(slips, edge_c, c)
        integral = np.where(gross, 0.0, integral + _integral(r, c, edge_r, edge_c))
        # The chain now ends with the point where it meets the edge, and the tip after it.
        edge = np.where(slips, last + 1, last)
        self._put(edge, column, edge_r, edge_c, integral)
        integral = integral + _integral(edge_r, edge_c, radius, memory)
        self._put(edge + 1, column, radius, memory, integral)
        self._top[which] = edge + 1
        self.stick_radius[which] = np.where(slips, edge_r, radius)
        return 1.5 * (displacement * radius + integral)

    def _last_inside(
        self, column: Integers, top: Integers, highest: Array, lowest: Array
    ) -> Integers:
        """Index of the outermost vertex inside the new cone, -1 for none: inner ones are too."""
        last, active = top.copy(), np.arange(top.size)
        # Each turn looks at the outermost vertex that is left. A contact leaves the loop when that
        # vertex is inside the cone, or when none is left. So the loop ends.
        while active.size:
            vertex = last[active], column[active]
            square, c = self._radius[vertex] ** 2, self._memory[vertex]
            active = active[(c + square > highest[active]) | (c - square < lowest[active])]
            last[active] -= 1
            active = active[last[active] >= 0]
        return last

    def _put(
        self, index: Integers, column: Integers, radius: Array, memory: Array, integral: Array
    ) -> None:
        self._radius[index, column] = radius
        self._memory[index, column] = memory
        self._integral[index, column] = integral


def _crossing(
    r: Array, c: Array, outer_r: Array, outer_c: Array, highest: Array, lowest: Array
) -> tuple[Array, Array]:
    """Where the piece from a vertex inside the cone to one outside leaves it: radius and c.

    `above` and `below` are the shares of the piece up to the upper and to the lower edge.
    """
    square, outer = r * r, outer_r * outer_r
    with np.errstate(divide="ignore", invalid="ignore"):  # where there is no vertex inside
        above = np.maximum(highest - (c + square), 0) / (outer_c + outer - (c + square))
        below = np.maximum(c - square - lowest, 0) / (c - square - (outer_c - outer))
    above = np.where(outer_c + outer > highest, above, 1.0)
    below = np.where(outer_c - outer < lowest, below, 1.0)
    square = square + np.minimum(above, below) * (outer - square)
    return np.sqrt(square), np.where(above <= below, highest - square, lowest + square)


def _integral(r: Numbers, c: Array, outer_r: Array, outer_c: Numbers) -> Array:
    """Integral over the radius of a piece that is straight in r^2."""
    total = r + outer_r
    share = (outer_r + 2 * r) / (3 * np.where(total > 0, total, 1.0))
    return (outer_r - r) * (c + (outer_c - c) * share)


@checks.default_errors
def friction(radius: ArrayLike, displacement: ArrayLike) -> tuple[Array, Array]:
    """Tangential force along a given path of approach and displacement (quasi-static).

    Parameters
    ----------
    radius : array_like, shape (steps,)
        Radius of contact after each step, in a_max; 1e-6 to 1. No contact before the first step.
    displacement : array_like, shape (steps,)
        Tangential displacement of the body in zeta^2 mu d_max, counted from first contact.

    Returns
    -------
    friction : ndarray, shape (steps,)
        Tangential force in mu times the normal force at radius 1; positive for a positive
        displacement of the body.
    stick_radius : ndarray, shape (steps,)
        Radius inside which the contact sticks, in a_max.

    Notes
    -----
    Exact for a path that is straight, in r^2 and displacement, between its points. For a contact
    pressed down and then pushed sideways it is the closed form of Cattaneo and Mindlin.

    Examples
    --------
    >>> force, stick = friction([1.0, 1.0], [0.0, 0.75])
    >>> float(force[1]), float(stick[1])
    (0.875, 0.5)
    """
    allowed = "numbers from -1e6 to 1e6"
    radius, displacement = checks.broadcast(
        radius=checks.checked("radius", radius, "numbers from 1e-6 to 1", 1e-6, 1),
        displacement=checks.checked("displacement", displacement, allowed, -1e6, 1e6),
    )
    if radius.ndim != 1:
        raise checks.InputError(f"shape = {radius.shape}: a path has one dimension")
    springs = ElasticSprings(np.zeros(1), radius.size)
    force, stick = np.empty((2, radius.size))
    for step, point in enumerate(zip(radius[:, None], displacement[:, None], strict=True)):
        force[step] = springs.move(*point)[0]
        stick[step] = springs.stick_radius[0]
    return force, stick
