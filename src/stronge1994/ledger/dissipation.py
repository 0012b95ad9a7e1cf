"""Checks of Eqs 36 to 41, and of what pp. 435 and 447 to 449 say of the energy lost.

Distances of Eqs 38 to 41 are over m1 v1(0)^2/2, the tangential kinetic energy at first.
"""

from itertools import product

import numpy as np

from planarimpact import lumped, rigid
from planarimpact.common.arrays import Array, ArrayLike, Numbers
from stronge1994.ledger import contact
from stronge1994.ledger.contact import Contact, NormalMotion, State
from stronge1994.ledger.dynamics import PLATE
from stronge1994.ledger.finding import Gaps, corrected_over, over
from stronge1994.printed import dissipation, slip

# Frictions and restitutions of Fig. 9.
OF_FIG_9 = tuple(product((0.1, 0.5), (1.0, 0.5)))
ANGLES = np.linspace(0.0, 89.95, 17991)[1:]  # degrees


@over(lambda: (0.0, 1.9, -0.4))
def kinetic_energy(clockwise: float) -> Gaps:
    """$K_0$ over the kinetic energy of a rigid body, less 1, without spin and with it."""
    mass, gyration, x2, v1, v2 = PLATE["mass"], PLATE["gyration"], PLATE["x2"], -0.8, -1.3
    # Velocity of the centre: that of C less that from rotation, v = V + spin x r.
    centre = v1 - clockwise * x2, v2
    exact = mass * (centre[0] ** 2 + centre[1] ** 2 + (gyration * clockwise) ** 2) / 2
    yield dissipation.kinetic_energy(mass, gyration, x2, v1, v2, clockwise) / exact - 1


@over(contact.normal_motions)
def hysteresis(motion: NormalMotion) -> Gaps:
    """Eqs 36 and 37 against the normal kinetic energy that the exact contact loses."""
    kinetic = _normal(motion)
    lost = kinetic - motion.m2 * motion.velocity[-1] ** 2 / 2
    yield (motion.printed(dissipation.eq_36_hysteresis) - lost) / kinetic
    yield motion.printed(dissipation.eq_37_hysteresis_share) - lost / kinetic


def _tangential(impact: Contact) -> float:
    """Tangential kinetic energy m1 v1(0)^2/2."""
    return impact.m1 * impact.v1**2 / 2


def _normal(impact: Contact) -> float:
    """Normal kinetic energy m2 v2(0)^2/2."""
    return impact.m2 * impact.v2**2 / 2


def _exact(impact: Contact) -> float:
    """Exact dissipation by friction, in the paper's units."""
    return float(impact.rebound.dissipation) * impact.m2 * impact.velocity_scale**2


def _gap(impact: Contact, lost: Numbers) -> float:
    """Distance of a dissipation from the exact one, over m1 v1(0)^2/2."""
    return float((lost - _exact(impact)) / _tangential(impact))


def _spring(impact: Contact, state: State) -> Array:
    """Tangential strain energy in a state."""
    return impact.stiffness / impact.stiffness_ratio * state.u1**2 / 2


@corrected_over(contact.initial_stick)
def friction_after_stick(impact: Contact) -> tuple[ArrayLike, float]:
    """Distance of Eq. 38 from the exact energy lost, over $m_1 v_1(0)^2/2$, after initial stick.

    Of the two signs before the impulse, minus and the plus of the scan, the nearer one counts.
    Corrected: the minus, with $s$, and the tangential strain energy at $t_1$.
    """
    printed = [impact.printed(dissipation.eq_38_friction, sign=sign) for sign in (-1, 1)]
    left = impact.slip_direction * impact.impulse_left
    right = impact.printed(dissipation.eq_38_friction, impulse_left=left, sign=-1)
    right += _spring(impact, impact.onset)
    return [_gap(impact, lost) for lost in printed], _gap(impact, right)


@corrected_over(contact.initial_stick)
def friction_after_stick_in_groups(impact: Contact) -> tuple[ArrayLike, float]:
    r"""Distance of Eq. 39 from the exact energy lost, over $m_1 v_1(0)^2/2$, after initial stick.

    With the leading sign that comes nearer. In the corrected formula the sign is minus, $s g_1$
    takes the place of $g_1$, and $\mu^2 \zeta^2\,\sin^2(\alpha)$ at $t_1$ is added.
    """
    half, swing = _normal(impact), np.cos(impact.tangential_frequency * impact.t1)
    lost = impact.printed(dissipation.eq_39_friction, swing=swing)
    signed = impact.slip_direction * impact.g1
    right = impact.printed(dissipation.eq_39_friction, swing=swing, g1=signed)
    force = impact.friction * impact.onset.force_2 / impact.force_scale
    right += impact.stiffness_ratio * force**2
    return [_gap(impact, sign * lost * half) for sign in (1, -1)], _gap(impact, right * half)


@corrected_over(contact.slip_stick_slip)
def friction_of_two_slips(impact: Contact) -> tuple[ArrayLike, float]:
    """Distance of Eq. 40 from the exact energy lost, over $m_1 v_1(0)^2/2$, slip, stick, slip.

    With the signs before $v_1(t_2)^2$, $v_1(t_3)^2$ and $v_1(t_f)^2$ that come nearest. Corrected:
    the signs are minus, plus and minus, strain energy at $t_3$ comes in, and strain energy at $t_2$
    goes out.
    """
    scale = impact.velocity_scale

    def printed(*signs: int) -> float:
        lost = impact.printed(
            dissipation.eq_40_friction,
            v1_t2=impact.v1_t2 / scale,
            v1_t3=impact.v1_t3 / scale,
            final=impact.final / scale,
            signs=signs,
        )
        return lost * _normal(impact)

    right = printed(-1, 1, -1) + _spring(impact, impact.onset) - _spring(impact, impact.start)
    readings = [printed(*signs) for signs in product((-1, 1), repeat=3)]
    return [_gap(impact, lost) for lost in readings], _gap(impact, right)


@over(contact.slip_throughout)
def friction_of_slip_throughout(impact: Contact) -> Gaps:
    r"""Eq. 41 against the exact energy lost above $x = (1 + e) \beta$."""
    yield _gap(impact, impact.printed(dissipation.eq_41_friction) * _normal(impact))


@corrected_over(contact.of_sphere(2.0, 3.0, 4.5))
def theorem(impact: Contact) -> tuple[ArrayLike, float]:
    """The footnote's $D_1$ of the first slip less the work of friction on the particle.

    Over $m_1 v_1(0)^2/2$, the work by quadrature along exact contacts. Corrected: less the
    tangential strain energy gained.
    """
    path, first = impact.path, impact.path.t <= impact.t2
    on_body = impact.integral(path.force_1 * path.v1)[first][-1]
    # F1 is proportional to u1, so the trapezoidal rule is exact.
    on_spring = np.trapezoid(path.force_1[first], path.u1[first])
    impulse = impact.m1 * (impact.v1_t2 - impact.v1)
    gap = dissipation.footnote_theorem(impact.v1, impact.v1_t2, impulse) + (on_body + on_spring)
    unit = _tangential(impact)
    return gap / unit, float((gap - _spring(impact, impact.start)) / unit)


@over(contact.with_stick)
def only_in_slip(impact: Contact) -> Gaps:
    """Work of friction over the phases of slip against the exact balance of energy."""
    gap = lumped.friction_work(*impact.groups) - impact.rebound.dissipation
    yield gap / (impact.incidence**2 / (2 * impact.mass_ratio))


def body_velocity_alone() -> float:
    """Work of friction with $v_1$ alone over the last slip, over that with $v_1 + du_1/dt$.

    The lowest ratio of those sampled over initial stick, sphere of the paper, $e = 1$; the sentence
    has it 1.
    """
    ratios = []
    for share in (0.02, 0.2, 0.4, 0.6, 0.8, 0.99):
        impact = Contact(share * contact.STIFFNESS_RATIO)
        change = impact.m1 * (impact.v1_t1**2 - impact.final**2) / 2
        ratios.append(change / _exact(impact))
    return float(min(ratios))


def strain_decreases() -> float:
    """Largest rise of either element's strain energy during the last slip, or what is left of it.

    Over its value at the onset; the largest of those sampled that stick, $e > 0$.
    """
    rises = []
    for impact in contact.with_stick():
        path = impact.between(impact.t3, impact.end.t)
        # Energy of the normal element, with the stiffness kappa/e^2 of restitution.
        normal = impact.restitution**2 * path.force_2**2 / (2 * impact.stiffness)
        for energy in (_spring(impact, path), normal):
            rises += [np.diff(energy).max() / energy[0], energy[-1] / energy[0]]
    return float(max(rises))


@over(lambda: contact.RESTITUTIONS)
def losses_decoupled(e: float) -> Gaps:
    r"""Spread of the hysteresis over $m_2 v_2(0)^2/2$ with incidence and $\zeta^2$."""
    shares = []
    for x, zeta2 in ((0.3, 1.21), (2.0, 1.21), (8.0, 1.21), (2.0, 0.5)):
        motion = NormalMotion(x, contact.MASS_RATIO, zeta2, e, samples=2001)
        shares.append(-motion.work[-1] / _normal(motion))
    yield np.ptp(shares)


@over(lambda: (0.0, *contact.RESTITUTIONS))
def compliance_immaterial(e: float) -> Gaps:
    r"""What tangential compliance changes in velocity and dissipation above $x = (1 + e) \beta$."""
    x = slip.slip_throughout_limit(contact.MASS_RATIO, e) * np.array([1.0, 1.1, 3.0])
    soft = lumped.rebound(x, *contact.SPHERE, e)
    hard = rigid.rebound(x, contact.MASS_RATIO, restitution=e)
    yield soft.velocity - hard.velocity
    yield soft.dissipation / hard.dissipation - 1


def _dissipated(friction: float, restitution: float) -> Array:
    """Share of m2 S^2/2 that friction takes at each of ANGLES."""
    theta = np.radians(ANGLES)
    lost = lumped.rebound(np.tan(theta) / friction, *contact.SPHERE, restitution).dissipation
    return 2 * (friction * np.cos(theta)) ** 2 * lost


def small_incidence() -> float:
    """Largest share of $m_2 S^2/2$ that friction takes up to 10 degrees: the axes of Fig. 9."""
    return float(max(_dissipated(*groups)[ANGLES <= 10.0].max() for groups in OF_FIG_9))


def angle_of_largest() -> float:
    r"""Largest angle between most dissipation and the printed limit, $(1 + e) \beta$, in degrees.

    Over both frictions and restitutions of Fig. 9.
    """
    gaps = []
    for mu, e in OF_FIG_9:
        limit = np.degrees(np.arctan(mu * slip.slip_throughout_limit(contact.MASS_RATIO, e)))
        gaps.append(ANGLES[_dissipated(mu, e).argmax()] - limit)
    return float(max(gaps))


def limited_by_restitution() -> float:
    """Smallest gain of the largest share dissipated from one $e$ to the next larger."""
    shares = [
        [_dissipated(mu, e).max() for e in np.linspace(0, 1, 11)] for mu in (0.1, 0.3, 0.5, 1.0)
    ]
    return float(np.min(np.diff(shares, axis=1)))


@over(lambda: contact.RESTITUTIONS)
def rigid_independence(e: float) -> Gaps:
    r"""Slip halted: dissipation over $x^2 \mu^2 m_2 v_2(0)^2/(2 \beta)$, less 1, for all $e$.

    Of the rigid limit and of the lumped model with $\zeta^2 = 10^{-4}$, in units where $\mu$
    cancels.
    """
    beta = contact.MASS_RATIO
    x = (1 + e) * beta * np.array([0.1, 0.5, 0.98])
    for lost in (rigid.rebound(x, beta, restitution=e), lumped.rebound(x, beta, contact.HARD, e)):
        yield lost.dissipation / (x**2 / (2 * beta)) - 1
