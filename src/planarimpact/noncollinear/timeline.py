"""The history of one non-collinear contact in physical units, from its steps."""

from typing import NamedTuple

import numpy as np

from planarimpact.common.arrays import Array
from planarimpact.common.records import record
from planarimpact.common.results import Event, EventKind
from planarimpact.phases import Step
from planarimpact.phases.off_centre import Phase
from planarimpact.phases.runs import runs


@record
class NoncollinearHistory(NamedTuple):
    """Forces, velocities and deflections over one contact; every event is a vertex.

    Attributes
    ----------
    time : ndarray, shape (n,)
        [s], from 0 to separation.
    normal_force, friction_force : ndarray, shape (n,)
        F2 and F1 [N]; F1 is positive where it opposes a positive tangential velocity.
    tangential, normal : ndarray, shape (n,)
        Velocity of the contact point [m/s]; normal > 0 is approach.
    compression, spring : ndarray, shape (n,)
        Deflection of the normal and of the tangential element [m].
    events : tuple of Event
        In order of time; `normal` is the force, `velocity` the tangential one. STICK and SLIP mark
        where a phase starts, RELOADING where compression exceeds its earlier maximum again.

    Notes
    -----
    Without restitution, the normal force of a contact that friction holds closed oscillates without
    end (`phases.closed`). `normal_force` is then its mean. It jumps to that value, and if the
    first oscillation slips, friction jumps too: two vertices have the same time. Creep, which is
    many short slips, counts as slip.
    """

    time: Array
    normal_force: Array
    friction_force: Array
    tangential: Array
    normal: Array
    compression: Array
    spring: Array
    events: tuple[Event, ...]


def timeline(
    steps: list[Step],
    coupling: float,
    zeta2: float,
    e: float,
    samples: int,
    speed_unit: float,
    impedance_unit: float,
    time_unit: float,
) -> NoncollinearHistory:
    """History of a contact; units are v2(0) [m/s], m2 Omega [N s/m] and 1/Omega [s]."""
    force_unit, length_unit = speed_unit * impedance_unit, speed_unit * time_unit
    units = time_unit, force_unit, force_unit, speed_unit, speed_unit, length_unit, length_unit
    blocks: list[Array] = []
    events: list[tuple[EventKind, Array]] = []
    before, peak = None, 0.0

    def unit(phase: Phase) -> float:
        """Of time: e on the line of unloading."""
        return e if phase.unloading and not phase.side else 1.0

    for phase, time, z in runs(steps, np.linspace(0.0, 1.0, samples), unit):
        if phase.side:  # held closed: the mean of N, and no approach
            friction, velocity = phase.side * z[0], phase.side * z[2]
            normal, approach = coupling * friction, np.zeros_like(time)
        else:
            normal, approach, friction, velocity = z
            normal, approach = np.maximum(normal, 0.0), unit(phase) * approach
            velocity = velocity - coupling * approach
        if not phase.unloading:
            peak = normal[-1]
        # On the line of unloading u = u_max - e^2 (N_max - N).
        compression = peak - e * e * (peak - normal) if phase.unloading else normal
        columns = time, normal, friction, velocity, approach, compression, zeta2 * friction
        block = np.stack([column * u for column, u in zip(columns, units, strict=True)])
        first = block[:, 0]
        if before and phase.side and not before.side:
            first = blocks[-1][:, -1]  # the force jumps, after the events
        elif before:
            blocks[-1] = blocks[-1][:, :-1]  # the end of a phase is the start of the next one
        events += [(kind, first) for kind in phase.events(before)]
        blocks.append(block)
        before = phase
    events.insert(0, (EventKind.CONTACT, blocks[0][:, 0]))
    last = blocks[-1][:, -1]
    if before and not before.unloading:
        events.append((EventKind.MAXIMUM_COMPRESSION, last))
    events.append((EventKind.SEPARATION, last))
    return NoncollinearHistory._make(
        [*np.concatenate(blocks, axis=1), tuple(_event(kind, state) for kind, state in events)]
    )


def _event(kind: EventKind, state: Array) -> Event:
    """An event, from its state in the order of `NoncollinearHistory`."""
    time, normal_force, friction, tangential, _, _, spring = map(float, state)
    return Event(kind, time, normal_force, friction, tangential, spring)
