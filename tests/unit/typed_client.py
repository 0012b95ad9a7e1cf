"""Code of a user, for type checkers: they must refuse the lines marked `wrong`, and no other."""

from typing import Any, assert_type

import numpy as np
from numpy.typing import NDArray

from planarimpact import (
    Pair,
    Rebound,
    Regime,
    bodies,
    collide,
    continuum,
    lumped,
    models,
    noncollinear,
    rigid,
    spheres,
)
from planarimpact.models import laws

Array = NDArray[np.float64]
OneRebound = Rebound[np.float64, Regime, int]
STEEL = bodies.Material(207e9, 0.3)


def scalars() -> None:
    v: float = lumped.rebound(1.0, loss="viscous").velocity
    name: str = lumped.rebound(incidence=2, stiffness_ratio=1.5).regime.name
    one: OneRebound = continuum.rebound(v, 3.5, restitution=0.8, loss="plastic", tolerance=1e-3)
    assert_type(one.velocity, np.float64)
    assert_type(one.regime, Regime)
    assert_type(one.reversals, int | None)
    assert_type(rigid.rebound(np.float64(2.0)), OneRebound)
    assert_type(spheres.rebound(1.0, restitution=0.9, loss="viscous", forces=False), OneRebound)
    assert_type(laws.brach(1.0, tangential_restitution=0.5), OneRebound)
    assert_type(laws.smith(1.0), OneRebound)
    u: float = models.rebound("rigid", 8.0).velocity
    print(name, u, Regime.names(one.regime))


def arrays() -> None:
    x = np.linspace(0, 8, 3)
    many: Rebound = lumped.rebound(x, 3.5, loss="unloading-stiffness")
    assert_type(many.velocity, Array)
    assert_type(many.regime, NDArray[np.integer])
    assert_type(continuum.rebound([0.5, 2], tolerance=1e-3), Rebound)
    assert_type(rigid.rebound(2.0, restitution=[0.5, 0.9]), Rebound)
    assert_type(laws.smith(np.arange(3)), Rebound)
    assert_type(laws.brach([[1, 2], [3, 4]]), Rebound)
    assert_type(spheres.rebound(x, loss=["viscous", None, "plastic"]).velocity, Array)
    assert_type(lumped.friction_work(x), Array)
    w: Array = models.rebound("lumped.viscous", x).velocity
    print(Regime.names(many.regime), w)


def bodies_in_space() -> None:
    pair = Pair(STEEL, friction=0.2, restitution=[0.9, 0.8], loss="plastic")
    ball = bodies.solid_sphere(0.01, density=7800)
    after = collide(pair, [0, 0, 1], ball, (0.8, 0.0, -2.0), np.zeros(3))
    rod = noncollinear.inverse_mass(1.0, 0.3, offset=0.35, depth=0.35)
    tip = noncollinear.rebound(0.0, 1.0, rod, friction=0.5, restitution=0.5, loss="hysteretic")
    if isinstance(tip.regime, Regime):  # as the type of a body does not say whether it is one
        print(tip.regime.name)
    print(after.velocity, Regime.names(after.regime), Regime.names(tip.regime))


def refused(text: str, unknown: Any) -> None:
    lumped.rebound(1.0, loss="plastic")  # wrong
    lumped.rebound([1.0], loss=text)  # wrong
    continuum.rebound(1.0, restitution=0.8, loss="hysteretic")  # wrong
    spheres.rebound(1.0, restitution=0.8, loss="hysteretic")  # wrong
    noncollinear.rebound(0.0, 1.0, unknown, 0.5, 0.5, loss="viscous")  # wrong
    Pair(STEEL, friction=0.2, restitution=0.8, loss="elastic")  # wrong
    bodies.peak_force(1.0, 1.0, 1.0, 1.0, 0.8, "hysteretic")  # wrong
    lumped.history(1.0, loss="plastic")  # wrong
    lumped.rebound("1.0")  # wrong
    rigid.rebound(["1.0"])  # wrong
    rigid.rebound(1.0, loss="viscous")  # wrong
    continuum.rebound(1.0, restitutions=0.5)  # wrong
    collide(unknown, "up", unknown, unknown, unknown)  # wrong
    s: str = rigid.rebound(1.0).velocity  # wrong
    x: float = rigid.rebound([1.0]).velocity  # wrong
    print(rigid.rebound([1.0]).regime.name, s, x)  # wrong
