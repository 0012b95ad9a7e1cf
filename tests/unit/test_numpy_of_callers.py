"""What callers do changes no answer: with NumPy's error state, an empty mask, pickle and copies."""

import copy
import pickle
from functools import partial, update_wrapper

import numpy as np
import pandas as pd
import pytest

from planarimpact import (
    ConvergenceError,
    InputError,
    Pair,
    bodies,
    collide,
    collision,
    continuum,
    fit,
    lumped,
    models,
    noncollinear,
    scene,
    spheres,
)
from planarimpact.bodies import Body, Motion
from planarimpact.continuum import micro_slip
from planarimpact.models import laws
from planarimpact.noncollinear import rigid
from planarimpact.normal_impact import hertz
from planarimpact.spheres import table

WIDE = np.array([1e-300, 0.0, 0.7, 2.3, 8.0, 1e100])
COARSE = {f"continuum{loss}": {"tolerance": 0.1} for loss in ("", ".viscous", ".plastic")}
ROD = noncollinear.inverse_mass(1.0, 12**-0.5, offset=0.2, depth=0.4)
LOSS = {"loss": "hysteretic"}
TINY = 1e-300
CALLS = [
    *(partial(models.rebound, name, WIDE, **COARSE.get(name, {})) for name in models.MODELS),
    *(partial(lumped.history, x, samples=9) for x in (TINY, 0.0, 2.3)),
    *(partial(continuum.history, x, tolerance=0.1) for x in (TINY, 0.0, 2.3)),
    *(partial(f, TINY) for f in (hertz.velocity, hertz.state, hertz.phase_at, hertz.time)),
    partial(lumped.slip_throughout_limit, 3.5, [1e-12, 1e12], 1e-12),
    partial(lumped.friction_work, TINY),
    partial(laws.brach, TINY, tangential_restitution=TINY),
    partial(micro_slip.friction, [1e-6, 1.0], [TINY, 1e-200]),
    partial(noncollinear.rebound, [TINY, 0, 2, 1e50], 1, ROD, 0.5, [1e-12, 0, 1, 1], **LOSS),
    partial(noncollinear.history, TINY, 1.0, ROD, 0.5, 0.5, samples=9, **LOSS),
    partial(noncollinear.history, 2.0, 1.0, ROD, 1.6, 0.5, samples=9, **LOSS),
    partial(noncollinear.kinetic_energy, TINY, TINY, ROD),
    partial(noncollinear.combined, ROD, noncollinear.inverse_mass(1e99, 1e50, 1e-100, 1e-100)),
    partial(rigid.rebound, [TINY, 0.0, 0.5, 1e100], 1.0, ROD, 0.5, 0.5),
    partial(bodies.mass_ratio, Body(1.0, 1e100, 1e-100)),
    partial(bodies.effective_radius, 1e-100, 1e100),
    partial(bodies.contact_velocity, 0.0, 1.0, 1e-200, 1e-200),
    partial(bodies.incidence, TINY, 1.0, 1e100),
    partial(bodies.incidence_from_angle, TINY, 1e100),
    partial(bodies.rebound_motion, Body(1, 1, 1), Motion(TINY, 1e-100, TINY), 1e-10, 0.5, 0.5),
]


def to_the_bit(call):
    with np.printoptions(floatmode="unique", threshold=10**6):
        return repr(call())


@pytest.mark.parametrize("call", CALLS, ids=lambda call: f"{call.func.__name__}{call.args}"[:40])
def test_the_error_state_of_the_caller_changes_nothing(call):
    usual = to_the_bit(call)
    for state in ("raise", "ignore"):
        with np.errstate(all=state):
            assert to_the_bit(call) == usual


def test_an_empty_mask_is_none():
    whole = np.ma.array([0.5, 0.75], mask=[False, False])
    assert repr(lumped.rebound(whole)) == repr(lumped.rebound(whole.data))
    assert repr(lumped.rebound([whole, whole])) == repr(lumped.rebound([whole.data] * 2))


STEEL, BALL = bodies.Material(207e9, 0.3), Body(0.1, 4e-3, 0.01)
PAIR = Pair(STEEL, friction=0.3, restitution=[0.8, 0.9], loss="plastic")
MANY = PAIR[np.zeros(99, int)]


def half(x, mass_ratio, stiffness_ratio, restitution):
    return np.maximum(x - (1 + restitution) * mass_ratio, -0.5 * x)


decorated = laws.of_velocity(half)
update_wrapper(decorated, half).__qualname__ = "decorated"  # as by its `@`


OBJECTS = [
    *(call() for call in CALLS),
    *(collide(pair, [0, 0, 1], BALL, [1, 0, -3.0], [0, 2.0, 0]) for pair in (PAIR[0], PAIR, MANY)),
    *(STEEL, BALL, PAIR, scene.Report(0.1, "viscous"), bodies.contact(BALL, STEEL)),
    *(fit.fit("yade", incidence_max=2.0), *fit.CODES.values(), *collision.presets().values()),
    *(*models.MODELS.values(), models.Model("half", laws.of_velocity(half)), decorated),
    *(InputError("refused"), bodies.OutOfRange({1: "too large"}), ConvergenceError("given up")),
    *[continuum.Unsolved("needs more steps", np.array([1, 2]))],
]


def pickled(thing):
    return pickle.loads(pickle.dumps(thing))


def contents(thing):
    """All that something holds, as pickle takes it apart."""
    if isinstance(thing, dict):
        return {key: contents(value) for key, value in thing.items()}
    if isinstance(thing, list | tuple):
        return [type(thing).__name__, *map(contents, thing)]
    if isinstance(thing, type):  # which has a name
        return thing
    ours = type(thing).__module__.startswith(("planarimpact", "functools"))
    return contents(thing.__reduce_ex__(4)) if ours else thing


@pytest.mark.parametrize("again", [pickled, copy.deepcopy, copy.copy])
@pytest.mark.parametrize("thing", OBJECTS, ids=lambda thing: type(thing).__name__)
def test_what_is_given_survives_pickle_and_copies(thing, again):
    found = again(thing)
    np.testing.assert_equal(contents(found), contents(thing))
    if isinstance(thing, collision.Collision):  # still lazy, and not much larger than its data
        data = sum(getattr(value, "nbytes", 0) for value in vars(thing).values())
        assert "model_form" not in vars(found) and len(pickle.dumps(thing)) < 1.6 * data + 2000
        np.testing.assert_array_equal(found.model_form, again(thing).model_form)


@pytest.mark.parametrize("kind", ["object", "string", "category", "Sparse[object]"])
def test_losses_may_be_a_column_of_pandas(kind):
    """In which one is missing where nothing is lost."""
    groups = {
        "restitution": [0.8, 1.0, 0.8],
        "loss": pd.Series(["plastic", None, "viscous"], dtype=kind),
    }
    assert Pair(STEEL, friction=0.3, **groups).loss.tolist() == ["plastic", "none", "viscous"]
    wanted = spheres.rebound(
        2.0, restitution=[0.8, 1.0, 0.8], loss=["plastic", "viscous", "viscous"]
    )
    assert to_the_bit(partial(spheres.rebound, 2.0, **groups)) == to_the_bit(lambda: wanted)


def test_the_table_of_spheres_indexes_with_the_integers_of_the_platform(monkeypatch):
    """Its files have int64, which NumPy does not cast to an index on 32 bits (Pyodide)."""
    monkeypatch.setattr(np, "intp", np.int32)
    panels = table.shipped.__wrapped__("coarse").panels.values()
    assert {panel.intervals.dtype for panel in panels} == {np.dtype(np.int32)}
