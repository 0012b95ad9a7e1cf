"""Steps doubled until the answer, extrapolated once, meets a tolerance."""

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from typing import NamedTuple

import numpy as np

from planarimpact.common.arrays import Array, Booleans, Integers
from planarimpact.common.checks import ConvergenceError
from planarimpact.common.results import Regime

# An error estimate counts only with so many steps in each radian of the tangential oscillation.
STEPS_A_RADIAN = 4
# Errors below this share of the incidence cannot be told from rounding.
ROUNDING = 2.0**-48
# The estimated error falls at best with this power of the steps, as measured.
BEST_ORDER = 4
# A gross slip may still come or go if it is nearer than this many times the last change.
UNSURE = 2


class Unsolved(ConvergenceError):
    """Impacts of an array have no answer within the tolerance.

    Attributes
    ----------
    impacts : ndarray of int
        Their indices in the flattened arguments.
    """

    __module__ = "planarimpact.continuum"

    def __init__(self, message: str, impacts: Integers) -> None:
        super().__init__(message)
        self.impacts = impacts

    def __reduce__(self) -> tuple[type["Unsolved"], tuple[str, Integers]]:
        """Pickle it by its arguments, so that another process can raise it again."""
        return type(self), (str(self), self.impacts)


class Solved(NamedTuple):
    """Answers to m impacts by a number of steps."""

    values: Array  # shape (k, m): velocity and peak friction come first
    counts: Integers  # of gross slips after stick, and of reversals, shape (2, m)
    nearest: Array  # how near one gross slip more or less is, shape (m,)


def steps_needed(beta: Array, zeta2: Array, share_of_hertz: Array | float = 1.0) -> Array:
    """Steps that resolve the tangential oscillation of a contact.

    An elastic contact has sqrt(b)/2 oscillations, b = beta/zeta^2. One that yields is softer and
    lasts longer: b is divided by the share that its force has of Hertz's.
    """
    frequency = np.sqrt(beta) / (np.sqrt(zeta2) * np.sqrt(share_of_hertz))
    return STEPS_A_RADIAN * np.pi * frequency


def refuse_hopeless(
    x: Array, beta: Array, zeta2: Array, needed: Array, tolerance: Array, most: int
) -> None:
    """Refuse impacts that cannot reach their tolerance however many steps are taken."""
    unresolved = np.flatnonzero(needed > most)
    if unresolved.size:
        first = unresolved[0]
        raise Unsolved(
            f"stiffness_ratio = {zeta2[first]:g} at mass_ratio = {beta[first]:g}: the tangential "
            f"oscillation needs {needed[first]:.3g} steps, allowed are {most}",
            unresolved,
        )
    blurred = np.flatnonzero(ROUNDING * x > tolerance)
    if blurred.size:
        first = blurred[0]
        raise Unsolved(
            f"tolerance = {tolerance[first]:g}: at incidence = {x[first]:g} rounding alone may be "
            f"more, {ROUNDING * x[first]:.1e}",
            blurred,
        )


def refine(
    groups: tuple[Array, ...],
    needed: Array,
    tolerance: Array,
    integrate: Callable[[tuple[Array, ...], int], Solved],
    first: int,
    most: int,
    safety: float,
) -> tuple[Array, Integers]:
    """Values (k, n) and counts (2, n), with steps doubled until each impact meets its tolerance.

    `groups` are incidence, mass ratio, stiffness ratio, and what else `integrate` takes, each (n,);
    `tolerance` (n,) is that of each; with fewer steps than `needed` (n,) an estimate does not
    count. `integrate` takes groups of m impacts and a number of steps. Of its values velocity and
    peak friction must meet the tolerance.
    """
    x, beta, zeta2 = groups[:3]
    refuse_hopeless(x, beta, zeta2, needed, tolerance, most)
    known = _Known(3, x.size)  # if there is nothing to do
    unsolved, message = [], None
    todo, steps = np.arange(x.size), first
    while todo.size:
        # Each turn solves the impacts that remain with twice the steps, and estimates the error. An
        # impact leaves when it meets the tolerance or when no number of steps up to `most` can
        # help.
        fine, number, near = integrate(tuple(group[todo] for group in groups), steps)
        if steps == first:
            known = _Known(len(fine), x.size)
        estimate = safety * known.improve(todo, fine, number, near)
        resolved = steps >= needed[todo]
        worst = estimate[:2].max(axis=0)  # NaN while there is no estimate yet
        allowed = tolerance[todo]
        settled = resolved & (worst <= allowed)
        # More steps do not help an answer that is not finite. An estimate says what more steps can
        # do once the steps resolve the contact at all four levels that it compares.
        sure = (steps >= 8 * needed[todo]) | (2 * steps > most)
        beyond = ~np.isfinite(fine).all(axis=0) | (
            sure & ~settled & ~in_reach(worst, allowed, steps, most)
        )
        if beyond.any() and not message:
            i, error = todo[beyond][0], worst[beyond][0]
            message = not_met(x[i], beta[i], zeta2[i], tolerance[i], steps, error, most)
        unsolved += todo[beyond].tolist()
        todo, steps = todo[~settled & ~beyond], 2 * steps
    if message:
        raise Unsolved(message, np.sort(unsolved))
    return known.values, known.counts


class _Known:
    """What is known of n impacts so far: values, extrapolated, and counts, as in `Solved`."""

    def __init__(self, k: int, n: int) -> None:
        self.values, self.counts = np.zeros((k, n)), np.zeros((2, n), dtype=np.int64)
        # The last answers as they were solved, and by how much the extrapolated ones changed.
        self._coarse, self._change = np.full((2, k, n), np.nan)
        self._nearest = np.full(n, np.nan)

    def improve(self, which: Integers, fine: Array, number: Integers, near: Array) -> Array:
        """Take some impacts, `Solved` with twice the steps, and estimate their errors, (k, m)."""
        correction = (fine - self._coarse[:, which]) / 3
        better = fine + correction
        changed = np.abs(better - self.values[:, which])
        # A change may be small by chance, where the steps resolve an event of the contact late. So
        # a quarter of the change before counts too, and a quarter of the correction. All of the
        # correction counts where a gross slip may still come or go: the velocity has a kink there.
        # Steps displace the kink, and answers on one side of it do not show that.
        moved = np.abs(near - self._nearest[which])
        unsure = (number[0] != self.counts[0, which]) | (near <= UNSURE * moved)
        chances = self._change[:, which] / 4, np.abs(correction) / np.where(unsure, 1, 4)
        self._coarse[:, which], self.values[:, which] = fine, better
        self._change[:, which] = changed
        self.counts[:, which], self._nearest[which] = number, near
        return np.maximum(changed, np.maximum(*chances))


def in_reach(error: Array, tolerance: Array, steps: int, most: int) -> Booleans:
    """Whether `most` steps may reduce an error to the tolerance; true for unknown errors."""
    if 2 * steps > most:
        return error <= tolerance
    return ~(error * (steps / most) ** BEST_ORDER > tolerance)


def not_met(
    x: float, beta: float, zeta2: float, tolerance: float, steps: int, error: float, most: int
) -> str:
    """Message about an impact that does not meet the tolerance."""
    beyond = f", and out of reach of {most}" if steps < most else ""
    return (
        f"tolerance = {tolerance:g}: not met with {steps} steps{beyond}, at incidence = {x:g}, "
        f"mass_ratio = {beta:g}, stiffness_ratio = {zeta2:g}; estimated error {error:.1e}"
    )


def settled_path(
    solve: Callable[[int], Sequence[Array]],
    judged: tuple[int, int],
    groups: tuple[Array, Array, Array],
    needed: Array,
    tolerance: Array,
    most: int,
) -> Sequence[Array]:
    """Columns over one contact, of which those numbered `judged` meet the tolerance, shape (1,).

    `solve` returns columns of shape (steps + 1, 1) for a number of steps. The instants of a coarse
    path are among those of one with twice the steps.
    """
    x, beta, zeta2 = groups
    refuse_hopeless(x, beta, zeta2, needed, tolerance, most)
    message, steps = None, 128
    coarse = solve(steps)
    while not message:
        steps *= 2
        fine = solve(steps)
        # An error that falls with the square of the steps is a third of the change.
        change = max(np.max(np.abs(fine[i][::2] - coarse[i])) / 3 for i in judged)
        resolved = steps >= needed[0]
        if resolved and change <= tolerance[0]:
            return fine
        if resolved and not in_reach(np.asarray(change), tolerance[0], steps, most):
            message = not_met(x[0], beta[0], zeta2[0], tolerance[0], steps, change, most)
        coarse = fine
    raise ConvergenceError(message)


@contextmanager
def counted_among(rows: Integers) -> Iterator[None]:
    """Impacts that are not solved are named by their places among all, not among these rows."""
    try:
        yield
    except Unsolved as error:
        error.impacts = rows[error.impacts]
        raise


def sign_changes(force: Array) -> Integers:
    """How often each column changes sign; zeros do not count."""
    sign = np.sign(force)
    # Carry the last sign over zeros.
    last_nonzero = np.maximum.accumulate(
        np.where(sign != 0, np.arange(len(sign))[:, None], 0), axis=0
    )
    sign = np.take_along_axis(sign, last_nonzero, axis=0)
    return np.sum(sign[1:] * sign[:-1] < 0, axis=0)


def regime(x: Array, zeta2: Array, gross_slips: Integers) -> Integers:
    """Regime by the start of contact and the number of gross slips after stick."""
    usual = np.where(x > zeta2, Regime.SLIP_STICK_SLIP, Regime.STICK_SLIP)
    return np.where(gross_slips > 1, Regime.MULTIPLE, usual)
