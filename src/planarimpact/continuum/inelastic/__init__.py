"""Oblique impact of inelastic spheres with micro-slip, for e < 1, in steps.

The method is that of dimensionality reduction, as for elastic spheres in `micro_slip`. The contact
is a row of springs. `kelvin_voigt` and `thornton` give the normal motion, each for one way to lose
energy. Here the springs are moved sideways. Let u be the tangential displacement of the body over
zeta^2, q the deflection of a spring over zeta^2, and L its normal force density. A spring has the
tangential force density q + tau q', at most L. While it sticks q' = u'. A spring that loses contact
forgets its deflection. What it remembers is c = q - u. With V = u + tau u' the density is V + c
while the spring sticks. In slip it is L or -L, and tau c' = density - (V + c): what is beyond the
limit relaxes. Without relaxation, tau = 0, c is moved to the limit at once.

Springs stand at the radii where the edge of the contact is at each instant. So the edge is always
at a spring, and the error falls with the square of the steps.
"""

from typing import NamedTuple

import numpy as np

from planarimpact.continuum import refinement
from planarimpact.continuum.inelastic.kelvin_voigt import KelvinVoigt
from planarimpact.continuum.inelastic.normal_motion import NormalMotion
from planarimpact.continuum.inelastic.thornton import Thornton
from planarimpact.continuum.refinement import Solved
from planarimpact.ground import sliding
from planarimpact.ground.arrays import Array, Booleans, Integers
from planarimpact.ground.checks import ConvergenceError, Unsolved
from planarimpact.ground.results import Regime

LOSSES = {"viscous": KelvinVoigt, "plastic": Thornton}
# Friction within this share of its limit is gross slip. Near separation less stick than that cannot
# be told from rounding.
GROSS = 1 - 1e-6
FIRST_STEPS, MOST_STEPS = 32, 2**12
# Factor of the estimated error.
SAFETY = 2
# Steps times impacts solved together: their springs stay in the cache.
CELLS = 2**15
# The peak of friction is sought at so many places of a few steps.
SAMPLES = 49
# Places within a step where the peak just after gross slip is sought.
PLACES = 24
# It is sought for two instants and a share of the steps.
AFTER = 48


class Path(NamedTuple):
    """Impacts step by step, one a column, in the units of `planarimpact.lumped.rebound`.

    Attributes
    ----------
    time : ndarray, shape (steps + 1, n)
        In that of compression.
    normal, friction : ndarray, shape (steps + 1, n)
        Over the largest normal force, and mu times that.
    velocity, radius, stick_radius : ndarray, shape (steps + 1, n)
        The radii over the largest radius of contact.
    start, force, peak : ndarray, shape (n,)
        Time when gross slip from the start ends, friction then, and the largest friction up to
        then.
    searched : bool
        Whether that peak has been sought after then too, for two instants.
    work : ndarray, shape (n,)
        Work of friction.
    """

    time: Array
    normal: Array
    friction: Array
    velocity: Array
    radius: Array
    stick_radius: Array
    start: Array
    force: Array
    peak: Array
    searched: bool
    work: Array


def rebound(
    x: Array, beta: Array, zeta2: Array, e: Array, tolerance: float, loss: str
) -> tuple[Array, Array, Array, Integers, Integers]:
    """Velocity, peak friction, work of friction, regime and reversals, each of shape (n,).

    Parameters
    ----------
    x, beta, zeta2, e : ndarray, shape (n,)
        x >= 0; e below 1.
    tolerance : float
    loss : str
        One of `LOSSES`.

    Raises
    ------
    Unsolved
        As `refinement.refine`.

    Examples
    --------
    >>> groups = np.array([[2.0], [3.5], [1.21], [0.8]])
    >>> rebound(*groups, 1e-5, "viscous")[0].round(4)
    array([-0.4805])
    """
    slides = x >= sliding.limit_alike(beta, zeta2, e)
    velocity = np.where(slides, sliding.velocity(x, beta, e), 0.0)
    peak, regime = slides.astype(float), np.where(slides, Regime.SLIP_THROUGHOUT, Regime.STICK)
    reversals = np.zeros(x.size, np.int64)
    work = np.where(slides, _work_sliding(x, beta, zeta2, e, loss), 0.0)
    rest = np.flatnonzero((x > 0) & ~slides)
    groups = x[rest], beta[rest], zeta2[rest], e[rest]

    def integrate(groups: tuple[Array, ...], steps: int) -> Solved:
        x, beta, zeta2, e = groups

        def solve(part: slice) -> Solved:
            return _summary(path(x[part], beta[part], zeta2[part], e[part], loss, steps))

        return refinement.in_parts(x.size, max(32, CELLS // steps), solve)

    try:
        values, counts = refinement.refine(
            groups, tolerance, integrate, FIRST_STEPS, MOST_STEPS, SAFETY
        )
    except Unsolved as error:
        error.impacts = rest[error.impacts]
        raise
    # The exact values have these bounds. Extrapolation and rounding may exceed them.
    velocity[rest] = np.clip(values[0], -x[rest], x[rest])
    peak[rest], work[rest] = np.clip(values[1], 0.0, 1.0), values[2]
    if loss == "plastic":  # the springs are elastic, and empty at separation
        work[rest] = (groups[0] - velocity[rest]) * (groups[0] + velocity[rest]) / (2 * groups[1])
    regime[rest] = refinement.regime(x[rest], zeta2[rest], counts[0])
    reversals[rest] = counts[1]
    return velocity, peak, work, regime, reversals


def path(x: Array, beta: Array, zeta2: Array, e: Array, loss: str, steps: int) -> Path:
    """Integrate from contact to separation.

    Parameters
    ----------
    x, beta, zeta2, e : ndarray, shape (n,)
        x > 0; e below 1.
    loss : str
        One of `LOSSES`.
    steps : int
        Even: half of them are compression.

    Returns
    -------
    Path

    Examples
    --------
    >>> groups = np.array([[2.0], [3.5], [1.21], [0.8]])
    >>> [path(*groups, loss, 128).velocity[-1].round(3) for loss in LOSSES]
    [array([-0.482]), array([-0.415])]
    """
    motion = LOSSES[loss](e, steps // 2)
    # Gross slip from the start ends at this normal velocity, at once for x <= zeta^2.
    slips = x > zeta2
    last = np.maximum(motion.grip(x, beta, zeta2), -e)
    start, approach, slid = (np.where(slips, a, 0.0) for a in motion.when(last))
    throughout = x >= sliding.limit_alike(beta, zeta2, e)
    start = np.where(throughout, 2 * motion.time[-1], start)  # never
    # The largest force of that slip.
    peak = np.where(last > motion.velocity_at_largest_force, slid, motion.largest_force)
    row = _Row(motion)
    friction, velocity = motion.force.copy(), x - beta * (1 - motion.velocity)
    stick_radius = np.zeros_like(friction)
    u, w = (
        (x * start - beta * (start - approach)) / zeta2,
        np.where(slips, x - beta * (1 - last), x),
    )
    force, began = np.zeros(x.size), start == 0
    # Time, approach, normal velocity, displacement and its rate when slip ends, and at some
    # instants after that; and how many of them are known.
    knots = np.zeros((3 + steps // AFTER, 5, x.size))
    knots[:] = start, approach, last, u, w / zeta2
    known = np.ones(x.size, dtype=np.intp)
    work = _work_sliding(x, beta, zeta2, -last, loss)
    for k in range(1, steps + 1):
        before, after = motion.time[k - 1 : k + 1]
        begins = ~began & (after > start)
        if begins.any():
            row.slide(begins, approach, last, u)
            force = np.where(begins, slid, force)
            if not motion.viscous:  # the springs hold strain, which no friction has taken yet
                work -= begins * zeta2 * row.strain()
            began |= begins
        step = np.where(began, after - np.maximum(before, start), 0.0)
        pace = np.where(begins, last, motion.velocity[k - 1])
        # Heun's method: a step with the force at its start, then one with the mean of both ends.
        # Elastic springs do not feel the velocity, so that once is enough (Verlet's method).
        ahead = w - beta * step * force
        for _ in range(1 + motion.viscous):
            moved = u + step * (w + ahead) / (2 * zeta2)
            new = row.move(k, step, pace, (u, w / zeta2), (moved, ahead / zeta2))
            ahead = w - beta * step * (force + new) / 2
        u, w, force = moved, np.where(began, ahead, w), np.where(began, new, force)
        work += zeta2 * row.settle(k) * began
        friction[k, began], velocity[k, began] = force[began], w[began]
        stick_radius[k] = np.where(began, row.stick_radius, 0.0)
        if not motion.viscous and (began & (known < len(knots))).any():
            which = np.flatnonzero(began & (known < len(knots)))
            here = np.array([after, motion.approach[k], motion.velocity[k], u, w / zeta2])
            knots[known[which], :, which] = here[:, which].T
            known[which] += 1
    if not motion.viscous:
        soon = slips & (last > 0) & (known == len(knots))
        with np.errstate(divide="ignore", invalid="ignore"):  # where it is not sought
            later = _peak_after_slip(motion, knots)
        peak = np.maximum(peak, np.where(soon, later, 0.0))
    largest = motion.largest_force
    radius = np.concatenate([motion.radius, motion.radius[-2::-1]]) / motion.radius[-1]
    return Path(
        motion.time / motion.time[steps // 2],
        motion.force / largest,
        friction / largest,
        velocity,
        radius,
        stick_radius / motion.radius[-1],
        start / motion.time[steps // 2],
        slid / largest,
        np.where(slips, peak, 0.0) / largest,
        not motion.viscous,
        work,
    )


def contact(
    x: Array, beta: Array, zeta2: Array, e: Array, loss: str, tolerance: float
) -> list[Array]:
    """One contact, its arguments of shape (1,): columns of `Path` up to the radius of stick."""
    refinement.refuse_hopeless(x, beta, zeta2, tolerance, MOST_STEPS)
    steps, why = 128, None
    coarse = path(x, beta, zeta2, e, loss, steps)
    while not why:
        steps *= 2
        fine = path(x, beta, zeta2, e, loss, steps)
        # An error that falls with the square of the steps is a third of the change. The instants of
        # a coarse path are among those of a fine one.
        pairs = (fine.friction, coarse.friction), (fine.velocity, coarse.velocity)
        change = max(np.max(np.abs(a[::2] - b)) / 3 for a, b in pairs)
        resolved = steps >= refinement.steps_needed(beta, zeta2)[0]
        if resolved and change <= tolerance:
            return [column[:, 0] for column in fine[:6]]
        if resolved and not refinement.in_reach(np.asarray(change), tolerance, steps, MOST_STEPS):
            why = refinement.not_met(x[0], beta[0], zeta2[0], tolerance, steps, change, MOST_STEPS)
        coarse = fine
    raise ConvergenceError(why)


def _summary(found: Path) -> Solved:
    """Raw velocity, peak and work; counts of gross slips after stick and of reversals; ones.

    The last stands for how far a contact is from one gross slip more or less, which is not known.
    """
    size = np.abs(found.friction)
    gross = (size >= GROSS * found.normal)[1:-1]
    slips = np.sum(gross[1:] & ~gross[:-1], axis=0)
    counts = np.stack([slips, refinement.sign_changes(found.friction)])
    # The largest force is that of gross slip from the start, or comes just after that, or lies near
    # the instant that has the largest.
    column = np.arange(slips.size)
    first = np.clip(np.sum(found.time <= found.start, axis=0), 1, len(size) - 3)
    # A point too near to the first one would make the polynomial through them steep.
    step = found.time[first, column] - found.time[first - 1, column]
    first += found.time[first, column] - found.start < step / 2
    top = np.clip(np.argmax(size, axis=0), 2, len(size) - 3)
    lower = size[top - 1, column] > size[top + 1, column]
    around = top + np.arange(-1, 3)[:, None] - lower
    late = [(found.time[k, column], size[k, column]) for k in around]
    early = [(found.time[k, column], size[k, column]) for k in (first, first + 1)]
    peak = np.where(around[0] >= first, _top(late), size[top, column])
    if found.searched:
        past = around[0] >= first + len(found.time) // AFTER // 2
        peak = np.where(past | (found.start == 0), peak, size[top, column])
    else:
        peak = np.maximum(peak, _top([(found.start, np.abs(found.force)), *early]))
    values = np.stack([found.velocity[-1], np.maximum(peak, found.peak), found.work])
    return values, counts, np.ones(slips.size)


def _peak_after_slip(motion: NormalMotion, knots: Array) -> Array:
    """Largest friction soon after gross slip of elastic springs, by the limits in between.

    Friction grows on, turns and falls within a step, as one spring after the other sticks. Then
    each keeps c, the least value that limit less displacement has had. Approach and displacement
    are cubics between the knots.
    """
    count = len(motion.radius)
    width = motion.width.copy()
    width[0] /= 2
    limit = motion.sliding_deflection(knots[0, 1], knots[0, 2], count)
    memory = limit - knots[0, 3]
    points = [(knots[0, 0], motion.force_at(knots[0, 1], knots[0, 2]))]
    for left, right in zip(knots, knots[1:], strict=False):
        step = right[0] - left[0]
        for share in np.linspace(0.0, 1.0, 1 + max(2, PLACES // len(knots)))[1:]:
            approach = _cubic(share, left[1], right[1], step * left[2], step * right[2])
            velocity = left[2] + share * (right[2] - left[2])
            u = _cubic(share, left[3], right[3], step * left[4], step * right[4])
            limit = motion.sliding_deflection(approach, velocity, count)
            memory = np.minimum(memory, limit - u)
            whole = np.sum(width * limit, axis=0)
            lack = np.sum(width * (limit - u - memory), axis=0)
            force = motion.force_at(approach, velocity)
            force = force * (1 - lack / np.where(whole > 0, whole, 1.0))
            points.append((left[0] + share * step, force))
    times, forces = (np.array(column) for column in zip(*points, strict=True))
    top = np.clip(np.argmax(forces, axis=0), 1, len(forces) - 2)
    column = np.arange(top.size)
    return _top([(times[k, column], forces[k, column]) for k in (top - 1, top, top + 1)])


def _cubic(share: float, before: Array, after: Array, rise: Array, fall: Array) -> Array:
    """Cubic through two values with two changes by the step, at a share of the step."""
    change = after - before
    bend = 3 * change - 2 * rise - fall + share * (rise + fall - 2 * change)
    return before + share * (rise + share * bend)


def _top(points: list[tuple[Array, Array]]) -> Array:
    """Largest value between the first and the last point of a polynomial through all of them."""
    times = [time for time, _ in points]
    grid = times[0] + np.linspace(0.0, 1.0, SAMPLES)[:, None] * (times[-1] - times[0])
    value = np.zeros_like(grid)
    for time, height in points:
        factors = [(grid - other) / (time - other) for other in times if other is not time]
        value += height * np.prod(factors, axis=0)
    return value.max(axis=0)


def _work_sliding(x: Array, beta: Array, zeta2: Array, e: Array, loss: str) -> Array:
    """Work of friction in slip from the start, until the normal velocity is -e.

    Friction mu F2 acts on the velocity w - zeta^2 v of the springs, w = x - beta (1 - v). With
    plastic loss this is all that the body loses: strain is included, which is 0 at separation.
    """
    if loss == "plastic":
        return sliding.work(x, beta, e)
    return (1 + e) * (x - zeta2 - (beta - zeta2) * (1 + e) / 2)


class _Row:
    """The springs of many contacts, innermost first, moved together from instant to instant.

    Attributes
    ----------
    stick_radius : ndarray, shape (n,)
        Radius inside which no spring slipped in the last step.
    """

    def __init__(self, motion: NormalMotion) -> None:
        self._motion = motion
        n = motion.tau.size
        # Memory c, limit L and tangential density of the springs that touch.
        self._memory, self._limit, self._density = np.zeros((3, 1, n))
        self._next = self._memory, self._limit, self._density
        self._since = np.zeros(n)  # approach at the last instant
        self._slips = np.zeros((1, n), dtype=bool)

    def slide(self, which: Booleans, approach: Array, velocity: Array, u: Array) -> None:
        """Put contacts in the state of gross slip at an approach and a normal velocity."""
        count = len(self._memory)
        self._since = np.where(which, approach, self._since)
        deflection = self._motion.sliding_deflection(approach, velocity, count)
        limit = deflection + self._motion.tau * velocity
        for mine, new in zip(
            (self._memory, self._limit, self._density), (deflection - u, limit, limit), strict=True
        ):
            mine[:, which] = new[:, which]

    def move(
        self,
        k: int,
        step: Array,
        pace: Array,
        start: tuple[Array, Array],
        end: tuple[Array, Array],
    ) -> Array:
        """Tangential force at instant k if the body moves from one (u, u') to another; a trial.

        `step` is the time since the start, and `pace` the normal velocity there.
        """
        motion = self._motion
        limit = motion.density(k)
        pull, later = (u + motion.tau * rate for u, rate in (start, end))
        count = min(len(limit), len(self._memory))
        parts = self._memory[:count], self._limit[:count], limit[:count]
        if motion.viscous:
            memory, density = _relaxed(*parts, pull, later, step, motion.tau)
        else:
            wanted = self._turned(k, parts, step, pace, start, end) + later
            density = np.clip(wanted, -limit[:count], limit[:count])
            memory = density - later
        if count < len(limit):  # a spring comes into contact, without deflection
            edge = np.clip(later - end[0], -limit[-1], limit[-1])
            memory, density = np.vstack([memory, -end[0]]), np.vstack([density, edge])
        self._next = memory, limit, density
        return self._sum(k)

    def _turned(
        self,
        k: int,
        parts: tuple[Array, Array, Array],
        step: Array,
        pace: Array,
        start: tuple[Array, Array],
        end: tuple[Array, Array],
    ) -> Array:
        """Memory after slip that ends within a step.

        Slip in direction g stops when g u less the limit is largest. Every slipped spring remembers
        that value. In the step it is a parabola, through its values at both ends and in the middle.
        A step over its top leaves an error that varies irregularly, which extrapolation cannot
        remove.
        """
        memory, limit, limit_after = parts
        motion, count = self._motion, len(memory)
        grown = limit_after[-1] - limit[-1]  # what the limit gains at the edge, and less inside
        slowing = (motion.velocity[k] - pace) * step
        between: Array | None = None
        for side in (1.0, -1.0):
            early, late = (side * rate * step for _, rate in (start, end))
            bend = slowing + early - late
            # A spring turns if the rate of its limit lies between those of the body.
            turns = (early > np.minimum(grown, 0.0) - bend) & (late < np.maximum(grown, 0.0) + bend)
            which = np.flatnonzero(turns & (early > late))
            if not which.size:
                continue
            if between is None:
                approach = _cubic(
                    0.5, self._since, motion.approach[k], step * pace, step * motion.velocity[k]
                )
                between = motion.sliding_deflection(
                    approach, (pace + motion.velocity[k]) / 2, count
                )
                halfway = _cubic(0.5, start[0], end[0], step * start[1], step * end[1])
                memory = memory.copy()
            c = parts[0][:, which]
            before = side * (c + start[0][which]) - limit[:, which]
            middle = side * (c + halfway[which]) - between[:, which]
            after = side * (c + end[0][which]) - limit_after[:, which]
            bulge = np.maximum(8 * middle - 4 * (before + after), 1e-300)
            part = np.clip(0.5 + (after - before) / bulge, 0.0, 1.0)
            top = before + part * (after - before + (1 - part) * bulge / 2)
            memory[:, which] -= side * np.maximum(top, 0.0)
        return memory

    def settle(self, k: int) -> Array:
        """Keep the last trial; return the work of friction over zeta^2 in its step."""
        memory, _, density = self._next
        count = min(len(memory), len(self._memory))
        slid = self._memory[:count] - memory[:count]
        mean = (self._density[:count] + density[:count]) / 2
        width = self._motion.width[:count]
        work = 2 * np.sum(width * mean * slid, axis=0) - width[0] * mean[0] * slid[0]
        first = np.argmax(slid != 0, axis=0)
        column = np.arange(first.size)
        stuck = slid[first, column] == 0
        inner = self._motion.radius[np.where(stuck, len(density) - 1, first), column]
        self.stick_radius = inner
        self._memory, self._limit, self._density = self._next
        self._since = self._motion.approach[k]
        return work

    def strain(self) -> Array:
        """Strain energy over zeta^2 of elastic springs, whose density is their deflection."""
        width = self._motion.width[: len(self._density)]
        squares = width * self._density**2
        return 2 * (np.sum(squares, axis=0) - squares[0] / 2) / 2

    def _sum(self, k: int) -> Array:
        """Friction at instant k: mu times the normal force times the share of the limits."""
        _, limit, density = self._next
        width = self._motion.width[: len(limit)].copy()
        width[0] /= 2
        width[-1] /= 2
        whole = np.sum(width * limit, axis=0)
        share = np.sum(width * density, axis=0) / np.where(whole > 0, whole, 1.0)
        return share * self._motion.force[k]


def _relaxed(
    memory: Array,
    limit: Array,
    limit_after: Array,
    pull: Array,
    pull_after: Array,
    step: Array,
    tau: Array,
) -> tuple[Array, Array]:
    """Memory and density after a step in which pull and limit are straight lines in time."""
    ratio = step / tau
    decay = np.exp(-ratio)
    gain = np.where(ratio > 0, -np.expm1(-ratio) / np.where(ratio > 0, ratio, 1.0), 1.0)
    wanted = memory + pull_after
    side = np.copysign(1.0, wanted)
    # What is beyond the limit before the step, and after it if nothing relaxed.
    before, after = side * (memory + pull) - limit, side * wanted - limit_after
    change = after - before
    with np.errstate(divide="ignore", invalid="ignore"):
        # From slip: exact. If it ends within the step, change is all that stick adds after that.
        slides = before * decay + change * gain
        slides = np.where(slides < 0, change * slides / (slides - before), slides)
        # From stick: exact for a crossing of the limit at either end of the step.
        begins = np.where(after > 0, after / (1 + (1 / gain - 1) * after / change), after)
    beyond = np.where(before > 0, slides, begins)
    density = side * (limit_after + np.minimum(beyond, 0.0))
    return side * (limit_after + beyond) - pull_after, density
