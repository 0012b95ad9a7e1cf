"""Tangential motion over a Hertz contact: gross slip first, which has a closed form, then steps.

The method is Stoermer-Verlet in equal steps of the phase of `normal_impact.hertz`. The force is
that of the springs of `micro_slip`.

Symbols: incidence x, tangential velocity w and displacement u of the body, normal velocity v and
approach d. Units: w mu |v2(0)|, v |v2(0)|, force mu times the largest normal force, radius a_max,
u and d as in `micro_slip`.

A contact starts with a share g = min(1, x/zeta^2) of the limit of friction at every radius. If that
share stayed, u would be g d, and w would fall by g beta (1 - v). Only the difference from this
motion is integrated. So gross slip is exact. Close to gross slip the distance from it decides
whether the contact slips or sticks, and that distance may be far smaller than the error of a step
in the whole motion.
"""

import numpy as np

from planarimpact.common import sliding
from planarimpact.common.arrays import Array
from planarimpact.continuum.micro_slip import ElasticSprings
from planarimpact.normal_impact import hertz


def first_stick(x: Array, beta: Array, zeta2: Array) -> tuple[Array, Array]:
    """Phase and velocity where gross slip from the start of contact ends: at once for x <= zeta^2.

    Slip lasts while the body is faster than the spring in the middle, w > zeta^2 v. With friction
    mu F2, w = x - beta (1 - v), which yields v.
    """
    slips = x > zeta2
    normal = np.where(slips, (beta - x) / np.where(slips, beta - zeta2, 1.0), 1.0)
    return hertz.phase_at(normal), np.where(slips, zeta2 * normal, x)


def gross_slip(x: Array, beta: Array, zeta2: Array) -> list[Array]:
    """Phase, friction, velocity and radius of stick (zeros) of one contact while it first slips.

    From the start of contact to the end of gross slip or to separation; one point for no slip.
    """
    end = np.full(1, np.pi)
    if x[0] < sliding.limit(beta[0], zeta2[0], 1.0):
        end, _ = first_stick(x, beta, zeta2)
    phase = np.linspace(0.0, end[0], 129 if end[0] > 0 else 1)
    friction = np.sin(phase) ** 3 * (x[0] > 0)
    velocity = x - beta * (1 - hertz.velocity(phase))
    return [phase, friction, velocity, np.zeros(phase.size)]


def path(x: Array, beta: Array, zeta2: Array, steps: int) -> Array:
    """Integrate impacts that do not slide throughout, from the end of gross slip to separation.

    Returns phase, friction, velocity, radius of stick, reserve and centre, shape (6, steps + 1, n).
    The last two are displacements of `micro_slip`: by how much the spring in the middle is below
    its limit, and what it remembers.
    """
    start, velocity = first_stick(x, beta, zeta2)
    step = (np.pi - start) / steps
    radius, pace, normal = hertz.state(start)
    separated = np.zeros(x.size), np.zeros(x.size), np.full(x.size, -1.0)
    first = radius * radius
    springs = ElasticSprings(radius, 2 * steps)
    columns = np.empty((6, steps + 1, x.size))
    columns[:3, 0] = start, radius**3, velocity
    columns[3:, 0] = springs.stick_radius, np.zeros(x.size), springs.centre
    share = np.minimum(x / zeta2, 1.0)
    deceleration = share * beta
    kick = beta * hertz.PEAK_FORCE * step / 2
    coupling = deceleration - share * zeta2  # of the difference of displacement to v
    # The differences from the motion with the share g: of velocity, w - g beta v; of displacement,
    # u - g d; and of friction, g d^(3/2) minus the friction.
    velocity_difference = velocity - deceleration * normal
    displacement_difference, friction_difference = np.zeros((2, x.size))
    for n in range(1, steps + 1):
        # One step of Stoermer-Verlet: half a kick, a drift by the velocity in the middle, the new
        # force, half a kick. `early` and `middle` are the rates of the difference of displacement
        # by phase, at the start and in the middle of the step; `growth` is the rate of d.
        early = pace * (velocity_difference + coupling * normal) / zeta2
        growth = pace * normal
        velocity_difference = velocity_difference + kick * pace * friction_difference
        phase = start + (n - 0.5) * step
        _, pace, normal = hertz.state(phase)
        middle = pace * (velocity_difference + coupling * normal) / zeta2
        rates = (early, growth), (middle, pace * normal)
        # The springs first stop at the place within the step where slip ends, if there is one.
        displacement = displacement_difference - share * first
        _stop_where_slip_ends(springs, phase - step / 2, step, share, displacement, rates)
        displacement_difference = displacement_difference + step * middle
        phase = phase + step / 2
        radius, pace, normal = hertz.state(phase) if n < steps else separated
        depth = radius * radius
        displacement = displacement_difference + share * (depth - first)
        friction = springs.move(radius, displacement)
        friction_difference = share * (depth * radius) - friction
        velocity_difference = velocity_difference + kick * pace * friction_difference
        velocity = velocity_difference + deceleration * normal
        reserve = depth - np.abs(displacement + springs.centre)
        columns[:, n] = phase, friction, velocity, springs.stick_radius, reserve, springs.centre
    return columns


def _stop_where_slip_ends(
    springs: ElasticSprings,
    phase: Array,
    step: Array,
    share: Array,
    displacement: Array,
    rates: tuple[tuple[Array, Array], tuple[Array, Array]],
) -> None:
    """Move the springs to where slip ends within a step, if it does.

    Slip in the direction g stops when g u - d is largest. Every slipped spring remembers that
    value. A step over it leaves an error that varies irregularly, which extrapolation cannot
    remove. `rates` are those by phase of u - g d and of d, at the start of the step and in its
    middle; `displacement` is u - g d less g times the first d.
    """
    (early, growth_early), (middle, growth_middle) = rates
    for direction in (1, -1):
        # The rate of g u - d at both ends of the step, as a straight line through its values at the
        # start and in the middle. Slip ends at the zero of that line, if it falls through zero.
        growth_share = direction * share - 1  # g u - d = g (u - g d) + (g^2 - 1) d
        at_start = direction * early + growth_share * growth_early
        at_end = 2 * (direction * middle + growth_share * growth_middle) - at_start
        turns = np.flatnonzero((at_start > 0) & (at_end < 0))
        if turns.size:
            part = at_start[turns] / (at_start - at_end)[turns]
            travel = part * (early[turns] + (middle - early)[turns] * part)
            radius = np.sin(phase[turns] + part * step[turns])
            moved = displacement[turns] + step[turns] * travel + share[turns] * radius * radius
            springs.move(radius, moved, turns)
