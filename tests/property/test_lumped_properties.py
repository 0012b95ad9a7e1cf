"""Properties of the lumped model over the whole box of parameters."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from planarimpact import Regime, lumped

INCIDENCE = st.floats(0.0, 20.0)
MASS_RATIO = st.floats(1.0, 8.0)
STIFFNESS_RATIO = st.floats(-1.0, 1.0).map(lambda power: 10.0**power)
RESTITUTION = st.one_of(
    st.sampled_from([0.0, 1.0]), st.floats(0.0, 1.0), st.floats(-12, 0).map(lambda p: 10.0**p)
)
GROUPS = st.tuples(MASS_RATIO, STIFFNESS_RATIO, RESTITUTION)

settings.register_profile("house", max_examples=300, deadline=None, derandomize=True)
settings.load_profile("house")


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
