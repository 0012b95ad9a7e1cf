"""Beyond the paper: a rubber sphere that bounces off granite, six models beside 13 impacts.

The quantity that is judged is e_t = -w/x of each impact: the tangential velocity of the contact
point after the impact over that before it, with the sign reversed.
"""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from planarimpact.ground.arrays import Array
from stronge1994.csv_tables import Columns, Curves
from stronge1994.curve_names import EACH, SIGNS, name, shifted
from stronge1994.figures.shared.curves import lossy
from stronge1994.figures.shared.curves.lossy import MODELS
from stronge1994.figures.shared.curves.sampling import vertices

ELASTIC = "continuum"  # without loss, whatever the restitution
# Impacts that are stated singly in the text of a paper, with their own parameters in source.yaml.
STATED = {"Cross 2010": "2010", "Cross 2002": "2002"}
X, E_T, ANGLE = "incidence [mu v2(0)]", "tangential_restitution [1]", "angle [deg]"
LIMIT = "incidence_limit [mu v2(0)]"
# e_t by one half of the measurement alone, and the columns of distances from e_t by each.
ALONE = "velocity alone", "spin alone"
RMS = "rms_distance [1]", "rms_from_velocity [1]", "rms_from_spin [1]"
IMPACT, BALL = f"{EACH}impact's parameters", f"{EACH}ball's parameters"

# Incidences, and the restitution of each.
_Impacts = tuple[Array, Array]


def curves(
    ball: Mapping[str, float],
    points: Mapping[str, Sequence[Any]],
    restitution: float,
    incidence: Sequence[float],
    samples: int,
    sticking: float,
    tolerance: float,
    uncertainty: Mapping[str, float] | None = None,
) -> Curves:
    """What each model says of the impacts, of the stated ones, and of every incidence at one e.

    `points` has the columns of data/cross2014/impacts.csv, `ball` parameters of its source. For
    each of `MODELS` there are `<model>, impacts`, `<model>, stated`, `<model>, e = ...` and
    `<model>, rms`: root mean square distances from e_t over the impacts with an incidence up to a
    limit, `sticking` and the end of the range. The elastic continuum has no stated impacts. Two
    more curves, `ALONE`, have what each half of the measurement says of e_t. With `uncertainty`,
    one sigma of the parameters, come the curves named by `curve_names.shifted`: friction moves all
    impacts together, while angle and restitution are each impact's own.

    >>> ball = {"mass_ratio": 3.5, "stiffness_ratio": 1.5, "friction": 0.4}
    >>> for year in ("2010", "2002"):
    ...     ball |= {f"angle_{year}": 25.0, f"restitution_{year}": 0.8, f"friction_{year}": 0.5}
    >>> points = {"impact": ["impact 1"], "angle": [27.0], "tangential_restitution": [0.66],
    ...           "restitution": [0.9], "tangential_before": [0.45], "velocity_ratio": [0.51],
    ...           "spin_change": [0.44]}
    >>> named = curves(ball, points, 0.9, (0.2, 8), 11, 2.5, 1e-3)
    >>> round(float(named["lumped.hysteretic, impacts"]["tangential_restitution [1]"][0]), 2)
    0.43
    """
    x, (at, e) = vertices(incidence, samples), _measured(ball, points)
    groups = {
        "impacts": (at, e),
        "stated": _stated(ball),
        "line": (x, np.full_like(x, restitution)),
    }
    if uncertainty:
        groups |= _off(ball, points, uncertainty)
    labels: Columns = {"impact": np.array(points["impact"]), ANGLE: np.array(points["angle"])}
    years = STATED.values()
    balls: Columns = {"ball": np.array(list(STATED))}
    balls |= {ANGLE: np.array([ball[f"angle_{year}"] for year in years])}
    alone = halves(points, ball["mass_ratio"])
    measured = np.array(points["tangential_restitution"], float), *alone
    named: Curves = {key: {X: at, E_T: e_t} for key, e_t in zip(ALONE, alone, strict=True)}
    limits = np.array([sticking, incidence[1]])
    if limits.min() < at.min():
        raise ValueError(
            f"sticking = {sticking:g}, incidence to {incidence[1]:g}: allowed are limits from "
            f"{at.min():g}, the smallest incidence of an impact"
        )
    for model in (*MODELS, ELASTIC):
        own = groups
        if model == ELASTIC:
            own = {
                key: (groups[key][0], np.ones_like(groups[key][0])) for key in ("impacts", "line")
            }
        solved = _solved(model, own, ball, tolerance)
        e_of_line = own["line"][1][0]
        named[f"{model}, impacts"] = {X: at, E_T: solved["impacts"]}
        named[f"{model}, {name('e', e_of_line)}"] = {X: x, E_T: solved["line"]}
        squares = np.square(solved["impacts"] - measured)
        means = np.array([squares[:, at <= limit].mean(axis=1) for limit in limits])
        named[f"{model}, rms"] = {LIMIT: limits} | dict(zip(RMS, np.sqrt(means).T, strict=True))
        if model != ELASTIC:  # only compared curves need labels
            named[f"{model}, impacts"] |= labels
            named[f"{model}, stated"] = balls | {X: groups["stated"][0], E_T: solved["stated"]}
        if uncertainty and model != ELASTIC:
            named |= _shifted(f"{model}, impacts", labels, solved)
            named |= _own_shifts(f"{model}, stated", BALL, balls, solved, "stated")
    return named


def halves(points: Mapping[str, Sequence[Any]], mass_ratio: float) -> tuple[Array, Array]:
    """e_t that follows from the change of the centre's velocity alone, and of the spin alone.

    The impulse of friction changes the velocity of the contact point `mass_ratio` times as much as
    that of the centre; the spin has the rest. `points` has the columns that `curves` needs.

    >>> points = {"angle": [45.0], "tangential_before": [1.0], "velocity_ratio": [0.5],
    ...           "spin_change": [0.5]}
    >>> velocity, spin = halves(points, 3.5)
    >>> round(float(velocity[0]), 2), round(float(spin[0]), 2)
    (0.75, -0.01)
    """
    angle, before, ratio, spin = (
        np.array(points[key], float)
        for key in ("angle", "tangential_before", "velocity_ratio", "spin_change")
    )
    angle = np.radians(angle)
    # Both over the normal velocity before the impact, as `before` is.
    of_velocity = (1 - ratio) * np.tan(angle)
    of_spin = spin / np.cos(angle) / (mass_ratio - 1)
    return mass_ratio * of_velocity / before - 1, mass_ratio * of_spin / before - 1


def _measured(ball: Mapping[str, float], points: Mapping[str, Sequence[Any]]) -> _Impacts:
    before = np.array(points["tangential_before"], float)
    return before / ball["friction"], np.array(points["restitution"], float)


def _stated(ball: Mapping[str, float]) -> _Impacts:
    """Incidences and restitutions of the stated impacts, which have no spin before."""
    angle, friction, e = (
        np.array([ball[f"{key}_{year}"] for year in STATED.values()])
        for key in ("angle", "friction", "restitution")
    )
    return np.tan(np.radians(angle)) / friction, e


def _off(
    ball: Mapping[str, float],
    points: Mapping[str, Sequence[Any]],
    uncertainty: Mapping[str, float],
) -> dict[str, _Impacts]:
    """Impacts with one parameter off by its sigma; a restitution is lowered, some are almost 1."""
    groups = {}
    for sign in SIGNS:
        friction = ball["friction"] + sign * uncertainty["friction"]
        groups[f"friction {sign}"] = _measured({**ball, "friction": friction}, points)
    at, e = _measured(ball, points)
    before = np.array(points["tangential_before_uncertainty"], float)
    groups["impacts, incidence"] = at + before / ball["friction"], e
    groups["impacts, restitution"] = at, e - np.array(points["restitution_uncertainty"], float)
    for key in ("angle", "friction", "restitution"):
        own = [f"{key}_{year}" for year in STATED.values()]
        lowered = {one: ball[one] - uncertainty[one] for one in own}
        groups[f"stated, {key}"] = _stated({**ball, **lowered})
    return groups


def _solved(
    model: str, groups: Mapping[str, _Impacts], ball: Mapping[str, float], tolerance: float
) -> dict[str, Array]:
    """e_t of several groups of impacts, which are solved together."""
    x, e = (np.concatenate(parts) for parts in zip(*groups.values(), strict=True))
    w = lossy.velocity(model, tolerance, x, ball["mass_ratio"], ball["stiffness_ratio"], e)
    ends = np.cumsum([len(at) for at, _ in groups.values()])[:-1]
    return dict(zip(groups, np.split(-w / x, ends), strict=True))


def _shifted(curve: str, labels: Columns, solved: Mapping[str, Array]) -> Curves:
    """The impacts with the common friction off by its sigma, and with each impact's own sigma."""
    friction = {
        shifted(curve, "friction", sign): labels | {E_T: solved[f"friction {sign}"]}
        for sign in SIGNS
    }
    return friction | _own_shifts(curve, IMPACT, labels, solved, "impacts")


def _own_shifts(
    curve: str, parameter: str, labels: Columns, solved: Mapping[str, Array], group: str
) -> Curves:
    """e_t plus and minus its standard deviation from parameters that are each impact's own."""
    off = [solved[key] for key in solved if key.startswith(f"{group}, ")]
    return lossy.each_off(curve, parameter, labels, E_T, solved[group], off)
