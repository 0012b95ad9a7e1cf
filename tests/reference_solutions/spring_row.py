"""The elastic continuum as a divided row of springs, in small equal steps of time.

The method of dimensionality reduction as published (Popov & Hess), without any of the package's
code: springs at given radii, each with its own deflection, cut back to its own friction at every
step. Hertz's normal motion is a closed form; the tangential one is a leapfrog.
"""

import math
from typing import NamedTuple

import numpy as np
from scipy.special import betaincinv

# From first contact to greatest compression, in d_max/v2(0): (2/5) B(2/5, 1/2).
TO_MAXIMUM = 0.4 * math.gamma(0.4) * math.gamma(0.5) / math.gamma(0.9)


class Course(NamedTuple):
    """Arrays of shape (instants, impacts): friction in mu F2max, velocity in mu v2(0)."""

    friction: np.ndarray
    velocity: np.ndarray
    stick_radius: np.ndarray  # in a_max


def contact_radius(time):
    """Radius of a Hertz contact in a_max at a time in t_c, by the inverse incomplete beta function.

    With y = d^(5/2) = a^5 the energy v^2 = 1 - y gives t = (2/5) B(2/5, 1/2; y).
    """
    return betaincinv(0.4, 0.5, np.minimum(time, 2 - np.asarray(time))) ** 0.2


def course(x, beta, zeta2, instants, springs, steps):
    """Friction, velocity and radius of stick at some ascending instants, in t_c.

    Springs are counted over the largest contact, steps over the whole of it.
    """
    wanted = np.round(np.asarray(instants) * steps / 2).astype(int)
    if not np.allclose(wanted * 2 / steps, instants, rtol=0, atol=1e-12):
        raise ValueError("an instant is not that of a step")
    radius = (np.arange(springs) + 0.5) / springs
    area = radius**2
    depth = contact_radius(np.arange(steps + 1) * 2 / steps) ** 2
    step = 2 * TO_MAXIMUM / steps
    velocity = np.asarray(x, float).copy()  # half a step ahead; no force yet slows it
    deflection = np.zeros((len(velocity), springs))
    found = []
    for n in range(1, wanted[-1] + 1):
        limit = np.maximum(depth[n] - area, 0.0)
        # Deflections in zeta^2 mu d_max, so that the largest normal density is 1 in the middle.
        deflection += (step / zeta2 * velocity)[:, None]
        if n in wanted:
            slips = (np.abs(deflection) > limit) & (limit > 0)
        np.clip(deflection, -limit, limit, out=deflection)
        friction = 1.5 * deflection.mean(axis=1)  # 1 where all springs carry their most at d = 1
        kick = beta * 1.25 * step / 2 * friction  # F2max = (5/4) m2 v2(0)^2/d_max
        if n in wanted:
            edge = math.sqrt(depth[n])
            inside = np.where(slips.any(axis=1), radius[slips.argmax(axis=1)], edge)
            inside = np.where(inside == radius[0], 0.0, inside)  # gross slip
            found.append((friction, velocity - kick, inside))
        velocity = velocity - 2 * kick
    return Course(*(np.array(part) for part in zip(*found, strict=True)))
