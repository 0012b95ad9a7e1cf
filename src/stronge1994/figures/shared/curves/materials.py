"""Groups of bodies of one material."""

from planarimpact import bodies
from planarimpact.bodies import Material


def stiffness_ratio(nu: float) -> float:
    """zeta^2 of two bodies of one material, by its Poisson's ratio.

    >>> round(stiffness_ratio(0.3), 4)
    1.2143
    """
    return float(bodies.stiffness_ratio(Material(1.0, nu)))
