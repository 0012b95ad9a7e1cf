"""Bodies that strike off their centre, with vectors: `planarimpact.noncollinear` in one plane.

The way from a centre of mass to the point of contact has a part along the normal, the radius, and
one along the surface, the offset. A body has one radius of gyration, about the axis across the
plane of offset and normal, so that all motion must be in that plane.
"""

from __future__ import annotations

from functools import partial
from typing import Any, NamedTuple

import numpy as np

from planarimpact import bodies, noncollinear
from planarimpact.bodies import Body
from planarimpact.collision import mechanics, methods
from planarimpact.collision.mechanics import Impacts, State, cross, dot
from planarimpact.collision.methods import Answers
from planarimpact.collision.pairs import Pair
from planarimpact.common import checks
from planarimpact.common.arrays import Array, Integers
from planarimpact.common.checks import OutOfRange
from planarimpact.common.losses import NAMES, NONCOLLINEAR
from planarimpact.common.results import Regime
from planarimpact.models import MODELS, Model
from planarimpact.noncollinear import InverseMass, NoncollinearRebound

# Models of such an impact; the loss of the pair decides if none is asked for.
LUMPED = {name: MODELS[f"lumped.{name}"] for name in NONCOLLINEAR}
CHOICES = (*LUMPED.values(), MODELS["rigid"])
ALLOWED = f"allowed is {' or '.join(LUMPED)}"
GIVEN_UP = "the solver of bodies off their centre gave up; see noncollinear.rebound"
# Share of a vector that may be out of the plane.
OUT = checks.LENGTH_ERROR


class Plane(NamedTuple):
    """The plane of motion of each impact, vectors of shape (3, n)."""

    along: Array  # unit vector along the surface
    arm: Array  # from the body's centre to the contact point [m]
    other_arm: Array
    mass: InverseMass  # of both


def impacts(
    pair: Pair,
    normal: Array,
    body: Body,
    before: State,
    other: Body,
    other_before: State,
    offset: Array,
    other_offset: Array,
) -> tuple[Impacts, Plane]:
    """As `mechanics.impacts`, for bodies with an offset; OutOfRange also of what is out of plane.

    The plane is that of the first of the two offsets that is not 0, else that of the motion.
    """
    normal = mechanics.unit_normal(normal)
    bodies.effective_masses(body, other)  # refuses two walls
    arm, other_arm = offset - body.radius * normal, other_offset + other.radius * normal
    relative = before.velocity + np.stack(cross(before.spin, arm))
    relative = relative - other_before.velocity - np.stack(cross(other_before.spin, other_arm))
    along = np.zeros_like(normal)
    anywhere = np.eye(3)[:, np.argmin(np.abs(normal), axis=0)]
    # Lengths and speeds that count, so that rounding of what is 0 does not make a plane.
    length = np.max([_size(arm), _size(other_arm)], axis=0)
    speed = _size(before.velocity) + _size(other_before.velocity)
    speed = speed + length * (_size(before.spin) + _size(other_before.spin))
    for vector, least in (
        (offset, OUT * length),
        (other_offset, OUT * length),
        (relative, OUT * speed),
        (anywhere, 0.0),
    ):
        direction = vector - dot(vector, normal) * normal
        counts = ~np.any(along != 0, axis=0) & (_size(direction) > least)
        along = np.where(counts, direction / np.where(counts, _size(direction), 1.0), along)
    along = along * np.where(dot(along, relative) < 0, -1.0, 1.0)
    across = np.stack(cross(along, normal))
    approach = before.velocity - other_before.velocity  # both may drift together
    v1, v2 = dot(relative, along), -dot(relative, normal)
    checks.in_range("tangential velocity of contact", v1, 0.0)
    checks.in_range("normal velocity of approach", np.where(v2 > 0, v2, 1.0))
    surface = "along the surface; the radius is the part along the normal"
    plane, axis = (f"{where} the plane of offset and normal" for where in ("in", "across"))
    for name, vector, out, arms, scale, allowed in (
        ("offset", offset, normal, 1.0, length, surface),
        ("other_offset", other_offset, normal, 1.0, length, surface),
        ("other_offset", other_offset, across, 1.0, length, plane),
        ("velocity - other_velocity", approach, across, 1.0, speed, plane),
        ("spin", before.spin, along, length, speed, axis),
        ("spin", before.spin, normal, length, speed, axis),
        ("other_spin", other_before.spin, along, length, speed, axis),
        ("other_spin", other_before.spin, normal, length, speed, axis),
    ):
        # Bodies that do not approach are left as they are.
        wrong = np.flatnonzero((v2 > 0) & ~(arms * np.abs(dot(vector, out)) <= OUT * scale))
        if wrong.size:
            said = f"{name} = {{}}: allowed is a vector {allowed}"
            raise OutOfRange({i: said.format(vector[:, i].tolist()) for i in wrong.tolist()})
    own = noncollinear.of_arrays(*body[:2], dot(offset, along), body.radius)
    others = noncollinear.of_arrays(*other[:2], dot(other_offset, along), -other.radius)
    mass = InverseMass(*map(np.add, own, others))
    m2 = 1 / np.asarray(mass.normal)
    restitution = mechanics.restitution(pair, body, other, m2, v2)
    loss_code = np.where(restitution == 1, np.int8(-1), pair.loss_code)
    numbers = v1, v2, pair.friction, restitution, loss_code, m2, m2 * mass.tangential
    materials = pair.stiffness_ratio, pair.dundurs
    given = body, other, normal, before, other_before, along
    return Impacts._make([*given, *numbers, *materials]), Plane(along, arm, other_arm, mass)


def _size(vector: Array) -> Array:
    """Lengths of vectors, shape (3, n)."""
    return np.sqrt(dot(vector, vector))


def answers(
    impacts: Impacts, plane: Plane, model: Model | None
) -> tuple[Answers, Array, tuple[Array, Array]]:
    """Answers to impacts, the impulses of friction and normal force [N s], and `Facts.energies`.

    Without a model the loss of the pair decides; elastic contacts are hysteretic.
    """
    count = impacts.v1.size
    fields = [np.zeros(count) for _ in range(5)]
    velocity, friction, push, normal_loss, work = fields
    place, error = np.full(count, methods.ASKED), np.full(count, np.nan)
    regime = np.full(count, Regime.UNRESOLVED, np.uint8)
    result = Answers(place, np.zeros(count), velocity, error, regime, error, {}, {})
    names = np.where(impacts.loss_code < 0, "hysteretic", NAMES[impacts.loss_code])
    for name in np.unique(names).tolist():
        chosen, rows = model or LUMPED.get(name), np.flatnonzero(names == name)
        if chosen is None:
            said = f"loss = '{name}': with an offset {ALLOWED}, or one of these as model"
            result.refused.update(dict.fromkeys(rows.tolist(), said))
            continue
        if model is None:
            place[rows] += [*LUMPED].index(name)
        rebound = partial(_rebound, chosen, impacts, plane.mass, rows)
        found = methods.tried(rebound, rows, result)
        if not found:
            continue
        velocity[rows], _, friction[rows], push[rows] = found[:4]
        if isinstance(found, NoncollinearRebound):
            regime[rows], normal_loss[rows], work[rows] = (
                found.regime,
                found.hysteresis,
                found.friction_work,
            )
            given_up = rows[np.isnan(found.tangential)]
            result.unsolved.update(dict.fromkeys(given_up.tolist(), GIVEN_UP))
        else:  # the work of each impulse; their sum is exact
            normal_loss[rows] = found.normal_impulse * (impacts.v2[rows] + found.normal) / 2
            work[rows] = found.tangential_impulse * (impacts.v1[rows] + found.tangential) / 2
            limit = impacts.friction[rows] * found.normal_impulse * (1 - 1e-12)
            slides = (found.tangential > 0) & (found.tangential_impulse >= limit)
            regime[rows[slides]] = Regime.SLIP_THROUGHOUT
            regime[rows[found.tangential == 0]] = Regime.SLIP_STICK
    result.change[:] = velocity - impacts.v1
    return result, np.array([friction, push]), (normal_loss, work)


def _rebound(
    model: Model, impacts: Impacts, mass: InverseMass, rows: Integers, part: slice | int
) -> Any:
    """A part of the rows by `noncollinear`, or without compliance; what it gives up is NaN."""
    rows = rows[part]
    inverse_mass = InverseMass(*(np.asarray(entry)[rows] for entry in mass))
    v1, v2, e = impacts.v1[rows], impacts.v2[rows], impacts.restitution[rows]
    mu, zeta2 = impacts.friction[rows], impacts.stiffness_ratio[rows]
    if model is MODELS["rigid"]:
        return noncollinear.rigid.rebound(v1, v2, inverse_mass, mu, e)
    return noncollinear.solved(v1, v2, inverse_mass, mu, e, zeta2, 1.0, model.loss)[0]


def after(impacts: Impacts, plane: Plane, impulses: Array) -> tuple[State, State, Array]:
    """As `mechanics.after`, by the impulses of friction and normal force, shape (2, n) [N s]."""
    impulse = impulses[1] * impacts.normal - impulses[0] * plane.along
    states = []
    for body, before, arm, own in (
        (impacts.body, impacts.before, plane.arm, impulse),
        (impacts.other, impacts.other_before, plane.other_arm, -impulse),
    ):
        turn = np.stack(cross(arm / body.gyration, own / body.mass)) / body.gyration
        states.append(State(before.velocity + own / body.mass, before.spin + turn))
    return *states, impulse
