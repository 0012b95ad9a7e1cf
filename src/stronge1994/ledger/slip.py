"""Checks of Eqs 10 to 27: when stick and slip begin, and the velocity at separation."""

from itertools import product

import numpy as np

from planarimpact import lumped
from planarimpact.ground.arrays import Array, ArrayLike, Numbers
from planarimpact.ground.results import EventKind, Regime
from stronge1994.ledger import contact
from stronge1994.ledger.contact import Contact, boundary
from stronge1994.ledger.finding import Gaps, corrected_over, over
from stronge1994.printed import slip


@over(contact.initial_stick)
def force_ratio(impact: Contact) -> Gaps:
    """Eqs 10a and 10b at the exact onset of slip: |F1| = mu F2, and less before."""
    onset, e = impact.onset, impact.restitution
    groups = impact.incidence, impact.stiffness_ratio, impact.normal_frequency
    omega = impact.tangential_frequency
    t = impact.between(0.0, onset.t).t[1:-1]
    early = t <= impact.compression_time
    yield np.maximum(slip.eq_10a_force_ratio(t[early], *groups, omega) - 1, 0)
    yield np.maximum(slip.eq_10b_force_ratio(t[~early], *groups, omega, e) - 1, 0)
    reached = np.abs(onset.force_1) / (impact.friction * onset.force_2)
    yield slip.eq_10b_force_ratio(onset.t, *groups, omega, e) / reached - 1


@over(lambda: contact.PAIRS)
def initial_stick_limit(pair: tuple[float, float]) -> Gaps:
    """Eq. 11 against the incidence at which the regime of the solver changes."""
    zeta2 = pair[1]
    limit = boundary(
        lambda x: bool(lumped.rebound(x, *pair).regime == Regime.STICK_SLIP),
        1e-3 * zeta2,
        2 * zeta2,
    )
    yield limit * Contact.friction / slip.eq_11_stick_limit(Contact.friction, zeta2) - 1


@over(contact.initial_stick)
def velocity_at_slip(impact: Contact) -> Gaps:
    """Eq. 12 at the exact onset of slip."""
    onset = impact.onset
    printed = slip.eq_12_velocity_at_slip(impact.v1, impact.tangential_frequency, onset.t)
    yield (printed - onset.v1) / impact.velocity_scale


@over(contact.initial_stick)
def final_velocity(impact: Contact) -> Gaps:
    """Eq. 13 after initial stick, with s as it is at the onset of slip."""
    groups = impact.impulse_left(impact.onset.t), impact.friction, impact.m1
    printed = slip.eq_13_final_velocity(impact.onset.v1, impact.last_slip_direction, *groups)
    yield (printed - impact.final_velocity) / impact.velocity_scale


def _share_left(impact: Contact) -> Array:
    return slip.impulse_ratio(impact.onset.t, impact.normal_frequency, impact.restitution)


@over(contact.initial_stick)
def impulse_left(impact: Contact) -> Gaps:
    """Eq. 14 and g1: the impulse after t1 from the momentum at separation."""
    printed = slip.eq_14_impulse_left(_share_left(impact), impact.m2, impact.v2)
    change = abs(impact.final_velocity - impact.onset.v1) * impact.m1 / impact.friction
    yield (printed - change) / impact.compression_impulse


@over(contact.reversed_after_stick)
def rebound_after_stick(impact: Contact) -> Gaps:
    """Eq. 15 against the exact rebound, where the last slip reverses (s = +1)."""
    scale = impact.velocity_scale
    printed = slip.eq_15_rebound(impact.onset.v1 / scale, _share_left(impact), impact.mass_ratio)
    yield printed - impact.final_velocity / scale


@over(contact.slip_stick_slip)
def velocity_in_slip(impact: Contact) -> Gaps:
    """Eq. 16 along the first slip."""
    path = impact.between(0.0, impact.start.t)
    groups = impact.impulse(path.t), impact.friction, impact.m1
    printed = slip.eq_16_velocity_in_slip(impact.v1, -1, *groups)
    yield (printed - path.v1) / impact.velocity_scale


def _normal_rate(impact: Contact, t: Numbers) -> Array:
    groups = impact.v2, impact.m2, impact.normal_frequency, impact.restitution
    return slip.eq_20_normal_force_rate(t, *groups)


def _stick_rate(impact: Contact, elapsed: Numbers) -> Array:
    start = impact.start
    groups = start.u1, start.v1, impact.m1, impact.tangential_frequency
    return slip.stick_force_rate(elapsed, *groups)


@over(contact.slip_stick_slip)
def transition(impact: Contact) -> Gaps:
    """Eq. 17 where the exact contact starts to stick: both forces have one rate."""
    rates = _stick_rate(impact, 0.0), _normal_rate(impact, impact.start.t)
    scale = impact.friction_scale * impact.normal_frequency
    yield slip.eq_17_excess_rate(*rates, impact.friction) / scale


@over(contact.slip_stick_slip)
def stick_force_rate(impact: Contact) -> Gaps:
    """Formula after Eq. 17: its integral over the stick is the change of the exact force."""
    start, end = impact.start, impact.onset
    nodes, weights = np.polynomial.legendre.leggauss(20)
    half = (end.t - start.t) / 2
    change = half * float(weights @ _stick_rate(impact, half * (1 + nodes)))
    yield (change - (end.force_1 - start.force_1)) / impact.force_scale


def _starts_late(impact: Contact) -> bool:
    return bool(impact.start.t > impact.compression_time)


@over(contact.slip_stick_slip)
def deflection_at_stick(impact: Contact) -> Gaps:
    """Eqs 18a and 18b at the exact start of stick."""
    frequencies = impact.normal_frequency, impact.tangential_frequency
    groups = impact.start.t, impact.v2, impact.friction, impact.m1, impact.m2, *frequencies
    if _starts_late(impact):
        printed = slip.eq_18b_deflection(*groups, impact.restitution)
    else:
        printed = slip.eq_18a_deflection(*groups)
    yield (printed - impact.start.u1) * impact.normal_frequency / impact.velocity_scale


@over(contact.slip_stick_slip)
def velocity_at_stick(impact: Contact) -> Gaps:
    """Eqs 19a and 19b at the exact start of stick."""
    masses = impact.friction, impact.mass_ratio
    groups = impact.start.t, impact.v1, impact.v2, *masses, impact.normal_frequency
    if _starts_late(impact):
        printed = slip.eq_19b_velocity(*groups, impact.restitution)
    else:
        printed = slip.eq_19a_velocity(*groups)
    yield (printed - impact.start.v1) / impact.velocity_scale


@over(contact.slip_stick_slip)
def normal_force_rate(impact: Contact) -> Gaps:
    """Eq. 20: its integral over each half is the change of the exact normal force."""
    nodes, weights = np.polynomial.legendre.leggauss(20)
    kinks = impact.first(EventKind.CONTACT), impact.top, impact.end
    for start, end in zip(kinks, kinks[1:], strict=False):
        half = (end.t - start.t) / 2
        change = half * float(weights @ _normal_rate(impact, start.t + half * (1 + nodes)))
        yield (change - (end.force_2 - start.force_2)) / impact.force_scale


@over(contact.slip_stick_slip)
def end_of_first_slip(impact: Contact) -> Gaps:
    """Eq. 21 at the exact start of stick gives the incidence back."""
    groups = impact.mass_ratio, impact.stiffness_ratio, impact.normal_frequency
    x = slip.eq_21_incidence(impact.start.t, *groups, impact.restitution)
    yield x / impact.incidence - 1


@over(contact.slip_stick_slip)
def second_stick(impact: Contact) -> Gaps:
    """Eqs 22a and 22b along the stick of the exact contact."""
    start, path, omega = impact.start, impact.stick, impact.tangential_frequency
    elapsed, initial = path.t - start.t, (start.u1, start.v1)
    velocity = slip.eq_22a_velocity(elapsed, *initial, omega)
    force = slip.eq_22b_force(elapsed, *initial, impact.m1, omega)
    yield (velocity - path.v1) / impact.velocity_scale
    yield (force - path.force_1) / impact.friction_scale


@over(contact.reversed_after_slip)
def onset_of_second_slip(impact: Contact) -> Gaps:
    """Eq. 23 at the exact onset of the last slip, where that reverses (s = +1)."""
    start, groups = impact.start, (impact.v2, impact.friction, impact.stiffness_ratio)
    frequencies = impact.normal_frequency, impact.tangential_frequency
    left, right = slip.eq_23_sides(
        impact.onset.t, start.t, start.u1, start.v1, *groups, *frequencies, impact.restitution
    )
    yield left - right


@over(contact.reversed_after_slip)
def final_velocity_after_second_slip(impact: Contact) -> Gaps:
    """Eq. 24 against the exact rebound, where the last slip reverses (s = +1)."""
    groups = impact.impulse_left(impact.onset.t), impact.friction, impact.m1
    printed = slip.eq_24_final_velocity(impact.onset.v1, *groups)
    yield (printed - impact.final_velocity) / impact.velocity_scale


@over(contact.reversed_after_slip)
def rebound_after_second_slip(impact: Contact) -> Gaps:
    """Eq. 25 against the exact rebound, where the last slip reverses (s = +1)."""
    onset, scale = impact.onset, impact.velocity_scale
    share = impact.impulse(onset.t) / impact.compression_impulse
    groups = share, impact.mass_ratio, impact.restitution
    yield slip.eq_25_rebound(onset.v1 / scale, *groups) - impact.final_velocity / scale


@over(contact.of_sphere(1.3, 2.0, 3.0, 4.5))
def slid_after_first_slip(impact: Contact) -> Gaps:
    """Largest way that the particle slides in the phase that begins at t2, over its deflection.

    The particle moves with v1 + du1/dt; by quadrature along sampled contacts of slip, stick, slip.
    """
    way = impact.integral(impact.path.v1) + impact.path.u1
    inside = (impact.path.t >= impact.start.t) & (impact.path.t <= impact.onset.t)
    yield (way[inside] - way[inside][0]) / impact.start.u1


@over(contact.slip_throughout)
def rebound_after_slip_throughout(impact: Contact) -> Gaps:
    """Eqs 26 and 27 against the exact rebound above x = (1 + e) beta."""
    scale, e = impact.velocity_scale, impact.restitution
    groups = impact.compression_impulse, impact.friction, impact.m1, e
    yield (slip.eq_26_final_velocity(impact.v1, *groups) - impact.final_velocity) / scale
    ratio = slip.eq_27_rebound(impact.incidence, impact.mass_ratio, e)
    yield ratio - impact.final_velocity / scale


def _slips_throughout_from(mass_ratio: float, stiffness_ratio: float, restitution: float) -> float:
    """Incidence from which the solver never sticks, by bisection of its regimes.

    >>> round(_slips_throughout_from(3.5, 1.21, 1.0), 9)
    5.79
    """

    def sticks(x: float) -> bool:
        rebound = lumped.rebound(x, mass_ratio, stiffness_ratio, restitution)
        return rebound.regime != Regime.SLIP_THROUGHOUT

    return boundary(sticks, 0.0, 4 * mass_ratio)


@corrected_over(lambda: product(contact.PAIRS, (0.0, *contact.RESTITUTIONS)))
def slip_throughout_limit(place: tuple[tuple[float, float], float]) -> tuple[ArrayLike, float]:
    """The printed limit (1 + e) beta less the one found by bisection of regimes, as incidences x.

    Corrected, by Eqs 17 to 20: beta + max(0, e beta - zeta^2/e).
    """
    (beta, zeta2), e = place
    exact = _slips_throughout_from(beta, zeta2, e)
    later = e * beta - zeta2 / e if e else 0.0
    return slip.slip_throughout_limit(beta, e) - exact, beta + max(0.0, later) - exact
