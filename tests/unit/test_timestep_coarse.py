"""Laws in coarse time steps against the leapfrog that they are, written plainly."""

import math

import numpy as np
import pytest

from planarimpact import Regime, models
from planarimpact.ground import checks

NAMES = ["linear", "mindlin", "mindlin_rescaled"]
LINEAR, MINDLIN, RESCALED = LAWS = [models.get(f"timestep.{name}").rebound for name in NAMES]
BETA = 3.5
# Time to maximum compression of a Hertz contact, in d_max/v2(0): (2/5) B(2/5, 1/2).
HERTZ = 0.4 * math.gamma(0.4) * math.gamma(0.5) / math.gamma(0.9)


def leapfrog(law, x, beta, zeta2, e, steps):
    """Velocity, and whether slip was seen in one direction alone."""
    hertzian = law is not LINEAR
    step = (1 + e) * (HERTZ if hertzian else math.pi / 2) / steps
    depth = deepest = radius = friction = 0.0
    approach, w, one_way = 1.0, x, True
    while True:
        depth += step * approach
        deepest = max(deepest, depth)
        elastic = deepest - (deepest - depth) / e**2
        if elastic <= 0:
            return w, one_way
        before, radius = radius, math.sqrt(elastic) if hertzian else 1.0
        normal = 1.25 * elastic**1.5 if hertzian else elastic
        if law is RESCALED and radius < before:
            friction *= radius / before
        friction += step * (1.875 if hertzian else 1.0) * radius * w / zeta2
        one_way &= friction > normal
        friction = math.copysign(min(abs(friction), normal), friction)
        approach -= step * normal
        w -= step * beta * friction


def softest(law, steps, e):
    """Least zeta^2 for which so many steps are allowed, and a little more."""
    with pytest.raises(checks.InputError) as refused:
        law(1.0, BETA, 1e-4, e, steps=3)
    least = int(str(refused.value).split("integers from ")[1].split()[0])
    return 1e-4 * (least / steps) ** 2 * 1.01


def edges(law, zeta2, e, steps):
    """Incidences where slip in one direction begins to be all there is, by bisection."""
    x = np.linspace(1e-3, 2.5 * BETA, 160)
    slides = [leapfrog(law, a, BETA, zeta2, e, steps)[1] for a in x]
    for i in np.flatnonzero(np.diff(slides)):
        low, high = x[i], x[i + 1]
        for _ in range(40):
            middle = (low + high) / 2
            if leapfrog(law, middle, BETA, zeta2, e, steps)[1] == slides[i]:
                low = middle
            else:
                high = middle
        x = np.append(x, low + np.array([-1e-3, -1e-6, -1e-12, 1e-12, 1e-6, 1e-3]))
    return x


@pytest.mark.parametrize("e", [1.0, 0.6])
@pytest.mark.parametrize("steps", [3, 4, 5, 8, 96])
@pytest.mark.parametrize("law", LAWS, ids=NAMES)
def test_coarse_steps_are_the_leapfrog(law, steps, e):
    stiff = softest(law, steps, e)
    for zeta2 in (stiff, 2 * stiff) if steps == 96 else (stiff, max(stiff, 1.21)):
        x = edges(law, zeta2, e, steps)
        w, one_way = np.transpose([leapfrog(law, a, BETA, zeta2, e, steps) for a in x])
        found = law(x, BETA, zeta2, e, steps=steps)
        # Many stiff steps make a rounding grow with every stick; to take one regime for another
        # costs a velocity of the order of beta.
        np.testing.assert_allclose(found.velocity, w, atol=1e-3 if steps == 96 else 1e-9)
        np.testing.assert_array_equal(found.regime == Regime.SLIP_THROUGHOUT, one_way == 1)
