"""Which solver has a loss: the paper's springs, or two Kelvin-Voigt elements with dashpots.

At e = 1 nothing is lost: the springs solve it for every loss, so that all have the same bits.
"""

import numpy as np

from planarimpact.common import checks, sliding
from planarimpact.common.arrays import Array, Booleans
from planarimpact.common.losses import Loss
from planarimpact.common.results import History
from planarimpact.lumped import dashpots, histories, stick_slip
from planarimpact.lumped.stick_slip import Impacts, Outcome

# Impacts solved together: few enough for the cache, enough to hide Python's overhead.
CHUNK = 32768


def slides_from(loss: Loss, beta: Array, zeta2: Array, e: Array) -> Array:
    """Incidence from which the contact slides throughout."""
    if loss.dashpots:
        return sliding.limit_alike(beta, zeta2, e)
    return sliding.limit(beta, loss.stiffness_ratio(zeta2, e), e)


def solve(loss: Loss, impacts: Impacts) -> Outcome:
    """Outcome of impacts x >= 0, arrays of shape (n,), chunk by chunk."""
    starts = range(0, impacts.x.size, CHUNK) or [0]
    parts = (Impacts(*(group[start : start + CHUNK] for group in impacts)) for start in starts)
    solved = [_solve_chunk(loss, part) for part in parts]
    return Outcome(*map(np.concatenate, zip(*solved, strict=True)))


def history(loss: Loss, mirror: float, impact: Impacts, samples: int) -> History:
    """One contact, its arrays of shape (1,); `mirror` is the sign of the incidence."""
    if _damped(loss, impact)[0]:
        return histories.of_dashpots(mirror, impact, samples)
    return histories.of_springs(mirror, _springs(loss, impact), samples)


def friction_work(loss: Loss, impacts: Impacts) -> Array:
    """Work of friction of impacts, by the loop of `planarimpact.phases`."""
    damped, work = _damped(loss, impacts), np.empty_like(impacts.x)
    with_dashpots, without = (impacts.take(np.flatnonzero(part)) for part in (damped, ~damped))
    work[damped] = dashpots.solve(with_dashpots).dissipation
    work[~damped] = histories.friction_work(_springs(loss, without))
    return work


def _solve_chunk(loss: Loss, impacts: Impacts) -> Outcome:
    """Outcome of impacts, arrays of shape (n,), all at once."""
    if not loss.dashpots:
        return stick_slip.solve(_springs(loss, impacts))
    damped = _damped(loss, impacts)
    if damped.all():
        return dashpots.solve(impacts)
    outcome = stick_slip.solve(_springs(loss, impacts))
    if damped.any():
        solved = dashpots.solve(impacts.take(np.flatnonzero(damped)))
        for field, values in zip(outcome, solved, strict=True):
            field[damped] = values
    return outcome


def _damped(loss: Loss, impacts: Impacts) -> Booleans:
    """Which impacts have dashpots; those are checked to be in the range of their solver."""
    damped = loss.dashpots & (impacts.e < 1)
    if damped.any():
        dashpots.check_range(impacts.take(np.flatnonzero(damped)), loss.least_restitution)
    return damped


def _springs(loss: Loss, impacts: Impacts) -> Impacts:
    """Impacts on the paper's springs that stand for this loss."""
    zeta2 = loss.stiffness_ratio(impacts.zeta2, impacts.e)
    checks.tangential_frequency(*impacts[1:], zeta2)
    return impacts._replace(zeta2=zeta2)
