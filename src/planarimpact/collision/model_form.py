"""Model form: how far the answer would move if the energy were lost in the other way.

A coefficient of restitution says how much normal energy is lost, not how. `continuum` has two ways,
viscous and plastic. The difference of their velocities at separation is no error of a solver: no
tolerance makes it smaller, only knowledge of the material does.
"""

from typing import NamedTuple

import numpy as np

from planarimpact import continuum, spheres
from planarimpact.collision import continua
from planarimpact.ground import sliding
from planarimpact.ground.arrays import Array

# Tolerance of the continuum with the other loss, mu v2(0) and v1(0): two digits of the difference
# suffice.
TOLERANCE = 1e-2


class Summary(NamedTuple):
    """Differences of many impacts in a few numbers."""

    known: int = 0
    unknown: int = 0
    squares: float = 0.0
    largest: float = 0.0

    def joined(self, other: "Summary") -> "Summary":
        """The summary of the impacts of both."""
        return Summary(
            self.known + other.known,
            self.unknown + other.unknown,
            self.squares + other.squares,
            max(self.largest, other.largest),
        )

    def lines(self) -> list[str]:
        """One line of text; none where no energy is lost."""
        count = self.known + self.unknown
        if not count:
            return []
        typical = (self.squares / max(self.known, 1)) ** 0.5
        unknown = f", not known for {self.unknown}" if self.unknown else ""
        return [
            f"with the other loss the velocity would differ by {typical:.2g} mu v2(0) (root mean "
            f"square), {self.largest:.2g} at most: {count} impacts{unknown}"
        ]


def summary(differences: Array) -> Summary:
    """Summary of differences of velocity, mu v2(0), NaN where they are not known.

    >>> print(*summary(np.array([0.3, 0.4, np.nan])).lines())
    with the other loss the velocity would differ by 0.35 mu v2(0) (root mean square), 0.4 at \
most: 3 impacts, not known for 1
    """
    known = differences[np.isfinite(differences)]
    unknown = differences.size - known.size
    return Summary(known.size, unknown, float(np.sum(known**2)), float(np.max(known, initial=0.0)))


def velocity_with_other_loss(loss: str, incidence: Array, groups: tuple[Array, ...]) -> Array:
    """Velocity at separation, mu v2(0), of impacts that stick, NaN where there is no answer."""
    (other,) = set(continuum.LOSSES) - {loss}
    velocity, covered = np.full(incidence.size, np.nan), spheres.covers(*groups)
    rows = np.flatnonzero(covered)
    tabled_groups = (group[rows] for group in groups)
    tabled = spheres.rebound(incidence[rows], *tabled_groups, loss=other, forces=False)
    velocity[rows] = tabled.velocity
    rows = np.flatnonzero(~covered)
    if rows.size:
        groups = tuple(group[rows] for group in groups)
        tolerance = TOLERANCE * np.minimum(incidence[rows], 1.0)
        solved = continua.rebound(f"continuum.{other}", incidence[rows], groups, tolerance)
        velocity[rows[solved.rows]] = solved.rebound.velocity
    return velocity


def of_sliding(incidence: Array, groups: tuple[Array, ...]) -> Array:
    """Velocity with plastic loss, less that of viscous impacts that slide throughout, mu v2(0).

    With plastic loss such an impact may stick for a while. There may be very many of them, so that
    the difference is NaN where the table of spheres has no answer.
    """
    limit = continuum.slip_throughout_limit(*groups, loss="plastic")
    sticks = incidence < limit
    rows = np.flatnonzero(sticks & spheres.covers(*groups))
    x, (mass_ratio, stiffness_ratio, restitution) = incidence[rows], (g[rows] for g in groups)
    plastic = spheres.rebound(x, mass_ratio, stiffness_ratio, restitution, loss="plastic").velocity
    difference = np.where(sticks, np.nan, 0.0)
    difference[rows] = plastic - sliding.velocity(x, mass_ratio, restitution)
    return difference
