"""What an answer does not have at once: computed when somebody asks a `Collision` for it.

That is the model by its name, the model form, the caution, and the energy that is lost.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from planarimpact import bodies
from planarimpact.collision import mechanics, methods
from planarimpact.collision.mechanics import Impacts
from planarimpact.collision.model_form import model_forms
from planarimpact.common.arrays import Array, Integers
from planarimpact.common.cautions import Caution
from planarimpact.common.results import Regime

# By the place of a method; then the name of a model that was asked for, and of no impact.
MODELS = tuple(method.model for method in methods.METHODS)
NO_IMPACT = "no impact"


class Facts(NamedTuple):
    """Impacts with their answers, and how their values get the shape of the arguments.

    Attributes
    ----------
    whole : callable
        Of values, shape (n,), and a value where bodies do not approach: in the shape of arguments.
    impacts : Impacts
        It needs no vectors.
    place, change, regime : ndarray, shape (n,)
        As in `methods.Answers`.
    asked : tuple of str
        Names of the models that were asked for.
    spared : Caution
        Those that do not concern the model that was asked for.
    energies : tuple of ndarray, shape (n,), or None
        Lost along the normal and along the surface [J], where `mechanics` does not know it.
    form : ndarray or None
        The model form, in its shape, where it is known already.
    solve : bool
        Whether the continuum may be solved for it.
    """

    whole: Callable[[Any, Any], Any]
    impacts: Impacts
    place: Integers
    change: Array
    regime: Integers
    asked: tuple[str, ...] = ()
    spared: Caution = Caution.NONE
    energies: tuple[Array, Array] | None = None
    form: Array | None = None
    solve: bool = True

    def model(self) -> Any:
        """Names of the models that answered."""
        return np.array([*MODELS, *self.asked, NO_IMPACT])[self.whole(self.place, -1)]

    def model_form(self) -> Array:
        """How far the velocity of the contact point would move with the other loss [m/s]."""
        if self.form is not None:
            return self.form
        velocity = self.impacts.v1 + self.change
        return self.whole(model_forms(self.impacts, self.place, velocity, self.solve), np.nan)

    def caution(self) -> Any:
        """Codes of `Caution`."""
        codes = cautions(self.impacts, self.place, self.regime, self.spared)
        codes = self.whole(codes, 0)
        return codes if codes.ndim else Caution(int(codes))

    def energy_lost(self) -> Array:
        """Along the normal and along the surface [J], shape (..., 2)."""
        lost = self.energies or mechanics.energies_lost(self.impacts, self.change)
        return self.whole(np.array(lost), 0.0)


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
