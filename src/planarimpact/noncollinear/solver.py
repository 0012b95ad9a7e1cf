"""The phases of a non-collinear contact in turn, from contact to separation."""

from typing import NamedTuple

import numpy as np

from planarimpact.ground.arrays import Array, Booleans, Integers
from planarimpact.ground.results import Regime
from planarimpact.noncollinear import closed_contact, stick_end
from planarimpact.noncollinear.phases import Groups, Slip, State, Stick

# A contact with more phases than this is given up.
MOST_PHASES = 5_000
# All restitutions below this one leave the same tangential motion, to rounding.
SMALLEST_PACE = 1e-50
# Two impulses that differ by less than this share are equal but for rounding.
TIE = 1e-14


class Impacts(NamedTuple):
    """Impacts in the units of `phases`, arrays of shape (n,); |v2(0)| = 1."""

    velocity: Array
    mass_ratio: Array
    coupling: Array
    stiffness_ratio: Array
    friction: Array
    restitution: Array


class Outcome(NamedTuple):
    """What is known of each impact so far, arrays of shape (n,), filled in place.

    `given_up` marks impacts with too many phases or oscillations: they have no result.
    """

    velocity: Array
    approach: Array
    peak_friction: Array
    peak_normal: Array
    friction_work: Array
    duration: Array
    regime: Integers
    jams: Booleans
    given_up: Booleans


class Phase(NamedTuple):
    """One phase of one contact: its motion, the half it belongs to, how long."""

    motion: Slip | Stick | closed_contact.Swing
    unloading: bool
    duration: float


class Contacts(NamedTuple):
    """Contacts that have not ended, arrays of shape (n,).

    `lanes` are their places in the batch, `unloading` tells the half of the contact. `direction` is
    that of slip, 0 in stick. `rising` tells whether in unloading the force has begun to rise again.
    `peak` is the normal force at maximum compression so far, `sticks` the number of sticks.
    """

    lanes: Integers
    state: State
    unloading: Booleans
    direction: Array
    rising: Booleans
    peak: Array
    sticks: Integers
    slid_first: Booleans


def solve(impacts: Impacts, trace: list[Phase] | None = None) -> Outcome:
    """Velocities, peak forces, work of friction, duration and regime.

    Parameters
    ----------
    impacts : Impacts
    trace : list, optional
        For a single impact: its phases are appended in order.

    Returns
    -------
    Outcome
    """
    size = impacts.velocity.size
    outcome = Outcome._make(
        [*np.zeros((6, size)), np.zeros(size, np.uint8), *np.zeros((2, size), bool)]
    )
    contacts = _first(impacts)
    for _ in range(MOST_PHASES):
        if not contacts.lanes.size:
            break
        contacts = _advance(contacts, impacts, outcome, trace)
    outcome.given_up[contacts.lanes] = True
    return outcome


def _first(impacts: Impacts) -> Contacts:
    """Contacts at their first instant: they stick, unless the body outruns the spring."""
    velocity, mu, zeta2 = impacts.velocity, impacts.friction, impacts.stiffness_ratio
    size = velocity.size
    direction = np.where(velocity < 0, -1.0, 1.0)
    start = State(np.zeros(size), np.ones(size), np.zeros(size), velocity)
    all_lanes = np.arange(size)
    groups = _groups(impacts, all_lanes, np.zeros(size, bool))
    limit = mu * zeta2
    # At the limit itself both forces leave zero together. Then it slides if slip would get faster.
    grows = Slip.start(start, groups, direction).slope >= 0
    slides = (np.abs(velocity) > limit) | ((np.abs(velocity) == limit) & grows) | (mu == 0)
    return Contacts(
        all_lanes,
        start,
        np.zeros(size, bool),
        np.where(slides, direction, 0.0),
        np.zeros(size, bool),
        np.zeros(size),
        np.where(slides, 0, 1),
        slides,
    )


def _groups(impacts: Impacts, lanes: Integers, unloading: Booleans) -> Groups:
    pace = np.where(unloading, np.maximum(impacts.restitution[lanes], SMALLEST_PACE), 1.0)
    return Groups(
        impacts.mass_ratio[lanes],
        impacts.coupling[lanes],
        impacts.stiffness_ratio[lanes],
        impacts.friction[lanes],
        pace,
    )


def _advance(
    contacts: Contacts, impacts: Impacts, outcome: Outcome, trace: list[Phase] | None
) -> Contacts:
    """One phase for every contact; those that end leave."""
    groups = _groups(impacts, contacts.lanes, contacts.unloading)
    sticks = contacts.direction == 0
    pieces = []
    for chosen, move in ((~sticks, _slide), (sticks, _stick)):
        which = np.flatnonzero(chosen)
        if which.size:
            part, some = _take(contacts, which), Groups(*(g[which] for g in groups))
            moved = move(part, some, impacts, outcome, trace)
            pieces.append(_leave(*moved, impacts, outcome, trace))
    if len(pieces) == 1:
        return pieces[0]
    return _join(*pieces)


def _take(contacts: Contacts, which: Integers) -> Contacts:
    state = State._make(field[which] for field in contacts.state)
    return Contacts._make(state if field is contacts.state else field[which] for field in contacts)


def _join(first: Contacts, second: Contacts) -> Contacts:
    state = State(*(np.concatenate(pair) for pair in zip(first.state, second.state, strict=True)))
    return Contacts._make(
        state if one is first.state else np.concatenate([one, two])
        for one, two in zip(first, second, strict=True)
    )


def _slide(
    contacts: Contacts,
    groups: Groups,
    impacts: Impacts,
    outcome: Outcome,
    trace: list[Phase] | None,
) -> tuple[Contacts, Booleans, Booleans]:
    """Slip to its next event: the contacts after it, those that separate, those that turn."""
    slip = Slip.start(contacts.state, groups, contacts.direction)
    unloading = contacts.unloading
    separation = np.where(unloading, slip.separation(), np.inf)
    candidates = np.stack(
        [
            # If it stops at the instant of another event, the other one comes first: the next phase
            # then tells whether slip goes on.
            slip.stop() * (1 + TIE),
            np.where(unloading, separation, slip.turn()),
            np.where(unloading, slip.reload(contacts.peak), np.inf),
        ]
    )
    event = candidates.argmin(axis=0)
    impulse = candidates.min(axis=0)
    # No event: rounding does this where C^2 equals m2/m1 to the last digits.
    endless = ~np.isfinite(impulse)
    outcome.given_up[contacts.lanes] = endless
    impulse = np.where(endless, 0.0, impulse)
    after = slip.after(impulse, separation)
    stops, ends, again = (event == kind for kind in range(3))
    after = after._replace(
        approach=np.where(ends & ~unloading, 0.0, after.approach),
        normal=np.where(ends & unloading, 0.0, np.where(again, contacts.peak, after.normal)),
    )
    lanes, mu = contacts.lanes, groups.friction
    after = after._replace(friction=contacts.direction * mu * after.normal)
    # A reloading that stays below the earlier peak has a largest force of its own.
    crest = slip.turn()
    inside = (contacts.state.approach > 0) & (after.approach < 0) & unloading
    top = slip.after(np.where(inside, crest, 0.0), separation).normal
    force = np.maximum(np.maximum(contacts.state.normal, after.normal), top)
    outcome.peak_friction[lanes] = np.maximum(outcome.peak_friction[lanes], mu * force)
    outcome.friction_work[lanes] += slip.work(impulse)
    duration = slip.duration(impulse, after.normal)
    outcome.duration[lanes] += groups.pace * duration
    outcome.jams[lanes] |= (slip.mass < 0) & (impulse > 0)
    _record(trace, slip, contacts, duration)
    moved = contacts._replace(
        state=after,
        direction=np.where(stops, 0.0, contacts.direction),
        rising=unloading & (after.approach > 0),
        sticks=contacts.sticks + stops,
    )
    return moved, ends, again


def _stick(
    contacts: Contacts,
    groups: Groups,
    impacts: Impacts,
    outcome: Outcome,
    trace: list[Phase] | None,
) -> tuple[Contacts, Booleans, Booleans]:
    """Stick to its next event."""
    stick = Stick.start(contacts.state, groups)
    unloading = contacts.unloading
    which = stick_end.functions(
        stick, contacts.state, groups, contacts.peak, unloading, contacts.rising
    )
    time, event = stick_end.first_zero(which)
    outcome.given_up[contacts.lanes] = event < 0
    after = stick.at(time)
    forward, backward, turns, ends, other = (event == kind for kind in range(5))
    again = other & contacts.rising
    direction = np.where(forward, 1.0, np.where(backward, -1.0, 0.0))
    slides = forward | backward
    mu = groups.friction
    normal = np.where(ends & unloading, 0.0, np.where(again, contacts.peak, after.normal))
    # At the onset of slip |F| = mu N, and the larger of the two forces is known to more digits.
    normal = np.where(slides & (mu > 1), np.abs(after.friction) / np.maximum(mu, 1.0), normal)
    normal = np.maximum(normal, 0.0)
    after = State(
        normal,
        np.where(ends & ~unloading, 0.0, after.approach),
        np.where(slides, direction * mu * normal, after.friction),
        np.where(turns, 0.0, after.velocity),
    )
    lanes = contacts.lanes
    outcome.peak_friction[lanes] = np.maximum(outcome.peak_friction[lanes], np.abs(after.friction))
    outcome.duration[lanes] += groups.pace * time
    _record(trace, stick, contacts, time)
    moved = contacts._replace(
        state=after,
        direction=direction,
        rising=(contacts.rising | other) & ~again,
    )
    return moved, ends, again


def _record(
    trace: list[Phase] | None,
    motion: Slip | Stick | closed_contact.Swing,
    contacts: Contacts,
    duration: Array,
) -> None:
    if trace is not None:
        trace.append(Phase(motion, bool(contacts.unloading[0]), float(duration[0])))


def _leave(
    contacts: Contacts,
    ends: Booleans,
    again: Booleans,
    impacts: Impacts,
    outcome: Outcome,
    trace: list[Phase] | None,
) -> Contacts:
    """Turn contacts at maximum compression and at the earlier peak; settle those that separate."""
    lanes, state = contacts.lanes, contacts.state
    e = impacts.restitution[lanes]
    pace = np.maximum(e, SMALLEST_PACE)
    compressed = ends & ~contacts.unloading
    peak = np.where(compressed, state.normal, contacts.peak)
    dead = compressed & (e == 0)
    separates = (ends & contacts.unloading) | dead
    approach = np.where(again, pace * state.approach, state.approach)
    moved = contacts._replace(
        state=state._replace(approach=approach),
        unloading=(contacts.unloading | compressed) & ~again,
        peak=peak,
    )
    sticks = np.flatnonzero(dead & (contacts.direction == 0))
    if sticks.size:
        moved, goes_on = _hold(moved, sticks, impacts, outcome, trace)
        separates[goes_on] = False
    gone = np.flatnonzero(separates)
    if gone.size:
        _settle(_take(moved, gone), e[gone], impacts, outcome)
    over = separates | outcome.given_up[lanes]
    return _take(moved, np.flatnonzero(~over)) if over.any() else moved


def _hold(
    contacts: Contacts,
    which: Integers,
    impacts: Impacts,
    outcome: Outcome,
    trace: list[Phase] | None,
) -> tuple[Contacts, Integers]:
    """Move on those of `which`, in stick without restitution, that friction holds closed.

    Returns the contacts and which of them compression goes on for.
    """
    lanes = contacts.lanes[which]
    some, groups = _take(contacts, which), _groups(impacts, lanes, np.zeros(which.size, bool))
    closed, lowest = closed_contact.lowest_force(some.state, groups)
    which, lanes, kept = which[closed], lanes[closed], np.flatnonzero(closed)
    some, groups = _take(some, kept), Groups(*(group[kept] for group in groups))
    release = closed_contact.Release.of(some.state, groups, lowest[kept])
    outcome.peak_friction[lanes] = np.maximum(outcome.peak_friction[lanes], release.peak_friction)
    outcome.friction_work[lanes] += release.work
    outcome.duration[lanes] += release.stick_time + release.creep_time
    outcome.jams[lanes] |= release.bursts | ~release.reloads
    if kept.size:
        _record(trace, release.stick, some, release.stick_time)
        if not release.reloads.all():
            _record(trace, release.creep, some, release.creep_time)
    state = State(*(field.copy() for field in contacts.state))
    for field, end in zip(state, release.end, strict=True):
        field[which] = end
    # Each burst, and creep again and again, brings a new stick.
    sticks, unloading = contacts.sticks.copy(), contacts.unloading.copy()
    sticks[which] += release.bursts + 2 * ~release.reloads
    unloading[which] = ~release.reloads
    moved = contacts._replace(state=state, sticks=sticks, unloading=unloading)
    return moved, which[release.reloads]


def _settle(contacts: Contacts, e: Array, impacts: Impacts, outcome: Outcome) -> None:
    """Write down the outcome of contacts that separate, with the strain energy that is lost.

    At separation the tangential spring may still be strained: for e = 0, and where mu is so large
    that the last slip cannot be told from separation.
    """
    lanes, state = contacts.lanes, contacts.state
    outcome.velocity[lanes] = state.velocity
    outcome.approach[lanes] = e * state.approach
    outcome.peak_normal[lanes] = contacts.peak
    outcome.friction_work[lanes] += impacts.stiffness_ratio[lanes] * state.friction**2 / 2
    sticks, slid_first, slides = contacts.sticks, contacts.slid_first, contacts.direction != 0
    outcome.regime[lanes] = np.select(
        [sticks == 0, sticks > 1, slid_first & slides, slid_first, slides],
        [
            Regime.SLIP_THROUGHOUT,
            Regime.MULTIPLE,
            Regime.SLIP_STICK_SLIP,
            Regime.SLIP_STICK,
            Regime.STICK_SLIP,
        ],
        Regime.STICK,
    )
