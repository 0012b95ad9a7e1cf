"""Fig. 9: share of the initial kinetic energy dissipated by friction."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from planarimpact import lumped, rigid
from planarimpact.common.arrays import Array
from stronge1994.csv_tables import Curves
from stronge1994.curve_names import name
from stronge1994.figures.shared.curves import as_printed as printed_curves
from stronge1994.figures.shared.curves.beside import rebounds_of_continua
from stronge1994.figures.shared.curves.sampling import NO_NODES, Nodes, vertices
from stronge1994.printed import impact
from stronge1994.printed.slip import slip_throughout_limit as printed_limit


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
) -> Curves:
    """Dissipation by friction over m2 S^2/2, from two independent calculations.

    `mu = ..., e = ...` has the dissipation from the balance of energy, and the work of friction
    integrated over the phases of slip. The continua, `continuum.viscous, mu = ..., e = ...`, have
    the work of friction.

    >>> named = curves(3.5, 1.21, (0, 90), [0.5], [1.0], 10)
    >>> sorted(named)
    ['mu = 0.5, e = 1', 'no tangential compliance, mu = 0.5, e = 1']
    """
    extra = nodes.get("angle", ())
    named = {}
    for mu in friction:
        for e in restitution:
            limit = lumped.slip_throughout_limit(mass_ratio, stiffness_ratio, e)
            limits = limit, printed_limit(mass_ratio, e)
            thresholds = np.array([stiffness_ratio, mass_ratio, *limits])
            theta = vertices(angle, samples, np.degrees(np.arctan(mu * thresholds)), extra)
            x, share = _incidence_and_share(theta, mu)
            lost = lumped.rebound(x, mass_ratio, stiffness_ratio, e).dissipation
            work = [lumped.friction_work(value, mass_ratio, stiffness_ratio, e) for value in x]
            rough = rigid.rebound(x, mass_ratio, restitution=e).dissipation
            pair = f"{name('mu', mu)}, {name('e', e)}"
            named[pair] = {
                "angle [deg]": theta,
                "friction_dissipation [m2 S^2/2]": share * lost,
                "friction_work [m2 S^2/2]": share * np.array(work),
            }
            named[f"no tangential compliance, {pair}"] = {
                "angle [deg]": theta,
                "friction_dissipation [m2 S^2/2]": share * rough,
            }
            if as_printed:
                _, _, printed = impact.rebound(x, mass_ratio, stiffness_ratio, e)
                named |= printed_curves.beside(pair, named[pair], share * printed)
        theta = vertices(angle, samples, extra)
        x, share = _incidence_and_share(theta, mu)
        for title, of_continuum in rebounds_of_continua(continua, x, mass_ratio, stiffness_ratio):
            model, e_name = title.split(", ")
            named[f"{model}, {name('mu', mu)}, {e_name}"] = {
                "angle [deg]": theta,
                "friction_dissipation [m2 S^2/2]": share * of_continuum.dissipation,
            }
    return named


def _incidence_and_share(theta: Array, mu: float) -> tuple[Array, Array]:
    """Incidences for angles in degrees, and mu^2 m2 v2(0)^2 over m2 S^2/2."""
    return np.tan(np.radians(theta)) / mu, 2 * (mu * np.cos(np.radians(theta))) ** 2
