"""From the state of two bodies before an impact to its groups, and on to the state after it.

Vectors are arrays of shape (3, n) in the axes of the table. The unit normal n points from the
other body, or the surface, to the body; contact points lie at -radius n from the body's centre and
at +radius n from the other's. A plane state stands in the plane of x (tangential) and z (normal):
its normal velocity is positive towards the surface and its spin, positive where it moves the
contact point in the tangential direction, turns about -y. In space the spin is the right-handed
vector of angular velocity.
"""

from typing import NamedTuple

import numpy as np

from planarimpact import bodies, continuum
from planarimpact.bodies import Body, Material
from planarimpact.continuum import inelastic
from planarimpact.ground import sliding
from planarimpact.ground.arrays import Array, Booleans, Integers
from planarimpact.scene.columns import AXES, LOSSES

# Largest error of the length of a normal.
UNIT = 1e-6
# Largest mass ratio m2/m1: beyond it no digit of the rebound is certain.
LARGEST_RATIO = 1e12


class State(NamedTuple):
    """Velocity of a centre [m/s] and spin [rad/s], arrays of shape (3, n) or (3, 1)."""

    velocity: Array
    spin: Array


class Impacts(NamedTuple):
    """Impacts of a table: bodies, the direction of contact, states, and what follows from them.

    Arrays of shape (n,), except vectors, (3, n); `other` bodies at infinity have infinite mass.
    """

    body: Body
    other: Body
    normal: Array
    before: State
    other_before: State
    tangent: Array  # unit vector of v1(0), 0 where there is none
    v1: Array  # tangential velocity of contact, at least 0 [m/s]
    v2: Array  # normal velocity of approach [m/s]
    friction: Array
    restitution: Array
    plastic: Booleans  # else viscous; no meaning where e = 1
    m2: Array  # normal effective mass [kg]
    mass_ratio: Array
    stiffness_ratio: Array
    peak_normal: Array  # largest normal force by the law of the loss [N], NaN where it has none
    coupling: Array  # size of Dundurs' constant over friction, see `bodies.COUPLING`

    @property
    def unit(self) -> Array:
        """The scale of tangential velocity, mu v2(0) [m/s]."""
        return self.friction * self.v2

    def groups_of(self, rows: Integers) -> tuple[Array, Array, Array]:
        """Mass ratio, stiffness ratio and restitution of some impacts."""
        return self.mass_ratio[rows], self.stiffness_ratio[rows], self.restitution[rows]

    def incidence_of(self, rows: Integers) -> Array:
        """v1(0)/(mu v2(0)) of some impacts: NaN or infinite without friction."""
        with np.errstate(divide="ignore", over="ignore", invalid="ignore"):
            return self.v1[rows] / (self.friction[rows] * self.v2[rows])


def impacts(values: dict[str, Array]) -> Impacts:
    """Impacts of columns as `columns.numbers` returns them, without bad rows.

    `loss` stands beside `restitution`. v2 may be 0 or negative, where nothing approaches, and other
    numbers may be infinite: `problems` finds that. OutOfRange says where a mass, a mass ratio or a
    force is beyond the range of numbers, or a relaxation time beyond its law.
    """
    with np.errstate(over="ignore", invalid="ignore"):  # `problems` finds what is not finite
        body, other = _body(values, ""), _body(values, "other_")
        normal = _normal(values)
        before, other_before = _state(values, ""), _state(values, "other_")
        relative = _contact_velocity(before, body, -normal)
        relative = relative - _contact_velocity(other_before, other, normal)
        along = np.sum(relative * normal, axis=0)
        sideways = relative - along * normal
        v1, v2 = np.hypot(np.hypot(*sideways[:2]), sideways[2]), -along
        _, m2 = bodies.effective_masses(body, other)
        restitution, plastic, peak_normal = _normal_impact(values, m2, v2)
        materials = _materials(values)
        with np.errstate(divide="ignore", invalid="ignore"):  # without friction nothing resists
            coupling = np.abs(bodies.dundurs(*materials)) / values["friction"]
        return Impacts(
            body,
            other,
            normal,
            before,
            other_before,
            sideways / np.where(v1 > 0, v1, 1.0),
            v1,
            v2,
            values["friction"],
            restitution,
            plastic,
            m2,
            bodies.mass_ratio(body, other),
            bodies.stiffness_ratio(*materials),
            peak_normal,
            coupling,
        )


def slides_throughout(impacts: Impacts) -> Booleans:
    """Whether each impact slides from first to last."""
    with np.errstate(over="ignore"):  # friction may stop any finite velocity
        unit = impacts.unit
        groups = impacts.mass_ratio, impacts.stiffness_ratio, impacts.restitution
        slides = impacts.v1 >= sliding.limit_alike(*groups) * unit
        # Spheres that yield may slide from a larger incidence on. The law has a least restitution.
        yields = np.flatnonzero(slides & impacts.plastic & (impacts.restitution < 1))
        known = yields[impacts.restitution[yields] >= bodies.LEAST_RESTITUTION]
        slides[yields] = False
        beta, zeta2, e = impacts.groups_of(known)
        limit = inelastic.LOSSES["plastic"](e).slides_from(beta, zeta2)
        slides[known] = impacts.v1[known] >= limit * unit[known]
    return slides


def problems(impacts: Impacts) -> dict[int, str]:
    """What is wrong with an impact as a whole: `{index: message}`.

    >>> steel = {"young_modulus": 207e9, "poisson_ratio": 0.3, "radius": 0.01, "density": 7800.0}
    >>> state = {"velocity_tangential": 1.0, "velocity_normal": -1.0, "spin": 0.0}
    >>> row = steel | state | {"friction": 0.1, "restitution": 0.5, "loss": 0}
    >>> problems(impacts({name: np.array([value]) for name, value in row.items()}))
    {0: 'normal velocity of approach = -1: the bodies must approach each other'}
    """
    length = np.sqrt(np.sum(impacts.normal**2, axis=0))
    numbers = impacts.mass_ratio, impacts.stiffness_ratio, impacts.v1
    with np.errstate(over="ignore", invalid="ignore"):
        energy = impacts.m2 * impacts.v2 * impacts.v2 + impacts.m2 * impacts.v1 * impacts.v1
        unit = impacts.unit
        spins = [_largest_turn(impacts, body) for body in (impacts.body, impacts.other)]
    finite = np.isfinite([*numbers, impacts.v2, energy, *spins]).all(axis=0)
    sticks = ~slides_throughout(impacts) & (impacts.v1 > 0)
    least = continuum.LEAST_RESTITUTION
    messages = {}  # the last one of several problems counts
    for i in np.flatnonzero(~finite).tolist():
        messages[i] = "its numbers are too large or too small to compute with"
    for i in np.flatnonzero(~(impacts.v2 > 0) & finite).tolist():
        messages[i] = (
            f"normal velocity of approach = {impacts.v2[i]:g}: the bodies must approach each other"
        )
    for i in np.flatnonzero(finite & np.isinf(unit)).tolist():
        messages[i] = (
            f"friction = {impacts.friction[i]:g} times normal velocity of approach = "
            f"{impacts.v2[i]:g} is too large a number to compute with"
        )
    for i in np.flatnonzero((impacts.restitution < least) & sticks).tolist():
        messages[i] = (
            f"restitution = {impacts.restitution[i]}: allowed are numbers from {least} where the "
            "contact sticks at some time"
        )
    for i in np.flatnonzero(impacts.mass_ratio > LARGEST_RATIO).tolist():
        messages[i] = (
            f"mass ratio m2/m1 = {impacts.mass_ratio[i]:g}: allowed are numbers up to "
            f"{LARGEST_RATIO:g}"
        )
    for i in np.flatnonzero(np.abs(length - 1) > UNIT).tolist():
        messages[i] = f"normal_x, y, z have the length {length[i]:g}: allowed is 1"
    return messages


def after(impacts: Impacts, tangential_velocity: Array) -> tuple[State, State]:
    """States of the body and the other one after the impact.

    `tangential_velocity` is that of the contact point, in the direction of `impacts.tangent` [m/s].
    """
    change = (tangential_velocity - impacts.v1) / impacts.mass_ratio
    # P1 = m1 (v1(tf) - v1(0)), m1 = m2/beta; P2 = (1 + e) m2 v2(0). Both are divided by m2, so that
    # they do not overflow in any units.
    impulse = change * impacts.tangent + (1 + impacts.restitution) * impacts.v2 * impacts.normal
    m2 = impacts.m2
    return (
        _after_impulse(impacts.before, impacts.body, m2, impulse, -impacts.normal),
        _after_impulse(impacts.other_before, impacts.other, m2, -impulse, impacts.normal),
    )


def energy_lost(impacts: Impacts, tangential_velocity: Array) -> Array:
    """Kinetic energy lost by both bodies [J]: in the normal element, and tangentially."""
    e, v1, after = impacts.restitution, impacts.v1, tangential_velocity
    # The masses come first: a square of a velocity may overflow where the energy does not.
    normal = (1 - e) * (1 + e) * (impacts.m2 / 2 * impacts.v2 * impacts.v2)
    m1 = impacts.m2 / impacts.mass_ratio
    return normal + m1 / 2 * (v1 - after) * (v1 + after)


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
    """A body; the other one is a half-space where it has no mass."""
    count = values["radius"].size
    radius = values.get(f"{prefix}radius", np.zeros(count))
    if f"{prefix}density" in values:
        return bodies.solid_sphere(radius, values[f"{prefix}density"])
    if f"{prefix}mass" not in values:
        return Body(np.full(count, np.inf), np.full(count, np.inf), np.zeros(count))
    mass, gyration = values[f"{prefix}mass"], values[f"{prefix}gyration"]
    # The radius of a body that can neither move nor turn has no effect. It may be infinite.
    radius = np.where(np.isinf(mass) & np.isinf(gyration), 0.0, radius)
    return Body(mass, gyration, radius)


def _materials(values: dict[str, Array]) -> tuple[Material, Material | None]:
    material = Material(values["young_modulus"], values["poisson_ratio"])
    if "other_young_modulus" not in values:
        return material, None
    young, poisson = values["other_young_modulus"], values["other_poisson_ratio"]
    # A rigid counterbody adds no compliance. A very large Young's modulus has the same effect.
    young = np.where(np.isinf(young), np.finfo(float).max, young)
    return material, Material(young, poisson)


def _normal(values: dict[str, Array]) -> Array:
    if "normal_x" in values:
        return np.stack([values[f"normal_{axis}"] for axis in AXES])
    return np.broadcast_to(np.array([[0.0], [0.0], [1.0]]), (3, values["radius"].size))


def _state(values: dict[str, Array], prefix: str) -> State:
    if f"{prefix}velocity_x" in values:
        return State(
            np.stack([values[f"{prefix}velocity_{axis}"] for axis in AXES]),
            np.stack([values[f"{prefix}spin_{axis}"] for axis in AXES]),
        )
    if f"{prefix}velocity_normal" not in values:
        return State(np.zeros((3, 1)), np.zeros((3, 1)))
    still = np.zeros(values[f"{prefix}spin"].size)
    return State(
        np.stack(
            [values[f"{prefix}velocity_tangential"], still, -values[f"{prefix}velocity_normal"]]
        ),
        np.stack([still, -values[f"{prefix}spin"], still]),
    )


def _contact_velocity(state: State, body: Body, towards: Array) -> Array:
    """Velocity of the contact point, at the body's radius in the direction `towards`."""
    return state.velocity + body.radius * np.cross(state.spin, towards, axis=0)


def _after_impulse(state: State, body: Body, m2: Array, impulse: Array, towards: Array) -> State:
    """State after an impulse at the contact point, which is given over m2."""
    change = impulse * (m2 / body.mass)
    turn = np.cross(towards, change, axis=0) * (body.radius / body.gyration) / body.gyration
    return State(state.velocity + change, state.spin + turn)


def _largest_turn(impacts: Impacts, body: Body) -> Array:
    """More than an impact can change the spin of a body [rad/s]."""
    change = 2 * (impacts.v1 + impacts.v2) * (impacts.m2 / body.mass)
    return change * (body.radius / body.gyration) / body.gyration


def _normal_impact(values: dict[str, Array], m2: Array, v2: Array) -> tuple[Array, Booleans, Array]:
    """Restitution, whether the loss is plastic, and the largest normal force by its law.

    Both laws give peak forces from `bodies.LEAST_RESTITUTION` on. Below it they are NaN: a viscous
    one grows without a bound as e approaches 0, and a plastic one falls to 0.
    """
    radius = bodies.effective_radius(values["radius"], values.get("other_radius", np.inf))
    modulus = bodies.effective_modulus(*_materials(values))
    approaches = (v2 > 0) & np.isfinite(v2)  # others are refused later
    speed = np.where(approaches, v2, 1.0)
    contact = m2, modulus, radius
    if "relaxation_time" in values:
        tau = np.where(approaches, values["relaxation_time"], 0.0)
        e, loss = bodies.viscous_restitution(speed, tau, *contact), np.zeros(v2.size)
    elif "yield_pressure" in values:
        pressure = values["yield_pressure"]
        e, loss = bodies.plastic_restitution(speed, pressure, *contact), np.ones(v2.size)
    else:
        e, loss = values["restitution"], values["loss"]
    known = e >= bodies.LEAST_RESTITUTION
    peak = np.full(v2.size, np.nan)
    for position, name in enumerate(LOSSES):
        rows = known & (loss == position)
        if rows.any():
            # All impacts are computed, so that a refusal has the index of its row.
            force = bodies.peak_force(m2, speed, modulus, radius, np.where(rows, e, 1.0), name)
            peak = np.where(rows, force, peak)
    return e, loss == LOSSES.index("plastic"), peak
