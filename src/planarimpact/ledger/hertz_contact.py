"""A Hertz contact that sticks and slips as a whole: the elastic continuum without micro-slip.

It separates what the law of normal compliance does from what micro-slip does. Tangential
stiffness goes with the radius of contact (Mindlin); where the contact shrinks, the part that
leaves it takes its share of the force along.
"""

from typing import NamedTuple

import numpy as np

from planarimpact import hertz

STEPS = 4000


class HertzRebound(NamedTuple):
    """State at separation, arrays; units as in `planarimpact.Rebound`."""

    velocity: np.ndarray
    peak_friction: np.ndarray


def rebound(incidence, mass_ratio, stiffness_ratio):
    """Velocity at separation and peak friction, e = 1; fixed steps, good to 1e-3.

    Parameters
    ----------
    incidence : ndarray, shape (n,)
        v1(0)/(mu v2(0)) >= 0.
    mass_ratio, stiffness_ratio : float
        beta and zeta^2.

    Returns
    -------
    HertzRebound

    Examples
    --------
    >>> velocity, peak = rebound(np.array([8.0]), 3.5, 1.21)
    >>> round(float(velocity[0]), 3), round(float(peak[0]), 3)
    (1.0, 1.0)
    """
    phase = np.linspace(0, np.pi, STEPS + 1)
    elapsed = hertz.pace((phase[1:] + phase[:-1]) / 2) * np.diff(phase)
    radius = np.sin(phase)
    w, force = np.array(incidence, dtype=float), np.zeros(len(incidence))
    peak = np.zeros(len(incidence))
    for step, before, after in zip(elapsed, radius, radius[1:], strict=False):
        limit = hertz.PEAK_FORCE * after**3
        # Fully sheared stiffness 2 a/zeta^2 over that of the normal force, d N/d(depth) = 2 a.
        rate = hertz.PEAK_FORCE * 1.5 * (before + after) / 2 / stiffness_ratio
        force = force * min(1.0, after / before if before else 1.0)
        force = np.clip(force + rate * step * w, -limit, limit)
        w = w - mass_ratio * force * step
        peak = np.maximum(peak, np.abs(force))
    return HertzRebound(w, peak / hertz.PEAK_FORCE)
