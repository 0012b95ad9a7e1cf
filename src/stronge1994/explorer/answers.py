"""Rebounds of the package within the sliders of the explorer, whose page solves by itself."""

from collections.abc import Mapping, Sequence
from itertools import product
from typing import TypeAlias

import numpy as np

from planarimpact import continuum, lumped
from planarimpact.common.results import Regime

# Incidence, mass ratio, stiffness ratio, restitution and for the continuum its loss; velocity, peak
# friction and for the lumped model dissipation and the name of the regime.
Answer: TypeAlias = tuple[list[float | str], list[float | str]]
COUNT, SEED = 60, 1994
# Tolerance of the package for the continuum, small against the error of the page.
TOLERANCE = 1e-3


def answers(limits: Mapping[str, Sequence[float]]) -> list[Answer]:
    """Rebounds that the page must reproduce, of the lumped model and of the continuum.

    `limits` holds the smallest and the largest value of each slider, angles in degrees.

    >>> names = "angle", "friction", "restitution", "poisson_ratio", "compliance"
    >>> len(answers(dict.fromkeys(names, (0.2, 0.4)) | {"mass_ratio": (1, 10)})) > COUNT
    True
    """
    return _lumped(limits) + _continuum()


def _continuum() -> list[Answer]:
    """Rebounds of the continuum, elastic and with each loss, of bodies within the sliders."""
    x = np.array([0.3, 1.0, 2.0, 4.0, 7.0])
    losses = [("elastic", 1.0), *product(("viscous", "plastic"), (0.9, 0.4))]
    found: list[Answer] = []
    for beta, zeta2 in ((3.5, 1.21), (2.5, 1.5), (10.0, 1.0)):
        for loss, e in losses:
            law = None if e == 1 else loss
            rebound = continuum.rebound(x, beta, zeta2, e, loss=law, tolerance=TOLERANCE)
            found += [
                ([incidence, beta, zeta2, e, loss], [velocity, peak])
                for incidence, velocity, peak in np.transpose(
                    [x, rebound.velocity, rebound.peak_friction]
                ).tolist()
            ]
    return found


def _lumped(limits: Mapping[str, Sequence[float]]) -> list[Answer]:
    """Rebounds of the lumped model: of random sliders, and of two bodies on every threshold."""
    rng = np.random.default_rng(SEED)
    draw = {name: rng.uniform(limit[0], limit[1], COUNT) for name, limit in limits.items()}
    nu = draw["poisson_ratio"]
    incidence = np.tan(np.radians(draw["angle"])) / draw["friction"]
    stiffness_ratio = draw["compliance"] * (2 - nu) / (2 * (1 - nu))
    groups = [incidence, draw["mass_ratio"], stiffness_ratio, draw["restitution"]]
    for beta, zeta2 in ((3.5, 1.25), (10.0, 1.0)):
        for e in (0.0, 0.3, 0.9, 1.0):
            limit = float(lumped.slip_throughout_limit(beta, zeta2, e))
            x = np.array([0.0, 0.5, zeta2, 2.0, beta, (beta + limit) / 2, limit, 2 * limit])
            own = np.broadcast_arrays(x, beta, zeta2, e)
            groups = [np.append(one, more) for one, more in zip(groups, own, strict=True)]
    rebound = lumped.rebound(*groups)
    names = Regime.names(rebound.regime)
    columns = rebound.velocity, rebound.peak_friction, rebound.dissipation, names
    return [
        (list(map(float, row)), [*map(float, numbers), str(name)])
        for row, *numbers, name in zip(np.transpose(groups), *columns, strict=True)
    ]
