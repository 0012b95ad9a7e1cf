"""Properties of the lumped model: first where it is used, then over its whole box."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from planarimpact import Regime, bodies, lumped, rigid

INCIDENCE = st.floats(0.0, 20.0)
MASS_RATIO = st.floats(1.0, 8.0)
STIFFNESS_RATIO = st.floats(-1.0, 1.0).map(lambda power: 10.0**power)
RESTITUTION = st.one_of(
    st.sampled_from([0.0, 1.0]), st.floats(0.0, 1.0), st.floats(-12, 0).map(lambda p: 10.0**p)
)
GROUPS = st.tuples(MASS_RATIO, STIFFNESS_RATIO, RESTITUTION)


@given(INCIDENCE, GROUPS)
def test_friction_never_creates_energy(x, groups):
    result = lumped.rebound(x, *groups)
    assert abs(result.velocity) <= x * (1 + 1e-15) + 1e-300
    assert result.dissipation >= 0
    assert 0 <= result.peak_friction <= 1


@given(INCIDENCE, GROUPS)
def test_energy_is_the_integrated_work_of_friction(x, groups):
    contact = lumped.history(x, *groups, samples=2)
    result = lumped.rebound(x, *groups)
    strain = groups[1] * contact.friction[-1] ** 2 / 2
    lost = lumped.friction_work(x, *groups) + strain
    assert abs(lost - result.dissipation) <= 2e-12 * max(1.0, result.dissipation)


@given(INCIDENCE, INCIDENCE, GROUPS)
def test_two_impacts_approach_each_other(x, y, groups):
    """The tangential energy of a difference never grows: w is 1-Lipschitz in the incidence."""
    gap = lumped.rebound(x, *groups).velocity - lumped.rebound(y, *groups).velocity
    assert abs(gap) <= abs(x - y) + 4e-14 * max(1.0, x, y)


@given(GROUPS)
def test_thresholds_are_crossed_without_a_jump(groups):
    beta, zeta2, e = groups
    limit = float(lumped.slip_throughout_limit(*groups))
    for threshold in (zeta2, beta, limit, beta + e * beta):
        x = np.array([np.nextafter(threshold, 0), threshold, np.nextafter(threshold, 99)])
        result = lumped.rebound(x, *groups)
        assert np.ptp(result.velocity) <= 4e-14 * max(1.0, threshold)
        assert np.ptp(result.dissipation) <= 1e-12 * max(1.0, threshold)


@given(INCIDENCE, GROUPS)
def test_history_keeps_coulombs_law(x, groups):
    contact = lumped.history(x, *groups, samples=40)
    assert (np.abs(contact.friction) <= contact.normal + 4e-14).all()
    assert np.isfinite(np.stack(contact[:5])).all()
    assert abs(contact.velocity[-1] - lumped.rebound(x, *groups).velocity) <= 1e-13 * max(1, x)


@given(st.floats(0.0, 1.0), MASS_RATIO, st.floats(0.05, 1.0))
def test_regimes_follow_the_incidence(share, beta, e):
    zeta2 = beta / 2.9  # omega/Omega = 1.7
    limit = float(lumped.slip_throughout_limit(beta, zeta2, e))
    sticks = lumped.rebound(share * zeta2 * 0.999 + 1e-6, beta, zeta2, e).regime
    slips = lumped.rebound(zeta2 * 1.001 + share * (limit - zeta2) * 0.99, beta, zeta2, e).regime
    assert sticks in (Regime.STICK_SLIP, Regime.MULTIPLE)
    assert slips in (Regime.SLIP_STICK_SLIP, Regime.MULTIPLE)


# The whole box. `impacts` takes many incidences at once, every threshold and its neighbours among
# them; omega/Omega up to 1000 bounds the number of phases.

FEWER = settings(max_examples=settings.default.max_examples // 3)
ROUNDING = 200 * 2.0**-52


def power(low, high):
    return st.floats(low, high).map(lambda exponent: 10.0**exponent)


WHOLE_BOX = st.tuples(
    power(0, 6),
    power(-8, 12),
    st.one_of(
        st.sampled_from([0.0, 5e-324, 1e-300, 1e-160, 1.0]), st.floats(0.0, 1.0), power(-20, 0)
    ),
).filter(lambda groups: groups[0] <= 1e6 * groups[1])


def thresholds(beta, zeta2, e):
    """Incidences where the order of phases changes."""
    omega = np.sqrt(beta / zeta2)
    breaks = zeta2 * omega / np.sin(omega * np.pi / 2) if omega < 1 else zeta2
    limit = float(lumped.slip_throughout_limit(beta, zeta2, e))
    return np.array([zeta2, beta, limit, (1 + e) * beta, breaks])


def impacts(groups, share):
    """Incidences over the whole range: near every threshold, below them, tiny and huge."""
    at = thresholds(*groups)
    near = [at, np.nextafter(at, 0), np.nextafter(at, np.inf)]
    tiny = [0.0, 5e-324, 1e-310, 1e-300, 1e-200, 1e-100, 1e-12, 1e-3]
    return np.concatenate([*near, share * at, tiny, [1.0, 20.0, 1e12, 1e100, 1e300]])


def scale(x, beta):
    """What rounding is measured by: velocities of this size are added and taken away."""
    return np.maximum(x, beta)


def check_energy(x, groups):
    result = lumped.rebound(x, *groups)
    assert np.isfinite(np.stack(result[:3])).all()
    assert (np.abs(result.velocity) <= x * (1 + ROUNDING)).all()
    assert (result.dissipation >= 0).all()
    assert ((result.peak_friction >= 0) & (result.peak_friction <= 1)).all()


def check_mirror(x, groups):
    there, back = lumped.rebound(x, *groups), lumped.rebound(-x, *groups)
    np.testing.assert_array_equal(back.velocity, -there.velocity)
    for one, other in zip(there[1:4], back[1:4], strict=True):
        np.testing.assert_array_equal(one, other)


def check_sliding(x, groups):
    beta, zeta2, e = groups
    x = x[x >= max(lumped.slip_throughout_limit(*groups), zeta2)]
    result = lumped.rebound(x, *groups)
    np.testing.assert_array_equal(result.velocity, x - (1 + e) * beta)
    assert (result.regime == Regime.SLIP_THROUGHOUT).all()


def check_continuity(x, groups):
    """Two impacts approach each other, those on two sides of a threshold among them."""
    x = np.sort(x)
    gap = np.abs(np.diff(lumped.rebound(x, *groups).velocity))
    assert (gap <= np.diff(x) + ROUNDING * scale(x[1:], groups[0])).all()


def check_plastic_limit(x, groups):
    """Restitution adds the impulse e at most: e -> 0 leads to e = 0."""
    beta, zeta2, e = groups
    gap = np.abs(lumped.rebound(x, *groups).velocity - lumped.rebound(x, beta, zeta2, 0.0).velocity)
    assert (gap <= e * beta * (1 + 1e-12) + ROUNDING * scale(x, beta)).all()


def check_rigid_limit(x, groups):
    """Tangential compliance stores the velocity sqrt(beta zeta^2) at most."""
    beta, zeta2, e = groups
    gap = lumped.rebound(x, *groups).velocity - rigid.rebound(x, *groups).velocity
    assert (np.abs(gap) <= np.sqrt(beta * zeta2) + ROUNDING * scale(x, beta)).all()


CHECKS = {
    check_energy: lambda result, x: result._replace(velocity=result.velocity * 1.001),
    check_mirror: lambda result, x: result._replace(velocity=np.abs(result.velocity)),
    check_sliding: lambda result, x: result._replace(velocity=result.velocity + 1e-6),
    check_continuity: lambda result, x: result._replace(
        velocity=result.velocity - 1e-6 * (x >= 3.5)
    ),
    check_plastic_limit: lambda result, x: result._replace(
        velocity=result.velocity * (1 - 0.1 * (result.regime == Regime.STICK))
    ),
    check_rigid_limit: lambda result, x: result._replace(velocity=result.velocity - x / 2),
}


@pytest.mark.parametrize("check", CHECKS, ids=lambda check: check.__name__)
@FEWER
@given(groups=WHOLE_BOX, share=st.floats(0.01, 1.2))
def test_over_the_whole_box(check, groups, share):
    check(impacts(groups, share), groups)


@pytest.mark.parametrize("check", CHECKS, ids=lambda check: check.__name__)
def test_a_wrong_solver_is_found_out(check, monkeypatch):
    groups = (3.5, 1e-4, 0.01) if check is check_rigid_limit else (3.5, 1.21, 0.001)
    x = impacts(groups, 0.5)
    check(x, groups)
    right = lumped.rebound

    def wrong(x, *groups):
        return CHECKS[check](right(x, *groups), np.abs(x))

    monkeypatch.setattr(lumped, "rebound", wrong)
    with pytest.raises(AssertionError):
        check(x, groups)


@FEWER
@given(WHOLE_BOX, st.floats(0.0, 1.1))
def test_tangential_energy_never_grows(groups, share):
    beta, zeta2, _ = groups
    x = share * thresholds(*groups)[2]
    contact = lumped.history(x, *groups, samples=30)
    energy = contact.velocity**2 / (2 * beta) + zeta2 * contact.friction**2 / 2
    assert (np.diff(energy) <= ROUNDING * scale(x, beta) ** 2 / beta).all()


@given(WHOLE_BOX, power(-300, -3), st.floats(1e-3, 1e3))
def test_without_friction_nothing_changes(groups, mu, v1):
    beta, zeta2, e = groups
    body = bodies.Body(1.0, 1.0, np.sqrt(beta - 1))
    motion = bodies.Motion(v1, 1.0, 0.0)
    w = lumped.rebound(bodies.incidence(v1, 1.0, mu), bodies.mass_ratio(body), zeta2, e).velocity
    after = bodies.rebound_motion(body, motion, mu, w, e)
    v1_after, _ = bodies.contact_velocity(after.tangential, 1.0, after.spin, body.radius)
    assert abs(v1_after - v1) <= (1 + e) * beta * mu + ROUNDING * beta * v1
