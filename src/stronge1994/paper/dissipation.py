"""Frictional dissipation, pp. 447 to 449: Eqs 36 to 41, and what is said of the energy lost.

Distances of Eqs 38 to 41 are over m1 v1(0)^2/2, the tangential kinetic energy at first.
"""

from itertools import product
from typing import Any

import numpy as np

from planarimpact import lumped, rigid
from planarimpact.common.arrays import ArrayLike, Numbers
from stronge1994.paper import contact
from stronge1994.paper.contact import Contact, Gaps, NormalMotion
from stronge1994.paper.dynamics import PLATE
from stronge1994.paper.entry import entry
from stronge1994.paper.introduction import ANGLES, compliance_immaterial, dissipated
from stronge1994.paper.slip import strain_decreases
from stronge1994.printed import equations
from stronge1994.printed import impact as as_printed


@entry(
    "formula-kinetic-energy",
    "p. 447, formula at the foot of the page, before Eq. 36",
    r"The kinetic energy at first is $K_0$ $= (M/2) [v_1^2 + v_2^2 - 2 x_2 v_1 \phi' + (x_2^2 + "
    r"k^2) \phi'^2]$",
    at=lambda: (0.0, 1.9, -0.4),
    reading=r"The factor 1/2 is lost in the scan, but Eqs 37 to 41 ask for it. The spin $\phi'$ is "
    "read as positive clockwise, which the sign of the third term asks for",
)
def kinetic_energy(clockwise: float) -> Gaps:
    """$K_0$ over the kinetic energy of a rigid body, less 1, without spin and with it."""
    mass, gyration, x2, v1, v2 = PLATE["mass"], PLATE["gyration"], PLATE["x2"], -0.8, -1.3
    # Velocity of the centre: that of C less that from rotation, v = V + spin x r.
    centre = v1 - clockwise * x2, v2
    exact = mass * (centre[0] ** 2 + centre[1] ** 2 + (gyration * clockwise) ** 2) / 2
    printed = v1**2 + v2**2 - 2 * x2 * v1 * clockwise + (x2**2 + gyration**2) * clockwise**2
    yield mass / 2 * printed / exact - 1


def friction_takes(angle: float) -> tuple[str, str]:
    """Energy that friction dissipates in Fig. 9 as printed, and by the model; mu = 0.5, e = 1."""
    mu, theta = 0.5, np.radians(angle)
    impact, share = (np.tan(theta) / mu, *contact.SPHERE, 1.0), 2 * (mu * np.cos(theta)) ** 2
    printed, own = as_printed.rebound(*impact)[2][0], float(lumped.rebound(*impact).dissipation)
    return f"{share * printed:.2g} m2 S^2/2", f"{share * own:.2g} m2 S^2/2"


# What Eqs 38 and 39 change: one is the integral of the other. At 30 deg the contact sticks first.
AFTER_STICK: dict[str, Any] = {
    "quantity": "Eqs 38, 39: energy, 30 deg, mu 0.5, e 1",
    "values": lambda _: friction_takes(30.0),
}


def _normal(impact: Contact) -> float:
    """Normal kinetic energy m2 v2(0)^2/2."""
    return impact.m2 * impact.v2**2 / 2


@entry(
    "eq-36",
    "p. 448, Eq. 36",
    "The normal element loses $(1 - e^2) m_2 v_2(0)^2/2$",
    at=contact.normal_motions,
    reading="The last factor 1/2 is lost in the scan. Eq. 37 asks for it",
)
@entry(
    "eq-37",
    "p. 448, Eq. 37",
    "The loss in the normal element, over $M v_2(0)^2/2$, is $1 - e^2$",
    at=contact.normal_motions,
    holds="Eq. 37 is right as a share of the normal kinetic energy. The sentence before it speaks "
    "of the whole initial kinetic energy",
)
def hysteresis(motion: NormalMotion) -> Gaps:
    """Eqs 36 and 37 against the normal kinetic energy that the exact contact loses."""
    kinetic = _normal(motion)
    lost = kinetic - motion.m2 * motion.velocity[-1] ** 2 / 2
    share = 1 - motion.restitution**2
    yield (share * motion.m2 * motion.v2**2 / 2 - lost) / kinetic
    yield share - lost / kinetic


def _tangential(impact: Contact) -> float:
    """Tangential kinetic energy m1 v1(0)^2/2."""
    return impact.m1 * impact.v1**2 / 2


def _exact(impact: Contact) -> float:
    """Exact dissipation by friction, in the paper's units."""
    return float(impact.rebound.dissipation) * impact.m2 * impact.velocity_scale**2


def _gap(impact: Contact, lost: Numbers) -> float:
    """Distance of a dissipation from the exact one, over m1 v1(0)^2/2."""
    return float((lost - _exact(impact)) / _tangential(impact))


def eq_38(c: Contact, impulse_left: Numbers, sign: int) -> Numbers:
    """D1 of the last slip, by v1 = v1(t1) + sign (mu/m1) [p - p(t1)]."""
    return c.friction * impulse_left * (c.v1_t1 + sign * c.friction / c.m1 * impulse_left / 2)


@entry(
    "eq-38",
    "p. 448, Eq. 38",
    "After initial stick friction dissipates minus the integral of $F_1 v_1$ over the last slip",
    at=contact.initial_stick,
    verdict="wrong",
    grade="changes a result",
    cause="strain-energy",
    **AFTER_STICK,
    correction="In Eq. 38 the direction $s$ takes the sign of the last slip, and the tangential "
    r"strain energy at $t_1$, $(\kappa/\zeta^2) u_1(t_1)^2/2$, is added",
    derivation="Friction acts on the particle, which slides with $v_1 + du_1/dt$. So $D_1$ is "
    "minus the integral of $F_1 (v_1 + du_1/dt) dt$. The second part is the integral of "
    r"$-(\kappa/\zeta^2) u_1 du_1$, which is the strain energy at $t_1$ less that at $t_f$, and "
    "that at $t_f$ is 0. The balance of energy says the same: at $t_f$ the springs are empty, so "
    "$m_1 v_1(0)^2/2 - m_1 v_1(t_f)^2/2$ has gone into friction alone.",
    reading=r"Inside the integral the scan shows a plus before $(\mu/m_1) [p - p(t_1)]$. Eq. 13 "
    "with $s = +1$, and Eq. 39, ask for a minus. The sign that comes nearer is judged. The "
    r"verdict does not depend on it: as $v_1(0) \to 0$, either sign is off by nearly all the "
    "energy that friction takes. Why the velocity of sliding of p. 439 is kept here, see "
    "body-velocity-alone",
)
def friction_after_stick(impact: Contact) -> tuple[ArrayLike, float]:
    """Distance of Eq. 38 from the exact energy lost, over $m_1 v_1(0)^2/2$, after initial stick.

    Of the two signs before the impulse, minus and the plus of the scan, the nearer one counts.
    Corrected: the minus, with $s$, and the tangential strain energy at $t_1$.
    """
    printed = [eq_38(impact, impact.impulse_left, sign) for sign in (-1, 1)]
    right = eq_38(impact, impact.slip_direction * impact.impulse_left, -1)
    right += impact.strain_energy(impact.onset)
    return [_gap(impact, lost) for lost in printed], _gap(impact, right)


@entry(
    "eq-39",
    "p. 448, Eq. 39",
    r"$2 D_1/(m_2 v_2(0)^2)$ $= -2 \mu^2 g_1$ $[(v_1(0)/(\mu v_2(0)))\,\cos(\omega t_1) + (m_2/(2 "
    "m_1)) g_1]$",
    at=contact.initial_stick,
    verdict="wrong",
    grade="changes a result",
    cause="strain-energy",
    **AFTER_STICK,
    explorer={"angle": 14, "friction": 0.5, "restitution": 1, "view": "energy"},
    correction=r"In Eq. 39 the product $s g_1$ takes the place of $g_1$, and $\mu^2 "
    r"\zeta^2\,\sin^2(\alpha)$, with $\alpha$ at $t_1$, is added",
    derivation=r"What is added is the strain energy that Eq. 38 leaves out, with $|u_1(t_1)| = \mu "
    r"\zeta^2 F_2(t_1)/\kappa$, over $m_2 v_2(0)^2/2$. The corrected sum is $\mu^2 (m_1/m_2) "
    r"[v_1(0)^2 - v_1(t_f)^2]/(\mu v_2(0))^2$.",
    holds=r"No range was found where Eq. 39 is right. At $e = 1$ it is negative for $v_1(0)/(\mu "
    "v_2(0)) < 1.0$",
    reading="The first sign, and $g_1$ in the second term, are lost in the scan. Eq. 38 gives the "
    "minus and the $g_1$. The first sign that comes nearer is judged, and the verdict does not "
    "depend on it. For the velocity of sliding see body-velocity-alone",
)
def friction_after_stick_in_groups(impact: Contact) -> tuple[ArrayLike, float]:
    r"""Distance of Eq. 39 from the exact energy lost, over $m_1 v_1(0)^2/2$, after initial stick.

    With the leading sign that comes nearer. In the corrected formula the sign is minus, $s g_1$
    takes the place of $g_1$, and $\mu^2 \zeta^2\,\sin^2(\alpha)$ at $t_1$ is added.
    """
    half, swing = _normal(impact), np.cos(impact.tangential_frequency * impact.t1)
    lost = impact.printed(equations.eq_39_friction, swing=swing)
    signed = impact.slip_direction * impact.g1
    right = impact.printed(equations.eq_39_friction, swing=swing, g1=signed)
    force = impact.friction * impact.onset.force_2 / impact.force_scale
    right += impact.stiffness_ratio * force**2
    return [_gap(impact, sign * lost * half) for sign in (1, -1)], _gap(impact, right * half)


@entry(
    "eq-40",
    "p. 448, Eq. 40",
    r"$2 D_1/(m_2 v_2(0)^2)$ $= \mu^2 (m_1/m_2)$ $[v_1(0)^2 - v_1(t_2)^2 + v_1(t_3)^2 - "
    r"v_1(t_f)^2]$ $/(\mu v_2(0))^2$",
    at=contact.slip_stick_slip,
    verdict="wrong",
    grade="changes a result",
    cause="strain-energy",
    quantity="Eq. 40: energy, 56 deg, mu 0.5, e 1",
    values=lambda _: friction_takes(56.0),
    explorer={"angle": 45, "friction": 0.5, "restitution": 1, "view": "energy"},
    correction=r"The term $\mu^2 \zeta^2 [F_2(t_3)^2 - F_2(t_2)^2]/(m_2 \Omega v_2(0))^2$ is added "
    "to Eq. 40. The same results if the terms with $v_1(t_2)$ and $v_1(t_3)$ are left out",
    derivation="As in Eq. 38, strain energy is left out, here for both slips. The first slip "
    r"fills the spring with $(\kappa/\zeta^2) u_1(t_2)^2/2$. The second empties it of "
    r"$(\kappa/\zeta^2) u_1(t_3)^2/2$. Stick keeps $m_1 v_1^2/2 + (\kappa/\zeta^2) u_1^2/2$, so "
    r"the corrected sum is $\mu^2 (m_1/m_2) [v_1(0)^2 - v_1(t_f)^2]/(\mu v_2(0))^2$.",
    reading="The signs between the four terms are not legible in the scan, and the last instant "
    "shows as $t_4$. Eq. 38 over both slips asks for the signs and the $t_f$ that are shown here. "
    "The verdict does not depend on them: no other choice of signs comes nearer. For the velocity "
    "of sliding see body-velocity-alone",
)
def friction_of_two_slips(impact: Contact) -> tuple[ArrayLike, float]:
    """Distance of Eq. 40 from the exact energy lost, over $m_1 v_1(0)^2/2$, slip, stick, slip.

    With the signs before $v_1(t_2)^2$, $v_1(t_3)^2$ and $v_1(t_f)^2$ that come nearest. Corrected:
    the signs are minus, plus and minus, strain energy at $t_3$ comes in, and strain energy at $t_2$
    goes out.
    """
    scale = impact.velocity_scale

    def printed(*signs: int) -> float:
        lost = impact.printed(
            equations.eq_40_friction,
            v1_t2=impact.v1_t2 / scale,
            v1_t3=impact.v1_t3 / scale,
            final=impact.final / scale,
            signs=signs,
        )
        return lost * _normal(impact)

    right = (
        printed(-1, 1, -1) + impact.strain_energy(impact.onset) - impact.strain_energy(impact.start)
    )
    readings = [printed(*signs) for signs in product((-1, 1), repeat=3)]
    return [_gap(impact, lost) for lost in readings], _gap(impact, right)


@entry(
    "eq-41",
    "p. 448, Eq. 41",
    r"In slip throughout $2 D_1/(m_2 v_2(0)^2)$ $= 2 \mu^2 (1 + e)$ $[v_1(0)/(\mu v_2(0)) - (1 + "
    "e) m_2/(2 m_1)]$",
    at=contact.slip_throughout,
    holds="Eq. 41 is right in a continuum too if the material yields. If it is viscous, its shear "
    "takes a part of the energy, and friction takes less",
)
def friction_of_slip_throughout(impact: Contact) -> Gaps:
    r"""Eq. 41 against the exact energy lost above $x = (1 + e) \beta$."""
    yield _gap(impact, impact.printed(equations.eq_41_friction) * _normal(impact))


@entry(
    "formula-theorem",
    "p. 448, footnote, both formulas",
    "Over a time $t_a$ to $t_b$ of slip in one direction, friction dissipates minus half its "
    "impulse times the sum of the velocities before and after. In collinear impact this is $-m_1 "
    "[v_1(t_b)^2 - v_1(t_a)^2]/2$",
    at=contact.of_sphere(2.0, 3.0, 4.5),
    verdict="wrong",
    grade="matter of judgement",
    cause="strain-energy",
    correction="Friction dissipates $-m_1 [v_1(t_b)^2 - v_1(t_a)^2]/2$ less the tangential strain "
    "energy gained",
    derivation="The integral of $F_1 v_1 dt = m_1 v_1 dv_1$ is the kinetic energy that the body "
    "gains. While the spring fills, it takes a part of the energy that the body loses, and only "
    "the rest goes into friction; see eq-38.",
    holds="The formula is right without tangential compliance, and where the spring is equally "
    "full at both ends, as over a whole contact",
    reading="No minus is legible before either form, but Eq. 36 asks for one. The footnote is "
    "judged as what friction dissipates, for which Eq. 38 cites it. Read as the energy that $F_1$ "
    "takes from the body it is exact",
)
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
    gap = -(impact.v1_t2 + impact.v1) * impulse / 2 + (on_body + on_spring)
    unit = _tangential(impact)
    return gap / unit, float((gap - impact.strain_energy(impact.start)) / unit)


@entry(
    "friction-only-in-slip",
    "p. 448, Frictional dissipation, 1st sentence",
    "Friction dissipates only while the contact slips",
    at=contact.with_stick,
)
def only_in_slip(impact: Contact) -> Gaps:
    """Work of friction over the phases of slip against the exact balance of energy."""
    gap = lumped.friction_work(*impact.groups) - impact.rebound.dissipation
    yield gap / (impact.incidence**2 / (2 * impact.mass_ratio))


@entry(
    "body-velocity-alone",
    "p. 448, Frictional dissipation, 3rd sentence",
    "What friction dissipates depends on $v_1$ alone, and the total work of the tangential force "
    "on $v_1 + du_1/dt$",
    value=1.0,
    rounding=1e-09,
    verdict="wrong",
    grade="matter of judgement",
    cause="strain-energy",
    correction="Over a time of slip what friction dissipates depends on $v_1 + du_1/dt$. The work "
    "of the tangential force on the body depends on $v_1$",
    derivation="For the derivation see eq-38. With $v_1$ alone friction would give energy back in "
    "the last slip after stick.",
    reading="The sentence is judged over the last slip, as Eq. 38 uses it. Over a whole contact, "
    "stick included, what friction dissipates does follow from $v_1$ alone: $m_1 [v_1(0)^2 - "
    "v_1(t_f)^2]/2$. Here and in Eqs 38 to 40 the velocity of sliding is that of p. 439, $v_1 + "
    "du_1/dt$: the sentence sets it beside $v_1$ and takes $v_1$ for the energy that friction "
    "dissipates, and with $v_1$ that energy does not balance. As the work that $F_1$ takes from "
    "the body over the slips Eqs 38 to 40 are right, Eqs 38 and 39 where $s = +1$. But the paper "
    "means the energy that friction dissipates, and p. 448 says that Fig. 9 shows what Eqs 39 to "
    "41 give for it. In the remark of sliding-slows, from which nothing follows, $v_1$ is granted "
    "as the speed of sliding",
)
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


entry(
    "strain-recovered",
    "p. 448, Frictional dissipation, 4th sentence",
    "The tangential strain energy is given back before separation",
    only_if="$e > 0$",
    holds="This is right for $e > 0$. At $e = 0$ the contact ends with the spring full",
    reading="“Given back” is read as given back by the spring, which is empty at separation. The "
    "body does not get all of it: of what the spring holds at the start of the last slip, the "
    "body gets 85 % at most, and friction takes the rest",
)(strain_decreases)


# Frictions and restitutions of Fig. 9.
OF_FIG_9 = tuple(product((0.1, 0.5), (1.0, 0.5)))


@entry(
    "almost-no-dissipation",
    "p. 448, 3rd sentence after Eq. 41",
    "At small angles, friction dissipates next to nothing where there is tangential compliance",
    at_most=0.01,
    holds="This is right without tangential compliance as well, because at small angles there is "
    "hardly any tangential energy to take",
    reading="The sentence is judged on the axes of Fig. 9. “Next to nothing” is read as less than "
    "0.01 of the whole initial energy, a tenth of the first division. “Small angles” is read as "
    "up to 10°, a third of the first division. Read as an effect of compliance the sentence would "
    r"not stand: at 10° and $\mu = 0.1$, friction takes 0.0083 with compliance and hardly more, "
    "0.0086, without it. At 1 to 5° the ratio of the two is 0.66 to 0.93 for $e = 1$ and 0.46 to "
    "0.57 for $e = 0.5$",
)
def small_incidence() -> float:
    """Largest share of $m_2 S^2/2$ that friction takes up to 10 degrees: the axes of Fig. 9."""
    return float(max(dissipated(*groups)[ANGLES <= 10.0].max() for groups in OF_FIG_9))


entry(
    "dissipation-independent-of-compliance",
    "p. 448, 4th sentence after Eq. 41; p. 449, caption of Fig. 9, last sentence",
    "In gross slip tangential compliance has no effect on the dissipation by friction",
    at=lambda: (0.0, *contact.RESTITUTIONS),
    holds="This is right from $(1 + e) m_2/m_1$ on, the paper's range of gross slip. Between the "
    "corrected limit, see slip-throughout-limit, and $(1 + e) m_2/m_1$ tangential compliance lets "
    "friction take up to 4.4 % less at $e = 1$",
)(compliance_immaterial)


def places_of_most(_: float) -> tuple[str, str]:
    r"""Angle of the printed limit of slip throughout, and of most dissipation; e = 1, mu = 0.1."""
    limit = np.degrees(np.arctan(0.1 * equations.slip_throughout_limit(contact.MASS_RATIO, 1.0)))
    most = ANGLES[dissipated(0.1, 1.0).argmax()]
    return f"just above {limit:.3g} deg", f"at {most:.3g} deg"


@entry(
    "largest-dissipation-angle",
    "p. 448, 5th sentence after Eq. 41",
    "The angle at which friction dissipates most lies just above the one at which gross slip "
    "begins",
    at_most=5.0,
    verdict="wrong",
    grade="changes a result",
    cause="place-of-most-dissipation",
    quantity="friction takes most, mu 0.1, e 1",
    values=places_of_most,
    explorer={"angle": 54.6, "friction": 0.1, "restitution": 1, "view": "energy"},
    correction=r"Friction dissipates most at $\tan(2 \theta) = -2/(\mu (1 + e) m_2/m_1)$. For $\mu "
    "= 0.1$ this is 54.6° at $e = 1$ and 52.4° at $e = 0.5$, while $(1 + e) m_2/m_1$ is at 35.0° "
    r"and 27.7°. For $\mu = 0.5$ it is 75.1° and 71.3°, while $(1 + e) m_2/m_1$ is at 74.1° and "
    "69.1°",
    derivation=r"Eq. 41, for a given speed $S$, is proportional to $\sin(\theta)\,\cos(\theta)$ "
    r"${} - \mu (1 + e) (m_2/m_1)\,\cos^2(\theta)/2$. The derivative of this vanishes where "
    r"$\cos(2 \theta)$ ${} + \mu (1 + e) (m_2/m_1)\,\sin(2 \theta)/2$ $= 0$.",
    holds=r"For $\mu = 0.5$ the sentence is right: the angle is within 2.2° of the paper's limit",
    reading="“Just above” is read as within 5° of the paper's own limit, $(1 + e) m_2/m_1$. The "
    r"sentence is judged for every $\mu$ of Fig. 9, because it names none and a reader would use "
    r"it for any. For $\mu = 0.5$, one of the two, the sentence is true. This is a range where it "
    "holds, not another reading. The grade is as for another angle, see peak-angle-0.18: the "
    "sentence places an angle that is more than 5° off",
)
def angle_of_largest() -> float:
    r"""Largest angle between most dissipation and the printed limit, $(1 + e) \beta$, in degrees.

    Over both frictions and restitutions of Fig. 9.
    """
    gaps = []
    for mu, e in OF_FIG_9:
        limit = np.degrees(np.arctan(mu * equations.slip_throughout_limit(contact.MASS_RATIO, e)))
        gaps.append(ANGLES[dissipated(mu, e).argmax()] - limit)
    return float(max(gaps))


@entry(
    "rigid-dissipation",
    "p. 449, caption of Fig. 9, last sentence but one",
    "Without tangential compliance, and if slip is halted, the dissipation depends neither on "
    r"$\mu$ nor on $e$",
    at=lambda: contact.RESTITUTIONS,
    at_most=0.001,
    reading=r"In the lumped model $\zeta^2 = 10^{-4}$ stands for no tangential compliance",
)
def rigid_independence(e: float) -> Gaps:
    r"""Slip halted: dissipation over $x^2 \mu^2 m_2 v_2(0)^2/(2 \beta)$, less 1, for all $e$.

    Of the rigid limit and of the lumped model with $\zeta^2 = 10^{-4}$, in units where $\mu$
    cancels.
    """
    beta = contact.MASS_RATIO
    x = (1 + e) * beta * np.array([0.1, 0.5, 0.98])
    for lost in (rigid.rebound(x, beta, restitution=e), lumped.rebound(x, beta, contact.HARD, e)):
        yield lost.dissipation / (x**2 / (2 * beta)) - 1


entry(
    "high-speed",
    "p. 448, 7th sentence after Eq. 41, the last before the footnote",
    "Above 50 m/s indentation and heat change the friction force (Sundararajan)",
    verdict="not testable",
    why="Plastic indentation and heat are not modelled",
)
