"""Inverse mass of a body at its contact point; its motion is that of `planarimpact.collide`.

Axes and signs as in `planarimpact.bodies`: tangential velocities and forces along any one direction
of the surface, normal velocities positive while the body approaches. The contact point lies at
(offset, depth) from the centre of mass: `offset` along the tangential direction, `depth` along the
approach of the first body; in the paper x1 = offset, x2 = -depth. Friction and normal force are
positive where they oppose positive velocities of the (first) body.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from planarimpact.common import checks
from planarimpact.common.arrays import Array, ArrayLike, Numbers
from planarimpact.common.checks import InputError, checked, finite, not_negative, positive
from planarimpact.common.records import record


@record
class InverseMass(NamedTuple):
    """Inverse mass at the contact point [1/kg] (Eq. 2): 1/m1, the coupling c, and 1/m2.

    Tangential and normal velocity change by -(p1/m1 - c p2) and -(p2/m2 - c p1) under impulses p1
    of friction and p2 of the normal force. c = 0 in a collinear configuration.
    """

    tangential: Numbers
    coupling: Numbers
    normal: Numbers


@checks.default_errors
def inverse_mass(
    mass: ArrayLike, gyration: ArrayLike, offset: ArrayLike, depth: ArrayLike
) -> InverseMass:
    """Inverse mass of one rigid body at its contact point (Eqs 1, 2); arguments broadcast.

    With the mass M [kg] and the radius of gyration k [m], above 0, and the way from the centre of
    mass to the contact point, offset and depth [m], see the module's heading:
    1/m1 = (1 + depth^2/k^2)/M, c = offset depth/(M k^2), 1/m2 = (1 + offset^2/k^2)/M. Errors:
    `planarimpact.noncollinear`.

    Examples
    --------
    >>> rod = inverse_mass(1.0, 12**-0.5, offset=0.3, depth=0.4)  # a metre of slender rod, tilted
    >>> [round(float(entry), 12) for entry in rod]
    [2.92, 1.44, 2.08]
    """
    mass, gyration, offset, depth = checks.broadcast(
        mass=positive("mass", mass),
        gyration=positive("gyration", gyration),
        offset=finite("offset", offset),
        depth=finite("depth", depth),
    )
    with np.errstate(over="ignore"):  # refused as beyond the rule of sizes
        return checked_inverse_mass(of_arrays(mass, gyration, offset, depth))


def of_arrays(mass: Numbers, gyration: Numbers, offset: Numbers, depth: Numbers) -> InverseMass:
    """As `inverse_mass`, of checked arrays; that of an infinite mass is 0."""
    offset, depth = offset / gyration, depth / gyration
    return InverseMass((1 + depth**2) / mass, offset * depth / mass, (1 + offset**2) / mass)


@checks.default_errors
def combined(first: InverseMass, second: InverseMass) -> InverseMass:
    """Inverse mass of two bodies that strike each other: the sum of theirs.

    The second body's contact point is seen from its own centre along the same axes, those of the
    first: its depth is negative where its centre lies beyond the surface. They broadcast. Refused
    is also an inverse mass that no body has; other errors: `planarimpact.noncollinear`.

    Examples
    --------
    >>> balls = combined(inverse_mass(1.0, 1.0, 0.0, 2.0), inverse_mass(2.0, 1.0, 0.0, -1.0))
    >>> [float(entry) for entry in balls]
    [6.0, 0.0, 1.5]
    """
    one, other = checked_inverse_mass(first, "first"), checked_inverse_mass(second, "second")
    checks.broadcast(first=np.asarray(one.normal), second=np.asarray(other.normal))
    return checked_inverse_mass(InverseMass(*map(np.add, one, other)))


def checked_inverse_mass(value: InverseMass, name: str = "inverse_mass") -> InverseMass:
    """Check that an inverse mass is that of a body: finite, positive definite."""
    if not isinstance(value, InverseMass):
        raise InputError(
            f"{name} = {checks.brief(value)}: allowed are "
            f"InverseMass({', '.join(InverseMass._fields)}) tuples, as inverse_mass(...) makes them"
        )
    tangential, coupling, normal = checks.broadcast(
        tangential=positive(f"{name}.tangential", value.tangential),
        coupling=finite(f"{name}.coupling", value.coupling),
        normal=positive(f"{name}.normal", value.normal),
    )
    with np.errstate(over="ignore"):  # where it is not
        # Every body has 1/(m1 m2) - c^2 = (1 + (offset^2 + depth^2)/k^2)/M^2 > 0.
        definite = np.abs(coupling) / normal * (np.abs(coupling) / tangential) < 1
    if not definite.all():
        index = tuple(int(i) for i in np.argwhere(~definite)[0])
        raise InputError(
            f"{name}.coupling = {float(coupling[index])}: allowed are numbers whose square"
            " is below tangential times normal"
        )
    return InverseMass(tangential[()], coupling[()], normal[()])


def checked_impact(
    tangential: ArrayLike,
    normal: ArrayLike,
    inverse_mass: InverseMass,
    friction: ArrayLike,
    restitution: ArrayLike,
    **others: Array,
) -> tuple[Array, ...]:
    """Check an impact and broadcast it with checked `others`; the inverse mass comes last."""
    mass = fields_of(inverse_mass)
    return checks.broadcast(
        tangential=finite("tangential", tangential),
        normal=checked("normal", normal, "finite numbers above 0 (approach)", 0, open_low=True),
        friction=not_negative("friction", friction),
        restitution=checks.restitution(restitution),
        **others,
        **mass,
    )


def fields_of(inverse_mass: InverseMass) -> dict[str, Array]:
    """Checked fields of an inverse mass, keyed by the names that a refusal shows."""
    mass = checked_inverse_mass(inverse_mass)
    return {f"inverse_mass.{name}": field for name, field in mass._asdict().items()}
