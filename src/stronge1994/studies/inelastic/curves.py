"""Beyond the paper: restitution below 1, five models of loss and measured pairs of materials.

Experiments state one number for the tangential rebound, beta_0: minus the slope of the line that
fits w(x) where the contact does not slide. It is computed here as it was measured.
"""

from collections.abc import Callable, Mapping, Sequence
from functools import partial
from typing import Any, NamedTuple

import numpy as np
from scipy.interpolate import CubicSpline

from planarimpact import bodies
from planarimpact.bodies import Material
from planarimpact.common import sliding
from planarimpact.common.arrays import Array, ArrayLike
from planarimpact.common.results import Rebound
from stronge1994 import tables
from stronge1994.figures.shared.curves import curves_below_one
from stronge1994.figures.shared.curves.sampling import vertices
from stronge1994.names import MODELS
from stronge1994.studies.inelastic.trials import BETA_0, WHOLE, E
from stronge1994.tables import Table

# Slopes from which the fit starts. Friction never accelerates the body, so |w| is at most x.
TRIAL_SLOPES = np.linspace(-1.0, 1.0, 201)
# Number of impacts in a fit, so large that beta_0 does not depend on it.
FIT_SIZE = 2000
X, W = "incidence [mu v2(0)]", "velocity [mu v2(0)]"
PROPERTIES = "young_modulus", "poisson_ratio"  # of a material; before each stands its name


class Spread(NamedTuple):
    """Incidences of the impacts to which beta_0 is fitted.

    They reach from 0 to `reach` times (1 + e) beta, or to an `angle` in degrees, and are spread
    evenly over incidence or, with `by_angle`, over the angle of incidence.
    """

    reach: float = 1.0
    angle: float | None = None
    by_angle: bool = False


RANGES = {
    WHOLE: Spread(),
    "to 45 deg": Spread(angle=45.0),
    "to 60 deg": Spread(angle=60.0),
    "to 0.5 (1 + e) m2/m1": Spread(reach=0.5),
    "to 1.5 (1 + e) m2/m1": Spread(reach=1.5),
}
SPREADS = RANGES | {
    f"{spread_name}, by angle": spread._replace(by_angle=True)
    for spread_name, spread in RANGES.items()
}
LARGEST_REACH = max(spread.reach for spread in SPREADS.values())


def curves(
    mass_ratio: float,
    points: Mapping[str, Sequence[Any]],
    materials: Mapping[str, float],
    restitution: Sequence[float],
    poisson_ratio: Sequence[float],
    contact: Mapping[str, float],
    incidence: Sequence[float],
    samples: int,
    solved: int,
    tolerance: float,
    uncertainty: Mapping[str, float],
) -> Table:
    """What each model says of the measured pairs, of every restitution, and of every incidence.

    `points` has the columns of data/cornell1999/pairs.csv; `materials` has the parameters of its
    source.yaml, moduli in Pa, and `uncertainty` one sigma of each. For each of `MODELS` there are
    the variant `pairs` for each of the `SPREADS`, in the column `spread`; a curve with `nu` for
    both edges of the band; and one with `e` at all incidences. Beside beta_0 of the pairs stands
    the standard deviation that it has from restitution, friction and moduli, which are each pair's
    own. A smooth curve joins `solved` incidences of each contact.

    >>> pairs = {"pair": ["glass"], "body": ["glass"], "other": ["glass"], "restitution": [0.97],
    ...          "restitution_uncertainty": [0.01], "friction": [0.1],
    ...          "friction_uncertainty": [0.01]}
    >>> glass = {"glass_young_modulus": 7e10, "glass_poisson_ratio": 0.2}
    >>> sigmas = {"glass_young_modulus": 1e9, "glass_poisson_ratio": 0.01}
    >>> table = curves(3.5, pairs, glass, [0.8, 1.0], [0.2, 0.5], {"restitution": 0.6,
    ...                "poisson_ratio": 0.3}, (0, 8), 11, 24, 1e-3, sigmas)
    >>> own = tables.select(table, model="lumped.hysteretic", variant="pairs", spread=WHOLE)
    >>> float(own["tangential_restitution [1]"].round(2)[0])
    0.37
    """
    zeta2, zeta2_sigma = _stiffness_ratios(points, materials, uncertainty)
    parameters = "restitution", "friction"
    stated = np.array([*(points[key] for key in parameters), zeta2], float)
    sigmas = np.array([*(points[f"{key}_uncertainty"] for key in parameters), zeta2_sigma], float)
    # Each parameter is lowered by its sigma, because e cannot exceed 1.
    e, friction, ratios = curves_below_one.each_lowered(stated, sigmas)
    own = {key: points[key] for key in ("pair", "body", "other")} | {E: e[0]}
    band, x = np.array(restitution, float), vertices(incidence, samples)
    of_contact = curves_below_one.stiffness_ratio(contact["poisson_ratio"]), contact["restitution"]
    parts = []
    for model in MODELS:
        solve = partial(curves_below_one.rebound, model, tolerance)
        fitted = partial(_fitted, solve, solved, mass_ratio)
        for spread, cases in fitted(ratios, e, friction, list(SPREADS)).items():
            columns = own | curves_below_one.with_sigma(BETA_0, cases)
            parts.append(tables.curve(columns, model, "pairs", spread=spread))
        for nu in poisson_ratio:
            one = np.full_like(band, curves_below_one.stiffness_ratio(nu))
            # Friction has no influence on the whole range.
            beta_0 = fitted(one, band, one, [WHOLE])[WHOLE]
            parts.append(tables.curve({E: band, BETA_0: beta_0}, model, nu=nu))
        w = solve(x, mass_ratio, *of_contact).velocity
        parts.append(tables.curve({X: x, W: w}, model, e=contact["restitution"]))
    return tables.join(parts)


def _stiffness_ratios(
    points: Mapping[str, Sequence[Any]],
    materials: Mapping[str, float],
    uncertainty: Mapping[str, float],
) -> tuple[Array, Array]:
    """zeta^2 of every pair, and its sigma from those of the moduli."""

    def ratios(known: Mapping[str, float]) -> Array:
        pairs = [
            [Material(*(known[f"{_key(body)}_{part}"] for part in PROPERTIES)) for body in couple]
            for couple in zip(points["body"], points["other"], strict=True)
        ]
        return np.array([bodies.stiffness_ratio(*pair) for pair in pairs], float)

    stated = ratios(materials)
    changes = [
        ratios({**materials, key: materials[key] + sigma}) - stated
        for key, sigma in uncertainty.items()
    ]
    return stated, np.sqrt(np.sum(np.square(changes), axis=0))


def _key(material: str) -> str:
    """Name of a material as parameters of source.yaml have it."""
    return material.lower().replace(" ", "_").replace("-", "_")


def _fitted(
    solve: Callable[..., Rebound],
    solved: int,
    beta: float,
    zeta2: Array,
    e: Array,
    friction: Array,
    spreads: Sequence[str],
) -> dict[str, Array]:
    """beta_0 of contacts by spread; `zeta2`, `e` and `friction` have one shape."""
    ends = sliding.change(np.full_like(e, beta), e)
    x = LARGEST_REACH * ends[..., None] * np.linspace(0.0, 1.0, solved)
    w = solve(x, beta, zeta2[..., None], e[..., None]).velocity
    fitted = {spread: np.empty_like(e) for spread in spreads}
    for place in np.ndindex(e.shape):
        rebound = CubicSpline(x[place], w[place])
        end, mu, own_e = (float(values[place]) for values in (ends, friction, e))
        for spread, beta_0 in fitted.items():
            at = _impacts(end, mu, SPREADS[spread])
            beta_0[place] = tangential_restitution(at, rebound(at), beta, own_e)
    return fitted


def _impacts(end: float, friction: float, spread: Spread) -> Array:
    """Incidences of the impacts of one fit, up to `LARGEST_REACH` times the end of sticking."""
    reach = spread.reach * end
    if spread.angle is not None:
        reach = min(np.tan(np.radians(spread.angle)) / friction, LARGEST_REACH * end)
    share = (np.arange(FIT_SIZE) + 0.5) / FIT_SIZE
    if not spread.by_angle:
        return share * reach
    return np.tan(share * np.arctan(friction * reach)) / friction


def tangential_restitution(x: ArrayLike, w: ArrayLike, beta: float, e: float) -> float:
    """beta_0 of the two lines that fit rebounds best: w = max(-beta_0 x, x - (1 + e) beta).

    The line of slip throughout is known, so beta_0 is all that is fitted, by least squares of w.
    All incidences `x` are above 0.

    >>> x = np.linspace(0.1, 7, 70)
    >>> round(tangential_restitution(x, np.maximum(-0.4 * x, x - 7), 3.5, 1.0), 9)
    0.4
    """
    x, w = np.asarray(x, float), np.asarray(w, float)
    slip = sliding.velocity(x, beta, e)
    squares = [
        np.sum((w - np.maximum(-tried_slope * x, slip)) ** 2) for tried_slope in TRIAL_SLOPES
    ]
    slope, previous = float(TRIAL_SLOPES[np.argmin(squares)]), np.nan
    # The slope decides which impacts lie above the line of slip, and these decide the slope.
    while slope != previous:
        first, previous = -slope * x > slip, slope
        slope = -float(np.sum(w[first] * x[first]) / np.sum(x[first] ** 2))
    return slope
