"""The limit of negligible tangential compliance (zeta^2 -> 0; Stronge 1994, Eqs 34, 35).

The contact slides until friction has stopped it, and then sticks until separation. In a collinear
configuration it never turns round. These are the light and dotted curves of Figs 5, 7 and 9.
"""

from __future__ import annotations

import numpy as np

from planarimpact.common import checks, sliding
from planarimpact.common.arrays import ArrayLike
from planarimpact.common.results import Rebound, Regime, of_groups


@of_groups
def rebound(
    incidence: ArrayLike,
    mass_ratio: ArrayLike = 3.5,
    stiffness_ratio: ArrayLike = 1.21,
    restitution: ArrayLike = 1.0,
) -> Rebound:
    """State at separation; all arguments broadcast.

    The velocity is max(0, x - (1 + e) beta), the peak of friction that at the halt (Eq. 34) or at
    maximum compression (Eq. 35). The stiffness ratio has no effect: all models have the same
    arguments. Arguments and errors: `planarimpact.lumped`.

    Examples
    --------
    >>> [float(w) for w in rebound([2.0, 8.0]).velocity]
    [0.0, 1.0]
    """
    signed, beta, _, e = checks.impact(incidence, mass_ratio, stiffness_ratio, restitution)
    x, beta, e = (a.reshape(-1) for a in (np.abs(signed), beta, e))
    impulse_to_halt = x / beta
    slides = impulse_to_halt >= 1 + e
    final = np.where(slides, sliding.velocity(x, beta, e), 0.0)
    impulse_at_peak = np.minimum(impulse_to_halt, 1.0)
    peak = np.sqrt(impulse_at_peak * (2 - impulse_at_peak))
    halted_regime = np.where(x > 0, Regime.SLIP_STICK, Regime.STICK)
    regime = np.where(slides, Regime.SLIP_THROUGHOUT, halted_regime).astype(np.uint8)
    return Rebound.of(signed, final, np.minimum(impulse_to_halt, 1 + e), peak, regime)
