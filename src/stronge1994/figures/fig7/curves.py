"""Fig. 7: largest normal and tangential force against the angle of incidence."""

from collections.abc import Sequence

import numpy as np

from planarimpact import lumped, rigid
from planarimpact.common.arrays import Array, ArrayLike
from stronge1994 import tables
from stronge1994.figures.shared.curves.printed_variants import printed_variants
from stronge1994.figures.shared.curves.sampling import NO_NODES, Nodes, vertices
from stronge1994.printed import impact
from stronge1994.printed.equations import slip_throughout_limit as printed_limit
from stronge1994.tables import Table


def curves(
    mass_ratio: float,
    stiffness_ratio: float,
    angle: Sequence[float],
    friction: Sequence[float],
    samples: int,
    nodes: Nodes = NO_NODES,
    as_printed: bool = False,
) -> Table:
    """Peak forces over m2 Omega S; they do not depend on restitution when omega > Omega.

    The tangential force has a curve of the model `lumped` and one of `rigid` for each mu. Variants
    without mu are the `normal force`, and `slip throughout`, below which the contact slides
    throughout.

    >>> friction = tables.select(curves(3.5, 1.21, (0, 90), [0.5], 91), model="lumped", mu=0.5)
    >>> float(friction["angle [deg]"][friction["peak_force [m2 Omega S]"].idxmax()])
    45.0
    """
    limit = float(lumped.slip_throughout_limit(mass_ratio, stiffness_ratio, 1.0))
    thresholds = np.array([stiffness_ratio, mass_ratio, limit])
    extra = nodes.get("angle", ())
    theta = vertices(angle, samples, extra)
    normal, sliding = np.cos(np.radians(theta)), np.sin(np.radians(theta)) / limit
    parts = [
        tables.curve(_force(theta, normal), "lumped", "normal force"),
        tables.curve(_force(theta, sliding), "lumped", "slip throughout"),
    ]
    for mu in friction:
        theta = vertices(angle, samples, np.degrees(np.arctan(mu * thresholds)), extra)
        x = np.tan(np.radians(theta)) / mu
        scale = mu * np.cos(np.radians(theta))
        compliant = lumped.rebound(x, mass_ratio, stiffness_ratio).peak_friction
        rough = rigid.rebound(x, mass_ratio).peak_friction
        parts.append(tables.curve(_force(theta, scale * compliant), "lumped", mu=mu))
        parts.append(tables.curve(_force(theta, scale * rough), "rigid", mu=mu))
        if as_printed:
            parts += _as_printed(mu, mass_ratio, stiffness_ratio, samples, extra)
    return tables.join(parts)


def _as_printed(
    mu: float, mass_ratio: float, stiffness_ratio: float, samples: int, nodes: ArrayLike
) -> list[Table]:
    """Eqs 30 to 33 where they differ: from x = beta, where slip lasts to t_c, to (1 + e) beta."""
    limit = lumped.slip_throughout_limit(mass_ratio, stiffness_ratio, 1.0)
    end = float(printed_limit(mass_ratio, 1.0))
    x = vertices((mass_ratio, end), samples // 20 + 2, limit)
    ends = np.degrees(np.arctan(mu * np.array([mass_ratio, end]))).tolist()
    theta = vertices(ends, 2, np.degrees(np.arctan(mu * x)), nodes)
    x = np.clip(np.tan(np.radians(theta)) / mu, mass_ratio, end)
    scale = mu * np.cos(np.radians(theta))
    exact = scale * lumped.rebound(x, mass_ratio, stiffness_ratio).peak_friction
    _, peak, _ = impact.rebound(x, mass_ratio, stiffness_ratio, 1.0)
    return printed_variants(_force(theta, exact), scale * peak, mu=mu)


def _force(theta: Array, force: Array) -> dict[str, Array]:
    return {"angle [deg]": theta, "peak_force [m2 Omega S]": force}
