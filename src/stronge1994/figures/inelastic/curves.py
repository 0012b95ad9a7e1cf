"""Beyond the paper: restitution below 1, five models of loss beside measured pairs of materials.

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
from planarimpact.ground import sliding
from planarimpact.ground.arrays import Array, ArrayLike
from stronge1994.csv_tables import Columns, Curves
from stronge1994.curve_names import EACH, name
from stronge1994.figures.shared.curves import lossy
from stronge1994.figures.shared.curves import materials as of_material
from stronge1994.figures.shared.curves.lossy import MODELS
from stronge1994.figures.shared.curves.sampling import vertices

# Slopes from which the fit starts. Friction never accelerates the body, so |w| is at most x.
TRIAL_SLOPES = np.linspace(-1.0, 1.0, 201)
# Number of impacts in a fit, so large that beta_0 does not depend on it.
FIT_SIZE = 2000
E, BETA_0 = "restitution [1]", "tangential_restitution [1]"
PARAMETERS = f"{EACH}pair's parameters"


class Spread(NamedTuple):
    """Incidences of the impacts to which beta_0 is fitted.

    They reach from 0 to `reach` times (1 + e) beta, or to an `angle` in degrees, and are spread
    evenly over incidence or, with `by_angle`, over the angle of incidence.
    """

    reach: float = 1.0
    angle: float | None = None
    by_angle: bool = False


WHOLE = "to (1 + e) m2/m1"
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
    materials: Mapping[str, Sequence[Any]],
    restitution: Sequence[float],
    poisson_ratio: Sequence[float],
    contact: Mapping[str, float],
    incidence: Sequence[float],
    samples: int,
    solved: int,
    tolerance: float,
    uncertainty: Mapping[str, Sequence[float]] | None = None,
) -> Curves:
    """What each model says of the measured pairs, of every restitution, and of every incidence.

    `points` has the columns of data/cornell1999/pairs.csv; the moduli of `materials` are in Pa. For
    each of `MODELS` there are `<model>, pairs`; `<model>, pairs, <spread>` for all other `SPREADS`;
    `<model>, nu = ...` for both edges of the band; and `<model>, e = ...`. With `uncertainty`, one
    sigma of the materials' properties, there are also `<model>, pairs; each pair's parameters +- 1
    sigma`: beta_0 with the standard deviation that it has from restitution, friction and moduli,
    which are each pair's own. A smooth curve joins `solved` incidences of each contact.

    >>> pairs = {"pair": ["glass"], "body": ["glass"], "other": ["glass"], "restitution": [0.97],
    ...          "friction": [0.1]}
    >>> glass = {"material": ["glass"], "young_modulus": [7e10], "poisson_ratio": [0.2]}
    >>> named = curves(3.5, pairs, glass, [0.8, 1.0], [0.2, 0.5], {"restitution": 0.6,
    ...                "poisson_ratio": 0.3}, (0, 8), 11, 24, 1e-3)
    >>> round(float(named["lumped.hysteretic, pairs"]["tangential_restitution [1]"][0]), 2)
    0.37
    """
    pairs = _Contacts.of_pairs(points, materials)
    bands = [_Contacts.of_band(restitution, nu) for nu in poisson_ratio]
    # Each parameter is lowered by its sigma, because e cannot exceed 1.
    lowered = [] if uncertainty is None else pairs.lowered(points, materials, uncertainty)
    zeta2 = of_material.stiffness_ratio(contact["poisson_ratio"])
    x = vertices(incidence, samples)
    named: Curves = {}
    for model in MODELS:
        solve = partial(lossy.velocity, model, tolerance)
        fitted = _fitted(solve, mass_ratio, [pairs, *bands, *lowered], solved)
        labels = {key: np.array(points[key]) for key in ("pair", "body", "other")}
        own: Columns = labels | {E: pairs.restitution}
        for spread, (beta_0, *others) in fitted.items():
            title = f"{model}, pairs" + (f", {spread}" if spread != WHOLE else "")
            named[title] = own | {BETA_0: beta_0}
            if lowered:
                off = others[-len(lowered) :]
                named |= lossy.each_off(title, PARAMETERS, own, BETA_0, beta_0, off)
        for nu, band, beta_0 in zip(poisson_ratio, bands, fitted[WHOLE][1:], strict=False):
            named[f"{model}, {name('nu', nu)}"] = {E: band.restitution, BETA_0: beta_0}
        named[f"{model}, {name('e', contact['restitution'])}"] = {
            "incidence [mu v2(0)]": x,
            "velocity [mu v2(0)]": solve(x, mass_ratio, zeta2, contact["restitution"]),
        }
    return named


class _Contacts(NamedTuple):
    """Several contacts. Friction turns angles into incidences; a band has none."""

    stiffness_ratio: Array
    restitution: Array
    friction: Array

    @classmethod
    def of_band(cls, restitution: Sequence[float], nu: float) -> "_Contacts":
        e = np.array(restitution, float)
        return cls(np.full_like(e, of_material.stiffness_ratio(nu)), e, np.full_like(e, np.nan))

    @classmethod
    def of_pairs(
        cls, points: Mapping[str, Sequence[Any]], materials: Mapping[str, Sequence[Any]]
    ) -> "_Contacts":
        known = {
            material: Material(young, nu)
            for material, young, nu in zip(
                *(materials[key] for key in ("material", "young_modulus", "poisson_ratio")),
                strict=True,
            )
        }
        couples = zip(points["body"], points["other"], strict=True)
        ratios = [
            bodies.stiffness_ratio(known[_key(body)], known[_key(other)]) for body, other in couples
        ]
        e, friction = (np.array(points[key], float) for key in ("restitution", "friction"))
        return cls(np.array(ratios, float), e, friction)

    def lowered(
        self,
        points: Mapping[str, Sequence[Any]],
        materials: Mapping[str, Sequence[Any]],
        uncertainty: Mapping[str, Sequence[float]],
    ) -> list["_Contacts"]:
        """The same pairs with one group lowered by its sigma: e, mu, zeta^2."""
        changes = []
        for key, sigmas in uncertainty.items():
            for place, sigma in enumerate(sigmas):
                other = list(materials[key])
                other[place] += sigma
                changed = _Contacts.of_pairs(points, {**materials, key: other})
                changes.append(changed.stiffness_ratio - self.stiffness_ratio)
        sigma = np.sqrt(np.sum(np.square(changes), axis=0))
        e, friction = (np.array(points[f"{key}_uncertainty"]) for key in self._fields[1:])
        return [
            self._replace(restitution=self.restitution - e),
            self._replace(friction=self.friction - friction),
            self._replace(stiffness_ratio=self.stiffness_ratio - sigma),
        ]


def _key(material: str) -> str:
    """Name of a material as parameters of source.yaml have it."""
    return material.lower().replace(" ", "_").replace("-", "_")


def _fitted(
    solve: Callable[..., Array], beta: float, groups: Sequence[_Contacts], solved: int
) -> dict[str, list[Array]]:
    """beta_0 of several groups of contacts by spread; all are solved together, up to `FARTHEST`."""
    whole = _Contacts(*map(np.concatenate, zip(*groups, strict=True)))
    e = whole.restitution
    ends = sliding.change(np.full_like(e, beta), e)
    x = LARGEST_REACH * ends[:, None] * np.linspace(0.0, 1.0, solved)
    # Contacts that differ by friction alone have the same rebounds.
    groups_of_rebound = np.stack([whole.stiffness_ratio, e], axis=1)
    _, first, same = np.unique(groups_of_rebound, axis=0, return_index=True, return_inverse=True)
    w = solve(x[first], beta, whole.stiffness_ratio[first, None], e[first, None])[same.ravel()]
    splits = np.cumsum([len(group.restitution) for group in groups])[:-1]
    beta_0 = {spread: np.full(len(ends), np.nan) for spread in SPREADS}
    for i, end in enumerate(ends):
        rebound, friction = CubicSpline(x[i], w[i]), float(whole.friction[i])
        for spread_name, spread in SPREADS.items():
            if spread_name == WHOLE or not np.isnan(friction):
                at = _impacts(end, friction, spread)
                beta_0[spread_name][i] = tangential_restitution(at, rebound(at), beta, float(e[i]))
    return {spread_name: np.split(values, splits) for spread_name, values in beta_0.items()}


def _impacts(end: float, friction: float, spread: Spread) -> Array:
    """Incidences of the impacts of one fit, up to `FARTHEST` times the end of the sliding line."""
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
