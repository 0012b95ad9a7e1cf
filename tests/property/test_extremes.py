"""All models at the ends of the rule of sizes: possible answers or clear refusals, never NaN.

pytest turns warnings into errors. Each model has a range of its own, in its docstring.
"""

from itertools import product

import numpy as np
import pytest

from planarimpact import ConvergenceError, InputError, lumped, models

# How far the error of steps may create energy.
GAINS = {"timestep.linear": 0.03, "timestep.mindlin": 0.06}
MASS_RATIOS = [1.0, 3.5, 1e12]
STIFFNESS_RATIOS = [1e-12, 1e-8, 1.21, 1e12]
RESTITUTIONS = [0.0, 1e-12, 1e-3, 0.5, np.nextafter(1, 0), 1.0]


def incidences(beta, zeta2, e):
    """Tiny, huge, and each threshold with its neighbours."""
    limit = float(lumped.slip_throughout_limit(beta, zeta2, e))
    at = np.array([zeta2, beta, limit, (1 + e) * beta])
    x = np.concatenate([at, np.nextafter(at, 0), np.nextafter(at, np.inf), at / 2])
    return np.sort(np.append(x, [0.0, 5e-324, 1e-100, 1.0, 1e12, 1e100]))


@pytest.mark.parametrize("name", models.MODELS)
def test_answers_are_possible_and_refusals_clear(name):
    model, answered = models.get(name), 0
    for beta, zeta2, e in product(MASS_RATIOS, STIFFNESS_RATIOS, RESTITUTIONS):
        x = incidences(beta, zeta2, e)
        coarse = {"tolerance": 0.1 * np.maximum(1.0, x)} if name.startswith("continuum") else {}
        try:
            result = model.rebound(x, beta, zeta2, e, **coarse)
        except (InputError, ConvergenceError) as error:
            words = str(error)
            assert " = " in words and any(w in words for w in ("allowed", "below 1", "steps"))
            assert len(words) < 300
            continue
        answered += 1
        gain = GAINS.get(name, 0.0)
        assert (np.abs(result.velocity) <= x * (1 + gain + 1e-14)).all()
        assert np.isfinite(result.dissipation).all()
        slack = coarse.get("tolerance", 0.0) * (e < 1)
        assert gain or (result.dissipation >= -slack).all()
        peak = result.peak_friction[~np.isnan(result.peak_friction)]
        assert ((peak >= 0) & (peak <= 1)).all()
    assert answered


@pytest.mark.parametrize("name", [name for name in models.MODELS if "timestep" in name])
def test_a_tiny_impact_scales_a_small_one(name):
    """It sticks to the last step, so that everything is in proportion to the incidence."""
    law = models.get(name).rebound
    for beta, zeta2 in ((3.5, 1.21), (1e12, 1e12), (1.0, 1e12)):
        small = law(zeta2 * 1e-90, beta, zeta2)
        for x in (zeta2 * 1e-101, zeta2 * 1e-110, min(1e-12, zeta2 * 1e-120)):
            tiny = law(x, beta, zeta2)
            share = x / (zeta2 * 1e-90)
            for found, wanted in zip(tiny[:2], small[:2], strict=False):
                assert found == pytest.approx(wanted * share, rel=1e-12, abs=1e-322)
