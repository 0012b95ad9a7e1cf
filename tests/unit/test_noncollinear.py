"""The non-collinear model: bodies, limits, histories, and the rigid impulse beside it."""

from functools import partial
from itertools import product

import numpy as np
import pytest

from planarimpact import Regime, noncollinear, phases
from planarimpact.common.checks import ConvergenceError
from planarimpact.noncollinear import InverseMass, rigid

paper_rebound = partial(noncollinear.rebound, loss="hysteretic")
paper_history = partial(noncollinear.history, loss="hysteretic")

ROD = {"mass": 2.0, "gyration": 1 / 12**0.5}  # of a metre


def rod(degrees, mass=2.0):
    tilt = np.radians(degrees)
    return noncollinear.inverse_mass(mass, 12**-0.5, np.sin(tilt) / 2, np.cos(tilt) / 2)


def test_two_bodies_are_one_of_their_inverse_mass():
    """Equal rods, tip to tip, mirrored in the surface: as one of half the mass on a half-space."""
    above = noncollinear.inverse_mass(2.0, 0.3, offset=0.2, depth=0.4)
    below = noncollinear.inverse_mass(2.0, 0.3, offset=-0.2, depth=-0.4)
    pair = noncollinear.combined(above, below)
    half = noncollinear.inverse_mass(1.0, 0.3, offset=0.2, depth=0.4)
    np.testing.assert_allclose(pair, half)
    one, other = (paper_rebound(1.0, 2.0, m, 0.5, 0.8) for m in (pair, half))
    np.testing.assert_allclose(one[:9], other[:9])


@pytest.mark.parametrize("e", [1e-6, 1e-9, 1e-12])
def test_a_history_of_little_restitution_ends_at_separation(e):
    contact = paper_history(0.4, 1.0, rod(30.0), 0.8, e)
    result = paper_rebound(0.4, 1.0, rod(30.0), 0.8, e)
    assert contact.normal_force[-1] <= 1e-12 * result.peak_normal
    assert contact.normal[-1] == pytest.approx(result.normal, rel=1e-12)
    assert contact.tangential[-1] == pytest.approx(result.tangential, rel=1e-12)


def test_impacts_that_rattle_on_are_named_and_the_others_answered(monkeypatch):
    """Friction holds the contact closed (mu C > 1), and the stiff unloading element rattles."""
    monkeypatch.setattr(phases, "MOST_STEPS", 60)
    monkeypatch.setattr(phases, "BLOCK", 2)
    settings = 1.0, InverseMass(1.0, 0.75, 1.0), 6.0, 1e-3, 20.0
    v1 = np.array([[0.0, 0.5], [0.0, 12.0]])
    with pytest.warns(RuntimeWarning, match="1 of 4 impacts given up.*impact 3.*'friction': 6.0"):
        result = paper_rebound(v1, *settings)
    assert all(np.isnan(field[1, 1]) for field in result[:9])
    assert result.regime[1, 1] == Regime.UNRESOLVED and not result.jams[1, 1]
    for place in ((0, 0), (0, 1), (1, 0)):
        single = paper_rebound(v1[place], *settings)
        assert all(field[place] == one for field, one in zip(result, single, strict=True))
    for function in (paper_rebound, paper_history):
        with pytest.raises(ConvergenceError, match="1 of 1 impacts given up.*'friction': 6.0"):
            function(12.0, *settings)


def test_friction_holds_a_contact_without_restitution_closed():
    """It is compressed twice, then held closed in stick, in creep, and let go without force."""
    mass = InverseMass(0.3692, 0.5663, 1.0)
    contact = paper_history(6.2256, 1.0, mass, 1.8575, 0.0, 1.3185, samples=20_000)
    assert [str(event.kind) for event in contact.events] == [
        "contact",
        "slip",
        "stick",
        "maximum compression",
        "reloading",
        "maximum compression",
        "slip",
        "separation",
    ]
    held = contact.time >= contact.events[5].time
    np.testing.assert_allclose(contact.normal[held], 0, atol=1e-15)
    mean = mass.coupling * contact.friction_force[held][1:]
    np.testing.assert_allclose(contact.normal_force[held][1:], mean, atol=1e-14)
    # Friction is the force of a spring: in stick and in creep alike, by its deflection.
    np.testing.assert_allclose(contact.spring, 1.3185 * contact.friction_force, atol=1e-13)
    # The change of velocity is the impulse of the forces.
    force = mass.coupling * contact.normal_force - mass.tangential * contact.friction_force
    change = np.trapezoid(force, contact.time)
    assert contact.tangential[-1] - 6.2256 == pytest.approx(change, abs=1e-5)
    result = paper_rebound(6.2256, 1.0, mass, 1.8575, 0.0, 1.3185)
    assert result.jams and result.regime == Regime.MULTIPLE and result.normal == 0


@pytest.mark.parametrize(
    ("v1", "mass_ratio", "coupling", "friction", "restitution", "stiffness_ratio", "regime"),
    [
        (1.0, 0.5, 0.25, 4.0, 0.0, 0.5, "STICK"),
        (4.0, 0.5, 0.25, 4.0, 0.0, 0.5, "SLIP_STICK"),
        (4.0, 0.5, 0.25, 4.0, 1.0, 1.0, "STICK_SLIP"),  # at the limit of initial slip
        (1.5, 0.5, 0.25, 2.0, 1.0, 0.75, "SLIP_THROUGHOUT"),  # there, and slip gets no faster
        (4.0, 0.5, 0.25, 4.0, 1.0, 2.0, "MULTIPLE"),
        (4.0, 4.0, -1.0, 2.0, 1.0, 1.0, "SLIP_THROUGHOUT"),  # slip stops at maximum compression
    ],
)
def test_regimes_at_round_numbers(
    v1, mass_ratio, coupling, friction, restitution, stiffness_ratio, regime
):
    mass = InverseMass(mass_ratio, coupling, 1.0)
    result = paper_rebound(v1, 1.0, mass, friction, restitution, stiffness_ratio)
    assert result.regime.name == regime and not result.jams


def test_friction_is_largest_in_the_middle_of_a_swing_too():
    """In stick it swings to -0.0336 N, and at separation it is 0.0333 N."""
    impact = -0.13198714064363087, 1.0, InverseMass(0.4985177194559317, 0.4603085237375929, 1.0)
    rest = 0.5030861863458862, 0.0, 1.9451418777045333
    forces = paper_history(*impact, *rest, samples=20_001).friction_force
    assert forces[-1] == pytest.approx(0.0333, abs=1e-4)
    assert paper_rebound(*impact, *rest).peak_friction == pytest.approx(-forces.min(), rel=1e-7)


def test_stiff_tangential_elements_come_to_the_rigid_impulse():
    """zeta^2 -> 0 where the contact slides on or comes to rest before it separates."""
    angles = np.array([-60.0, -30.0, 5.0, 60.0])
    stiff = paper_rebound(1.5, 1.0, rod(angles), 0.4, 0.6, 1e-4)
    exact = rigid.rebound(1.5, 1.0, rod(angles), 0.4, 0.6)
    np.testing.assert_allclose(stiff.tangential, exact.tangential, atol=0.02)
    np.testing.assert_allclose(stiff.normal, exact.normal, atol=0.02)


LAWS = list(rigid.Law)


@pytest.mark.parametrize("law", LAWS)
def test_rigid_impulse_against_small_steps(law):
    """Velocities against the normal impulse, in small steps that know only Coulomb's law."""
    e, count = 0.7, 4_000
    groups = product([-50.0, -20.0, 25.0, 60.0], [0.0, 0.3, 1.0, 3.0, -1.0], [0.0, 0.3, 1.6])
    degrees, v1, friction = np.array([*groups]).T
    a, c, b = rod(degrees)
    result = rigid.rebound(v1, 1.0, rod(degrees), friction, e, law)
    step = result.normal_impulse / count
    velocity, normal = v1, np.ones(v1.size)
    compression, taken, returned = np.zeros((3, v1.size))
    for _ in range(count):
        share = np.sign(velocity) * friction
        after = velocity - step * (share * a - c)
        # At rest it is held if friction can.
        held = np.clip((velocity / step + c) / a, -friction, friction)
        share = np.where(velocity * after <= 0, held, share)
        middle = normal - step * (b - share * c) / 2
        velocity, normal = velocity - step * (share * a - c), normal - step * (b - share * c)
        compression += step * (normal > 0)
        taken += np.where(normal > 0, middle * step, 0)
        returned -= np.where(normal > 0, 0, middle * step)
    np.testing.assert_allclose(velocity, result.tangential, atol=1e-3)
    np.testing.assert_allclose(normal, result.normal, atol=1e-3)
    if law == rigid.Law.ENERGETIC:
        np.testing.assert_allclose(returned, e**2 * taken, atol=1e-3)
    elif law == rigid.Law.KINEMATIC:
        np.testing.assert_allclose(result.normal, -e, atol=1e-14)
    else:
        np.testing.assert_allclose(result.normal_impulse, (1 + e) * compression, atol=3e-3)


def test_only_newtons_law_creates_energy():
    rng = np.random.default_rng(5)
    low, high = np.array([[-9, 0.01, -1, 0, 0.0], [9, 100, 1, 9, 1.0]])[:, :, None]

    def gain(groups, law):
        v1, a, share, friction, e = groups
        mass = InverseMass(a, share * 0.999 * np.sqrt(a), np.ones_like(a))
        found = rigid.rebound(v1, 1.0, mass, friction, e, law)
        before = noncollinear.kinetic_energy(v1, 1.0, mass)
        return noncollinear.kinetic_energy(found.tangential, found.normal, mass) / before - 1

    groups = low + (high - low) * rng.random((5, 20_000)) ** 2
    largest = {law: gain(groups, law).max() for law in LAWS}
    # Energies near the singular mass are differences: 1/(1 - 0.999^2) = 500 roundings.
    assert largest[rigid.Law.ENERGETIC] <= 1e-12 and largest[rigid.Law.KINETIC] <= 1e-12
    assert largest[rigid.Law.KINEMATIC] > 10


def test_the_unloading_stiffness_stiffens_the_tangential_element_by_the_square_of_e():
    rod = noncollinear.inverse_mass(1.0, 12**-0.5, offset=0.2, depth=0.4)
    stiffer = noncollinear.rebound(0.2, 1.0, rod, 0.3, 0.6, 1.21, loss="unloading-stiffness")
    assert stiffer == paper_rebound(0.2, 1.0, rod, 0.3, 0.6, 0.36 * 1.21)
    assert stiffer.tangential != paper_rebound(0.2, 1.0, rod, 0.3, 0.6, 1.21).tangential
    history = noncollinear.history(0.2, 1.0, rod, 0.3, 0.6, 1.21, loss="unloading-stiffness")
    assert history.tangential[-1] == pytest.approx(stiffer.tangential, abs=1e-12)
