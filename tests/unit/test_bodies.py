"""Bodies and materials: known values, limits, conservation laws."""

import inspect
import re

import numpy as np
import pytest

from planarimpact import InputError, bodies, fit, lumped
from planarimpact.bodies import HALF_SPACE, Body, Material, Motion
from tests.reference_solutions.inelastic_contact import motion_with, plastic_motion

CERAMIC, GLASS = Material(380e9, 0.23), Material(70e9, 0.25)
STEEL_BALL = bodies.solid_sphere(0.0127, density=7800.0)


@pytest.mark.parametrize("scale", [None, 1.0, 7.0])
def test_mass_ratio_is_that_of_the_shape(scale):
    """Of two bodies of one shape; 1 without an arm or a rotation."""
    shell = bodies.thin_shell(0.02, mass=0.0027)
    shapes = {STEEL_BALL: 3.5, shell: 2.5, Body(1.0, np.inf, 0.3): 1.0, Body(1.0, 0.3, 0.0): 1.0}
    for body, expected in shapes.items():
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
    flat = Body(1.0, 1.0, 0.0)
    for both in ((flat, GLASS, wall), (wall, GLASS, flat, GLASS)):
        assert bodies.contact(*both).effective_radius == 0.2
    assert bodies.effective_masses(STEEL_BALL, wall) == bodies.effective_masses(STEEL_BALL)


@pytest.mark.parametrize("nu", [-0.5, 0.0, 0.25, 0.3, 0.5])
def test_stiffness_ratio_of_one_material(nu):
    material = Material(3e9, nu)
    expected = pytest.approx((2 - nu) / (2 * (1 - nu)), rel=1e-14)
    assert bodies.stiffness_ratio(material) == expected
    assert bodies.stiffness_ratio(material, material) == expected


def test_neither_material_is_the_first_and_a_rigid_one_leaves_the_other():
    assert bodies.stiffness_ratio(GLASS, CERAMIC) == bodies.stiffness_ratio(CERAMIC, GLASS)
    rigid = Material(1e30, 0.3)
    alone = {bodies.stiffness_ratio: 7 / 6, bodies.effective_modulus: 70e9 * 16 / 15}
    for group, of_glass in alone.items():
        assert group(GLASS, rigid) == pytest.approx(of_glass, rel=1e-12)
        assert group(rigid, GLASS) == pytest.approx(of_glass, rel=1e-12)
    halves = bodies.effective_modulus(GLASS, GLASS), bodies.effective_modulus(GLASS) / 2
    assert halves[0] == pytest.approx(halves[1], rel=1e-14)


@pytest.mark.parametrize("x", [-4.0, 0.0, 1e-12, 1.0, 80.0])
@pytest.mark.parametrize("friction", [0.05, 1.0])
def test_incidence_from_the_angle(x, friction):
    theta = np.degrees(np.arctan(friction * x))
    assert bodies.incidence_from_angle(theta, friction) == pytest.approx(x, rel=1e-12)


@pytest.mark.parametrize(
    "body", [STEEL_BALL, bodies.thin_shell(0.02, mass=0.0027), Body(3, 0.2, 0.7)]
)
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


def test_arrays_broadcast():
    ball = bodies.solid_sphere(np.array([0.01, 0.02]), density=2500.0)
    motion = Motion(np.zeros((3, 1)), 1.0, 0.0)
    after = bodies.rebound_motion(ball, motion, 0.2, 0.0, 1.0)
    assert [v.shape for v in after] == [(3, 2)] * 3
    assert bodies.incidence(np.ones(4), 1.0, 0.5).shape == (4,)
    assert np.ndim(bodies.incidence(1.0, 1.0, 0.5)) == 0


STEEL = {"mass": 0.0327, "effective_radius": 0.01, "effective_modulus": 115e9}
RUBBER = {"mass": 0.3, "effective_radius": 0.02, "effective_modulus": 3e6}
LAWS = {
    "viscous": (bodies.viscous_restitution, bodies.relaxation_time),
    "plastic": (bodies.plastic_restitution, bodies.yield_pressure),
}


def test_all_laws_take_a_contact_first_in_one_order():
    """By place a radius and a modulus, or a speed, could be swapped in silence."""
    order = [*bodies.Contact._fields, "speed"]
    assert order == ["mass", "effective_radius", "effective_modulus", "speed"]
    functions = [getattr(bodies, name) for name in bodies.__all__]
    taken = {f.__name__: [*inspect.signature(f).parameters] for f in functions if callable(f)}
    laws = {name: names for name, names in taken.items() if {*names} & {*order[1:]}}
    assert len(laws) == 9  # Contact among them
    for names in laws.values():
        assert names[: len({*names} & {*order})] == [name for name in order if name in names]


def test_yield_begins_at_the_yield_speed():
    """There the largest pressure of Hertz, 3 F/(2 pi a^2), is the yield pressure."""
    pressure = np.array([1e8, 2e9, 1e10])
    speed = bodies.yield_speed(yield_pressure=pressure, **STEEL)
    force = bodies.hertz_peak_force(speed=speed, **STEEL)
    radius = (3 * force * 0.01 / (4 * 115e9)) ** (1 / 3)
    np.testing.assert_allclose(3 * force / (2 * np.pi * radius**2), pressure, rtol=1e-13)
    assert (bodies.plastic_restitution(*STEEL.values(), speed, pressure) == 1).all()
    assert (bodies.plastic_restitution(*STEEL.values(), 0.9 * speed, pressure) == 1).all()
    assert (bodies.plastic_restitution(*STEEL.values(), 1.01 * speed, pressure) < 1).all()
    assert bodies.yield_pressure(*STEEL.values(), speed, 1.0) == pytest.approx(pressure, rel=1e-13)


@pytest.mark.parametrize(
    ("ball", "speed", "e"),
    [(STEEL, 1e-3, 0.99), (RUBBER, 30.0, 0.8), (STEEL, 0.7, 0.3), (RUBBER, 1e-3, 0.022)],
)
def test_restitution_and_force_are_those_of_the_motion(ball, speed, e):
    """The motions by SciPy to 1e-11, in units of effective mass, modulus, radius and speed."""
    mass, radius, modulus = ball.values()
    length = (mass * speed**2 / (modulus * np.sqrt(radius))) ** 0.4
    unit = modulus * np.sqrt(radius) * length**1.5
    motions = {}
    motions["viscous"], tau = motion_with("continuum.viscous", e)
    motions["plastic"], yield_radius = motion_with("continuum.plastic", e)
    materials = {"viscous": tau * length / speed}
    materials["plastic"] = 2 / np.pi * modulus * yield_radius * np.sqrt(length / radius)
    for loss, (law, inverse) in LAWS.items():
        material = materials[loss]
        assert law(*ball.values(), speed, material) == pytest.approx(e, abs=1e-10)
        assert inverse(*ball.values(), speed, e) == pytest.approx(material, rel=1e-8)
        found = bodies.peak_force(speed=speed, restitution=e, loss=loss, **ball)
        assert found == pytest.approx(motions[loss].peak * unit, rel=1e-8)
    elastic = plastic_motion(1.2)  # it never yields
    found = bodies.hertz_peak_force(speed=speed, **ball)
    assert elastic.restitution == pytest.approx(1) and found == pytest.approx(elastic.peak * unit)


@pytest.mark.parametrize("loss", LAWS)
def test_restitution_at_one_speed_gives_the_material_and_back(loss):
    law, inverse = LAWS[loss]
    e = np.array([[1.0], [1 - 1e-9], [0.9], [0.5], [0.022]])
    speed = np.array([1e-4, 1.0, 300.0])
    steel = STEEL.values()
    found = law(*steel, speed, inverse(*steel, speed, e))
    np.testing.assert_allclose(found, np.broadcast_to(e, (5, 3)), rtol=0, atol=1e-10)
    assert (np.diff(law(*steel, speed, inverse(*steel, 1.0, 0.7))) < 0).all()
    hertz = bodies.hertz_peak_force(speed=2.0, **STEEL)
    force = bodies.peak_force(speed=2.0, restitution=[1.0, 1 - 1e-12], loss=loss, **STEEL)
    assert force[0] == hertz and force[1] == pytest.approx(hertz, rel=1e-6)
    assert bodies.relaxation_time(*steel, speed=2.0, restitution=1.0) == 0
    assert bodies.plastic_restitution(*steel, speed=1, yield_pressure=1e100) == 1


def test_what_is_made_keeps_its_fields_as_given():
    """Velocities after an impact among them, which point away from the surface."""
    radius = np.full((3, 1), 0.1)
    body, after = Body([1, np.inf], gyration=np.inf, radius=radius), Motion(-1, -2.0, spin=0)
    assert body.mass == [1, np.inf] and body.radius is radius and after == (-1, -2.0, 0)
    for made in (body, after, Material(poisson_ratio=0.5, young_modulus=1)):
        for again in (type(made)._make(made), made._replace()):
            assert type(again) is type(made) and repr(again) == repr(made)


@pytest.mark.parametrize("value", [10**20, [10**20, 1.5], [[-(10**99), 1]], range(3)])
def test_whole_numbers_are_numbers_if_a_float_can_hold_them(value):
    numbers = np.array(value, dtype=float)
    np.testing.assert_array_equal(lumped.rebound(value).velocity, lumped.rebound(numbers).velocity)


def test_what_is_out_of_range_is_named_with_its_place():
    with pytest.raises(bodies.OutOfRange) as refusal:
        bodies.viscous_restitution(*STEEL.values(), [1.0, 9.0], [[1e-7, 0.1], [0.2, 1e-7]])
    messages = refusal.value.messages
    words = {i: message.partition(":")[0] for i, message in messages.items()}
    assert words == {1: "relaxation_time = 0.1", 2: "relaxation_time = 0.2"}


def test_a_limit_that_a_refusal_prints_is_allowed():
    """Of relaxation times, and of speeds of spheres in other codes; four digits are enough."""
    speeds = np.geomspace(1e-3, 1e3, 200)
    with pytest.raises(bodies.OutOfRange) as refusal:
        bodies.viscous_restitution(*STEEL.values(), speeds, 1e9)
    said = [refusal.value.messages[i] for i in range(speeds.size)]
    limits = [float(re.search("up to (.*?) here", message)[1]) for message in said]
    found = bodies.viscous_restitution(*STEEL.values(), speeds, limits)
    np.testing.assert_allclose(found, bodies.LEAST_RESTITUTION, rtol=1e-2)
    for density in np.geomspace(10, 1e5, 50):
        sphere = GLASS, 0.005, float(density)
        with pytest.raises(InputError) as refusal:
            fit.overlap(*sphere, 1e6)
        limit = float(re.search("up to (.*?) m/s", str(refusal.value))[1])
        assert fit.overlap(*sphere, limit) == pytest.approx(0.1, rel=1e-3)


def test_dundurs_constant_is_that_of_the_text_books():
    """Johnson, Contact Mechanics, Table 5.1: with G (1 - nu) and (1 - 2 nu), by shear moduli."""
    steel, rubber = Material(210e9, 0.3), Material(1e7, 0.5)
    assert bodies.dundurs(rubber) == pytest.approx(0.0, abs=1e-15)  # incompressible
    assert bodies.dundurs(steel) == pytest.approx((1 - 0.6) / (2 * (1 - 0.3)))
    g1, g2 = 210e9 / 2.6, 70e9 / 2.5
    stated = (g2 * (1 - 0.6) - g1 * (1 - 0.5)) / (g2 * (1 - 0.3) + g1 * (1 - 0.25)) / 2
    assert bodies.dundurs(steel, GLASS) == pytest.approx(stated)
    assert bodies.dundurs(GLASS, steel) == -bodies.dundurs(steel, GLASS)
