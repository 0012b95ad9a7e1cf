"""The limit of negligible tangential compliance (zeta^2 -> 0; Stronge 1994, Eqs 34, 35).

The contact slides until friction has stopped it and then sticks for good; in a collinear
configuration it never turns round. Light and dotted curves of Figs 5, 7 and 9.
"""

import numpy as np

from planarimpact import checks
from planarimpact.results import Rebound, Regime


def rebound(incidence, mass_ratio=3.5, restitution=1.0):
    """State at separation; all arguments broadcast.

    Parameters
    ----------
    incidence : array_like
        x = v1(0)/(mu v2(0)); any finite number, negative for the mirror image.
    mass_ratio : array_like
        beta = m2/m1 >= 1.
    restitution : array_like
        Energetic coefficient e, 0 to 1.

    Returns
    -------
    Rebound
        The same fields and units as `planarimpact.lumped.rebound`: velocity
        max(0, x - (1 + e) beta), friction at the halt (Eq. 34) or at maximum compression
        (Eq. 35).

    Raises
    ------
    InputError
        If an argument is not a finite real number in its range, or shapes do not broadcast.

    Examples
    --------
    >>> [float(w) for w in rebound([2.0, 8.0]).velocity]
    [0.0, 1.0]
    """
    signed, beta, e = checks.groups(
        incidence=incidence, mass_ratio=mass_ratio, restitution=restitution
    )
    x = np.abs(signed)
    impulse_to_halt = x / beta
    slides = impulse_to_halt >= 1 + e
    final = np.where(slides, x - (1 + e) * beta, 0.0)
    compressed = np.minimum(impulse_to_halt, 1.0)
    peak = np.sqrt(compressed * (2 - compressed))
    dissipation = np.minimum(impulse_to_halt, 1 + e) * (x / 2 + final / 2)
    halted = np.where(x > 0, Regime.SLIP_STICK, Regime.STICK)
    regime = np.where(slides, Regime.SLIP_THROUGHOUT, halted).astype(np.uint8)
    velocity = np.copysign(1.0, signed) * final
    if x.ndim == 0:
        return Rebound(velocity[()], peak[()], dissipation[()], Regime(int(regime)))
    return Rebound(velocity, peak, dissipation, regime)
