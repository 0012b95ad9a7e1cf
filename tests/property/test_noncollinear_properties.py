"""Properties of the non-collinear model over its box of parameters."""

from functools import partial

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from planarimpact import lumped, noncollinear
from planarimpact.noncollinear import InverseMass

paper_rebound = partial(noncollinear.rebound, loss="hysteretic")
paper_history = partial(noncollinear.history, loss="hysteretic")

RATIO = st.floats(-1, 1).map(lambda power: 10.0**power)
SHARE = st.floats(-0.99, 0.99).map(
    lambda share: round(share, 6)
)  # of the largest coupling that a body can have
FRICTION = st.one_of(st.sampled_from([0.0, 0.5, 1.0]), st.floats(-2, 1).map(lambda p: 10.0**p))
RESTITUTION = st.one_of(st.sampled_from([0.0, 0.5, 1.0]), st.floats(0.01, 1.0))
INCIDENCE = st.one_of(
    st.sampled_from([0.0, 1.0, -1.0]), st.floats(-6, 6).map(lambda incidence: round(incidence, 9))
)
IMPACT = st.tuples(INCIDENCE, RATIO, SHARE, FRICTION, RESTITUTION, RATIO)


def impact(incidence, mass_ratio, share, friction, restitution, stiffness_ratio):
    """Arguments of `rebound` for m2 = v2 = 1; incidence in units of mu zeta^2."""
    mass = InverseMass(mass_ratio, share * mass_ratio**0.5, 1.0)
    tangential = incidence * stiffness_ratio * (friction or 1.0)
    return tangential, 1.0, mass, friction, restitution, stiffness_ratio


@given(IMPACT)
def test_energy_balances(groups):
    v1, v2, mass, friction, *rest = impact(*groups)
    result = paper_rebound(v1, v2, mass, friction, *rest)
    before = noncollinear.kinetic_energy(v1, v2, mass)
    after = noncollinear.kinetic_energy(result.tangential, result.normal, mass)
    assert abs(before - after - result.friction_work - result.hysteresis) <= 1e-12 * before
    assert result.friction_work >= 0 and result.normal <= 0
    assert result.peak_friction <= friction * result.peak_normal * (1 + 1e-13)
    change = np.array([v1 - result.tangential, v2 - result.normal])
    impulses = np.array([result.tangential_impulse, result.normal_impulse])
    a, c, b = mass
    by_impulses = np.array([[a, -c], [-c, b]]) @ impulses
    np.testing.assert_allclose(by_impulses, change, atol=1e-12 * np.abs(change).max())


@given(IMPACT)
def test_without_coupling_it_is_the_collinear_model(groups):
    v1, _, (ratio, _, _), friction, e, zeta2 = impact(*groups)
    mu = friction or 1.0
    result = paper_rebound(v1, 1.0, InverseMass(ratio, 0.0, 1.0), mu, e, zeta2)
    # lumped takes mass ratios from 1; below, a lighter half of the same motion is not a body's.
    if ratio < 1:
        return
    exact = lumped.rebound(v1 / mu, ratio, zeta2, e)
    assert abs(result.tangential / mu - exact.velocity) <= 1e-12
    assert abs(result.normal + e) <= 1e-12
    assert abs(result.peak_friction / mu - exact.peak_friction) <= 1e-12
    assert abs(result.friction_work / mu**2 - exact.dissipation) <= 1e-12 * (1 + exact.dissipation)


@given(IMPACT)
def test_the_mirror_image_is_solved_alike(groups):
    v1, v2, mass, *rest = impact(*groups)
    one = paper_rebound(v1, v2, mass, *rest)
    other = paper_rebound(-v1, v2, mass._replace(coupling=-mass.coupling), *rest)
    turned = other._replace(
        tangential=-other.tangential, tangential_impulse=-other.tangential_impulse
    )
    # Impulses follow from velocities by a matrix that a large coupling makes nearly singular.
    scale = (1 + abs(v1) + mass.tangential) / (1 - groups[2] ** 2)
    np.testing.assert_allclose(turned[:9], one[:9], rtol=1e-12, atol=1e-13 * scale)
    assert other.regime == one.regime and other.jams == one.jams


@given(IMPACT, st.integers(-300, 300), st.integers(-300, 300), st.integers(-300, 300))
def test_speed_mass_and_stiffness_only_scale(groups, speed, mass, stiffness):
    """Powers of 4, which no rounding touches, up to 1e180; halves of them for the energies."""
    speed, mass, stiffness = (4.0 ** (power // 3) for power in (speed, mass, stiffness))
    v1, v2, inverse, *rest = impact(*groups)
    scaled = InverseMass(*(float(entry) / mass for entry in inverse))
    plain = paper_rebound(v1, v2, inverse, *rest)
    result = paper_rebound(v1 * speed, v2 * speed, scaled, *rest, stiffness)
    force = speed * (mass * stiffness) ** 0.5
    energy = mass * speed * speed
    units = [speed] * 2 + [mass * speed] * 2 + [force] * 2 + [energy] * 2
    units += [(mass / stiffness) ** 0.5]
    for found, one, unit in zip(result, plain, units, strict=False):
        assert found == one * unit


@given(IMPACT)
def test_history_keeps_coulombs_law_and_ends_at_the_rebound(groups):
    arguments = impact(*groups)
    friction = arguments[3]
    contact = paper_history(*arguments, samples=50)
    result = paper_rebound(*arguments)
    scale = contact.normal_force.max()
    rounding = 1e-12 * max(scale, np.abs(contact.friction).max())
    assert (np.abs(contact.friction) <= friction * contact.normal_force + rounding).all()
    assert (contact.normal_force >= 0).all() and (np.diff(contact.time) >= 0).all()
    reach = max(1.0, np.abs(contact.tangential).max())
    assert abs(contact.tangential[-1] - result.tangential) <= 1e-11 * reach
    assert abs(contact.normal[-1] - result.normal) <= 1e-11 * reach
    assert abs(contact.time[-1] - result.duration) <= 1e-12 * result.duration
    assert abs(scale - result.peak_normal) <= 1e-12 * scale


@given(RATIO, SHARE, RESTITUTION, st.floats(-5, 5))
def test_without_friction_only_the_coupling_turns_it(mass_ratio, share, e, v1):
    mass = InverseMass(mass_ratio, share * mass_ratio**0.5, 1.0)
    result = paper_rebound(v1, 1.0, mass, 0.0, e)
    assert abs(result.tangential - (v1 + mass.coupling * (1 + e))) <= 1e-14 * max(5, mass_ratio)
    assert abs(result.normal + e) <= 1e-15 and result.friction_work == 0


@given(RATIO, SHARE, FRICTION, RESTITUTION, RATIO)
def test_thresholds_are_crossed_without_a_jump(mass_ratio, share, friction, e, zeta2):
    """Initial slip at |v1| = mu zeta^2 v2, and where 1 - mu C = 0, the onset of jam."""
    mass = InverseMass(mass_ratio, share * mass_ratio**0.5, 1.0)
    limit = friction * zeta2
    v1 = np.array([np.nextafter(limit, -9), limit, np.nextafter(limit, 99)])
    result = paper_rebound(v1, 1.0, mass, friction, e, zeta2)
    assert jump(result.tangential) <= 1e-10 * max(1.0, limit, mass_ratio)
    if abs(mass.coupling) > 0.01 and e > 0:
        onset = 1 / abs(mass.coupling)
        friction = onset * np.array([1 - 1e-14, 1.0, 1 + 1e-14])
        sliding = 3 * onset * zeta2 * np.sign(mass.coupling)
        result = paper_rebound(sliding, 1.0, mass, friction, e, zeta2)
        assert jump(result.tangential) <= 1e-9 * max(1.0, abs(sliding), mass_ratio)


def jump(velocity):
    """Of three neighbours, apart from a steady slope: a contact that rattles has a steep one."""
    return abs(velocity[0] - 2 * velocity[1] + velocity[2])
