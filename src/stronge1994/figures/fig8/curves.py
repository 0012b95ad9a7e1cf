"""Fig. 8: largest forces in newtons on the pendulum ball of Lewis & Rogers."""

from collections.abc import Sequence

import numpy as np

from planarimpact import bodies, lumped
from stronge1994 import tables
from stronge1994.figures.shared.curves.sampling import NO_NODES, Nodes, vertices
from stronge1994.tables import Table


def curves(
    mass_ratio: float,
    stiffness_ratio: float,
    angle: Sequence[float],
    friction: float,
    speed: float,
    mass: float,
    ball: dict[str, float],
    samples: int,
    nodes: Nodes = NO_NODES,
) -> Table:
    """Peak forces at one speed of incidence.

    The paper states no contact stiffness. Omega is taken so that the peak force at normal incidence
    is Hertz's for this ball and mass; only angles, ratios and shapes test the model. The lowest
    friction of a contact is negative where friction reverses.

    >>> steel = dict(radius=0.0127, young_modulus=207e9, poisson_ratio=0.3)
    >>> table = curves(3.5, 1.21, (0, 90), 0.18, 0.048, 0.101, steel, 91)
    >>> round(tables.select(table, variant="normal")["peak_force [N]"][0])
    94
    """
    metal = bodies.Material(ball["young_modulus"], ball["poisson_ratio"])
    hertz = float(
        bodies.hertz_peak_force(mass, ball["radius"], bodies.effective_modulus(metal, metal), speed)
    )
    limit = lumped.slip_throughout_limit(mass_ratio, stiffness_ratio, 1.0)
    thresholds = np.array([stiffness_ratio, mass_ratio, limit])
    extra = nodes.get("angle", ())
    theta = vertices(angle, samples, np.degrees(np.arctan(friction * thresholds)), extra)
    x = np.tan(np.radians(theta)) / friction
    peak = lumped.rebound(x, mass_ratio, stiffness_ratio).peak_friction
    lowest = [
        lumped.history(value, mass_ratio, stiffness_ratio).friction_force.min() for value in x
    ]
    normal = hertz * np.cos(np.radians(theta))
    largest = {
        "normal": {"angle [deg]": theta, "peak_force [N]": normal},
        "friction": {
            "angle [deg]": theta,
            "peak_force [N]": friction * normal * peak,
            "peak_over_mu_normal [1]": peak,
            "lowest_friction [N]": friction * normal * np.array(lowest),
        },
    }
    return tables.join(tables.curve(own, "lumped", force) for force, own in largest.items())
