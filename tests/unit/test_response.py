"""Compiled responses against their models; what they refuse; their files."""

import copy
import dataclasses
import pickle

import numpy as np
import pytest

from planarimpact import (
    ConvergenceError,
    InputError,
    Rebound,
    Regime,
    continuum,
    lumped,
    models,
    response,
)

X = np.linspace(-9.5, 9.5, 2003)
FINE, COARSE = 1e-9, 1e-3
CASES = [
    ("rigid", FINE, {}),
    ("rigid", FINE, {"restitution": 0.3, "mass_ratio": 2.7}),
    ("laws.smith", FINE, {"restitution": 0.5}),
    ("laws.brach", FINE, {"tangential_restitution": 0.7}),
    ("lumped.hysteretic", FINE, {}),
    ("lumped.hysteretic", FINE, {"mass_ratio": 8.0, "stiffness_ratio": 0.1}),
    ("lumped.hysteretic", FINE, {"restitution": 0.5}),
    ("lumped.hysteretic", FINE, {"restitution": 0.0}),
    ("timestep.linear", COARSE, {"restitution": 0.5}),
    ("timestep.linear", 1e-6, {"steps": 16}),
    ("timestep.linear", 0.08, {"steps": 16, "mass_ratio": 50.0, "stiffness_ratio": 0.94}),  # gains
    ("timestep.mindlin", COARSE, {}),
    ("timestep.mindlin_rescaled", COARSE, {"stiffness_ratio": 3.0}),
    ("continuum", COARSE, {}),
    ("annuli", 5e-2, {"circles": 4, "steps": 16}),
]
SLIDING = ["rigid", "laws.smith", "laws.brach", "lumped.hysteretic", "continuum"]
NEVER_SLIDING = ["timestep.linear", "timestep.mindlin", "timestep.mindlin_rescaled"]


def compiled(model="lumped.hysteretic", tolerance=COARSE, **parameters):
    return response.compile(model, incidence_max=10, tolerance=tolerance, **parameters)


def assert_same(one, other):
    """Equal to the bit, NaN and all."""
    for a, b in zip(one[:4], other[:4], strict=True):
        np.testing.assert_array_equal(a, b)


@pytest.fixture(scope="module")
def ball():
    return compiled("lumped.hysteretic", 1e-10)


@pytest.mark.parametrize(("model", "tolerance", "parameters"), CASES)
def test_it_agrees_with_its_model_to_the_tolerance(model, tolerance, parameters):
    found = compiled(model, tolerance, **parameters)
    assert max(found.error_bound) <= tolerance == found.tolerance
    result, exact = found(X), models.rebound(model, X, **found.parameters)
    for field in ("velocity", "peak_friction"):
        error = np.abs(getattr(result, field) - getattr(exact, field))
        assert (np.isnan(getattr(exact, field)) == np.isnan(error)).all()
        assert np.nanmax(error, initial=0.0) <= tolerance, field
    work = np.abs(result.dissipation - exact.dissipation)
    speed = np.maximum(np.abs(X), 1)
    assert (work <= speed * tolerance / found.parameters["mass_ratio"] + 1e-13).all()
    assert np.mean(result.regime == exact.regime) > 0.995
    np.testing.assert_array_equal(found.velocity(X), result.velocity)


@pytest.mark.parametrize("restitution", [1.0, 0.5, 0.0])
def test_regimes_are_those_of_the_lumped_model(restitution):
    found = compiled("lumped.hysteretic", 1e-10, restitution=restitution)
    exact = models.rebound("lumped.hysteretic", X, restitution=restitution)
    np.testing.assert_array_equal(found(X).regime, exact.regime)


# At 7.3 some slide throughout only beyond the largest incidence; the continuum, slow there, is left
# out.
@pytest.mark.parametrize(
    ("model", "beta"),
    [(m, b) for m in SLIDING for b in (1.0, 3.5, 7.3) if (m, b) != ("continuum", 7.3)],
)
def test_sliding_is_exact_to_the_bit_for_any_incidence(model, beta):
    e = 1.0 if model == "continuum" else 0.3
    found = compiled(model, 1e-2, mass_ratio=beta, stiffness_ratio=0.9, restitution=e)
    limit = float(models.get(model).sliding_limit(beta, 0.9, e))
    assert (found.incidence_max == np.inf) == (limit <= 10)
    largest = min(found.incidence_max, 1e300)
    x = np.array([limit, np.nextafter(limit, 99), limit + 1, 1e9, 1e300])
    x = x[x <= largest]
    result = found(np.concatenate([x, -x]))
    np.testing.assert_array_equal(result.velocity[: x.size], x - (1 + e) * beta)
    np.testing.assert_array_equal(result.velocity[x.size :], -(x - (1 + e) * beta))
    assert (result.regime == Regime.SLIP_THROUGHOUT).all() and (result.peak_friction == 1).all()
    if x.size:
        below = found(np.nextafter(limit, 0))
        assert below.regime != Regime.SLIP_THROUGHOUT
        assert abs(below.velocity - (limit - (1 + e) * beta)) <= 1e-2


def test_a_smaller_incidence_max_ends_before_it_slides():
    found = response.compile("lumped.hysteretic", incidence_max=2.5, tolerance=COARSE)
    assert found.incidence_max == 2.5
    assert found.velocity(-2.5) == -found.velocity(2.5)
    with pytest.raises(InputError, match="from -2.5 to 2.5"):
        found(np.nextafter(2.5, 3))


def test_the_mirror_image_only_turns_the_velocity(ball):
    right, left = ball(np.abs(X)), ball(-np.abs(X))
    assert_same(right, left._replace(velocity=-left.velocity))


def test_normal_impact_leaves_no_tangential_velocity(ball):
    result = ball(0.0)
    assert result == (0.0, 0.0, 0.0, Regime.STICK, None)
    assert ball(-0.0).velocity == ball(5e-324).peak_friction == 0


def test_scalars_in_scalars_out(ball):
    result = ball(2)
    assert isinstance(result, Rebound)
    assert all(isinstance(number, float) for number in result[:3])
    assert result.regime is Regime.SLIP_STICK_SLIP and result.reversals is None
    assert isinstance(ball.velocity(2.0), float) and np.ndim(ball.velocity(np.array(2.0))) == 0


@pytest.mark.parametrize("shape", [(0,), (0, 2), (1,), (3, 2), (2, 1, 4)])
def test_shapes_are_kept(ball, shape):
    result = ball(np.full(shape, 2.0))
    assert {np.shape(field) for field in result[:4]} == {shape}
    assert result.regime.dtype == np.uint8
    assert ball.velocity(np.full(shape, 2.0)).shape == shape


def test_numbers_of_any_kind_and_layout_will_do(ball):
    whole = np.arange(-8, 9)
    assert_same(ball(whole), ball(whole.astype(float)))
    assert_same(ball(whole.tolist()), ball(whole.astype(float)))
    grid = np.arange(12.0).reshape(3, 4)
    for view in (grid.T, grid[::-1, ::2], whole[::-1], whole.astype(np.float32)):
        np.testing.assert_array_equal(ball.velocity(view), ball.velocity(np.array(view, float)))
        np.testing.assert_array_equal(ball(view).velocity, ball.velocity(view))


def test_the_argument_is_left_alone(ball):
    x = X.copy()
    x.flags.writeable = False
    ball(x), ball.velocity(x)
    np.testing.assert_array_equal(x, X)


def test_batches_do_not_depend_on_their_size(ball):
    x = np.linspace(-9, 9, 2 * response.CHUNK + 3)
    whole = ball(x)
    assert_same([field[::977] for field in whole[:4]], ball(x[::977]))
    assert [ball.velocity(v) for v in x[::3001]] == whole.velocity[::3001].tolist()


def test_it_is_deterministic(ball):
    assert_same(compiled("lumped.hysteretic", 1e-10)(X), ball(X))


@pytest.mark.parametrize(
    "again", [lambda ball: pickle.loads(pickle.dumps(ball)), copy.copy, copy.deepcopy]
)
def test_it_is_pickled_and_copied(ball, again):
    assert_same(again(ball)(X), ball(X))
    assert repr(again(ball)) == repr(ball) and "lumped.hysteretic" in repr(ball)
    assert again(ball).parameters == ball.parameters


def test_nothing_of_it_can_be_changed(ball):
    with pytest.raises(TypeError):
        ball.parameters["mass_ratio"] = 2.0
    for name in ("tolerance", "error_bound", "pieces", "parameters", "another"):
        with pytest.raises(AttributeError):
            setattr(ball, name, 1.0)
    for made in (ball, copy.deepcopy(ball)):
        for array in made.pieces[:-1]:
            with pytest.raises(ValueError, match="read-only"):
                array[...] = 0


@pytest.mark.parametrize(
    "change", [{"model": "rigid"}, {"tolerance": 1e-12}, {"parameters": {"mass_ratio": 2.0}}, {}]
)
def test_it_is_not_replaced_by_one_that_nobody_measured(ball, change):
    with pytest.raises(InputError, match="response of .*: allowed are those that `compile` or"):
        dataclasses.replace(ball, **change)


def test_laws_of_impulses_know_a_peak_in_sliding_alone():
    found = compiled("laws.smith", restitution=0.5)
    result = found([0.0, 2.0, 5.24, 5.25, -9.0])
    np.testing.assert_array_equal(result.peak_friction, [np.nan] * 3 + [1.0, 1.0])
    names = ["STICK", "UNRESOLVED", "UNRESOLVED", "SLIP_THROUGHOUT", "SLIP_THROUGHOUT"]
    assert [Regime(code).name for code in result.regime] == names


@pytest.mark.parametrize("model", NEVER_SLIDING)
def test_an_incidence_beyond_the_largest_is_refused(model):
    found = compiled(model)
    assert found.incidence_max == 10
    for answer in (found, found.velocity):
        answer([10.0, -10.0])
        for x in (np.nextafter(10, 11), -11.0, [1.0, 1e300]):
            with pytest.raises(InputError, match=r"incidence.* from -10 to 10"):
                answer(x)


@pytest.mark.parametrize(
    ("x", "words"),
    [
        (np.nan, "incidence.* = nan"),
        ([0.0, np.inf], r"incidence\[1\] = inf"),
        ([0.0, 1.0, -np.inf], r"incidence\[2\] = -inf"),
        ("1", "incidence = '1'"),
        (["a", "b"], "incidence = "),
        (True, "incidence = True"),
        (1j, "as real numbers"),
        (None, "incidence = None"),
    ],
)
def test_what_is_no_finite_number_is_named(ball, x, words):
    for answer in (ball, ball.velocity):
        with pytest.raises(InputError, match=words):
            answer(x)


@pytest.mark.parametrize("x", [8e307, np.nextafter(8e307, np.inf), 1.1e308, np.finfo(float).max])
def test_one_rule_for_the_largest_incidence(ball, x):
    """As every model has it, for numbers and arrays, and for both ways to ask."""
    given = [x, -x, [x], np.array([1.0, -x]), np.array(x)]
    for answer in (ball, ball.velocity, lambda x: models.rebound("lumped.hysteretic", x)):
        for one in given:
            if x <= 8e307:
                answer(one)
            else:
                with pytest.raises(InputError, match=r"allowed are .* from -8e307 to 8e307"):
                    answer(one)


def test_a_bad_incidence_late_in_a_batch_is_named(ball):
    x = np.ones(2 * response.CHUNK)
    x[-5] = np.nan
    with pytest.raises(InputError, match=rf"incidence\[{x.size - 5}\] = nan"):
        ball.velocity(x)


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ({"model": "magic"}, "model = 'magic': allowed are rigid, "),
        ({"steps": 64}, "steps = 64: lumped.hysteretic has no settings"),
        ({"model": "continuum", "circles": 4}, "circles = 4: continuum has the settings"),
        ({"tolerance": 0}, "tolerance = 0.0: allowed are numbers from 1e-11 to 1"),
        ({"tolerance": 1e-13}, "tolerance = 1e-13"),
        ({"tolerance": 1.5}, "tolerance = 1.5"),
        ({"tolerance": np.nan}, "tolerance = nan"),
        ({"tolerance": "fine"}, "tolerance = 'fine'"),
        ({"tolerance": [1e-3, 1e-6]}, r"tolerance, shape \(2,\): allowed is one number"),
        ({"incidence_max": 0}, "incidence_max = 0.0: allowed are numbers from 1e-9"),
        ({"incidence_max": -1}, "incidence_max = -1.0"),
        ({"incidence_max": np.inf}, "incidence_max = inf"),
        ({"incidence_max": [9.0]}, r"incidence_max, shape \(1,\)"),
        ({"mass_ratio": [3.5, 2.0]}, r"mass_ratio, shape \(2,\): allowed is one number"),
        ({"stiffness_ratio": np.ones((1, 1))}, r"stiffness_ratio, shape \(1, 1\)"),
        ({"restitution": [1.0]}, r"restitution, shape \(1,\)"),
        ({"mass_ratio": 0.9}, "mass_ratio = 0.9"),
        ({"stiffness_ratio": 0.0}, "stiffness_ratio = 0.0"),
        ({"restitution": 1.1}, "restitution = 1.1"),
        ({"restitution": np.nan}, "restitution = nan"),
        ({"restitution": "1"}, "restitution = '1'"),
        ({"model": "continuum", "restitution": 0.5}, "restitution = 0.5: .* name says"),
        ({"model": "timestep.linear", "steps": 2.5}, "steps = 2.5"),
        ({"model": "laws.brach", "tangential_restitution": 2.0}, "tangential_restitution = 2.0"),
    ],
)
def test_bad_parameters_are_named(arguments, words):
    given = {"model": "lumped.hysteretic", "incidence_max": 10, "tolerance": COARSE} | arguments
    with pytest.raises(InputError, match=words):
        response.compile(given.pop("model"), **given)


def test_the_tolerance_is_given_once():
    """Python refuses the name twice; the model's own follows from it."""
    with pytest.raises(TypeError, match="tolerance"):
        response.compile("continuum", incidence_max=9, tolerance=1e-3, **{"tolerance": 1e-3})
    assert compiled("continuum").parameters["tolerance"] < COARSE


def test_a_wrong_model_does_not_pass(monkeypatch):
    """Noise of 1e-6 is too much for 1e-10, and little enough for 1e-3."""
    rng = np.random.default_rng(5)
    paper = models.MODELS["lumped.hysteretic"]

    def noisy(incidence, *groups):
        result = paper.rebound(incidence, *groups)
        noise = 1e-6 * rng.standard_normal(np.shape(incidence))
        return result._replace(velocity=result.velocity + noise)

    monkeypatch.setitem(models.MODELS, "lumped.hysteretic", paper._replace(rebound=noisy))
    with pytest.raises(ConvergenceError, match="too rough"):
        compiled("lumped.hysteretic", 1e-10)
    assert max(compiled("lumped.hysteretic", 1e-3).error_bound) <= 1e-3


def test_a_model_that_jumps_does_not_pass(monkeypatch):
    paper = models.MODELS["lumped.hysteretic"]

    def jumping(incidence, *groups):
        result = paper.rebound(incidence, *groups)
        return result._replace(velocity=result.velocity + 1e-5 * (np.asarray(incidence) > 2.2))

    monkeypatch.setitem(models.MODELS, "lumped.hysteretic", paper._replace(rebound=jumping))
    with pytest.raises(
        ConvergenceError, match=r"hysteretic is not .* jumps by 1.0e-05 at x = 2.2;"
    ):
        compiled("lumped.hysteretic", 1e-8)


def test_a_velocity_that_is_no_number_is_named(monkeypatch):
    paper = models.MODELS["lumped.hysteretic"]

    def unknown(incidence, *groups):
        result = paper.rebound(incidence, *groups)
        return result._replace(velocity=np.where(incidence > 2.2, np.nan, result.velocity))

    monkeypatch.setitem(models.MODELS, "lumped.hysteretic", paper._replace(rebound=unknown))
    words = "^lumped.hysteretic is not .* at incidence .* is no finite number"
    with pytest.raises(ConvergenceError, match=words):
        compiled("lumped.hysteretic")


def test_a_tolerance_out_of_reach_is_named_with_one_that_is_reached(monkeypatch):
    """The model itself gets a share of it, which nobody asked for."""
    exact = models.MODELS["continuum.viscous"]

    def coarse(incidence, *groups, tolerance):
        if np.size(incidence) and tolerance < 1e-4:
            raise continuum.Unsolved(f"tolerance = {tolerance}: not met", np.array([2]))
        return lumped.rebound(incidence, *groups, loss="viscous")

    monkeypatch.setitem(models.MODELS, exact.name, exact._replace(rebound=coarse))
    words = r"tolerance = 1e-06: .*viscous does not .* = 1.9995; there 0.001 is .* default is 0.003"
    with pytest.raises(ConvergenceError, match=words):
        response.compile(exact.name, tolerance=1e-6, restitution=0.8)
    monkeypatch.setattr(response, "MODEL_SHARE", 1e-9)  # then no tolerance is coarse enough
    with pytest.raises(
        ConvergenceError, match="tolerance = 1e-06: .*viscous is not compiled: not met"
    ):
        response.compile(exact.name, tolerance=1e-6, restitution=0.8)
    words = "tolerance = 1e-08: spheres.viscous is not .* jumps by .* tolerances .* times as large"
    with pytest.raises(ConvergenceError, match=words):
        response.compile("spheres.viscous", tolerance=1e-8)


def test_the_default_tolerance_is_that_of_the_cost():
    assert {model.cost for model in models.MODELS.values()} == set(response.TOLERANCES)
    for model, tolerance in (("rigid", 1e-6), ("spheres.plastic", 1e-3)):
        assert response.compile(model).tolerance == tolerance
    with pytest.raises(InputError, match="model = 'continum': allowed are rigid, .*, continuum,"):
        response.compile("continum")


# Files ------------------------------------------------------------------------------------------


def test_sliding_loses_no_digits_of_dissipation():
    x = np.array([10.0, 1e16, 1e300])
    found, exact = compiled("lumped.hysteretic"), models.rebound("lumped.hysteretic", x)
    np.testing.assert_allclose(found(x).dissipation, exact.dissipation, rtol=1e-15)


@pytest.mark.parametrize("value", [[0.5], None, "b", True])
def test_settings_are_numbers(value):
    with pytest.raises(InputError, match="tangential_restitution"):
        response.compile(
            "laws.brach", incidence_max=8, tolerance=1e-2, tangential_restitution=value
        )


def test_a_refused_incidence_is_named_by_its_place():
    law = response.compile("timestep.linear", incidence_max=8, tolerance=1e-2)
    with pytest.raises(InputError, match=r"incidence = 9.0: allowed are .* from -8 to 8"):
        law(9.0)
    with pytest.raises(InputError, match=r"incidence\[1, 0\] = nan: allowed are finite numbers"):
        compiled("lumped.hysteretic").velocity(np.array([[1.0, 2.0], [np.nan, 4.0]]))


def test_the_bound_has_the_tolerance_of_the_model_in_it():
    found = compiled("continuum")
    assert COARSE * response.MODEL_SHARE < max(found.error_bound) <= COARSE


def test_a_regime_changes_where_that_of_the_model_does():
    groups = {"mass_ratio": 7.0, "stiffness_ratio": 0.2, "restitution": 0.9}
    found = response.compile("lumped.hysteretic", incidence_max=12, tolerance=1e-9, **groups)
    x = np.linspace(0.01, 12, 4000)
    low, high = x[:-1], x[1:]
    codes = models.rebound("lumped.hysteretic", x, **groups).regime
    low, high = low[codes[1:] != codes[:-1]], high[codes[1:] != codes[:-1]]
    first = models.rebound("lumped.hysteretic", low, **groups).regime
    for _ in range(60):
        middle = (low + high) / 2
        same = models.rebound("lumped.hysteretic", middle, **groups).regime == first
        low, high = np.where(same, middle, low), np.where(same, high, middle)
    assert low.size == 5
    for near in (low - 1e-9, high + 1e-9):
        exact = models.rebound("lumped.hysteretic", near, **groups).regime
        assert found(near).regime.tolist() == exact.tolist()
