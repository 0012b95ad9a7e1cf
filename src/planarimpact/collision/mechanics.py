"""From the state of two bodies before an impact to its groups, and on to the state after it.

Vectors are arrays of shape (3, n) in any axes. The unit normal n points from the other body, or the
surface, to the body; contact points lie at -radius n from the body's centre and at +radius n from
the other's. Spin is the right-handed vector of angular velocity.
"""

from typing import Any, NamedTuple

import numpy as np

from planarimpact import bodies, continuum
from planarimpact.bodies import Body
from planarimpact.collision.pairs import Pair
from planarimpact.common import checks, sliding
from planarimpact.common.arrays import Array, Booleans, Integers
from planarimpact.common.losses import CODES, NAMES, PLASTIC, SPHERES
from planarimpact.continuum import inelastic

# Restitution at the speed of an impact, by the quantity of a pair that it follows from.
RESTITUTION_BY = {
    "relaxation_time": bodies.viscous_restitution,
    "yield_pressure": bodies.plastic_restitution,
}


class State(NamedTuple):
    """Velocity of a centre [m/s] and spin [rad/s], arrays of shape (3, n) or (3, 1)."""

    velocity: Array
    spin: Array


class Impacts(NamedTuple):
    """Impacts: bodies, the direction of contact, states, and what follows from them.

    Arrays of shape (n,), except vectors, (3, n); `other` bodies at infinity have infinite mass.
    """

    body: Body
    other: Body
    normal: Array
    before: State
    other_before: State
    tangent: Array  # unit vector of v1(0), 0 where there is none
    v1: Array  # tangential velocity of contact, at least 0 [m/s]
    v2: Array  # normal velocity of approach [m/s]; the bodies meet where it is above 0
    friction: Array
    restitution: Array
    loss_code: Integers  # of `losses.NAMES`, -1 where e = 1
    m2: Array  # normal effective mass [kg]
    mass_ratio: Array
    stiffness_ratio: Array
    dundurs: Array  # size of Dundurs' constant, NaN where it is not known

    @property
    def unit(self) -> Array:
        """The scale of tangential velocity: mu v2(0), but at most v1(0)/LEAST_INCIDENCE [m/s]."""
        return np.minimum(self.friction * self.v2, self.v1 / checks.LEAST_INCIDENCE)

    def groups_of(self, rows: Integers) -> tuple[Array, Array, Array]:
        """Mass ratio, stiffness ratio and restitution of some impacts."""
        return self.mass_ratio[rows], self.stiffness_ratio[rows], self.restitution[rows]

    def incidence_of(self, rows: Integers) -> Array:
        """v1(0)/unit of some impacts: 0 where v1(0) = 0, else infinite without friction."""
        v1 = self.v1[rows]
        with np.errstate(divide="ignore", over="ignore", invalid="ignore"):  # tiny friction or none
            return np.where(v1 > 0, v1 / self.unit[rows], 0.0)

    def take(self, rows: Integers) -> "Impacts":
        """Some of the impacts."""
        return Impacts._make(taken(field, rows, self.v2.size) for field in self)


def taken(field: Any, rows: Integers, count: int) -> Any:
    """Some of `count` entries of an array, or of the arrays of a tuple; one stands for all."""
    if field is None:  # left out, as nobody needs it
        return None
    if isinstance(field, tuple):
        return type(field)(*(taken(part, rows, count) for part in field))
    return np.broadcast_to(field, (*field.shape[:-1], count))[..., rows]


def impacts(
    pair: Pair, normal: Array, body: Body, before: State, other: Body, other_before: State
) -> Impacts:
    """Impacts of bodies, arrays of shape (n,), whose states and normals have the shape (3, n).

    v2 may be 0 or negative, where nothing approaches. OutOfRange says where a velocity of contact,
    a mass or a mass ratio is beyond the rule of sizes, or a relaxation time beyond its law.
    `problems_of_normals` finds other normals.
    """
    normal = unit_normal(normal)
    relative = contact_velocity(before, body, -normal)
    relative = relative - contact_velocity(other_before, other, normal)
    along = dot(relative, normal)
    sideways = relative - along * normal
    v1, v2 = np.hypot(np.hypot(*sideways[:2]), sideways[2]), -along
    checks.in_range("tangential velocity of contact", v1, 0.0)
    checks.in_range("normal velocity of approach", np.where(v2 > 0, v2, 1.0))
    _, m2 = bodies.effective_masses(body, other)
    e = restitution(pair, body, other, m2, v2)
    return Impacts(
        body,
        other,
        normal,
        before,
        other_before,
        sideways / np.where(v1 > 0, v1, 1.0),
        v1,
        v2,
        pair.friction,
        e,
        np.where(e == 1, np.int8(-1), pair.loss_code),
        m2,
        bodies.mass_ratio(body, other),
        pair.stiffness_ratio,
        pair.dundurs,
    )


def unit_normal(normal: Array) -> Array:
    """Normals, divided by their length if it is within 1e-6 of 1.

    Else energy would grow by a share of that error, and a head-on impact would have an incidence.
    """
    length = np.sqrt(dot(normal, normal))
    return normal / np.where(np.abs(length - 1) <= checks.LENGTH_ERROR, length, 1.0)


def slides_throughout(impacts: Impacts) -> Booleans:
    """Whether each impact slides from first to last."""
    unit = impacts.unit
    groups = impacts.mass_ratio, impacts.stiffness_ratio, impacts.restitution
    slides = impacts.v1 >= sliding.limit_alike(*groups) * unit
    # Spheres that yield may slide from a larger incidence on, at e = 0 from none.
    yields = np.flatnonzero(slides & (impacts.loss_code == CODES[PLASTIC]))
    known = yields[impacts.restitution[yields] > 0]
    slides[yields] = False
    if known.size:
        beta, zeta2, e = impacts.groups_of(known)
        limit = inelastic.MOTIONS[PLASTIC](e).slides_from(beta, zeta2)
        slides[known] = impacts.v1[known] >= limit * unit[known]
    return slides


def problems(impacts: Impacts) -> dict[int, str]:
    """What is wrong with an impact as a whole, but for its normal: `{index: message}`."""
    least = continuum.LEAST_RESTITUTION
    low = np.flatnonzero((impacts.restitution < least) & (impacts.v1 > 0))
    if low.size:
        low = low[~slides_throughout(impacts.take(low))]
    messages = {}  # the last one of several problems counts
    for i in np.flatnonzero(impacts.loss_code >= len(CODES)).tolist():
        loss = NAMES[impacts.loss_code[i]]
        messages[i] = (
            f"loss = '{loss}': the continuum has no such loss; allowed are "
            f"{' and '.join(SPHERES)}, or model = 'lumped.{loss}'"
        )
    for i in np.flatnonzero(~(impacts.v2 > 0)).tolist():
        messages[i] = (
            f"normal velocity of approach = {impacts.v2[i]:g}: the bodies must approach each other"
        )
    for i in low.tolist():
        messages[i] = (
            f"restitution = {impacts.restitution[i]}: allowed are numbers from {least} where the "
            "contact sticks at some time"
        )
    return messages


def problems_of_normals(normal: Array) -> dict[int, str]:
    """Which normals, shape (3, n), are no unit vectors: `{index: message}`."""
    length = np.sqrt(dot(normal, normal))
    wrong = np.flatnonzero(~(np.abs(length - 1) <= checks.LENGTH_ERROR)).tolist()
    said = "the normal has the length {:.9g}: allowed is 1, within 1e-6"
    return {i: said.format(length[i]) for i in wrong}


def after(impacts: Impacts, change: Array) -> tuple[State, State, Array]:
    """States of the body and the other one after the impact, and the impulse on the body [N s].

    `change` is that of the velocity of the contact point along `impacts.tangent` [m/s].
    """
    # P1 = m1 (v1(tf) - v1(0)), m1 = m2/beta; P2 = (1 + e) m2 v2(0). Both are divided by m2.
    impulse = (
        change / impacts.mass_ratio * impacts.tangent
        + (1 + impacts.restitution) * impacts.v2 * impacts.normal
    )
    m2 = impacts.m2
    state = _after_impulse(impacts.before, impacts.body, m2, impulse, -impacts.normal)
    other = _after_impulse(impacts.other_before, impacts.other, m2, -impulse, impacts.normal)
    return state, other, impulse * m2


def energies_lost(impacts: Impacts, change: Array) -> tuple[Array, Array]:
    """Kinetic energy lost by both bodies [J]: along the normal, and along the surface."""
    e = impacts.restitution
    m1 = impacts.m2 / impacts.mass_ratio
    normal = (1 - e) * (1 + e) * (impacts.m2 / 2 * impacts.v2**2)
    return normal, -m1 / 2 * change * (2 * impacts.v1 + change)


def contact_velocity(state: State, body: Body, towards: Array) -> Array:
    """Velocity of the contact point, at the body's radius in the direction `towards`."""
    return state.velocity + body.radius * np.stack(cross(state.spin, towards))


def _after_impulse(state: State, body: Body, m2: Array, impulse: Array, towards: Array) -> State:
    """State after an impulse at the contact point, which is given over m2."""
    change = impulse * (m2 / body.mass)
    turn = np.stack(cross(towards, change)) * (body.radius / body.gyration) / body.gyration
    return State(state.velocity + change, state.spin + turn)


def dot(a: Any, b: Any) -> Any:
    """Products of vectors, shape (3, n), or of two of three floats."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a: Any, b: Any) -> list[Any]:
    """Components of right-handed products; NumPy's own function takes three times as long."""
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def restitution(pair: Pair, body: Body, other: Body, m2: Array, v2: Array) -> Array:
    """Restitution: that of the pair, or what its material has at the speed of each impact."""
    e = pair.restitution
    for name, law in RESTITUTION_BY.items():
        value = getattr(pair, name)
        has = ~np.isnan(value)
        if has.any():
            # All impacts are computed, so that a refusal has the index of its row: with a small
            # number for each quantity where there is no such law, or nothing approaches.
            meets = has & (v2 > 0)
            radius = bodies.radius_of_two(body.radius, other.radius)
            quantities = m2, radius, pair.effective_modulus, v2, value
            of_meeting = law(*(np.where(meets, quantity, 1e-3) for quantity in quantities))
            e = np.where(has, of_meeting, e)
    return e
