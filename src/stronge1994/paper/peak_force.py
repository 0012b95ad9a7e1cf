"""Angle of incidence for maximum friction, pp. 444 to 447: Eqs 28 to 35, and what is measured."""

from collections.abc import Callable, Sequence
from itertools import product

import numpy as np

from planarimpact import bodies, lumped, rigid
from planarimpact.common.arrays import Array, ArrayLike, Numbers
from planarimpact.common.results import Rebound, Regime
from stronge1994.judging import landmarks
from stronge1994.paper import contact
from stronge1994.paper.contact import Contact, Gaps, State, boundary, lumped_sphere, rigid_sphere
from stronge1994.paper.entry import entry, largest
from stronge1994.paper.introduction import restitution_immaterial
from stronge1994.printed import equations
from stronge1994.printed.equations import eq_28_normal, eq_33_friction

Model = Callable[[Array], Rebound]

FRICTIONS = (0.1, 0.2, 0.4, 0.6, 0.8, 1.0)  # of Fig. 7
ANGLES = np.linspace(0.0, 89.9, 1799)[1:]  # degrees, 0.05 apart


def _values_of_eq_32(impact: Contact) -> tuple[Array, Array]:
    """Both values of Eq. 32 at the exact start of stick."""
    return impact.printed(equations.eq_32_start, angle=impact.normal_frequency * impact.t2)


def _over_speed(impact: Contact) -> float:
    """m2 Omega S(0), the scale of printed forces."""
    return float(impact.m2 * impact.normal_frequency * np.hypot(impact.v1, impact.v2))


def eq_31(c: Contact, stretch: Numbers, velocity: Numbers, elapsed: Numbers) -> Array:
    """F1/(m2 Omega S) at t2 + elapsed, from the two values of Eq. 32."""
    ratio = c.tangential_frequency / c.normal_frequency
    angle = c.tangential_frequency * elapsed
    swing = stretch * np.cos(angle) + velocity / ratio * np.sin(angle)
    return c.friction / c.stiffness_ratio * eq_28_normal(c.slope) * swing


def _eq_31(impact: Contact, stretch: Numbers, velocity: Numbers) -> tuple[State, Array]:
    """States of the stick after the first slip, and Eq. 31 there, in mu F2max."""
    path = impact.between(impact.t2, impact.t3)
    force = eq_31(impact, stretch, velocity, path.t - impact.t2)
    return path, force * _over_speed(impact) / impact.friction_scale


@entry(
    "eq-18-31-32",
    "p. 442, Eqs 18a and 18b, with p. 445, Eqs 31 and 32",
    "Taken together: $u_1(t_2)$ has one sign in Eqs 18 and 32, and the two terms of the force in "
    "stick have a minus between them in Eq. 7c, but a plus in Eq. 31",
    at=lambda: contact.slip_stick_slip(late=False),
    verdict="wrong",
    grade="sign or misprint",
    cause="sign-of-deflection",
    correction=r"Eq. 32 should read $\Omega u_1(t_2)/(\mu v_2(0))$ $= -\zeta^2\,\sin(\Omega t_2)$, "
    "and Eq. 31 should have a minus before its sine and a minus before its brace",
    derivation=r"Where stick begins, $u_1(t_2) = \zeta^2 F_1(t_2)/\kappa$ $= \mu \zeta^2 "
    r"F_2(t_2)/\kappa > 0$, while $v_2(0) < 0$. With $F_2(t_2)$ $= -m_2 \Omega v_2(0)\,\sin(\Omega "
    r"t_2)$ and $\kappa = m_2 \Omega^2$ this is $\Omega u_1(t_2)/(\mu v_2(0))$ $= "
    r"-\zeta^2\,\sin(\Omega t_2)$. Eq. 7 asks for this sign, and Eqs 18 and 23 have it as they are "
    "read here.",
    holds="The magnitudes are right. So are the force, see eq-31, and $v_1(t_2)$",
    reading="The minus of Eq. 7c and the plus of Eq. 31 are legible in the scan. Whether a minus "
    "stands before $u_1(t_2)$ in Eqs 18 and 32, and before the brace of Eq. 31, is not. The best "
    "choice of the illegible signs is judged: whatever they are, the equations do not agree. Eq. "
    "23, where the scan leaves the sign open too, is not needed for that. If $u_1$ has the "
    "opposite sign in Eqs 31 and 32, as a convention of their own, those two give the right "
    "force, see eq-31",
)
def signs_of_deflection(impact: Contact) -> tuple[ArrayLike, float]:
    r"""How far the legible plus in Eq. 31 and one sign of $u_1(t_2)$ in Eqs 18 and 32 are apart.

    In units of $\mu$: the largest distance of Eq. 31 from the exact force, or of Eq. 32 from the
    exact $u_1(t_2)$, whichever is larger, under the best choice of the signs that the scan may have
    lost: before the $u_1(t_2)$ of Eq. 32, and before the brace of Eq. 31. Corrected: $u_1(t_2)$
    with a minus, as in Eq. 18, and a minus before sine and brace, as Eq. 7c asks.
    """
    stretch, velocity = _values_of_eq_32(impact)
    exact = impact.normal_frequency * impact.u1_t2 / impact.velocity_scale

    def gap(stretch: Numbers, velocity: Numbers, leading: int) -> float:
        path, force = _eq_31(impact, stretch, velocity)
        return largest([stretch - exact, leading * force - path.force_1 / impact.friction_scale])

    signs = product((-1, 1), (-1, 1))
    printed = [gap(sign * stretch, velocity, leading) for sign, leading in signs]
    return printed, gap(-stretch, -velocity, -1)


@entry(
    "eq-28",
    "p. 445, Eq. 28",
    r"The largest normal force over $m_2 \Omega S$ is the cosine of the angle of incidence",
    at=lambda: [*contact.initial_stick(), *contact.slip_throughout()],
)
def normal(impact: Contact) -> Gaps:
    """Eq. 28 against the exact normal force, which is largest at $t_c$."""
    top = impact.top.force_2
    exact = top / _over_speed(impact) if top == impact.path.force_2.max() else np.nan
    yield (impact.printed(eq_28_normal) - exact) / impact.friction


def _gap(impact: Contact, printed: Numbers) -> Array:
    """Distance of a printed F1max/(m2 Omega S) from the exact peak of friction, in mu."""
    peak = impact.rebound.peak_friction * impact.friction_scale
    return (printed - peak / _over_speed(impact)) / impact.friction


@entry(
    "eq-29",
    "p. 445, Eq. 29",
    r"After initial stick the largest friction is $-\omega m_1 v_1(0)$",
    at=contact.initial_stick,
)
@entry(
    "eq-30",
    "p. 445, Eq. 30",
    r"After initial stick the largest friction over $m_2 \Omega S$ is $\sqrt{m_1/m_2}/\zeta$ times "
    r"$v_1(0)/v_2(0)$, divided by $\sqrt{1 + v_1(0)^2/v_2(0)^2}$",
    at=contact.initial_stick,
    reading="The root is hardly legible. Eqs 4 and 29 ask for it",
)
def stick(impact: Contact) -> Gaps:
    """Eqs 29 and 30 against the exact peak of friction, initial stick."""
    peak = impact.rebound.peak_friction * impact.friction_scale
    yield -impact.tangential_frequency * impact.m1 * impact.v1 / peak - 1
    slope = impact.slope * eq_28_normal(impact.slope)
    yield _gap(impact, np.sqrt(1 / (impact.stiffness_ratio * impact.mass_ratio)) * slope)


@entry(
    "eq-31",
    "p. 445, Eq. 31, with the values of Eq. 32",
    r"In the stick after the first slip, friction over $m_2 \Omega S$ follows from $u_1(t_2)$ and "
    r"$v_1(t_2)$, with a plus between their two terms. Their values are $\Omega u_1(t_2)/(\mu "
    r"v_2(0))$ $= \zeta^2\,\sin(\Omega t_2)$ and $v_1(t_2)/(\mu v_2(0)) = v_1(0)/(\mu v_2(0))$ ${} "
    r"- (m_2/m_1) (1 - \cos(\Omega t_2))$",
    at=lambda: contact.slip_stick_slip(late=False),
    only_if=r"$v_1(0)/(\mu v_2(0)) < m_2/m_1$",
    holds=r"Eqs 31 and 32 are right for stick that begins in compression, $v_1(0)/(\mu v_2(0)) < "
    "m_2/m_1$. For the rest of their stated range see eq-32-late",
    reading="The factor before Eq. 31 and its first sign are not legible. The deflection "
    "$u_1(t_2)$ is taken as Eq. 32 shows it, with a sign of its own, see eq-18-31-32",
)
def stick_after_slip(impact: Contact) -> Gaps:
    r"""Eq. 31 with Eq. 32 along stick that begins in compression, over $\mu F_{2\mathrm{max}}$."""
    path, printed = _eq_31(impact, *_values_of_eq_32(impact))
    yield printed - path.force_1 / impact.friction_scale


@entry(
    "eq-32-late",
    "p. 445, Eqs 31 and 32, under the heading Intermediate angles of incidence",
    r"For $m_2/m_1 < v_1(0)/(\mu v_2(0))$ $< (1 + e) m_2/m_1$, the upper part of the stated range, "
    "the largest friction is the largest value of Eq. 31",
    at=lambda: contact.slip_stick_slip((1.0,), late=True),
    verdict="wrong",
    grade="sign or misprint",
    cause="late-stick",
    explorer={"angle": 66, "friction": 0.5, "restitution": 1, "view": "forces"},
    correction=r"From $v_1(0)/(\mu v_2(0)) = m_2/m_1$ on, the largest friction is $\mu "
    r"F_{2\mathrm{max}}$, Eq. 33",
    derivation=r"If $v_1(0)/(\mu v_2(0)) > m_2/m_1$, the normal impulse $p(t_c)$ of compression "
    r"does not stop the slip, and slip lasts beyond $t_c$. So $F_1 = \mu F_2$ at $t_c$, where "
    r"$F_2$ is largest. Friction cannot be larger than $\mu F_{2\mathrm{max}}$. Stick begins "
    "later, with less friction.",
    reading="Eqs 31 and 33 are judged over the ranges that the headings of p. 445 give. A "
    r"parenthesis on p. 447 has the right limit: from $v_1(0)/(\mu v_2(0)) = m_2/m_1$ on, both "
    "forces are largest together. With that limit in both headings nothing is wrong",
)
def peak_after_late_stick(impact: Contact) -> tuple[ArrayLike, float]:
    r"""Largest value of Eq. 31 over the stick that begins in restitution, less the exact peak.

    In $\mu F_{2\mathrm{max}}$, at $e = 1$, where both formulas of Table 1 coincide; corrected by
    Eq. 33.
    """
    _, force = _eq_31(impact, *_values_of_eq_32(impact))
    exact = float(impact.rebound.peak_friction)
    return np.abs(force).max() - exact, float(eq_33_friction(0.0, 1.0)) - exact


@entry(
    "eq-33",
    "p. 446, Eq. 33",
    r"In slip throughout the largest friction is $\mu$ times the largest normal force",
    at=lambda: [*contact.slip_throughout(), *contact.slip_stick_slip(late=True)],
    holds=r"Eq. 33 is right below its range, too, from $v_1(0)/(\mu v_2(0)) = m_2/m_1$ on",
)
def slip_throughout(impact: Contact) -> Gaps:
    r"""Eq. 33 against the exact peak of friction above $x = (1 + e) \beta$, and from $\beta$ on."""
    yield _gap(impact, impact.printed(eq_33_friction))


@entry(
    "eq-34",
    "p. 446, Eq. 34",
    r"Without tangential compliance friction is largest where slip halts, at $\Omega t_s$ $= "
    r"\arccos(1 - (m_1/m_2) v_1(0)/(\mu v_2(0)))$",
    given={"shares": [0.05, 0.4, 0.9, 0.99]},
    reading=r"In the arccosine $\mu$ and $m_1/m_2$ are hardly legible. Eq. 16 asks for them",
)
@entry(
    "eq-35",
    "p. 446, Eq. 35",
    "Without tangential compliance friction is largest at $t_c$ if the contact still slides at "
    "$t_c$",
    given={"shares": [1, 1.7, 2.5]},
)
def rigid_limit(shares: Sequence[float]) -> float:
    r"""Eq. 34 or, from $\beta$ on, Eq. 35 against quadrature and `rigid`, in $\mu$.

    At $x/\beta$ of {shares}.
    """
    from scipy.interpolate import CubicSpline  # here, as in `contact.cumulative`

    (motion,) = contact.normal_motions([1.0])
    compression = slice(motion.at_top + 1)
    force = motion.path.force_2[compression] / motion.force_scale
    impulse = motion.brought[compression] / motion.compression_impulse
    # Slip halts at a known impulse p. F2 rises with p in compression, and dp/dF2 is 0 at t_c, so
    # F2^2 is smooth there.
    squared, gaps = CubicSpline(impulse, force**2), []
    for (beta, _), share in product(contact.PAIRS, shares):
        slope = motion.friction * share * beta
        printed = motion.friction * eq_28_normal(slope)
        if share < 1:
            printed *= np.sin(np.arccos(1 - slope / (motion.friction * beta)))
        halted = squared(min(share, 1)) ** 0.5
        for exact in (halted, rigid.rebound(share * beta, beta).peak_friction):
            gaps.append(printed / motion.friction - exact * eq_28_normal(slope))
    return largest(gaps)


@entry(
    "rigid-sequence",
    "p. 446, Maximum friction for negligible tangential compliance, 1st sentence",
    "Without tangential compliance the contact slips first and then sticks to the end",
    at_most=0.0,
)
def rigid_sequence() -> float:
    r"""Share of rigid contacts below $(1 + e) \beta$ that do not slip first and then stick."""
    e, beta = np.linspace(0, 1, 11)[:, None], contact.MASS_RATIO
    x = equations.slip_throughout_limit(beta, e) * np.linspace(0.001, 0.999, 50)
    regime = rigid.rebound(x, beta, restitution=e).regime
    return float(np.mean(regime != Regime.SLIP_STICK))


entry(
    "wear-tests",
    "p. 444, Angle of incidence for maximum friction, 1st sentence",
    "Ko found that wear follows the largest tangential force, at normal speeds below 1 m/s",
    verdict="not testable",
    why="Wear is not modelled",
)


entry(
    "peak-in-compression",
    "p. 445, 1st full sentence of the text; p. 449, Conclusions, 5th sentence",
    r"With $\omega > \Omega$ friction is largest in compression",
    at=lambda: contact.PAIRS,
    holds="In a continuum that yields, friction may be largest shortly after compression",
)(restitution_immaterial)


@entry(
    "peak-where-velocity-turns",
    "p. 445, Small angles of incidence, 2nd sentence",
    r"After initial stick friction is largest at $\Omega t_c/\omega$, when $v_1$ changes sign",
    at=lambda: [Contact(zeta2 / 2, beta, zeta2, samples=2001) for beta, zeta2 in contact.PAIRS],
)
def stick_velocity(impact: Contact) -> Gaps:
    r"""$v_1$ at $t = \pi/(2 \omega)$, where friction is largest in initial stick, over $v_1(0)$."""
    from scipy.interpolate import CubicHermiteSpline  # here, as in `contact.cumulative`

    path = impact.path
    # dv1/dt is known at the samples too: F1/m1.
    velocity = CubicHermiteSpline(path.t, path.v1, path.force_1 / impact.m1)
    yield velocity(np.pi / 2 / impact.tangential_frequency) / impact.v1


def _slip_stick_slip(number: int, samples: int) -> list[Contact]:
    """Contacts of the paper's sphere over all incidences of slip, stick, slip, e = 1."""
    limit = float(lumped.slip_throughout_limit(*contact.SPHERE, 1.0))
    incidences = np.linspace(contact.STIFFNESS_RATIO, limit, number + 2)[1:-1]
    return [Contact(x, samples=samples) for x in incidences]


@entry(
    "stick-in-compression",
    "p. 445, Intermediate angles of incidence, 1st sentence",
    "At intermediate angles stick begins in compression",
    at_most=0.0,
    verdict="wrong",
    grade="sign or misprint",
    cause="late-stick",
    explorer={"angle": 66, "friction": 0.5, "restitution": 1, "view": "velocity"},
    correction="At $e = 1$ stick begins in restitution over the upper part of the range, 3.5 to "
    "5.79",
    derivation="For the limits see transition-at-compression and slip-throughout-limit.",
    holds=r"This is right for $v_1(0)/(\mu v_2(0)) < m_2/m_1$, which is all of the range if $e \le "
    r"\Omega/\omega$",
    reading="The sentence is judged over the range of intermediate angles that its heading "
    "states, up to the corrected limit, see slip-throughout-limit. Eq. 21 on p. 443 has the other "
    "case, stick that begins in restitution, which p. 445 leaves out. If the heading ended at "
    "$m_2/m_1$, the limit that p. 447 states, the sentence would be right",
)
def late_stick() -> float:
    """Share of the incidences of slip, stick, slip ($e = 1$) whose stick begins after $t_c$."""
    late = [impact.t2 > impact.compression_time for impact in _slip_stick_slip(200, 2)]
    return float(np.mean(late))


@entry(
    "still-moving-at-stick",
    "p. 445, Intermediate angles of incidence, 2nd sentence",
    "Where stick begins after a first slip, $v_1$ has its first direction",
    at_least=0.0,
    verdict="wrong",
    grade="sign or misprint",
    cause="late-stick",
    explorer={"angle": 66, "friction": 0.5, "restitution": 1, "view": "velocity"},
    correction=r"For $v_1(0)/(\mu v_2(0)) > m_2/m_1$ the body has turned round before the particle "
    "stops",
    derivation=r"By Eqs 17 and 20 stick begins with $v_1(t_2)/(\mu v_2(0))$ $= "
    r"(\zeta^2/e)\,\cos(\alpha)$ in restitution, and this is negative.",
    holds=r"This is right for $v_1(0)/(\mu v_2(0)) < m_2/m_1$, which is all of the range if $e \le "
    r"\Omega/\omega$",
    reading="The paper has $v_1(t_2) > 0$ against its own $v_1(0) < 0$, so the direction is "
    "judged, over the range of intermediate angles that the heading states. If the heading ended "
    "at $m_2/m_1$, the limit that p. 447 states, the sentence would be right",
)
def velocity_at_stick() -> float:
    r"""Lowest $v_1(t_2)/(\mu v_2(0))$ over slip, stick, slip, $e = 1$, of those sampled.

    Negative means that the body has turned round.
    """
    return min(
        float(impact.v1_t2) / impact.velocity_scale
        for impact in contact.slip_stick_slip((1.0,))
        if (impact.mass_ratio, impact.stiffness_ratio) == contact.SPHERE
    )


@entry(
    "peak-after-stick",
    "p. 445, Intermediate angles of incidence, 3rd sentence",
    "After a first slip the largest friction comes a little after the start of stick, and before "
    "$t_c$",
    at_most=0.0,
    verdict="wrong",
    grade="sign or misprint",
    cause="late-stick",
    explorer={"angle": 66, "friction": 0.5, "restitution": 1, "view": "forces"},
    correction=r"For $v_1(0)/(\mu v_2(0)) > m_2/m_1$ friction is largest at $t_c$, while the "
    "contact still slips",
    derivation="For the derivation see eq-32-late.",
    holds=r"This is right for $v_1(0)/(\mu v_2(0)) < m_2/m_1$, which is all of the range if $e \le "
    r"\Omega/\omega$",
    reading="The sentence is judged over the range of intermediate angles that its heading "
    "states. The text of p. 447 is right for the upper part of the range, and has the limit "
    "$m_2/m_1$ at which the heading should end, see eq-32-late",
)
def peak_after_stick() -> float:
    """Share of the incidences of slip, stick, slip ($e = 1$) with the peak before stick."""
    before = [
        impact.path.t[np.argmax(np.abs(impact.path.force_1))] < impact.t2
        for impact in _slip_stick_slip(100, 401)
    ]
    return float(np.mean(before))


@entry(
    "simultaneous-peaks",
    "p. 446, sentence after Eq. 33",
    "In gross slip both forces are largest together",
    at=contact.slip_throughout,
)
def simultaneous(impact: Contact) -> Gaps:
    """Distance of the instants of both peaks in slip throughout, in $t_c$."""
    path = impact.path
    gap = path.t[path.force_2.argmax()] - path.t[path.force_1.argmax()]
    yield gap / impact.compression_time


def forces(model: Model, friction: float) -> Array:
    """F1max/(m2 Omega S) at each of ANGLES; `model` takes incidences."""
    theta = np.radians(ANGLES)
    return friction * np.cos(theta) * model(np.tan(theta) / friction).peak_friction


def _incidence_of_peak(model: Model) -> Array:
    """Incidence of the largest peak, for each friction of Fig. 7."""
    return np.array([np.tan(np.radians(peak_angle(mu, model))) / mu for mu in FRICTIONS])


@entry(
    "peak-at-intermediate-incidence",
    "p. 446, 4th sentence after Eq. 33",
    "Over all angles friction is largest at an intermediate one",
    at_least=0.0,
)
def peak_at_intermediate_incidence() -> float:
    r"""Distance of the incidence of the largest peak from $\zeta^2$ and $(1 + e) \beta$."""
    (beta, zeta2), x = contact.SPHERE, _incidence_of_peak(lumped_sphere)
    return float(min((x - zeta2).min(), (2 * beta - x).min()))


@entry(
    "peak-angle-rises",
    "p. 446, 5th sentence after Eq. 33",
    r"The angle at which friction is largest rises with $\mu$",
    at_least=0.1,
    reading=r"“Rises” is read as by a tenth of a degree at least from one $\mu$ of Fig. 7 to the "
    "next",
)
def peak_angle_rises() -> float:
    r"""Smallest rise in degrees of the angle of the largest peak between $\mu$ of Fig. 7."""
    return float(np.min(np.diff([peak_angle(mu) for mu in FRICTIONS])))


@entry(
    "peak-angle-0.1",
    "p. 446, 5th sentence after Eq. 33",
    r"For $\mu = 0.1$ friction is largest at about 20°",
    given={"friction": 0.1},
    fact="peak_angle_mu_0.1",
    verdict="confirmed within rounding",
)
@entry(
    "peak-angle-1",
    "p. 446, 5th sentence after Eq. 33",
    r"For $\mu = 1$ friction is largest at almost 60°",
    given={"friction": 1},
    fact="peak_angle_mu_1",
    verdict="confirmed within rounding",
)
def peak_angle(friction: float, model: Model = lumped_sphere) -> float:
    r"""Angle of the largest peak of friction, $\mu = {friction}$, in degrees."""
    return landmarks.peak(ANGLES, forces(model, friction))


@entry(
    "substantially-less",
    "pp. 446 and 447, 2nd sentence after Eq. 35, which runs over the end of the page",
    "For solid spheres the largest friction is substantially less than without tangential "
    "compliance",
    given={"friction": 1},
    at_least=0.1,
    only_if=r"$\mu > 0.55$",
    holds=r"This is right for $\mu$ above 0.55; the reduction is 21 % for $\mu = 1$. For every "
    r"$\mu$ it is right at one small incidence: the reduction is 31 % at $v_1(0)/(\mu v_2(0)) = 1$",
    reading="“Substantially” is read as by a tenth at least, for the largest friction over all "
    r"angles of incidence. The sentence is judged for some $\mu$ of Fig. 7, because it speaks of "
    r"one largest force. Over these $\mu$ the force is largest for $\mu = 1$, where the reduction "
    r"is largest too. Read for every $\mu$ the sentence is wrong: the reduction is 0.2 % for $\mu "
    r"= 0.1$ and 1.4 % for $\mu = 0.2$",
)
@entry(
    "somewhat-smaller",
    "p. 449, Conclusions, 7th sentence",
    "With tangential compliance the largest friction is somewhat smaller than without",
    given={"friction": 0.1},
    at_least=1e-09,
)
def reduction(friction: float) -> float:
    r"""Share by which tangential compliance makes the largest peak smaller, $\mu = {friction}$."""
    return 1 - forces(lumped_sphere, friction).max() / forces(rigid_sphere, friction).max()


@entry(
    "peak-independent-of-compliance",
    "p. 447, 2nd full sentence of the text, the last before the heading Comparison with "
    "measurement",
    "At large angles, in gross slip, the largest friction does not depend on tangential compliance",
    holds=r"This is right from $v_1(0)/(\mu v_2(0)) = m_2/m_1$ on",
)
def compliance_immaterial() -> float:
    r"""Difference of both peaks from $x = \beta$ on, in $\mu$."""
    x = np.linspace(contact.MASS_RATIO, 20, 200)
    return largest([lumped_sphere(x).peak_friction - rigid_sphere(x).peak_friction])


@entry(
    "peak-below-gross-slip",
    "p. 447, 1st full sentence of the text",
    "With tangential compliance and without, friction is largest at small to intermediate angles",
    at_most=5.79,
)
def peak_below_gross_slip() -> float:
    """Largest incidence of the largest peak, with tangential compliance and without."""
    return float(max(_incidence_of_peak(model).max() for model in (lumped_sphere, rigid_sphere)))


entry(
    "peak-angle-0.18",
    "p. 447, Comparison with measurement, last sentence but one",
    r"For $\mu = 0.18$ friction is largest at about 35°",
    given={"friction": 0.18},
    fact="peak_angle_mu_0.18",
    verdict="wrong",
    grade="changes a result",
    cause="peak-angle",
    quantity="friction is largest, mu 0.18",
    values=lambda angle: ("at about 35 deg", f"at {angle:.3g} deg"),
    explorer={"angle": 27.8, "friction": 0.18, "restitution": 1, "view": "forces"},
    correction=r"For $\mu = 0.18$ friction is largest at 27.8°",
    derivation=r"The incidence $v_1(0)/(\mu v_2(0)) = m_2/m_1$ lies at 32.2°. At larger angles the "
    "largest friction is proportional to the cosine of the angle, which falls. So friction cannot "
    r"be largest at 35°. At smaller angles the largest value of Eqs 31 and 32 lies at $v_1(0)/(\mu "
    "v_2(0)) = 2.93$.",
    holds="The same sentence says that the angle does not depend on the speed, and this is right. "
    "The maximum is flat: at 35° the largest friction is 5.5 % below that at 27.8°",
    reading="“About” is read as within 5°, as generously as for 20° and 60°. The model's angle is "
    "7° away. Any angle that the paper places is judged by these 5°, see "
    "largest-dissipation-angle",
)(peak_angle)


entry(
    "measured-peak-angle",
    "p. 447, Comparison with measurement, last sentence but two",
    "Lewis and Rogers measured the largest friction at about 40°, at four speeds",
    verdict="not testable",
    why="The measurements are not at hand. The model is compared with the angle that Lewis and "
    "Rogers (1988) state",
)


@entry(
    "full-friction-angle",
    "p. 447, Comparison with measurement, last sentence, in parentheses",
    r"For $\mu = 0.18$ both forces are largest together above 32°, where $v_1(0)/v_2(0) > \mu "
    "m_2/m_1$",
    fact="full_friction_angle",
    verdict="confirmed within rounding",
)
def full_friction_angle() -> float:
    r"""Degrees from which peak friction is $\mu$ times the peak normal force, $\mu = 0.18$."""

    def below(angle: float) -> bool:
        return bool(lumped_sphere(np.tan(np.radians(angle)) / 0.18).peak_friction < 1 - 1e-15)

    return boundary(below, 0.0, 80.0)


@entry(
    "ball-mass",
    "p. 447, caption of Fig. 8, 2nd sentence, and Comparison with measurement, 1st and 8th "
    "sentence",
    "A steel ball of 25.4 mm and half as much for its holder are 101 g",
    value=0.101,
    rounding=0.0005,
    verdict="confirmed within rounding",
    reading="The steel is taken to have 7850 kg/m³. The paper does not state its density",
)
def ball_mass() -> float:
    """Mass of a steel ball of 25.4 mm and half as much for its holder, kg."""
    return 1.5 * float(bodies.solid_sphere(0.0127, density=7850.0).mass)
