"""Beyond the paper: velocity at separation over incidence and restitution, for several springs."""

from collections.abc import Sequence

import numpy as np

from planarimpact import Regime, lumped
from stronge1994.csv_tables import Curves
from stronge1994.curve_names import name
from stronge1994.figures.shared.curves.sampling import NO_NODES, Nodes, vertices


def curves(
    mass_ratio: float,
    incidence: Sequence[float],
    restitution: Sequence[float],
    stiffness_ratio: Sequence[float],
    samples: int,
    restitutions: int,
    nodes: Nodes = NO_NODES,
) -> Curves:
    """One grid `zeta^2 = ...` for each stiffness ratio, a row for each impact of it.

    The incidence runs fastest. It has so many `samples`, and the restitution so many values, both
    evenly spread from the first number to the second.

    >>> named = curves(3.5, (0, 8), (0, 1), [1.21], 3, 2)
    >>> for column in ("restitution [1]", "incidence [mu v2(0)]", "velocity [mu v2(0)]"):
    ...     print(named["zeta^2 = 1.21"][column].round(2))
    [0. 0. 0. 1. 1. 1.]
    [0. 4. 8. 0. 4. 8.]
    [ 0.    0.5   4.5   0.   -1.75  1.  ]
    """
    x = vertices(incidence, samples, nodes.get("incidence", ()))
    low, high = restitution
    e = np.linspace(low, high, restitutions)[:, None]
    named = {}
    for zeta2 in stiffness_ratio:
        rebound = lumped.rebound(x, mass_ratio, zeta2, e)
        grid = {
            "incidence [mu v2(0)]": x,
            "restitution [1]": e,
            "velocity [mu v2(0)]": rebound.velocity,
            "peak_friction [mu F2max]": rebound.peak_friction,
            "dissipation [mu^2 m2 v2(0)^2]": rebound.dissipation,
            "regime": Regime.names(rebound.regime),
        }
        shape = rebound.velocity.shape
        named[name("zeta^2", zeta2)] = {
            column: np.broadcast_to(values, shape).ravel() for column, values in grid.items()
        }
    return named
