"""The paper's way from incidence to rebound, as printed: its formulas in its ranges.

The ranges are those of its headings: initial stick up to zeta^2, slip throughout from
(1 + e) beta, slip - stick - slip between. Where the printed equations have no solution, because
Eq. 21 has no root, the answer is nan. The instants at which slip begins come from the solver
`lumped`, which meets Eqs 10, 21 and 23 (their roots are not in doubt; the ledger tests them).
"""

import numpy as np

from planarimpact import lumped
from planarimpact.common import checks
from planarimpact.common.arrays import Array, ArrayLike, Numbers
from planarimpact.common.results import EventKind
from stronge1994.printed import equations


def rebound(
    incidence: ArrayLike, mass_ratio: float, stiffness_ratio: float, restitution: float
) -> tuple[Array, Array, Array]:
    """Velocity, peak friction and dissipation as printed.

    Parameters
    ----------
    incidence : array_like, shape (n,)
        x = v1(0)/(mu v2(0)) >= 0.
    mass_ratio, stiffness_ratio, restitution : float
        beta, zeta^2 and e. Where omega <= Omega the printed equations do not apply.

    Returns
    -------
    velocity, peak_friction, dissipation : ndarray, shape (n,)
        Units as in `planarimpact.Rebound`; nan where the printed equations have no solution.

    Raises
    ------
    InputError
        If a group is not a finite real number in its range.

    Examples
    --------
    >>> velocity, peak, dissipation = rebound([0.5, 6.0, 8.0], 3.5, 1.21, 1.0)
    >>> [round(float(w), 3) for w in velocity]  # Eq. 21 has no root for 6
    [0.211, nan, 1.0]
    """
    x, *groups = checks.impact(np.ravel(incidence), mass_ratio, stiffness_ratio, restitution)
    beta, zeta2, e = (float(group[0]) for group in groups)
    limit = equations.slip_throughout_limit(beta, e)
    solved = [_solved(abs(value), beta, zeta2, e, limit) for value in x.tolist()]
    velocity, peak, lost = np.array(solved).reshape(-1, 3).T
    return np.copysign(1.0, x) * velocity, peak, lost


def _solved(
    x: float, beta: float, zeta2: float, e: float, limit: Numbers
) -> tuple[Numbers, Numbers, Numbers]:
    """Velocity, peak friction and dissipation of one impact."""
    if x >= limit:
        final = equations.eq_27_rebound(x, beta, e)
        peak = equations.eq_33_friction(0.0, 1.0)
        return final, peak, equations.eq_41_friction(x, beta, 1.0, e) / 2
    instants = _instants(x, beta, zeta2, e) if beta > zeta2 else None
    if instants is None:
        return (np.nan,) * 3
    return (_stick_first if x <= zeta2 else _slip_first)(x, beta, zeta2, e, *instants)


def _instants(x: float, beta: float, zeta2: float, e: float) -> tuple[float, float] | None:
    """Start of stick and of the slip that follows it, in 1/Omega; None where slip never ends."""
    events = lumped.history(x, beta, zeta2, e, samples=2).events
    stick = next((event.time for event in events if event.kind == EventKind.STICK), None)
    if stick is None:
        # A stick that takes no time, at maximum compression, is no event.
        instant = x < lumped.slip_throughout_limit(beta, zeta2, e)
        return (np.pi / 2, np.pi / 2) if instant else None
    slips = [event.time for event in events if event.kind == EventKind.SLIP]
    # The paper has one slip after stick. If there is none, stick lasts to separation.
    after = next((time for time in slips if time > stick), 1 + e)
    return np.pi / 2 * stick, np.pi / 2 * after


def _stick_first(
    x: float, beta: float, zeta2: float, e: float, _: float, t1: float
) -> tuple[Numbers, Numbers, Numbers]:
    """Eqs 12, 15, 30 and 39."""
    omega = np.sqrt(beta / zeta2)
    g1 = equations.impulse_ratio(t1, 1.0, e) if e else 0.0
    final = equations.eq_15_rebound(equations.eq_12_velocity_at_slip(x, omega, t1), g1, beta)
    # For mu = 1 and slope -> 0 of both sides of Eq. 30, the factor of the slope remains.
    peak = x * np.sqrt(1 / (zeta2 * beta))
    return final, peak, equations.eq_39_friction(x, np.cos(omega * t1), g1, beta, 1.0) / 2


def _slip_first(
    x: float, beta: float, zeta2: float, e: float, t2: float, t3: float
) -> tuple[Numbers, Numbers, Numbers]:
    """Eqs 19, 22, 25, 31, 32 and 40."""
    omega = np.sqrt(beta / zeta2)
    late = t2 > np.pi / 2
    w2 = (
        equations.eq_19b_velocity(t2, x, 1.0, 1.0, beta, 1.0, e)
        if late
        else equations.eq_19a_velocity(t2, x, 1.0, 1.0, beta, 1.0)
    )
    normal = equations.table_1_force(t2, -1.0, 1.0, 1.0, e)
    w3 = equations.eq_7b_velocity(t3 - t2, -zeta2 * normal, w2, omega)
    share = equations.table_1_impulse(t3, -1.0, 1.0, 1.0, e)
    final = equations.eq_25_rebound(w3, share, beta, e)
    stretch, velocity = equations.eq_32_start(t2, x, beta, zeta2)
    peak = _largest(stretch, velocity / omega, omega * (t3 - t2)) / zeta2
    return final, peak, equations.eq_40_friction(x, w2, w3, final, beta, 1.0) / 2


def _largest(cosine: Numbers, sine: Numbers, end: float) -> float:
    """Largest |cosine cos(a) + sine sin(a)| for a from 0 to `end`: a crest, or an end."""
    crests = np.arctan2(sine, cosine) + np.pi * np.arange(-1, 3)
    angles = np.array([0.0, end, *crests[(crests > 0) & (crests < end)]])
    return float(np.abs(cosine * np.cos(angles) + sine * np.sin(angles)).max())
