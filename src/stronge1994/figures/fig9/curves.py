"""Fig. 9: share of the initial kinetic energy dissipated by friction."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from planarimpact import lumped, rigid
from planarimpact.common.arrays import Array
from stronge1994 import tables
from stronge1994.figures.shared.curves.curves_below_one import rebounds_of_continua
from stronge1994.figures.shared.curves.printed_variants import printed_variants
from stronge1994.figures.shared.curves.sampling import NO_NODES, Nodes, vertices
from stronge1994.printed import impact
from stronge1994.printed.equations import slip_throughout_limit as printed_limit
from stronge1994.tables import Table

ANGLE, LOST = "angle [deg]", "friction_dissipation [m2 S^2/2]"


def curves(
    mass_ratio: float,
    stiffness_ratio: float,
    angle: Sequence[float],
    friction: Sequence[float],
    restitution: Sequence[float],
    samples: int,
    continua: Mapping[str, Any] | None = None,
    nodes: Nodes = NO_NODES,
    as_printed: bool = False,
) -> Table:
    """Dissipation by friction over m2 S^2/2, from two independent calculations.

    For each mu and e the model `lumped` has the dissipation from the balance of energy, and the
    work of friction integrated over the phases of slip. `rigid` and the continua have the
    dissipation; that of a continuum is the work of its friction.

    >>> table = curves(3.5, 1.21, (0, 90), [0.5], [1.0], 10)
    >>> table["curve"].unique().tolist()
    ['lumped, mu = 0.5, e = 1', 'rigid, mu = 0.5, e = 1']
    """
    extra = nodes.get("angle", ())
    parts = []
    for mu in friction:
        for e in restitution:
            limit = lumped.slip_throughout_limit(mass_ratio, stiffness_ratio, e)
            limits = limit, printed_limit(mass_ratio, e)
            thresholds = np.array([stiffness_ratio, mass_ratio, *limits])
            theta = vertices(angle, samples, np.degrees(np.arctan(mu * thresholds)), extra)
            x, share = _incidence_and_share(theta, mu)
            lost = lumped.rebound(x, mass_ratio, stiffness_ratio, e).dissipation
            work = lumped.friction_work(x, mass_ratio, stiffness_ratio, e)
            rough = rigid.rebound(x, mass_ratio, restitution=e).dissipation
            columns = {ANGLE: theta, LOST: share * lost}
            both = columns | {"friction_work [m2 S^2/2]": share * work}
            parts.append(tables.curve(both, "lumped", mu=mu, e=e))
            parts.append(tables.curve({ANGLE: theta, LOST: share * rough}, "rigid", mu=mu, e=e))
            if as_printed:
                _, _, printed = impact.rebound(x, mass_ratio, stiffness_ratio, e)
                parts += printed_variants(columns, share * printed, mu=mu, e=e)
        theta = vertices(angle, samples, extra)
        x, share = _incidence_and_share(theta, mu)
        for model, e, found in rebounds_of_continua(continua, x, mass_ratio, stiffness_ratio):
            columns = {ANGLE: theta, LOST: share * found.dissipation}
            parts.append(tables.curve(columns, model, mu=mu, e=e))
    return tables.join(parts)


def _incidence_and_share(theta: Array, mu: float) -> tuple[Array, Array]:
    """Incidences for angles in degrees, and mu^2 m2 v2(0)^2 over m2 S^2/2."""
    return np.tan(np.radians(theta)) / mu, 2 * (mu * np.cos(np.radians(theta))) ** 2
