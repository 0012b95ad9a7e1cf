"""Contact laws of discrete-element codes, integrated as these codes do: in few equal time steps.

The method is velocity Verlet (leapfrog): half a kick of the velocities, a drift, forces from
positions at the new time and velocities half a step old, half a kick. The tangential force is
carried from step to step. It grows by stiffness times displacement, and is cut back to mu times the
normal force. Normal and tangential motion both have the error of the steps. Events are not located
within a step.

The contact starts at a step. For e < 1 all three laws lose normal energy in the paper's hysteretic
spring (Walton & Braun's with latching): below the largest depth reached, the normal force follows a
line, or a Hertz curve, that is steeper by 1/e^2. So restitution takes e times as long as
compression. The length of the step stays the same: restitution has e/(1 + e) of the steps. If that
is less than one step, the impulse of friction is wrong by up to 0.75 of what the largest force
gives in a step. The evidence on this spring is divided, see `planarimpact.lumped`. For e = 0 the
contact ends with the step nearest to maximum compression. Many codes use a dashpot instead, which
is another law.

`Regime` is read from the steps. A slip or a stick that is shorter than a step is missed: if the
last slip is so short, the regime ends in stick. But a contact whose slip changes its direction
counts as having stuck once, even if no step was in stick. Hertz contact starts in slip
from x = 2 zeta^2/3, not zeta^2, however many steps there are, because the first step already has
the stiffness of its end.

Units: m2 and |v2(0)|, times mu in tangential direction; time 1/Omega where the contact is linear,
d_max/|v2(0)| where it is Hertzian.
"""

import math
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from planarimpact.ground import checks
from planarimpact.ground.arrays import Array, ArrayLike, Booleans, Integers, Numbers
from planarimpact.ground.results import Rebound, Regime
from planarimpact.normal_impact import hertz

STEPS = 64
# So many steps take a few minutes.
MOST_STEPS = 10**7

# Impacts solved together, as in `planarimpact.lumped`.
CHUNK = 16384

# Explicit steps are stable while the phase of an oscillation grows by no more than this [rad].
STABLE_ANGLE = 2.0

# Velocity over zeta^2 is clipped to these bounds. Below, the contact sticks to its last step and
# the answer is proportional to x. Above, it slides throughout.
LEAST, LARGEST = 1e-100, 1e300


@checks.default_errors
def linear(
    incidence: ArrayLike,
    mass_ratio: ArrayLike = 3.5,
    stiffness_ratio: ArrayLike = 1.21,
    restitution: ArrayLike = 1.0,
    *,
    steps: int = STEPS,
) -> Rebound:
    """Linear springs with a slider, after Cundall & Strack: the lumped model in steps.

    Parameters
    ----------
    incidence, mass_ratio, stiffness_ratio, restitution : array_like
        As in `planarimpact.lumped.rebound`.
    steps : int
        Over the duration of contact; 3 to 10^7, and at least (1 + e) pi/4 times the root
        of beta/zeta^2: with fewer the tangential oscillation turns by more than 2 in a step and
        grows. With this least number it may still create energy: |velocity| up to
        (2 steps + 1) |x|. With more it is at most |x|/sqrt(1 - r^2), r = least number/steps.

    Returns
    -------
    Rebound
        The same fields and units as `planarimpact.lumped.rebound`; peak_friction, at most
        1, and regime are what the steps show.

    Raises
    ------
    InputError
        If an argument is not a finite real number in its range, if shapes do not broadcast, or if
        there are too few steps for one of the impacts.

    Notes
    -----
    The bound of velocity is that of a contact that sticks throughout, where each step is the same
    linear map. A search showed that slip only lowers it; this is not proved.
    The error of the steps falls with their square, unevenly, as events fall between them. For a
    solid sphere at e = 1 and 64 steps it is 0.0008 (root mean square over x from 0 to 8) and 0.0026
    at most, against the lumped model. It is not the error of that model.

    References
    ----------
    P. A. Cundall, O. D. L. Strack, Geotechnique 29 (1979) 47-65. O. R. Walton, R. L. Braun,
    J. Rheol. 30 (1986) 949-980.

    Examples
    --------
    >>> from planarimpact import lumped
    >>> limit = lumped.rebound(2.0).velocity
    >>> bool(abs(linear(2.0).velocity - limit) < 1e-3)
    True
    """
    return _rebound(LINEAR, incidence, mass_ratio, stiffness_ratio, restitution, steps)


@checks.default_errors
def mindlin(
    incidence: ArrayLike,
    mass_ratio: ArrayLike = 3.5,
    stiffness_ratio: ArrayLike = 1.21,
    restitution: ArrayLike = 1.0,
    *,
    steps: int = STEPS,
) -> Rebound:
    """Hertz contact; friction grows with the full tangential stiffness.

    Parameters
    ----------
    incidence, mass_ratio, restitution : array_like
        As in `linear`.
    stiffness_ratio : array_like
        zeta^2 > 0, normal stiffness dF2/d(depth) of an elastic contact over Mindlin's tangential
        stiffness 8 a G*; (2 - nu)/(2 (1 - nu)) for equal materials.
    steps : int
        Over the duration of contact; 3 to 10^7, and at least 1.0076 (1 + e) times the root
        of beta/zeta^2: with fewer the tangential oscillation turns by more than 2 in a step and
        grows. Close to that number it may still create energy: a search reached |velocity| = 11 |x|
        with the least number, many steps and e near 0; 1.8 |x| with twice as many.

    Returns
    -------
    Rebound
        The same fields and units as `planarimpact.continuum.rebound`, but no reversals;
        peak_friction, at most 1, and regime are what the steps show.

    Raises
    ------
    InputError
        If an argument is not a finite real number in its range, if shapes do not broadcast, or if
        there are too few steps for one of the impacts.

    Notes
    -----
    Its limit of many steps is not the elastic continuum: at beta = 3.5, zeta^2 = 17/14 the root
    mean square of the difference in velocity is 0.29 over x from 0 to 8, with 16 steps as with
    4096. The error of the steps falls with their first power, since friction grows with the
    radius at the end of each step. Nor does the law conserve energy: a friction force that is kept
    while its spring softens creates energy (Elata & Berryman 1996). Where beta/zeta^2 is so small
    that stick lasts, a solid sphere may leave up to 5 % faster than it came: |velocity| <= |x|
    and dissipation >= 0 do not hold for this law, however many steps there are.

    References
    ----------
    A. Di Renzo, F. P. Di Maio, Chem. Eng. Sci. 59 (2004) 525-541. LAMMPS, pair_style granular,
    tangential model mindlin/force. D. Elata, J. G. Berryman, Mech. Mater. 24 (1996) 229-240.

    Examples
    --------
    >>> [round(float(w), 2) for w in mindlin([1.0, 2.0, 8.0], 3.5, 17 / 14).velocity]
    [0.54, -0.18, 1.0]
    """
    return _rebound(MINDLIN, incidence, mass_ratio, stiffness_ratio, restitution, steps)


@checks.default_errors
def mindlin_rescaled(
    incidence: ArrayLike,
    mass_ratio: ArrayLike = 3.5,
    stiffness_ratio: ArrayLike = 1.21,
    restitution: ArrayLike = 1.0,
    *,
    steps: int = STEPS,
) -> Rebound:
    """Hertz contact as `mindlin`, but friction shrinks in proportion to the radius of contact.

    Parameters
    ----------
    incidence, mass_ratio, stiffness_ratio, restitution : array_like
        As in `mindlin`.
    steps : int
        As in `mindlin`.

    Returns
    -------
    Rebound
        As `mindlin`.

    Raises
    ------
    InputError
        As `mindlin`.

    Notes
    -----
    The elastic continuum without micro-slip: a Hertz contact that sticks and slips as a whole. It
    is no nearer to the continuum than `mindlin`: the root mean square of the difference is 0.31.
    Close to the least number of steps it may create energy: a search for the worst case reached
    |velocity| = 4.3 |x| with that number and 1.01 |x| with twice as many; no energy is created
    with four times as many. Friction that shrinks with the radius favours stick in restitution: at
    e = 1 the contact slides throughout from x = 2 beta - 2 zeta^2/3 on, where the continuum does
    from 2 beta - zeta^2. The error of the steps falls with their first
    power where the contact starts in stick.

    References
    ----------
    C. Thornton, S. J. Cummins, P. W. Cleary, Powder Technol. 233 (2013) 30-46. LAMMPS, pair_style
    granular, tangential model mindlin_rescale/force.

    Examples
    --------
    >>> [round(float(w), 2) for w in mindlin_rescaled([1.0, 2.0, 8.0], 3.5, 17 / 14).velocity]
    [0.45, -0.19, 1.0]
    """
    return _rebound(MINDLIN_RESCALED, incidence, mass_ratio, stiffness_ratio, restitution, steps)


class _Law(NamedTuple):
    """A law of contact; depth means the elastic depth, in units of d_max."""

    to_maximum: float  # time to maximum compression
    peak_force: float  # largest normal force, at depth 1
    stiffness: float  # largest normal stiffness, at depth 1
    hertzian: bool
    rescales: bool


LINEAR = _Law(math.pi / 2, 1.0, 1.0, hertzian=False, rescales=False)
MINDLIN = _Law(
    # The integral of dd/sqrt(1 - d^(5/2)) from 0 to 1.
    math.sqrt(math.pi) * math.gamma(1.4) / math.gamma(0.9),
    hertz.PEAK_FORCE,
    1.5 * hertz.PEAK_FORCE,
    hertzian=True,
    rescales=False,
)
MINDLIN_RESCALED = MINDLIN._replace(rescales=True)


def _rebound(
    law: _Law,
    incidence: ArrayLike,
    mass_ratio: ArrayLike,
    stiffness_ratio: ArrayLike,
    restitution: ArrayLike,
    steps: int,
) -> Rebound:
    signed, *groups = checks.impact(incidence, mass_ratio, stiffness_ratio, restitution)
    beta, zeta2, e = (a.reshape(-1) for a in groups)
    with np.errstate(over="ignore"):
        frequency = math.sqrt(law.stiffness) * (np.sqrt(beta) / np.sqrt(zeta2))
        angle = (1 + e) * law.to_maximum * frequency
    steps = checks.explicit_steps(steps, angle / STABLE_ANGLE, 3, MOST_STEPS)
    x = np.abs(signed).reshape(-1)
    velocity, impulse, peak = (np.empty(x.size) for _ in range(3))
    regime = np.empty(x.size, np.uint8)
    for start in range(0, x.size, CHUNK):
        part = slice(start, start + CHUNK)
        outcome = _impacts(law, x[part], beta[part], zeta2[part], e[part], steps)
        velocity[part], impulse[part], peak[part], regime[part] = outcome
    return Rebound.of(signed, velocity, impulse, peak, regime)


class _Instant(NamedTuple):
    """Normal motion at one step, arrays of one entry or of one for each impact."""

    force: Array
    touches: Booleans  # whether there is any force
    rate: Array  # growth of tangential force, for a unit of tangential velocity/zeta^2
    kept: Array | None  # share of the tangential force that is carried over; None for all
    kick: Array  # time over which the force at this step acts


def _normal_motion(law: _Law, e: Array, steps: int) -> Iterator[_Instant]:
    """Yield the `_Instant` of every step with a force: all but the first and the last step."""
    step = (1 + e) * (law.to_maximum / steps)
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
        radius_before, radius = radius, np.sqrt(elastic) if law.hertzian else 1.0
        force = law.peak_force * elastic * radius
        velocity = velocity - step * force
        # Velocity never increases. Once it is negative, every contact comes to its end.
        ended = ended | ((e == 0) & (velocity <= 0))
        kept = _share_kept(radius_before, radius) if law.rescales else None
        rate = step * law.stiffness * radius * touches
        yield _Instant(force, touches, rate, kept, np.where(ended, step / 2, step))


def _share_kept(before: Numbers, after: Numbers) -> Array:
    """Radius of contact over that of the step before where it shrinks, else 1."""
    return np.divide(after, before, out=np.ones_like(after), where=after < before)


def _impacts(
    law: _Law, x: Array, beta: Array, zeta2: Array, e: Array, steps: int
) -> tuple[Array, Array, Array, Integers]:
    """Velocity, impulse, peak friction and regime of impacts solved together, x >= 0."""
    # Normal motion depends on e alone: it is integrated once where all impacts have the same e.
    if (e == e[0]).all():
        e = e[:1]
    # Tangential velocity over zeta^2, half a step ahead.
    with np.errstate(over="ignore"):
        start = np.clip(x / zeta2, LEAST, LARGEST)
        start_share = np.minimum(x / zeta2 / LEAST, 1.0)  # x over the incidence that is solved
    velocity = start.copy()
    slowing = beta / zeta2
    friction, work, peak, lowest = np.zeros((4, x.size))
    slips, starts_in_slip = np.zeros((2, x.size), bool)
    slipped = np.ones(x.size, bool)  # slip before contact, so that an initial stick is counted
    sticks = np.zeros(x.size, np.int64)  # number of phases of stick
    started, normal_impulse = False, np.zeros(e.size)
    for normal in _normal_motion(law, e, steps):
        np.multiply(velocity, normal.rate, out=work)
        if normal.kept is not None:
            friction *= normal.kept
        work += friction
        np.abs(work, out=friction)
        np.greater(friction, normal.force, out=slips, where=normal.touches)
        if not started:
            started, starts_in_slip[:] = True, slips
        sticks += slipped > slips
        slipped[:] = slips
        np.minimum(friction, normal.force, out=friction)
        np.maximum(peak, friction, out=peak)
        np.copysign(friction, work, out=friction)
        np.minimum(lowest, friction, out=lowest)
        np.multiply(friction, slowing, out=work)
        work *= normal.kick
        velocity -= work
        normal_impulse = normal_impulse + normal.kick * normal.force
    # Where the direction of slip has changed the contact has stuck, for less than a step.
    sticks += (sticks == 0) & (lowest < 0)
    # In slip throughout the difference of velocities would have few digits at large x.
    slides = sticks == 0
    impulse = np.where(slides, normal_impulse, 0.0)
    final = x - beta * impulse
    final[~slides] = (x * (velocity / start))[~slides]
    impulse = np.where(slides, impulse, x / beta - final / beta)
    regime = _regime(sticks, starts_in_slip, slips)
    peak *= start_share
    return final, impulse, np.minimum(peak / law.peak_force, 1.0), regime


def _regime(sticks: Integers, starts_in_slip: Booleans, ends_in_slip: Booleans) -> Integers:
    """Regime by the number of phases of stick and by the first and the last step."""
    after_stick = np.where(ends_in_slip, Regime.STICK_SLIP, Regime.STICK)
    after_slip = np.where(ends_in_slip, Regime.SLIP_STICK_SLIP, Regime.SLIP_STICK)
    once = np.where(starts_in_slip, after_slip, after_stick)
    once_or_more = np.where(sticks > 1, Regime.MULTIPLE, once)
    return np.where(sticks == 0, Regime.SLIP_THROUGHOUT, once_or_more)
