"""Oblique impact of inelastic spheres with micro-slip, for e < 1, in steps.

The method is that of dimensionality reduction, as for elastic spheres in `micro_slip`. The contact
is a row of springs. `viscous` and `plastic` give the normal motion and the springs, each for one
law of `planarimpact.normal_impact`. Here the springs of either law are moved sideways.

Let u be the tangential displacement of the body over zeta^2, q the deflection of a spring over
zeta^2, and L its normal force density. A spring has the tangential force density q + tau q', at
most L. While it sticks q' = u'. A spring that loses contact forgets its deflection. What it
remembers is c = q - u. With V = u + tau u' the density is V + c while the spring sticks. In slip it
is L or -L, and tau c' = density - (V + c): the part beyond the limit relaxes. Springs of metal have
no tau: q is moved to the limit at once. While the contact yields q also decays, see `plastic`.

Springs stand at the radii where the edge of the contact is at each instant. So the edge is always
at a spring, and the error falls with the square of the steps.
"""

from typing import NamedTuple

import numpy as np

from planarimpact.common import sliding
from planarimpact.common.arrays import Array, Booleans, Integers, in_parts
from planarimpact.common.losses import PLASTIC, VISCOUS, Loss
from planarimpact.common.results import Regime
from planarimpact.continuum import refinement
from planarimpact.continuum.inelastic import peaks
from planarimpact.continuum.inelastic.motion import MOST_STEPS, NormalMotion, places
from planarimpact.continuum.inelastic.plastic import PlasticMotion
from planarimpact.continuum.inelastic.viscous import ViscousMotion
from planarimpact.continuum.refinement import Solved

# The normal motion and the springs, by what takes the energy.
MOTIONS: dict[Loss, type[NormalMotion]] = {VISCOUS: ViscousMotion, PLASTIC: PlasticMotion}
# Friction within this share of its limit is gross slip. Near separation less stick than that cannot
# be told from rounding.
GROSS = 1 - 1e-6
FIRST_STEPS = 32
# Factor of the estimated error. With it searches that climb to the worst of 1800 impacts, beside
# thresholds and at tolerances from 1e-4 to 5e-3, found errors of at most 0.53 of the tolerance.
SAFETY = 2
# Steps times impacts solved together: their springs stay in the cache.
CELLS = 2**15


class Path(NamedTuple):
    """Impacts step by step, arrays of shape (steps + 1, n), in the units of `ContinuumHistory`."""

    time: Array
    normal: Array
    friction_force: Array
    velocity: Array
    radius: Array
    stick_radius: Array
    peak: Array  # largest friction, between the instants too, shape (n,)
    work: Array  # of friction, in that of `planarimpact.lumped.rebound`, shape (n,)


def rebound(
    x: Array, beta: Array, zeta2: Array, e: Array, kind: type[NormalMotion], tolerance: Array
) -> tuple[Array, Array, Array, Integers, Integers]:
    """Velocity, peak friction, work of friction, regime and reversals, each of shape (n,).

    For x >= 0 and e below 1; `kind` is one of `MOTIONS`. Raises `Unsolved` as `refinement.refine`.
    """
    motion = kind(e)
    slides = x >= motion.slides_from(beta, zeta2)
    velocity = np.where(slides, sliding.velocity(x, beta, e), 0.0)
    peak, regime = slides.astype(float), np.where(slides, Regime.SLIP_THROUGHOUT, Regime.STICK)
    reversals = np.zeros(x.size, np.int64)
    work = np.where(slides, motion.work_of_first_slip(x, beta, zeta2, -e), 0.0)
    sticks = np.flatnonzero((x > 0) & ~slides)
    groups = x[sticks], beta[sticks], zeta2[sticks], e[sticks]

    def integrate(groups: tuple[Array, ...], steps: int) -> Solved:
        def solve(part: slice) -> Solved:
            x, beta, zeta2, e = (group[part] for group in groups)
            return _summary(path(x, beta, zeta2, e, kind, steps))

        return Solved._make(in_parts(groups[0].size, max(32, CELLS // steps), solve))

    with refinement.counted_among(sticks):
        values, counts = refinement.refine(
            groups,
            motion.steps_needed(beta, zeta2)[sticks],
            tolerance[sticks],
            integrate,
            FIRST_STEPS,
            MOST_STEPS,
            SAFETY,
        )
    # The exact values have these bounds. Extrapolation and rounding may exceed them.
    velocity[sticks] = np.clip(values[0], -x[sticks], x[sticks])
    peak[sticks], work[sticks] = np.clip(values[1], 0.0, 1.0), values[2]
    regime[sticks] = refinement.regime(x[sticks], zeta2[sticks], counts[0])
    reversals[sticks] = counts[1]
    return velocity, peak, work, regime, reversals


def path(
    x: Array, beta: Array, zeta2: Array, e: Array, kind: type[NormalMotion], steps: int
) -> Path:
    """Integrate from contact to separation, in an even number of steps: half are compression.

    For x > 0 and e below 1, shape (n,); `kind` is one of `MOTIONS`.
    """
    motion, column = kind(e), np.arange(x.size)
    slips, onset = x > zeta2, _put_springs(motion, x, beta, zeta2, steps)
    start, approach, last, slid = (
        a[onset, column] for a in (motion.time, motion.approach, motion.velocity, motion.force)
    )
    # The largest force of that slip.
    peak = np.where(last > motion.velocity_at_largest_force, slid, motion.largest_force) * slips
    work = motion.work_of_first_slip(x, beta, zeta2, last)
    springs = motion.springs()
    friction, velocity = motion.force.copy(), x - beta * (1 - motion.velocity)
    stick_radius, displacement = np.zeros((2, *friction.shape))
    u, w = (x * start - beta * (start - approach)) / zeta2, velocity[onset, column]
    displacement[onset, column] = u
    force = np.zeros(x.size)
    throughout = x >= motion.slides_from(beta, zeta2)
    onset = np.where(throughout, steps + 1, onset)  # never
    for k in range(1, steps + 1):
        begins, began = (onset == k - 1) & slips, onset < k
        if begins.any():
            springs.slide(k - 1, begins, u)
            force = np.where(begins, slid, force)
        step = np.where(began, motion.time[k] - motion.time[k - 1], 0.0)
        # Heun's method: a step with the force at its start, then one with the mean of both ends.
        # Springs without a dashpot hardly feel the velocity: once is enough (Verlet's method).
        ahead = w - beta * step * force
        for _ in range(1 + motion.dashpots):
            moved = u + step * (w + ahead) / 2 / zeta2
            new = springs.move(k, step, (u, w / zeta2), (moved, ahead / zeta2))
            ahead = w - beta * step * (force + new) / 2
        u, w, force = moved, np.where(began, ahead, w), np.where(began, new, force)
        work += zeta2 * springs.settle(k) * began
        friction[k, began], velocity[k, began], displacement[k, began] = (
            a[began] for a in (force, w, u)
        )
        stick_radius[k] = np.where(began, springs.stick_radius, 0.0)
    if not motion.dashpots:  # the springs are empty at separation: all that the body has lost
        work = (x - velocity[-1]) * (x + velocity[-1]) / (2 * beta)
    peak = _largest_friction(motion, slips, onset, peak, friction, displacement, velocity / zeta2)
    largest = motion.largest_force
    radius = np.concatenate([motion.radius, motion.radius[-2::-1]]) / motion.radius[-1]
    return Path(
        motion.time / motion.time[steps // 2],
        motion.force / largest,
        friction / largest,
        velocity,
        radius,
        stick_radius / motion.radius[-1],
        np.minimum(peak / largest, 1.0),  # a polynomial may exceed it
        work,
    )


def _put_springs(motion: NormalMotion, x: Array, beta: Array, zeta2: Array, steps: int) -> Integers:
    """Put the springs of impacts; return the instants at which gross slip from the start ends.

    They are numbers up to `steps`, shape (n,): 0 for x <= zeta^2.
    """
    slips = x > zeta2
    last = np.maximum(motion.end_of_first_slip(x, beta, zeta2), -motion.restitution)
    where, number = places(steps // 2, np.where(slips, motion.place(last), 0.0))
    motion.put_springs(where)
    return np.where(last > 0, number, steps - number) * slips


def _largest_friction(
    motion: NormalMotion,
    slips: Booleans,
    onset: Integers,
    peak: Array,
    friction: Array,
    displacement: Array,
    rate: Array,
) -> Array:
    """Largest friction of each contact, shape (n,), between the instants too.

    Contacts that slip from the start do so to the instant `onset`, with at most the friction
    `peak`. Friction, and displacement over zeta^2 with its rate, have the shape (steps + 1, n).
    """
    steps = len(friction) - 1
    searched = motion.instants_after_slip(steps)
    if searched:
        column = np.arange(onset.size)
        loads = motion.velocity[np.minimum(onset, steps), column] > 0
        after = np.minimum(onset + np.arange(1 + searched)[:, None], steps)
        knots = [motion.time, motion.approach, motion.velocity, displacement, rate]
        with np.errstate(divide="ignore", invalid="ignore"):  # impacts that are not used
            later = motion.peak_after_slip(np.stack([a[after, column] for a in knots], axis=1))
        used = slips & loads & (onset + searched <= steps)
        peak = np.maximum(peak, np.where(used, later, 0.0))
    size, instants = np.abs(friction), (motion.time, motion.velocity, motion.force)
    gross = size >= GROSS * motion.force
    return peaks.largest(instants, size, gross, onset, peak, searched)


def contact(
    x: Array, beta: Array, zeta2: Array, e: Array, kind: type[NormalMotion], tolerance: Array
) -> list[Array]:
    """One contact, its arguments of shape (1,): columns of `Path` up to the radius of stick."""
    fine = refinement.settled_path(
        lambda steps: path(x, beta, zeta2, e, kind, steps),
        (Path._fields.index("friction_force"), Path._fields.index("velocity")),
        (x, beta, zeta2),
        kind(e).steps_needed(beta, zeta2),
        tolerance,
        MOST_STEPS,
    )
    return [column[:, 0] for column in fine[:-2]]


def _summary(impacts: Path) -> Solved:
    """Answers whose values are velocity, peak friction and work.

    How near one gross slip more or less is, is not known here: 1 stands for it. So only a change of
    the count tells `refinement.refine` that a gross slip came or went.
    """
    size = np.abs(impacts.friction_force)
    gross = (size >= GROSS * impacts.normal)[1:-1]
    slips = np.sum(gross[1:] & ~gross[:-1], axis=0)
    counts = np.stack([slips, refinement.sign_changes(impacts.friction_force)])
    values = np.stack([impacts.velocity[-1], impacts.peak, impacts.work])
    return Solved(values, counts, np.ones(slips.size))
