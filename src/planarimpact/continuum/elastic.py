"""Elastic spheres: impacts in closed form where there is one, in steps elsewhere."""

import numpy as np

from planarimpact.common import sliding
from planarimpact.common.arrays import Array, Booleans, Integers, in_parts
from planarimpact.common.results import Regime
from planarimpact.continuum import refinement, tangential_motion
from planarimpact.continuum.refinement import Solved

FIRST_STEPS, MOST_STEPS = 16, 2**15
# Factor of the estimated error. With it none of 7000 random impacts had an error above 0.3 of the
# tolerance, and a search for the worst impact found 0.9 of it.
SAFETY = 5
# The golden section searches for the peak of friction, to 1e-5 of a step.
SECTIONS, GOLDEN = 24, 0.381966
# Steps times impacts solved together: this bounds the memory to some 100 MB.
CELLS = 2**20

_UNSOLVED = 255


def rebound(
    x: Array, beta: Array, zeta2: Array, tolerance: Array
) -> tuple[Array, Array, Array, Integers, Integers]:
    """Velocity, peak friction, work of friction, regime and reversals, each (n,), for x >= 0."""
    velocity, impulse, peak, regime, reversals = _at_limits(x, beta, zeta2)
    stepped = np.flatnonzero(regime == _UNSOLVED)
    groups = x[stepped], beta[stepped], zeta2[stepped]
    with refinement.counted_among(stepped):
        needed = refinement.steps_needed(*groups[1:])
        values, counts = refinement.refine(
            groups, needed, tolerance[stepped], _integrate, FIRST_STEPS, MOST_STEPS, SAFETY
        )
    # The exact values have these bounds. Extrapolation and rounding may exceed them.
    velocity[stepped] = np.clip(values[0], -groups[0], groups[0])
    at_limit = (groups[0] > groups[2]) & (groups[0] >= groups[1])
    peak[stepped] = np.where(at_limit, 1.0, np.clip(values[1], 0.0, 1.0))
    regime[stepped] = refinement.regime(groups[0], groups[2], counts[0])
    reversals[stepped] = counts[1]
    impulse[stepped] = ((x - velocity) / beta)[stepped]
    # Stronge's theorem, the paper's footnote: impulse times mean velocity.
    return velocity, peak, impulse * (x / 2 + velocity / 2), regime, reversals


def contact(x: Array, beta: Array, zeta2: Array, tolerance: Array) -> list[Array]:
    """Phase, friction, velocity and radius of stick over one contact, each of shape (m,)."""
    slid = tangential_motion.gross_slip(x, beta, zeta2)
    if x[0] < sliding.limit(beta[0], zeta2[0], 1.0):
        # Friction and velocity are judged.
        stuck = refinement.settled_path(
            lambda steps: list(tangential_motion.path(x, beta, zeta2, steps)),
            (1, 2),
            (x, beta, zeta2),
            refinement.steps_needed(beta, zeta2),
            tolerance,
            MOST_STEPS,
        )
        slid = [np.concatenate([a[:-1], b[:, 0]]) for a, b in zip(slid, stuck, strict=False)]
    return slid


def _at_limits(
    x: Array, beta: Array, zeta2: Array
) -> tuple[Array, Array, Array, Integers, Integers]:
    """Velocity, impulse of friction, peak friction, regime and reversals of closed forms.

    All other impacts have `_UNSOLVED` in place of the regime.
    """
    slides = x >= sliding.limit(beta, zeta2, 1.0)
    velocity = np.where(slides, sliding.velocity(x, beta, 1.0), 0.0)
    regime = np.where(x > 0, _UNSOLVED, Regime.STICK).astype(np.uint8)
    regime[slides] = Regime.SLIP_THROUGHOUT
    full = np.where(slides, 1.0, 0.0)
    return velocity, 2 * full, full, regime, np.zeros(x.shape, dtype=np.int64)


def _integrate(groups: tuple[Array, ...], steps: int) -> Solved:
    """Answers of so many steps, of which the values are velocity and peak friction."""
    x, beta, zeta2 = groups

    def solve(part: slice) -> Solved:
        return _summary(*tangential_motion.path(x[part], beta[part], zeta2[part], steps))

    return Solved._make(in_parts(x.size, max(1, CELLS // steps), solve))


def _summary(
    phase: Array,
    friction: Array,
    velocity: Array,
    stick_radius: Array,
    reserve: Array,
    centre: Array,
) -> Solved:
    gross = stick_radius == 0
    gross_slips = np.sum(gross[1:] & ~gross[:-1], axis=0)
    counts = np.stack([gross_slips, refinement.sign_changes(friction)])
    values = np.stack([velocity[-1], _peak(phase, np.abs(friction), gross)])
    return Solved(values, counts, _nearest(reserve, centre, gross))


def _nearest(reserve: Array, centre: Array, gross: Booleans) -> Array:
    """How far each contact is from one gross slip more or less, a displacement of `micro_slip`.

    This is the smallest displacement that was missing for a gross slip, or that the contact slid in
    a gross slip between two sticks. It is 1, which no reserve exceeds, if there is neither.
    """
    here = reserve[1:-1]
    lowest = (here < reserve[:-2]) & (here <= reserve[2:]) & (here > refinement.ROUNDING)
    nearest = np.min(here, axis=0, where=lowest, initial=1.0)
    onsets, ends = ~gross[:-1] & gross[1:], gross[:-1] & ~gross[1:]
    for i in np.flatnonzero(np.sum(ends, axis=0) > 1):
        first, last = np.flatnonzero(onsets[:, i]), np.flatnonzero(ends[:, i])[1:] + 1
        slid = np.abs(centre[last, i] - centre[first[: last.size], i])
        nearest[i] = min(nearest[i], np.min(slid))
    return nearest


def _peak(phase: Array, force: Array, gross: Booleans) -> Array:
    """Largest force of each column, between the points too.

    Between the points the force is a share of sin(phase)^3 minus a deficit, which is a parabola. As
    gross slip sets in, the share is 1, and the deficit vanishes with the power 3/2 of the time that
    is left. There the power 2/3 of the deficit is a parabola, through three points before gross
    slip.
    """
    top = force.argmax(axis=0)
    column = np.arange(top.size)
    last = np.clip(top + 1, 2, len(force) - 2)
    last -= gross[last, column]  # up to two points of gross slip may be among the three
    last -= gross[last, column]
    slides = gross[last, column]
    last = np.maximum(last, 2)
    points = np.stack([last - 2, last - 1, last])
    normal, forces = np.sin(phase[points, column]) ** 3, force[points, column]
    deficits = np.maximum(normal - forces, 0.0)
    nears = (deficits[2] < deficits[0]) & (2 * forces[1] > normal[1])
    share = np.where(nears | slides, 1.0, forces[1] / normal[1])
    before, at, after = np.where(nears, deficits ** (2 / 3), share * normal - forces)
    slope, bend = (after - before) / 2, before - 2 * at + after
    middle, step = phase[last - 1, column], phase[1] - phase[0]

    def force_at(at_phase: Array) -> Array:
        t = (at_phase - middle) / step
        deficit = at + t * (slope + t * bend / 2)
        deficit = np.where(nears, np.maximum(deficit, 0.0) ** 1.5, deficit)
        return share * np.sin(at_phase) ** 3 - np.where(slides, 0.0, deficit)

    low = phase[np.maximum(top - 1, 0), column]
    high = phase[np.minimum(top + 1, len(force) - 1), column]
    for _ in range(SECTIONS):
        third = (high - low) * GOLDEN
        left, right = low + third, high - third
        rises = force_at(left) < force_at(right)
        low, high = np.where(rises, left, low), np.where(rises, high, right)
    return force_at((low + high) / 2)
