"""Oblique impact of elastic spheres with micro-slip: the elastic continuum, e = 1.

A Hertz contact slips in an outer annulus and sticks inside, as Maw, Barber & Fawcett (1976)
describe it. The method is that of dimensionality reduction. `planarimpact.hertz` gives the normal
motion, `micro_slip` keeps a row of springs, and `tangential_motion` integrates in steps. Here the
number of steps is doubled until the answer, extrapolated once, meets the tolerance.

Gross slip from the start of contact needs no steps: its closed form is exact. So are impacts that
slide throughout.
"""

import numpy as np

from planarimpact import hertz
from planarimpact.continuum import tangential_motion
from planarimpact.ground import checks, sliding
from planarimpact.ground.arrays import Array, ArrayLike, Booleans, Integers
from planarimpact.ground.checks import Unsolved
from planarimpact.ground.results import ContinuumHistory, Rebound, Regime

FIRST_STEPS = 16
MOST_STEPS = 2**15
# Factor of the estimated error. With it none of 7000 random impacts had an error above 0.3 of the
# tolerance, and a search for the worst impact found 0.9 of it.
SAFETY = 5
# An error estimate counts only with so many steps in each radian of the tangential oscillation.
STEPS_A_RADIAN = 4
# Errors below this share of the incidence cannot be told from rounding.
ROUNDING = 2.0**-48
# An estimated error falls at best with this power of the steps, as measured.
BEST_ORDER = 4
# A gross slip may still come or go if it is nearer than this many times the last change.
UNSURE = 2
# The golden section searches for the peak of friction, to 1e-5 of a step.
SECTIONS, GOLDEN = 24, 0.381966
# Steps times impacts solved together: this bounds the memory to some 100 MB.
CELLS = 2**20


@checks.default_errors
def rebound(
    incidence: ArrayLike,
    mass_ratio: ArrayLike = 3.5,
    stiffness_ratio: ArrayLike = 1.21,
    restitution: ArrayLike = 1.0,
    *,
    tolerance: float = 1e-6,
) -> Rebound:
    """State at separation; the groups broadcast.

    Parameters
    ----------
    incidence, mass_ratio, stiffness_ratio : array_like
        As in `planarimpact.lumped.rebound`. Impacts that do not slide throughout need a mass ratio
        up to 6.8e6 zeta^2: more tangential oscillations are not resolved. In the variables of Maw
        et al. psi1 = x/zeta^2, chi = beta/(2 zeta^2).
    restitution : array_like
        1: the contact is elastic.
    tolerance : float
        Largest error allowed in velocity (mu v2(0)) and peak friction (mu F2max), by the
        solver's own estimate; above 0. For a solid sphere 1e-8 is met, 1e-9 not always.

    Returns
    -------
    Rebound
        velocity, peak_friction, dissipation, regime, reversals, in the broadcast shape (scalars
        for scalars).

    Raises
    ------
    InputError
        If an argument is not a finite real number in its range, or shapes do not broadcast.
    ConvergenceError
        If the tolerance is not met with `MOST_STEPS` steps, or is out of their reach. `impacts`
        holds the flat indices of all such impacts, the message describes the first.

    Notes
    -----
    The error of the steps falls with their square. The extrapolated error falls with their power
    2.5 on average, as gross slip sets in with a root of time. The error is estimated, not bounded:
    it is five times the largest of three numbers, the last change of the extrapolated answer, a
    quarter of the change before it, and a quarter of what extrapolation corrects. All of the
    correction counts where one gross slip more or less is within reach of the error. A reversal of
    friction shorter than a step, just below slip throughout, is not counted.

    References
    ----------
    N. Maw, J. R. Barber, J. N. Fawcett, Wear 38 (1976) 101-114. V. L. Popov, M. Hess, Method of
    Dimensionality Reduction in Contact Mechanics and Friction, Springer 2015.

    Examples
    --------
    >>> result = rebound([0.5, 2.0, 8.0])
    >>> [Regime(code).name for code in result.regime]
    ['STICK_SLIP', 'SLIP_STICK_SLIP', 'SLIP_THROUGHOUT']
    >>> [round(float(w), 5) for w in result.velocity]
    [0.06343, -0.66592, 1.0]
    """
    signed, beta, zeta2, tolerance = _checked(
        incidence, mass_ratio, stiffness_ratio, restitution, tolerance
    )
    size, beta, zeta2 = (a.reshape(-1) for a in (np.abs(signed), beta, zeta2))
    velocity, impulse, peak, regime, reversals = _at_limits(size, beta, zeta2)
    rest = np.flatnonzero(regime == _UNSOLVED)
    try:
        found = _refine(size[rest], beta[rest], zeta2[rest], tolerance)
    except Unsolved as error:
        error.impacts = rest[error.impacts]
        raise
    velocity[rest], peak[rest], regime[rest], reversals[rest] = found
    impulse[rest] = (size - velocity)[rest] / beta[rest]
    return Rebound.of(signed, velocity, impulse, peak, regime, reversals)


@checks.default_errors
def fixed_steps(
    incidence: ArrayLike,
    mass_ratio: ArrayLike = 3.5,
    stiffness_ratio: ArrayLike = 1.21,
    steps: int = 128,
    extrapolate: bool = False,
) -> Array:
    """Velocity at separation with a given number of steps, whatever its error.

    Parameters
    ----------
    incidence, mass_ratio, stiffness_ratio : array_like
        As in `rebound`.
    steps : int
        2 to 32768, and at least pi times the root of beta/zeta^2: with fewer the tangential
        oscillation may grow. With `extrapolate` an even number, at least twice as large.
    extrapolate : bool
        Solve with half the steps too, and take away the part of the error that falls with their
        square.

    Returns
    -------
    ndarray of float64 or float

    Raises
    ------
    InputError
        As `rebound`; also if `steps` is no such number.

    Examples
    --------
    >>> [round(float(fixed_steps(2.0, steps=64, extrapolate=e)), 5) for e in (False, True)]
    [-0.66502, -0.66594]
    """
    signed, beta, zeta2, _ = _checked(incidence, mass_ratio, stiffness_ratio, 1.0, 1.0)
    size, beta, zeta2 = (a.reshape(-1) for a in (np.abs(signed), beta, zeta2))
    velocity, _, _, regime, _ = _at_limits(size, beta, zeta2)
    rest = np.flatnonzero(regime == _UNSOLVED)
    groups = size[rest], beta[rest], zeta2[rest]
    resolved = np.max(_steps_needed(*groups[1:]), initial=0.0)
    needed = resolved / STEPS_A_RADIAN * (2 if extrapolate else 1)
    steps = checks.explicit_steps(steps, needed, 2, MOST_STEPS)
    if extrapolate and steps % 2:
        raise checks.InputError(f"steps = {steps}: allowed are even integers where extrapolated")
    velocity[rest] = _integrate_in_parts(*groups, steps)[0][0]
    if extrapolate:
        velocity[rest] += (velocity[rest] - _integrate_in_parts(*groups, steps // 2)[0][0]) / 3
    return (np.copysign(1.0, signed) * velocity.reshape(signed.shape))[()]


@checks.default_errors
def history(
    incidence: float,
    mass_ratio: float = 3.5,
    stiffness_ratio: float = 1.21,
    tolerance: float = 1e-4,
) -> ContinuumHistory:
    """Forces, velocity and radius of stick over one contact.

    Parameters
    ----------
    incidence, mass_ratio, stiffness_ratio : float
        As in `rebound`; scalars.
    tolerance : float
        Largest error allowed in friction and velocity at every instant, above 0. It also
        decides how many instants there are, at least 128.

    Returns
    -------
    ContinuumHistory

    Raises
    ------
    InputError
        As `rebound`; also if an argument is not scalar.
    ConvergenceError
        As `rebound`.

    Notes
    -----
    Gross slip from the start is exact. At its threshold, x = zeta^2, every spring is at the limit
    of friction as long as the contact grows, and rounding decides the radius of stick.

    Examples
    --------
    >>> contact = history(1.0)
    >>> float(contact.time[-1]), float(contact.stick_radius[-1])
    (2.0, 0.0)
    """
    signed, beta, zeta2, tolerance = _checked(
        incidence, mass_ratio, stiffness_ratio, 1.0, tolerance
    )
    if signed.ndim:
        raise checks.InputError(f"shape = {signed.shape}: one contact takes scalars")
    x, beta, zeta2 = (a.reshape(1) for a in (np.abs(signed), beta, zeta2))
    slid = tangential_motion.gross_slip(x, beta, zeta2)
    if x[0] < sliding.limit(beta[0], zeta2[0], 1.0):
        stuck = _settled_path(x, beta, zeta2, tolerance)
        slid = [np.concatenate([a[:-1], b]) for a, b in zip(slid, stuck, strict=True)]
    phase, friction, velocity, stick_radius = slid
    radius = np.sin(phase)
    radius[-1] = friction[-1] = stick_radius[-1] = 0.0
    mirror = float(np.copysign(1.0, signed))
    return ContinuumHistory(
        hertz.time(phase), radius**3, mirror * friction, mirror * velocity, radius, stick_radius
    )


_UNSOLVED = 255


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


def _steps_needed(beta: Array, zeta2: Array) -> Array:
    """Steps that resolve the tangential oscillation: a contact has sqrt(beta/zeta^2)/2 of it."""
    with np.errstate(over="ignore"):
        return STEPS_A_RADIAN * np.pi * (np.sqrt(beta) / np.sqrt(zeta2))


def _refuse_hopeless(x: Array, beta: Array, zeta2: Array, tolerance: float) -> None:
    """Refuse impacts that cannot reach the tolerance however many steps are taken."""
    needed = _steps_needed(beta, zeta2)
    unresolved = np.flatnonzero(needed > MOST_STEPS)
    if unresolved.size:
        first = unresolved[0]
        raise Unsolved(
            f"stiffness_ratio = {zeta2[first]:g} at mass_ratio = {beta[first]:g}: the tangential "
            f"oscillation needs {needed[first]:.3g} steps, allowed are {MOST_STEPS}",
            unresolved,
        )
    blurred = np.flatnonzero(ROUNDING * x > tolerance)
    if blurred.size:
        error = ROUNDING * x[blurred[0]]
        raise Unsolved(
            f"tolerance = {tolerance:g}: at incidence = {x[blurred[0]]:g} rounding alone may be "
            f"more, {error:.1e}",
            blurred,
        )


def _refine(
    x: Array, beta: Array, zeta2: Array, tolerance: float
) -> tuple[Array, Array, Integers, Integers]:
    """Velocity, peak friction, regime and reversals, with steps doubled until they settle."""
    values, estimate = np.zeros((2, x.size)), np.full((2, x.size), np.inf)
    counts, nearest = np.zeros((2, x.size), dtype=np.int64), np.full(x.size, np.nan)
    coarse, change = np.full((2, 2, x.size), np.nan)
    _refuse_hopeless(x, beta, zeta2, tolerance)
    lost, why = [], None
    todo, steps = np.arange(x.size), FIRST_STEPS
    while todo.size:
        # A turn solves what is left with twice the steps, and estimates the error. Impacts leave
        # when they have settled or when no number of steps up to MOST_STEPS can help.
        fine, number, near = _integrate_in_parts(x[todo], beta[todo], zeta2[todo], steps)
        correction = (fine - coarse[:, todo]) / 3
        better = fine + correction
        changed = np.abs(better - values[:, todo])
        # A change may be small by chance, where the steps resolve an event of the contact late. So
        # the change before counts too, less what a doubling gains, and a share of the correction.
        # All of the correction counts where a gross slip may still come or go: the velocity has a
        # kink there. Steps displace the kink, and answers on one side of it do not show that.
        moved = np.abs(near - nearest[todo])
        unsure = (number[0] != counts[0, todo]) | (near <= UNSURE * moved)
        chances = change[:, todo] / 4, np.abs(correction) / np.where(unsure, 1, 4)
        estimate[:, todo] = SAFETY * np.maximum(changed, np.maximum(*chances))
        coarse[:, todo], values[:, todo], change[:, todo] = fine, better, changed
        counts[:, todo], nearest[todo] = number, near
        resolved = steps >= _steps_needed(beta[todo], zeta2[todo])
        worst = estimate[:, todo].max(axis=0)  # NaN while there is no estimate yet
        settled = resolved & (worst <= tolerance)
        # More steps do not help an answer that is not finite.
        beyond = ~np.isfinite(fine).all(axis=0) | (resolved & ~_in_reach(worst, tolerance, steps))
        if beyond.any() and not why:
            i, error = todo[beyond][0], worst[beyond][0]
            why = _not_met(x[i], beta[i], zeta2[i], tolerance, steps, error)
        lost += todo[beyond].tolist()
        todo, steps = todo[~settled & ~beyond], 2 * steps
    if why:
        raise Unsolved(why, np.sort(lost))
    # The exact values have these bounds. Extrapolation and rounding may exceed them.
    velocity, peak = np.clip(values[0], -x, x), np.clip(values[1], 0.0, 1.0)
    peak[(x > zeta2) & (x >= beta)] = 1.0  # gross slip from the start to maximum compression
    return velocity, peak, _regime(x, zeta2, counts[0]), counts[1]


def _in_reach(error: Array, tolerance: float, steps: int) -> Booleans:
    """Whether `MOST_STEPS` steps may reduce an error to the tolerance; true for unknown errors."""
    if 2 * steps > MOST_STEPS:
        return error <= tolerance
    return ~(error * (steps / MOST_STEPS) ** BEST_ORDER > tolerance)


def _not_met(
    x: float, beta: float, zeta2: float, tolerance: float, steps: int, error: float
) -> str:
    beyond = f", and out of reach of {MOST_STEPS}" if steps < MOST_STEPS else ""
    return (
        f"tolerance = {tolerance:g}: not met with {steps} steps{beyond}, at incidence = {x:g}, "
        f"mass_ratio = {beta:g}, stiffness_ratio = {zeta2:g}; estimated error {error:.1e}"
    )


def _integrate_in_parts(
    x: Array, beta: Array, zeta2: Array, steps: int
) -> tuple[Array, Integers, Array]:
    """Raw velocity and peak, counts of gross slips after stick and of reversals, `_nearest`."""
    together = max(1, CELLS // steps)
    cuts = range(together, x.size, together)
    groups = zip(*(np.split(a, cuts) for a in (x, beta, zeta2)), strict=True)
    found = [_summary(*tangential_motion.path(a, b, c, steps)) for a, b, c in groups]
    values, counts, nearest = zip(*found, strict=True)
    return np.concatenate(values, axis=1), np.concatenate(counts, axis=1), np.concatenate(nearest)


def _summary(
    phase: Array,
    friction: Array,
    velocity: Array,
    stick_radius: Array,
    reserve: Array,
    centre: Array,
) -> tuple[Array, Integers, Array]:
    gross = stick_radius == 0
    gross_slips = np.sum(gross[1:] & ~gross[:-1], axis=0)
    counts = np.stack([gross_slips, _sign_changes(friction)])
    values = np.stack([velocity[-1], _peak(phase, np.abs(friction), gross)])
    return values, counts, _nearest(reserve, centre, gross)


def _nearest(reserve: Array, centre: Array, gross: Booleans) -> Array:
    """How far each contact is from one gross slip more or less, in the unit of the spring row.

    This is the smallest displacement that was missing for a gross slip, or that the contact slid in
    a gross slip between two sticks. It is 1, which no reserve exceeds, if there is neither.
    """
    here = reserve[1:-1]
    lowest = (here < reserve[:-2]) & (here <= reserve[2:]) & (here > ROUNDING)
    nearest = np.min(here, axis=0, where=lowest, initial=1.0)
    onsets, ends = ~gross[:-1] & gross[1:], gross[:-1] & ~gross[1:]
    for i in np.flatnonzero(np.sum(ends, axis=0) > 1):
        first, last = np.flatnonzero(onsets[:, i]), np.flatnonzero(ends[:, i])[1:] + 1
        slid = np.abs(centre[last, i] - centre[first[: last.size], i])
        nearest[i] = min(nearest[i], np.min(slid))
    return nearest


def _sign_changes(force: Array) -> Integers:
    """How often each column changes sign; zeros do not count."""
    sign = np.sign(force)
    # Carry the last sign over zeros.
    held = np.maximum.accumulate(np.where(sign != 0, np.arange(len(sign))[:, None], 0), axis=0)
    sign = np.take_along_axis(sign, held, axis=0)
    return np.sum(sign[1:] * sign[:-1] < 0, axis=0)


def _peak(phase: Array, force: Array, gross: Booleans) -> Array:
    """Largest force of each column, between the points too.

    Between the points the force is a share of sin(phase)^3 less a parabola. As gross slip sets in,
    the share is 1 and the deficit vanishes with the power 3/2 of the time left. There the power 2/3
    of the deficit is the parabola, through three points before gross slip.
    """
    top = force.argmax(axis=0)
    lanes = np.arange(top.size)
    last = np.clip(top + 1, 2, len(force) - 2)
    last -= gross[last, lanes]  # up to two points of gross slip may be among the three
    last -= gross[last, lanes]
    slides = gross[last, lanes]
    last = np.maximum(last, 2)
    points = np.stack([last - 2, last - 1, last])
    normal, forces = np.sin(phase[points, lanes]) ** 3, force[points, lanes]
    deficits = np.maximum(normal - forces, 0.0)
    nears = (deficits[2] < deficits[0]) & (2 * forces[1] > normal[1])
    share = np.where(nears | slides, 1.0, forces[1] / normal[1])
    before, at, after = np.where(nears, deficits ** (2 / 3), share * normal - forces)
    slope, bend = (after - before) / 2, before - 2 * at + after
    middle, step = phase[last - 1, lanes], phase[1] - phase[0]

    def between(at_phase: Array) -> Array:
        t = (at_phase - middle) / step
        lack = at + t * (slope + t * bend / 2)
        lack = np.where(nears, np.maximum(lack, 0.0) ** 1.5, lack)
        return share * np.sin(at_phase) ** 3 - np.where(slides, 0.0, lack)

    low = phase[np.maximum(top - 1, 0), lanes]
    high = phase[np.minimum(top + 1, len(force) - 1), lanes]
    for _ in range(SECTIONS):
        third = (high - low) * GOLDEN
        left, right = low + third, high - third
        rises = between(left) < between(right)
        low, high = np.where(rises, left, low), np.where(rises, high, right)
    return between((low + high) / 2)


def _regime(x: Array, zeta2: Array, gross_slips: Integers) -> Integers:
    """Regime by the start of contact and the number of gross slips after stick."""
    usual = np.where(x > zeta2, Regime.SLIP_STICK_SLIP, Regime.STICK_SLIP)
    return np.where(gross_slips > 1, Regime.MULTIPLE, usual)


def _settled_path(x: Array, beta: Array, zeta2: Array, tolerance: float) -> list[Array]:
    """Path of one contact after gross slip, as fine as the tolerance asks."""
    _refuse_hopeless(x, beta, zeta2, tolerance)
    why, steps = None, 128
    coarse = tangential_motion.path(x, beta, zeta2, steps)
    while not why:
        steps *= 2
        fine = tangential_motion.path(x, beta, zeta2, steps)
        # An error that falls with the square of the steps is a third of the change.
        change = max(np.max(np.abs(fine[i][::2] - coarse[i])) / 3 for i in (1, 2))
        resolved = steps >= _steps_needed(beta, zeta2)[0]
        if resolved and change <= tolerance:
            return [a[:, 0] for a in fine[:4]]
        if resolved and not _in_reach(np.asarray(change), tolerance, steps):
            why = _not_met(x[0], beta[0], zeta2[0], tolerance, steps, change)
        coarse = fine
    raise checks.ConvergenceError(why)


def _checked(
    incidence: ArrayLike,
    mass_ratio: ArrayLike,
    stiffness_ratio: ArrayLike,
    restitution: ArrayLike,
    tolerance: float,
) -> tuple[Array, Array, Array, float]:
    x, beta, zeta2 = checks.elastic_impact(incidence, mass_ratio, stiffness_ratio, restitution)
    allowed = checks.number("tolerance", tolerance, "numbers above 0", 0, open_low=True)
    return x, beta, zeta2, allowed
