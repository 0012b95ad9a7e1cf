"""Model form: how far the answer would move if the energy were lost in the other way.

A coefficient of restitution says how much normal energy is lost, not how. `continuum` has two ways,
viscous and plastic. The difference of their velocities at separation is no error of a solver: no
tolerance makes it smaller, only knowledge of the material does.
"""

import numpy as np

from planarimpact import continuum, spheres
from planarimpact.collision import methods
from planarimpact.collision.mechanics import Impacts
from planarimpact.common import sliding
from planarimpact.common.arrays import Array, Integers
from planarimpact.common.losses import CODES, PLASTIC, VISCOUS, Loss

# Tolerance of the continuum with the other loss, mu v2(0) and v1(0): two digits of the difference
# suffice.
TOLERANCE = 1e-2


def model_forms(impacts: Impacts, place: Integers, velocity: Array) -> Array:
    """How far the velocity of `Answers` would move with the other loss [m/s], NaN if not known."""
    form, unit = np.zeros(impacts.v1.size), impacts.unit
    form[(place == methods.ASKED) & (impacts.loss_code >= 0)] = np.nan
    viscous = (place == methods.SLIDING) & (impacts.loss_code == CODES[VISCOUS])
    form[viscous] = np.nan
    rows = np.flatnonzero(viscous & (impacts.restitution >= continuum.LEAST_RESTITUTION))
    difference = _of_sliding(impacts.incidence_of(rows), impacts.groups_of(rows))
    form[rows] = np.abs(difference) * unit[rows]
    for loss, other in ((VISCOUS, PLASTIC), (PLASTIC, VISCOUS)):
        rows = np.flatnonzero(methods.IS_CONTINUUM[place] & (impacts.loss_code == CODES[loss]))
        moved = _velocity(other, impacts.incidence_of(rows), impacts.groups_of(rows))
        form[rows] = np.abs(moved * unit[rows] - velocity[rows])
    return form


def _velocity(loss: Loss, incidence: Array, groups: tuple[Array, ...]) -> Array:
    """Velocity at separation, mu v2(0), of impacts that stick, NaN where there is no answer."""
    velocity, covered = np.full(incidence.size, np.nan), spheres.covers(*groups)
    x, *of_table = (values[covered] for values in (incidence, *groups))
    velocity[covered] = spheres.rebound(x, *of_table, loss=loss.name, forces=False).velocity
    rows = np.flatnonzero(~covered)
    if rows.size:
        x, groups = incidence[rows], tuple(group[rows] for group in groups)
        rebound, solved, _ = methods.solved(loss, x, groups, TOLERANCE * np.minimum(x, 1.0))
        velocity[rows[solved]] = rebound.velocity
    return velocity


def _of_sliding(incidence: Array, groups: tuple[Array, ...]) -> Array:
    """Velocity with plastic loss, less that of viscous impacts that slide throughout, mu v2(0).

    With plastic loss such an impact may stick for a while. There may be very many of them, so that
    the difference is NaN where the table of spheres has no answer.
    """
    sticks = incidence < continuum.slip_throughout_limit(*groups, loss=PLASTIC.name)
    rows = np.flatnonzero(sticks & spheres.covers(*groups))
    x, (mass_ratio, stiffness_ratio, restitution) = incidence[rows], (g[rows] for g in groups)
    plastic = spheres.rebound(
        x, mass_ratio, stiffness_ratio, restitution, loss=PLASTIC.name
    ).velocity
    difference = np.where(sticks, np.nan, 0.0)
    difference[rows] = plastic - sliding.velocity(x, mass_ratio, restitution)
    return difference
