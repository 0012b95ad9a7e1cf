"""Continua that lose energy, drawn light beside the curves of the paper's model."""

from collections.abc import Iterator, Mapping
from typing import Any

from planarimpact import models
from planarimpact.ground.arrays import ArrayLike
from planarimpact.ground.results import Rebound
from stronge1994.curve_names import name

# Energy is lost by relaxation, with one time in shear and compression, or by yield.
MODELS = ("continuum.viscous", "continuum.plastic")


def rebounds_of_continua(
    continua: Mapping[str, Any] | None, x: ArrayLike, mass_ratio: float, stiffness_ratio: float
) -> Iterator[tuple[str, Rebound]]:
    """Names of curves and rebounds of each continuum at each restitution, if `continua` is set.

    >>> settings = {"models": ["continuum.viscous"], "restitution": [0.5], "tolerance": 1e-3}
    >>> ((name, rebound),) = rebounds_of_continua(settings, [6.0], 3.5, 1.21)
    >>> name, rebound.velocity.tolist()
    ('continuum.viscous, e = 0.5', [0.75])
    """
    if continua:
        for e in continua["restitution"]:
            for model in continua["models"]:
                rebound = models.rebound(
                    model, x, mass_ratio, stiffness_ratio, e, tolerance=continua["tolerance"]
                )
                yield f"{model}, {name('e', e)}", rebound
