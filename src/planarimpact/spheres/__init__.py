"""The continuum of spheres from a table: fast, also where every impact has groups of its own.

The table has the rebound of elastic, viscous and plastic spheres, as `planarimpact.continuum`
solves it, for every incidence and for mass over stiffness ratio from 1.1 to 3.5. Restitution is
from 0.1 to 1 with viscous loss, and from 0.3 with plastic loss, as that law does not hold below.
Solid spheres (mass ratio 3.5) and thin shells (2.5) of every Poisson's ratio from 0 to 1/2
(stiffness ratio 1 to 1.5) are among them, and so is whatever lies between, such as discs (3).
`table` evaluates it.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from planarimpact.common import checks, sliding
from planarimpact.common.arrays import Array, ArrayLike, Booleans, Integers, in_parts
from planarimpact.common.losses import CODES, PLASTIC, SPHERES, SpheresLosses
from planarimpact.common.results import Rebound, Regime, of_groups
from planarimpact.spheres import table

# Names of the losses that spheres have.
LOSSES = tuple(SPHERES)
# By panel of the table, and by loss: the largest difference from the continuum, of velocity
# (mu v2(0)), peak friction (mu F2max) and, with viscous loss, dissipation (mu^2 m2 v2(0)^2); times
# x where that is below 1, and for stiffness ratios up to `STATED_STIFFNESS`: beyond, in proportion.
# It is measured, not proved: a little above the largest error that the searches of
# tests/reference/test_spheres_reference.py have climbed to. With plastic loss dissipation is
# (x^2 - w^2)/(2 beta) by the balance of energy. So an error of w up to E makes one of it up to
# E (|w| + E/2)/beta, which grows with the incidence.
PANEL_BOUND = {"viscous": 1.5e-4, "plastic_low": 4e-3, "plastic_middle": 4e-3, "plastic_high": 9e-4}
ERROR_BOUND = {"viscous": PANEL_BOUND["viscous"], "plastic": PANEL_BOUND["plastic_low"]}
LEAST_RESTITUTION = {"viscous": 0.1, "plastic": 0.3}
# Bounds of mass ratio over stiffness ratio.
LEAST_RATIO, LARGEST_RATIO = 1.1, 3.5
# Errors of velocity and work are in proportion to zeta^2: the bounds are stated up to the first.
STATED_STIFFNESS, LARGEST_STIFFNESS = 1.6, 3.5
# The bounds are admitted although rounding puts a ratio a little beyond.
ROUNDING = 1e-9
# Impacts evaluated together: they stay in the cache.
CHUNK = 16384


def covers(
    mass_ratio: ArrayLike,
    stiffness_ratio: ArrayLike,
    restitution: ArrayLike,
    *,
    loss: str | None = None,
) -> Booleans:
    """Whether the table has an answer for these groups, at every incidence; they broadcast.

    Arguments: those of `rebound`; without a loss, whether there is an answer with both of them.

    Examples
    --------
    >>> covers(3.5, [0.9, 1.21, 3.1], 0.8).tolist()
    [False, True, True]
    >>> covers(3.5, 1.21, [0.2, 0.3]).tolist()
    [False, True]
    >>> covers(3.5, 1.21, [0.2, 0.3], loss="viscous").tolist()
    [True, True]
    """
    plastic = np.array(loss is None or checks.loss(loss, SPHERES) == PLASTIC.name)
    return _covers(mass_ratio, stiffness_ratio, restitution, plastic)


def _covers(
    mass_ratio: ArrayLike, stiffness_ratio: ArrayLike, restitution: ArrayLike, plastic: Booleans
) -> Booleans:
    """As `covers`, by whether the loss is plastic."""
    beta, zeta2, e = checks.broadcast(
        mass_ratio=checks.real("mass_ratio", mass_ratio),
        stiffness_ratio=checks.real("stiffness_ratio", stiffness_ratio),
        restitution=checks.real("restitution", restitution),
    )
    with np.errstate(over="ignore", divide="ignore"):  # of a stiffness ratio near 0
        ratio = beta / zeta2
    least = np.where(plastic, LEAST_RESTITUTION["plastic"], LEAST_RESTITUTION["viscous"])
    low, high = LEAST_RATIO * (1 - ROUNDING), LARGEST_RATIO * (1 + ROUNDING)
    small = (beta >= 1) & (zeta2 <= LARGEST_STIFFNESS * (1 + ROUNDING))
    return small & (ratio >= low) & (ratio <= high) & (e >= least) & (e <= 1)


def error_bound(
    mass_ratio: Array, stiffness_ratio: Array, restitution: Array, plastic: Booleans
) -> Array:
    """Largest error of velocity for these groups, mu v2(0); infinite where `covers` is False.

    Below x = 1 the error is x times that. With plastic loss it is smaller above a restitution from
    0.62 (mass over stiffness ratio 3.5) to 0.96 (1.1), 0.67 for solid spheres of steel.

    Arguments and answer are arrays of shape (n,).

    Examples
    --------
    >>> error_bound(*np.array([[3.5, 3.5], [1.21, 2.4], [0.7, 0.6]]), np.array([True, False]))
    array([0.0009  , 0.000225])
    """
    bound = np.where(plastic, ERROR_BOUND["plastic"], ERROR_BOUND["viscous"])
    covered = _covers(mass_ratio, stiffness_ratio, restitution, plastic)
    bound[~covered] = np.inf
    rows = np.flatnonzero(covered & plastic)
    b = mass_ratio[rows] / stiffness_ratio[rows]
    high = restitution[rows] >= table.limits_at(table.shipped(), b)[1]
    bound[rows[high]] = PANEL_BOUND["plastic_high"]
    return bound * np.maximum(stiffness_ratio / STATED_STIFFNESS, 1.0)


@of_groups
def rebound(
    incidence: ArrayLike,
    mass_ratio: ArrayLike = 3.5,
    stiffness_ratio: ArrayLike = 1.21,
    restitution: ArrayLike = 1.0,
    *,
    loss: SpheresLosses | None = None,
    forces: bool = True,
) -> Rebound:
    """State at separation; all arguments broadcast, the loss too.

    Parameters
    ----------
    incidence, mass_ratio, stiffness_ratio, restitution : array_like
        As in `planarimpact.lumped.rebound`, with groups that `covers` admits.
    loss : str or array_like of str, optional
        What takes the energy where e < 1, as in `planarimpact.continuum`: "viscous" or "plastic".
        Where all impacts have e = 1 it may be left out, as if viscous; it has no effect beyond
        `ERROR_BOUND`.
    forces : bool
        Whether peak friction and dissipation are wanted. They are NaN without, in half the time.

    Returns
    -------
    Rebound
        The same fields and units as `planarimpact.continuum.rebound`, but no reversals, within
        `error_bound` of it, below x = 1 within x times that. The error of plastic dissipation is up
        to |velocity|/mass_ratio times that of velocity. Where slip throughout begins, and where
        parts of the table meet, the velocity jumps: by up to 0.001 mu v2(0) with plastic loss, 4e-6
        with viscous. Impacts that slide as a whole more often than their regime says are not called
        MULTIPLE.

    Raises
    ------
    InputError
        As `planarimpact.continuum.rebound`, or if the table does not cover an impact.

    Examples
    --------
    >>> impacts = [0.5, 2.0, 8.0], 3.5, 17 / 14, [1.0, 0.8, 0.6]
    >>> rebound(*impacts, loss=["viscous", "plastic", "plastic"]).velocity.round(3).tolist()
    [0.061, -0.189, 2.4]
    """
    groups = incidence, mass_ratio, stiffness_ratio, restitution
    signed, beta, zeta2, e, codes = checks.impact(*groups, loss=checks.losses(loss, SPHERES))
    if (codes < 0).any():
        checks.require_loss(np.where(codes < 0, e, 1.0), LOSSES)
    plastic = codes == CODES[PLASTIC]
    if not _covers(beta, zeta2, e, plastic).all():
        _refuse_uncovered(beta, zeta2, e, plastic)
    flat: list[Any] = [a.reshape(-1) for a in (np.abs(signed), beta, zeta2, e, plastic)]
    solved = in_parts(e.size, CHUNK, lambda part: _rebound(forces, *(a[part] for a in flat)))
    return Rebound.shaped(signed, *solved)


def _refuse_uncovered(beta: Array, zeta2: Array, e: Array, plastic: Booleans) -> None:
    allowed = f"numbers above 0 up to {LARGEST_STIFFNESS}, for the table of spheres"
    checks.checked("stiffness_ratio", zeta2, allowed, 0, LARGEST_STIFFNESS * (1 + ROUNDING))
    for loss, mine in (("viscous", ~plastic), ("plastic", plastic)):
        least = LEAST_RESTITUTION[loss]
        allowed = f"numbers from {least} to 1, for the table of spheres with loss = {loss!r}"
        # Indices stay those of the caller.
        checks.checked("restitution", np.where(mine, e, 1.0), allowed, least, 1)
    bad = np.flatnonzero(~_covers(beta, zeta2, 1.0, plastic))[0]
    raise checks.InputError(
        f"mass_ratio/stiffness_ratio = {beta.flat[bad]:g}/{zeta2.flat[bad]:g}: allowed are ratios "
        f"from {LEAST_RATIO} to {LARGEST_RATIO}, for the table of spheres"
    )


def _rebound(
    forces: bool, x: Array, beta: Array, zeta2: Array, e: Array, plastic: Booleans
) -> tuple[Array, Array, Array, Integers]:
    """Velocity, peak friction, work of friction and regime of impacts with x >= 0."""
    y, b = x / zeta2, beta / zeta2
    velocity = sliding.velocity(x, beta, e)
    peak, work = np.full((2, x.size), 1.0 if forces else np.nan)
    if forces:
        work = np.where(plastic, sliding.work(x, beta, e), sliding.viscous_work(x, beta, zeta2, e))
    regime = np.full(x.size, Regime.SLIP_THROUGHOUT, dtype=np.uint8)
    # Plastic spheres that lose much may stick for a while at larger incidences too.
    rows = np.flatnonzero(plastic | (y < (b + e * (b - 1)) * table.NEARLY))
    answer = table.evaluate(table.shipped(), y[rows], b[rows], e[rows], plastic[rows], forces)
    sticks = np.flatnonzero(~answer.slides)
    rows = rows[sticks]
    x, beta, zeta2, e, plastic = x[rows], beta[rows], zeta2[rows], e[rows], plastic[rows]
    # The exact values have these bounds: energy, and Coulomb's limit.
    least = np.maximum(-x, sliding.velocity(x, beta, e))
    w = np.clip(zeta2 * answer.velocity[sticks], least, x)
    velocity[rows] = w
    if forces:
        peak[rows] = np.clip(answer.peak[sticks], 0.0, 1.0)
        balance = (x - w) * (x + w) / (2 * beta)  # of energy, with empty springs at the end
        work[rows] = np.where(plastic, balance, np.maximum(zeta2 * answer.work[sticks], 0.0))
    regime[rows] = np.where(x > zeta2, Regime.SLIP_STICK_SLIP, Regime.STICK_SLIP)
    regime[rows[x == 0]] = Regime.STICK
    return velocity, peak, work, regime
