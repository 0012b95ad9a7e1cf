"""`collide`: conservation, Coulomb's limit, frames, limits, and one impact beside many."""

import pickle

import numpy as np
import pytest

from planarimpact import (
    InputError,
    Pair,
    Regime,
    bodies,
    collide,
    collision,
    continuum,
    spheres,
)
from planarimpact.collision import one_impact
from planarimpact.normal_impact import yielding
from tests.reference_solutions import inelastic_contact

COUNT = 12_000
# Rounding, as a share of the largest term of a balance.
ROUNDING = 1e-12
WALL = bodies.HALF_SPACE
STEEL = bodies.Material(207e9, 0.3)
BALL = bodies.solid_sphere(0.01, density=7800.0)


def of_steel(friction, restitution, loss="plastic"):
    return Pair(STEEL, friction=friction, restitution=restitution, loss=loss)


# Random impacts.


def directions(rng, count):
    vectors = rng.normal(size=(count, 3))
    return vectors / np.linalg.norm(vectors, axis=1)[:, None]


def balls(rng, count, walls=0.2):
    """Solid spheres, shells and moving walls: masses of 1e-6 to 1 kg."""
    radius, shell = 10 ** rng.uniform(-3, -1, count), rng.random(count) < 0.3
    gyration = radius * np.sqrt(np.where(shell, 2 / 3, 0.4))
    sizes = 10 ** rng.uniform(-6, 0, count), gyration, radius
    wall = rng.random(count) < walls
    return bodies.Body(*(np.where(wall, w, v) for w, v in zip(WALL, sizes, strict=True)))


def pairs(rng, count):
    """e from 0.3, constant or by the speed; a tenth without friction, a tenth elastic."""
    kind = rng.integers(0, 3, count)
    e = np.where(rng.random(count) < 0.1, 1.0, rng.uniform(0.3, 1.0, count))
    return Pair(
        friction=np.where(rng.random(count) < 0.1, 0.0, rng.uniform(0.01, 1.0, count)),
        stiffness_ratio=rng.uniform(1.0, 1.5, count),
        effective_modulus=10 ** rng.uniform(7, 11, count),
        restitution=np.where(kind == 0, e, np.nan),
        relaxation_time=np.where(kind == 1, 10 ** rng.uniform(-9, -7, count), np.nan),
        yield_pressure=np.where(kind == 2, 10 ** rng.uniform(9, 10, count), np.nan),
        loss=np.where(kind > 0, "", np.where(rng.random(count) < 0.5, "viscous", "plastic")),
    )


def random_impacts(count=COUNT, seed=1):
    """Arguments of `collide`; some bodies part or only touch, some are head-on."""
    rng = np.random.default_rng(seed)
    normal, body, other = directions(rng, count), balls(rng, count, 0.0), balls(rng, count)
    velocity, other_velocity = rng.normal(size=(2, count, 3))
    spin, other_spin = rng.normal(size=(2, count, 3)) / body.radius[:, None]
    flat = np.isinf(other.mass)
    other_spin[flat] = 0.0
    still = rng.random(count) < 0.02
    velocity[still], other_velocity[still], spin[still] = -normal[still], 0.0, 0.0
    other_spin[still] = 0.0
    touch = rng.random(count) < 0.02
    velocity[touch] = other_velocity[touch] = 0.0
    return pairs(rng, count), normal, body, velocity, spin, other, other_velocity, other_spin


@pytest.fixture(scope="module")
def impacts():
    """Arguments, and the answer to them, where normals have any length that is accepted."""
    arguments = random_impacts()
    pair, normal, *others = arguments
    nearly_unit = normal * (1 + 0.999e-6 * np.sin(np.arange(len(normal))))[:, None]
    return arguments, collide(pair, nearly_unit, *others)


def dot(a, b):
    return np.sum(a * b, axis=-1)


def inertia(body):
    """Mass and moment of inertia, of walls 0."""
    mass, gyration = (np.where(np.isinf(value), 0.0, value) for value in body[:2])
    return mass, mass * gyration**2


def energy(body, velocity, spin):
    """Kinetic energy, of walls 0."""
    mass, moment = inertia(body)
    return mass / 2 * dot(velocity, velocity) + moment / 2 * dot(spin, spin)


def test_momentum_and_angular_momentum_are_conserved(impacts):
    (_, normal, body, velocity, spin, other, other_velocity, other_spin), after = impacts
    bodies_before = (body, velocity, spin), (other, other_velocity, other_spin)
    bodies_after = (after.velocity, after.spin), (after.other_velocity, after.other_spin)
    arm = (body.radius + other.radius)[:, None] * np.cross(normal, after.impulse)
    turned, size = arm, (body.radius + other.radius) * np.abs(after.impulse).max(axis=1)
    for (who, v, w), (v_after, w_after), sign in zip(
        bodies_before, bodies_after, (1, -1), strict=True
    ):
        mass, moment = inertia(who)
        error = np.abs((v_after - v) * mass[:, None] - sign * after.impulse).max(axis=1)
        scale = np.abs(after.impulse).max(axis=1) + mass * np.abs(v).max(axis=1)
        assert (error <= ROUNDING * scale)[mass > 0].all()
        turned = turned + moment[:, None] * (w_after - w)
        size = size + moment * np.abs(w).max(axis=1)
    # A wall takes any angular momentum.
    assert (np.abs(turned).max(axis=1) <= ROUNDING * size)[np.isfinite(other.mass)].all()


def test_no_energy_is_created_and_friction_keeps_its_limit(impacts):
    (pair, normal, body, velocity, spin, other, other_velocity, other_spin), after = impacts
    # In the frame of the other body, so that a wall that moves does no work.
    before = energy(body, velocity - other_velocity, spin) + energy(other, 0 * velocity, other_spin)
    then = energy(body, after.velocity - other_velocity, after.spin)
    then += energy(other, after.other_velocity - other_velocity, after.other_spin)
    assert (then <= before * (1 + 1e-11)).all()
    push = dot(after.impulse, normal)
    drag = np.linalg.norm(after.impulse - push[:, None] * normal, axis=1)
    assert (push >= 0).all()
    assert (drag <= pair.friction * push * (1 + 1e-9) + ROUNDING * push).all()
    kept = (pair.friction == 0) & (after.restitution == 1)
    assert kept.any() and np.allclose(then[kept], before[kept], rtol=1e-11, atol=0)


def test_what_does_not_approach_is_left_alone(impacts):
    """Of what does, the normal velocity is reversed by restitution."""
    (_, normal, body, velocity, spin, other, other_velocity, other_spin), after = impacts
    contact = velocity - np.cross(spin, normal) * body.radius[:, None]
    contact = contact - other_velocity - np.cross(other_spin, normal) * other.radius[:, None]
    away = dot(contact, normal) >= 1e-12
    alone = after.regime == Regime.NO_IMPACT
    assert alone[away].all() and (velocity == other_velocity).all(axis=1)[alone & ~away].any()
    for then, before in (
        (after.velocity, velocity),
        (after.spin, spin),
        (after.other_velocity, other_velocity),
        (after.other_spin, other_spin),
    ):
        assert (then[alone] == before[alone]).all()
    assert (after.impulse[alone] == 0).all() and np.isnan(after.incidence[alone]).all()
    assert np.isnan(after.model_form[alone]).all() and (after.loss[alone] == "none").all()
    contact = after.velocity - after.other_velocity
    change = dot(contact, normal) + after.restitution * dot(velocity - other_velocity, normal)
    assert np.abs(change[~alone]).max() < 1e-10


@pytest.mark.parametrize("frame", ["mirrored", "moving", "other body first"])
def test_the_frame_does_not_matter(impacts, frame):
    """A frame that is mirrored is turned as well; spins are axial vectors."""
    (pair, normal, body, velocity, spin, other, other_velocity, other_spin), after = impacts
    turn, along, hand = np.eye(3), np.zeros(3), 1
    if frame == "mirrored":
        turn, hand = np.linalg.qr(np.random.default_rng(2).normal(size=(3, 3)))[0], -1
        turn = -turn * np.sign(np.linalg.det(turn))
    elif frame == "moving":
        along = np.array([3.0, -1.0, 2.0])
    one = body, velocity @ turn.T + along, hand * spin @ turn.T
    two = other, other_velocity @ turn.T + along, hand * other_spin @ turn.T
    if frame == "other body first":
        found = collide(pair, -normal, *two, *one)
        then = found.other_velocity, found.other_spin, found.velocity
    else:
        found = collide(pair, normal @ turn.T, *one, *two)
        then = found.velocity, found.spin, found.other_velocity
    then = (then[0] - along) @ turn, hand * then[1] @ turn, (then[2] - along) @ turn
    met = after.regime != Regime.NO_IMPACT
    speed = np.abs(velocity).max() + np.abs(spin * body.radius[:, None]).max(axis=1)
    for new, old, unit in zip(
        then, (after.velocity, after.spin, after.other_velocity), (1, body.radius, 1), strict=True
    ):
        error = np.abs(new - old).max(axis=1) * unit
        assert (error[met] <= 1e-8 * speed[met]).all()


# One impact alone is taken by a function of its own.


def sprayed(rng):
    """Pairs and incidences around every threshold of incidence, restitution and zeta^2.

    The table has the incidence where metal begins to slide with an error, the continuum without.
    """
    near = np.array([0.0, 1e-15, -1e-15, 1e-9, -1e-9, 1e-6, -1e-6, 1e-3, -1e-3, 2e-2, -2e-2])
    rows = []
    ends = 0.1, 0.1 * (1 + near[1]), *0.3 * (1 + near[:3])  # nothing is solved below 0.1
    for e in (*ends, 0.6, rng.uniform(0.3, 0.9), 1 - 1e-9, 1):
        for zeta2 in (1.0, rng.uniform(1.0, 1.5), 1.5, 2.4):
            for loss in spheres.LOSSES:
                least = max(e, spheres.LEAST_RESTITUTION[loss])
                limit = float(continuum.slip_throughout_limit(3.5, zeta2, least, loss=loss))
                table = spheres.table.shipped()
                _, tabled, _ = spheres.table.of_one(table, 0.0, 3.5 / zeta2, max(e, 0.3), True)
                at = zeta2, 3.5, limit, tabled * zeta2, (limit + tabled * zeta2) / 2
                rows += [(zeta2, e, loss, x) for x in (*at, rng.uniform(0, 9))]
    zeta2, e, loss, x = map(np.array, zip(*rows, strict=True))
    pairs = Pair(friction=0.3, stiffness_ratio=zeta2, restitution=e, loss=loss)
    distance = rng.choice(near, x.size)
    return pairs, x * (1 + distance), distance


LONG_SEEDS = (pytest.param(seed, marks=pytest.mark.long) for seed in range(30))


@pytest.mark.parametrize("seed", [100, *LONG_SEEDS])
def test_one_impact_is_that_of_many(seed):
    """Both have the same answer, to rounding, and the single one is taken by its own function."""
    up, still, ball = (
        np.array([0.0, 0.0, 1.0]),
        np.zeros(3),
        bodies.solid_sphere(0.01, density=2500.0),
    )
    pairs, x, distance = sprayed(np.random.default_rng(seed))
    velocity = x[:, None] * [0.3, 0, 0] - up
    many, plain = collide(pairs, up, ball, velocity, still), 0
    for i, row in enumerate(velocity):
        vectors, pair = [v.tolist() for v in (up, row, still, still, still)], pairs[i]
        if not one_impact.collide(pair, ball, WALL, vectors, 5e-3):
            continue
        one, plain = collide(pair, up, ball, row, still), plain + 1
        if one.error_bound:  # of the table, which leaves impacts to the continuum below it
            assert not one_impact.collide(pair, ball, WALL, vectors, 0.999 * one.error_bound / 0.3)
        # A float64 beside a threshold one may take the formula, and the other one the table.
        error = max(one.error_bound, many.error_bound[i])
        same_method = one.error_bound == many.error_bound[i]
        assert same_method or abs(distance[i]) < 1e-14
        np.testing.assert_allclose(
            one.velocity, many.velocity[i], rtol=1e-12, atol=1e-12 if same_method else error
        )
        assert one.regime == many.regime[i] or not same_method
        assert one.incidence == pytest.approx(many.incidence[i], rel=1e-14)
        assert one.restitution == many.restitution[i] and one.loss == many.loss[i]
    assert plain > 0.6 * x.size


@pytest.mark.parametrize("shape", [(), (1,)])
def test_bodies_of_short_numbers_are_computed_in_double_precision(shape):
    sizes = [np.full(shape, n, np.float32)[()] for n in (0.1, 0.0063, 0.01)]
    one, two = (
        collide(of_steel(0.3, 0.8), [0, 0, 1], body, np.full((*shape, 3), [0.5, 0, -2]), [0, 0, 0])
        for body in (bodies.Body(*sizes), bodies.Body(*(np.array(n, float) for n in sizes)))
    )
    for name in ("velocity", "spin", "impulse"):
        np.testing.assert_allclose(getattr(one, name), getattr(two, name), rtol=1e-13)


# Limits and thresholds.


def answers(pair, normal, velocity):
    """The answer to one impact alone and in an array; or its refusal. A scene is what these say."""
    found = []
    for shape in ((3,), (1, 3)):
        normals, velocities = (np.reshape(vector, shape) for vector in (normal, velocity))
        try:
            one = collide(pair, normals, BALL, velocities, [0, 0, 0])
        except InputError as error:
            found.append(str(error).removeprefix("impact [0]: "))
        else:
            regime = Regime(np.ravel(one.regime)[0]).name
            found.append((one.velocity.reshape(3), one.incidence, regime))
    return found


@pytest.mark.parametrize(("loss", "zeta2", "e"), [("viscous", 1.5, 0.35), ("plastic", 1.0, 0.2)])
def test_friction_of_any_size_is_that_of_springs_which_stick(loss, zeta2, e):
    """Where x vanishes the rebound is in proportion to v1(0), and so is its error."""
    up, unit_ball = [0, 0, 1], bodies.Body(1, 0.4**0.5, 1)
    wanted = inelastic_contact.small_incidences(loss, 1e-9, 3.5, zeta2, e)
    friction = 10.0 ** np.array([3, 4, 6, 9, 15, 24, 60, 100])
    pair = Pair(stiffness_ratio=zeta2, friction=friction, restitution=e, loss=loss)
    for given, mu in ((pair, friction), (pair[-1], friction[-1])):
        found = collide(given, up, unit_ball, [0.5, 0, -2], [0, 0, 0], tolerance=1.0)
        w = (found.velocity - np.cross(found.spin, up))[..., 0]
        assert np.all(found.error_bound <= collision.TOLERANCE * 0.5 * (1 + 1e-12))
        slack = found.error_bound + 0.5 * (inelastic_contact.SMALL + 2.5e-1 / mu)
        assert np.all(np.abs(w - 0.5 * wanted) <= slack)
        assert np.all(found.model_form < 0.5)


@pytest.mark.parametrize("length", [1 + 9.9e-7, 1 - 9.9e-7])
def test_the_length_of_a_normal_adds_no_energy_and_no_incidence(length):
    unit, pair = np.array([2.0, 3.0, 6.0]) / 7, of_steel(0.3, 0.8)
    for answer, incidence, _ in answers(pair, unit * length, -3.0 * unit):
        np.testing.assert_allclose(answer, 2.4 * unit, rtol=1e-15)
        assert incidence < 1e-14


@pytest.mark.parametrize("length", [0, 1 - 1.1e-6, 1 - 1e-6, 1 + 1e-6, 1 + 1.1e-6, 1e20])
def test_the_length_of_a_normal_is_looked_at_first(length):
    """Also where nothing approaches, as of two centres at one place."""
    for unit in ([0, 0, 1], [0, 1, 0]):
        for velocity in ([0.3, 0, -1.0], [0.3, 0, 1.0], [0, 0, 0]):
            normal = np.multiply(unit, float(length))
            found = answers(of_steel(0.3, 0.8), normal, velocity)
            told = ["the normal has the length" in str(answer) for answer in found]
            assert told == 2 * [abs(length - 1) > 1.05e-6]


@pytest.mark.parametrize("friction", [0.0, 0.3, 1e-300])
@pytest.mark.parametrize("loss", spheres.LOSSES)
def test_head_on_nothing_slips_whatever_the_friction(friction, loss):
    for e in (1.0, 0.5, 0.01, 0.0):
        for velocity, incidence, regime in answers(
            of_steel(friction, e, loss), [0, 0, 1], [0, 0, -2.0]
        ):
            assert incidence == 0 and regime == "STICK"
            np.testing.assert_allclose(velocity, [0, 0, 2 * e], atol=4e-16)
    for _, incidence, regime in answers(of_steel(0.0, 0.5, loss), [0, 0, 1], [1e-9, 0, -2.0]):
        assert incidence == np.inf and regime == "SLIP_THROUGHOUT"


@pytest.mark.parametrize("e", [0.3, 0.1, 0.0219, 1e-7])
def test_metal_slides_throughout_where_no_spring_can_hold_it(e):
    """The body outruns every spring: w > zeta^2 v times the pull of the middle one, always."""
    zeta2 = float(bodies.stiffness_ratio(STEEL))
    loading = yielding.loading(np.array([e]))
    depth = np.geomspace(float(loading.yields[0]), float(loading.largest_approach()[0]), 200_001)
    v, pull = loading.at(depth)[1], loading.pull(depth, yielding.FLOW)[0]
    limit = np.max(3.5 - v * (3.5 - zeta2 * pull))
    friction, fast, slow = 0.2, 1.001 * limit, 0.99 * limit
    for answer in answers(of_steel(friction, e), [0, 0, 1], [0.2 * fast, 0, -1.0]):
        velocity, incidence, regime = answer
        assert regime == "SLIP_THROUGHOUT" and incidence == pytest.approx(fast)
        wanted = 0.2 * fast - friction * (1 + e), 0.0, e
        np.testing.assert_allclose(velocity, wanted, rtol=1e-13, atol=4e-16)
    if e < 0.1:  # else it is solved
        for words in answers(of_steel(friction, e), [0, 0, 1], [0.2 * slow, 0, -1.0]):
            assert words.startswith(f"restitution = {e}: allowed are numbers from 0.1")


# Pairs.


def test_a_table_of_pairs_is_indexed_by_kinds():
    """Also what is made of materials is that of the two kinds."""
    moduli, ratios = np.array([207e9, 70e9]), np.array([0.3, 0.22])
    materials = bodies.Material(moduli[:, None], ratios[:, None]), bodies.Material(moduli, ratios)
    table = Pair(*materials, friction=0.2, restitution=[[0.8, 0.9], [0.7, 1.0]], loss="plastic")
    glass = bodies.Material(70e9, 0.22)
    one = Pair(STEEL, glass, friction=0.2, restitution=0.9, loss="plastic")
    kinds = np.array([0, 1, 1]), np.array([1, 1, 0])
    assert table.shape == (2, 2) and table[kinds].restitution.tolist() == [0.9, 1.0, 0.7]
    assert table[0, 1].stiffness_ratio == one.stiffness_ratio


def test_nobody_changes_a_pair():
    """Single impacts have its numbers in another form, which would not follow."""
    given = np.array([0.2, 0.3])
    table = Pair(STEEL, friction=given, restitution=0.8, loss="plastic")
    given[:] = 0.9
    assert table.friction.tolist() == [0.2, 0.3]
    for pair in (table, table[0], pickle.loads(pickle.dumps(table[0]))):
        with pytest.raises(ValueError, match="read-only"):
            pair.friction[...] = 0.9


def test_a_caller_may_change_its_vectors_afterwards():
    velocity, pair = np.array([0.6, 0, -1.0]), of_steel(0.3, 0.8)
    wanted = collide(pair, [0, 0, 1], BALL, velocity, [0, 0, 0]).model_form
    result = collide(pair, [0, 0, 1], BALL, velocity, [0, 0, 0])
    velocity[:] = result.velocity
    assert result.model_form == wanted > 0


@pytest.mark.parametrize("law", [{"restitution": 0.8}, {"yield_pressure": 2e9}])
def test_replaced_fields_are_those_of_a_new_pair(law):
    """Of one pair and of a table; the old pair stays as it was."""
    for friction in (0.2, [[0.2], [0.3]]):
        given = {"friction": friction, "loss": "plastic"} | law
        pair = Pair(STEEL, **given)
        for change in ({"friction": 0.4}, {"friction": [0.1, 0.2]}, dict(law), {"loss": "plastic"}):
            change |= {name: 0.9 * value for name, value in law.items()}
            found, wanted = pair.replace(**change), Pair(STEEL, **given | change)
            wanted = wanted if found.shape == wanted.shape else wanted.broadcast(found.shape)
            for name in Pair.__slots__:
                one, other = (np.ravel(getattr(pair, name)) for pair in (found, wanted))
                np.testing.assert_array_equal(one, other)
        np.testing.assert_array_equal(pair.friction, friction)
    other = pair.replace(restitution=0.5, yield_pressure=None, loss="plastic")
    assert (other.restitution == 0.5).all() and np.isnan(other.yield_pressure).all()
    if "yield_pressure" in law:  # whose loss goes with it
        polymer = pair.replace(yield_pressure=None, relaxation_time=1e-7)
        assert (polymer.loss == "viscous").all()
