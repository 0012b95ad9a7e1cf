"""Tangential motion over a Hertz contact: gross slip first, which has a closed form, then steps.

The method is Stoermer-Verlet in equal steps of the phase of `normal_impact.hertz`. The force is
that of the row of springs of `micro_slip`.

A contact starts with a share g = min(1, x/zeta^2) of the limit of friction at every radius. If that
share stayed, the displacement would be g d, and the velocity would fall by g beta (1 - v). Only the
difference from this motion is integrated. So gross slip is exact. Close to gross slip the distance
from it decides whether the contact slips or sticks, and that distance may be far smaller than the
error of a step in the whole motion.

Arguments have been checked by `planarimpact.continuum`. The units are its own: velocity mu |v2(0)|,
force mu times the largest normal force, radius a_max.
"""

import numpy as np

from planarimpact.continuum.micro_slip import SpringRow
from planarimpact.ground import sliding
from planarimpact.ground.arrays import Array
from planarimpact.normal_impact import hertz


def first_stick(x: Array, beta: Array, zeta2: Array) -> tuple[Array, Array]:
    """Where gross slip from the start of contact ends: at once for x <= zeta^2.

    Parameters
    ----------
    x, beta, zeta2 : ndarray, shape (n,)
        Impacts that do not slide throughout, x >= 0.

    Returns
    -------
    phase, velocity : ndarray, shape (n,)

    Notes
    -----
    Slip lasts while the body outruns the spring in the middle, w > zeta^2 v. With friction mu F2,
    w = x - beta (1 - v), which yields v.

    Examples
    --------
    >>> phase, velocity = first_stick(np.array([3.5]), np.array([3.5]), np.array([1.21]))
    >>> round(float(phase[0] / np.pi), 9), float(velocity[0])  # maximum compression
    (0.5, 0.0)
    """
    slips = x > zeta2
    normal = np.where(slips, (beta - x) / np.where(slips, beta - zeta2, 1.0), 1.0)
    return hertz.phase_at(normal), np.where(slips, zeta2 * normal, x)


def gross_slip(x: Array, beta: Array, zeta2: Array) -> list[Array]:
    """Path of one contact from its start to the end of gross slip, which may be separation.

    Parameters
    ----------
    x, beta, zeta2 : ndarray, shape (1,)

    Returns
    -------
    list of ndarray, shape (m,)
        Phase, friction, velocity and radius of stick (zeros); one point where nothing slips.

    Examples
    --------
    >>> phase, friction, velocity, _ = gross_slip(*np.array([[8.0], [3.5], [1.21]]))
    >>> float(velocity[-1])
    1.0
    """
    end = np.full(1, np.pi)
    if x[0] < sliding.limit(beta[0], zeta2[0], 1.0):
        end, _ = first_stick(x, beta, zeta2)
    phase = np.linspace(0.0, end[0], 129 if end[0] > 0 else 1)
    friction = np.sin(phase) ** 3 * (x[0] > 0)
    velocity = x - beta * (1 - hertz.velocity(phase))
    return [phase, friction, velocity, np.zeros(phase.size)]


def path(x: Array, beta: Array, zeta2: Array, steps: int) -> Array:
    """Integrate from the end of gross slip to separation.

    Parameters
    ----------
    x, beta, zeta2 : ndarray, shape (n,)
        Impacts that do not slide throughout, x >= 0.
    steps : int

    Returns
    -------
    phase, friction, velocity, stick_radius, reserve, centre : ndarray, shape (steps + 1, n)
        The last two in the unit of the spring row: the displacement that the spring in the middle
        is short of its limit, and what it remembers.

    Examples
    --------
    >>> path(*np.array([[2.0], [3.5], [1.21]]), steps=64)[2, -1].round(3)
    array([-0.665])
    """
    start, velocity = first_stick(x, beta, zeta2)
    step = (np.pi - start) / steps
    radius, pace, normal = hertz.state(start)
    separated = np.zeros(x.size), np.zeros(x.size), np.full(x.size, -1.0)
    first = radius * radius
    row = SpringRow(radius, 2 * steps)
    found = np.empty((6, steps + 1, x.size))
    found[:, 0] = start, radius**3, velocity, row.stick_radius, np.zeros(x.size), row.centre
    share = np.minimum(x / zeta2, 1.0)
    drag = share * beta
    kick = beta * hertz.PEAK_FORCE * step / 2
    bend = drag - share * zeta2
    # Differences from the motion with the share g: `excess` of velocity, w - g beta v, `lead` of
    # displacement, u - g d, and `lack` of friction, which is missing to that share.
    excess, lead, lack = velocity - drag * normal, np.zeros(x.size), np.zeros(x.size)
    for n in range(1, steps + 1):
        # One step of Stoermer-Verlet: half a kick, a drift by the velocity in the middle, the new
        # force, half a kick. `early` and `middle` are rates of `lead` by phase, `growth` that of d.
        early = pace * (excess + bend * normal) / zeta2
        growth = pace * normal
        excess = excess + kick * pace * lack
        phase = start + (n - 0.5) * step
        _, pace, normal = hertz.state(phase)
        middle = pace * (excess + bend * normal) / zeta2
        rates = (early, growth), (middle, pace * normal)
        # The row first stops at the place within the step where slip ends, if there is one.
        _turn(row, phase - step / 2, step, share, lead - share * first, rates)
        lead = lead + step * middle
        phase = phase + step / 2
        radius, pace, normal = hertz.state(phase) if n < steps else separated
        depth = radius * radius
        displacement = lead + share * (depth - first)
        friction = row.move(radius, displacement)
        lack = share * (depth * radius) - friction
        excess = excess + kick * pace * lack
        reserve = depth - np.abs(displacement + row.centre)
        found[:, n] = phase, friction, excess + drag * normal, row.stick_radius, reserve, row.centre
    return found


def _turn(
    row: SpringRow,
    phase: Array,
    step: Array,
    share: Array,
    lead: Array,
    rates: tuple[tuple[Array, Array], tuple[Array, Array]],
) -> None:
    """Move the row to where slip ends within a step, if it does.

    Slip in the direction g stops when g u - d is largest. Every slipped spring remembers that
    value. A step over it leaves an error that varies irregularly, which extrapolation cannot
    remove. `rates` are those of the lead and of d, by phase, at the start of the step and in its
    middle.
    """
    (early, growth_early), (middle, growth_middle) = rates
    for direction in (1, -1):
        # The rate of g u - d at both ends of the step, as a straight line through its values at the
        # start and in the middle. Slip ends at the zero of that line, if it falls through zero.
        surplus = direction * share - 1
        at_start = direction * early + surplus * growth_early
        at_end = 2 * (direction * middle + surplus * growth_middle) - at_start
        turns = np.flatnonzero((at_start > 0) & (at_end < 0))
        if turns.size:
            part = at_start[turns] / (at_start - at_end)[turns]
            travel = part * (early[turns] + (middle - early)[turns] * part)
            radius = np.sin(phase[turns] + part * step[turns])
            moved = lead[turns] + step[turns] * travel + share[turns] * radius * radius
            row.move(radius, moved, turns)
