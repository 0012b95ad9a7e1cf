"""Checks of Eqs 10 to 27: when stick and slip begin, and the velocity at separation."""

from collections.abc import Callable
from functools import partial

import numpy as np

from planarimpact import lumped
from planarimpact.ground.arrays import Array, Numbers
from planarimpact.ground.results import EventKind, Regime
from stronge1994.ledger import contact
from stronge1994.ledger.contact import Contact, State, reversed_last_slip
from stronge1994.ledger.finding import Finding, largest
from stronge1994.printed import slip


def boundary(holds: Callable[[float], bool], low: float, high: float) -> float:
    """Where a property that holds at `low` and not at `high` is lost, by bisection.

    >>> round(boundary(lambda x: x < 2, 0.0, 8.0), 12)
    2.0
    """
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if holds(middle) else (low, middle)
    return low


def slips_throughout_from(mass_ratio: float, stiffness_ratio: float, restitution: float) -> float:
    """Incidence from which the solver never sticks, by bisection of its regimes.

    >>> round(slips_throughout_from(3.5, 1.21, 1.0), 9)
    5.79
    """

    def sticks(x: float) -> bool:
        rebound = lumped.rebound(x, mass_ratio, stiffness_ratio, restitution)
        return rebound.regime != Regime.SLIP_THROUGHOUT

    return boundary(sticks, 0.0, 4 * mass_ratio)


def force_ratio() -> Finding:
    r"""Eqs 10a and 10b at the exact onset of slip: $|F_1| = \mu F_2$, and less before."""
    gaps = []
    for impact in contact.initial_stick():
        onset = impact.last(EventKind.SLIP)
        groups = impact.incidence, impact.stiffness_ratio, impact.normal_frequency
        omega, e = impact.tangential_frequency, impact.restitution
        t = impact.between(0.0, onset.t).t[1:-1]
        early = t <= impact.compression_time
        gaps += [
            np.maximum(slip.eq_10a_force_ratio(t[early], *groups, omega) - 1, 0),
            np.maximum(slip.eq_10b_force_ratio(t[~early], *groups, omega, e) - 1, 0),
        ]
        reached = np.abs(onset.force_1) / (impact.friction * onset.force_2)
        gaps.append(slip.eq_10b_force_ratio(onset.t, *groups, omega, e) / reached - 1)
    return Finding(largest(gaps))


def _sticks_at_first(mass_ratio: float, stiffness_ratio: float, x: float) -> bool:
    return bool(lumped.rebound(x, mass_ratio, stiffness_ratio).regime == Regime.STICK_SLIP)


def initial_stick_limit() -> Finding:
    """Eq. 11 against the incidence at which the regime of the solver changes."""
    gaps = []
    for beta, zeta2 in contact.PAIRS:
        limit = boundary(partial(_sticks_at_first, beta, zeta2), 1e-3 * zeta2, 2 * zeta2)
        printed = slip.eq_11_stick_limit(contact.FRICTION, zeta2)
        gaps.append(limit * contact.FRICTION / printed - 1)
    return Finding(largest(gaps))


def velocity_at_slip() -> Finding:
    """Eq. 12 at the exact onset of slip."""
    gaps = []
    for impact in contact.initial_stick():
        onset = impact.last(EventKind.SLIP)
        printed = slip.eq_12_velocity_at_slip(impact.v1, impact.tangential_frequency, onset.t)
        gaps.append((printed - onset.v1) / impact.velocity_scale)
    return Finding(largest(gaps))


def final_velocity() -> Finding:
    """Eq. 13 after initial stick, with $s$ as it is at the onset of slip."""
    gaps = []
    for impact in contact.initial_stick():
        onset = impact.last(EventKind.SLIP)
        left, direction = impact.impulse_left(onset.t), impact.last_slip_direction
        groups = left, impact.friction, impact.m1
        printed = slip.eq_13_final_velocity(onset.v1, direction, *groups)
        gaps.append((printed - impact.final_velocity) / impact.velocity_scale)
    return Finding(largest(gaps))


def _share_left(impact: Contact, t: Numbers) -> Array:
    return slip.impulse_ratio(t, impact.normal_frequency, impact.restitution)


def impulse_left() -> Finding:
    """Eq. 14 and $g_1$: the impulse after $t_1$ from the momentum at separation."""
    gaps = []
    for impact in contact.initial_stick():
        onset = impact.last(EventKind.SLIP)
        printed = slip.eq_14_impulse_left(_share_left(impact, onset.t), impact.m2, impact.v2)
        change = abs(impact.final_velocity - onset.v1) * impact.m1 / impact.friction
        gaps.append((printed - change) / (impact.m2 * impact.v2))
    return Finding(largest(gaps))


def rebound_after_stick() -> Finding:
    """Eq. 15 against the exact rebound, where the last slip reverses ($s = +1$)."""
    gaps = []
    for impact in reversed_last_slip(contact.initial_stick()):
        onset, scale = impact.last(EventKind.SLIP), impact.velocity_scale
        g1 = _share_left(impact, onset.t)
        printed = slip.eq_15_rebound(onset.v1 / scale, g1, impact.mass_ratio)
        gaps.append(printed - impact.final_velocity / scale)
    return Finding(largest(gaps))


def velocity_in_slip() -> Finding:
    """Eq. 16 along the first slip."""
    gaps = []
    for impact in contact.slip_stick_slip():
        path = impact.between(0.0, impact.first(EventKind.STICK).t)
        groups = impact.impulse(path.t), impact.friction, impact.m1
        printed = slip.eq_16_velocity_in_slip(impact.v1, -1, *groups)
        gaps.append((printed - path.v1) / impact.velocity_scale)
    return Finding(largest(gaps))


def _normal_rate(impact: Contact, t: Numbers) -> Array:
    groups = impact.v2, impact.m2, impact.normal_frequency, impact.restitution
    return slip.eq_20_normal_force_rate(t, *groups)


def transition() -> Finding:
    """Eq. 17 where the exact contact starts to stick: both forces have one rate."""
    gaps = []
    for impact in contact.slip_stick_slip():
        start = impact.first(EventKind.STICK)
        rate_1 = slip.stick_force_rate(
            0.0, start.u1, start.v1, impact.m1, impact.tangential_frequency
        )
        rate_2 = _normal_rate(impact, start.t)
        scale = impact.friction_scale * impact.normal_frequency
        gaps.append(slip.eq_17_excess_rate(rate_1, rate_2, impact.friction) / scale)
    return Finding(largest(gaps))


def stick_force_rate() -> Finding:
    """Formula after Eq. 17: its integral over the stick is the change of the exact force."""
    gaps = []
    nodes, weights = np.polynomial.legendre.leggauss(20)
    for impact in contact.slip_stick_slip():
        start, end = impact.first(EventKind.STICK), impact.last(EventKind.SLIP)
        half = (end.t - start.t) / 2
        rate = slip.stick_force_rate(
            half * (1 + nodes), start.u1, start.v1, impact.m1, impact.tangential_frequency
        )
        change = half * float(weights @ rate)
        gaps.append((change - (end.force_1 - start.force_1)) / impact.force_scale)
    return Finding(largest(gaps))


def _transition_states(
    formula_a: Callable[..., Numbers],
    formula_b: Callable[..., Numbers],
    exact: Callable[[State], Numbers],
    scale: Callable[[Contact], float],
) -> Finding:
    """Distances of two formulas at t2, each in its half, from the exact state there."""
    gaps = []
    for impact in contact.slip_stick_slip():
        start = impact.first(EventKind.STICK)
        late = start.t > impact.compression_time
        printed = (formula_b if late else formula_a)(impact, start.t)
        gaps.append((printed - exact(start)) / scale(impact))
    return Finding(largest(gaps))


def deflection_at_stick() -> Finding:
    """Eqs 18a and 18b at the exact start of stick."""

    def groups(impact: Contact) -> tuple[float, float, float, float, float, float]:
        frequencies = impact.normal_frequency, impact.tangential_frequency
        return impact.v2, impact.friction, impact.m1, impact.m2, *frequencies

    return _transition_states(
        lambda impact, t2: slip.eq_18a_deflection(t2, *groups(impact)),
        lambda impact, t2: slip.eq_18b_deflection(t2, *groups(impact), impact.restitution),
        lambda start: start.u1,
        lambda impact: impact.velocity_scale / impact.normal_frequency,
    )


def velocity_at_stick() -> Finding:
    """Eqs 19a and 19b at the exact start of stick."""

    def groups(impact: Contact) -> tuple[float, float, float, float, float]:
        return impact.v1, impact.v2, impact.friction, impact.mass_ratio, impact.normal_frequency

    return _transition_states(
        lambda impact, t2: slip.eq_19a_velocity(t2, *groups(impact)),
        lambda impact, t2: slip.eq_19b_velocity(t2, *groups(impact), impact.restitution),
        lambda start: start.v1,
        lambda impact: impact.velocity_scale,
    )


def normal_force_rate() -> Finding:
    """Eq. 20: its integral over each half is the change of the exact normal force."""
    gaps = []
    nodes, weights = np.polynomial.legendre.leggauss(20)
    for impact in contact.slip_stick_slip():
        kinks = [0.0, impact.compression_time, (1 + impact.restitution) * impact.compression_time]
        ends = EventKind.CONTACT, EventKind.MAXIMUM_COMPRESSION, EventKind.SEPARATION
        forces = [impact.first(kind).force_2 for kind in ends]
        for start, end, before, after in zip(kinks, kinks[1:], forces, forces[1:], strict=False):
            half = (end - start) / 2
            change = half * float(weights @ _normal_rate(impact, start + half * (1 + nodes)))
            gaps.append((change - (after - before)) / impact.force_scale)
    return Finding(largest(gaps))


def end_of_first_slip() -> Finding:
    """Eq. 21 at the exact start of stick gives the incidence back."""
    gaps = []
    for impact in contact.slip_stick_slip():
        groups = impact.mass_ratio, impact.stiffness_ratio
        rates = impact.normal_frequency, impact.restitution
        t2 = impact.first(EventKind.STICK).t
        gaps.append(slip.eq_21_incidence(t2, *groups, *rates) / impact.incidence - 1)
    return Finding(largest(gaps))


def second_stick() -> Finding:
    """Eqs 22a and 22b along the stick of the exact contact."""
    gaps = []
    for impact in contact.slip_stick_slip():
        start, end = impact.first(EventKind.STICK), impact.last(EventKind.SLIP)
        path, omega = impact.between(start.t, end.t), impact.tangential_frequency
        elapsed, initial = path.t - start.t, (start.u1, start.v1)
        velocity = slip.eq_22a_velocity(elapsed, *initial, omega)
        force = slip.eq_22b_force(elapsed, *initial, impact.m1, omega)
        gaps.append((velocity - path.v1) / impact.velocity_scale)
        gaps.append((force - path.force_1) / impact.friction_scale)
    return Finding(largest(gaps))


def onset_of_second_slip() -> Finding:
    """Eq. 23 at the exact onset of the last slip, where that reverses ($s = +1$)."""
    gaps = []
    for impact in reversed_last_slip(contact.slip_stick_slip()):
        start, onset = impact.first(EventKind.STICK), impact.last(EventKind.SLIP)
        left, right = slip.eq_23_sides(
            onset.t,
            start.t,
            start.u1,
            start.v1,
            impact.v2,
            impact.friction,
            impact.stiffness_ratio,
            impact.normal_frequency,
            impact.tangential_frequency,
            impact.restitution,
        )
        gaps.append(left - right)
    return Finding(largest(gaps))


def final_velocity_after_second_slip() -> Finding:
    """Eq. 24 against the exact rebound, where the last slip reverses ($s = +1$)."""
    gaps = []
    for impact in reversed_last_slip(contact.slip_stick_slip()):
        onset = impact.last(EventKind.SLIP)
        groups = impact.impulse_left(onset.t), impact.friction, impact.m1
        printed = slip.eq_24_final_velocity(onset.v1, *groups)
        gaps.append((printed - impact.final_velocity) / impact.velocity_scale)
    return Finding(largest(gaps))


def rebound_after_second_slip() -> Finding:
    """Eq. 25 against the exact rebound, where the last slip reverses ($s = +1$)."""
    gaps = []
    for impact in reversed_last_slip(contact.slip_stick_slip()):
        onset, scale = impact.last(EventKind.SLIP), impact.velocity_scale
        share = impact.impulse(onset.t) / (-impact.m2 * impact.v2)
        groups = onset.v1 / scale, share, impact.mass_ratio, impact.restitution
        gaps.append(slip.eq_25_rebound(*groups) - impact.final_velocity / scale)
    return Finding(largest(gaps))


def slid_after_first_slip() -> Finding:
    """Largest way that the particle slides in the phase that begins at $t_2$, over its deflection.

    The particle moves with $v_1 + du_1/dt$; by quadrature along sampled contacts of slip, stick,
    slip.
    """
    shares = []
    for x in (1.3, 2.0, 3.0, 4.5):
        impact = contact.contact(x, samples=2001)
        start, end = impact.first(EventKind.STICK), impact.last(EventKind.SLIP)
        inside = (impact.path.t >= start.t) & (impact.path.t <= end.t)
        way = contact.integral(impact, impact.path.v1)[inside] + impact.path.u1[inside]
        shares.append((way - way[0]) / start.u1)
    return Finding(largest(shares))


def rebound_after_slip_throughout() -> Finding:
    r"""Eqs 26 and 27 against the exact rebound above $x = (1 + e) \beta$."""
    gaps = []
    for impact in contact.slip_throughout():
        scale, e = impact.velocity_scale, impact.restitution
        compression = -impact.m2 * impact.v2
        groups = compression, impact.friction, impact.m1, e
        final = slip.eq_26_final_velocity(impact.v1, *groups)
        gaps.append((final - impact.final_velocity) / scale)
        ratio = slip.eq_27_rebound(impact.incidence, impact.mass_ratio, e)
        gaps.append(ratio - impact.final_velocity / scale)
    return Finding(largest(gaps))


def slip_throughout_limit() -> Finding:
    r"""The printed limit $(1 + e) \beta$ less the one found by bisection of regimes, by incidence.

    Corrected, by Eqs 17 to 20: $\beta + \mathrm{max}(0, e \beta - \zeta^2/e)$.
    """
    printed, corrected = [], []
    for beta, zeta2 in contact.PAIRS:
        for e in (0.0, *contact.RESTITUTIONS):
            exact = slips_throughout_from(beta, zeta2, e)
            printed.append(slip.slip_throughout_limit(beta, e) - exact)
            later = e * beta - zeta2 / e if e else 0.0
            corrected.append(beta + max(0.0, later) - exact)
    return Finding(largest(printed), largest(corrected))
