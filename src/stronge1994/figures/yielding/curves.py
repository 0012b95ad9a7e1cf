"""Beyond the paper: spheres that yield, six models and finite elements of our own."""

from collections.abc import Mapping, Sequence
from functools import partial
from typing import Any

import numpy as np
from scipy.integrate import cumulative_trapezoid

from planarimpact.common.arrays import Array, ArrayLike
from planarimpact.continuum import inelastic
from planarimpact.continuum.inelastic.plastic import PlasticMotion
from stronge1994 import names, tables
from stronge1994.figures.shared.curves import curves_below_one
from stronge1994.figures.shared.curves.sampling import vertices
from stronge1994.names import ELASTIC, ELASTIC_IN_SHEAR
from stronge1994.tables import Table

MODELS = (*names.MODELS, ELASTIC_IN_SHEAR)
# Columns of data/finite_elements/spheres.csv that tell its rows apart.
LABELS = ("set", "contact", "run")
X, W = "incidence [mu v2(0)]", "velocity [mu v2(0)]"
# Number of springs in the row under a pushed contact, and of points that its curve keeps.
SPRINGS, KEPT = 4000, 100
# Largest restitution of a sphere that yields.
ALMOST_ELASTIC = 1 - 1e-9


def curves(
    mass_ratio: float,
    points: Mapping[str, Sequence[Any]],
    contact: Mapping[str, Any],
    elastic: Mapping[str, Sequence[float]],
    pushed: Sequence[float],
    incidence: Sequence[float],
    samples: int,
    tolerance: float,
) -> Table:
    """What each model says of every run, and of two contacts at all incidences.

    `points` has the columns of data/finite_elements/spheres.csv. For each of `MODELS` there are the
    variant `runs`, and a curve for each `e`. With them come the elastic continuum for each `nu`,
    and the variant `pushed`: the force on a contact that is pushed while it yields.

    >>> run = {"set": ["a"], "contact": ["b"], "run": ["c"], "incidence": [2.0],
    ...        "restitution": [0.55], "poisson_ratio": [0.3]}
    >>> table = curves(3.5, run, {"restitution": [0.55], "poisson_ratio": 0.3},
    ...                {"poisson_ratio": [0.3]}, [0.55], [0, 6], 3, 1e-2)
    >>> own = tables.select(table, model="continuum.plastic", variant="runs")
    >>> float(own["velocity [mu v2(0)]"].round(1)[0])
    -0.3
    """
    x = vertices(incidence, samples)
    at, e = (np.array(points[key], float) for key in ("incidence", "restitution"))
    ratios = np.array([curves_below_one.stiffness_ratio(nu) for nu in points["poisson_ratio"]])
    labels = {key: points[key] for key in LABELS}
    of_contact = mass_ratio, curves_below_one.stiffness_ratio(contact["poisson_ratio"])
    parts = []
    for model in MODELS:
        solve = partial(_velocity, model, tolerance)
        runs = labels | {X: at, W: solve(at, mass_ratio, ratios, e)}
        parts.append(tables.curve(runs, model, "runs"))
        for one in contact["restitution"]:
            parts.append(tables.curve({X: x, W: solve(x, *of_contact, one)}, model, e=one))
    for nu in elastic["poisson_ratio"]:
        velocity = _velocity(
            ELASTIC, tolerance, x, mass_ratio, curves_below_one.stiffness_ratio(nu)
        )
        parts.append(tables.curve({X: x, W: velocity}, ELASTIC, nu=nu))
    for one in pushed:
        approach, share = share_of_elastic(one)
        columns = {"approach [delta_max]": approach, "share_of_elastic_force [1]": share}
        parts.append(tables.curve(columns, "continuum.plastic", "pushed", e=one))
    return tables.join(parts)


class ElasticInShear(PlasticMotion):
    """Thornton's own sphere, which forgets no shear while it yields: for comparison alone."""

    flows = 0.0


def _velocity(model: str, tolerance: float, *groups: ArrayLike) -> Array:
    if model == ELASTIC_IN_SHEAR:
        x, beta, zeta2, e = np.broadcast_arrays(*groups)
        lossy, allowed = np.minimum(e, ALMOST_ELASTIC), np.full(x.size, tolerance)
        return inelastic.rebound(x, beta, zeta2, lossy, ElasticInShear, allowed)[0]
    return curves_below_one.rebound(model, tolerance, *groups).velocity


def share_of_elastic(restitution: float) -> tuple[Array, Array]:
    """Tangential force of a contact that sticks and is pushed at a constant speed, in loading.

    Over that of an elastic contact which has come as near. The spring at radius r touches at the
    approach r^2, follows the displacement U, and flows: q' = U' - q f'. So exp(f) q is the integral
    of exp(f) dU since then. The force is the sum of all springs.

    >>> approach, share = share_of_elastic(0.55)
    >>> [round(float(np.interp(at, approach, share)), 2) for at in (0.05, 0.5, 0.8)]
    [1.0, 0.27, 0.19]
    """
    motion = PlasticMotion(np.array([min(restitution, ALMOST_ELASTIC)]))
    motion.put_springs(np.linspace(0.0, 1.0, SPRINGS + 1)[:, None])
    radius, displacement = motion.radius[:, 0], motion.time[: SPRINGS + 1, 0]
    approach = motion.approach[: SPRINGS + 1, 0]
    flow = motion.flowed(approach[:, None])[:, 0]
    pulled = cumulative_trapezoid(np.exp(flow), displacement, initial=0)
    force = np.exp(-flow) * (radius * pulled - cumulative_trapezoid(pulled, radius, initial=0))
    elastic = radius * displacement - cumulative_trapezoid(displacement, radius, initial=0)
    kept = slice(SPRINGS // KEPT, None, SPRINGS // KEPT)
    return approach[kept] / approach[-1], force[kept] / elastic[kept]
