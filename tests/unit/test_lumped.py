"""Identities, limits and refusals of the lumped and the rigid model."""

import numpy as np
import pytest

from planarimpact import ConvergenceError, EventKind, InputError, Regime, lumped, rigid, stick_slip

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
    x = np.linspace(0, 8, 2 * lumped.CHUNK + 3)
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
