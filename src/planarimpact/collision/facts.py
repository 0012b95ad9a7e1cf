"""What an answer does not have at once: `Collision` computes it when somebody asks for it.

**Model form** is how far the answer would move if the energy were lost in the other way. A
coefficient of restitution says how much normal energy is lost, not how. `continuum` has two ways,
viscous and plastic. The difference of their velocities at separation is no error of a solver: no
tolerance makes it smaller, only knowledge of the material does.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from planarimpact import bodies, continuum
from planarimpact.collision import methods
from planarimpact.collision.mechanics import Impacts
from planarimpact.common.arrays import Array, Integers
from planarimpact.common.cautions import Caution
from planarimpact.common.losses import CODES, PLASTIC, VISCOUS
from planarimpact.common.results import Regime

# Tolerance of the continuum with the other loss, mu v2(0): two digits of the difference suffice.
FORM_TOLERANCE = 1e-2


class Facts(NamedTuple):
    """Impacts with their answers, and how their values get the shape of the arguments."""

    # Of values, shape (n,), and a value where bodies do not approach: in the shape of arguments.
    whole: Callable[[Any, Any], Any]
    impacts: Impacts  # without vectors
    place: Integers  # this and the next two as in `methods.Answers`
    change: Array
    regime: Integers
    asked: tuple[str, ...] = ()  # names of the models that were asked for
    spared: Caution = Caution.NONE  # those that do not concern the model that was asked for
    # Lost along the normal and along the surface [J], where `mechanics` does not know it.
    energies: tuple[Array, Array] | None = None
    form: Array | None = None  # the model form, in its shape, where it is known already
    solve: bool = True  # whether the continuum may be solved for it


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
        found = methods.answers(others._replace(loss_code=code), FORM_TOLERANCE, solve=solve)
        form[rows] = np.abs(found.velocity - velocity[rows])
        form[rows[[*found.refused, *found.unsolved]]] = np.nan
    return form


def cautions(
    impacts: Impacts, place: Integers, regime: Integers, spared: Caution = Caution.NONE
) -> Integers:
    """Codes of `Caution`, shape (n,).

    Where the contact slides throughout, Coulomb's law alone decides; head-on nothing does.
    """
    moves = (impacts.v1 > 0) | (place >= methods.ASKED)
    sticks = moves & (regime != Regime.SLIP_THROUGHOUT)
    dissimilar = impacts.dundurs > bodies.COUPLING * impacts.friction
    codes = Caution.codes(impacts.loss_code, impacts.friction, impacts.restitution, dissimilar)
    codes = codes + Caution.NO_MICRO_SLIP * ~methods.IS_CONTINUUM[place]
    codes = np.where(sticks, codes & ~spared, codes & Caution.FRICTION)
    return np.where(moves, codes, 0)


def in_shape(
    approach: Integers, count: int, shape: tuple[int, ...], values: Any, before: Any
) -> Any:
    """Values of impacts, and those before where bodies do not approach, in the given shape."""
    if approach.size < count:
        everywhere = np.empty((*values.shape[:-1], count), values.dtype)
        everywhere[:] = before
        everywhere[..., approach] = values
        values = everywhere
    return values.T.reshape((*shape, *values.shape[:-1]))[()]
