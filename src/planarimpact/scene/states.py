"""From the columns of a table to impacts, and from states back to columns.

A plane state stands in the plane of x (tangential) and z (normal): its normal velocity is positive
towards the surface and its spin, positive where it moves the contact point in the tangential
direction, turns about -y. In space the spin is the right-handed vector of angular velocity.
"""

from typing import Any, NamedTuple

import numpy as np

from planarimpact import bodies
from planarimpact.bodies import Body, Material
from planarimpact.collision import RESTITUTION_FROM, Pair, mechanics
from planarimpact.collision.mechanics import Impacts, State
from planarimpact.common.arrays import Array
from planarimpact.common.checks import LARGEST
from planarimpact.common.losses import CODES, SPHERES, VISCOUS
from planarimpact.scene.columns import AXES, PLANE


class Rows(NamedTuple):
    """Impacts of the rows of a table, and what only a table tells: arrays of shape (n,)."""

    impacts: Impacts
    peak_normal: Array  # largest normal force by the law of the loss [N], NaN where it has none
    coupling: Array  # size of Dundurs' constant over friction, see `bodies.COUPLING`


def rows(values: dict[str, Any]) -> Rows:
    """Rows of columns as `columns.numbers` returns them, without bad ones.

    OutOfRange is that of `mechanics.impacts`.
    """
    body, other = _body(values, ""), _body(values, "other_")
    before, other_before = _state(values, ""), _state(values, "other_")
    material, other_material = materials = _materials(values)
    law = {name: values[name] for name in (*RESTITUTION_FROM, "loss") if name in values}
    both = (material,) if other_material is None else (material, other_material)
    pair = Pair(*both, friction=values["friction"], **law)
    impacts = mechanics.impacts(pair, _normal(values), body, before, other, other_before)
    with np.errstate(divide="ignore", invalid="ignore"):  # without friction nothing resists
        coupling = np.abs(bodies.dundurs(*materials)) / values["friction"]
    radius = bodies.radius_of_two(body.radius, other.radius)
    return Rows(impacts, _peak_normal(impacts, pair.effective_modulus, radius), coupling)


def _peak_normal(impacts: Impacts, modulus: Array, radius: Array) -> Array:
    """Largest normal force by the law of the loss [N].

    Both laws have one from `bodies.LEAST_RESTITUTION` on. Below it they are NaN: a viscous one
    grows without a bound as e approaches 0, and a plastic one falls to 0.
    """
    known = impacts.restitution >= bodies.LEAST_RESTITUTION
    speed = np.where(impacts.v2 > 0, impacts.v2, 1.0)  # others are refused later
    peak = np.full(speed.size, np.nan)
    code = np.where(
        impacts.loss_code < 0, CODES[VISCOUS], impacts.loss_code
    )  # at e = 1 any of them
    for loss in SPHERES.values():
        which = known & (code == CODES[loss])
        if which.any():
            # All impacts are computed, so that a refusal has the index of its row.
            e = np.where(which, impacts.restitution, 1.0)
            force = bodies.peak_force(impacts.m2, radius, modulus, speed, e, loss.name)
            peak = np.where(which, force, peak)
    return peak


def columns_of(state: State, plane: bool) -> dict[str, Array]:
    """Columns of a state, by name: those of a plane state, or of three axes."""
    if plane:
        return {
            "velocity_tangential": state.velocity[0],
            "velocity_normal": -state.velocity[2],
            "spin": -state.spin[1],
        }
    named = {f"velocity_{axis}": row for axis, row in zip(AXES, state.velocity, strict=True)}
    return named | {f"spin_{axis}": row for axis, row in zip(AXES, state.spin, strict=True)}


def _body(values: dict[str, Array], prefix: str) -> Body:
    """A body; the other one is a wall of infinite mass where it has no mass."""
    count = values["radius"].size
    radius = values.get(f"{prefix}radius", np.zeros(count))
    if f"{prefix}density" in values:
        return bodies.solid_sphere(radius, values[f"{prefix}density"])
    wall = np.full(count, np.inf)
    mass, gyration = (values.get(f"{prefix}{name}", wall) for name in ("mass", "gyration"))
    # The radius of a body that can neither move nor turn may be infinite: it is flat.
    return Body(mass, gyration, np.where(np.isinf(radius), 0.0, radius))


def _materials(values: dict[str, Array]) -> tuple[Material, Material | None]:
    material = Material(values["young_modulus"], values["poisson_ratio"])
    if "other_young_modulus" not in values:
        return material, None
    young, poisson = values["other_young_modulus"], values["other_poisson_ratio"]
    # A rigid counterbody adds no compliance. The largest modulus of all has the same effect.
    young = np.where(np.isinf(young), LARGEST, young)
    return material, Material(young, poisson)


def _normal(values: dict[str, Array]) -> Array:
    if "normal_x" in values:
        return np.stack([values[f"normal_{axis}"] for axis in AXES])
    return np.broadcast_to(np.array([[0.0], [0.0], [1.0]]), (3, values["radius"].size))


def _state(values: dict[str, Array], prefix: str) -> State:
    """A state; what is left out is 0."""
    zero = np.zeros(values["radius"].size)
    if {f"{prefix}velocity_x", f"{prefix}spin_x"} & set(values):
        vectors = [
            np.stack([values.get(f"{prefix}{quantity}_{axis}", zero) for axis in AXES])
            for quantity in ("velocity", "spin")
        ]
        return State(*vectors)
    along, towards, spin = (values.get(f"{prefix}{name}", zero) for name in PLANE)
    return State(np.stack([along, zero, -towards]), np.stack([zero, -spin, zero]))
