"""Identities, limits and refusals of the lumped model where other elements take the energy."""

import numpy as np
import pytest
from mpmath import mp

from planarimpact import EventKind, InputError, Regime, lumped, rigid
from planarimpact.lumped import losses
from planarimpact.lumped.viscous import elements
from tests.reference_solutions import viscous_precision

X = np.linspace(0, 20, 401)
GROUPS = [(3.5, 1.21, 0.8), (8.0, 0.1, 0.97), (2.5, 1.5, 0.01), (1.0, 10.0, 0.3), (8.0, 0.5, 0.1)]
LOSSES = ["hysteretic", "unloading-stiffness", "viscous"]


def drawn(count, seed=1):
    rng = np.random.default_rng(seed)
    beta, zeta2 = rng.uniform(1, 8, count), 10 ** rng.uniform(-1, 1, count)
    return rng.uniform(0, 10, count), beta, zeta2, rng.uniform(0.01, 1, count)


def same(one, other):
    for a, b in zip(one[:4], other[:4], strict=True):
        np.testing.assert_array_equal(a, b)


@pytest.mark.parametrize("loss", LOSSES)
def test_without_loss_all_are_the_same_to_the_bit(loss):
    x, beta, zeta2, _ = drawn(5000)
    same(lumped.rebound(x, beta, zeta2, 1.0, loss=loss), lumped.rebound(x, beta, zeta2, 1.0))
    one, other = lumped.history(2.5, loss=loss), lumped.history(2.5)
    np.testing.assert_array_equal(one.friction, other.friction)
    assert lumped.friction_work(2.5, loss=loss) == lumped.friction_work(2.5)
    limit = lumped.slip_throughout_limit(beta, zeta2, 1.0, loss=loss)
    np.testing.assert_array_equal(limit, lumped.slip_throughout_limit(beta, zeta2, 1.0))


def test_some_of_many_without_loss():
    x, beta, zeta2, e = drawn(1000)
    e[::3] = 1.0
    mixed = lumped.rebound(x, beta, zeta2, e, loss="viscous")
    for part in (e == 1, e < 1):
        alone = lumped.rebound(x[part], beta[part], zeta2[part], e[part], loss="viscous")
        same([field[part] for field in mixed[:4]], alone)


def test_unloading_stiffness_is_the_elastic_stiffness_of_unloading():
    x, beta, zeta2, e = drawn(5000)
    found = lumped.rebound(x, beta, zeta2, e, loss="unloading-stiffness")
    same(found, lumped.rebound(x, beta, e * (e * zeta2), e))
    one = lumped.history(2.0, 3.5, 1.21, 0.5, loss="unloading-stiffness")
    other = lumped.history(2.0, 3.5, 1.21 * 0.25, 0.5)
    np.testing.assert_allclose(one.velocity, other.velocity, rtol=1e-13)


def test_unloading_stiffness_without_restitution_has_no_tangential_compliance():
    for e in (0.0, 1e-200):
        found = lumped.rebound(X, 3.5, 1.21, e, loss="unloading-stiffness")
        limit = rigid.rebound(X, 3.5, 1.21, e)
        for name in ("velocity", "peak_friction", "dissipation"):
            np.testing.assert_allclose(getattr(found, name), getattr(limit, name), atol=1e-13)


def test_limits_of_slip_throughout():
    """Equal up to zeta^2 = beta. Beyond, a plastic contact starts to slip sooner."""
    _, beta, zeta2, e = drawn(5000)
    plastic, viscous_limit = (
        lumped.slip_throughout_limit(beta, zeta2, e, loss=loss) for loss in LOSSES[1:]
    )
    stiff = zeta2 <= beta
    np.testing.assert_allclose(plastic[stiff], viscous_limit[stiff], rtol=1e-15)
    np.testing.assert_array_equal(viscous_limit[~stiff], zeta2[~stiff])
    soft = np.maximum(e * e * zeta2, beta)[~stiff]
    np.testing.assert_allclose(plastic[~stiff], soft, rtol=1e-15)
    at_0 = [lumped.slip_throughout_limit(3.5, [1.0, 5.0], 0.0, loss=loss) for loss in LOSSES[1:]]
    np.testing.assert_array_equal(at_0, [[3.5, 3.5], [3.5, 5.0]])


@pytest.mark.parametrize("loss", LOSSES[1:])
@pytest.mark.parametrize("groups", GROUPS)
def test_slip_throughout_is_linear_from_its_limit_on(groups, loss):
    beta, _, e = groups
    limit = lumped.slip_throughout_limit(*groups, loss=loss)
    x = np.array([limit, np.nextafter(limit, 99), limit + 5])
    result = lumped.rebound(x, *groups, loss=loss)
    np.testing.assert_array_equal(result.velocity, x - (1 + e) * beta)
    assert (result.regime == Regime.SLIP_THROUGHOUT).all()
    before = lumped.rebound(np.nextafter(limit, 0), *groups, loss=loss)
    assert before.regime != Regime.SLIP_THROUGHOUT
    assert before.velocity == pytest.approx(result.velocity[0], abs=1e-13)


def test_viscous_loss_vanishes_as_e_goes_to_1():
    x, beta, zeta2, _ = drawn(2000)
    elastic = lumped.rebound(x, beta, zeta2, 1.0)
    gaps = []
    for lost in (1e-4, 1e-6, 1e-8, 1e-10, 1e-16):
        found = lumped.rebound(x, beta, zeta2, 1 - lost, loss="viscous")
        gap = max(
            np.abs(getattr(found, name) - getattr(elastic, name)).max()
            for name in ("velocity", "peak_friction", "dissipation")
        )
        gaps.append(gap / lost)
    assert max(gaps[:4]) < 200
    assert gap < 1e-13


@pytest.mark.parametrize("loss", LOSSES)
@pytest.mark.parametrize("groups", GROUPS)
def test_mirror_image_only_turns_the_velocity(groups, loss):
    right, left = (lumped.rebound(s * X, *groups, loss=loss) for s in (1, -1))
    np.testing.assert_array_equal(left.velocity, -right.velocity)
    for field in ("peak_friction", "dissipation", "regime"):
        np.testing.assert_array_equal(getattr(left, field), getattr(right, field))
    right, left = (lumped.history(s * 2.0, *groups, loss=loss) for s in (1, -1))
    np.testing.assert_array_equal(left.friction, -right.friction)
    np.testing.assert_array_equal(left.spring, -right.spring)
    np.testing.assert_array_equal(left.normal, right.normal)


@pytest.mark.parametrize("groups", GROUPS)
def test_velocities_and_ratios_have_one_scale(groups):
    """x, beta and zeta^2 in another unit: only e and the ratio beta/zeta^2 drive the contact."""
    beta, zeta2, e = groups
    one = lumped.rebound(X, beta, zeta2, e, loss="viscous")
    other = lumped.rebound(4 * X, 4 * beta, 4 * zeta2, e, loss="viscous")
    np.testing.assert_array_equal(other.velocity, 4 * one.velocity)
    np.testing.assert_array_equal(other.peak_friction, one.peak_friction)
    np.testing.assert_array_equal(other.dissipation, 4 * one.dissipation)


@pytest.mark.parametrize("groups", GROUPS)
def test_contact_that_never_slips_against_a_matrix_exponential(groups):
    """Friction without bound, x -> 0: w(tf) is linear in x."""
    x = 1e-9
    beta, zeta2, e = groups
    with mp.workdps(50):
        answer = viscous_precision.rebound(x, beta, zeta2, e)
        tau = 2 * answer.xi
        b = mp.mpf(beta) / zeta2
        normal = mp.expm(mp.matrix([[0, 1], [-1, -tau]]) * answer.duration)
        assert abs(normal[1, 1] + e) < 1e-20  # v(tf) = -e from v = 1
        body = mp.expm(mp.matrix([[0, 1], [-b, -b * tau]]) * answer.duration)[1, 1] * x
    found = lumped.rebound(x, beta, zeta2, e, loss="viscous").velocity
    assert abs(found - body) < 100 * x * x / min(e * zeta2, 1)


def test_normal_impact_leaves_no_tangential_velocity():
    for contact in (
        lumped.rebound(0.0, restitution=[1e-3, 0.1, 0.9, 1 - 1e-16], loss="viscous"),
        lumped.rebound(0.0, restitution=[0.0, 0.1, 0.9, 1 - 1e-16], loss="unloading-stiffness"),
    ):
        assert not contact.velocity.any() and not contact.dissipation.any()
        assert (contact.regime == Regime.STICK).all()
    assert not lumped.history(0.0, restitution=0.5, loss="viscous").friction.any()


def test_arguments_broadcast_in_any_shape():
    result = lumped.rebound(np.ones((3, 1)), restitution=np.full((1, 4), 0.5), loss="viscous")
    assert result.velocity.shape == result.regime.shape == (3, 4)
    assert lumped.rebound(np.zeros((0, 2)), restitution=0.5, loss="viscous").velocity.shape == (
        0,
        2,
    )
    assert lumped.rebound(1.0, restitution=0.5, loss="viscous").regime is Regime.STICK_SLIP


def test_one_and_many_agree(monkeypatch):
    monkeypatch.setattr(losses.Viscous, "chunk", 1000)
    groups = np.array(drawn(10_000))
    many = lumped.rebound(*groups, loss="viscous")
    some = slice(None, None, 601)
    for lane, point in zip(range(0, groups.shape[1], 601), groups.T[some].tolist(), strict=True):
        alone = lumped.rebound(*point, loss="viscous")
        assert tuple(alone[:4]) == tuple(field[lane] for field in many[:4])


def test_nothing_creates_energy():
    x, beta, zeta2, e = drawn(200_000)
    result = lumped.rebound(x, beta, zeta2, e, loss="viscous")
    lost = (x * x - result.velocity**2) / (2 * beta)
    assert (result.dissipation <= lost + 1e-13 * (1 + x)).all() and (result.dissipation >= 0).all()
    assert ((result.peak_friction >= 0) & (result.peak_friction <= 1)).all()


@pytest.mark.parametrize("groups", GROUPS)
@pytest.mark.parametrize("x", [0.05, 1.0, 2.5, 12.0])
def test_history_ends_as_rebound_says(groups, x):
    contact = lumped.history(x, *groups, samples=4000, loss="viscous")
    result = lumped.rebound(x, *groups, loss="viscous")
    assert contact.velocity[-1] == pytest.approx(result.velocity, abs=1e-13)
    share = np.abs(contact.friction).max() / contact.normal.max()
    assert share == pytest.approx(result.peak_friction, abs=1e-5)
    assert (contact.time[0], contact.time[-1]) == (0, 2) and (np.diff(contact.time) > 0).all()
    assert (np.abs(contact.friction) <= contact.normal + 1e-13).all()
    work = lumped.friction_work(x, *groups, loss="viscous")
    assert work == pytest.approx(result.dissipation, rel=1e-14)
    kinds = [event.kind for event in contact.events]
    assert kinds[0] == EventKind.CONTACT and kinds[-1] == EventKind.SEPARATION
    assert kinds.count(EventKind.MAXIMUM_COMPRESSION) == 1
    times = [event.time for event in contact.events]
    assert times == sorted(times) and set(times) <= set(contact.time)


@pytest.mark.parametrize(
    "case", [(1.0, 3.5, 1.21, 0.5), (2.5, 3.5, 0.2, 0.9), (5.0, 8.0, 2.0, 0.05)]
)
def test_history_has_the_events_of_the_reference(case):
    exact = viscous_precision.rebound(*case)
    found = lumped.history(*case, loss="viscous").events
    kept = [e for e in found if e.kind not in (EventKind.CONTACT, EventKind.MAXIMUM_COMPRESSION)]
    assert [e.kind for e in exact.events] == [str(e.kind) for e in kept]
    for one, other in zip(exact.events, kept, strict=True):
        assert abs(float(2 * one.time / exact.duration) - other.time) < 1e-12
        assert abs(float(one.normal) - other.normal) < 1e-12
        assert abs(float(one.friction) - other.friction) < 1e-12
        assert abs(float(one.velocity) - other.velocity) < 1e-12
        assert abs(float(one.spring) - other.spring) < 1e-12


def test_restitution_of_a_kelvin_voigt_element():
    """The relation of Schwager and Poeschel (2007), and its known values."""
    xi = np.array([1e-9, 0.1, 0.5, 0.7, 0.9])
    root = np.sqrt(1 - xi * xi)
    e = np.exp(-xi / root * np.arctan2(2 * xi * root, 2 * xi * xi - 1))
    np.testing.assert_allclose(damping_ratio(e, True), xi, atol=1e-15)
    xi = np.array([1.1, 2.0, 10.0, 300.0])
    root = np.sqrt(xi * xi - 1)
    e = np.exp(-2 * xi / root * np.log(xi + root))
    np.testing.assert_allclose(damping_ratio(e, False), xi, rtol=1e-13)


def damping_ratio(e, under):
    [(_, both)] = elements.alike(np.ones_like(e), np.ones_like(e), e)
    assert both.normal_under == under
    return both.xi


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ({"loss": "magic"}, "loss = 'magic': allowed are hysteretic, unloading-stiffness, viscous"),
        ({"loss": None}, "loss = None"),
        ({"restitution": 0.0}, "restitution = 0.0: allowed are numbers from 0.001 to 1 where loss"),
        ({"restitution": [0.5, 1e-9]}, "restitution = 1e-09"),
        ({"mass_ratio": 1e7}, "mass_ratio = 10000000.0: allowed are numbers up to 1e.06"),
        ({"stiffness_ratio": 1e-6}, "stiffness_ratio = 1e-06: allowed are 0.0001 to 1e.06 times"),
    ],
)
def test_bad_input_is_named(arguments, words):
    groups = {"incidence": 1.0, "restitution": 0.5, "loss": "viscous"} | arguments
    with pytest.raises(InputError, match=words):
        lumped.rebound(**groups)
    if not isinstance(groups["restitution"], list):
        for call in (lumped.history, lumped.friction_work):
            with pytest.raises(InputError, match=words):
                call(**groups)


def test_next_to_resonance_rounding_starts_no_stick():
    """T and N are in proportion there, all along: stick and slip differ by rounding only."""
    near = 1 + np.concatenate([-np.geomspace(1e-16, 1e-3, 200), np.geomspace(1e-16, 1e-3, 200)])
    for e in (0.01, np.exp(-2), 0.5, 0.999, 1 - 1e-12):
        for beta in (1.0, 3.5, 5.119047748496251):
            zeta2 = np.append(beta * near, beta)
            for x in (0.3 * zeta2, zeta2, np.nextafter(zeta2, 0)):
                result = lumped.rebound(x, beta, zeta2, e, loss="viscous")
                stuck = -e * x  # the limit of equal ratios
                away = np.append(np.abs(near - 1), 0)
                assert (np.abs(result.velocity - stuck) <= 20 * (away + 1e-15) * beta).all()


def test_the_whole_range_is_solved():
    """Warnings are errors here."""
    x = np.array([0.0, 5e-324, 1e-300, 1e-100, 1e-9, 1.0, 30.0, 1e6, 1e100, 8e307])
    beta, share = np.array([1.0, 3.5, 1e6]), np.array([1e-4, 1e-2, 0.5, 1.0, 2.0, 1e3, 1e6])
    e = np.array([1e-3, 0.03, np.exp(-2), 0.5, 0.99, 1 - 1e-9, np.nextafter(1, 0)])
    x, beta, share, e = np.meshgrid(x, beta, share, e, indexing="ij")
    result = lumped.rebound(x, beta, share * beta, e, loss="viscous")
    assert (np.abs(result.velocity) <= x).all() and np.isfinite(result.dissipation).all()
    assert ((result.peak_friction >= 0) & (result.peak_friction <= 1)).all()


def test_an_array_is_no_name_of_a_loss():
    with pytest.raises(InputError, match="allowed are hysteretic, unloading-stiffness, viscous"):
        lumped.rebound(2.0, loss=np.array(["plastic", "viscous"]))
