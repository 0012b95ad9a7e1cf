"""Every model keeps the one convention, and what its entry says of it."""

from functools import partial
from pathlib import Path

import numpy as np
import pytest

from planarimpact import InputError, Rebound, Regime, continuum, lumped, models, spheres
from planarimpact.common.losses import LOSSES
from planarimpact.spheres import table
from tests.reference_solutions import table_files

COARSE = {
    "continuum": {"tolerance": 1e-3},
    "continuum.viscous": {"tolerance": 1e-2},
    "continuum.plastic": {"tolerance": 1e-2},
}
MODELS = list(models.MODELS.values())
# Incidence from which a model slides throughout, (1 + e) m2/m1 less what compliance holds. That of
# lumped and continuum is held with their other laws.
SLIDES_FROM = {
    "rigid": lambda beta, zeta2, e: (1 + e) * beta,
    "laws.smith": lambda beta, zeta2, e: (1 + e) * beta,
    "laws.brach": lambda beta, zeta2, e: (1 + e) * beta / 1.4,
    "spheres.viscous": partial(continuum.slip_throughout_limit, loss="viscous"),
    "spheres.plastic": lambda beta, zeta2, e: (
        zeta2 * table.of_one(table.shipped(), 0.0, beta / zeta2, e, True)[1]
    ),
}
X = np.array([[0.0, 0.5, 2.0], [3.4, 6.5, 9.0]])

every_model = pytest.mark.parametrize("model", MODELS, ids=lambda model: model.name)


def solve(model, x, *groups):
    return model.rebound(x, *groups, **COARSE.get(model.name, {}))


def admissible(model):
    return [e for e in (0.0, 0.3, 1.0) if model.restitution[0] <= e]


@every_model
def test_arguments_and_results_keep_the_convention(model):
    groups = 3.0, 1.3, 1.0
    result = solve(model, X, *groups)
    assert isinstance(result, Rebound) and result.regime.dtype == np.uint8
    assert {np.shape(field) for field in result[:4]} == {X.shape}
    assert solve(model, X[:, :1], np.array([3.0, 3.5, 4.0]), 1.3, 1.0).velocity.shape == (2, 3)
    assert solve(model, np.zeros((0, 2)), *groups).velocity.shape == (0, 2)
    alone = solve(model, 2.0, *groups)
    assert isinstance(alone.velocity, float) and isinstance(alone.regime, Regime)
    assert alone.reversals is None or isinstance(alone.reversals, int)
    assert alone.velocity == pytest.approx(result.velocity[0, 2], abs=1e-12)


@every_model
def test_the_mirror_image_only_turns_the_velocity(model):
    for e in admissible(model):
        right, left = solve(model, X, 3.0, 1.3, e), solve(model, -X, 3.0, 1.3, e)
        np.testing.assert_array_equal(left.velocity, -right.velocity)
        for field in ("peak_friction", "dissipation", "regime"):
            np.testing.assert_array_equal(getattr(left, field), getattr(right, field))
        at_rest = [right[0][0, 0], right[2][0, 0], right.regime[0, 0]]
        assert at_rest == [0, 0, Regime.STICK] and not right.peak_friction[0, 0] > 0


@every_model
def test_the_range_of_restitution_is_enforced(model):
    low, high = model.restitution
    for e in (low, high):
        assert np.isfinite(solve(model, 2.0, 3.0, 1.3, e).velocity)
    for e in (low - 0.1, high + 0.1, float(np.nextafter(high, 2))):
        with pytest.raises(InputError, match=f"restitution = {e!r}: (allowed|below)"):
            solve(model, 2.0, 3.0, 1.3, e)


@pytest.mark.parametrize("name", SLIDES_FROM)
@pytest.mark.parametrize("groups", [(3.5, 1.21), (1.0, 0.4), (8.0, 9.5), (2.7, 2.7)])
def test_it_slides_throughout_from_its_limit_on_and_not_below(name, groups):
    (beta, zeta2), model = groups, models.get(name)
    for e in admissible(model):
        if model.cost == "table" and not spheres.covers(beta, zeta2, e):
            continue
        limit = float(SLIDES_FROM[name](beta, zeta2, e))
        x = np.array([limit, limit * (1 + 1e-12), limit + 1, 1e100])
        result = solve(model, x, beta, zeta2, e)
        np.testing.assert_array_equal(result.velocity, x - (1 + e) * beta)
        assert (result.regime[1:] == Regime.SLIP_THROUGHOUT).all()
        assert (result.peak_friction[1:] == 1).all()
        if e == 1 or name != "spheres.viscous":  # there a dashpot takes a share
            work = (1 + e) * (x / 2 + result.velocity / 2)
            np.testing.assert_allclose(result.dissipation, work, rtol=1e-7)  # at any incidence
        assert solve(model, limit - 1e-6, beta, zeta2, e).regime != Regime.SLIP_THROUGHOUT


def test_a_second_code_has_measured_the_errors_of_every_model():
    """But of the elastic continuum, against which it measures, and of tables of continua."""
    tables = "elastic", "inelastic", "wrong_loss"
    known = {row["model"] for name in tables for row in table_files.read(f"model_errors/{name}")}
    assert known == {model.name for model in MODELS if model.cost != "table"} - {"continuum"}


def test_the_page_of_the_solver_says_what_each_loss_is_and_how_far_off():
    text = (Path(__file__).parents[2] / "src/README.md").read_text(encoding="utf-8")
    rows = [line.split("|")[1].strip() for line in text.splitlines() if line.startswith("|")]
    for loss in LOSSES:
        assert any(row.startswith(f'`"{loss.name}"`') for row in rows), loss.name
        if loss.model == "lumped":
            assert any(row.startswith(f"`lumped`, {loss.name}") for row in rows), loss.name


@pytest.mark.parametrize("x", [0.5, 2.0, 4.0, 9.0])
def test_spread_of_uncertain_inputs_is_that_of_random_ones(x):
    """40 000 random e and mu: their root mean square is known to 0.4 %."""
    rng = np.random.default_rng(1)
    e = np.clip(rng.normal(0.8, 0.02, 40_000), 0, 1)
    ratio = rng.normal(1.0, 0.1, e.size)  # of friction to what it is believed to be
    moved = ratio * lumped.rebound(x / ratio, 3.5, 1.21, e).velocity
    change = moved - lumped.rebound(x, 3.5, 1.21, 0.8).velocity
    found = models.input_spread("lumped.hysteretic", x, 3.5, 1.21, 0.8)
    assert found == pytest.approx(np.sqrt(np.mean(change**2)), rel=0.05)


def test_uncertain_restitution_keeps_to_what_a_model_admits():
    """It does not exceed 1, and the continuum with a loss ends at 0.1."""
    assert models.input_spread("lumped.hysteretic", 8.0) > 0
    assert models.input_spread("continuum.viscous", 8.0, restitution=0.1) > 0


def two_lines(x, mass_ratio, stiffness_ratio, restitution, *, share=0.5):
    return np.maximum(x - (1 + restitution) * mass_ratio, -share * x)


def test_a_law_of_ones_own_is_a_model_like_others():
    own = models.Model("own.two-lines", models.laws.of_velocity(two_lines), {"share": 0.5})
    solved = models.rebound(own, X, restitution=0.8, share=0.2)
    brach = models.rebound("laws.brach", X, restitution=0.8, tangential_restitution=0.2)
    assert np.isnan(solved.peak_friction).all()
    for name in ("velocity", "dissipation", "regime"):
        np.testing.assert_allclose(getattr(solved, name), getattr(brach, name), rtol=1e-13)


def test_no_two_models_share_their_settings():
    settings = [
        model.settings for model in (*MODELS, models.Model("a", len), models.Model("b", len))
    ]
    assert len(set(map(id, settings))) == len(settings)
