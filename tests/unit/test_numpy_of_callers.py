"""The error state of the caller changes no answer, nor does an empty mask."""

from functools import partial

import numpy as np
import pytest

from planarimpact import bodies, continuum, lumped, models, noncollinear
from planarimpact.bodies import Body, Motion
from planarimpact.continuum import annuli, cattaneo_mindlin, micro_slip
from planarimpact.models import laws
from planarimpact.noncollinear import rigid
from planarimpact.normal_impact import hertz

WIDE = np.array([1e-300, 0.0, 0.7, 2.3, 8.0, 1e150])
COARSE = {"annuli": {"circles": 4, "steps": 16}}
COARSE |= {f"continuum{loss}": {"tolerance": 0.1} for loss in ("", ".viscous", ".plastic")}
ROD = noncollinear.inverse_mass(1.0, 12**-0.5, offset=0.2, depth=0.4)
LOSS = {"loss": "hysteretic"}
TINY = 1e-300
CALLS = [
    *(partial(models.rebound, name, WIDE, **COARSE.get(name, {})) for name in models.MODELS),
    *(partial(lumped.history, x, samples=9) for x in (TINY, 0.0, 2.3)),
    *(partial(continuum.history, x, tolerance=0.1) for x in (TINY, 0.0, 2.3)),
    *(partial(f, TINY) for f in (hertz.velocity, hertz.state, hertz.phase_at, hertz.time)),
    partial(lumped.slip_throughout_limit, 3.5, [TINY, 1e150], TINY),
    partial(lumped.friction_work, TINY),
    partial(laws.brach, TINY, tangential_restitution=TINY),
    partial(continuum.fixed_steps, WIDE[:-1], steps=8),
    partial(annuli.friction, [1e-6, 1.0], [TINY, 1e-200], circles=4),
    partial(micro_slip.friction, [1e-6, 1.0], [TINY, 1e-200]),
    partial(cattaneo_mindlin.friction, TINY),
    partial(cattaneo_mindlin.unloading, 0.0, TINY),
    partial(cattaneo_mindlin.stick_radius, TINY),
    partial(noncollinear.rebound, [TINY, 0, 2, 1e50], 1, ROD, 0.5, [TINY, 0, 1, 1], **LOSS),
    partial(noncollinear.history, TINY, 1.0, ROD, 0.5, 0.5, samples=9, **LOSS),
    partial(noncollinear.history, 2.0, 1.0, ROD, 1.6, 0.5, samples=9, **LOSS),
    partial(noncollinear.kinetic_energy, TINY, TINY, ROD),
    partial(noncollinear.combined, ROD, noncollinear.inverse_mass(1e200, 1e150, 1e-200, 1e-200)),
    partial(noncollinear.contact_velocity, Motion(TINY, 1.0, TINY), 1e-200, 1e-200),
    partial(noncollinear.motion_after, Motion(0, 1, 0), (TINY, TINY), 1e200, 1.0, 1.0, 1.0),
    partial(rigid.rebound, [TINY, 0.0, 0.5, 1e150], 1.0, ROD, 0.5, 0.5),
    partial(bodies.mass_ratio, Body(1.0, 1e200, 1e-200)),
    partial(bodies.effective_radius, 1e-200, 1e200),
    partial(bodies.contact_velocity, 0.0, 1.0, 1e-200, 1e-200),
    partial(bodies.incidence, TINY, 1.0, 1e100),
    partial(bodies.incidence_from_angle, TINY, 1e100),
    partial(bodies.rebound_motion, Body(1, 1, 1), Motion(TINY, TINY, TINY), 1e-10, 0.5, 0.5),
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
