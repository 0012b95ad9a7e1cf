"""Properties of the elastic continuum over the whole box of parameters."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from planarimpact import continuum, lumped
from planarimpact.continuum import annuli, micro_slip

SHARE = st.floats(0.0, 1.2)  # of the limit of slip throughout
MASS_RATIO = st.floats(1.0, 20.0)
STIFFNESS_RATIO = st.floats(-1.0, 1.0).map(lambda power: 10.0**power)
PATH = st.lists(st.tuples(st.floats(0.05, 1.0), st.floats(-1.5, 1.5)), min_size=1, max_size=25)


@given(SHARE, MASS_RATIO, STIFFNESS_RATIO)
def test_friction_never_creates_energy(share, beta, zeta2):
    x = share * float(lumped.slip_throughout_limit(beta, zeta2))
    result = continuum.rebound(x, beta, zeta2, tolerance=1e-3)
    assert abs(result.velocity) <= x
    assert result.dissipation >= 0
    assert 0 <= result.peak_friction <= 1


@given(SHARE, MASS_RATIO, STIFFNESS_RATIO)
def test_history_keeps_coulombs_law_and_the_balance_of_momentum(share, beta, zeta2):
    x = share * float(lumped.slip_throughout_limit(beta, zeta2))
    contact = continuum.history(x, beta, zeta2, tolerance=1e-2)
    assert (np.abs(contact.friction) <= contact.normal + 1e-12).all()
    assert (contact.stick_radius <= contact.contact_radius).all()
    gross = contact.stick_radius == 0
    np.testing.assert_allclose(np.abs(contact.friction[gross]), contact.normal[gross] * (x > 0))
    # F1 = -m1 dv1/dt; a contact lasts 2 t_c = 2.943 d_max/v2(0), and F2max = 1.25.
    impulse = np.trapezoid(contact.friction, contact.time * 1.4716375921623508) * 1.25
    assert abs(x - contact.velocity[-1] - beta * impulse) <= 1e-3 * beta


@given(PATH)
def test_tractions_stay_within_friction_on_any_path(path):
    radius, displacement = np.array(path).T
    force, stick = micro_slip.friction(radius, displacement)
    assert (np.abs(force) <= radius**3 * (1 + 1e-9) + 1e-12).all()
    assert ((stick >= 0) & (stick <= radius)).all()


@given(PATH, st.integers(1, 6))
def test_straight_steps_may_be_divided(path, parts):
    """The row is exact for straight steps in r^2 and u, however they are cut."""
    corners = np.concatenate([[[0.0, 0.0]], np.array(path) ** [2, 1]])
    at = np.arange(len(path) * parts + 1) / parts
    fine = [np.interp(at, np.arange(len(corners)), column)[1:] for column in corners.T]
    whole, _ = micro_slip.friction(np.sqrt(corners[1:, 0]), corners[1:, 1])
    cut, _ = micro_slip.friction(np.sqrt(fine[0]), fine[1])
    np.testing.assert_allclose(cut[parts - 1 :: parts], whole, atol=1e-9)


@settings(max_examples=settings.default.max_examples // 7)
@given(SHARE, st.floats(1.0, 8.0), st.floats(0.3, 5.0))
def test_annuli_find_the_same(share, beta, zeta2):
    x = share * float(lumped.slip_throughout_limit(beta, zeta2))
    exact = continuum.rebound(x, beta, zeta2, tolerance=1e-4).velocity
    found = annuli.rebound(x, beta, zeta2, circles=20, steps=1000).velocity
    assert abs(found - exact) <= 3e-3 * max(1.0, beta / 3.5)
