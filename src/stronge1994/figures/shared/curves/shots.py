"""A free sphere without spin, shot at a plane under many angles, and what is measured of it."""

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np

from planarimpact import lumped
from planarimpact.ground import sliding
from planarimpact.ground.arrays import Array, ArrayLike
from planarimpact.ground.results import Rebound
from stronge1994 import curve_names
from stronge1994.csv_tables import Columns
from stronge1994.figures.shared.curves.sampling import vertices

# Curves with a parameter off by one sigma serve only for its effect. They have this many times
# fewer vertices.
COARSER = 4


class Shots(NamedTuple):
    """Shots of a sphere, given by its parameters, under angles [deg] from the normal."""

    sphere: Mapping[str, float]
    angle: Array

    @property
    def x(self) -> Array:
        """Incidences."""
        return np.tan(np.radians(self.angle)) / self.sphere["friction"]


def groups(parameters: Mapping[str, float]) -> tuple[float, float, float]:
    """Mass ratio, stiffness ratio and restitution of an experiment."""
    return (
        parameters["mass_ratio"],
        parameters["stiffness_ratio"],
        parameters["restitution"],
    )


def shots(
    name: str,
    samples: int,
    nodes: ArrayLike,
    sphere: Mapping[str, float],
    uncertainty: Mapping[str, float],
) -> dict[str, Shots]:
    """Shots by the name of their curve, with the uncertain parameters each off by one sigma.

    A restitution above 1 counts as 1.

    >>> sphere = {"mass_ratio": 3.5, "stiffness_ratio": 1.2, "restitution": 0.9, "friction": 0.1}
    >>> list(shots("ball", 9, (), sphere, {"friction": 0.01}))
    ['ball', 'ball; friction + 1 sigma', 'ball; friction - 1 sigma']
    """
    named = {name: _shots(samples, nodes, sphere)}
    for parameter, sigma in uncertainty.items():
        for sign in curve_names.SIGNS:
            changed = {**sphere, parameter: sphere[parameter] + sign * sigma}
            changed["restitution"] = min(changed["restitution"], 1.0)
            shifted = curve_names.shifted(name, parameter, sign)
            named[shifted] = _shots(samples // COARSER, (), changed)
    return named


def _shots(samples: int, nodes: ArrayLike, sphere: Mapping[str, float]) -> Shots:
    beta, zeta2, e = (np.array(group) for group in groups(sphere))
    alike = sliding.limit_alike(beta, zeta2, e)
    limits = [zeta2, beta, lumped.slip_throughout_limit(*groups(sphere)), alike]
    thresholds = np.degrees(np.arctan(sphere["friction"] * np.array(limits)))
    # The ratio of velocities has no value at normal incidence.
    return Shots(sphere, vertices((0.01, 89.9), samples, thresholds, nodes))


def measured(shots: Shots, rebound: Rebound) -> Columns:
    """What is measured of a sphere against its angle of incidence; spin only with its speed."""
    sphere, x = shots.sphere, shots.x
    beta, friction, restitution = (sphere[key] for key in ("mass_ratio", "friction", "restitution"))
    change = x - rebound.velocity
    centre = 1 - change / (beta * x)
    columns = {
        "incidence [mu v2(0)]": x,
        "velocity [mu v2(0)]": rebound.velocity,
        "angle [deg]": shots.angle,
        "centre_restitution [1]": centre,
    }
    if "speed" in sphere:
        unit = friction * sphere["speed"] * np.cos(np.radians(shots.angle))
        columns["spin [rad/s]"] = (beta - 1) / beta * change * unit / sphere["radius"]
    return columns | {
        "centre_rebound_angle [deg]": np.degrees(np.arctan(centre * friction * x / restitution)),
        "contact_rebound_angle [deg]": np.degrees(
            np.arctan(friction * rebound.velocity / restitution)
        ),
    }
