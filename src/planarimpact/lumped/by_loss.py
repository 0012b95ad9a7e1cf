"""Which solver has a loss: the paper's element, or two Kelvin-Voigt elements with dashpots.

At e = 1 nothing is lost: the paper's element solves it for every loss, so that all have the same
bits.
"""

import numpy as np

from planarimpact.common import checks, sliding
from planarimpact.common.arrays import Array, Booleans
from planarimpact.common.losses import Loss
from planarimpact.common.results import History
from planarimpact.lumped import hysteretic, viscous
from planarimpact.lumped.extremes import scaling
from planarimpact.lumped.stick_slip import Impacts, Outcome

# Largest omega/Omega of stick in compression in a history: rounding moves its friction by 1e-6.
LARGEST_FREQUENCY = 1e9
# Impacts solved together: few enough for the cache, enough to hide Python's overhead. Those with
# dashpots are of up to four kinds, each of them solved together.
CHUNK, CHUNK_WITH_DASHPOTS = 32768, 131072


def slides_from(loss: Loss, beta: Array, zeta2: Array, e: Array) -> Array:
    """Incidence from which the contact slides throughout."""
    if loss.dashpots:
        return sliding.limit_alike(beta, zeta2, e)
    return sliding.limit(beta, loss.stiffness_ratio(zeta2, e), e)


def solve(loss: Loss, impacts: Impacts) -> Outcome:
    """Outcome of impacts x >= 0, arrays of shape (n,), chunk by chunk."""
    size, chunk = impacts.x.size, CHUNK_WITH_DASHPOTS if loss.dashpots else CHUNK
    velocity, peak, work = (np.empty(size) for _ in range(3))
    outcome = Outcome(velocity, peak, work, np.empty(size, np.uint8))
    for start in range(0, size, chunk):
        part = slice(start, start + chunk)
        solved = _solve_chunk(loss, Impacts(*(group[part] for group in impacts)))
        for field, values in zip(outcome, solved, strict=True):
            field[part] = values
    return outcome


def history(loss: Loss, mirror: float, impacts: Impacts, samples: int) -> History:
    """One contact, its arrays of shape (1,); `mirror` is the sign of the incidence."""
    if _damped(loss, impacts)[0]:
        return viscous.history(mirror, impacts, samples)
    element = _element(loss, impacts)
    x, beta, zeta2, e = (float(group[0]) for group in element)
    if 0 < x < beta and np.sqrt(beta) > LARGEST_FREQUENCY * np.sqrt(zeta2):
        raise checks.InputError(
            f"restitution = {e!r}, stiffness_ratio = {float(impacts.zeta2[0])!r}: in a history"
            f" allowed are tangential frequencies omega/Omega up to {LARGEST_FREQUENCY:g} (for "
            "no tangential compliance use planarimpact.rigid)"
        )
    return hysteretic.history(mirror, element, samples)


def friction_work(loss: Loss, impacts: Impacts) -> float:
    """Work of friction in one contact, computed in another way than by `solve`, if possible."""
    if _damped(loss, impacts)[0]:  # there is the closed form alone
        return float(viscous.solve(impacts).dissipation[0])
    return hysteretic.friction_work(_element(loss, impacts))


def _solve_chunk(loss: Loss, impacts: Impacts) -> Outcome:
    """Outcome of impacts, arrays of shape (n,), all at once."""
    damped = _damped(loss, impacts)
    if damped.all():
        return viscous.solve(impacts)
    outcome = scaling.solve(_element(loss, impacts))
    if damped.any():
        solved = viscous.solve(impacts.take(np.flatnonzero(damped)))
        for field, values in zip(outcome, solved, strict=True):
            field[damped] = values
    return outcome


def _damped(loss: Loss, impacts: Impacts) -> Booleans:
    """Which impacts dashpots damp."""
    return impacts.e < (1 if loss.dashpots else 0)


def _element(loss: Loss, impacts: Impacts) -> Impacts:
    """Impacts on the paper's element that stands for this loss."""
    return impacts._replace(zeta2=loss.stiffness_ratio(impacts.zeta2, impacts.e))
