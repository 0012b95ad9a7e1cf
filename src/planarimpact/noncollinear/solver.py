"""Solves non-collinear contacts phase by phase, from contact to separation."""

from typing import NamedTuple, TypeAlias

import numpy as np

from planarimpact.common.arrays import Array, Booleans, Integers, Numbers
from planarimpact.common.results import Regime
from planarimpact.noncollinear import stick_end
from planarimpact.noncollinear.closed_contact import ClosedCourse, ClosedPhase, held_closed
from planarimpact.noncollinear.phases import TIE, Groups, Slip, State, Stick, taken

# Impacts solved together: few enough for memory, enough that Python's overhead is small.
CHUNK = 65536
# The solver gives up a contact with more phases than this.
MOST_PHASES = 5_000
# Time scale of unloading where restitution is smaller: then the tangential motion is the same, to
# rounding.
SMALLEST_TIME_SCALE = 1e-50


class Impacts(NamedTuple):
    """Impacts in the units of `phases`, arrays of shape (n,); |v2(0)| = 1."""

    velocity: Array
    mass_ratio: Array
    coupling: Array
    stiffness_ratio: Array
    friction: Array
    restitution: Array


Motion: TypeAlias = Slip | Stick | ClosedPhase


class Phase(NamedTuple):
    """One phase of one contact: its motion, whether in unloading, and its scaled duration."""

    motion: Motion
    unloading: bool
    duration: float


class Contacts(NamedTuple):
    """Contacts that have not ended, arrays of shape (n,).

    `impact` is the index of each in `Impacts` and `Outcome`. `unloading` is true on the line of
    unloading, and there `rising` is true while the force rises again. `direction` is that of slip,
    0 in stick. `peak` is the normal force at maximum compression so far.
    """

    impact: Integers
    state: State
    unloading: Booleans
    direction: Array
    rising: Booleans
    peak: Array
    stick_count: Integers
    slid_first: Booleans


class Outcome(NamedTuple):
    """Results of impacts so far, arrays of shape (n,), filled in place.

    `given_up` marks impacts with too many phases or oscillations: they have no result.
    Impulses are sums: the change of velocity has too few digits for them where C^2 is near beta.
    `trace` gets the phases of a single impact in order.
    """

    velocity: Array
    approach: Array
    friction_impulse: Array
    normal_impulse: Array
    peak_friction: Array
    peak_normal: Array
    friction_work: Array
    duration: Array
    regime: Integers
    jams: Booleans
    given_up: Booleans
    trace: list[Phase] | None

    def add(
        self,
        contacts: Contacts,
        motion: Motion,
        duration: Array,
        impulses: tuple[Array, Array],
        peak_friction: Array,
        time_scale: Numbers = 1.0,
    ) -> None:
        """Add a phase of contacts, with the scaled duration and impulses of F and N."""
        impact = contacts.impact
        self.duration[impact] += time_scale * duration
        friction, normal = impulses
        self.friction_impulse[impact] += time_scale * friction
        self.normal_impulse[impact] += time_scale * normal
        self.peak_friction[impact] = np.maximum(self.peak_friction[impact], peak_friction)
        if self.trace is not None:
            self.trace.append(Phase(motion, bool(contacts.unloading[0]), float(duration[0])))


def solve(impacts: Impacts, trace: list[Phase] | None = None) -> Outcome:
    """Solve impacts, chunk by chunk; the phases of a single one are appended to `trace`."""
    size = impacts.velocity.size
    outcome = Outcome._make(
        [*np.zeros((8, size)), np.zeros(size, np.uint8), *np.zeros((2, size), bool), trace]
    )
    for start in range(0, size, CHUNK):
        contacts = _start(impacts, np.arange(start, min(start + CHUNK, size)))
        for _ in range(MOST_PHASES):
            if not contacts.impact.size:
                break
            contacts = _next_phase(contacts, impacts, outcome)
        outcome.given_up[contacts.impact] = True
    return outcome


def _start(impacts: Impacts, chosen: Integers) -> Contacts:
    """Contacts at their first instant: they stick, unless the body is faster than the spring."""
    velocity, size = impacts.velocity[chosen], chosen.size
    direction = np.where(velocity < 0, -1.0, 1.0)
    start = State(np.zeros(size), np.ones(size), np.zeros(size), velocity)
    groups = _groups(impacts, chosen, np.zeros(size, bool))
    limit = groups.friction * groups.stiffness_ratio
    # At the limit itself |F| = mu N to first order in time: the contact slips if slip gets faster.
    gets_faster = Slip.start(start, groups, direction).slope >= 0
    at_limit = np.abs(velocity) == limit
    slides = (np.abs(velocity) > limit) | (at_limit & gets_faster) | (groups.friction == 0)
    return Contacts(
        chosen,
        start,
        np.zeros(size, bool),
        np.where(slides, direction, 0.0),
        np.zeros(size, bool),
        np.zeros(size),
        np.where(slides, 0, 1),
        slides,
    )


def _groups(impacts: Impacts, chosen: Integers, unloading: Booleans) -> Groups:
    """Groups of the chosen impacts, with the time scale of loading or unloading."""
    _, *groups, e = (field[chosen] for field in impacts)
    time_scale = np.where(unloading, np.maximum(e, SMALLEST_TIME_SCALE), 1.0)
    return Groups._make([*groups, time_scale])


def _next_phase(contacts: Contacts, impacts: Impacts, outcome: Outcome) -> Contacts:
    """Advance every contact by one phase, and return those that have not ended."""
    groups = _groups(impacts, contacts.impact, contacts.unloading)
    in_stick = contacts.direction == 0
    remaining = []
    for mask, advance in ((~in_stick, _slip_phase), (in_stick, _stick_phase)):
        chosen = np.flatnonzero(mask)
        if chosen.size:
            event = advance(taken(contacts, chosen), taken(groups, chosen), outcome)
            remaining.append(_after_event(*event, impacts, outcome))
    return remaining[0] if len(remaining) == 1 else _join(*remaining)


def _join(first: Contacts, second: Contacts) -> Contacts:
    """The contacts of both."""
    state = State(*(np.concatenate(pair) for pair in zip(first.state, second.state, strict=True)))
    return Contacts._make(
        state if one is first.state else np.concatenate([one, two])
        for one, two in zip(first, second, strict=True)
    )


def _slip_phase(
    contacts: Contacts, groups: Groups, outcome: Outcome
) -> tuple[Contacts, Booleans, Booleans]:
    """Slip to its next event: contacts there, where a half ends, where N is at its peak again."""
    slip = Slip.start(contacts.state, groups, contacts.direction)
    unloading = contacts.unloading
    separation = np.where(unloading, slip.separation(), np.inf)
    # If slip stops at the instant of another event, the other one comes first: the next phase then
    # shows whether slip goes on.
    stop = slip.stop() * (1 + TIE)
    half_end = np.where(unloading, separation, slip.approach_end())
    peak_again = np.where(unloading, slip.reload(contacts.peak), np.inf)
    impulse = np.minimum(np.minimum(stop, half_end), peak_again)
    stops = stop == impulse
    half_ends = ~stops & (half_end == impulse)
    at_peak = ~(stops | half_ends)
    # Where C^2 equals m2/m1 to the last digits, rounding may leave no event.
    no_event = ~np.isfinite(impulse)
    outcome.given_up[contacts.impact] = no_event
    impulse = np.where(no_event, 0.0, impulse)
    after = slip.after(impulse, separation)
    after = after._replace(
        approach=np.where(half_ends & ~unloading, 0.0, after.approach),
        normal=np.where(half_ends & unloading, 0.0, np.where(at_peak, contacts.peak, after.normal)),
    )
    impact, mu = contacts.impact, groups.friction
    after = after._replace(friction=contacts.direction * mu * after.normal)
    # A force that rises again and stays below the earlier peak has a maximum within the phase.
    has_maximum = (contacts.state.approach > 0) & (after.approach < 0) & unloading
    maximum = slip.after(np.where(has_maximum, slip.approach_end(), 0.0), separation).normal
    largest = np.maximum(np.maximum(contacts.state.normal, after.normal), maximum)
    duration, impulses = slip.duration(impulse, after.normal), slip.impulses(impulse)
    outcome.add(contacts, slip, duration, impulses, mu * largest, groups.time_scale)
    outcome.friction_work[impact] += slip.work(impulse)
    outcome.jams[impact] |= (slip.inverse_mass < 0) & (impulse > 0)
    contacts_after = contacts._replace(
        state=after,
        direction=np.where(stops, 0.0, contacts.direction),
        rising=unloading & (after.approach > 0),
        stick_count=contacts.stick_count + stops,
    )
    return contacts_after, half_ends, at_peak


def _stick_phase(
    contacts: Contacts, groups: Groups, outcome: Outcome
) -> tuple[Contacts, Booleans, Booleans]:
    """Stick to its next event; returns as `_slip_phase`."""
    stick = Stick.start(contacts.state, groups)
    unloading = contacts.unloading
    functions = stick_end.functions_of(
        stick, contacts.state, groups, contacts.peak, unloading, contacts.rising
    )
    time, event = stick_end.first_zero(functions)
    impact = contacts.impact
    outcome.given_up[impact] = event == stick_end.NOT_FOUND
    after = stick.at(time)
    forward, backward = event == stick_end.FORWARD_SLIP, event == stick_end.BACKWARD_SLIP
    half_ends, force_rises = event == stick_end.END_OF_HALF, event == stick_end.FORCE_RISES
    at_peak = force_rises & contacts.rising
    direction = np.where(forward, 1.0, np.where(backward, -1.0, 0.0))
    slides = forward | backward
    mu = groups.friction
    normal = np.where(half_ends & unloading, 0.0, np.where(at_peak, contacts.peak, after.normal))
    # At the onset of slip |F| = mu N, and the larger of the two forces has more correct digits.
    normal = np.where(slides & (mu > 1), np.abs(after.friction) / np.maximum(mu, 1.0), normal)
    normal = np.maximum(normal, 0.0)
    after = State(
        normal,
        np.where(half_ends & ~unloading, 0.0, after.approach),
        np.where(slides, direction * mu * normal, after.friction),
        np.where(event == stick_end.EXTREMUM_OF_FRICTION, 0.0, after.velocity),
    )
    peak_friction = np.abs(after.friction)
    outcome.add(contacts, stick, time, stick.impulses(time), peak_friction, groups.time_scale)
    contacts_after = contacts._replace(
        state=after,
        direction=direction,
        rising=(contacts.rising | force_rises) & ~at_peak,
    )
    return contacts_after, half_ends, at_peak


def _after_event(
    contacts: Contacts, half_ends: Booleans, at_peak: Booleans, impacts: Impacts, outcome: Outcome
) -> Contacts:
    """Start unloading or loading, write the outcome of contacts that separate, and drop them."""
    impact, state = contacts.impact, contacts.state
    e = impacts.restitution[impact]
    compressed = half_ends & ~contacts.unloading
    peak = np.where(compressed, state.normal, contacts.peak)
    no_restitution = compressed & (e == 0)
    separates = (half_ends & contacts.unloading) | no_restitution
    time_scale = np.maximum(e, SMALLEST_TIME_SCALE)
    approach = np.where(at_peak, time_scale * state.approach, state.approach)
    contacts = contacts._replace(
        state=state._replace(approach=approach),
        unloading=(contacts.unloading | compressed) & ~at_peak,
        peak=peak,
    )
    in_stick = np.flatnonzero(no_restitution & (contacts.direction == 0))
    if in_stick.size:
        separates[_closed_course(contacts, in_stick, impacts, outcome)] = False
    separating = np.flatnonzero(separates)
    if separating.size:
        _write_outcome(taken(contacts, separating), e[separating], impacts, outcome)
    ended = separates | outcome.given_up[impact]
    return taken(contacts, np.flatnonzero(~ended)) if ended.any() else contacts


def _closed_course(
    contacts: Contacts, in_stick: Integers, impacts: Impacts, outcome: Outcome
) -> Integers:
    """Advance contacts in stick without restitution, in place, if friction holds them closed.

    Returns the indices of those whose compression goes on.
    """
    candidates = taken(contacts, in_stick)
    groups = _groups(impacts, candidates.impact, np.zeros(in_stick.size, bool))
    is_held, lowest = held_closed(candidates.state, groups)
    kept = np.flatnonzero(is_held)
    held, closed = in_stick[kept], taken(candidates, kept)
    groups = taken(groups, kept)
    course = ClosedCourse.of(closed.state, groups, lowest[kept])
    if kept.size:
        impulses = course.stick.impulses(course.stick_time)
        outcome.add(closed, course.stick, course.stick_time, impulses, course.peak_friction)
    if not course.reloads.all():
        impulses = course.creep.impulses(course.creep_time)
        outcome.add(closed, course.creep, course.creep_time, impulses, course.peak_friction)
    impact = closed.impact
    outcome.friction_work[impact] += course.work
    outcome.jams[impact] |= course.slips_first | ~course.reloads
    for field, end in zip(contacts.state, course.end, strict=True):
        field[held] = end
    # A slip in the first oscillation is followed by a new stick, and creep has many.
    contacts.stick_count[held] += course.slips_first + 2 * ~course.reloads
    contacts.unloading[held] = ~course.reloads
    return held[course.reloads]


def _write_outcome(contacts: Contacts, e: Array, impacts: Impacts, outcome: Outcome) -> None:
    """Write the outcome of contacts that separate, with the strain energy that is lost.

    At separation the tangential spring may still be strained: for e = 0, and where mu is so large
    that rounding hides the last slip.
    """
    impact, state = contacts.impact, contacts.state
    outcome.velocity[impact] = state.velocity
    outcome.approach[impact] = e * state.approach
    outcome.peak_normal[impact] = contacts.peak
    outcome.friction_work[impact] += impacts.stiffness_ratio[impact] * state.friction**2 / 2
    outcome.regime[impact] = Regime.of_phases(
        contacts.stick_count, contacts.slid_first, contacts.direction != 0
    )
