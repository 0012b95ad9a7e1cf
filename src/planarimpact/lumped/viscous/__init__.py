"""The lumped contact of two Kelvin-Voigt elements: both directions lose energy by viscosity.

Each element is a spring beside a dashpot, and both have the relaxation time tau = 2 xi/Omega: the
tangential one obeys T = (s + tau s')/zeta^2 with its deflection s, the normal one N = u + tau u'
(Schwager and Poeschel 2007, DOI 10.1007/s10035-007-0065-z). All else is as in the paper's model:
w' = -beta T, stick has s' = w while |T| <= N, slip in direction g has T = g N. Units are those of
`stick_slip`. `elements` holds the closed forms, `searches` the ends of phases.

**Slip.** With the rate of compression v = u' and v' = -N, T = g N gives w = w0 + g beta (v - v0).
The deflection relaxes: s - g zeta^2 u falls as y = exp(-t/tau), with t from the onset. So the slip
velocity is

    w_s = g (w - s') = A + k v + B y,   A = g w0 - beta v0,   k = beta - zeta^2.

Slip from contact has B = 0. At an onset after stick s' has no jump, so w_s = 0 and
B = -(g w0 - zeta^2 v0).

**The work of friction** in a slip is the integral of N w_s. With -v' = N and

    (1 + 2 tau^2) N y = -((tau N + tau^2 v) y)'

it is closed: the fall of v times the mean of A + k v at both ends, and B times the integral of N y.

Errors do not grow: any two solutions approach each other in w^2/(2 beta) + s^2/(2 zeta^2). An event
misplaced by epsilon moves the result by the order of epsilon^2.
"""

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from planarimpact.ground import checks, roots, sliding
from planarimpact.ground.arrays import Array, Integers
from planarimpact.ground.checks import ConvergenceError
from planarimpact.ground.results import Event, EventKind, History, Regime
from planarimpact.lumped.stick_slip import Impacts, Outcome
from planarimpact.lumped.viscous.elements import Elements, damping_ratio, elements_of, phase_angle
from planarimpact.lumped.viscous.searches import Slip, Stick, slip_end, stick_end

# Impacts solved together: few enough for the cache, enough to hide Python's overhead.
CHUNK = 65536
# The range of the solver. A contact has at most some hundred half-waves of T, and all products
# keep their digits.
LEAST_RESTITUTION = 1e-3
LARGEST_MASS_RATIO = 1e6
LEAST_SHARE, LARGEST_SHARE = 1e-4, 1e6  # of the stiffness ratio in the mass ratio
# A slip is short if its time over tau, and times tau, is below this. There the closed form of its
# work loses digits; the quadrature of Gauss does not, and its error is below rounding.
SHORT = 1.0
NODES, WEIGHTS = np.polynomial.legendre.leggauss(8)


class Phase(NamedTuple):
    """A phase of one contact: times to separation at both ends, and the state at its start.

    `side` is the direction of slip, or the sign of T at the start of stick. Friction and velocity
    are mirrored by it. `transient` is B in slip.
    """

    sticks: bool
    ahead: float
    ahead_end: float
    side: float
    friction: float
    velocity: float
    transient: float


def check_range(impacts: Impacts) -> None:
    """Refuse impacts beyond the range of this solver."""
    _, beta, zeta2, e = impacts
    rules = [
        (
            "restitution",
            e,
            e < LEAST_RESTITUTION,
            f"numbers from {LEAST_RESTITUTION:g} to 1 where loss='viscous' (a viscous element "
            "stops no body at once)",
        ),
        (
            "mass_ratio",
            beta,
            beta > LARGEST_MASS_RATIO,
            f"numbers up to {LARGEST_MASS_RATIO:g} where loss='viscous'",
        ),
        (
            "stiffness_ratio",
            zeta2,
            (zeta2 < LEAST_SHARE * beta) | (zeta2 > LARGEST_SHARE * beta),
            f"{LEAST_SHARE:g} to {LARGEST_SHARE:g} times the mass ratio where loss='viscous'",
        ),
    ]
    for name, values, bad, rule in rules:
        if bad.any():
            raise checks.InputError(f"{name} = {float(values[bad][0])!r}: allowed are {rule}")


def solve(impacts: Impacts) -> Outcome:
    """Outcome of impacts with e < 1, arrays of shape (n,).

    The peak of friction is in mu times the largest normal force of the impact. The dissipation is
    the work of friction alone.
    """
    outcome = Outcome(
        np.empty_like(impacts.x),
        np.empty_like(impacts.x),
        np.empty_like(impacts.x),
        np.empty(impacts.x.size, np.uint8),
    )
    for which, elements in _alike_chunks(impacts):
        solved = _solve_alike(impacts.x[which], elements, None)
        for field, values in zip(outcome, solved, strict=True):
            field[which] = values
    return outcome


def phases(impacts: Impacts) -> tuple[Elements, list[Phase]]:
    """Elements and phases of one impact with e < 1."""
    trace: list[Phase] = []
    [(_, elements)] = _alike_chunks(impacts)
    _solve_alike(impacts.x, elements, trace)
    return elements, trace


def history(mirror: float, impacts: Impacts, samples: int) -> History:
    """Forces, velocity and spring over one contact with e < 1; `mirror` is the sign of x."""
    elements, trace = phases(impacts)
    half = elements.duration[0] / 2
    grid = np.linspace(2.0, 0.0, samples) * half

    def column(phase: Phase, ahead: Array) -> Array:
        normal, friction, velocity, spring = state(phase, elements, ahead)
        mirrored = mirror * friction, mirror * velocity, mirror * spring
        return np.stack([2.0 - ahead / half, normal, *mirrored])

    def event(kind: EventKind, values: Array) -> Event:
        return Event(kind, *(float(value) for value in values))

    columns, events = [], []
    for phase in trace:
        inside = grid[(grid < phase.ahead) & (grid > phase.ahead_end)]
        compressed = phase.ahead >= half > phase.ahead_end
        middle = [half] if compressed else []
        ahead = np.concatenate([[phase.ahead], inside, middle, [phase.ahead_end]])
        columns.append(column(phase, np.sort(np.unique(ahead))[::-1]))
        kinds = [EventKind.STICK if phase.sticks else EventKind.SLIP]
        if phase is trace[0]:
            kinds.insert(0, EventKind.CONTACT)
        events += [event(kind, columns[-1][:, 0]) for kind in kinds]
        if compressed:
            values = column(phase, np.array([half]))[:, 0]
            events.append(event(EventKind.MAXIMUM_COMPRESSION, values))
    events.append(event(EventKind.SEPARATION, columns[-1][:, -1]))
    joined = [phase_columns[:, :-1] for phase_columns in columns[:-1]] + columns[-1:]
    time, normal, friction, velocity, spring = np.concatenate(joined, axis=1)
    return History(time, normal, friction, velocity, spring, tuple(events))


def state(phase: Phase, elements: Elements, ahead: Array) -> tuple[Array, Array, Array, Array]:
    """Normal force, friction, velocity and deflection of the spring at times to separation."""
    tau, zeta2 = 2 * elements.xi, elements.zeta2
    force, v = elements.motion(ahead)
    time = phase.ahead - ahead
    start, rate = np.full_like(ahead, phase.friction), np.full_like(ahead, phase.velocity)
    if phase.sticks:
        friction, velocity = elements.stick(start, rate, time)
        spring = zeta2 * friction - tau * velocity
    else:
        _, v_start = elements.motion(np.full_like(ahead, phase.ahead))
        friction, velocity = force, rate + elements.beta * (v - v_start)
        spring = zeta2 * (force - tau * v) + tau * phase.transient * np.exp(-time / tau)
    return force, phase.side * friction, phase.side * velocity, phase.side * spring


def peak_normal(elements: Elements) -> Array:
    """Largest normal force over the contact, in m2 Omega |v2(0)|: at contact it is tau."""
    crest = elements.crest_ahead()
    force, _ = elements.motion(crest)
    return np.where(crest < elements.duration, force, 2 * elements.xi)


def _alike_chunks(impacts: Impacts) -> Iterator[tuple[Integers, Elements]]:
    """Indices of impacts with alike elements, `CHUNK` or fewer at a time, and these elements."""
    _, beta, zeta2, e = impacts
    angle, under = phase_angle(e)
    xi = damping_ratio(e, angle, np.where(under, np.sin(angle), np.sinh(angle)))
    swings = beta * xi * xi < zeta2
    for normal_under in (True, False):
        for tangential_under in (True, False):
            which = np.flatnonzero((under == normal_under) & (swings == tangential_under))
            for first in range(0, which.size, CHUNK):
                part = which[first : first + CHUNK]
                groups = beta[part], zeta2[part], e[part], angle[part]
                yield part, elements_of(normal_under, tangential_under, groups)


def _solve_alike(x: Array, elements: Elements, trace: list[Phase] | None) -> Outcome:
    """Outcome of impacts with alike elements; a `trace`, for one impact, gets its phases."""
    beta, zeta2, e = elements.beta, elements.zeta2, elements.e
    k = beta - zeta2
    # The slip velocity falls from x - zeta^2, linearly in the normal impulse, 1 + e in all.
    mean = (x - zeta2 + (x - beta - e * k)) / 2
    outcome = Outcome(
        sliding.velocity(x, beta, e),
        np.ones_like(x),
        (1 + e) * mean,
        np.full(x.shape, Regime.SLIP_THROUGHOUT, np.uint8),
    )
    sticks = x < sliding.limit_alike(beta, zeta2, e)
    early, late = np.flatnonzero(sticks & (x <= zeta2)), np.flatnonzero(sticks & (x > zeta2))
    if trace is not None and not sticks[0]:
        trace.append(Phase(False, elements.duration[0], 0.0, 1.0, 0.0, x[0], 0.0))
    if trace is not None and x[0] == 0:
        trace.append(Phase(True, elements.duration[0], 0.0, 1.0, 0.0, 0.0, 0.0))
    if early.size:
        part, start = elements.take(early), x[early]
        for field in outcome[:3]:
            field[early] = 0.0
        outcome.regime[early] = Regime.STICK
        friction = 2 * part.xi * start / part.zeta2
        moves = np.flatnonzero(start > 0)
        if moves.size < early.size:
            early, part, start, friction = (
                early[moves],
                part.take(moves),
                start[moves],
                friction[moves],
            )
        _alternate(early, Stick(part, part.duration, friction, start), True, outcome, trace)
    if late.size:
        part, start = elements.take(late), x[late]
        slip = Slip(part, part.duration, start - part.beta, np.zeros_like(start))
        time = roots.crossing(slip.velocity, np.zeros_like(start), part.duration)
        ahead = part.duration - time
        force, _ = part.motion(ahead)
        v = (part.beta - start) / slip.k
        if trace is not None:
            trace.append(Phase(False, part.duration[0], ahead[0], 1.0, 0.0, start[0], 0.0))
        outcome.dissipation[late] = (start - part.zeta2) * (start - part.zeta2) / (2 * slip.k)
        outcome.peak_friction[late] = np.where(ahead <= part.crest_ahead(), 1.0, 0.0)
        outcome.regime[late] = Regime.SLIP_STICK
        _alternate(late, Stick(part, ahead, force, part.zeta2 * v), False, outcome, trace)
    # Rounding must not create energy.
    np.minimum(np.maximum(outcome.velocity, -x), x, out=outcome.velocity)
    np.maximum(outcome.dissipation, 0.0, out=outcome.dissipation)
    np.minimum(outcome.peak_friction, 1.0, out=outcome.peak_friction)
    return outcome


def _alternate(
    which: Integers, stick: Stick, at_contact: bool, outcome: Outcome, trace: list[Phase] | None
) -> None:
    """Stick and slip in turn until every impact slides to separation; adds to the outcome.

    A stick that follows slip lasts at least to the next zero of T, or its slip to separation. So
    there are no more sticks than half-waves of T, and two: `most` is more than that.
    """
    side, count = np.ones(which.size), 0
    while which.size:
        elements, ahead = stick.elements, stick.ahead
        if count == 0:
            largest_phase = float(np.max(elements.rate * elements.duration))
            most = 8 + largest_phase * elements.tangential_under / np.pi
        if count > most:
            raise ConvergenceError(f"{which.size} impacts stick more often than they can")
        end, sign = stick_end(stick, at_contact and count == 0)
        time = ahead - end
        _, velocity = elements.stick(stick.friction, stick.velocity, time)
        _raise_peak(outcome.peak_friction, which, stick, time)
        if trace is not None:
            fields = stick.friction[0], stick.velocity[0]
            trace.append(Phase(True, ahead[0], end[0], side[0], *fields, 0.0))
        # The onset of slip, from now on mirrored to direction +1.
        side = side * sign
        velocity = velocity * sign
        ahead = end
        force, v = elements.motion(ahead)
        impulse = elements.impulse_ahead(ahead, v)
        transient = elements.zeta2 * v - velocity
        slip = Slip(elements, ahead, velocity - elements.beta * v, transient)
        stopped, time = slip_end(slip)
        outcome.velocity[which] = side * (velocity - elements.beta * impulse)
        outcome.regime[which] += np.uint8(Regime.STICK_SLIP - Regime.STICK if count == 0 else 0)
        # The end of slip, at separation or before.
        end, v_end, force_end = np.zeros_like(ahead), -elements.e, np.zeros_like(ahead)
        if stopped.size:
            end[stopped] = np.maximum(ahead[stopped] - time, 0.0)
            part = elements.take(stopped)
            force_end[stopped], v_end[stopped] = part.motion(end[stopped])
            impulse[stopped] -= part.impulse_ahead(end[stopped], v_end[stopped])
            outcome.regime[which[stopped]] = Regime.MULTIPLE
        ends = force, v, force_end, v_end
        outcome.dissipation[which] += _work(slip, end, impulse, *ends)
        crest = elements.crest_ahead()
        outcome.peak_friction[which[(end <= crest) & (crest <= ahead)]] = 1.0
        if trace is not None:
            onset = force[0], velocity[0], transient[0]
            trace.append(Phase(False, ahead[0], end[0], side[0], *onset))
        velocity = velocity - elements.beta * impulse
        which, side = which[stopped], side[stopped]
        stick = Stick(elements, end, force_end, velocity).take(stopped)
        count += 1


def _raise_peak(peak: Array, which: Integers, stick: Stick, time: Array) -> None:
    """Raise the peak of friction to that of a stick of this duration.

    Only a stick that starts before the normal force is largest can raise it: later N falls.
    """
    crest = stick.elements.crest_ahead()
    early = np.flatnonzero(stick.ahead >= crest)
    if not early.size:
        return
    part = stick.take(early)
    # The first crest is the highest of them.
    place = np.minimum(part.first_crest(part.first_zero()), time[early])
    highest = np.abs(part.elements.stick(part.friction, part.velocity, place)[0])
    last = np.abs(part.elements.stick(part.friction, part.velocity, time[early])[0])
    highest = np.maximum(np.maximum(highest, last), part.friction) / peak_normal(part.elements)
    peak[which[early]] = np.maximum(peak[which[early]], highest)


def _work(
    slip: Slip, end: Array, impulse: Array, force: Array, v: Array, force_end: Array, v_end: Array
) -> Array:
    """Work of friction in slips that start with w_s = 0, with the normal impulse of each."""
    tau = 2 * slip.elements.xi
    decay = slip.decay(slip.ahead - end)
    mean = (slip.constant + slip.k * v_end - slip.transient) / 2
    weighted = tau * (force - force_end * decay) + tau * tau * (v - v_end * decay)
    work = impulse * mean + slip.transient * weighted / (1 + 2 * tau * tau)
    time = slip.ahead - end
    short = np.flatnonzero(time * np.maximum(tau, 1 / tau) < SHORT)
    if short.size:
        part = slip.take(short)
        half = time[short] / 2
        total = np.zeros_like(half)
        for node, weight in zip(NODES, WEIGHTS, strict=True):
            at = half * (1 + node)
            normal, _ = part.elements.motion(part.ahead - at)
            total += weight * normal * part.velocity(np.arange(short.size), at)[0]
        work[short] = half * total
    return work
