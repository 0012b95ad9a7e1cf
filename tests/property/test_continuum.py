"""The continuum, elastic and with a loss: what holds for every impact, and its limits."""

from itertools import product

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from planarimpact import Regime, continuum, lumped
from planarimpact.common import sliding
from planarimpact.continuum import micro_slip
from tests.reference_solutions import annuli

LOSSES = list(continuum.LOSSES)
EVERY = [None, *LOSSES]
BETA, ZETA2 = 3.5, 1.21
PATH = st.lists(st.tuples(st.floats(0.05, 1.0), st.floats(-1.5, 1.5)), min_size=1, max_size=25)
FEWER = settings(max_examples=settings.default.max_examples // 2)


def solved(x, beta=BETA, zeta2=ZETA2, e=0.6, loss="viscous", tolerance=1e-4):
    return continuum.rebound(x, beta, zeta2, e if loss else 1.0, loss=loss, tolerance=tolerance)


def spray(rng, n, loss):
    """Groups and incidences near every threshold: zeta^2, beta and slip throughout."""
    beta, zeta2 = rng.uniform(1, 8, n), rng.uniform(0.8, 2.0, n)
    e = np.where(rng.random(n) < 0.2, 1 - 10 ** rng.uniform(-9, -2, n), rng.uniform(0.3, 1, n))
    e = e if loss else np.ones(n)
    limit = sliding.limit_alike(beta, zeta2, e)
    flowing = continuum.slip_throughout_limit(beta, zeta2, e, loss="plastic")
    places = [zeta2, beta, limit, limit * rng.random(n), flowing]
    near = np.choose(rng.integers(0, 5, n), places)
    x = near * (1 + 10 ** rng.uniform(-12, -1, n) * rng.choice([-1, 1], n))
    return x, beta, zeta2, e


# ---- every impact ----


@pytest.mark.parametrize("loss", EVERY)
def test_no_impact_of_a_spray_around_the_thresholds_gains_energy_or_fails(loss):
    x, beta, zeta2, e = spray(np.random.default_rng(11), 120, loss)
    found = solved(x, beta, zeta2, e, loss, 1e-3)
    assert (np.abs(found.velocity) <= x * (1 + 1e-15)).all()
    lost = (x**2 - found.velocity**2) / (2 * beta)
    allowed = 1e-3 * (1 + x) if loss else 1e-12 * (1 + x**2)
    assert (found.dissipation <= lost + allowed).all()
    assert (found.dissipation >= (-1e-3 if loss else 0)).all()
    assert ((found.peak_friction >= 0) & (found.peak_friction <= 1)).all()
    # Velocity is continuous: on both sides of each threshold it is the same.
    beside = solved(x * (1 + 1e-9), beta, zeta2, e, loss, 1e-3)
    np.testing.assert_allclose(beside.velocity, found.velocity, atol=2e-3)
    np.testing.assert_allclose(beside.peak_friction, found.peak_friction, atol=2e-3)


@pytest.mark.parametrize(
    ("loss", "x"),
    [
        *product([None, *LOSSES], [0.0, 0.8, -2.0, 9.0]),
        # About zeta^2, and just below slip throughout.
        *product([None], [1.21, 1.2100001, 5.7899999]),
        *product(LOSSES, [4.6]),
    ],
)
def test_a_history_keeps_the_laws_and_ends_where_the_rebound_does(loss, x):
    e = 0.5 if loss else 1.0
    contact = continuum.history(x, restitution=e, loss=loss, tolerance=1e-3)
    after = solved(x, e=e, loss=loss, tolerance=1e-3)
    assert contact.velocity[0] == x and contact.time[0] == 0
    assert contact.velocity[-1] == pytest.approx(after.velocity, abs=2e-3)
    assert np.abs(contact.friction_force).max() == pytest.approx(after.peak_friction, abs=5e-3)
    assert (np.abs(contact.friction_force) <= contact.normal + 1e-12).all()
    assert (np.diff(contact.time) > 0).all() and len(contact.time) >= 129
    assert (contact.stick_radius <= contact.contact_radius).all()
    assert contact.normal[-1] == contact.friction_force[-1] == 0
    gross = contact.stick_radius == 0
    full = contact.normal[gross] * (x != 0)
    atol = 1e-3 if loss else 0  # one of the springs may still stick
    np.testing.assert_allclose(np.abs(contact.friction_force[gross]), full, atol=atol)
    # Both velocities change by the impulses of their forces.
    impulse, normal_impulse = (
        np.trapezoid(force, contact.time) for force in (contact.friction_force, contact.normal)
    )
    change = BETA * (1 + e) * impulse / normal_impulse
    assert x - contact.velocity[-1] == pytest.approx(change, abs=1e-3 * BETA)
    if loss is None:
        assert contact.time[-1] == 2


@given(PATH)
def test_tractions_stay_within_friction_on_any_path(path):
    radius, displacement = np.array(path).T
    force, stick = micro_slip.friction(radius, displacement)
    assert (np.abs(force) <= radius**3 * (1 + 1e-9) + 1e-12).all()
    assert ((stick >= 0) & (stick <= radius)).all()


@FEWER
@given(PATH, st.integers(1, 6))
def test_straight_steps_may_be_divided(path, parts):
    """The row is exact for straight steps in r^2 and u, however they are cut."""
    corners = np.concatenate([[[0.0, 0.0]], np.array(path) ** [2, 1]])
    at = np.arange(len(path) * parts + 1) / parts
    fine = [np.interp(at, np.arange(len(corners)), column)[1:] for column in corners.T]
    whole, _ = micro_slip.friction(np.sqrt(corners[1:, 0]), corners[1:, 1])
    cut, _ = micro_slip.friction(np.sqrt(fine[0]), fine[1])
    np.testing.assert_allclose(cut[parts - 1 :: parts], whole, atol=1e-9)


def test_annuli_the_scheme_of_1976_find_the_same():
    """At the corners of a box of groups, and within it, over all incidences."""
    beta, zeta2 = np.array([[1, 0.3], [1, 5], [8, 0.3], [8, 5], [2.5, 1.5]]).T[..., None]
    limit = lumped.slip_throughout_limit(beta, zeta2)
    x = np.array([0.1, 0.4, 0.8, 1.05]) * limit
    exact = continuum.rebound(x, beta, zeta2, tolerance=1e-5)
    scheme = annuli.rebound(x, beta, zeta2, circles=40, steps=2000)
    error = np.abs(scheme.velocity - exact.velocity)
    assert (error <= 3e-4 * np.maximum(1, limit / 6)).all()
    np.testing.assert_allclose(scheme.peak_friction, exact.peak_friction, atol=1e-3)
    np.testing.assert_array_equal(scheme.regime, Regime.names(exact.regime))
    np.testing.assert_array_equal(scheme.reversals, exact.reversals)


# ---- limits ----


@pytest.mark.parametrize("loss", LOSSES)
def test_without_loss_it_is_the_elastic_continuum(loss):
    x = np.array([0.3, 1.2, 1.3, 2.0, 3.4, 4.5])
    elastic, near = solved(x, loss=None), solved(x, e=1 - 1e-9, loss=loss)
    np.testing.assert_allclose(near.velocity, elastic.velocity, atol=1e-4)
    np.testing.assert_allclose(near.peak_friction, elastic.peak_friction, atol=1e-4)
    np.testing.assert_allclose(near.dissipation, elastic.dissipation, atol=3e-4)
    np.testing.assert_array_equal(near.regime, elastic.regime)
    mixed = continuum.rebound(x, restitution=[1, 1, 1, 0.8, 0.8, 1], loss=loss, tolerance=1e-4)
    np.testing.assert_array_equal(mixed.velocity[[0, 1, 2, 5]], elastic.velocity[[0, 1, 2, 5]])


@pytest.mark.parametrize("loss", EVERY)
@pytest.mark.parametrize(
    ("beta", "zeta2", "e"), [(3.5, 1.21, 0.6), (3.5, 1.21, 0.4), (8, 0.8, 0.3), (1.2, 2.0, 0.7)]
)
def test_slip_throughout_begins_where_the_derivation_says(loss, beta, zeta2, e):
    e = e if loss else 1.0
    limit = float(continuum.slip_throughout_limit(beta, zeta2, e, loss=loss))
    alike = float(sliding.limit_alike(beta, zeta2, e))
    # Where much has yielded, the middle sticks for a while though the body outruns all springs.
    assert (limit > alike) == (loss == "plastic" and (e < 0.5 or beta < zeta2))
    over = solved(np.array([limit, limit + 3]), beta, zeta2, e, loss)
    np.testing.assert_array_equal(over.velocity, np.array([limit, limit + 3]) - (1 + e) * beta)
    assert (over.peak_friction == 1).all() and (over.regime == Regime.SLIP_THROUGHOUT).all()
    under = solved(limit - 1e-6, beta, zeta2, e, loss, 1e-5)
    assert under.velocity == pytest.approx(limit - (1 + e) * beta, abs=2e-5)
    assert under.regime != Regime.SLIP_THROUGHOUT


def test_a_history_meets_its_tolerance_at_every_instant():
    own, exact = (continuum.history(2.3, tolerance=allowed) for allowed in (2e-5, 1e-6))
    for name in ("friction_force", "velocity"):
        wanted = np.interp(own.time, exact.time, getattr(exact, name))
        np.testing.assert_allclose(getattr(own, name), wanted, rtol=0, atol=2e-5)


@pytest.mark.parametrize("loss", LOSSES)
def test_the_contact_starts_in_stick_up_to_zeta2(loss):
    for x, sticks in ((ZETA2 * 0.98, True), (ZETA2 * 1.02, False)):
        contact = continuum.history(x, restitution=0.6, loss=loss, tolerance=1e-3)
        early = slice(1, 4)
        share = contact.friction_force[early] / contact.normal[early]
        assert (share < 0.999).all() if sticks else (share > 1 - 1e-12).all()


def test_the_regimes_of_maw_and_others_begin_where_they_say():
    """Gross slip at the start from psi1 = 1 on, throughout from psi1 = 4 chi - 1 on."""
    zeta2 = np.array([17 / 14, 1.5, 0.4])
    stick, slip = Regime.STICK_SLIP, Regime.SLIP_STICK_SLIP
    for at, *regimes in (
        (zeta2, stick, stick, slip),
        (7 - zeta2, slip, Regime.SLIP_THROUGHOUT, Regime.SLIP_THROUGHOUT),
    ):
        near = at * (1 + 1e-6 * np.array([[-1], [0], [1]]))
        found = continuum.rebound(near, 3.5, zeta2, tolerance=1e-5)
        assert found.regime.T.tolist() == [regimes] * 3
    assert (continuum.rebound([3.5, 4.5, 5.5], tolerance=1e-4).peak_friction == 1).all()
