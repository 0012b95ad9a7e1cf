"""Four models of the paper's sphere below e = 1: two of the paper's kind, two continua."""

from collections.abc import Callable
from typing import NamedTuple

from planarimpact import continuum, lumped
from planarimpact.continuum import ContinuumHistory
from planarimpact.ground.arrays import ArrayLike
from planarimpact.ground.results import History, Rebound
from stronge1994.ledger import contact

PAPER, UNLOADING_STIFFNESS = "paper", "unloading_stiffness"
LOSSES = ("viscous", "plastic")
MODELS = (PAPER, UNLOADING_STIFFNESS, *LOSSES)
# The loss of the paper's model, and that of the same model with e^2 zeta^2 in place of zeta^2.
LUMPED = {PAPER: "hysteretic", UNLOADING_STIFFNESS: "unloading-stiffness"}
# Error of the continua. It is small compared with every bound of the ledger.
TOLERANCE = 1e-3


class Model(NamedTuple):
    """A model: rebounds, and the history of one contact, by incidence and restitution."""

    rebound: Callable[[ArrayLike, ArrayLike], Rebound]
    history: Callable[[float, float], History | ContinuumHistory]


def model(name: str) -> Model:
    """One of `MODELS`.

    With the unloading stiffness e^2 zeta^2 takes the place of zeta^2. That is a ratio of elastic
    stiffnesses, and the elastic normal stiffness of the paper's contact is that of unloading,
    kappa/e^2.

    >>> [round(float(model(name).rebound(3.0, 0.5).velocity), 1) for name in MODELS]
    [-2.0, -0.6, -0.6, -0.8]
    """
    if name in LOSSES:
        return Model(
            lambda x, e: contact.once(
                continuum.rebound, x, *contact.SPHERE, e, loss=name, tolerance=TOLERANCE
            ),
            lambda x, e: contact.once(
                continuum.history, x, *contact.SPHERE, e, loss=name, tolerance=TOLERANCE
            ),
        )
    loss = LUMPED[name]
    return Model(
        lambda x, e: contact.once(lumped.rebound, x, *contact.SPHERE, e, loss=loss),
        lambda x, e: contact.once(lumped.history, x, *contact.SPHERE, e, loss=loss, samples=513),
    )
