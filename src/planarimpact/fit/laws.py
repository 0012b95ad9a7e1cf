"""One contact in steps, as discrete-element codes step through it.

Each step moves the bodies by their velocities half a step before, and then finds the forces from
the new places and these velocities: what velocity Verlet and leapfrog do in LAMMPS, MercuryDPM and
Yade. The normal force is a spring, linear or of Hertz, beside a dashpot. Friction is a spring that
remembers, beside a dashpot, up to mu times the normal force. The overlap is taken to vanish beside
the radius, so the normal does not turn. Then no law has mass, stiffness or speed of its own: with
the units below they are all 1.

Units: m2 and v2(0), times mu in tangential direction. The normal spring has the force d where it is
linear, and d^(3/2) where it is Hertz'. A dashpot has its coefficient times (m2 F/d)^(1/2), where F
is the force of the normal spring and d the approach.
"""

import functools
import math
from typing import NamedTuple

import numpy as np

from planarimpact.ground.arrays import Array
from planarimpact.normal_impact import hertz

# Steps in a contact that loses nothing.
STEPS = 200
# A contact that loses energy lasts longer, but not so much.
LONGEST = 20


class Law(NamedTuple):
    """How one code finds the forces of a contact."""

    hertzian: bool = False
    # Whether friction shrinks in proportion to the radius of contact, where this shrinks.
    rescales: bool = False
    # Whether the normal force is kept from pulling. Where it pulls, friction acts as if it pressed.
    limited: bool = False
    # Whether the limit of friction holds for the spring alone; the dashpot is there in stick only.
    spring_slides: bool = False


class _Instant(NamedTuple):
    """One step: forces and stiffnesses that do not depend on the incidence."""

    force: float  # normal
    rate: float  # growth of friction, for a tangential stiffness and velocity of 1
    dashpot: float  # friction of a dashpot of coefficient 1, at a velocity of 1
    kept: float  # share of the tangential spring's force that is carried over


def duration(hertzian: bool) -> float:
    """Duration of a contact that loses nothing.

    Examples
    --------
    >>> round(duration(hertzian=False), 6), round(duration(hertzian=True), 3)
    (3.141593, 3.218)
    """
    return float(2 * hertz.COMPRESSION * 1.25**0.4) if hertzian else math.pi


def normal_damping(hertzian: bool, told: float) -> float:
    """Coefficient of the normal dashpot for a restitution, where the contact may pull at its end.

    Notes
    -----
    LAMMPS, `damping coeff_restitution`. D. Antypov, J. A. Elliott, EPL 94 (2011) 50004.

    Examples
    --------
    >>> round(normal_damping(hertzian=False, told=math.exp(-math.pi)), 6)
    1.414214
    """
    logarithm = -math.log(told)
    return (math.sqrt(5) if hertzian else 2.0) * logarithm / math.hypot(math.pi, logarithm)


@functools.lru_cache(maxsize=64)
def told_for(law: Law, restitution: float) -> float:
    """Restitution that a code must be told, so that the contact has this one.

    A contact that cannot pull keeps more of its energy than the coefficient says.

    Examples
    --------
    >>> told_for(Law(), 0.8), round(told_for(Law(limited=True), 0.8), 3)
    (0.8, 0.791)
    """
    if not law.limited or restitution == 1:
        return restitution
    from scipy import optimize  # here, as it takes longer to import than this package

    def excess(told: float) -> float:
        return _limited_restitution(law.hertzian, told) - restitution

    return float(optimize.brentq(excess, restitution / 4, restitution, xtol=1e-9))


def _limited_restitution(hertzian: bool, told: float) -> float:
    """Speed after a contact that ends where its force would become negative."""
    from scipy import integrate  # here, as it takes longer to import than this package

    damping = normal_damping(hertzian, told)

    def force(state: Array) -> float:
        depth = max(float(state[0]), 0.0)
        if hertzian:
            return float(depth**1.5 + damping * depth**0.25 * state[1])
        return float(state[0] + damping * state[1])

    def separates(time: float, state: Array) -> float:
        return force(state) if time > 0.5 else 1.0

    separates.terminal = True  # type: ignore[attr-defined]
    found = integrate.solve_ivp(
        lambda _, state: (state[1], -force(state)),
        (0, LONGEST * duration(hertzian)),
        (0.0, 1.0),
        events=separates,
        rtol=1e-9,
        atol=1e-12,
    )
    return float(-found.y[1, -1])


@functools.lru_cache(maxsize=128)
def _normal_motion(
    law: Law, told: float, steps: int, begins: float
) -> tuple[tuple[_Instant, ...], float, float]:
    """Every step with an overlap, the speed after them, and the length of a step."""
    step = duration(law.hertzian) / steps
    damping = normal_damping(law.hertzian, told)
    depth, speed, radius = -begins * step, 1.0, 0.0
    instants = []
    for _ in range(LONGEST * steps):
        depth += step * speed
        if depth <= 0:
            break
        before, radius = radius, math.sqrt(depth)
        spring = depth * radius if law.hertzian else depth
        dashpot = math.sqrt(spring / depth)
        force = spring + damping * dashpot * speed
        if law.limited:
            force = max(force, 0.0)
        kept = radius / before if law.rescales and radius < before else 1.0
        rate = step * (1.5 * radius if law.hertzian else 1.0)
        instants.append(_Instant(abs(force), rate, dashpot, kept))
        speed -= step * force
    return tuple(instants), -speed, step


def restitution(law: Law, told: float, steps: int = STEPS) -> float:
    """Normal speed after a contact over that before it.

    Examples
    --------
    >>> round(restitution(Law(), 0.8, 2000), 3)
    0.8
    """
    return _normal_motion(law, told, steps, 0.0)[1]


def rebound(
    law: Law,
    x: Array,
    mass_ratio: float,
    stiffness: Array | float,
    damping: Array | float,
    told: float,
    steps: int = STEPS,
    begins: float = 0.0,
) -> Array:
    """Velocity v1(tf)/(mu v2(0)) of the contact point; x, stiffness and damping broadcast.

    The tangential stiffness comes as a share of the normal one, in a Hertz contact at every
    approach; the tangential damping as the coefficient of its dashpot. `begins` is the part of the
    first step that is over when the bodies touch, from 0 to below 1.

    Examples
    --------
    >>> rebound(Law(), np.array([0.5, 2.0, 8.0]), 3.5, 14 / 17, 0.0, told=1.0).round(2)
    array([ 0.21, -0.58,  1.  ])
    """
    instants, _, step = _normal_motion(law, told, steps, begins)
    velocity = np.array(np.broadcast_arrays(x, stiffness, damping)[0], float)
    spring, dashpot, force = (np.zeros_like(velocity) for _ in range(3))
    for now in instants:
        np.multiply(velocity, stiffness * now.rate, out=force)
        if now.kept != 1:
            spring *= now.kept
        spring += force
        np.multiply(velocity, damping * now.dashpot, out=dashpot)
        if law.spring_slides:
            dashpot[np.abs(spring) > now.force] = 0
            np.clip(spring, -now.force, now.force, out=spring)
            np.add(spring, dashpot, out=force)
        else:
            np.add(spring, dashpot, out=force)
            np.clip(force, -now.force, now.force, out=force)
            np.subtract(force, dashpot, out=spring)
        force *= step * mass_ratio
        velocity -= force
    return velocity
