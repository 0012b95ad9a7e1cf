"""Normal motion of Hertz contact, elastic and frictionless, by one angle.

The angle `phase` is 0 at contact, pi/2 at maximum compression and pi at separation. Its sine is the
radius of contact. As a function of this angle the motion is smooth, also at both ends of the
contact, where forces vanish like a power of time that is no whole number. All functions take and
return numbers or arrays. Units: radius a_max, approach d_max, velocity |v2(0)|, force its largest
value, time d_max/|v2(0)| except where t_c is named.
"""

from __future__ import annotations

import math

import numpy as np

from planarimpact.common import checks
from planarimpact.common.arrays import Array, ArrayLike

# Largest normal force in m2 v2(0)^2/d_max, as the strain energy (2/5) F2max d_max is all energy.
PEAK_FORCE = 1.25
# Time of compression, in d_max/v: (2/5) B(2/5, 1/2), an integral of Euler's.
COMPRESSION = 0.4 * math.gamma(0.4) * math.gamma(0.5) / math.gamma(0.9)
# The following are in the units of `normal_impact`. Strain energy, in d^(5/2).
ENERGY = 8 / 15
# Largest approach, to the power 5/2.
FULL = 1 / (2 * ENERGY)
LARGEST_FORCE = PEAK_FORCE / FULL**0.4


@checks.default_errors
def velocity(phase: ArrayLike) -> Array:
    """Normal velocity of approach: 1 at contact, -1 at separation.

    Notes
    -----
    Energy gives v^2 = 1 - d^(5/2), d = sin(phase)^2. The factor cos(phase)^2 is taken out, so
    that nothing is lost to rounding at maximum compression.

    Examples
    --------
    >>> [round(float(v), 9) for v in velocity([0.0, np.pi / 2, np.pi])]
    [1.0, 0.0, -1.0]
    """
    return state(phase)[2]


@checks.default_errors
def state(phase: ArrayLike) -> tuple[Array, Array, Array]:
    """Radius of contact, time for a unit of phase dt/dphase, and `velocity` at once.

    Examples
    --------
    >>> [round(float(a), 9) for a in state(np.pi / 2)]  # the pace is 2 sqrt(2/5)
    [1.0, 1.264911064, 0.0]
    """
    phase = checks.real("phase", phase)
    radius = np.sin(phase)
    slowness = _slowness(radius)
    return radius, 2 * radius * slowness, np.cos(phase) / slowness


def _slowness(radius: Array) -> Array:
    """cos(phase)/v, by the factors that 1 - a^2 and 1 - a^5 share."""
    return np.sqrt((1 + radius) / (1 + radius * (1 + radius * (1 + radius * (1 + radius)))))


@checks.default_errors
def phase_at(velocity: ArrayLike) -> Array:
    """Phase at a normal velocity from 1 to -1, the inverse of `velocity`.

    Examples
    --------
    >>> round(float(phase_at(velocity(2.0))), 12)
    2.0
    """
    v = checks.real("velocity", velocity)
    with np.errstate(divide="ignore"):  # log of 0 at both ends of the contact
        log = np.log1p(-v * v)
    cosine = np.copysign(np.sqrt(-np.expm1(0.4 * log)), v)
    return np.arctan2(np.exp(0.2 * log), cosine)


@checks.default_errors
def time(phase: ArrayLike) -> Array:
    """Time t/t_c: 0 at contact, 1 at maximum compression, 2 at separation.

    Examples
    --------
    >>> [round(float(t), 9) for t in time([0.0, np.pi / 2, np.pi])]
    [0.0, 1.0, 2.0]
    """
    from scipy.special import betainc  # here, as it takes longer to import than this package

    phase = checks.real("phase", phase)
    share, v = np.sin(phase) ** 5, velocity(phase)
    # These are two forms of one function. Each is used where it loses no digits.
    to_go = betainc(0.5, 0.4, np.minimum(v * v, 1.0))
    passed = np.where(share < 0.5, betainc(0.4, 0.5, np.clip(share, 0.0, 1.0)), 1 - to_go)
    return np.where(v >= 0, passed, 2 - passed)[()]
