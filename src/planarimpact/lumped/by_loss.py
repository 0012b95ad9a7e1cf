"""Which solver has a loss: the paper's springs, or two Kelvin-Voigt elements with dashpots.

At e = 1 nothing is lost: the springs solve it for every loss, so that all have the same bits.
Histories, and the work of friction, are those of `planarimpact.phases`.
"""

import numpy as np

from planarimpact.common import checks, sliding
from planarimpact.common.arrays import Array, Booleans, in_parts
from planarimpact.common.losses import Loss
from planarimpact.common.results import EventKind, History
from planarimpact.lumped import dashpots, stick_slip
from planarimpact.lumped.dashpots import refuse_endless
from planarimpact.lumped.stick_slip import Impacts, Outcome
from planarimpact.phases import Step, closed
from planarimpact.phases.off_centre import F, N, OffCentre, Phase, Q
from planarimpact.phases.runs import BESIDE, runs

# Impacts solved together: few enough for the cache, enough to hide Python's overhead.
CHUNK = 32768


def slides_from(loss: Loss, beta: Array, zeta2: Array, e: Array) -> Array:
    """Incidence from which the contact slides throughout."""
    if loss.dashpots:
        return sliding.limit_alike(beta, zeta2, e)
    return sliding.limit(beta, loss.stiffness_ratio(zeta2, e), e)


def solve(loss: Loss, impacts: Impacts) -> Outcome:
    """Outcome of impacts x >= 0, arrays of shape (n,), chunk by chunk."""
    parts = in_parts(impacts.x.size, CHUNK, lambda part: _solve_chunk(loss, impacts.take(part)))
    return Outcome._make(parts)


def history(loss: Loss, mirror: float, impact: Impacts, samples: int) -> History:
    """One contact, its arrays of shape (1,); `mirror` is the sign of the incidence."""
    if _damped(loss, impact)[0]:
        return dashpots.history(mirror, impact, samples)
    return _history_on_springs(mirror, _springs(loss, impact), samples)


def friction_work(loss: Loss, impacts: Impacts) -> Array:
    """Work of friction of impacts, by the loop of `planarimpact.phases`."""
    damped, work = _damped(loss, impacts), np.empty_like(impacts.x)
    with_dashpots, without = (impacts.take(np.flatnonzero(part)) for part in (damped, ~damped))
    work[damped] = dashpots.solve(with_dashpots).dissipation
    springs = _springs(loss, without)
    contacts = _contacts(springs)
    refuse_endless(closed.solve(contacts))
    # Where rounding hides the last slip, before N = 0, it takes what the spring still has.
    strain = springs.zeta2 * contacts.z[F] ** 2 / 2
    work[~damped] = contacts.work - np.where(springs.e == 0, strain, 0.0)
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


def _history_on_springs(mirror: float, impact: Impacts, samples: int) -> History:
    """History of one contact on the paper's springs; `mirror` is the sign of x."""
    steps: list[Step] = []
    refuse_endless(closed.solve(_contacts(impact), steps))
    e = float(impact.e[0])

    def unit(phase: Phase) -> float:
        """Of time, in 1/Omega."""
        return e if phase.unloading else 1.0

    found = runs(steps, np.linspace(0.0, 1.0, samples), unit)
    compression = max(run.time[-1] for run in found if not run.phase.unloading)
    restitution = found[-1].time[-1] - compression
    columns, events = [], []
    before = None
    for phase, time, z in found:
        # Both halves are as long as they are by theory, to the last digit. What rounding puts
        # beside maximum compression is there.
        start, span = (compression, restitution) if phase.unloading else (0.0, compression)
        share = (time - start) / span
        share = np.where(np.abs(share - (not phase.unloading)) <= BESIDE, np.round(share), share)
        time = 1 + e * share if phase.unloading else share
        states = z[N], mirror * z[F], mirror * z[Q], mirror * impact.zeta2 * z[F]
        columns.append(np.stack([time, *states]))
        events += [(kind, columns[-1][:, 0]) for kind in phase.events(before)]
        before = phase
    if e == 0:
        events.append((EventKind.MAXIMUM_COMPRESSION, columns[-1][:, -1]))
    else:  # both forces vanish at separation, and the spring has no deflection
        columns[-1][[1, 2, 4], -1] = 0.0
    return History.joined(columns, events)


def _contacts(impacts: Impacts) -> OffCentre:
    """Contacts on springs, with friction in units of mu."""
    x, beta, zeta2, e = impacts
    return OffCentre(x, beta, np.zeros_like(x), zeta2, np.ones_like(x), e)
