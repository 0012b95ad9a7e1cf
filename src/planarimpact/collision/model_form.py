"""Model form: how far the answer would move if the energy were lost in the other way.

A coefficient of restitution says how much normal energy is lost, not how. `continuum` has two ways,
viscous and plastic. The difference of their velocities at separation is no error of a solver: no
tolerance makes it smaller, only knowledge of the material does.
"""

import numpy as np

from planarimpact import continuum
from planarimpact.collision import methods
from planarimpact.collision.mechanics import Impacts
from planarimpact.common.arrays import Array, Integers
from planarimpact.common.losses import CODES, PLASTIC, VISCOUS

# Tolerance of the continuum with the other loss, mu v2(0): two digits of the difference suffice.
TOLERANCE = 1e-2


def model_forms(
    impacts: Impacts, place: Integers, velocity: Array, may_solve: bool = True
) -> Array:
    """How far the velocity of `Answers` would move with the other loss [m/s], NaN if not known.

    There may be very many impacts that slide throughout, and of which metal would stick for a
    while: their difference is NaN where the table of spheres has no answer. So is that of others
    if the continuum may not be solved.
    """
    form = np.zeros(impacts.v1.size)
    lossy = (impacts.loss_code >= 0) & (place != methods.HEAD_ON)
    form[lossy] = np.nan
    known = lossy & (place < methods.ASKED) & (impacts.restitution >= continuum.LEAST_RESTITUTION)
    # What yields slides throughout only where viscous spheres do.
    form[(place == methods.SLIDING) & (impacts.loss_code == CODES[PLASTIC])] = 0.0
    known &= np.isnan(form)
    rows = np.flatnonzero(known)
    if rows.size:
        others = impacts.take(rows)
        code = CODES[VISCOUS] + CODES[PLASTIC] - others.loss_code
        solve = may_solve & (place[rows] != methods.SLIDING)
        found = methods.answers(others._replace(loss_code=code), TOLERANCE, solve=solve)
        form[rows] = np.abs(found.velocity - velocity[rows])
        form[rows[[*found.refused, *found.unsolved]]] = np.nan
    return form
