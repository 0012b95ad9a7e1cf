"""`collide` with a model that is asked for, with offsets, without solving; cautions and energy.

What it refuses stands in tests/refusals/planarimpact/collision.toml.
"""

import subprocess
import sys

import numpy as np
import pytest

from planarimpact import (
    Pair,
    Regime,
    bodies,
    collide,
    collision,
    models,
    noncollinear,
)
from planarimpact.collision import Caution, one_impact
from planarimpact.common import losses
from planarimpact.models import Model, laws
from tests.property.test_collide import STEEL, dot, energy, random_impacts

UP = np.array([0.0, 0.0, 1.0])
BALL = bodies.solid_sphere(0.01, density=7800.0)
QUICK = [name for name in models.MODELS if not name.startswith("continuum")]
QUICK.remove("lumped")  # for e = 1 alone
COUNT = 4000


def arguments_of(loss, seed=1):
    """Random impacts of one loss with e at least 0.3."""
    pair, *others = random_impacts(COUNT, seed)
    rng = np.random.default_rng(seed)
    e = np.where(rng.random(COUNT) < 0.1, 1.0, rng.uniform(0.3, 1.0, COUNT))
    groups = {"friction": pair.friction, "stiffness_ratio": pair.stiffness_ratio}
    return Pair(**groups, restitution=e, loss=loss), *others


def lost(arguments, after):
    """Kinetic energy lost, as seen from the other body, so that a moving wall does no work."""
    _, _, body, velocity, spin, other, other_velocity, other_spin = arguments
    before = energy(body, velocity - other_velocity, spin) + energy(other, 0 * velocity, other_spin)
    then = energy(body, after.velocity - other_velocity, after.spin)
    then += energy(other, after.other_velocity - other_velocity, after.other_spin)
    return before - then, before


@pytest.mark.parametrize("name", QUICK)
def test_a_model_that_is_asked_for_answers(name):
    """The contact point has the velocity of `models.rebound`; no energy is made of nothing."""
    model = models.MODELS[name]
    arguments = arguments_of("plastic" if name.endswith("plastic") else "viscous")
    pair, normal, body, velocity, spin, other, other_velocity, other_spin = arguments
    after = collide(*arguments, model=name)
    turning = body.radius[:, None] * spin + other.radius[:, None] * other_spin
    relative = velocity - other_velocity - np.cross(turning, normal)
    tangent = relative - dot(relative, normal)[:, None] * normal
    v1, v2 = np.linalg.norm(tangent, axis=1), -dot(relative, normal)
    apart, met, unit = v2 < -1e-9, v2 > 1e-9, pair.friction * v2  # some bodies only touch
    turned = body.radius[:, None] * after.spin + other.radius[:, None] * after.other_spin
    then = after.velocity - after.other_velocity - np.cross(turned, normal)
    met &= (v1 == 0) | (v1 > 1e-9)
    rubs = met & (v1 > 0) & (pair.friction > 0)
    groups = bodies.mass_ratio(body, other), pair.stiffness_ratio, pair.restitution
    x, groups = v1[rubs] / unit[rubs], [group[rubs] for group in groups]
    beta, _, e = groups
    answer = models.rebound(name, x, *groups)
    # A law in steps of time meets this line with an error; here it is exact.
    slides = answer.regime == Regime.SLIP_THROUGHOUT
    wanted = np.where(slides, x - (1 + e) * beta, answer.velocity)
    found = dot(then, tangent)[rubs] / v1[rubs]
    assert np.abs(found - wanted * unit[rubs]).max() < 1e-10 * np.abs(relative).max()
    assert set(after.model[rubs]) == {name}
    assert set(after.model[met & ~rubs]) == {"slip throughout", "head-on"}
    assert set(after.model[apart]) == {"no impact"} and set(after.loss[apart]) == {"none"}
    lossy = met & (pair.restitution < 1)
    assert set(after.loss[lossy]) == {"viscous" if model.loss == "any" else model.loss}
    difference, before = lost(arguments, after)
    assert (difference >= -1e-11 * before).all()
    assert np.abs(difference - after.energy_lost.sum(axis=1)).max() < 1e-11 * before.max()
    known = name.startswith("spheres")
    assert (np.isfinite(after.error_bound)[met] == (known | ~rubs)[met]).all()
    assert ((after.caution[met] & Caution.NO_MICRO_SLIP > 0) <= (rubs & (not known))[met]).all()
    elastic = after.model_form[met & (pair.restitution == 1)]
    assert (elastic == 0).all() and np.isnan(after.model_form[rubs & lossy]).all()


def test_the_default_loses_what_it_says():
    arguments = arguments_of("plastic")
    after = collide(*arguments)
    difference, before = lost(arguments, after)
    assert np.abs(difference - after.energy_lost.sum(axis=1)).max() < 1e-11 * before.max()
    assert set(after.model) == {
        *("continuum", "continuum.plastic", "slip throughout", "head-on", "no impact")
    }


@pytest.mark.parametrize("model", [None, *(model.name for model in one_impact.BY_MODEL)])
@pytest.mark.parametrize("friction", [0.3, 0.0])
@pytest.mark.parametrize("loss", ["viscous", "plastic"])
def test_all_that_one_impact_has_is_that_of_many(loss, friction, model, monkeypatch):
    """From stick to slip throughout, head-on, without friction, and where nothing meets."""
    velocity = np.linspace([0, 0, -1], [3, 0, -1], 60)
    velocity[-2:] = [[1, 0, 1], [1, 0, 0]]
    pair = Pair(STEEL, friction=friction, restitution=0.7, loss=loss)
    many = collide(pair, UP, BALL, velocity, [0, 0, 0], model=model)
    whole, seen = collision._collide_arrays, []
    monkeypatch.setattr(collision, "_collide_arrays", lambda *a: seen.append(a) or whole(*a))
    ones = [collide(pair, UP, BALL, [*row], [0, 0, 0], model=model) for row in velocity]
    assert len(seen) <= 2  # next to the incidence where metal slides throughout
    vectors = "velocity", "spin", "impulse", "other_velocity", "other_spin", "energy_lost"
    numbers = "incidence", "restitution", "error_bound", "model_form", "caution", "regime"
    for name in (*vectors, *numbers):
        found = np.array([getattr(one, name) for one in ones])
        np.testing.assert_allclose(found, getattr(many, name), atol=1e-9, err_msg=name)
    for name in ("model", "loss"):
        assert [str(getattr(one, name)) for one in ones] == getattr(many, name).tolist()
    if friction and model is None:
        assert many.model_form[:-2].max() > 0.05 and many.model_form[-3] == 0


def test_a_model_of_ones_own_answers():
    @laws.of_velocity
    def velocity(x, mass_ratio, stiffness_ratio, restitution):
        return np.maximum(x - (1 + restitution) * mass_ratio, 0.0)

    mine, pair = Model("mine", velocity), Pair(STEEL, friction=0.3, restitution=1.0)
    arguments = pair, UP, BALL, [[0.5, 0, -1], [5, 0, -1]], [0, 0, 0]
    found, rigid = collide(*arguments, model=mine), collide(*arguments, model="rigid")
    np.testing.assert_allclose(found.velocity, rigid.velocity, atol=1e-14)
    assert found.model.tolist() == ["mine", "mine"]


def test_what_the_table_or_a_formula_answers_is_as_ever_where_nothing_may_be_solved():
    pair = Pair(friction=0.3, stiffness_ratio=1.2, restitution=0.9, loss="plastic")
    for velocity in ([0.5, 0, -1.0], [9.0, 0, -1], [0, 0, -1]):
        arguments = pair, UP, BALL, velocity, [0, 0, 0]
        assert (collide(*arguments, solve=False).velocity == collide(*arguments).velocity).all()


def test_the_other_loss_is_not_solved_where_nothing_may_be():
    """With viscous loss the table covers e = 0.25, and with plastic loss it does not."""
    pair = Pair(friction=0.3, stiffness_ratio=1.2, restitution=0.25, loss="viscous")
    for velocity in ([0.3, 0, -1.0], [[0.3, 0, -1.0]]):
        arguments = pair, UP, BALL, velocity, [0, 0, 0]
        assert np.isnan(collide(*arguments, solve=False).model_form).all()
        assert np.all(collide(*arguments).model_form > 0.01)


def test_next_to_slip_throughout_metal_needs_no_more_modules():
    """As many modules take a quarter of a second to load, which no warm-up would find."""
    code = (
        "from planarimpact import Pair, bodies, collide; import sys;"
        "pair = Pair(friction=0.3, stiffness_ratio=1.2143, restitution=0.5, loss='plastic');"
        "ball = bodies.solid_sphere(0.01, density=7800.0);"
        "collide(pair, [0, 0, 1], ball, [0.3 * 5.15, 0, -1.0], [0, 0, 0], solve=False);"
        "assert 'scipy' not in sys.modules"
    )
    subprocess.run([sys.executable, "-c", code], check=True)


RUBBER, GLASS = bodies.Material(5e6, 0.5), bodies.Material(70e9, 0.22)
CAUTIONS = [
    ((STEEL, STEEL), {"friction": 0.2, "restitution": 0.4, "loss": "plastic"}, None, 0),
    ((STEEL, STEEL), {"friction": 0.2, "restitution": 0.39, "loss": "plastic"}, None, 1),
    ((STEEL, STEEL), {"friction": 0.21, "restitution": 0.4, "loss": "plastic"}, None, 2),
    ((STEEL, STEEL), {"friction": 0.5, "restitution": 1.0}, None, 0),
    ((STEEL,), {"friction": 0.1, "restitution": 1.0}, None, 4),
    ((STEEL,), {"friction": 0.36, "restitution": 1.0}, None, 0),
    ((STEEL, GLASS), {"friction": 0.2, "restitution": 1.0}, None, 4),
    ((GLASS, STEEL), {"friction": 0.2, "restitution": 1.0}, None, 4),
    ((RUBBER,), {"friction": 0.1, "restitution": 0.4, "loss": "viscous"}, None, 0),
    ((RUBBER,), {"friction": 0.1, "restitution": 1.0}, "lumped.hysteretic", 8),
    ((RUBBER,), {"friction": 0.1, "restitution": 0.9, "loss": "viscous"}, "lumped.hysteretic", 9),
    ((RUBBER,), {"friction": 0.1, "restitution": 0.9, "loss": "viscous"}, "lumped.viscous", 8),
    ((RUBBER,), {"friction": 0.1, "restitution": 0.9, "loss": "viscous"}, "spheres.viscous", 0),
    ((RUBBER,), {"friction": 0.1, "restitution": 0.9, "loss": "hysteretic"}, "rigid", 8),
    ((RUBBER,), {"friction": 0.1, "restitution": 0.9, "loss": "hysteretic"}, "laws.brach", 8),
]


@pytest.mark.parametrize(("materials", "values", "model", "code"), CAUTIONS)
def test_cautions_are_those_of_the_evidence(materials, values, model, code):
    """For one impact, many, those that slide throughout, head-on ones; unlike bodies either way."""
    pair = Pair(*materials, **values)
    velocity = np.array([[0.05, 0, -1.0], [30, 0, -1], [0, 0, -1], [0, 0, 1]])
    many = collide(pair, UP, BALL, velocity, [0, 0, 0], model=model)
    assert many.caution.tolist() == [code, code & Caution.FRICTION, 0, 0]
    one = collide(pair, UP, BALL, velocity[0], [0, 0, 0], model=model)
    assert one.caution == Caution(code) and isinstance(one.caution, Caution)
    assert bool(one.caution.text) == bool(code)


# Off the centre.


def test_off_the_centre_the_regime_and_the_loss_are_named():
    """Where the contact slides throughout, the law without compliance says the same."""
    pair = Pair(
        friction=[0.05, *[0.5] * len(losses.NONCOLLINEAR)],
        stiffness_ratio=1.2,
        restitution=0.5,
        loss=["hysteretic", *losses.NONCOLLINEAR],
    )
    body = bodies.Body(1.0, 0.3, 0.35)
    arguments = pair, UP, body, [0.4, 0, -1.0], [0, 0, 0]
    soft, stiff = (collide(*arguments, offset=[0.1, 0, 0], model=m) for m in (None, "rigid"))
    assert stiff.regime.tolist() == [
        Regime.SLIP_THROUGHOUT,
        *[Regime.SLIP_STICK] * (stiff.regime.size - 1),
    ]
    assert soft.regime[0] == Regime.SLIP_THROUGHOUT
    np.testing.assert_allclose(soft.velocity[0], stiff.velocity[0], rtol=1e-12)
    assert soft.model.tolist() == [f"lumped.{loss}" for loss in pair.loss]
    assert soft.caution[0] == stiff.caution[0] == 0 and (soft.caution[1:] == 9).all()


def rods(count, seed=5):
    """Planes, bodies and offsets at random; the vectors of both bodies are in the plane."""
    rng = np.random.default_rng(seed)
    turn = np.stack([np.linalg.qr(rng.normal(size=(3, 3)))[0] for _ in range(count)])
    normal, along, across = turn[:, :, 0], turn[:, :, 1], np.cross(turn[:, :, 1], turn[:, :, 0])
    body, other = (
        bodies.Body(*(10 ** rng.uniform(-1, 0.5, count) for _ in range(3))) for _ in range(2)
    )
    offsets = [rng.normal(size=count) for _ in range(2)]
    velocities, spins = rng.normal(size=(2, 2, count)), rng.normal(size=(2, count))
    velocities[0, 0] -= 2.0

    def space(velocity, spin):
        vector = velocity[0][:, None] * normal + velocity[1][:, None] * along
        return vector, spin[:, None] * across

    states = [
        v for velocity, spin in zip(velocities, spins, strict=True) for v in space(velocity, spin)
    ]
    levers = {
        name: offset[:, None] * along
        for name, offset in zip(("offset", "other_offset"), offsets, strict=True)
    }
    return (normal, body, *states[:2], other, *states[2:]), levers


@pytest.mark.parametrize("model", [None, "lumped.unloading-stiffness", "rigid"])
def test_off_the_centre_nothing_is_lost_but_what_is_said(model):
    """Momentum, angular momentum about the contact, energy; and Coulomb's limit."""
    arguments, levers = rods(300)
    normal, body, velocity, spin, other, other_velocity, other_spin = arguments
    mu, e = np.linspace(0.0, 1.0, 300), np.linspace(1.0, 0.3, 300)
    pair = Pair(friction=mu, stiffness_ratio=1.3, restitution=e, loss="hysteretic")
    after = collide(pair, *arguments, **levers, model=model)
    met = after.regime != Regime.NO_IMPACT
    assert 100 < met.sum() < 300
    arm = levers["offset"] - body.radius[:, None] * normal
    for who, lever, v, w, v_after, w_after, impulse in (
        (body, arm, velocity, spin, after.velocity, after.spin, after.impulse),
        (
            *(other, levers["other_offset"] + other.radius[:, None] * normal),
            *(other_velocity, other_spin, after.other_velocity, after.other_spin, -after.impulse),
        ),
    ):
        mass, moment = who.mass[:, None], (who.mass * who.gyration**2)[:, None]
        np.testing.assert_allclose(mass * (v_after - v), impulse, atol=1e-12)
        np.testing.assert_allclose(moment * (w_after - w), np.cross(lever, impulse), atol=1e-12)
    before = energy(body, velocity, spin) + energy(other, other_velocity, other_spin)
    then = energy(body, after.velocity, after.spin)
    then += energy(other, after.other_velocity, after.other_spin)
    np.testing.assert_allclose(before - then, after.energy_lost.sum(axis=1), atol=1e-11)
    assert (before - then > -1e-12).all()
    push = dot(after.impulse, normal)
    drag = np.linalg.norm(after.impulse - push[:, None] * normal, axis=1)
    assert (drag <= mu * push + 1e-11).all() and (push >= 0).all()
    assert set(after.model[met]) == {model or "lumped.hysteretic"}
    assert (after.velocity[~met] == velocity[~met]).all()


def test_rounding_makes_no_plane():
    """Offsets are contact points less centres, and half of them are 0 but for rounding."""
    rng, count = np.random.default_rng(7), 500
    normal, along = (np.cross(rng.normal(size=(count, 3)), rng.normal(size=3)) for _ in range(2))
    normal /= np.linalg.norm(normal, axis=1)[:, None]
    along = np.cross(normal, along)
    along /= np.linalg.norm(along, axis=1)[:, None]
    far = np.where(np.arange(count) % 2, 0.1, 0.0)[:, None]
    centre = 5 * rng.normal(size=(count, 3))
    way = centre - 0.3 * normal + far * along - centre
    offset = way - dot(way, normal)[:, None] * normal
    body = bodies.Body(1.0, 0.2, 0.3)
    pair = Pair(stiffness_ratio=1.2, friction=0.4, restitution=0.6, loss="hysteretic")
    state = 0.5 * along - normal, 2.0 * np.cross(along, normal)
    found, wanted = (collide(pair, normal, body, *state, offset=o) for o in (offset, far * along))
    np.testing.assert_allclose(found.velocity, wanted.velocity, atol=1e-12)
    assert collide(pair, UP, body, [0.5, 0, -1], [1e-17, 0, 0], offset=[1e-18, 1e-19, 0])


def test_an_offset_gives_what_noncollinear_gives():
    """A metre of slender rod falls on its tip, tilted by 45 degrees (help of `noncollinear`)."""
    half = 0.125**0.5
    rod = bodies.Body(mass=1.0, gyration=12**-0.5, radius=half)
    inverse = noncollinear.inverse_mass(1.0, 12**-0.5, offset=half, depth=half)
    known = noncollinear.rebound(0.0, 1.0, inverse, 0.5, 0.5, 1.21, loss="hysteretic")
    pair = Pair(stiffness_ratio=1.21, friction=0.5, restitution=0.5, loss="hysteretic")
    for way in (1.0, -1.0):  # the tip ahead, or behind
        found = collide(pair, UP, rod, -UP, [0, 0, 0], offset=[way * half, 0, 0])
        arm = [way * half, 0, -half]
        tip = found.velocity + np.cross(found.spin, arm)
        np.testing.assert_allclose(tip, [way * known.tangential, 0, -known.normal], atol=1e-14)
        assert found.regime == known.regime and np.isnan(found.error_bound)
    # Without an offset it is the paper's model.
    ball = bodies.solid_sphere(0.01, density=7800.0)
    state = [0.7, 0, -1.0], [0, 20.0, 0]
    centred = collide(pair, UP, ball, *state, model="lumped.hysteretic")
    assert centred.loss == "hysteretic"
    found = collide(pair, UP, ball, *state, offset=[0, 0, 0])
    np.testing.assert_allclose(found.velocity, centred.velocity, atol=1e-12)
    np.testing.assert_allclose(found.spin, centred.spin, atol=1e-9)
