"""The paper's element: linear in both directions, with a stiffer normal one in restitution.

Functions of impacts x >= 0, which `stick_slip` solves.
"""

import numpy as np

from planarimpact.common.arrays import Array, Numbers
from planarimpact.common.results import EventKind, History
from planarimpact.lumped import normal, stick_slip
from planarimpact.lumped.stick_slip import Impacts

# Nodes and weights of Gauss on -1 to 1, for the work of friction within a phase.
QUADRATURE = np.polynomial.legendre.leggauss(20)


def history(mirror: float, impacts: Impacts, samples: int) -> History:
    """Forces and velocity over one contact, as `lumped.history`; `mirror` is the sign of x."""
    groups, contact = phases(impacts)
    _, zeta2, e = groups
    grid = np.linspace(0.0, 1.0 + e, samples)
    columns: list[Array] = []
    events: list[tuple[EventKind, Array]] = []
    before = None
    for phase, eta_end in contact:
        start, end = (normal.time(eta, e, phase.in_restitution) for eta in (phase.eta, eta_end))
        inside = grid[(grid > start) & (grid < end)]
        time = np.concatenate([[start], inside, [end]])
        eta = np.concatenate([[phase.eta], _angle(inside, e, phase.in_restitution), [eta_end]])
        friction, velocity = stick_slip.state(phase, eta, *groups)
        friction, velocity = mirror * friction, mirror * velocity
        columns.append(np.stack([time, normal.force(eta), friction, velocity, zeta2 * friction]))
        events += [(kind, columns[-1][:, 0]) for kind in _kinds(phase, before)]
        before = phase
    if e == 0:
        events.append((EventKind.MAXIMUM_COMPRESSION, columns[-1][:, -1]))
    return History.joined(columns, events)


def friction_work(impacts: Impacts) -> float:
    """Work of friction in one contact, integrated over its phases of slip."""
    groups, contact = phases(impacts)
    _, zeta2, e = groups
    nodes, weights = QUADRATURE
    work = 0.0
    for phase, eta_end in contact:
        if phase.sticks:
            continue
        half = (eta_end - phase.eta) / 2
        eta = phase.eta + half * (1 + nodes)
        friction, velocity = stick_slip.state(phase, eta, *groups)
        # Slip velocity w - s' times dt, in the angle of either half.
        pace = -e if phase.in_restitution else 1.0
        slip = pace * velocity - phase.side * zeta2 * np.cos(eta)
        work += float(half * (weights @ (friction * slip)))
    return work


def phases(
    impacts: Impacts,
) -> tuple[tuple[float, float, float], list[tuple[stick_slip.Phase, Numbers]]]:
    """One impact: (beta, zeta^2, e), and its phases, each with its last eta."""
    _, beta, zeta2, e = impacts
    trace: list[stick_slip.Phase] = []
    stick_slip.solve(impacts, trace)
    if e[0] == 0:  # separation at maximum compression
        trace = [phase for phase in trace if not phase.in_restitution]
    trace = [stick_slip.Phase._make(np.ravel(field)[0] for field in phase) for phase in trace]
    # A phase ends where the next one starts, or with its half of the contact.
    ends = [
        after.eta if after.in_restitution == phase.in_restitution else np.pi / 2
        for phase, after in zip(trace, trace[1:], strict=False)
    ]
    ends.append(0.0 if trace[-1].in_restitution else np.pi / 2)
    ratios = float(beta[0]), float(zeta2[0]), float(e[0])
    return ratios, list(zip(trace, ends, strict=True))


def _angle(time: Array, e: float, in_restitution: bool) -> Array:
    """The angle `eta` of `normal` at a time within one half."""
    return np.pi / 2 * np.clip((1 + e - time) / e if in_restitution else time, 0.0, 1.0)


def _kinds(phase: stick_slip.Phase, before: stick_slip.Phase | None) -> list[EventKind]:
    """Events where a phase starts; one that goes on through maximum compression is not new."""
    kind = EventKind.STICK if phase.sticks else EventKind.SLIP
    if before is None or phase.in_restitution == before.in_restitution:
        return [kind]
    return [EventKind.MAXIMUM_COMPRESSION, *([kind] if phase.sticks != before.sticks else [])]
