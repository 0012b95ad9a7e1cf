"""Four models of the paper's sphere below e = 1: two of the paper's kind, two continua."""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from planarimpact import continuum, lumped
from planarimpact.ground.arrays import Array, ArrayLike
from planarimpact.ground.results import ContinuumHistory, History, Rebound
from stronge1994.ledger import contact

PAPER, REPAIRED = "paper", "repaired"
LOSSES = ("viscous", "plastic")
MODELS = (PAPER, REPAIRED, *LOSSES)
# Error of the continua. It is small beside every bound of the ledger.
TOLERANCE = 1e-3


class Model(NamedTuple):
    """A model: rebounds, and the history of one contact, by incidence and restitution."""

    rebound: Callable[[ArrayLike, ArrayLike], Rebound]
    history: Callable[[float, float], History | ContinuumHistory]


def model(name: str) -> Model:
    """One of `MODELS`.

    The repaired model is the paper's with e^2 zeta^2 in place of zeta^2: zeta^2 is a ratio of
    elastic stiffnesses, and the elastic normal stiffness of the paper's contact is that of its
    unloading, kappa/e^2.

    Examples
    --------
    >>> [round(float(model(name).rebound(3.0, 0.5).velocity), 1) for name in MODELS]
    [-2.0, -0.6, -0.4, -0.6]
    """
    beta, zeta2 = contact.SPHERE
    if name in LOSSES:
        return Model(
            lambda x, e: contact.once(
                continuum.rebound, x, beta, zeta2, e, loss=name, tolerance=TOLERANCE
            ),
            lambda x, e: contact.once(
                continuum.history, x, beta, zeta2, e, loss=name, tolerance=TOLERANCE
            ),
        )

    def ratio(e: ArrayLike) -> Array:
        return zeta2 * np.square(e) if name == REPAIRED else np.full_like(e, zeta2, float)

    return Model(
        lambda x, e: contact.once(lumped.rebound, x, beta, ratio(e), e),
        lambda x, e: contact.once(lumped.history, x, beta, ratio(e), e, samples=513),
    )
