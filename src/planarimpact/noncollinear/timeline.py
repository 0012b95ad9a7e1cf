"""The history of one non-collinear contact in physical units, from the solver's phases."""

from typing import NamedTuple

import numpy as np

from planarimpact.common.arrays import Array
from planarimpact.common.results import Event, EventKind
from planarimpact.noncollinear.closed_contact import ClosedPhase
from planarimpact.noncollinear.phases import Slip
from planarimpact.noncollinear.solver import Phase


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
    end (`closed_contact`). `normal_force` is then its mean. It jumps to that value, and if the
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
    trace: list[Phase],
    e: float,
    zeta2: float,
    samples: int,
    speed_unit: float,
    impedance_unit: float,
    time_unit: float,
) -> NoncollinearHistory:
    """History of a contact; units are v2(0) [m/s], m2 Omega [N s/m] and 1/Omega [s]."""
    ends = np.cumsum([_time_scale(phase, e) * phase.duration for phase in trace])
    grid = np.linspace(0.0, ends[-1], samples)
    force_unit, length_unit = speed_unit * impedance_unit, speed_unit * time_unit
    blocks: list[Array] = []
    events: list[tuple[EventKind, Array]] = []
    before, peak = None, 0.0
    for phase, start, end in zip(trace, np.append(0.0, ends[:-1]), ends, strict=True):
        inside = grid[(grid > start) & (grid < end)]
        instants = np.concatenate([[start], inside, [end]])
        # A phase in unloading with a small e is so short that the difference of its ends would have
        # few digits.
        time_scale = _time_scale(phase, e)
        elapsed = np.concatenate([[0.0], (inside - start) / time_scale, [phase.duration]])
        state = phase.motion.at(elapsed)
        normal = np.maximum(state.normal, 0.0)
        if not phase.unloading:
            peak = normal[-1]
        # On the line of unloading u = u_max - e^2 (N_max - N).
        compression = peak - e * e * (peak - normal) if phase.unloading else normal
        block = np.stack(
            [
                instants * time_unit,
                normal * force_unit,
                state.friction * force_unit,
                state.velocity * speed_unit,
                time_scale * state.approach * speed_unit,
                compression * length_unit,
                zeta2 * state.friction * length_unit,
            ]
        )
        first = block[:, 0]
        if before and isinstance(phase.motion, ClosedPhase) and not before.unloading:
            first = blocks[-1][:, -1]  # the force jumps, after the events
        elif before:
            blocks[-1] = blocks[-1][:, :-1]  # the end of a phase is the start of the next one
        events += [(kind, first) for kind in _kinds(phase, before)]
        blocks.append(block)
        before = phase
    last = blocks[-1][:, -1]
    if not trace[-1].unloading:
        events.append((EventKind.MAXIMUM_COMPRESSION, last))
    events.append((EventKind.SEPARATION, last))
    return NoncollinearHistory._make(
        [*np.concatenate(blocks, axis=1), tuple(_event(kind, state) for kind, state in events)]
    )


def _event(kind: EventKind, state: Array) -> Event:
    """An event, from its state in the order of `NoncollinearHistory`."""
    time, normal_force, friction, tangential, _, _, spring = map(float, state)
    return Event(kind, time, normal_force, friction, tangential, spring)


def _time_scale(phase: Phase, e: float) -> float:
    """Time scale of a phase: e on the line of unloading."""
    return e if phase.unloading and not isinstance(phase.motion, ClosedPhase) else 1.0


def _kinds(phase: Phase, before: Phase | None) -> list[EventKind]:
    """Events where a phase starts."""
    kind = _kind(phase)
    if before is None:
        return [EventKind.CONTACT, kind]
    kinds = []
    if phase.unloading != before.unloading:
        kinds.append(EventKind.MAXIMUM_COMPRESSION if phase.unloading else EventKind.RELOADING)
    if kind != _kind(before):
        kinds.append(kind)
    return kinds


def _kind(phase: Phase) -> EventKind:
    """Whether a phase is slip or stick."""
    motion = phase.motion
    slides = motion.creeps if isinstance(motion, ClosedPhase) else isinstance(motion, Slip)
    return EventKind.SLIP if slides else EventKind.STICK
