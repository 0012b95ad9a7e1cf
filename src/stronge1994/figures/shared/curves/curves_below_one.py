"""Models of an impact that loses energy, e < 1: as curves, and at measured points."""

from collections.abc import Iterable, Iterator, Mapping
from typing import Any

import numpy as np

from planarimpact import bodies, models
from planarimpact.bodies import Material
from planarimpact.common.arrays import Array, ArrayLike
from planarimpact.common.results import Rebound
from stronge1994.tables import sigma_name


def rebound(model: str, tolerance: float, *groups: ArrayLike) -> Rebound:
    """State at separation; `groups` as for `models.rebound`, `tolerance` of a continuum.

    >>> float(rebound("lumped.hysteretic", 1e-3, 8.0, 3.5, 1.21, 1.0).velocity)
    1.0
    """
    settings = {"tolerance": tolerance} if "tolerance" in models.get(model).settings else {}
    return models.rebound(model, *groups, **settings)


def rebounds_of_continua(
    continua: Mapping[str, Any] | None, x: ArrayLike, mass_ratio: float, stiffness_ratio: float
) -> Iterator[tuple[str, float, Rebound]]:
    """Model, restitution and rebound of each continuum at each restitution, if `continua` is set.

    >>> settings = {"models": ["continuum.viscous"], "restitution": [0.5], "tolerance": 1e-3}
    >>> ((model, e, found),) = rebounds_of_continua(settings, [6.0], 3.5, 1.21)
    >>> model, e, found.velocity.tolist()
    ('continuum.viscous', 0.5, [0.75])
    """
    if not continua:
        return
    for e in continua["restitution"]:
        for model in continua["models"]:
            yield model, e, rebound(model, continua["tolerance"], x, mass_ratio, stiffness_ratio, e)


def stiffness_ratio(nu: float) -> float:
    """zeta^2 of two bodies of one material, by its Poisson's ratio.

    >>> round(stiffness_ratio(0.3), 4)
    1.2143
    """
    return float(bodies.stiffness_ratio(Material(1.0, nu)))


def each_lowered(parameters: ArrayLike, sigmas: ArrayLike) -> Array:
    """Parameters of points: as stated, and with one parameter after the other lowered by its sigma.

    Both arguments have a row for each parameter and a column for each point. The result is [a, b,
    c] for parameter a of point c; b = 0 is as stated, and b = 1 + i has parameter i lowered.

    >>> each_lowered([[0.9, 0.8], [0.5, 0.25]], [[0.1, 0.2], [0.25, 0.125]])[1].tolist()
    [[0.5, 0.25], [0.5, 0.25], [0.25, 0.125]]
    """
    values, sigma = np.asarray(parameters, float), np.asarray(sigmas, float)
    cases = np.repeat(values[:, None], 1 + len(values), axis=1)
    for i in range(len(values)):
        cases[i, 1 + i] -= sigma[i]
    return cases


def with_sigma(column: str, cases: Iterable[Array]) -> dict[str, Array]:
    """A column of points, and its standard deviation from parameters that are each point's own.

    `cases` has the values as stated, then those with one parameter off by a sigma, as
    `each_lowered` has them.

    >>> with_sigma("y [1]", np.array([[1.0], [1.5]]))
    {'y [1]': array([1.]), 'y_sigma [1]': array([0.5])}
    """
    stated, *others = cases
    sigma = np.sqrt(np.sum(np.square([other - stated for other in others]), axis=0))
    return {column: stated, sigma_name(column): sigma}
