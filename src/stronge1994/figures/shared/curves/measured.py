"""Models of what is measured of a free sphere without spin, shot at a plane.

A figure of measured series needs no other curves.py, see workflow/your_model_your_data.md.
"""

from collections.abc import Mapping, Sequence

import numpy as np

from planarimpact import lumped
from planarimpact.common import sliding
from planarimpact.common.arrays import Array, ArrayLike
from stronge1994 import tables
from stronge1994.figures.shared.curves import curves_below_one
from stronge1994.figures.shared.curves.sampling import vertices
from stronge1994.tables import Table

# Curves with a parameter off by one sigma serve only for its effect. They have this many times
# fewer vertices.
COARSER = 4
X, W = "incidence [mu v2(0)]", "velocity [mu v2(0)]"


def curves(
    experiment: Mapping[str, float],
    models: Sequence[str],
    samples: int,
    tolerance: float,
    uncertainty: Mapping[str, float] | None = None,
) -> Table:
    """A curve of each model, with the parameters of an experiment; see `shots`.

    >>> sphere = {"mass_ratio": 3.5, "stiffness_ratio": 1.2, "restitution": 0.9, "friction": 0.1}
    >>> float(curves(sphere, ["rigid"], 9, 1e-3)["tangential_restitution [1]"].iloc[0])
    -0.0
    """
    settings = experiment, uncertainty or {}, samples, tolerance
    table = tables.join(own for model in models for own in shots(model, "", *settings))
    return table.assign(**{"tangential_restitution [1]": -table[W] / table[X]})


def groups(parameters: Mapping[str, float]) -> tuple[float, float, float]:
    """Mass ratio, stiffness ratio and restitution of an experiment."""
    return parameters["mass_ratio"], parameters["stiffness_ratio"], parameters["restitution"]


def shots(
    model: str,
    variant: str,
    sphere: Mapping[str, float],
    uncertainty: Mapping[str, float],
    samples: int,
    tolerance: float,
    nodes: ArrayLike = (),
) -> list[Table]:
    """What is measured of a sphere, by one model, and with each uncertain parameter off by a sigma.

    The angles from the normal reach from 0 to 90 deg; `nodes` are further ones. A restitution above
    1 counts as 1. `tolerance` is that of a continuum.

    >>> sphere = {"mass_ratio": 3.5, "stiffness_ratio": 1.2, "restitution": 0.9, "friction": 0.1}
    >>> for own in shots("rigid", "ball", sphere, {"friction": 0.01}, 9, 1e-3):
    ...     print(own["curve"].iloc[0])
    rigid, ball
    rigid, ball, friction +1 sigma
    rigid, ball, friction -1 sigma
    """
    parts = [tables.curve(_measured(model, sphere, samples, tolerance, nodes), model, variant)]
    for parameter, sigma in uncertainty.items():
        for sign in (1, -1):
            changed = {**sphere, parameter: sphere[parameter] + sign * sigma}
            changed["restitution"] = min(changed["restitution"], 1.0)
            columns = _measured(model, changed, samples // COARSER, tolerance, ())
            parts.append(tables.curve(columns, model, variant, shifted=parameter, sigmas=sign))
    return parts


def _measured(
    model: str, sphere: Mapping[str, float], samples: int, tolerance: float, nodes: ArrayLike
) -> dict[str, Array]:
    """Quantities against the angle of incidence; spin only if the sphere has a speed."""
    beta, zeta2, e = groups(sphere)
    friction = sphere["friction"]
    limits = [zeta2, beta, lumped.slip_throughout_limit(beta, zeta2, e)]
    limits.append(sliding.limit_alike(beta, zeta2, e))
    thresholds = np.degrees(np.arctan(friction * np.array(limits)))
    # The ratio of velocities has no value at normal incidence.
    angle = vertices((0.01, 89.9), samples, thresholds, nodes)
    x = np.tan(np.radians(angle)) / friction
    w = curves_below_one.rebound(model, tolerance, x, beta, zeta2, e).velocity
    centre = 1 - (x - w) / (beta * x)
    columns = {X: x, W: w, "angle [deg]": angle, "centre_restitution [1]": centre}
    if "speed" in sphere:
        unit = friction * sphere["speed"] * np.cos(np.radians(angle))
        columns["spin [rad/s]"] = (beta - 1) / beta * (x - w) * unit / sphere["radius"]
    return columns | {
        "centre_rebound_angle [deg]": np.degrees(np.arctan(centre * friction * x / e)),
        "contact_rebound_angle [deg]": np.degrees(np.arctan(friction * w / e)),
    }
