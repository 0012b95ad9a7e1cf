"""Impacts of two Kelvin-Voigt elements with e < 1, which `phases.viscous` follows.

Errors do not grow: any two solutions approach each other in w^2/(2 beta) + s^2/(2 zeta^2). An event
misplaced by epsilon moves the result by the order of epsilon^2.
"""

import numpy as np

from planarimpact.common import checks, sliding
from planarimpact.common.arrays import Integers
from planarimpact.common.checks import ConvergenceError
from planarimpact.common.results import EventKind, History, Regime
from planarimpact.lumped.stick_slip import Impacts, Outcome
from planarimpact.phases import MOST_STEPS, Step, follow
from planarimpact.phases.runs import runs
from planarimpact.phases.viscous import S, U, V, Viscous, W, damping

# The range of the solver, besides that of the loss: elements this stiff, or heavy, take many steps.
LARGEST_MASS_RATIO = 1e6
LEAST_SHARE, LARGEST_SHARE = 1e-2, 1e6  # of the stiffness ratio in the mass ratio


def check_range(impacts: Impacts, least_restitution: float) -> None:
    """Refuse impacts beyond the range of this solver."""
    _, beta, zeta2, e = impacts
    share = f"{LEAST_SHARE:g} to {LARGEST_SHARE:g} times the mass ratio"
    beyond = (zeta2 < LEAST_SHARE * beta) | (zeta2 > LARGEST_SHARE * beta)
    least = f"numbers from {least_restitution:g} to 1"
    rules = [
        ("restitution", e, e < least_restitution, least),
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
    x, beta, zeta2, e = impacts
    outcome = Outcome(
        sliding.velocity(x, beta, e),
        np.ones_like(x),
        sliding.viscous_work(x, beta, zeta2, e),
        np.full(x.shape, Regime.SLIP_THROUGHOUT, np.uint8),
    )
    sticks = np.flatnonzero(x < sliding.limit_alike(beta, zeta2, e))
    if sticks.size:
        tau, largest_force = damping(e[sticks])
        # Tangential velocities and deflections scale with the mass ratio.
        x_own, unit = x[sticks], beta[sticks]
        contacts = Viscous(x_own / unit, np.ones_like(tau), zeta2[sticks] / unit, tau)
        refuse_endless(follow(contacts, contacts.z))
        outcome.velocity[sticks] = unit * contacts.z[-1]
        outcome.peak_friction[sticks] = contacts.peak_friction / largest_force
        outcome.dissipation[sticks] = unit * contacts.work
        # What is known of the order holds however short a first or last phase is.
        count = np.maximum(contacts.order.sticks, 1)
        regime = Regime.of_phases(count, x_own > zeta2[sticks], True)
        outcome.regime[sticks] = np.where(x_own == 0, Regime.STICK, regime)
    # Rounding must not create energy.
    np.minimum(np.maximum(outcome.velocity, -x), x, out=outcome.velocity)
    np.maximum(outcome.dissipation, 0.0, out=outcome.dissipation)
    np.minimum(outcome.peak_friction, 1.0, out=outcome.peak_friction)
    return outcome


def history(mirror: float, impact: Impacts, samples: int) -> History:
    """History of one contact with e < 1; `mirror` is the sign of x."""
    x, beta, zeta2, e = impact
    tau, _ = damping(e)
    contact = Viscous(x, beta, zeta2, tau)
    steps: list[Step] = []
    refuse_endless(follow(contact, contact.z, steps=steps))
    # The middle of the contact is where compression is largest.
    found = runs(steps, np.union1d(np.linspace(0.0, 1.0, samples), 0.5), lambda _: 1.0)
    half = found[-1].time[-1] / 2
    columns, events = [], []
    for side, time, z in found:
        normal = z[U] + tau * z[V]
        friction, spring = side * normal, side * zeta2 * z[U] + z[S]
        if not side:
            friction = (spring + tau * z[W]) / zeta2
        tangential = (mirror * field for field in (friction, z[W], spring))
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


def refuse_endless(given_up: Integers) -> None:
    """Say that contacts do not come to an end, if `phases.follow` has given up some."""
    if given_up.size:
        raise ConvergenceError(f"{given_up.size} contacts do not end in {MOST_STEPS} steps")
