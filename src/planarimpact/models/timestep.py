"""Contacts in equal time steps, as discrete-element codes step through them.

Each step moves the bodies by their velocities half a step before, and then finds the forces from
the new places and these velocities: velocity Verlet, or leapfrog, as LAMMPS, MercuryDPM and Yade
have it. Friction is a spring that is carried from step to step, beside a dashpot or none, and is
cut back to mu times the normal force. Normal and tangential motion both have the error of the
steps: events are not located within a step. A `Law` says how a code finds these forces.

`rebound` loses energy for e < 1 in the paper's hysteretic spring (that of O. R. Walton and R. L.
Braun, J. Rheol. 30 (1986) 949-980, with latching): below the largest depth reached, the normal
force follows a line, or a Hertz curve, that is steeper by 1/e^2. So restitution takes e times as
long as compression, and has e/(1 + e) of the steps. If that is less than one step, the impulse of
friction is wrong by up to 0.75 of what the largest force gives in a step. For e = 0 the contact
ends with the step nearest to maximum compression. The evidence on this spring is divided, see
`planarimpact.lumped`. `with_dashpots` has a dashpot beside the normal spring instead, as many codes
do; `planarimpact.fit` fits its tangential spring and dashpot to the continuum.

Three laws are models by a name of their own; `planarimpact.models.MODELS` has their sources:

- `LINEAR` has linear springs with a slider: the lumped model in steps.
- `MINDLIN` is a Hertz contact whose friction grows with Mindlin's full tangential stiffness 8 a G*
  (A. Di Renzo, F. P. Di Maio, Chem. Eng. Sci. 59 (2004) 525-541); zeta^2 is the normal stiffness
  dF2/d(depth) of an elastic contact over it. It does not conserve energy: friction that is kept
  while its spring softens creates some (D. Elata, J. G. Berryman, Mech. Mater. 24 (1996) 229-240).
  Where beta/zeta^2 is so small that stick lasts, a solid sphere may leave up to 5 % faster than it
  came, however many steps there are.
- `MINDLIN_RESCALED` is the same, but friction shrinks in proportion to the radius of contact: the
  elastic continuum without micro-slip. This favours stick in restitution: at e = 1 the contact
  slides throughout from x = 2 beta - 2 zeta^2/3 on, where the continuum does from 2 beta - zeta^2.

Hertz contacts start in slip from x = 2 zeta^2/3, not zeta^2, because the first step already has the
stiffness of its end.

What the steps cost:

- The least number of steps is `factor` times (1 + e) (beta/zeta^2)^(1/2). With fewer the tangential
  oscillation turns by more than 2 in a step and grows.
- Steps near that number may create energy. `gain` is the largest |velocity|/|x| with the least
  number, and with twice as many; for a Hertz contact it is the largest that a search found. With
  four times as many, `MINDLIN_RESCALED` creates none.
- The error of the steps falls with the power `order` of their number. That of 64 steps of `LINEAR`
  is 0.0008, root mean square for a solid sphere of Poisson's ratio 0.3 at e = 1, x from 0 to 8.
- `distance` is the root mean square distance from the elastic continuum for the same impacts. It
  is not smaller with more steps.

==================  ======  ================  =====  ========
law                 factor  gain              order  distance
==================  ======  ================  =====  ========
`LINEAR`            pi/4    2 steps + 1; 1.2  2      0.08
`MINDLIN`           1.0076  11; 1.8           1      0.29
`MINDLIN_RESCALED`  1.0076  4.3; 1.01         1      0.31
==================  ======  ================  =====  ========

The overlap is taken to be much smaller than the radius: no normal turns, no lever arm shortens.

Units: m2 and |v2(0)|, times mu in tangential direction; the largest approach of a contact that
loses nothing. So the normal spring has the force d where it is linear, and 1.25 d^(3/2) where it is
Hertz's. A dashpot has its coefficient times (m2 F/d)^(1/2), where F is the force of the normal
spring and d the approach.
"""

from __future__ import annotations

import functools
import math
from collections.abc import Iterable, Iterator
from typing import NamedTuple

import numpy as np

from planarimpact.common import checks
from planarimpact.common.arrays import Array, ArrayLike, Integers, Numbers, in_parts
from planarimpact.common.results import Rebound, Regime
from planarimpact.normal_impact import hertz

STEPS = 64
# Impacts solved together, as in `planarimpact.lumped`.
CHUNK = 16384
# Explicit steps are stable while the phase of an oscillation grows by no more than this [rad].
STABLE_ANGLE = 2.0
# Least velocity over zeta^2 that is solved. Below, the contact sticks to its last step and the
# answer is proportional to x.
LEAST = 1e-100
# Steps of `with_dashpots` in a contact that loses nothing. One that loses energy lasts longer, but
# not so many times as long.
DASHPOT_STEPS, LONGEST = 200, 20


class Law(NamedTuple):
    """How a code finds the forces of a contact."""

    hertzian: bool = False
    # Whether friction shrinks in proportion to the radius of contact, where this shrinks.
    rescales: bool = False
    # Whether the normal force is kept from pulling. Where it pulls, friction acts as if it pressed.
    limited: bool = False
    # Whether the limit of friction holds for the spring alone; the dashpot is there in stick only.
    spring_slides: bool = False


LINEAR = Law()
MINDLIN = Law(hertzian=True)
MINDLIN_RESCALED = Law(hertzian=True, rescales=True)


@checks.default_errors
def rebound(
    law: Law,
    incidence: ArrayLike,
    mass_ratio: ArrayLike = 3.5,
    stiffness_ratio: ArrayLike = 1.21,
    restitution: ArrayLike = 1.0,
    *,
    steps: int = STEPS,
) -> Rebound:
    """State at separation by a law without dashpots: `LINEAR`, `MINDLIN` or `MINDLIN_RESCALED`.

    `steps` is their number over the duration of contact; 3 to 10^7, and at least that of the table
    above for each impact. Other arguments and errors: `planarimpact.lumped`.

    Peak_friction, at most 1, and regime are what the steps show. A slip or a stick that is shorter
    than a step is missed: if the last slip is so short, the regime ends in stick. But a contact
    whose slip changes its direction counts as having stuck once, even if no step was in stick.
    Where the steps or `MINDLIN` create energy, dissipation is negative.

    Examples
    --------
    >>> for law in (LINEAR, MINDLIN, MINDLIN_RESCALED):
    ...     rebound(law, [1.0, 2.0, 8.0], 3.5, 17 / 14).velocity.round(2).tolist()
    [0.2, -0.59, 1.0]
    [0.54, -0.18, 1.0]
    [0.45, -0.19, 1.0]
    """
    signed, *groups = checks.impact(incidence, mass_ratio, stiffness_ratio, restitution)
    beta, zeta2, e = (a.reshape(-1) for a in groups)
    _, stiffest, _ = _spring(law, 1.0)
    frequency = math.sqrt(stiffest) * np.sqrt(beta / zeta2)
    angle = (1 + e) * (duration(law.hertzian) / 2) * frequency
    steps = _stable(steps, float(np.max(angle / STABLE_ANGLE, initial=3)))
    flat = np.abs(signed).reshape(-1), beta, zeta2, e
    solved = in_parts(
        e.size, CHUNK, lambda part: _impacts(law, steps, *(group[part] for group in flat))
    )
    return Rebound.of(signed, *solved)


def _stable(steps: int, fewest: float) -> int:
    """Check the number of steps: fewer than `fewest` do not follow the tangential oscillation."""
    steps = checks.count("steps", steps, 3)
    if fewest > checks.MOST:
        raise checks.InputError(
            f"steps = {steps}: for this mass_ratio and stiffness_ratio {fewest:.3g} explicit steps "
            "are needed, or the tangential oscillation is unstable; allowed are up to "
            f"{checks.MOST}"
        )
    if steps < fewest:
        raise checks.InputError(
            f"steps = {steps}: allowed are integers from {math.ceil(fewest)} to {checks.MOST} "
            "(with fewer explicit steps the tangential oscillation is unstable)"
        )
    return steps


def with_dashpots(
    law: Law,
    x: Array,
    mass_ratio: float,
    stiffness: Array | float,
    damping: Array | float,
    input_restitution: float,
    steps: int = DASHPOT_STEPS,
    begins: float = 0.0,
) -> Array:
    """Velocity v1(tf)/(mu v2(0)) of the contact point; x, stiffness and damping broadcast.

    The tangential stiffness comes as a share of the normal one, in a Hertz contact at every
    approach; the tangential damping as the coefficient of its dashpot. `input_restitution` comes
    from `input_restitution_for`. `steps` is their number in a contact that loses nothing, `begins`
    the part of the first step that is over when the bodies touch, below 1. Nothing is checked.

    Examples
    --------
    >>> with_dashpots(Law(), np.array([0.5, 2.0, 8.0]), 3.5, 14 / 17, 0.0, 1.0).round(2)
    array([ 0.21, -0.58,  1.  ])
    """
    velocity = np.array(np.broadcast_arrays(x, stiffness, damping)[0], float)
    instants = _dashpot_motion(law, input_restitution, steps, begins)[0]
    for _ in _friction(law, instants, velocity, mass_ratio, stiffness, damping):
        pass
    return velocity


def duration(hertzian: bool) -> float:
    """Duration of a contact that loses nothing.

    Examples
    --------
    >>> round(duration(hertzian=False), 6), round(duration(hertzian=True), 3)
    (3.141593, 2.943)
    """
    return 2 * hertz.COMPRESSION if hertzian else math.pi


def normal_damping(hertzian: bool, input_restitution: float) -> float:
    """Coefficient of the normal dashpot for a restitution, where the contact may pull at its end.

    Notes
    -----
    LAMMPS, `damping coeff_restitution`. D. Antypov, J. A. Elliott, EPL 94 (2011) 50004.

    Examples
    --------
    >>> round(normal_damping(hertzian=False, input_restitution=math.exp(-math.pi)), 6)
    1.414214
    """
    logarithm = abs(math.log(input_restitution))
    return (math.sqrt(5) if hertzian else 2.0) * logarithm / math.hypot(math.pi, logarithm)


def restitution_after(law: Law, input_restitution: float, steps: int = DASHPOT_STEPS) -> float:
    """Normal speed after a contact over that before it, with dashpots.

    Examples
    --------
    >>> round(restitution_after(Law(), 0.8, 2000), 3)
    0.8
    """
    return _dashpot_motion(law, input_restitution, steps, 0.0)[1]


@functools.lru_cache(maxsize=64)
def input_restitution_for(law: Law, restitution: float) -> float:
    """Restitution that a code gets as input, so that its contact has this one.

    A contact that cannot pull keeps more of its energy than the coefficient gives.

    Examples
    --------
    >>> input_restitution_for(Law(), 0.8), round(input_restitution_for(Law(limited=True), 0.8), 3)
    (0.8, 0.791)
    """
    from scipy import optimize  # here, as it takes longer to import than this package

    if not law.limited or restitution == 1:
        return restitution

    def excess(input_restitution: float) -> float:
        return _limited_restitution(law.hertzian, input_restitution) - restitution

    return float(optimize.brentq(excess, restitution / 4, restitution, xtol=1e-9))


def _limited_restitution(hertzian: bool, input_restitution: float) -> float:
    """Speed after a contact that ends where its force would become negative; in any unit of it."""
    from scipy import integrate  # as above

    damping = normal_damping(hertzian, input_restitution)

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


class _Instant(NamedTuple):
    """Normal motion at one step; of several impacts arrays of one entry, or of one for each."""

    force: Numbers
    rate: Numbers  # growth of friction, for a tangential stiffness and velocity of 1
    kept: Numbers | None  # share of the tangential spring's force that is carried over; None: all
    kick: Numbers  # time over which the forces of this step act
    dashpot: Numbers = 0.0  # friction of a dashpot of coefficient 1, at a velocity of 1


def _spring(law: Law, depth: Numbers) -> tuple[Numbers, Numbers, Numbers]:
    """Force and stiffness of the elastic normal spring, and the radius of contact."""
    if not law.hertzian:
        return depth, 1.0, 1.0
    radius = np.sqrt(depth)
    return hertz.PEAK_FORCE * depth * radius, 1.5 * hertz.PEAK_FORCE * radius, radius


def _share_kept(law: Law, before: Numbers, after: Numbers) -> Array | None:
    """Radius of contact over that of the step before where it shrinks, else 1."""
    if not law.rescales:
        return None
    return np.divide(after, before, out=np.ones_like(after), where=after < before)


def _friction(
    law: Law,
    instants: Iterable[_Instant],
    velocity: Array,
    slowing: Array | float,
    stiffness: Array | float = 1.0,
    damping: Array | float = 0.0,
) -> Iterator[tuple[_Instant, Array, Array]]:
    """Step through contacts: change `velocity` in place by friction times `slowing`.

    Yields each instant, the force of the spring (with that of the dashpot where the limit holds for
    both) before it is cut back to the limit, and the friction that acts.
    """
    spring, dashpot, uncut, friction = (np.zeros_like(velocity) for _ in range(4))
    for now in instants:
        np.multiply(velocity, stiffness * now.rate, out=uncut)
        if now.kept is not None:
            spring *= now.kept
        uncut += spring
        np.multiply(velocity, damping * now.dashpot, out=dashpot)
        if law.spring_slides:
            dashpot[np.abs(uncut) > now.force] = 0
            np.clip(uncut, -now.force, now.force, out=spring)
            np.add(spring, dashpot, out=friction)
        else:
            uncut += dashpot
            np.clip(uncut, -now.force, now.force, out=friction)
            np.subtract(friction, dashpot, out=spring)
        yield now, uncut, friction
        friction *= slowing * now.kick
        velocity -= friction


@functools.lru_cache(maxsize=128)
def _dashpot_motion(
    law: Law, input_restitution: float, steps: int, begins: float
) -> tuple[tuple[_Instant, ...], float]:
    """Every step with an overlap, and the speed after them."""
    step = duration(law.hertzian) / steps
    damping = normal_damping(law.hertzian, input_restitution)
    depth: Numbers = -begins * step
    speed: Numbers = 1.0
    radius: Numbers = 0.0
    instants = []
    for _ in range(LONGEST * steps):
        depth = depth + step * speed
        if depth <= 0:
            break
        before = radius
        spring, stiffness, radius = _spring(law, depth)
        dashpot = np.sqrt(spring / depth)
        force = spring + damping * dashpot * speed
        if law.limited:
            force = np.maximum(force, 0.0)
        kept = _share_kept(law, before, radius)
        instants.append(_Instant(abs(force), step * stiffness, kept, step, dashpot))
        speed = speed - step * force
    return tuple(instants), -float(speed)


def _latching_motion(law: Law, e: Array, steps: int) -> Iterator[_Instant]:
    """Every step with a force, of the hysteretic spring: all but the first and the last step."""
    step = (1 + e) * (duration(law.hertzian) / 2 / steps)
    # With e = 0 there is no force below the largest depth: any tiny number has this effect.
    compliance = np.maximum(e * e, 1e-300)
    depth, deepest = np.zeros((2, e.size))
    radius: Numbers = np.zeros(e.size)
    velocity = np.ones(e.size)  # of approach, half a step ahead: no force has slowed it yet
    ended = np.zeros(e.size, bool)
    while True:
        depth = depth + step * velocity
        deepest = np.maximum(deepest, depth)
        elastic = np.maximum(deepest - (deepest - depth) / compliance, 0.0)
        elastic[ended] = 0.0
        touches = elastic > 0
        if not touches.any():
            return
        before = radius
        force, stiffness, radius = _spring(law, elastic)
        velocity = velocity - step * force
        # Velocity never increases. Once it is negative, every contact comes to its end.
        ended = ended | ((e == 0) & (velocity <= 0))
        kept = _share_kept(law, before, radius)
        kick = np.where(ended, step / 2, step)
        yield _Instant(force, step * stiffness * touches, kept, kick)


def _impacts(
    law: Law, steps: int, x: Array, beta: Array, zeta2: Array, e: Array
) -> tuple[Array, Array, Array, Integers]:
    """Velocity, impulse, peak friction and regime of impacts solved together, x >= 0."""
    # Normal motion depends on e alone: it is integrated once where all impacts have the same e.
    if (e == e[:1]).all():
        e = e[:1]
    # Tangential velocity over zeta^2, half a step ahead.
    start = np.maximum(x / zeta2, LEAST)
    start_share = np.minimum(x / zeta2 / LEAST, 1.0)  # x over the incidence that is solved
    velocity = start.copy()
    highest, lowest = np.zeros((2, x.size))
    slips, starts_in_slip = np.zeros((2, x.size), bool)
    slipped = np.ones(x.size, bool)  # slip before contact, so that an initial stick is counted
    sticks = np.zeros(x.size, np.int64)  # number of phases of stick
    normal_impulse = np.zeros(e.size)
    instants = _latching_motion(law, e, steps)
    for number, (now, uncut, friction) in enumerate(
        _friction(law, instants, velocity, beta / zeta2)
    ):
        np.greater(np.abs(uncut), now.force, out=slips, where=now.force > 0)
        if number == 0:
            starts_in_slip[:] = slips
        sticks += slipped > slips
        slipped[:] = slips
        np.maximum(highest, friction, out=highest)
        np.minimum(lowest, friction, out=lowest)
        normal_impulse = normal_impulse + now.kick * now.force
    # Where the direction of slip has changed the contact has stuck, for less than a step.
    sticks += (sticks == 0) & (lowest < 0)
    # In slip throughout the difference of velocities would have few digits at large x.
    slides = sticks == 0
    impulse = np.where(slides, normal_impulse, 0.0)
    final = x - beta * impulse
    final[~slides] = (x * (velocity / start))[~slides]
    impulse = np.where(slides, impulse, x / beta - final / beta)
    largest_force, _, _ = _spring(law, 1.0)
    peak = np.maximum(highest, -lowest) * start_share / largest_force
    regime = Regime.of_phases(sticks, starts_in_slip, slips).astype(np.uint8)
    return final, impulse, np.minimum(peak, 1.0), regime
