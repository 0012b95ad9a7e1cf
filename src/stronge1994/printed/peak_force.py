"""Equations 28 to 35: the largest forces, over m2 Omega S(0)."""

import numpy as np

from planarimpact.common.arrays import Array, Numbers


def eq_28_normal(slope: Numbers) -> Array:
    """Eq. 28: F2max/(m2 Omega S), from slope = v1(0)/v2(0).

    >>> float(eq_28_normal(0.75))
    0.8
    """
    return (1 + np.square(slope)) ** -0.5


def eq_29_friction(v1: Numbers, m1: Numbers, tangential_frequency: Numbers) -> Numbers:
    """Eq. 29: F1max = -omega m1 v1(0) of initial stick.

    >>> eq_29_friction(-2.0, 0.5, 3.0)
    3.0
    """
    return -tangential_frequency * m1 * v1


def eq_30_friction(slope: Numbers, mass_ratio: Numbers, stiffness_ratio: Numbers) -> Array:
    """Eq. 30: F1max/(m2 Omega S) of initial stick.

    >>> round(float(eq_30_friction(0.75, 4.0, 1.0)), 12)
    0.3
    """
    return np.sqrt(1 / (stiffness_ratio * mass_ratio)) * slope * eq_28_normal(slope)


def eq_31_friction(
    elapsed: Numbers,
    stretch: Numbers,
    velocity: Numbers,
    slope: Numbers,
    friction: Numbers,
    stiffness_ratio: Numbers,
    frequency_ratio: Numbers,
) -> Array:
    """Eq. 31: F1/(m2 Omega S) in the stick that begins at t2; `elapsed` is Omega (t - t2).

    `stretch` and `velocity` are the two values of Eq. 32, `frequency_ratio` omega/Omega.

    >>> float(eq_31_friction(0.0, 1.0, 0.0, 0.0, 0.5, 1.0, 1.7))
    0.5
    """
    angle = frequency_ratio * elapsed
    swing = velocity / frequency_ratio * np.sin(angle)
    return friction / stiffness_ratio * eq_28_normal(slope) * (stretch * np.cos(angle) + swing)


def eq_32_start(
    angle: Numbers, incidence: Numbers, mass_ratio: Numbers, stiffness_ratio: Numbers
) -> tuple[Array, Array]:
    """Eq. 32: Omega u1(t2)/(mu v2(0)) and v1(t2)/(mu v2(0)), from angle = Omega t2.

    >>> [float(value) for value in eq_32_start(0.0, 2.0, 3.5, 1.21)]
    [0.0, 2.0]
    """
    return stiffness_ratio * np.sin(angle), incidence - mass_ratio * (1 - np.cos(angle))


def eq_33_friction(slope: Numbers, friction: Numbers) -> Array:
    """Eq. 33: F1max/(m2 Omega S) of slip throughout.

    >>> float(eq_33_friction(0.75, 0.5))
    0.4
    """
    return friction * eq_28_normal(slope)


def eq_34_friction(slope: Numbers, friction: Numbers, mass_ratio: Numbers) -> Array:
    """Eq. 34: F1max/(m2 Omega S) without tangential compliance, where slip halts in compression.

    >>> float(eq_34_friction(0.0, 0.5, 3.5))
    0.0
    """
    return friction * np.sin(np.arccos(1 - slope / (friction * mass_ratio))) * eq_28_normal(slope)


def eq_35_friction(slope: Numbers, friction: Numbers) -> Array:
    """Eq. 35: the same, where it still slides at maximum compression.

    >>> float(eq_35_friction(0.75, 0.5))
    0.4
    """
    return friction * eq_28_normal(slope)
