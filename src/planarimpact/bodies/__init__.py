"""Physical bodies and materials, in SI units, to and from the groups that the models take.

Collinear configurations only: each centre of mass lies on the contact normal. Other consistent
units give the same numbers.

Arguments of all functions have these names. Each is a number or an array; they broadcast, and a
result is a number or an array of the broadcast shape. Index 1 is tangential, 2 normal.

| argument | meaning | unit | allowed |
|---|---|---|---|
| `body`, `other` | a `Body` and what it strikes, a half-space at rest by default | | one can move |
| `material`, `other`, `other_material` | the `Material` of each; None is rigid | | |
| `radius` | r, from the centre to the contact point; or of curvature | m | above 0 |
| `mass` of a shape | M | kg | above 0 |
| `density` | of a homogeneous sphere | kg/m^3 | above 0 |
| `motion`: `tangential`, `normal` | velocity of the centre of mass | m/s | finite |
| `motion`: `spin` | angular velocity | rad/s | finite |
| `v1`, `v2` | velocity of the contact point before impact | m/s | v2 above 0 |
| `friction` | coefficient mu | | above 0 |
| `speed` | normal speed of approach, v2(0) | m/s | above 0 |
| `mass` with a speed or modulus | normal effective mass m2 | kg | above 0 |
| `effective_modulus` | E* | Pa | above 0 |
| `effective_radius` | R | m | above 0 |
| `restitution` | energetic coefficient e | | 0.022 to 1; in `rebound_motion` 0 to 1 |
| `relaxation_time` | tau of viscous bodies | s | from 0 |
| `yield_pressure` | p_y of plastic bodies | Pa | above 0 |

Other symbols: m1 tangential effective mass; beta = m2/m1; k radius of gyration; x incidence, w
velocity of the contact point at separation over mu v2; E, G, nu Young's modulus, shear modulus and
Poisson's ratio; G* effective shear modulus; zeta^2 normal over tangential stiffness.

Errors. Every function raises `InputError` with the field and its value if an argument is not a
number that is allowed, if shapes do not broadcast, or if an argument or a result is beyond 1e-100
to 1e100 in size (a mass ratio 1e12); what may be 0 may be smaller.

Signs. The normal velocity is positive while the body approaches, so it is positive before the
impact and negative after it. The tangential velocity is positive in one direction along the
surface, the same one for all quantities; usually it is the incident direction. Spin is positive
where it moves the contact point in that direction: v1 = tangential + radius spin, so rolling
without slip, v1 = 0, is spin = -tangential/radius, and positive spin is backspin.

Users need only this module: it also exports what `masses`, `materials`, `quantities` and
`restitution` define.
"""

from functools import partial
from typing import NamedTuple

import numpy as np

from planarimpact.bodies.masses import disc, effective_masses, mass_ratio, solid_sphere, thin_shell
from planarimpact.bodies.materials import (
    COUPLING,
    dundurs,
    effective_modulus,
    effective_radius,
    hertz_peak_force,
    normal_frequency,
    stiffness_ratio,
)
from planarimpact.bodies.materials import radius_of_two as radius_of_two
from planarimpact.bodies.quantities import (
    HALF_SPACE,
    Body,
    Material,
    Motion,
    quietly,
)
from planarimpact.bodies.quantities import fields as fields
from planarimpact.bodies.restitution import (
    LEAST_RESTITUTION,
    peak_force,
    plastic_restitution,
    relaxation_time,
    viscous_restitution,
    yield_pressure,
    yield_speed,
)
from planarimpact.bodies.restitution import time_unit as time_unit
from planarimpact.bodies.restitution import unchecked_yield_speed as unchecked_yield_speed
from planarimpact.common import checks
from planarimpact.common.arrays import Array, ArrayLike
from planarimpact.common.checks import (
    OutOfRange,
    checked,
    finite,
    in_range,
    not_negative,
    positive,
)

__all__ = [
    "COUPLING",
    "HALF_SPACE",
    "LEAST_RESTITUTION",
    "Body",
    "Contact",
    "Material",
    "Motion",
    "OutOfRange",
    "contact",
    "contact_velocity",
    "disc",
    "dundurs",
    "effective_masses",
    "effective_modulus",
    "effective_radius",
    "hertz_peak_force",
    "incidence",
    "incidence_from_angle",
    "mass_ratio",
    "normal_frequency",
    "peak_force",
    "plastic_restitution",
    "rebound_motion",
    "relaxation_time",
    "solid_sphere",
    "stiffness_ratio",
    "thin_shell",
    "viscous_restitution",
    "yield_pressure",
    "yield_speed",
]

# The groups scale tangential velocities by mu: at mu = 0 they no longer hold v1.
_friction = partial(
    positive, "friction", allowed="finite numbers above 0 (without friction v1 stays as it is)"
)


class Contact(NamedTuple):
    """What the laws of restitution ask of two bodies, in the order of their arguments."""

    mass: Array
    effective_modulus: Array
    effective_radius: Array


def contact(
    body: Body, material: Material, other: Body = HALF_SPACE, other_material: Material | None = None
) -> Contact:
    """Effective mass, modulus and radius of two bodies that strike each other.

    A radius of 0 is flat. Another body that can move needs a material. Arguments and errors:
    `planarimpact.bodies`.

    Examples
    --------
    The yield pressure of two steel beads whose restitution is 0.8 at 1 m/s:

    >>> steel, bead = Material(207e9, 0.3), solid_sphere(0.001, 7800)
    >>> pressure = yield_pressure(0.8, 1.0, *contact(bead, steel, bead, steel))
    >>> round(float(pressure / 1e9), 2)
    2.59
    >>> contact(bead, steel, bead)
    Traceback (most recent call last):
    ...
    planarimpact.InputError: other_material: missing, as the other body has a finite mass
    """
    _, mass = effective_masses(body, other)
    if other_material is None and np.isfinite(other.mass).any():
        raise checks.InputError("other_material: missing, as the other body has a finite mass")
    radius = radius_of_two(body.radius, other.radius)
    if np.isnan(radius).any():
        raise checks.InputError("body.radius = 0, other.radius = 0: one of the two must be above 0")
    return Contact(mass, effective_modulus(material, other_material), radius)


@checks.default_errors
def contact_velocity(
    tangential: ArrayLike, normal: ArrayLike, spin: ArrayLike, radius: ArrayLike
) -> tuple[Array, Array]:
    """Velocity of the contact point of a body: v1 = tangential + radius spin, v2 = normal [m/s].

    For two bodies take relative velocities of the centres, and add the other's radius times its
    spin, in the same sense of turning, to v1. The radius may be 0. Arguments and errors:
    `planarimpact.bodies`.

    Examples
    --------
    >>> [float(v) for v in contact_velocity(2.0, 1.0, -4.0, 0.5)]  # rolling
    [0.0, 1.0]
    """
    tangential, normal, spin, radius = checks.broadcast(
        tangential=finite("tangential", tangential),
        normal=finite("normal", normal),
        spin=finite("spin", spin),
        radius=not_negative("radius", radius),
    )
    return in_range("v1", tangential + radius * spin, 0.0), normal.copy()[()]


@checks.default_errors
def incidence(v1: ArrayLike, v2: ArrayLike, friction: ArrayLike) -> Array:
    """Incidence of an impact from the velocity of the contact point: x = v1/(mu v2).

    Arguments and errors: `planarimpact.bodies`.

    Examples
    --------
    >>> round(float(incidence(3.0, 2.0, 0.5)), 12)
    3.0
    """
    v1, v2 = finite("v1", v1), positive("v2", v2)
    v1, v2, mu = checks.broadcast(v1=v1, v2=v2, friction=_friction(friction))
    return checks.incidence(v1 / v2 / mu)[()]


@checks.default_errors
def incidence_from_angle(theta_deg: ArrayLike, friction: ArrayLike) -> Array:
    """Incidence of an impact at an angle: x = tan(theta)/mu.

    `theta_deg` is the angle from the normal in degrees, between -90 and 90. Other arguments and
    errors: `planarimpact.bodies`.

    Examples
    --------
    >>> round(float(incidence_from_angle(45.0, 0.5)), 12)
    2.0
    """
    rule, most = "degrees between -90 and 90, exclusive", np.nextafter(90, 0)
    theta = checked("theta_deg", theta_deg, rule, -most, most)
    theta, mu = checks.broadcast(theta_deg=theta, friction=_friction(friction))
    return checks.incidence(np.tan(np.radians(theta)) / mu)[()]


@quietly
def rebound_motion(
    body: Body,
    motion: Motion,
    friction: ArrayLike,
    rebound_velocity: ArrayLike,
    restitution: ArrayLike,
) -> Motion:
    """Motion of one body after its impact on a half-space at rest.

    The tangential impulse P1 = m1 (mu v2 w(tf) - v1) adds P1/M to the centre's velocity and
    radius P1/(M k^2) to the spin; the normal velocity becomes -e times what it was.
    `rebound_velocity` is w(tf) = v1(tf)/(mu v2(0)), the `velocity` of a `Rebound`. The normal
    velocity of `motion` is above 0. Other arguments and errors: `planarimpact.bodies`.

    Examples
    --------
    >>> ball = Body(mass=1.0, gyration=0.1, radius=0.1)
    >>> after = rebound_motion(ball, Motion(1.0, 2.0, 0.0), 0.25, 0.0, 0.5)  # leaves rolling
    >>> [round(float(v), 12) for v in after]
    [0.5, -1.0, -5.0]
    """
    before = fields("motion", motion, Motion)
    before["motion.normal"] = positive("motion.normal", motion.normal)  # the body approaches
    beta, _, gyration, radius, tangential, v2, spin, mu, w, e = checks.broadcast(
        mass_ratio=mass_ratio(body),  # refuses an infinite mass
        **fields("body", body, Body),
        **before,
        friction=_friction(friction),
        rebound_velocity=finite("rebound_velocity", rebound_velocity),
        restitution=checks.restitution(restitution),
    )
    v1, _ = contact_velocity(tangential, v2, spin, radius)
    centre_change = (w * mu * v2 - v1) / beta  # P1/M: m1/M = 1/beta
    spin_change = centre_change * (radius / gyration) / gyration
    after = tangential + centre_change, -e * v2, spin + spin_change
    names = (f"{field} after impact" for field in Motion._fields)
    return Motion(*(in_range(name, v, 0.0) for name, v in zip(names, after, strict=True)))
