"""The other models at the ends of the rule of sizes: right answers or clear refusals, never NaN.

pytest turns warnings into errors. Each model has a box of its own, in its docstring.
"""

import time

import numpy as np
import pandas as pd
import pytest

from planarimpact import ConvergenceError, InputError, continuum, lumped, models, scene
from planarimpact.models import laws

NAMES = ["linear", "mindlin", "mindlin_rescaled"]
LINEAR, MINDLIN, RESCALED = STEPPED = [models.get(f"timestep.{name}").rebound for name in NAMES]
MASS_RATIOS = [1.0, np.nextafter(1, 2), 3.5, 1e6, 1e12]
STIFFNESS_RATIOS = [1e-12, 1e-8, 1.21, 1e12]
RESTITUTIONS = [0.0, 1e-12, 1e-3, 0.5, np.nextafter(1, 0), 1.0]
LONGEST = 30  # s of the processor for one call


def incidences(beta, zeta2, e):
    """Tiny, huge, and each threshold with its neighbours."""
    limit = float(lumped.slip_throughout_limit(beta, zeta2, e))
    at = np.array([zeta2, beta, limit, (1 + e) * beta])
    x = np.concatenate([at, np.nextafter(at, 0), np.nextafter(at, np.inf), at / 2])
    return np.sort(np.append(x, [0.0, 5e-324, 1e-100, 1.0, 1e12, 1e100]))


def box(restitutions):
    for beta in MASS_RATIOS:
        for zeta2 in STIFFNESS_RATIOS:
            for e in restitutions:
                yield incidences(beta, zeta2, e), beta, zeta2, e


def answered(call):
    """What a call returns, or None where it refuses clearly; in time."""
    start = time.process_time()
    try:
        return call()
    except (InputError, ConvergenceError) as error:
        words = str(error)
        assert " = " in words and any(w in words for w in ("allowed", "not met", "rounding"))
        assert len(words) < 300
        return None
    finally:
        assert time.process_time() - start < LONGEST


def assert_possible(result, x, gain=0.0):
    """Finite, and energy from nothing only as far as the error of a model's steps may create it."""
    assert np.isfinite(np.stack([result.velocity, result.dissipation])).all()
    assert (np.abs(result.velocity) <= x * (1 + gain + 1e-14)).all()
    if not gain:
        assert (result.dissipation >= 0).all()
    peak = result.peak_friction[~np.isnan(result.peak_friction)]
    assert ((peak >= 0) & (peak <= 1)).all()


@pytest.mark.parametrize("law", [laws.smith, laws.brach])
def test_laws_of_impulses(law):
    for x, *groups in box(RESTITUTIONS):
        assert_possible(law(x, *groups), x)


@pytest.mark.parametrize(("law", "gain"), [(LINEAR, 0.03), (MINDLIN, 0.06), (RESCALED, 0.0)])
def test_laws_in_steps(law, gain):
    solved = 0
    for x, *groups in box([0.0, 1e-12, 0.5, 1.0]):
        result = answered(lambda x=x, groups=groups: law(x, *groups, steps=64))
        if result is not None:
            solved += 1
            assert_possible(result, x, gain)
    assert solved > 30


@pytest.mark.parametrize("law", STEPPED, ids=NAMES)
def test_a_tiny_impact_scales_a_small_one(law):
    """It sticks to the last step, so that everything is in proportion to the incidence."""
    for beta, zeta2 in ((3.5, 1.21), (1e12, 1e12), (1.0, 1e12)):
        small = law(zeta2 * 1e-90, beta, zeta2)
        for x in (zeta2 * 1e-101, zeta2 * 1e-110, min(1e-12, zeta2 * 1e-120)):
            tiny = law(x, beta, zeta2)
            share = x / (zeta2 * 1e-90)
            for found, wanted in zip(tiny[:2], small[:2], strict=False):
                assert found == pytest.approx(wanted * share, rel=1e-12, abs=1e-322)


@pytest.mark.parametrize("beta", [1.0, 1e12])
@pytest.mark.parametrize("zeta2", [1e-12, 1e-8, 1.21, 1e12])
def test_the_continuum(beta, zeta2):
    limit = float(lumped.slip_throughout_limit(beta, zeta2))
    for x in (5e-324, np.nextafter(limit, 0), limit, limit / 2, 1e100):
        result = answered(
            lambda x=x: continuum.rebound([x], beta, zeta2, tolerance=0.1 * max(1.0, x))
        )
        if result is not None:
            assert_possible(result, np.array([x]))
            if x >= limit:
                assert result.velocity[0] == x - 2 * beta


# Physical scales. A unit that is a power of two changes exponents only. Powers of m, kg and s are
# the columns.

EXPONENTS = [(60, 0, 0), (0, 60, 0), (0, 0, 60), (-60, 60, -60), (60, -60, -60), (-7, 3, 11)]
UNITS = {
    "[m]": (1, 0, 0),
    "[kg]": (0, 1, 0),
    "[Pa]": (-1, 1, -2),
    "[m/s]": (1, 0, -1),
    "[rad/s]": (0, 0, -1),
    "[J]": (2, 1, -2),
    "[N]": (1, 1, -2),
}
ROWS = pd.DataFrame(
    {
        "radius [m]": [0.01, 0.013, 0.02],
        "mass [kg]": [0.03, 0.2, 0.07],
        "gyration [m]": [0.006, 0.009, 0.011],
        "other_radius [m]": [0.02, 0.05, 0.01],
        "other_mass [kg]": [0.05, 1.0, 0.02],
        "other_gyration [m]": [0.013, 0.03, 0.007],
        "young_modulus [Pa]": 207e9,
        "poisson_ratio": 0.3,
        "friction": [0.3, 0.2, 0.6],
        "restitution": [0.8, 0.5, 0.3],
        "loss": ["viscous", "viscous", "plastic"],
        "velocity_tangential [m/s]": [1.0, 7.0, -0.3],
        "velocity_normal [m/s]": [2.0, 1.0, 3.0],
        "spin [rad/s]": [30.0, -5.0, 11.0],
    }
)


def in_units(table, *exponents):
    factors = {unit: 2.0 ** float(np.dot(powers, exponents)) for unit, powers in UNITS.items()}
    units = {name: name.partition(" ")[2] for name in table}
    return table.assign(**{n: table[n] * factors[unit] for n, unit in units.items() if unit})


@pytest.fixture(scope="module")
def solved():
    return scene.solve(ROWS)


@pytest.mark.parametrize("exponents", EXPONENTS)
def test_a_scene_has_no_scale(exponents, solved):
    found, wanted = scene.solve(in_units(ROWS, *exponents)), in_units(solved, *exponents)
    for name in found:
        if "force" in name:  # powers that are no whole numbers
            np.testing.assert_allclose(found[name], wanted[name], rtol=1e-13)
        else:
            assert found[name].tolist() == wanted[name].tolist(), name
