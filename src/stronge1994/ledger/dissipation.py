"""Checks of Eqs 36 to 41, and of what pp. 435 and 447 to 449 say of the energy lost."""

from collections.abc import Iterable, Mapping
from itertools import product
from typing import Any

import numpy as np

from planarimpact import lumped, rigid
from planarimpact.ground.arrays import Array, Numbers
from planarimpact.ground.results import EventKind
from stronge1994.ledger import contact
from stronge1994.ledger.contact import Contact, State
from stronge1994.ledger.dynamics import PLATE
from stronge1994.ledger.finding import Finding, largest
from stronge1994.printed import dissipation, slip

# Parameters of Fig. 9.
FRICTIONS, RESTITUTIONS = (0.1, 0.5), (1.0, 0.5)
ANGLES = np.linspace(0.0, 89.95, 17991)[1:]  # degrees


def kinetic_energy() -> Finding:
    """$K_0$ over the kinetic energy of a rigid body, less 1, without spin and with it."""
    mass, gyration, x2 = PLATE["mass"], PLATE["gyration"], PLATE["x2"]
    v1, v2 = -0.8, -1.3
    ratios = []
    for clockwise in (0.0, 1.9, -0.4):
        # Velocity of the centre: that of C less that from rotation, v = V + spin x r.
        centre = v1 - clockwise * x2, v2
        exact = mass * (centre[0] ** 2 + centre[1] ** 2 + (gyration * clockwise) ** 2) / 2
        ratios.append(dissipation.kinetic_energy(mass, gyration, x2, v1, v2, clockwise) / exact)
    return Finding(largest([np.array(ratios) - 1]))


def hysteresis() -> Finding:
    """Eqs 36 and 37 against the normal kinetic energy that the exact contact loses."""
    gaps = []
    for e, motion in contact.normal_motions():
        impact = motion.impact
        kinetic = impact.m2 * impact.v2**2 / 2
        lost = kinetic - impact.m2 * motion.velocity[-1] ** 2 / 2
        gaps.append((dissipation.eq_36_hysteresis(impact.m2, impact.v2, e) - lost) / kinetic)
        gaps.append(dissipation.eq_37_hysteresis_share(e) - lost / kinetic)
    return Finding(largest(gaps))


def _unit(impact: Contact) -> float:
    """Tangential kinetic energy m1 v1(0)^2/2, in which the gaps are measured."""
    return impact.m1 * impact.v1**2 / 2


def _exact(impact: Contact) -> float:
    """Exact dissipation by friction, in the paper's units."""
    return float(impact.rebound.dissipation) * impact.m2 * impact.velocity_scale**2


def _spring(impact: Contact, state: State) -> Array:
    """Tangential strain energy in a state."""
    return impact.stiffness / impact.stiffness_ratio * state.u1**2 / 2


def friction_after_stick() -> Finding:
    """Distance of Eq. 38 from the exact energy lost, over $m_1 v_1(0)^2/2$, after initial stick.

    Of the two signs before the impulse, minus and the plus of the scan, the nearer one counts.
    Corrected: the minus, with $s$, and the tangential strain energy at $t_1$.
    """
    printed: dict[int, list[Numbers]] = {-1: [], 1: []}
    corrected = []
    for impact in contact.initial_stick():
        onset, s = impact.last(EventKind.SLIP), impact.last_slip_direction
        left, groups = impact.impulse_left(onset.t), (impact.friction, impact.m1)
        for sign, gaps in printed.items():
            lost = dissipation.eq_38_friction(onset.v1, left, *groups, sign)
            gaps.append((lost - _exact(impact)) / _unit(impact))
        lost = dissipation.eq_38_friction(onset.v1, s * left, *groups, -1) + _spring(impact, onset)
        corrected.append((lost - _exact(impact)) / _unit(impact))
    return Finding(_of_best_reading(printed), largest(corrected))


def _of_best_reading(gaps_of_readings: Mapping[Any, Iterable[Numbers]]) -> float:
    """Largest distance under that reading of a formula which comes nearest."""
    return min(largest(gaps) for gaps in gaps_of_readings.values())


def friction_after_stick_in_groups() -> Finding:
    r"""Distance of Eq. 39 from the exact energy lost, over $m_1 v_1(0)^2/2$, after initial stick.

    With the leading sign that comes nearer. In the corrected formula the sign is minus, $s g_1$
    takes the place of $g_1$, and $\mu^2 \zeta^2\,\sin^2(\alpha)$ at $t_1$ is added.
    """
    printed: dict[int, list[Numbers]] = {-1: [], 1: []}
    corrected = []
    for impact in contact.initial_stick():
        onset, normal = impact.last(EventKind.SLIP), impact.m2 * impact.v2**2
        swing = np.cos(impact.tangential_frequency * onset.t)
        g1 = slip.impulse_ratio(onset.t, impact.normal_frequency, impact.restitution)
        groups = impact.mass_ratio, impact.friction
        lost = dissipation.eq_39_friction(impact.incidence, swing, g1, *groups)
        for sign, gaps in printed.items():
            gaps.append((-sign * lost * normal / 2 - _exact(impact)) / _unit(impact))
        signed = impact.last_slip_direction * g1
        lost = dissipation.eq_39_friction(impact.incidence, swing, signed, *groups)
        strain = (
            impact.stiffness_ratio * (impact.friction * onset.force_2 / impact.force_scale) ** 2
        )
        corrected.append(((lost + strain) * normal / 2 - _exact(impact)) / _unit(impact))
    return Finding(_of_best_reading(printed), largest(corrected))


def friction_of_two_slips() -> Finding:
    """Distance of Eq. 40 from the exact energy lost, over $m_1 v_1(0)^2/2$, slip, stick, slip.

    With the signs before $v_1(t_2)^2$, $v_1(t_3)^2$ and $v_1(t_f)^2$ that come nearest. Corrected:
    the signs are minus, plus and minus, strain energy at $t_3$ comes in, and strain energy at $t_2$
    goes out.
    """
    printed: dict[tuple[int, ...], list[Numbers]] = {
        signs: [] for signs in product((-1, 1), repeat=3)
    }
    corrected = []
    for impact in contact.slip_stick_slip():
        scale, unit = impact.velocity_scale, _unit(impact)
        start, onset = impact.first(EventKind.STICK), impact.last(EventKind.SLIP)
        w2, w3, final = start.v1 / scale, onset.v1 / scale, impact.final_velocity / scale
        speeds, groups = (impact.incidence, w2, w3, final), (impact.mass_ratio, impact.friction)
        for signs, gaps in printed.items():
            lost = dissipation.eq_40_friction(*speeds, *groups, signs)
            gaps.append((lost * impact.m2 * impact.v2**2 / 2 - _exact(impact)) / unit)
        strain = _spring(impact, onset) - _spring(impact, start)
        corrected.append(printed[-1, 1, -1][-1] + strain / unit)
    return Finding(_of_best_reading(printed), largest(corrected))


def friction_of_slip_throughout() -> Finding:
    r"""Eq. 41 against the exact energy lost above $x = (1 + e) \beta$."""
    gaps = []
    for impact in contact.slip_throughout():
        groups = impact.incidence, impact.mass_ratio, impact.friction, impact.restitution
        lost = dissipation.eq_41_friction(*groups) * impact.m2 * impact.v2**2 / 2
        gaps.append((lost - _exact(impact)) / _unit(impact))
    return Finding(largest(gaps))


def theorem() -> Finding:
    """The footnote's $D_1$ of the first slip less the work of friction on the particle.

    Over $m_1 v_1(0)^2/2$, the work by quadrature along exact contacts. Corrected: less the
    tangential strain energy gained.
    """
    printed, corrected = [], []
    for x in (2.0, 3.0, 4.5):
        impact = contact.contact(x, samples=2001)
        start = impact.first(EventKind.STICK)
        path, first = impact.path, impact.path.t <= start.t
        on_body = contact.integral(impact, path.force_1 * path.v1)[first][-1]
        # F1 is proportional to u1, so the trapezoidal rule is exact.
        on_spring = np.trapezoid(path.force_1[first], path.u1[first])
        impulse = impact.m1 * (start.v1 - impact.v1)
        lost = dissipation.footnote_theorem(impact.v1, start.v1, impulse)
        exact = -(on_body + on_spring)
        printed.append((lost - exact) / _unit(impact))
        corrected.append((lost - _spring(impact, start) - exact) / _unit(impact))
    return Finding(largest(printed), largest(corrected))


def only_in_slip() -> Finding:
    """Work of friction over the phases of slip against the exact balance of energy."""
    gaps = []
    for impact in contact.with_stick():
        groups = impact.incidence, impact.mass_ratio, impact.stiffness_ratio, impact.restitution
        gap = lumped.friction_work(*groups) - impact.rebound.dissipation
        gaps.append(gap / (impact.incidence**2 / (2 * impact.mass_ratio)))
    return Finding(largest(gaps))


def body_velocity_alone() -> Finding:
    """Work of friction with $v_1$ alone over the last slip, over that with $v_1 + du_1/dt$.

    The lowest ratio of those sampled over initial stick, sphere of the paper, $e = 1$; the sentence
    has it 1.
    """
    ratios = []
    for share in (0.02, 0.2, 0.4, 0.6, 0.8, 0.99):
        impact = contact.contact(share * contact.STIFFNESS_RATIO)
        onset = impact.last(EventKind.SLIP)
        change = impact.m1 * (onset.v1**2 - impact.final_velocity**2) / 2
        ratios.append(change / _exact(impact))
    return Finding(float(min(ratios)))


def strain_recovered() -> Finding:
    """Tangential strain energy at separation over that at the onset of the last slip, $e > 0$."""
    shares = []
    for impact in contact.with_stick():
        onset, end = impact.last(EventKind.SLIP), impact.last(EventKind.SEPARATION)
        shares.append(_spring(impact, end) / _spring(impact, onset))
    return Finding(largest(shares))


def strain_decreases() -> Finding:
    """Largest rise of either element's strain energy during the last slip, or what is left of it.

    Over its value at the onset; the largest of those sampled that slip, stick and slip, $e > 0$.
    """
    rises = []
    for impact in contact.slip_stick_slip():
        onset, end = impact.last(EventKind.SLIP), impact.last(EventKind.SEPARATION)
        path = impact.between(onset.t, end.t)
        # Energy of the normal element, with the stiffness kappa/e^2 of restitution.
        normal = impact.restitution**2 * path.force_2**2 / (2 * impact.stiffness)
        for energy in (_spring(impact, path), normal):
            rises += [np.diff(energy).max() / energy[0], energy[-1] / energy[0]]
    return Finding(float(max(rises)))


def losses_decoupled() -> Finding:
    r"""Spread of the hysteresis over $m_2 v_2(0)^2/2$ with incidence and $\zeta^2$.

    Collinear impact.
    """
    spreads = []
    for e in contact.RESTITUTIONS:
        shares = []
        for x, zeta2 in ((0.3, 1.21), (2.0, 1.21), (8.0, 1.21), (2.0, 0.5)):
            impact = contact.contact(x, contact.MASS_RATIO, zeta2, e, samples=2001)
            impulse = contact.integral(impact, impact.path.force_2)
            work = contact.integral(impact, impact.path.force_2 * (impact.v2 + impulse / impact.m2))
            shares.append(-work[-1] / (impact.m2 * impact.v2**2 / 2))
        spreads.append(np.ptp(shares))
    return Finding(largest(spreads))


def small_incidence() -> Finding:
    """Largest share of $m_2 S^2/2$ that friction takes up to 10 degrees: the axes of Fig. 9."""
    small = ANGLES <= 10.0
    shares = [_dissipated(mu, e)[small].max() for mu in FRICTIONS for e in RESTITUTIONS]
    return Finding(float(max(shares)))


def compliance_immaterial() -> Finding:
    r"""Difference that tangential compliance makes to the dissipation above $x = (1 + e) \beta$."""
    gaps = []
    for e in contact.RESTITUTIONS:
        x = slip.slip_throughout_limit(contact.MASS_RATIO, e) * np.array([1.0, 1.1, 3.0])
        hard = rigid.rebound(x, contact.MASS_RATIO, restitution=e).dissipation
        gaps.append(lumped.rebound(x, *contact.SPHERE, e).dissipation / hard - 1)
    return Finding(largest(gaps))


def _dissipated(friction: float, restitution: float) -> Array:
    """Share of m2 S^2/2 that friction takes at each of ANGLES."""
    theta = np.radians(ANGLES)
    lost = lumped.rebound(np.tan(theta) / friction, *contact.SPHERE, restitution).dissipation
    return 2 * (friction * np.cos(theta)) ** 2 * lost


def angle_of_largest() -> Finding:
    r"""Largest angle between most dissipation and the printed limit, $(1 + e) \beta$, in degrees.

    Over both frictions and restitutions of Fig. 9.
    """
    gaps = []
    for mu in FRICTIONS:
        for e in RESTITUTIONS:
            limit = np.degrees(np.arctan(mu * slip.slip_throughout_limit(contact.MASS_RATIO, e)))
            gaps.append(ANGLES[_dissipated(mu, e).argmax()] - limit)
    return Finding(float(max(gaps)))


def limited_by_restitution() -> Finding:
    """Smallest gain of the largest share dissipated from one $e$ to the next larger."""
    shares = [
        [_dissipated(mu, e).max() for e in np.linspace(0, 1, 11)] for mu in (0.1, 0.3, 0.5, 1.0)
    ]
    return Finding(float(np.min(np.diff(shares, axis=1))))


def rigid_independence() -> Finding:
    r"""Slip halted: dissipation over $x^2 \mu^2 m_2 v_2(0)^2/(2 \beta)$, less 1, for all $e$.

    Of the rigid limit and of the lumped model with $\zeta^2 = 10^{-4}$, in units where $\mu$
    cancels.
    """
    gaps, beta = [], contact.MASS_RATIO
    for e in contact.RESTITUTIONS:
        x = (1 + e) * beta * np.array([0.1, 0.5, 0.98])
        for lost in (
            rigid.rebound(x, beta, restitution=e),
            lumped.rebound(x, beta, 1e-4, e),
        ):
            gaps.append(lost.dissipation / (x**2 / (2 * beta)) - 1)
    return Finding(largest(gaps))
