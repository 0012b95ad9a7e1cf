"""Lumped contacts followed by `planarimpact.phases`: history of one, work of friction of many."""

import numpy as np

from planarimpact.common.arrays import Array
from planarimpact.common.results import EventKind, History
from planarimpact.lumped.dashpots import refuse_endless
from planarimpact.lumped.stick_slip import Impacts
from planarimpact.phases import Step, closed, follow, viscous
from planarimpact.phases.off_centre import F, N, OffCentre, Phase, Q
from planarimpact.phases.runs import BESIDE, runs


def of_springs(mirror: float, impact: Impacts, samples: int) -> History:
    """On the paper's springs; `mirror` is the sign of x."""
    steps: list[Step] = []
    refuse_endless(closed.solve(_springs(impact), steps))
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


def of_dashpots(mirror: float, impact: Impacts, samples: int) -> History:
    """On two Kelvin-Voigt elements, e < 1; `mirror` is the sign of x."""
    x, beta, zeta2, e = impact
    tau, _ = viscous.damping(e)
    contact = viscous.Viscous(x, beta, zeta2, tau)
    steps: list[Step] = []
    refuse_endless(follow(contact, contact.z, steps=steps))
    # The middle of the contact is where compression is largest.
    found = runs(steps, np.union1d(np.linspace(0.0, 1.0, samples), 0.5), lambda _: 1.0)
    half = found[-1].time[-1] / 2
    columns, events = [], []
    for side, time, z in found:
        normal = z[viscous.U] + tau * z[viscous.V]
        friction, spring = side * normal, side * zeta2 * z[viscous.U] + z[viscous.S]
        if not side:
            friction = (spring + tau * z[viscous.W]) / zeta2
        tangential = (mirror * field for field in (friction, z[viscous.W], spring))
        columns.append(np.stack([time / half, normal, *tangential]))
        kind = EventKind.SLIP if side else EventKind.STICK
        events.append((kind, columns[-1][:, 0]))
    # Of two phases that meet there the later one: the end of the other is left out.
    middle = min(columns[::-1], key=lambda block: np.abs(block[0] - 1).min())
    place = np.abs(middle[0] - 1).argmin()
    middle[0, place] = 1.0
    columns[-1][1:3, -1] = 0.0  # both forces, at separation
    events.append((EventKind.MAXIMUM_COMPRESSION, middle[:, place]))
    return History.joined(columns, sorted(events, key=lambda event: event[1][0]))


def friction_work(impacts: Impacts) -> Array:
    """Work of friction on the paper's springs, integrated over the phases of slip."""
    contacts = _springs(impacts)
    refuse_endless(closed.solve(contacts))
    # Where rounding hides the last slip, before N = 0, it takes what the spring still has.
    strain = impacts.zeta2 * contacts.z[F] ** 2 / 2
    return contacts.work - np.where(impacts.e == 0, strain, 0.0)


def _springs(impacts: Impacts) -> OffCentre:
    """Contacts on springs, with friction in units of mu."""
    x, beta, zeta2, e = impacts
    return OffCentre(x, beta, np.zeros_like(x), zeta2, np.ones_like(x), e)
