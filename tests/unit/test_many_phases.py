"""The jump over many phases against the phases themselves, and impacts that need it.

The table of test_lumped_reference has impacts of up to 3000 phases.
"""

import numpy as np
import pytest

from planarimpact import Regime, lumped, rigid
from planarimpact.lumped import slip_onset, stick_slip


def impacts(rates, seed=1):
    """Random impacts x, beta, zeta^2, e that stick and slip with these rates nu = e omega."""
    rng = np.random.default_rng(seed)
    shape = np.shape(rates)
    beta, e = rng.uniform(1, 8, shape), rng.uniform(0.1, 1, shape)
    # Slip first to restitution only where phases are few: those impacts take a loop of their own.
    x = rng.uniform(0.1, np.where(np.asarray(rates) < 3000, 1.5, 1.0)) * beta
    return x, beta, (e / np.asarray(rates)) ** 2 * beta, e


def plainly(monkeypatch, *groups):
    """All phases one after the other."""
    with monkeypatch.context() as patch:
        patch.setattr(stick_slip, "STICKS_BEFORE_SKIP", -1)
        return lumped.rebound(*groups)


def test_jump_agrees_with_the_phases(monkeypatch):
    rates = np.geomspace(200, 6e3, 8)
    groups = impacts(rates)
    jumped, followed = lumped.rebound(*groups), plainly(monkeypatch, *groups)
    scale = groups[2] / groups[3]  # of the velocity, zeta^2/e
    assert (np.abs(jumped.velocity - followed.velocity) <= 1e-12 * rates * scale).all()
    np.testing.assert_allclose(jumped.dissipation, followed.dissipation, rtol=1e-13)
    np.testing.assert_array_equal(jumped.peak_friction, followed.peak_friction)
    np.testing.assert_array_equal(jumped.regime, followed.regime)
    assert (jumped.velocity != followed.velocity).any()  # it did jump


def test_number_of_steps_does_not_depend_on_the_number_of_phases(monkeypatch):
    searched = []
    true = slip_onset.in_restitution
    monkeypatch.setattr(
        slip_onset, "in_restitution", lambda *a: searched.append(a[0].size) or true(*a)
    )
    for zeta2 in (1e-6, 1e-8, 1e-12, 1e-30, 1e-300, 5e-324):
        searched.clear()
        result = lumped.rebound(2.0, 3.5, zeta2, 0.9)
        assert result.regime == Regime.MULTIPLE
        assert len(searched) < 450


@pytest.mark.parametrize("zeta2", [1e-4, 1e-6, 1e-8, 1e-12, 1e-100, 1e-300, 5e-324])
def test_vanishing_compliance_tends_to_the_rigid_contact(zeta2):
    x = np.array([0.0, 5e-324, 1e-300, 1e-4, 0.3, 1.0, 3.4, 3.5, 3.6, 5.0, 6.6, 6.7, 9.0, 1e300])
    e = np.array([1.0, 0.9, 1e-3])[:, None]
    found, limit = lumped.rebound(x, 3.5, zeta2, e), rigid.rebound(x, 3.5, restitution=e)
    gap = np.maximum(np.sqrt(3.5 * zeta2), 1e-150)
    assert (np.abs(found.velocity - limit.velocity) <= gap + 1e-15 * limit.velocity).all()
    # Where the first slip ends; not where x is as small as zeta^2 and stick comes first.
    slides = x > zeta2
    close = gap * 4 + 1e-14 * limit.dissipation
    assert (np.abs(found.dissipation - limit.dissipation) <= close)[:, slides].all()
    assert (np.abs(found.velocity) <= x).all()
