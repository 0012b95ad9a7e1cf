"""Laws of discrete-element codes: the leapfrog that they are, convergence, limits, energy."""

import math

import numpy as np
import pytest

from planarimpact import InputError, Regime, lumped, models
from planarimpact.models import timestep
from tests.reference_solutions import leapfrog

LAWS = {name: models.get(f"timestep.{name}").rebound for name in leapfrog.LAWS}
BETA, ZETA2 = 3.5, 17 / 14
X = np.linspace(0, 8, 161)

every_law = pytest.mark.parametrize("name", LAWS)


# ---- the leapfrog ----


def softest(name, steps, e):
    """Least zeta^2 for which so many steps are allowed, and a little more."""
    with pytest.raises(InputError) as refused:
        LAWS[name](1.0, BETA, 1e-4, e, steps=3)
    least = int(str(refused.value).split("integers from ")[1].split()[0])
    return 1e-4 * (least / steps) ** 2 * 1.01


def edges(name, zeta2, e, steps):
    """Incidences all over, and beside those where slip begins to be in one direction alone."""
    x = np.linspace(1e-3, 2.5 * BETA, 160)
    slides = leapfrog.rebound(name, x, BETA, zeta2, e, steps)[2]
    changes = np.flatnonzero(np.diff(slides))
    low, high, slides = x[changes], x[changes + 1], slides[changes]
    for _ in range(40):
        middle = (low + high) / 2
        same = leapfrog.rebound(name, middle, BETA, zeta2, e, steps)[2] == slides
        low, high = np.where(same, middle, low), np.where(same, high, middle)
    beside = low + np.array([[-1e-3], [-1e-6], [-1e-12], [1e-12], [1e-6], [1e-3]])
    return np.concatenate([x, beside.ravel()])


@pytest.mark.parametrize("e", [1.0, 0.6, 0.02])
@pytest.mark.parametrize("steps", [3, 4, 5, 8, 96])
@every_law
def test_steps_however_coarse_are_the_leapfrog(name, steps, e):
    stiff = softest(name, steps, e)
    for zeta2 in (stiff, 2 * stiff) if steps == 96 else (stiff, max(stiff, 1.21)):
        x = edges(name, zeta2, e, steps)
        w, peak, one_way = leapfrog.rebound(name, x, BETA, zeta2, e, steps)
        found = LAWS[name](x, BETA, zeta2, e, steps=steps)
        # Many stiff steps make a rounding grow with every stick; to take one regime for another
        # costs a velocity of the order of beta.
        np.testing.assert_allclose(found.velocity, w, atol=1e-3 if steps == 96 else 1e-9)
        np.testing.assert_array_equal(found.regime == Regime.SLIP_THROUGHOUT, one_way)
        if steps < 96:
            np.testing.assert_allclose(found.peak_friction, peak, atol=1e-9)


@every_law
def test_parts_and_shared_normal_motion_change_nothing(name, monkeypatch):
    law = LAWS[name]
    x = np.linspace(0, 8, 9)[:, None]
    e = np.array([0.0, 1e-9, 0.02, 0.5, 1.0])
    whole = law(x, BETA, ZETA2, e)
    monkeypatch.setattr(timestep, "CHUNK", 7)
    for one, parts in zip(whole[:4], law(x, BETA, ZETA2, e)[:4], strict=True):
        assert one.shape == (9, 5)
        np.testing.assert_array_equal(one, parts)
    monkeypatch.undo()
    for column, single in enumerate(e):
        alone = law(x[:, 0], BETA, ZETA2, single)
        np.testing.assert_array_equal(whole.velocity[:, column], alone.velocity)
        np.testing.assert_array_equal(whole.regime[:, column], alone.regime)


# ---- convergence ----


@pytest.mark.parametrize("e", [1.0, 0.5, 0.0])
def test_linear_converges_to_lumped_with_the_square_of_the_steps(e):
    """Events fall between steps by chance: the order shows in the mean over many impacts."""
    exact = lumped.rebound(X, BETA, ZETA2, e, loss="hysteretic")
    found = [LAWS["linear"](X, BETA, ZETA2, e, steps=n) for n in (32, 256, 2048)]
    for part in (X <= 1.2, (X >= 1.25) & (X <= 3.8), X >= 6):
        off = [(one.velocity - exact.velocity)[part] for one in found]
        first, _, last = (np.sqrt(np.mean(one**2)) for one in off)
        assert first < 0.02 and math.log(first / last, 64) > 1.8
    np.testing.assert_allclose(found[-1].peak_friction, exact.peak_friction, atol=1e-4)
    np.testing.assert_allclose(found[-1].dissipation, exact.dissipation, atol=1e-4)
    away = [0, 10, 40, 120, 160]  # from thresholds
    np.testing.assert_array_equal(found[-1].regime[away], exact.regime[away])
    assert LAWS["linear"](0.5, 8.0, 0.1, steps=2048).regime == Regime.MULTIPLE
