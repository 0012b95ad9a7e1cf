"""Model form: how far the answer would move if the energy were lost in the other way.

A coefficient of restitution says how much normal energy is lost, not how. `continuum` has two ways,
viscous and plastic. The difference of their velocities at separation is no error of a solver: no
tolerance makes it smaller, only knowledge of the material does.
"""

from typing import TypeAlias

import numpy as np

from planarimpact import continuum, models, spheres
from planarimpact.ground import sliding
from planarimpact.ground.arrays import Array, Integers
from planarimpact.scene.choice import REFERENCES, Job, without_unsolved

# Of the other continuum, mu v2(0). Nobody needs the third digit of a difference between models.
TOLERANCE = 1e-2
# Incidences between which the velocity of one pair is interpolated. That adds 0.01 at most for a
# solid sphere.
PLACES = 65

# Velocities of pairs that were solved, by the other model and the groups.
Curves: TypeAlias = dict[tuple[str, float, float, float], tuple[Array, Array]]


class Summary:
    """Differences of many impacts in a few numbers."""

    def __init__(self) -> None:
        self._count, self._squares, self._largest, self._unknown = 0, 0.0, 0.0, 0

    def add(self, differences: Array) -> None:
        """Take in differences of velocity, mu v2(0), NaN where they are not known."""
        known = np.abs(differences[np.isfinite(differences)])
        self._count += known.size
        self._unknown += differences.size - known.size
        self._squares += float(np.sum(known**2))
        self._largest = max(self._largest, float(np.max(known, initial=0.0)))

    def join(self, other: "Summary") -> None:
        """Take in what another one has."""
        self._count += other._count
        self._unknown += other._unknown
        self._squares += other._squares
        self._largest = max(self._largest, other._largest)

    def words(self) -> list[str]:
        """Lines for people; none where no energy is lost.

        Examples
        --------
        >>> found = Summary()
        >>> found.add(np.array([0.3, -0.4, np.nan]))
        >>> for line in found.words():
        ...     print(line)
        with the other loss the velocity would differ by 0.35 mu v2(0) (root mean square), 0.4 at \
most: 3 impacts, not known for 1
        """
        if not self._count + self._unknown:
            return []
        typical = (self._squares / max(self._count, 1)) ** 0.5
        unknown = f", not known for {self._unknown}" if self._unknown else ""
        return [
            f"with the other loss the velocity would differ by {typical:.2g} mu v2(0) (root mean "
            f"square), {self._largest:.2g} at most: {self._count + self._unknown} impacts{unknown}"
        ]


def difference(job: Job, incidence: Array, velocity: Array, known: Curves) -> Array:
    """Velocity with the other loss, less the velocity that was found.

    Parameters
    ----------
    job : Job
    incidence, velocity : ndarray, shape (n,)
        Of the impacts of the job; velocities at separation, mu v2(0).
    known : dict
        What was solved so far; a new pair is added.

    Returns
    -------
    ndarray, shape (n,)
        In mu v2(0), to about 0.01: 0 for an elastic job, NaN where the other continuum has no
        answer.
    """
    if job.rung.model not in REFERENCES[1:]:
        return np.zeros(incidence.size)
    (loss,) = set(continuum.LOSSES) - {job.rung.model.partition(".")[2]}
    if job.rung.way == "table":
        return spheres.rebound(incidence, *job.groups, loss=loss).velocity - velocity
    other = f"continuum.{loss}"
    if not job.alike:
        return _velocity(other, incidence, *map(np.asarray, job.groups)) - velocity
    pair = [float(np.reshape(group, -1)[0]) for group in job.groups]
    key = other, pair[0], pair[1], pair[2]
    if key not in known:
        x = np.linspace(0.0, float(continuum.slip_throughout_limit(*pair, loss=loss)), PLACES)
        known[key] = x, _velocity(other, x, *(np.full(PLACES, group) for group in pair))
    x, solved = known[key]
    slides = sliding.velocity(incidence, pair[0], pair[2])
    return np.where(incidence < x[-1], np.interp(incidence, x, solved), slides) - velocity


def of_sliding(incidence: Array, *groups: Array) -> Array:
    """Velocity with plastic loss, less that of viscous impacts that slide throughout, shape (n,).

    With plastic loss such an impact may stick for a while. NaN where the table of spheres has no
    answer: there may be very many such impacts.
    """
    found, limit = (
        np.zeros(incidence.size),
        continuum.slip_throughout_limit(*groups, loss="plastic"),
    )
    late = np.flatnonzero(incidence < limit)
    found[late] = np.nan
    late = late[spheres.covers(*(group[late] for group in groups))]
    x, some = incidence[late], [group[late] for group in groups]
    slides = sliding.velocity(x, some[0], some[2])
    found[late] = spheres.rebound(x, *some, loss="plastic").velocity - slides
    return found


def _velocity(model: str, incidence: Array, *groups: Array) -> Array:
    """Velocity at separation, NaN where the model has no answer."""

    def solve(left: Integers) -> Array:
        some = (group[left] for group in groups)
        return models.rebound(model, incidence[left], *some, tolerance=TOLERANCE).velocity

    velocity = np.full(incidence.size, np.nan)
    found, left, _ = without_unsolved(solve, incidence.size)
    velocity[left] = found
    return velocity
