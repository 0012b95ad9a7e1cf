"""Contact laws of discrete-element codes, in equal steps over the exact duration, plainly.

Units: the largest depth of an elastic contact, v2(0) and m2. Force is P d^power; its work
P/(power + 1) is the energy 1/2. Velocities are half a step ahead of positions.
"""

import math

import numpy as np

# Exponent of force by depth; whether friction shrinks with the radius of contact.
LAWS = {"linear": (1.0, False), "mindlin": (1.5, False), "mindlin_rescaled": (1.5, True)}


def rebound(law, x, beta, zeta2, e, steps):
    """Velocities, peak frictions, and whether slip was seen in one direction alone."""
    power, rescales = LAWS[law]
    peak_force = (power + 1) / 2
    # To greatest compression: the integral of dd/sqrt(1 - d^(power + 1)).
    share = 1 / (power + 1)
    duration = share * math.gamma(share) * math.gamma(0.5) / math.gamma(share + 0.5)
    step = (1 + e) * duration / steps
    approach, depth, deepest, radius = 1.0, 0.0, 0.0, 0.0
    w, friction, largest = x.copy(), np.zeros(x.size), np.zeros(x.size)
    one_way = np.ones(x.size, bool)
    while True:
        depth += step * approach
        deepest = max(deepest, depth)
        # Below the deepest point force follows a curve that is steeper by 1/e^2.
        elastic = deepest - (deepest - depth) / e**2
        if elastic <= 0:
            # Few steps may overshoot the largest force; the share is defined to be at most 1.
            return w, np.minimum(largest / peak_force, 1.0), one_way
        before, radius = radius, elastic ** (power - 1)
        force = peak_force * elastic**power
        if rescales and radius < before:
            friction = friction * radius / before
        stiffness = peak_force * power * radius / zeta2
        friction = friction + step * stiffness * w
        one_way &= friction > force
        friction = np.clip(friction, -force, force)
        largest = np.maximum(largest, np.abs(friction))
        approach -= step * force
        w = w - step * beta * friction
