"""Identities, limits and refusals of the lumped and the rigid model."""

from pathlib import Path

import numpy as np
import pytest

from planarimpact import ConvergenceError, EventKind, InputError, Regime, lumped, rigid
from planarimpact.lumped import losses, slip_onset, stick_slip
from tests.reference_solutions import high_precision

EXTREMES = Path(__file__).parents[2] / "data/lumped_extremes/impacts.csv"
GROUPS = [(3.5, 1.21, 1.0), (3.5, 1.21, 0.5), (2.5, 1.5, 0.0), (1.0, 10.0, 0.9), (8.0, 0.1, 0.7)]


@pytest.mark.parametrize("groups", GROUPS)
def test_mirror_image_only_turns_the_velocity(groups):
    x = np.linspace(0, 20, 101)
    right, left = lumped.rebound(x, *groups), lumped.rebound(-x, *groups)
    np.testing.assert_array_equal(left.velocity, -right.velocity)
    for field in ("peak_friction", "dissipation", "regime"):
        np.testing.assert_array_equal(getattr(left, field), getattr(right, field))


def test_scalars_in_scalars_out():
    result = lumped.rebound(1.0)
    assert isinstance(result.velocity, float)
    assert result.regime is Regime.STICK_SLIP


def test_arguments_broadcast_in_any_shape():
    result = lumped.rebound(np.ones((3, 1)), restitution=np.full((1, 4), 0.5))
    assert result.velocity.shape == result.regime.shape == (3, 4)
    assert lumped.rebound(np.zeros((0, 2))).velocity.shape == (0, 2)


def test_batches_do_not_depend_on_their_size():
    x = np.linspace(0, 8, 2 * losses.Hysteretic.chunk + 3)
    whole = lumped.rebound(x, restitution=0.7).velocity
    np.testing.assert_array_equal(whole[::977], lumped.rebound(x[::977], restitution=0.7).velocity)


@pytest.mark.parametrize("groups", GROUPS)
def test_slip_throughout_is_linear_from_its_limit_on(groups):
    limit = lumped.slip_throughout_limit(*groups)
    x = np.array([limit, np.nextafter(limit, 99), limit + 5])
    result = lumped.rebound(x, *groups)
    beta, _, e = groups
    np.testing.assert_array_equal(result.velocity, x - (1 + e) * beta)
    assert (result.regime == Regime.SLIP_THROUGHOUT).all()
    assert lumped.rebound(np.nextafter(limit, 0), *groups).regime != Regime.SLIP_THROUGHOUT


def test_limit_of_slip_throughout_is_that_of_the_continuum_at_e_1():
    assert lumped.slip_throughout_limit(3.5, 1.21, 1.0) == pytest.approx(2 * 3.5 - 1.21, abs=1e-15)


def test_normal_impact_leaves_no_tangential_velocity():
    result = lumped.rebound(0.0, restitution=[0.0, 1e-12, 0.3, 1.0])
    assert not result.velocity.any() and not result.dissipation.any()
    assert (result.regime == Regime.STICK).all()


def test_vanishing_tangential_compliance_tends_to_the_rigid_contact():
    x = np.linspace(0, 10, 201)
    zeta2 = 1e-8
    gap = (
        lumped.rebound(x, 3.5, zeta2, 0.8).velocity
        - rigid.rebound(x, 3.5, restitution=0.8).velocity
    )
    assert np.abs(gap).max() < 10 * np.sqrt(3.5 * zeta2)


def test_vanishing_restitution_tends_to_none():
    x = np.linspace(0, 10, 201)
    gap = lumped.rebound(x, restitution=1e-13).velocity - lumped.rebound(x, restitution=0).velocity
    assert np.abs(gap).max() < 1e-12


def test_last_slip_runs_in_the_incident_direction_at_small_restitution():
    contact = lumped.history(1.0, restitution=0.01)
    assert contact.events[-2].kind == EventKind.SLIP
    reversed_slip = lumped.history(1.0, restitution=1.0)
    assert np.sign(contact.events[-2].friction) == -np.sign(reversed_slip.events[-2].friction)


@pytest.mark.parametrize("groups", GROUPS)
@pytest.mark.parametrize("x", [0.0, 0.05, 1.0, 2.5, 12.0])
def test_history_ends_as_rebound_says(groups, x):
    contact, result = lumped.history(x, *groups, samples=2000), lumped.rebound(x, *groups)
    assert contact.velocity[-1] == pytest.approx(result.velocity, abs=1e-12)
    assert np.abs(contact.friction).max() == pytest.approx(result.peak_friction, abs=1e-5)
    assert (np.diff(contact.time) >= 0).all()
    assert (np.abs(contact.friction) <= contact.normal + 1e-13).all()
    np.testing.assert_allclose(contact.spring, groups[1] * contact.friction)


def test_every_event_is_a_vertex_in_order():
    contact = lumped.history(2.5, 3.5, 0.1, 1.0, samples=7)
    times = [event.time for event in contact.events]
    assert times == sorted(times) and set(times) <= set(contact.time)
    kinds = [event.kind for event in contact.events]
    assert kinds[0] == EventKind.CONTACT and kinds[-1] == EventKind.SEPARATION
    assert kinds.count(EventKind.MAXIMUM_COMPRESSION) == 1


def test_history_of_the_mirror_image():
    right, left = lumped.history(1.0), lumped.history(-1.0)
    np.testing.assert_array_equal(left.friction, -right.friction)
    np.testing.assert_array_equal(left.normal, right.normal)


def test_without_restitution_the_spring_keeps_the_rest_of_the_loss():
    contact, result = lumped.history(1.0, restitution=0.0), lumped.rebound(1.0, restitution=0.0)
    strain = 1.21 * contact.friction[-1] ** 2 / 2
    work = lumped.friction_work(1.0, restitution=0.0)
    assert work + strain == pytest.approx(result.dissipation, abs=1e-14)
    assert result.regime is Regime.STICK


HARDLY_ANYTHING_LOST = (1e-5, 1.0, 1e10, 0.3)  # 2e-20


@pytest.mark.parametrize(
    ("field", "bound", "case"),
    [
        # N and |T| stay together from maximum compression on.
        ("velocity", 1e-15, (0.9999999998255678, 1.0, 0.344897342622378, 0.5872796115786215)),
        # Slip starts at separation, where rounding puts it behind.
        ("velocity", 1e-15, (0.9999999999333825, 1.0, 1.0, 1.0)),
        # Friction far below the amplitude that it would reach later: 7e-12.
        ("peak_friction", 1e-26, (1.0655893404136876, 1.0655789130626547, 256863749330.29388, 0.1)),
        ("dissipation", 1e-34, HARDLY_ANYTHING_LOST),
        # Resonance: 1e-33 lost of 2e-3, if the arguments are exact.
        ("dissipation", 1e-30, (0.067495625, 1.07993, 0.06749562499999999, 0.5)),
        # Slip starts near a double zero.
        ("dissipation", 1e-15, (1.7420800000000003, 41.8356, 1.74208, 1.0)),
    ],
)
def test_small_results_keep_their_digits(field, bound, case):
    exact = getattr(high_precision.rebound(*case, digits=60), field)
    assert abs(float(getattr(lumped.rebound(*case), field) - exact)) <= bound


def test_dissipation_from_the_velocities_would_lose_them():
    x, beta, *_ = HARDLY_ANYTHING_LOST
    result = lumped.rebound(*HARDLY_ANYTHING_LOST)
    difference = (x - result.velocity) * (x + result.velocity) / (2 * beta)
    assert abs(difference - result.dissipation) > 1e7 * 1e-34


@pytest.mark.parametrize("groups", GROUPS)
def test_a_tiny_incidence_only_scales_the_outcome(groups):
    unit = lumped.rebound(1e-60, *groups)
    for x in (1e-120, 1e-200, 1e-300, 1e-310, 5e-324):
        found, share = lumped.rebound(x, *groups), x / 1e-60
        for name, power in (("velocity", 1), ("peak_friction", 1), ("dissipation", 2)):
            expected = getattr(unit, name) * share**power
            np.testing.assert_allclose(getattr(found, name), expected, rtol=1e-14, atol=1e-323)


def test_a_tiny_incidence_that_slips_first_is_no_scaled_one():
    found, limit = lumped.rebound(1e-150, 3.5, 1e-220), rigid.rebound(1e-150, 3.5)
    assert found.peak_friction == pytest.approx(limit.peak_friction, rel=1e-12, abs=0)


def test_the_least_incidences_are_followed_through():
    """The last slip starts so near separation that a bracket of it has no halves left."""
    table = np.loadtxt(EXTREMES, delimiter=",", skiprows=1)
    followed = table[(table[:, 0] < 1e-290) & (table[:, -1] <= 100)]
    assert len(followed) > 200
    for *groups, _, _, dissipation in followed[:, :7].tolist():
        for event in lumped.history(*groups, samples=2).events:
            if event.kind == EventKind.SLIP:
                # A friction force of `normal` is rounded a few times on its way.
                assert abs(event.friction) == pytest.approx(event.normal, rel=1e-15, abs=5e-324)
        assert lumped.friction_work(*groups) == pytest.approx(dissipation, rel=0, abs=5e-324)


def test_nothing_that_is_allowed_overflows_or_creates_energy():
    """Warnings are errors here."""
    x = np.array([0.0, 5e-324, 1e-300, 1.0, 1e150, 1e300, 8e307])
    beta = np.array([1.0, 3.5, 1e150, 8e307])
    zeta2 = np.array([5e-324, 1e-300, 1e-150, 1.0, 1e150, 1e300, 1.79e308])
    e = np.array([0.0, 5e-324, 1e-300, 1e-9, 0.5, 1.0])
    grid = np.meshgrid(x, beta, zeta2, e, indexing="ij")
    result = lumped.rebound(*grid)
    assert (np.abs(result.velocity) <= grid[0]).all()
    assert (result.dissipation >= 0).all() and np.isfinite(result.dissipation).all()
    assert ((result.peak_friction >= 0) & (result.peak_friction <= 1)).all()
    assert np.isfinite(lumped.slip_throughout_limit(*grid[1:])).all()


@pytest.mark.parametrize("x", [0.0, 5e-324, 1.0, 1e300, 8e307])
@pytest.mark.parametrize("beta", [1.0, 8e307])
@pytest.mark.parametrize("e", [0.0, 5e-324, 1.0])
def test_a_contact_at_the_end_of_the_numbers_is_followed(x, beta, e):
    zeta2 = 1.79e308
    result = lumped.rebound(x, beta, zeta2, e)
    contact = lumped.history(x, beta, zeta2, e, samples=3)
    assert contact.velocity[-1] == pytest.approx(result.velocity, rel=1e-14, abs=1e-14 * beta)
    np.testing.assert_allclose(contact.spring, zeta2 * contact.friction)
    if e > 0:
        work = lumped.friction_work(x, beta, zeta2, e)
        assert work == pytest.approx(result.dissipation, rel=1e-12, abs=1e-12 * min(x, beta))


def test_resonance_creates_no_energy():
    """x = -w but for rounding: T stays proportional to N to the end."""
    near = 1 + np.concatenate([-np.geomspace(1e-16, 1e-3, 200), np.geomspace(1e-16, 1e-3, 200)])
    for x in (1e-17, 0.3, 1.0):
        result = lumped.rebound(x, 3.5, 3.5 * near, 1.0)
        assert (np.abs(result.velocity) <= x).all() and (result.dissipation >= 0).all()


def test_rigid_contact():
    result = rigid.rebound([0.0, 1.75, 3.5, 9.0], restitution=1.0)
    np.testing.assert_allclose(result.velocity, [0, 0, 0, 2])
    np.testing.assert_allclose(result.peak_friction, [0, np.sqrt(0.75), 1, 1])
    np.testing.assert_allclose(result.dissipation, [0, 1.75**2 / 7, 3.5**2 / 7, (81 - 4) / 7])
    names = [Regime(code).name for code in result.regime]
    assert names == ["STICK", "SLIP_STICK", "SLIP_STICK", "SLIP_THROUGHOUT"]
    assert rigid.rebound(-9.0).velocity == -2.0


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ({"incidence": np.nan}, "incidence = nan: allowed are finite numbers"),
        ({"incidence": [0.0, np.inf]}, r"incidence\[1\] = inf"),
        ({"incidence": -1e308}, "incidence = -1e.308: .* -8e307 to 8e307 .the work of friction"),
        ({"mass_ratio": 1e308}, "mass_ratio = 1e.308: .* from 1 to 8e307"),
        ({"incidence": "1"}, "incidence = '1'"),
        ({"incidence": True}, "incidence = True"),
        ({"incidence": 1j}, "as real numbers"),
        ({"incidence": [[1.0], [1.0, 2.0]]}, "not a regular array"),
        ({"mass_ratio": 0.9}, "mass_ratio = 0.9: allowed are finite numbers from 1"),
        ({"stiffness_ratio": 0.0}, "stiffness_ratio = 0.0: .* use planarimpact.rigid"),
        ({"stiffness_ratio": -1}, "stiffness_ratio = -1.0"),
        ({"restitution": 1.0000001}, "restitution = 1.0000001: allowed are numbers from 0 to 1"),
        ({"restitution": -1e-9}, "restitution = -1e-09"),
        ({"incidence": [1.0, 2.0], "restitution": [1.0, 0.5, 0.2]}, "do not broadcast"),
    ],
)
def test_bad_input_is_named(arguments, words):
    with pytest.raises(InputError, match=words):
        lumped.rebound(**({"incidence": 1.0} | arguments))


@pytest.mark.parametrize("samples", [1, 0, -3, 2.5, True])
def test_bad_samples_are_named(samples):
    with pytest.raises(InputError, match="samples"):
        lumped.history(1.0, samples=samples)


def test_a_history_takes_scalars():
    with pytest.raises(InputError, match="scalars"):
        lumped.history([1.0, 2.0])


def test_a_solver_gone_wrong_does_not_run_for_ever(monkeypatch):
    """More phases than half-waves of the tangential oscillation cannot be."""
    assert lumped.rebound(2.0, 3.5, 0.1).regime == Regime.MULTIPLE
    monkeypatch.setattr(stick_slip, "_most_sticks", lambda *_: 1)
    with pytest.raises(ConvergenceError, match="1 impacts stick more often"):
        lumped.rebound(2.0, 3.5, 0.1)


def test_a_bracket_finds_the_onsets_that_free_steps_find(monkeypatch):
    rng = np.random.default_rng(3)
    x, e = rng.uniform(0, 8, 2000), rng.uniform(0.1, 1, 2000)
    groups = x, rng.uniform(1, 8, 2000), 10 ** rng.uniform(-3, 1, 2000), e
    free = lumped.rebound(*groups)
    monkeypatch.setattr(slip_onset, "FREE_STEPS", 1)
    bracketed = lumped.rebound(*groups)
    np.testing.assert_allclose(bracketed.velocity, free.velocity, rtol=0, atol=1e-14)
    np.testing.assert_array_equal(bracketed.regime, free.regime)
