"""Properties of the elastic continuum over the whole box of parameters."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from planarimpact import continuum, lumped
from planarimpact.continuum import annuli, micro_slip

SHARE = st.floats(0.0, 1.2)  # of the limit of slip throughout
MASS_RATIO = st.floats(1.0, 20.0)
STIFFNESS_RATIO = st.floats(-1.0, 1.0).map(lambda power: 10.0**power)
IMPACT = st.tuples(SHARE, MASS_RATIO, STIFFNESS_RATIO)
TOGETHER = 50
PATH = st.lists(st.tuples(st.floats(0.05, 1.0), st.floats(-1.5, 1.5)), min_size=1, max_size=25)
EXAMPLES = settings.default.max_examples


def groups_of(share, beta, zeta2):
    return share * lumped.slip_throughout_limit(beta, zeta2), beta, zeta2


@settings(max_examples=EXAMPLES // 20)  # of many impacts, which cost hardly more than one
@given(st.lists(IMPACT, min_size=TOGETHER, max_size=TOGETHER))
def test_friction_never_creates_energy(impacts):
    x, beta, zeta2 = groups_of(*np.array(impacts).T)
    result = continuum.rebound(x, beta, zeta2, tolerance=1e-3)
    assert (np.abs(result.velocity) <= x).all()
    assert (result.dissipation >= 0).all()
    assert ((result.peak_friction >= 0) & (result.peak_friction <= 1)).all()


@settings(max_examples=EXAMPLES // 4)  # of a hundred instants and more
@given(IMPACT)
def test_history_keeps_coulombs_law_and_the_balance_of_momentum(impact):
    x, beta, zeta2 = map(float, groups_of(*impact))
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


@settings(max_examples=EXAMPLES // 2)
@given(PATH, st.integers(1, 6))
def test_straight_steps_may_be_divided(path, parts):
    """The row is exact for straight steps in r^2 and u, however they are cut."""
    corners = np.concatenate([[[0.0, 0.0]], np.array(path) ** [2, 1]])
    at = np.arange(len(path) * parts + 1) / parts
    fine = [np.interp(at, np.arange(len(corners)), column)[1:] for column in corners.T]
    whole, _ = micro_slip.friction(np.sqrt(corners[1:, 0]), corners[1:, 1])
    cut, _ = micro_slip.friction(np.sqrt(fine[0]), fine[1])
    np.testing.assert_allclose(cut[parts - 1 :: parts], whole, atol=1e-9)


@settings(max_examples=EXAMPLES // 30)
@given(st.lists(st.tuples(SHARE, st.floats(1.0, 8.0), st.floats(0.3, 5.0)), min_size=7, max_size=7))
def test_annuli_find_the_same(impacts):
    x, beta, zeta2 = groups_of(*np.array(impacts).T)
    exact = continuum.rebound(x, beta, zeta2, tolerance=1e-4).velocity
    found = annuli.rebound(x, beta, zeta2, circles=20, steps=1000).velocity
    assert (np.abs(found - exact) <= 3e-3 * np.maximum(1.0, beta / 3.5)).all()
