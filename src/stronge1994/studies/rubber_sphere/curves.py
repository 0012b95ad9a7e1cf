"""Beyond the paper: a rubber sphere that bounces off granite, six models and 13 impacts.

The quantity that is judged is e_t = -w/x of each impact: the tangential velocity of the contact
point after the impact over that before it, with the sign reversed.
"""

from collections.abc import Mapping, Sequence
from functools import partial
from typing import Any

import numpy as np

from planarimpact.common.arrays import Array, ArrayLike
from stronge1994 import tables
from stronge1994.figures.shared.curves import curves_below_one
from stronge1994.figures.shared.curves.sampling import vertices
from stronge1994.names import ELASTIC, MODELS
from stronge1994.tables import Table

# Impacts that are stated singly in the text of a paper, with their own parameters in source.yaml.
STATED = {"Cross 2010": "2010", "Cross 2002": "2002"}
X, E_T, ANGLE = "incidence [mu v2(0)]", "tangential_restitution [1]", "angle [deg]"
LIMIT = "incidence_limit [mu v2(0)]"
# e_t by one half of the measurement alone, and the columns of distances from e_t by each.
ALONE = "velocity alone", "spin alone"
RMS = "rms_distance [1]", "rms_from_velocity [1]", "rms_from_spin [1]"


def curves(
    ball: Mapping[str, float],
    points: Mapping[str, Sequence[Any]],
    restitution: float,
    incidence: Sequence[float],
    samples: int,
    sticking: float,
    tolerance: float,
    uncertainty: Mapping[str, float],
) -> Table:
    """What each model says of the impacts, of the stated ones, and of every incidence at one e.

    `points` has the columns of data/cross2014/impacts.csv, `ball` parameters of its source, and
    `uncertainty` one sigma of each. Each of `MODELS` has the variants `impacts`, `stated` and
    `rms`, and a curve with e at all incidences. `rms` are root mean square distances from e_t over
    the impacts with an incidence up to a limit, `sticking` and the end of the range. The elastic
    continuum has no stated impacts. The model `measured` has what each half of the measurement says
    of e_t, see `ALONE`. Angle and restitution are each impact's own, while friction moves all
    impacts together: so it has curves of its own, up and down by a sigma.

    >>> ball = {"mass_ratio": 3.5, "stiffness_ratio": 1.5, "friction": 0.4}
    >>> for year in ("2010", "2002"):
    ...     ball |= {f"angle_{year}": 25.0, f"restitution_{year}": 0.8, f"friction_{year}": 0.5}
    >>> points = {"impact": ["impact 1"], "angle": [27.0], "tangential_restitution": [0.66],
    ...           "restitution": [0.9], "restitution_uncertainty": [0.01],
    ...           "tangential_before": [0.45], "tangential_before_uncertainty": [0.01],
    ...           "velocity_ratio": [0.51], "spin_change": [0.44]}
    >>> sigmas = {key: value / 100 for key, value in ball.items()}
    >>> table = curves(ball, points, 0.9, (0.2, 8), 11, 2.5, 1e-3, sigmas)
    >>> own = tables.select(table, model="lumped.hysteretic", variant="impacts")
    >>> float(own["tangential_restitution [1]"].round(2)[0])
    0.43
    """
    measured = {key: np.array(column) for key, column in points.items()}
    before, e = measured["tangential_before"], measured["restitution"]
    before_sigma = measured["tangential_before_uncertainty"]
    friction, x = ball["friction"], vertices(incidence, samples)
    at = before / friction
    # The incidence is raised by its sigma, and a restitution lowered: some are almost 1.
    sigmas = [-before_sigma / friction, measured["restitution_uncertainty"]]
    raised, lowered = curves_below_one.each_lowered([at, e], sigmas)
    others = [friction + sign * uncertainty["friction"] for sign in (1, -1)]
    impacts = [*raised, *(before / other for other in others)], [*lowered, e, e]
    angle, mu, stated_e = curves_below_one.each_lowered(_of_stated(ball), _of_stated(uncertainty))
    stated = np.tan(np.radians(angle)) / mu, stated_e

    alone = halves(measured, ball["mass_ratio"])
    e_t = measured["tangential_restitution"], *alone
    limits = np.array([sticking, incidence[1]])
    labels = {"impact": measured["impact"], ANGLE: measured["angle"]}
    balls = {"ball": list(STATED), ANGLE: angle[0], X: stated[0][0]}
    halves_of_e_t = zip(ALONE, alone, strict=True)
    parts = [tables.curve({X: at, E_T: half}, "measured", key) for key, half in halves_of_e_t]
    for model in (*MODELS, ELASTIC):
        solve = partial(_shares, model, tolerance, ball)
        own, e_of_line = {X: at, E_T: solve(at, 1.0)}, 1.0
        if model != ELASTIC:
            *cases, above, below = solve(*impacts)
            own = labels | {X: at} | curves_below_one.with_sigma(E_T, cases)
            e_of_line = restitution
            for sign, off in ((1, above), (-1, below)):
                shift = {"shifted": "friction", "sigmas": sign}
                parts.append(tables.curve(labels | {E_T: off}, model, "impacts", **shift))
            columns = balls | curves_below_one.with_sigma(E_T, solve(*stated))
            parts.append(tables.curve(columns, model, "stated"))
        parts.append(tables.curve(own, model, "impacts"))
        parts.append(tables.curve({X: x, E_T: solve(x, e_of_line)}, model, e=e_of_line))
        squares = np.square(own[E_T] - e_t)
        means = np.array([squares[:, at <= limit].mean(axis=1) for limit in limits])
        columns = {LIMIT: limits} | dict(zip(RMS, np.sqrt(means).T, strict=True))
        parts.append(tables.curve(columns, model, "rms"))
    return tables.join(parts)


def _of_stated(known: Mapping[str, float]) -> list[list[float]]:
    """Angle, friction and restitution of the stated impacts, which have no spin before."""
    keys = "angle", "friction", "restitution"
    return [[known[f"{key}_{year}"] for year in STATED.values()] for key in keys]


def _shares(
    model: str, tolerance: float, ball: Mapping[str, float], x: ArrayLike, e: ArrayLike
) -> Array:
    """e_t of impacts with the incidences `x` and restitutions `e`."""
    groups = ball["mass_ratio"], ball["stiffness_ratio"], e
    return -curves_below_one.rebound(model, tolerance, x, *groups).velocity / np.asarray(x)


def halves(measured: Mapping[str, Any], mass_ratio: float) -> tuple[Array, Array]:
    """e_t that follows from the change of the centre's velocity alone, and of the spin alone.

    The impulse of friction changes the velocity of the contact point `mass_ratio` times as much as
    that of the centre; the spin has the rest. `measured` has columns of data/cross2014/impacts.csv.

    >>> impact = {"angle": 45.0, "tangential_before": 1.0, "velocity_ratio": 0.5}
    >>> impact["spin_change"] = 0.5
    >>> [round(float(half), 2) for half in halves(impact, 3.5)]
    [0.75, -0.01]
    """
    angle, before = np.radians(measured["angle"]), measured["tangential_before"]
    # Both over the normal velocity before the impact, as `before` is.
    of_velocity = (1 - measured["velocity_ratio"]) * np.tan(angle)
    of_spin = measured["spin_change"] / np.cos(angle) / (mass_ratio - 1)
    return mass_ratio * of_velocity / before - 1, mass_ratio * of_spin / before - 1
