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

from typing import TypeAlias

import numpy as np

from planarimpact.common import checks, sliding
from planarimpact.common.arrays import Array, Integers
from planarimpact.common.checks import ConvergenceError
from planarimpact.common.results import EventKind, History, Regime
from planarimpact.lumped.stick_slip import Impacts, Outcome
from planarimpact.lumped.viscous.elements import Elements, alike
from planarimpact.lumped.viscous.searches import Slip, Stick, phase_end, take

# The range of the solver: a viscous element stops no body for good. In this range a contact has
# some hundred half-waves of T at most, fewer than MOST_STICKS, and all products keep their digits.
LEAST_RESTITUTION = 1e-3
LARGEST_MASS_RATIO = 1e6
LEAST_SHARE, LARGEST_SHARE = 1e-4, 1e6  # of the stiffness ratio in the mass ratio
MOST_STICKS = 1000
# The impulse of a slip is a difference, which loses digits where its time, and that times tau, is
# below SHORT. So does its work, where its time over tau is below SHORT too. Gauss's quadrature
# keeps them.
SHORT = 0.1
NODES, WEIGHTS = (numbers[:, None] for numbers in np.polynomial.legendre.leggauss(4))
# Phases of one impact, in order, and when each ends.
Trace: TypeAlias = list[tuple[Stick | Slip, Array]]


def _check_range(impacts: Impacts) -> None:
    """Refuse impacts beyond the range of this solver."""
    _, beta, zeta2, e = impacts
    share = f"{LEAST_SHARE:g} to {LARGEST_SHARE:g} times the mass ratio"
    beyond = (zeta2 < LEAST_SHARE * beta) | (zeta2 > LARGEST_SHARE * beta)
    least = f"numbers from {LEAST_RESTITUTION:g} to 1"
    rules = [
        ("restitution", e, e < LEAST_RESTITUTION, least),
        ("mass_ratio", beta, beta > LARGEST_MASS_RATIO, f"numbers up to {LARGEST_MASS_RATIO:g}"),
        ("stiffness_ratio", zeta2, beyond, share),
    ]
    for name, values, bad, rule in rules:
        if bad.any():
            found = float(values[bad][0])
            raise checks.InputError(f"{name} = {found}: allowed are {rule} where loss='viscous'")


def solve(impacts: Impacts) -> Outcome:
    """Outcome of impacts with e < 1, arrays of shape (n,).

    The peak of friction is in mu times the largest normal force of the impact. The dissipation is
    the work of friction alone.
    """
    _check_range(impacts)
    velocity, peak, work = (np.empty_like(impacts.x) for _ in range(3))
    outcome = Outcome(velocity, peak, work, np.empty(impacts.x.size, np.uint8))
    x, *groups = impacts
    for which, elements in alike(*groups):
        for field, values in zip(outcome, _solve_alike(x[which], elements, None), strict=True):
            field[which] = values
    return outcome


def history(mirror: float, impacts: Impacts, samples: int) -> History:
    """Forces, velocity and spring over one contact with e < 1; `mirror` is the sign of x."""
    _check_range(impacts)
    x, *groups = impacts
    [(_, elements)] = alike(*groups)
    trace: Trace = []
    _solve_alike(x, elements, trace)
    half = -elements.contact()[0] / 2
    grid = np.linspace(-2.0, 0.0, samples) * half
    columns: list[Array] = []
    events: list[tuple[EventKind, Array]] = []
    lasting = [(phase, end) for phase, end in trace if (phase.start < end).any()]
    for phase, end in lasting or [(_slip_from_contact(elements, x), np.zeros(1))]:
        inside = grid[(grid > phase.start) & (grid < end)]
        compressed = phase.start <= -half < end
        middle = [-half] if compressed else []
        time = np.unique([*phase.start, *inside, *middle, *end])
        normal, *tangential = phase.state(time)
        mirrored = (mirror * phase.side * values for values in tangential)
        columns.append(np.stack([2.0 + time / half, normal, *mirrored]))
        kind = EventKind.STICK if isinstance(phase, Stick) else EventKind.SLIP
        events.append((kind, columns[-1][:, 0]))
        if compressed:
            place = np.searchsorted(time, -half)
            events.append((EventKind.MAXIMUM_COMPRESSION, columns[-1][:, place]))
    return History.joined(columns, events)


def _solve_alike(x: Array, elements: Elements, trace: Trace | None) -> Outcome:
    """Outcome of impacts with alike elements; a `trace`, for one impact, gets its phases."""
    beta, zeta2, e = elements.beta, elements.zeta2, elements.e
    outcome = Outcome(
        sliding.velocity(x, beta, e),
        np.ones_like(x),
        sliding.viscous_work(x, beta, zeta2, e),
        np.full(x.shape, Regime.SLIP_THROUGHOUT, np.uint8),
    )
    ends = x < sliding.limit_alike(beta, zeta2, e)
    early, late = np.flatnonzero(ends & (x <= zeta2)), np.flatnonzero(ends & (x > zeta2))
    outcome.velocity[early] = 0.0
    for which, regime in ((early, Regime.STICK_SLIP), (late, Regime.SLIP_STICK_SLIP)):
        outcome.peak_friction[which] = outcome.dissipation[which] = 0.0
        outcome.regime[which] = regime
    outcome.regime[x == 0] = Regime.STICK
    stick = _stick_from_contact(elements.take(early), x[early])
    slip = _slip_from_contact(elements.take(late), x[late])
    stopped, after = _slide(late, slip, outcome, trace)
    which = np.concatenate([early, stopped])
    fields = (np.concatenate(both) for both in zip(stick[1:], after[1:], strict=True))
    _alternate(which, Stick(elements.take(which), *fields), outcome, trace)
    # Rounding must not create energy.
    np.minimum(np.maximum(outcome.velocity, -x), x, out=outcome.velocity)
    np.maximum(outcome.dissipation, 0.0, out=outcome.dissipation)
    np.minimum(outcome.peak_friction, 1.0, out=outcome.peak_friction)
    return outcome


def _stick_from_contact(elements: Elements, x: Array) -> Stick:
    friction = 2 * elements.xi * x / elements.zeta2
    return Stick(elements, elements.contact(), np.ones_like(x), friction, x)


def _slip_from_contact(elements: Elements, x: Array) -> Slip:
    constant, transient = x - elements.beta, np.zeros_like(x)
    return Slip(elements, elements.contact(), np.ones_like(x), x, constant, transient)


def _alternate(which: Integers, stick: Stick, outcome: Outcome, trace: Trace | None) -> None:
    """Stick and slip in turn until every impact slides to separation; adds to the outcome.

    A stick that follows slip lasts at least to the next zero of T, or its slip to separation. So
    there are no more sticks than half-waves of T, and two.
    """
    for _ in range(MOST_STICKS):
        if not which.size:
            return
        slip = _stick(which, stick, outcome, trace)
        which, stick = _slide(which, slip, outcome, trace)
        outcome.regime[which] = Regime.MULTIPLE
    raise ConvergenceError(f"{which.size} impacts stick more often than they can")


def _stick(which: Integers, stick: Stick, outcome: Outcome, trace: Trace | None) -> Slip:
    """The slip after a stick; raises the peak of friction to that of the stick."""
    elements = stick.elements
    end, sign = phase_end(stick)
    if trace is not None:
        trace.append((stick, end))
    friction, velocity = stick.tangential(end)
    # The first crest of |T| is the highest.
    crest, _ = stick.tangential(np.minimum(stick.first_crest(), end))
    highest = np.maximum(np.maximum(np.abs(crest), np.abs(friction)), stick.friction)
    largest_force, _ = elements.motion(elements.shifted_zero(1))
    outcome.peak_friction[which] = np.maximum(outcome.peak_friction[which], highest / largest_force)
    # From now on mirrored to direction +1.
    velocity = velocity * sign
    _, v = elements.motion(end)
    constant, transient = velocity - elements.beta * v, elements.zeta2 * v - velocity
    return Slip(elements, end, stick.side * sign, velocity, constant, transient)


def _slide(
    which: Integers, slip: Slip, outcome: Outcome, trace: Trace | None
) -> tuple[Integers, Stick]:
    """The impacts whose slip stops, and their stick; adds the slip to the outcome."""
    elements, tau = slip.elements, 2 * slip.elements.xi
    end, _ = phase_end(slip)
    if trace is not None:
        trace.append((slip, end))
    (force, v), (force_end, v_end) = (elements.motion(time) for time in (slip.start, end))
    # The normal impulse, and the work of friction as the head of this module has it.
    span, decay, impulse = end - slip.start, slip.decay(end), v - v_end
    short = np.flatnonzero(span * np.maximum(tau, 1.0) < SHORT)
    impulse[short], brief = _by_quadrature(take(slip, short), span[short])
    weighted = tau * (force - force_end * decay) + tau * tau * (v - v_end * decay)
    mean = slip.constant + (elements.beta - elements.zeta2) * (v + v_end) / 2
    work = impulse * mean + slip.transient * weighted / (1 + 2 * tau * tau)
    work[short] = np.where(span[short] < SHORT * tau[short], brief, work[short])
    outcome.dissipation[which] += work
    velocity = slip.velocity - elements.beta * impulse
    outcome.velocity[which] = slip.side * velocity
    crest = elements.shifted_zero(1)
    outcome.peak_friction[which[(slip.start <= crest) & (crest <= end)]] = 1.0
    stops = np.flatnonzero(end < 0)
    stick = Stick(elements, end, slip.side, force_end, velocity)
    return which[stops], take(stick, stops)


def _by_quadrature(slip: Slip, span: Array) -> tuple[Array, Array]:
    """Normal impulse and work of friction of short slips."""
    time = slip.start + span * (1 + NODES) / 2
    force, v = slip.elements.motion(time)
    steps = WEIGHTS / 2 * span * force
    return steps.sum(axis=0), (steps * slip.slip_velocity(v, time)).sum(axis=0)
