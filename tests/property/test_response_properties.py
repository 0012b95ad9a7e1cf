"""Compiled responses: the lumped model over its whole box of parameters, and others."""

import warnings

import numpy as np
from hypothesis import example, given, settings
from hypothesis import strategies as st

from planarimpact import ConvergenceError, lumped, models, response, spheres

SEED = st.integers(0, 2**32 - 1)
MASS_RATIO = st.floats(1.0, 8.0)
STIFFNESS_RATIO = st.floats(-1.0, 1.0).map(lambda power: 10.0**power)
RESTITUTION = st.one_of(
    st.sampled_from([0.0, 1.0, 1e-300]),
    st.floats(0.0, 1.0),
    st.floats(-12, 0).map(lambda p: 10.0**p),
)
GROUPS = st.tuples(MASS_RATIO, STIFFNESS_RATIO, RESTITUTION)

TOLERANCE, LARGEST = 1e-10, 20.0
ROUNDING = 1e-14  # of x - (1 + e) beta and of the model
NEAR = 1e-10  # of a change of regime
# Each compiles a response and asks it some four hundred times.
FEWER = settings(max_examples=settings.default.max_examples // 2)
SEARCHED = (
    "rigid",
    "laws.smith",
    "lumped.hysteretic",
    "lumped.unloading-stiffness",
    "lumped.viscous",
)
STEPPED = ("timestep.linear", "timestep.mindlin", "timestep.mindlin_rescaled")


def compiled(groups, tolerance=TOLERANCE):
    names = "mass_ratio", "stiffness_ratio", "restitution"
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        return response.compile(
            "lumped.hysteretic",
            incidence_max=LARGEST,
            tolerance=tolerance,
            **dict(zip(names, groups, strict=True)),
        )


def incidences(groups, seed):
    """Random ones of either sign, most where it does not slide, and tiny ones."""
    limit = float(lumped.slip_throughout_limit(*groups))
    rng = np.random.default_rng(seed)
    some = [rng.uniform(0, min(limit, LARGEST), 300), rng.uniform(0, LARGEST, 50)]
    x = np.concatenate([*some, 10 ** rng.uniform(-12, 0, 30)])
    return x * rng.choice([-1.0, 1.0], x.size)


def thresholds(groups):
    """Every threshold of the model with the numbers next to it."""
    beta, zeta2, e = groups
    limit = float(lumped.slip_throughout_limit(*groups))
    places = np.array([zeta2, beta, limit, (1 + e) * beta])
    x = np.concatenate([places, np.nextafter(places, 0), np.nextafter(places, 99)])
    return x[x <= LARGEST]


def assert_within_the_bound(found, x, groups):
    result, exact = found(x), lumped.rebound(x, *groups)
    for field, bound in found.error_bound._asdict().items():
        error = np.abs(getattr(result, field) - getattr(exact, field))
        allowed = bound + ROUNDING * np.maximum(1, np.abs(x))
        assert (error <= allowed).all(), (field, x[error.argmax()], error.max(), bound)
    np.testing.assert_array_equal(found.velocity(x), result.velocity)


@FEWER
@given(GROUPS, SEED)
def test_the_error_bound_holds_everywhere(groups, seed):
    found = compiled(groups)
    assert max(found.error_bound) <= TOLERANCE
    assert_within_the_bound(found, incidences(groups, seed), groups)
    assert_within_the_bound(found, thresholds(groups), groups)
    pieces = found._piecewise.pieces  # where one polynomial follows another
    starts = pieces.start[1:]
    assert_within_the_bound(found, np.concatenate([starts, np.nextafter(starts, 0)]), groups)


def errors(found, x):
    """Of velocity and peak friction, in units of what is allowed."""
    result, exact = found(x), models.rebound(found.model, x, **found.parameters)
    rows = []
    for field, bound in found.error_bound._asdict().items():
        error = np.abs(getattr(result, field) - getattr(exact, field))
        rows.append(np.nan_to_num(error / (bound + ROUNDING * found.pieces.end)))
    return np.stack(rows)


def largest_errors(found):
    """Found by climbing from the largest of many, edges of pieces among them."""
    ends = np.append(found.pieces.start, found.pieces.end)
    inside = (ends[:-1, None] + np.diff(ends)[:, None] * np.linspace(0, 1, 43)).ravel()
    x = np.concatenate([inside, np.nextafter(ends, 0), np.nextafter(ends, 99)])
    x = np.sort(x[x <= ends[-1]])
    error = errors(found, x)
    for row, most in enumerate(error.max(axis=1)):
        top = np.argsort(error[row])[-8:]
        best, step = x[top], (x[np.minimum(top + 1, x.size - 1)] - x[np.maximum(top - 1, 0)]) / 2
        for _ in range(9):
            near = np.clip(best + step * np.linspace(-1, 1, 9)[:, None], 0, ends[-1])
            height = errors(found, near.ravel())[row].reshape(near.shape)
            best = near[height.argmax(axis=0), np.arange(top.size)]
            step, most = step / 3, max(most, height.max())
        yield most


@settings(max_examples=settings.default.max_examples // 8)
@given(
    st.sampled_from(SEARCHED) | st.sampled_from(STEPPED),
    GROUPS,
    st.floats(-8, -1).map(lambda power: 10.0**power),
    st.floats(-0.3, 1.7).map(lambda power: 10.0**power),
)
@example(
    "lumped.hysteretic",
    (3.0605651918961225, 0.06721472096141552, 0.7855824770710292),
    3.156e-3,
    45.1,
)
@example(
    "lumped.unloading-stiffness",
    (4.612480098835151, 0.0584104979584844, 0.62348975),
    1.6348e-3,
    8.43,
)
@example("timestep.linear", (4.39633682, 5.69764727, 0.96165719), 4.204e-3, 1.79383465)
def test_no_search_finds_a_larger_error_than_was_measured(model, groups, tolerance, largest):
    """Nor a piece without a width, or a velocity that gains energy beside the start of a piece."""
    beta, zeta2, e = groups
    steps = {"steps": 16} if model in STEPPED else {}
    try:
        found = response.compile(
            model,
            incidence_max=largest,
            tolerance=max(tolerance, 1e-4) if steps else tolerance,
            mass_ratio=beta,
            stiffness_ratio=zeta2,
            restitution=max(e, models.get(model).restitution[0]),
            **steps,
        )
    except ConvergenceError as refused:
        assert "is not compiled: it is too rough" in str(refused) or "was fitted to" in str(refused)
        return
    assert max(largest_errors(found)) <= 1
    ends = np.append(found.pieces.start, found.pieces.end)
    assert (np.diff(ends) >= 32 * np.spacing(ends[1:])).all()
    x = np.concatenate([ends, np.nextafter(ends, 0), np.nextafter(ends, 99)])
    x = x[x <= ends[-1]]
    most = np.inf if found.gains else x
    assert (np.abs(found.velocity(x)) <= most).all()


@FEWER
@given(GROUPS, SEED)
def test_the_regime_is_that_of_the_model_or_a_neighbour(groups, seed):
    found, x = compiled(groups), incidences(groups, seed)
    wrong = x[found(x).regime != lumped.rebound(x, *groups).regime]
    assert wrong.size <= 1
    for one in np.abs(wrong):
        near = np.abs(one + NEAR * np.linspace(-1, 1, 2001))
        assert found(one).regime in lumped.rebound(near, *groups).regime, one


@FEWER
@given(GROUPS, SEED, st.sampled_from([1e-10, 1e-3, 1e-1]))
def test_friction_never_creates_energy(groups, seed, tolerance):
    """However coarse the response."""
    found = compiled(groups, tolerance)
    x = np.concatenate([incidences(groups, seed), thresholds(groups)])
    result = found(x)
    assert (np.abs(result.velocity) <= np.abs(x)).all()
    assert (result.dissipation >= 0).all()
    assert ((result.peak_friction >= 0) & (result.peak_friction <= 1)).all()


def test_a_table_of_spheres_compiles_without_jumps(tmp_path):
    """Pieces of zero width answered 1e51 where the table jumped from cell to cell."""
    rng = np.random.default_rng(4)
    found = ("plastic", 3.5, 17 / 14, 0.5)
    random = np.stack([rng.choice([2.5, 3.5], 6), rng.uniform(1, 1.5, 6), rng.uniform(0.3, 1, 6)]).T
    cases = [found, *(("plastic", *groups) for groups in random if spheres.covers(*groups))]
    just_below_sliding = ("viscous", 3.5, 1.21, 1.0), ("viscous", 1.728126446, 1.022016098, 1.0)
    for loss, beta, zeta2, e in [*cases, *just_below_sliding, ("viscous", 3.5, 1.2, 0.9)]:
        groups = {"mass_ratio": beta, "stiffness_ratio": zeta2, "restitution": e}
        tolerance = 3e-4 if loss == "plastic" else 1e-4
        made = response.compile(f"spheres.{loss}", incidence_max=20, tolerance=tolerance, **groups)
        start = made.pieces.start
        assert (np.diff(start) > 0).all()
        x = np.concatenate(
            [start, np.nextafter(start, 9), np.nextafter(start[1:], 0), [0.50323744]]
        )
        exact = spheres.rebound(x, beta, zeta2, e, loss=loss).velocity
        np.testing.assert_allclose(made.velocity(x), exact, rtol=0, atol=tolerance)
        assert (np.abs(made.velocity(x)) <= x).all()
        assert max(largest_errors(made)) <= 1
    made.save(tmp_path / "ball.json")
    assert response.load(tmp_path / "ball.json").velocity(2.0) == made.velocity(2.0)
