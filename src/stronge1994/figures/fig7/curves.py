"""Fig. 7: largest normal and tangential force against the angle of incidence."""

from collections.abc import Sequence

import numpy as np

from planarimpact import lumped, rigid
from planarimpact.common.arrays import Array, ArrayLike
from stronge1994.csv_tables import Columns, Curves
from stronge1994.curve_names import name
from stronge1994.figures.shared.curves import as_printed as printed_curves
from stronge1994.figures.shared.curves.sampling import NO_NODES, Nodes, vertices
from stronge1994.printed import impact
from stronge1994.printed.slip import slip_throughout_limit as printed_limit


def curves(
    mass_ratio: float,
    stiffness_ratio: float,
    angle: Sequence[float],
    friction: Sequence[float],
    samples: int,
    nodes: Nodes = NO_NODES,
    as_printed: bool = False,
) -> Curves:
    """Peak forces over m2 Omega S; they do not depend on restitution when omega > Omega.

    The curves are `normal`; `mu = ...` and `no tangential compliance, mu = ...` for each mu; and
    `slip throughout`, below which the contact slides throughout.

    >>> named = curves(3.5, 1.21, (0, 90), [0.5], 91)
    >>> column = "peak_force [m2 Omega S]"
    >>> float(named["mu = 0.5"]["angle [deg]"][named["mu = 0.5"][column].argmax()])
    45.0
    """
    limit = float(lumped.slip_throughout_limit(mass_ratio, stiffness_ratio, 1.0))
    thresholds = np.array([stiffness_ratio, mass_ratio, limit])
    extra = nodes.get("angle", ())
    theta = vertices(angle, samples, extra)
    named = {
        "normal": _force(theta, np.cos(np.radians(theta))),
        "slip throughout": _force(theta, np.sin(np.radians(theta)) / limit),
    }
    for mu in friction:
        theta = vertices(angle, samples, np.degrees(np.arctan(mu * thresholds)), extra)
        x = np.tan(np.radians(theta)) / mu
        scale = mu * np.cos(np.radians(theta))
        compliant = lumped.rebound(x, mass_ratio, stiffness_ratio).peak_friction
        rough = rigid.rebound(x, mass_ratio).peak_friction
        named[name("mu", mu)] = _force(theta, scale * compliant)
        named[f"no tangential compliance, {name('mu', mu)}"] = _force(theta, scale * rough)
        if as_printed:
            named |= _as_printed(mu, mass_ratio, stiffness_ratio, samples, extra)
    return named


def _as_printed(
    mu: float, mass_ratio: float, stiffness_ratio: float, samples: int, nodes: ArrayLike
) -> Curves:
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
    return printed_curves.beside(name("mu", mu), _force(theta, exact), scale * peak)


def _force(theta: Array, force: Array) -> Columns:
    return {"angle [deg]": theta, "peak_force [m2 Omega S]": force}
