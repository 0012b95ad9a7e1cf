"""Bodies and materials: known values, limits, conservation laws, refusals."""

import collections
import pickle

import numpy as np
import pytest

from planarimpact import InputError, bodies, lumped
from planarimpact.bodies import HALF_SPACE, Body, Material, Motion

CERAMIC, GLASS = Material(380e9, 0.23), Material(70e9, 0.25)
STEEL_BALL = bodies.solid_sphere(0.0127, 7800.0)


@pytest.mark.parametrize(
    "body, expected",
    [
        (STEEL_BALL, 3.5),
        (bodies.thin_shell(0.02, 0.0027), 2.5),
        (bodies.disc(0.05, 0.1), 3.0),
        (Body(1.0, np.inf, 0.3), 1.0),
        (Body(1.0, 0.3, 0.0), 1.0),
    ],
)
@pytest.mark.parametrize("scale", [None, 1.0, 7.0])
def test_mass_ratio_is_that_of_the_shape(body, expected, scale):
    other = HALF_SPACE if scale is None else Body(scale * body.mass, *body[1:])
    assert bodies.mass_ratio(body, other) == pytest.approx(expected, rel=1e-14)
    assert bodies.mass_ratio(other, body) == pytest.approx(expected, rel=1e-14)


def test_effective_masses_of_unlike_bodies():
    # By hand: 1/m1 = (1 + 4)/2 + (1 + 1/4)/5 = 2.75, 1/m2 = 1/2 + 1/5 = 0.7.
    masses = bodies.effective_masses(Body(2.0, 1.0, 2.0), Body(5.0, 2.0, 1.0))
    assert masses == pytest.approx((1 / 2.75, 1 / 0.7), rel=1e-14)


@pytest.mark.parametrize("gyration", [0.1, np.inf])
def test_infinite_mass_is_a_half_space_whatever_its_gyration(gyration):
    wall = Body(np.inf, gyration, 0.2)
    assert bodies.effective_masses(STEEL_BALL, wall) == bodies.effective_masses(STEEL_BALL)


@pytest.mark.parametrize("nu", [-0.5, 0.0, 0.25, 0.3, 0.5])
def test_stiffness_ratio_of_one_material(nu):
    material = Material(3e9, nu)
    expected = pytest.approx((2 - nu) / (2 * (1 - nu)), rel=1e-14)
    assert bodies.stiffness_ratio(material) == expected
    assert bodies.stiffness_ratio(material, material) == expected


def test_dissimilar_materials():
    assert bodies.effective_modulus(CERAMIC, GLASS) == pytest.approx(63e9, rel=2e-3)
    assert bodies.effective_shear_modulus(CERAMIC, GLASS) == pytest.approx(13.5e9, rel=2e-3)
    assert bodies.stiffness_ratio(CERAMIC, GLASS) == pytest.approx(1.164, abs=5e-4)
    assert bodies.stiffness_ratio(GLASS, CERAMIC) == bodies.stiffness_ratio(CERAMIC, GLASS)
    nearly_rigid = Material(1e30, 0.3)
    assert bodies.stiffness_ratio(GLASS, nearly_rigid) == pytest.approx(
        bodies.stiffness_ratio(GLASS), rel=1e-12
    )


def test_effective_radius():
    assert bodies.effective_radius(0.02) == 0.02
    assert bodies.effective_radius(0.02, [0.02, np.inf]) == pytest.approx([0.01, 0.02], rel=1e-14)


@pytest.mark.parametrize("speed", [1e-200, 1e-3, 1.0, 1e200])
def test_the_groups_do_not_depend_on_the_scale_of_speed(speed):
    x = bodies.incidence(3 * speed, 2 * speed, 0.1)
    assert x == pytest.approx(15, rel=1e-14)
    motion = Motion(3 * speed, 2 * speed, 0.0)
    after = bodies.rebound_motion(Body(1.0, 1.0, 1.0), motion, 0.1, -5.0, 0.5)
    assert np.divide(after, speed) == pytest.approx([1.0, -1.0, -2.0], rel=1e-14)
    force = bodies.hertz_peak_force(0.1, speed, 1e11, 0.01)
    assert force > 0
    assert bodies.normal_frequency(force, 0.1, speed) * 0.1 * speed == pytest.approx(force)


@pytest.mark.parametrize("x", [-4.0, 0.0, 1e-12, 1.0, 80.0])
@pytest.mark.parametrize("friction", [0.05, 1.0])
def test_angle_round_trip(x, friction):
    theta = bodies.angle_of_incidence(x, friction)
    assert np.tan(np.radians(theta)) == pytest.approx(friction * x, rel=1e-12)
    assert bodies.incidence_from_angle(theta, friction) == pytest.approx(x, rel=1e-12)


@pytest.mark.parametrize("body", [STEEL_BALL, bodies.thin_shell(0.02, 0.0027), Body(3, 0.2, 0.7)])
@pytest.mark.parametrize("spin", [0.0, -150.0, 90.0])
@pytest.mark.parametrize("w, e", [(-2.2, 1.0), (0.0, 0.5), (3.0, 0.0)])
def test_rebound_balances_energy_and_momentum(body, spin, w, e):
    friction, before = 0.3, Motion(4.0, 2.0, spin)
    after = bodies.rebound_motion(body, before, friction, w, e)

    v1, v2 = bodies.contact_velocity(*before, body.radius)
    v1_after, v2_after = bodies.contact_velocity(*after, body.radius)
    assert v1_after == pytest.approx(w * friction * v2, abs=1e-12)
    assert v2_after == -e * v2

    # The friction acts at the contact point: no moment about it.
    def moment(motion):
        return body.radius * motion.tangential - body.gyration**2 * motion.spin

    assert moment(after) == pytest.approx(moment(before), abs=1e-12)

    def energy(motion):
        squares = motion.tangential**2 + motion.normal**2 + (body.gyration * motion.spin) ** 2
        return body.mass * squares / 2

    x, beta = bodies.incidence(v1, v2, friction), bodies.mass_ratio(body)
    _, m2 = bodies.effective_masses(body)
    loss = m2 * v2**2 * ((1 - e**2) / 2 + friction**2 * (x**2 - w**2) / (2 * beta))
    assert energy(before) - energy(after) == pytest.approx(loss, rel=1e-12)


@pytest.mark.parametrize("tangential_restitution", [0.4, 5 / 7, 0.9])
def test_tangential_restitution_of_the_centre_of_a_sphere(tangential_restitution):
    x = bodies.incidence(1.5, 2.0, 0.2)
    w = x * (3.5 * tangential_restitution - 2.5)
    after = bodies.rebound_motion(STEEL_BALL, Motion(1.5, 2.0, 0.0), 0.2, w, 1.0)
    assert after.tangential == pytest.approx(1.5 * tangential_restitution, rel=1e-13)


def test_rolling_and_backspin():
    assert bodies.contact_velocity(2.0, 1.0, -2.0 / 0.05, 0.05)[0] == 0
    assert bodies.contact_velocity(2.0, 1.0, 10.0, 0.05)[0] > 2.0


def test_hertz_peak_force_against_integration():
    mass, speed, modulus, radius = 0.067, 0.05, 115e9, 0.0127
    stiffness = 4 / 3 * modulus * np.sqrt(radius)
    step, depth, velocity, peak = 2e-8, 0.0, speed, 0.0
    while velocity > 0:  # leapfrog to maximum compression
        depth += step * velocity / 2
        force = stiffness * depth**1.5
        velocity -= step * force / mass
        depth += step * velocity / 2
        peak = max(peak, force)
    assert bodies.hertz_peak_force(mass, speed, modulus, radius) == pytest.approx(peak, rel=1e-5)


def test_arrays_broadcast():
    ball = bodies.solid_sphere(np.array([0.01, 0.02]), 2500.0)
    motion = Motion(np.zeros((3, 1)), 1.0, 0.0)
    after = bodies.rebound_motion(ball, motion, 0.2, 0.0, 1.0)
    assert [v.shape for v in after] == [(3, 2)] * 3
    assert bodies.incidence(np.ones(4), 1.0, 0.5).shape == (4,)
    assert np.ndim(bodies.incidence(1.0, 1.0, 0.5)) == 0


def changed(body):
    body.mass[0] = -1.0
    return body


def test_what_is_made_keeps_its_fields_as_given():
    """Velocities after an impact among them, which point away from the surface."""
    radius = np.full((3, 1), 0.1)
    body, after = Body([1, np.inf], gyration=np.inf, radius=radius), Motion(-1, -2.0, spin=0)
    assert body.mass == [1, np.inf] and body.radius is radius and after == (-1, -2.0, 0)
    for made in (body, after, Material(poisson_ratio=0.5, young_modulus=1)):
        for again in (type(made)._make(made), made._replace(), pickle.loads(pickle.dumps(made))):
            assert type(again) is type(made) and repr(again) == repr(made)


@pytest.mark.parametrize(
    "call, field, value",
    [
        (lambda: bodies.incidence(1.0, 1.0, 0.0), "friction", "0.0"),
        (lambda: bodies.incidence(1.0, [1.0, -2.0], 0.1), "v2[1]", "-2.0"),
        (lambda: bodies.incidence(1e200, 1e-200, 0.1), "incidence", "inf"),
        (lambda: bodies.angle_of_incidence(1.0, 0.0), "friction", "0.0"),
        (lambda: bodies.incidence_from_angle(90, 0.1), "theta_deg", "90.0"),
        (lambda: bodies.incidence_from_angle(-120, 0.1), "theta_deg", "-120.0"),
        (lambda: Body(0.0, 1.0, 1.0), "mass", "0.0"),
        (lambda: Body("1", 1.0, 1.0), "mass", "'1'"),
        (lambda: Body(1.0, -1.0, 1.0), "gyration", "-1.0"),
        (lambda: Body(1.0, 1.0, np.inf), "radius", "inf"),
        (lambda: Body([np.inf, -1.0], 1.0, 1.0), "mass[1]", "-1.0"),
        (lambda: GLASS._replace(young_modulus=-1.0), "young_modulus", "-1.0"),
        (lambda: Material._make([1e9, -1.0]), "poisson_ratio", "-1.0"),
        (lambda: Motion(0.0, 1.0, np.nan), "spin", "nan"),
        (lambda: Motion(np.inf, 1.0, 0.0), "tangential", "inf"),
        (lambda: bodies.mass_ratio(changed(Body(np.ones(2), 1.0, 1.0))), "body.mass[0]", "-1.0"),
        (lambda: bodies.mass_ratio(HALF_SPACE), "body.mass", "inf"),
        (lambda: bodies.mass_ratio(3.5), "body", "3.5"),
        (lambda: Material(1e9, 0.51), "poisson_ratio", "0.51"),
        (lambda: Material(0, 0.3), "young_modulus", "0.0"),
        (lambda: bodies.solid_sphere(-0.1, 1.0), "radius", "-0.1"),
        (lambda: bodies.hertz_peak_force(1.0, 0.0, 1e9, 0.1), "speed", "0.0"),
        (lambda: bodies.normal_frequency(1.0, 1.0, np.nan), "speed", "nan"),
        (
            lambda: bodies.rebound_motion(STEEL_BALL, Motion(1, 0, 0), 0.1, 0, 1),
            "motion.normal",
            "0.0",
        ),
        (
            lambda: bodies.rebound_motion(STEEL_BALL, Motion(1, 1, 0), 0.0, 0, 1),
            "friction",
            "0.0",
        ),
    ],
)
def test_refusals_name_the_field_and_its_value(call, field, value):
    with pytest.raises(InputError) as refusal:
        call()
    assert str(refusal.value).startswith(f"{field} = {value}")


OTHERS = [
    [True, 2.0],
    (0.5, np.False_),
    [[1.0, 2.0], [3, False]],
    [np.array([True]), np.array([2.0])],
    collections.deque([True, 2.0]),
    np.array([True, 2.0], dtype=object),
    bytearray(b"12"),
    memoryview(b"12"),
    [bytearray(b"12")],
]


@pytest.mark.parametrize("value", OTHERS, ids=lambda value: type(value).__name__)
def test_booleans_and_bytes_are_no_numbers_beside_numbers_either(value):
    with pytest.raises(InputError, match="incidence = .*: allowed are finite .*, as real numbers"):
        lumped.rebound(value)


@pytest.mark.parametrize("value", [10**20, [10**20, 1.5], [[-(10**300), 1]], range(3)])
def test_whole_numbers_are_numbers_if_a_float_can_hold_them(value):
    numbers = np.array(value, dtype=float)
    np.testing.assert_array_equal(lumped.rebound(value).velocity, lumped.rebound(numbers).velocity)
    for large in (10**400, [1, -(10**400)]):
        with pytest.raises(InputError, match="incidence: an integer is beyond the range of numb"):
            lumped.rebound(large)


def test_shapes_that_do_not_broadcast_are_refused():
    with pytest.raises(InputError, match="v1 .3,., v2 .2,."):
        bodies.incidence(np.ones(3), np.ones(2), 0.1)


def test_a_result_out_of_range_is_pickled_with_its_place():
    with pytest.raises(bodies.OutOfRange, match="= inf: it is beyond") as refusal:
        bodies.normal_frequency([1e-9, 1e300], 1e-200, 1.0)
    again = pickle.loads(pickle.dumps(refusal.value))
    assert type(again) is bodies.OutOfRange and str(again) == str(refusal.value)
    assert again.where.tolist() == [False, True]
