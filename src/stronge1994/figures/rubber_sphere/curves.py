"""Beyond the paper: a rubber sphere that bounces off granite, six models beside 13 impacts.

The quantity that is judged is e_t = -w/x of each impact: the tangential velocity of the contact
point after the impact over that before it, with the sign reversed.
"""

from collections.abc import Mapping, Sequence
from functools import partial
from typing import Any

import numpy as np

from planarimpact.common.arrays import Array, ArrayLike
from stronge1994.csv_tables import Columns, Curves
from stronge1994.curve_names import ELASTIC, MODELS, SIGNS, name, shifted
from stronge1994.figures.shared.curves import beside
from stronge1994.figures.shared.curves.sampling import vertices

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
) -> Curves:
    """What each model says of the impacts, of the stated ones, and of every incidence at one e.

    `points` has the columns of data/cross2014/impacts.csv, `ball` parameters of its source, and
    `uncertainty` one sigma of each. For each of `MODELS` there are `<model>, impacts`, `<model>,
    stated`, `<model>, e = ...` and `<model>, rms`: root mean square distances from e_t over the
    impacts with an incidence up to a limit, `sticking` and the end of the range. The elastic
    continuum has no stated impacts. Two more curves, `ALONE`, have what each half of the
    measurement says of e_t. Beside the impacts come the curves named by `curve_names.shifted`:
    friction moves all impacts together, while angle and restitution are each impact's own.

    >>> ball = {"mass_ratio": 3.5, "stiffness_ratio": 1.5, "friction": 0.4}
    >>> for year in ("2010", "2002"):
    ...     ball |= {f"angle_{year}": 25.0, f"restitution_{year}": 0.8, f"friction_{year}": 0.5}
    >>> points = {"impact": ["impact 1"], "angle": [27.0], "tangential_restitution": [0.66],
    ...           "restitution": [0.9], "restitution_uncertainty": [0.01],
    ...           "tangential_before": [0.45], "tangential_before_uncertainty": [0.01],
    ...           "velocity_ratio": [0.51], "spin_change": [0.44]}
    >>> sigmas = {key: value / 100 for key, value in ball.items()}
    >>> named = curves(ball, points, 0.9, (0.2, 8), 11, 2.5, 1e-3, sigmas)
    >>> round(float(named["lumped.hysteretic, impacts"]["tangential_restitution [1]"][0]), 2)
    0.43
    """
    measured: Columns = {key: np.array(column) for key, column in points.items()}
    before, e = measured["tangential_before"], measured["restitution"]
    before_sigma = measured["tangential_before_uncertainty"]
    friction, x = ball["friction"], vertices(incidence, samples)
    at = before / friction
    # The incidence is raised by its sigma, and a restitution lowered: some are almost 1.
    sigmas = [-before_sigma / friction, measured["restitution_uncertainty"]]
    raised, lowered = beside.each_lowered([at, e], sigmas)
    others = [friction + sign * uncertainty["friction"] for sign in SIGNS]
    impacts = [*raised, *(before / other for other in others)], [*lowered, e, e]
    angle, mu, stated_e = beside.each_lowered(_of_stated(ball), _of_stated(uncertainty))
    stated = np.tan(np.radians(angle)) / mu, stated_e

    alone = halves(measured, ball["mass_ratio"])
    e_t = measured["tangential_restitution"], *alone
    limits = np.array([sticking, incidence[1]])
    labels: Columns = {"impact": measured["impact"], ANGLE: measured["angle"]}
    balls: Columns = {"ball": np.array(list(STATED)), ANGLE: angle[0]}
    named: Curves = {key: {X: at, E_T: half} for key, half in zip(ALONE, alone, strict=True)}
    for model in (*MODELS, ELASTIC):
        solve = partial(_shares, model, tolerance, ball)
        title, e_of_line = f"{model}, impacts", restitution
        if model == ELASTIC:
            e_of_line = 1.0
            named[title] = {E_T: solve(at, e_of_line)}
        else:
            *own, above, below = solve(*impacts)
            named |= beside.with_sigma(title, "impact", labels, E_T, own)
            for sign, off in zip(SIGNS, (above, below), strict=True):
                named[shifted(title, "friction", sign)] = labels | {E_T: off}
            named |= beside.with_sigma(f"{model}, stated", "ball", balls, E_T, solve(*stated))
            named[f"{model}, stated"] |= {X: stated[0][0]}
        named[title] |= {X: at}
        named[f"{model}, {name('e', e_of_line)}"] = {X: x, E_T: solve(x, e_of_line)}
        squares = np.square(named[title][E_T] - e_t)
        means = np.array([squares[:, at <= limit].mean(axis=1) for limit in limits])
        named[f"{model}, rms"] = {LIMIT: limits} | dict(zip(RMS, np.sqrt(means).T, strict=True))
    return named


def _of_stated(known: Mapping[str, float]) -> list[list[float]]:
    """Angle, friction and restitution of the stated impacts, which have no spin before."""
    keys = "angle", "friction", "restitution"
    return [[known[f"{key}_{year}"] for year in STATED.values()] for key in keys]


def _shares(
    model: str, tolerance: float, ball: Mapping[str, float], x: ArrayLike, e: ArrayLike
) -> Array:
    """e_t of impacts with the incidences `x` and restitutions `e`."""
    groups = ball["mass_ratio"], ball["stiffness_ratio"], e
    return -beside.rebound(model, tolerance, x, *groups).velocity / np.asarray(x)


def halves(measured: Columns, mass_ratio: float) -> tuple[Array, Array]:
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
