"""Checks of Eqs 10 to 27: when stick and slip begin, and the velocity at separation."""

from collections.abc import Callable
from itertools import product

import numpy as np

from planarimpact import lumped
from planarimpact.common.arrays import Array, ArrayLike
from planarimpact.common.results import Regime
from stronge1994.ledger import contact
from stronge1994.ledger.contact import Contact, State, boundary
from stronge1994.ledger.finding import Gaps, corrected_over, over
from stronge1994.printed import slip


@over(contact.initial_stick)
def force_ratio(impact: Contact) -> Gaps:
    r"""Eqs 10a and 10b at the exact onset of slip: $|F_1| = \mu F_2$, and less before."""
    t = impact.between(0.0, impact.t1).t[1:-1]
    early = t <= impact.compression_time
    yield np.maximum(impact.printed(slip.eq_10a_force_ratio, t1=t[early]) - 1, 0)
    yield np.maximum(impact.printed(slip.eq_10b_force_ratio, t1=t[~early]) - 1, 0)
    reached = np.abs(impact.onset.force_1) / (impact.friction * impact.onset.force_2)
    yield impact.printed(slip.eq_10b_force_ratio) / reached - 1


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
    yield (impact.printed(slip.eq_12_velocity_at_slip) - impact.v1_t1) / impact.velocity_scale


@over(contact.initial_stick)
def final_velocity(impact: Contact) -> Gaps:
    """Eq. 13 after initial stick, with $s$ as it is at the onset of slip."""
    yield (impact.printed(slip.eq_13_final_velocity) - impact.final) / impact.velocity_scale


@over(contact.initial_stick)
def impulse_left(impact: Contact) -> Gaps:
    """Eq. 14 and $g_1$: the impulse after $t_1$ from the momentum at separation."""
    change = abs(impact.final - impact.v1_t1) * impact.m1 / impact.friction
    yield (impact.printed(slip.eq_14_impulse_left) - change) / impact.compression_impulse


@over(contact.reversed_after_stick)
def rebound_after_stick(impact: Contact) -> Gaps:
    """Eq. 15 against the exact rebound, where the last slip reverses ($s = +1$)."""
    scale = impact.velocity_scale
    yield impact.printed(slip.eq_15_rebound, v1_t1=impact.v1_t1 / scale) - impact.final / scale


@over(contact.slip_stick_slip)
def velocity_in_slip(impact: Contact) -> Gaps:
    """Eq. 16 along the first slip."""
    path = impact.between(0.0, impact.t2)
    impulse = impact.impulse(path.t)
    printed = impact.printed(slip.eq_16_velocity_in_slip, impulse=impulse, slip_direction=-1)
    yield (printed - path.v1) / impact.velocity_scale


def _change(rate: Callable[[Array], Array], start: State, end: State) -> float:
    """Integral over time of a rate between two states."""
    nodes, weights = np.polynomial.legendre.leggauss(20)
    half = (end.t - start.t) / 2
    return float(half * (weights @ rate(start.t + half * (1 + nodes))))


@over(contact.slip_stick_slip)
def transition(impact: Contact) -> Gaps:
    """Eq. 17 where the exact contact starts to stick: both forces have one rate."""
    rate_1 = impact.printed(slip.stick_force_rate, elapsed=0.0)
    rate_2 = impact.printed(slip.eq_20_normal_force_rate, t=impact.t2)
    excess = impact.printed(slip.eq_17_excess_rate, force_1_rate=rate_1, force_2_rate=rate_2)
    yield excess / (impact.friction_scale * impact.normal_frequency)


@over(contact.slip_stick_slip)
def stick_force_rate(impact: Contact) -> Gaps:
    """Formula after Eq. 17: its integral over the stick is the change of the exact force."""
    start, end = impact.start, impact.onset
    change = _change(
        lambda t: impact.printed(slip.stick_force_rate, elapsed=t - start.t), start, end
    )
    yield (change - (end.force_1 - start.force_1)) / impact.force_scale


@over(contact.slip_stick_slip)
def deflection_at_stick(impact: Contact) -> Gaps:
    """Eqs 18a and 18b at the exact start of stick."""
    late = impact.t2 > impact.compression_time
    printed = impact.printed(slip.eq_18b_deflection if late else slip.eq_18a_deflection)
    yield (printed - impact.u1_t2) * impact.normal_frequency / impact.velocity_scale


@over(contact.slip_stick_slip)
def velocity_at_stick(impact: Contact) -> Gaps:
    """Eqs 19a and 19b at the exact start of stick."""
    late = impact.t2 > impact.compression_time
    printed = impact.printed(slip.eq_19b_velocity if late else slip.eq_19a_velocity)
    yield (printed - impact.v1_t2) / impact.velocity_scale


@over(contact.slip_stick_slip)
def normal_force_rate(impact: Contact) -> Gaps:
    """Eq. 20: its integral over each half is the change of the exact normal force."""
    kinks = impact.events[0][1], impact.top, impact.end
    for start, end in zip(kinks, kinks[1:], strict=False):
        change = _change(lambda t: impact.printed(slip.eq_20_normal_force_rate, t=t), start, end)
        yield (change - (end.force_2 - start.force_2)) / impact.force_scale


@over(contact.slip_stick_slip)
def end_of_first_slip(impact: Contact) -> Gaps:
    """Eq. 21 at the exact start of stick gives the incidence back."""
    yield impact.printed(slip.eq_21_incidence) / impact.incidence - 1


@over(contact.slip_stick_slip)
def second_stick(impact: Contact) -> Gaps:
    """Eqs 22a and 22b along the stick of the exact contact."""
    path = impact.between(impact.t2, impact.t3)
    elapsed = path.t - impact.t2
    velocity = impact.printed(slip.eq_22a_velocity, elapsed=elapsed)
    force = impact.printed(slip.eq_22b_force, elapsed=elapsed)
    yield (velocity - path.v1) / impact.velocity_scale
    yield (force - path.force_1) / impact.friction_scale


@over(contact.reversed_after_slip)
def onset_of_second_slip(impact: Contact) -> Gaps:
    """Eq. 23 at the exact onset of the last slip, where that reverses ($s = +1$)."""
    left, right = impact.printed(slip.eq_23_sides)
    yield left - right


@over(contact.reversed_after_slip)
def rebound_after_second_slip(impact: Contact) -> Gaps:
    """Eqs 24 and 25 against the exact rebound, where the last slip reverses ($s = +1$)."""
    scale, share = impact.velocity_scale, impact.impulse(impact.t3) / impact.compression_impulse
    yield (impact.printed(slip.eq_24_final_velocity) - impact.final) / scale
    printed = impact.printed(slip.eq_25_rebound, v1_t3=impact.v1_t3 / scale, impulse_share=share)
    yield printed - impact.final / scale


@over(contact.of_sphere(1.3, 2.0, 3.0, 4.5))
def slid_after_first_slip(impact: Contact) -> Gaps:
    """Largest way that the particle slides in the phase that begins at $t_2$, over its deflection.

    The particle moves with $v_1 + du_1/dt$; by quadrature along sampled contacts of slip, stick,
    slip.
    """
    way = impact.integral(impact.path.v1) + impact.path.u1
    inside = (impact.path.t >= impact.t2) & (impact.path.t <= impact.t3)
    yield (way[inside] - way[inside][0]) / impact.u1_t2


@over(contact.slip_throughout)
def rebound_after_slip_throughout(impact: Contact) -> Gaps:
    r"""Eqs 26 and 27 against the exact rebound above $x = (1 + e) \beta$."""
    scale = impact.velocity_scale
    yield (impact.printed(slip.eq_26_final_velocity) - impact.final) / scale
    yield impact.printed(slip.eq_27_rebound) - impact.final / scale


@corrected_over(lambda: product(contact.PAIRS, (0.0, *contact.RESTITUTIONS)))
def slip_throughout_limit(place: tuple[tuple[float, float], float]) -> tuple[ArrayLike, float]:
    r"""The printed limit $(1 + e) \beta$ less the one found by bisection of regimes, in $x$.

    Corrected, by Eqs 17 to 20: $\beta + \mathrm{max}(0, e \beta - \zeta^2/e)$.
    """
    (beta, zeta2), e = place

    def sticks(x: float) -> bool:
        return lumped.rebound(x, beta, zeta2, e).regime != Regime.SLIP_THROUGHOUT

    exact = boundary(sticks, 0.0, 4 * beta)
    later = e * beta - zeta2 / e if e else 0.0
    return slip.slip_throughout_limit(beta, e) - exact, beta + max(0.0, later) - exact
