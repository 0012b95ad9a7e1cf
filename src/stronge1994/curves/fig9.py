"""Fig. 9: share of the initial kinetic energy dissipated by friction."""

from collections.abc import Sequence

import numpy as np

from planarimpact import lumped, rigid
from stronge1994.csv_tables import Curves
from stronge1994.curve_names import name
from stronge1994.curves import as_printed as printed_curves
from stronge1994.curves.sampling import NO_NODES, Nodes, vertices
from stronge1994.printed import impact
from stronge1994.printed.slip import slip_throughout_limit as printed_limit


def curves(
    mass_ratio: float,
    stiffness_ratio: float,
    angle: Sequence[float],
    friction: Sequence[float],
    restitution: Sequence[float],
    samples: int,
    nodes: Nodes = NO_NODES,
    as_printed: bool = False,
) -> Curves:
    """Dissipation by friction over m2 S^2/2, from two independent calculations.

    Parameters
    ----------
    mass_ratio, stiffness_ratio : float
        beta and zeta^2.
    angle : (float, float)
        Range of the angle of incidence in degrees.
    friction, restitution : sequence of float
        Coefficients mu and e, a curve for each pair.
    samples : int
        Evenly spread vertices; thresholds come on top.
    nodes : dict, optional
        More vertices, of `angle`.
    as_printed : bool
        Add what the printed equations give, see `as_printed`.

    Returns
    -------
    dict
        `mu = ..., e = ...` with the dissipation from the balance of energy and the work of
        friction integrated over the phases of slip; `no tangential compliance, ...`.

    Examples
    --------
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
            x = np.tan(np.radians(theta)) / mu
            share = 2 * (mu * np.cos(np.radians(theta))) ** 2
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
    return named
