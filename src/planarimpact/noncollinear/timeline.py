"""The course of one non-collinear contact in physical units, from the solver's phases."""

from typing import NamedTuple

import numpy as np

from planarimpact.ground.arrays import Array
from planarimpact.ground.results import Event, EventKind
from planarimpact.noncollinear.closed_contact import Swing
from planarimpact.noncollinear.phases import Slip
from planarimpact.noncollinear.solver import Phase


class NoncollinearHistory(NamedTuple):
    """Forces, velocities and deflections over one contact; every event is a vertex.

    Attributes
    ----------
    time : ndarray, shape (n,)
        [s], from 0 to separation.
    normal_force, friction : ndarray, shape (n,)
        F2 and F1 [N]; friction is positive where it opposes a positive tangential velocity.
    tangential, normal : ndarray, shape (n,)
        Velocity of the contact point [m/s]; normal > 0 is approach.
    compression, spring : ndarray, shape (n,)
        Deflection of the normal and of the tangential element [m].
    events : tuple of Event
        In order of time; `normal` is the force, `velocity` the tangential one. STICK and SLIP mark
        where a phase starts, RELOADING where compression exceeds its earlier maximum again.

    Notes
    -----
    Without restitution, a contact that friction holds closed swings without end (`closed_contact`). The
    normal force is then its mean. It jumps to that value, and after a burst of slip friction jumps
    too: two vertices have the same time. Creep, which is many short slips, counts as slip.
    """

    time: Array
    normal_force: Array
    friction: Array
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
    speed: float,
    force: float,
    time: float,
) -> NoncollinearHistory:
    """History of a contact.

    Parameters
    ----------
    trace : list of solver.Phase
    e, zeta2 : float
        Restitution and stiffness ratio.
    samples : int
        Instants evenly spread over the contact, beside those of the events.
    speed, force, time : float
        v2(0) [m/s], m2 Omega [N s/m] and 1/Omega [s].

    Returns
    -------
    NoncollinearHistory
    """
    ends = np.cumsum([_pace(phase, e) * phase.duration for phase in trace])
    grid = np.linspace(0.0, ends[-1], samples)
    pieces: list[Array] = []
    starts: list[int] = []
    marks: list[tuple[EventKind, int]] = []
    before, peak = None, 0.0
    for phase, start, end in zip(trace, np.append(0.0, ends[:-1]), ends, strict=True):
        first = sum(piece.shape[1] for piece in pieces)
        jumps = isinstance(phase.motion, Swing) and not (before and before.unloading)
        # The end of a phase is the start of the next one. Events at a jump belong to the end.
        marks += [(kind, first - jumps) for kind in _kinds(phase, before)]
        if before and not jumps:
            starts.append(first)
        inside = grid[(grid > start) & (grid < end)]
        instants = np.concatenate([[start], inside, [end]])
        # A phase in unloading with a small e is so short that the difference of its ends would lose
        # digits.
        elapsed = np.concatenate([[0.0], (inside - start) / _pace(phase, e), [phase.duration]])
        state = phase.motion.at(elapsed)
        normal = np.maximum(state.normal, 0.0)
        if not phase.unloading:
            peak = normal[-1]
        # On the line of unloading u = u_max - e^2 (N_max - N).
        compression = peak - e * e * (peak - normal) if phase.unloading else normal
        approach = _pace(phase, e) * state.approach
        pieces.append(
            np.stack([instants, normal, state.friction, state.velocity, approach, compression])
        )
        before = phase
    columns = np.concatenate(pieces, axis=1)
    last = columns.shape[1] - 1
    if not trace[-1].unloading:
        marks.append((EventKind.MAXIMUM_COMPRESSION, last))
    marks.append((EventKind.SEPARATION, last))
    scales = [time, speed * force, speed * force, speed, speed, speed * time, speed * time]
    columns = np.vstack([columns, zeta2 * columns[2]]) * np.array(scales)[:, None]
    events = tuple(
        Event(kind, *(float(columns[row, column]) for row in (0, 1, 2, 3, 6)))
        for kind, column in marks
    )
    return NoncollinearHistory._make([*np.delete(columns, starts, axis=1), events])


def _pace(phase: Phase, e: float) -> float:
    return e if phase.unloading and not isinstance(phase.motion, Swing) else 1.0


def _kinds(phase: Phase, before: Phase | None) -> list[EventKind]:
    """Events where a phase starts."""
    kind = _kind(phase)
    if before is None:
        return [EventKind.CONTACT, kind]
    kinds = []
    if phase.unloading and not before.unloading:
        kinds.append(EventKind.MAXIMUM_COMPRESSION)
    if before.unloading and not phase.unloading:
        kinds.append(EventKind.RELOADING)
    if kind != _kind(before):
        kinds.append(kind)
    return kinds


def _kind(phase: Phase) -> EventKind:
    motion = phase.motion
    slides = motion.creeps if isinstance(motion, Swing) else isinstance(motion, Slip)
    return EventKind.SLIP if slides else EventKind.STICK
