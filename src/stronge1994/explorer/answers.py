"""Rebounds of the package within the sliders of the explorer, whose page solves by itself."""

from collections.abc import Mapping, Sequence
from typing import TypeAlias

import numpy as np

from planarimpact import lumped
from planarimpact.common.results import Regime

# Incidence, mass ratio, stiffness ratio, restitution; velocity, peak friction, dissipation and the
# name of the regime.
Answer: TypeAlias = tuple[list[float], list[float | str]]
COUNT, SEED = 60, 1994


def answers(limits: Mapping[str, Sequence[float]]) -> list[Answer]:
    """Rebounds that the page must reproduce: by random sliders, and on thresholds of two bodies.

    `limits` holds the smallest and the largest value of each slider, angles in degrees.

    >>> names = "angle", "friction", "restitution", "poisson_ratio", "compliance"
    >>> len(answers(dict.fromkeys(names, (0.2, 0.4)) | {"mass_ratio": (1, 10)})) > COUNT
    True
    """
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
