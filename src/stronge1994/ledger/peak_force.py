"""Checks of Eqs 28 to 35, and of what pp. 435 and 444 to 449 say of the largest forces."""

from collections.abc import Callable, Sequence
from itertools import product

import numpy as np

from planarimpact import bodies, lumped, rigid
from planarimpact.common.arrays import Array, ArrayLike, Numbers
from planarimpact.common.results import Rebound
from stronge1994.judging import landmarks
from stronge1994.ledger import contact
from stronge1994.ledger.contact import Contact, State, boundary
from stronge1994.ledger.finding import Gaps, corrected_over, largest, over
from stronge1994.printed import peak_force

FRICTIONS = (0.1, 0.2, 0.4, 0.6, 0.8, 1.0)
ANGLES = np.linspace(0.0, 89.9, 1799)[1:]  # degrees, 0.05 apart
INCIDENCE, RESTITUTIONS = np.linspace(0, 8, 401), np.linspace(0, 1, 21)[:, None]

Model = Callable[[Array], Rebound]


def _lumped(x: Array) -> Rebound:
    return contact.once(lumped.rebound, x, *contact.SPHERE)


def _rigid(x: Array) -> Rebound:
    return rigid.rebound(x, contact.MASS_RATIO)


def _forces(model: Model, friction: float) -> Array:
    """F1max/(m2 Omega S) at each of ANGLES; `model` takes incidences."""
    theta = np.radians(ANGLES)
    return friction * np.cos(theta) * model(np.tan(theta) / friction).peak_friction


def _over_speed(impact: Contact) -> float:
    """m2 Omega S(0), the scale of printed forces."""
    return float(impact.m2 * impact.normal_frequency * np.hypot(impact.v1, impact.v2))


def _gap(impact: Contact, formula: Callable[..., Array]) -> Array:
    """Distance of a printed F1max/(m2 Omega S) from the exact peak of friction, in mu."""
    peak = impact.rebound.peak_friction * impact.friction_scale
    return (impact.printed(formula) - peak / _over_speed(impact)) / impact.friction


@over(lambda: [*contact.initial_stick(), *contact.slip_throughout()])
def normal(impact: Contact) -> Gaps:
    """Eq. 28 against the exact normal force, which is largest at $t_c$."""
    top = impact.top.force_2
    exact = top / _over_speed(impact) if top == impact.path.force_2.max() else np.nan
    yield (impact.printed(peak_force.eq_28_normal) - exact) / impact.friction


@over(contact.initial_stick)
def stick(impact: Contact) -> Gaps:
    """Eqs 29 and 30 against the exact peak of friction, initial stick."""
    peak = impact.rebound.peak_friction * impact.friction_scale
    yield impact.printed(peak_force.eq_29_friction) / peak - 1
    yield _gap(impact, peak_force.eq_30_friction)


@over(lambda: [Contact(zeta2 / 2, beta, zeta2, samples=2001) for beta, zeta2 in contact.PAIRS])
def stick_velocity(impact: Contact) -> Gaps:
    r"""$v_1$ at $t = \pi/(2 \omega)$, where friction is largest in initial stick, over $v_1(0)$."""
    from scipy.interpolate import CubicHermiteSpline  # here, as in `contact.cumulative`

    path = impact.path
    # dv1/dt is known at the samples too: F1/m1.
    velocity = CubicHermiteSpline(path.t, path.v1, path.force_1 / impact.m1)
    yield velocity(np.pi / 2 / impact.tangential_frequency) / impact.v1


def _values_of_eq_32(impact: Contact) -> tuple[Array, Array]:
    """Both values of Eq. 32 at the exact start of stick."""
    return impact.printed(peak_force.eq_32_start, angle=impact.normal_frequency * impact.t2)


def _eq_31(impact: Contact, stretch: Numbers, velocity: Numbers) -> tuple[State, Array]:
    """States of the stick after the first slip, and Eq. 31 there, in mu F2max."""
    path, omega = impact.between(impact.t2, impact.t3), impact.normal_frequency
    force = impact.printed(
        peak_force.eq_31_friction,
        elapsed=omega * (path.t - impact.t2),
        stretch=stretch,
        velocity=velocity,
        frequency_ratio=impact.tangential_frequency / omega,
    )
    return path, force * _over_speed(impact) / impact.friction_scale


@over(lambda: contact.slip_stick_slip(late=False))
def stick_after_slip(impact: Contact) -> Gaps:
    r"""Eq. 31 with Eq. 32 along stick that begins in compression, over $\mu F_{2\mathrm{max}}$."""
    path, printed = _eq_31(impact, *_values_of_eq_32(impact))
    yield printed - path.force_1 / impact.friction_scale


@corrected_over(lambda: contact.slip_stick_slip(late=False))
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


@corrected_over(lambda: contact.slip_stick_slip((1.0,), late=True))
def peak_after_late_stick(impact: Contact) -> tuple[ArrayLike, float]:
    r"""Largest value of Eq. 31 over the stick that begins in restitution, less the exact peak.

    In $\mu F_{2\mathrm{max}}$, at $e = 1$, where both formulas of Table 1 coincide; corrected by
    Eq. 33.
    """
    _, force = _eq_31(impact, *_values_of_eq_32(impact))
    exact = float(impact.rebound.peak_friction)
    return np.abs(force).max() - exact, float(peak_force.eq_33_friction(0.0, 1.0)) - exact


@over(lambda: [*contact.slip_throughout(), *contact.slip_stick_slip(late=True)])
def slip_throughout(impact: Contact) -> Gaps:
    r"""Eq. 33 against the exact peak of friction above $x = (1 + e) \beta$, and from $\beta$ on."""
    yield _gap(impact, peak_force.eq_33_friction)


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
        if share < 1:
            printed = peak_force.eq_34_friction(slope, motion.friction, beta)
        else:
            printed = peak_force.eq_35_friction(slope, motion.friction)
        halted = squared(min(share, 1)) ** 0.5
        for exact in (halted, rigid.rebound(share * beta, beta).peak_friction):
            gaps.append(printed / motion.friction - exact * peak_force.eq_28_normal(slope))
    return largest(gaps)


def compliance_reduces() -> float:
    r"""Smallest excess of the peak without tangential compliance over that with it, in $\mu$."""
    x = np.linspace(0, 8, 2001)
    return float(np.min(_rigid(x).peak_friction - _lumped(x).peak_friction))


@over(lambda: contact.PAIRS)
def restitution_immaterial(pair: tuple[float, float]) -> Gaps:
    r"""Change of the peak of friction with $e$, $\omega > \Omega$.

    From $e = 0$ on, where there is compression alone.
    """
    yield np.ptp(lumped.rebound(INCIDENCE, *pair, RESTITUTIONS).peak_friction, axis=0)


def _slip_stick_slip(number: int, samples: int) -> list[Contact]:
    """Contacts of the paper's sphere over all incidences of slip, stick, slip, e = 1."""
    limit = float(lumped.slip_throughout_limit(*contact.SPHERE, 1.0))
    incidences = np.linspace(contact.STIFFNESS_RATIO, limit, number + 2)[1:-1]
    return [Contact(x, samples=samples) for x in incidences]


def late_stick() -> float:
    """Share of the incidences of slip, stick, slip ($e = 1$) whose stick begins after $t_c$."""
    late = [impact.t2 > impact.compression_time for impact in _slip_stick_slip(200, 2)]
    return float(np.mean(late))


def peak_after_stick() -> float:
    """Share of the incidences of slip, stick, slip ($e = 1$) with the peak before stick."""
    before = [
        impact.path.t[np.argmax(np.abs(impact.path.force_1))] < impact.t2
        for impact in _slip_stick_slip(100, 401)
    ]
    return float(np.mean(before))


def velocity_at_stick() -> float:
    r"""Lowest $v_1(t_2)/(\mu v_2(0))$ over slip, stick, slip, $e = 1$, of those sampled.

    Negative means that the body has turned round.
    """
    return min(
        float(impact.v1_t2) / impact.velocity_scale
        for impact in contact.slip_stick_slip((1.0,))
        if (impact.mass_ratio, impact.stiffness_ratio) == contact.SPHERE
    )


@over(contact.slip_throughout)
def simultaneous(impact: Contact) -> Gaps:
    """Distance of the instants of both peaks in slip throughout, in $t_c$."""
    path = impact.path
    gap = path.t[path.force_2.argmax()] - path.t[path.force_1.argmax()]
    yield gap / impact.compression_time


def peak_angle(friction: float, model: Model = _lumped) -> float:
    r"""Angle of the largest peak of friction, $\mu = {friction}$, in degrees."""
    return landmarks.peak(ANGLES, _forces(model, friction))


def peak_angle_rises() -> float:
    r"""Smallest rise in degrees of the angle of the largest peak between $\mu$ of Fig. 7."""
    return float(np.min(np.diff([peak_angle(mu) for mu in FRICTIONS])))


def _incidence_of_peak(model: Model) -> Array:
    """Incidence of the largest peak, for each friction of Fig. 7."""
    return np.array([np.tan(np.radians(peak_angle(mu, model))) / mu for mu in FRICTIONS])


def peak_at_intermediate_incidence() -> float:
    r"""Distance of the incidence of the largest peak from $\zeta^2$ and $(1 + e) \beta$."""
    (beta, zeta2), x = contact.SPHERE, _incidence_of_peak(_lumped)
    return float(min((x - zeta2).min(), (2 * beta - x).min()))


def peak_below_gross_slip() -> float:
    """Largest incidence of the largest peak, with tangential compliance and without."""
    return float(max(_incidence_of_peak(model).max() for model in (_lumped, _rigid)))


def reduction(friction: float) -> float:
    r"""Share by which tangential compliance makes the largest peak smaller, $\mu = {friction}$."""
    return 1 - _forces(_lumped, friction).max() / _forces(_rigid, friction).max()


def compliance_immaterial() -> float:
    r"""Difference of both peaks from $x = \beta$ on, in $\mu$."""
    x = np.linspace(contact.MASS_RATIO, 20, 200)
    return largest([_lumped(x).peak_friction - _rigid(x).peak_friction])


def full_friction_angle() -> float:
    r"""Degrees from which peak friction is $\mu$ times the peak normal force, $\mu = 0.18$."""

    def below(angle: float) -> bool:
        return bool(_lumped(np.tan(np.radians(angle)) / 0.18).peak_friction < 1 - 1e-15)

    return boundary(below, 0.0, 80.0)


def ball_mass() -> float:
    """Mass of a steel ball of 25.4 mm and half as much for its holder, kg."""
    return 1.5 * float(bodies.solid_sphere(0.0127, 7850.0).mass)


def _effect(model: Model, friction: float, base: Model = _lumped) -> float:
    """Relative change of the largest peak of one mu from a model to another."""
    return abs(_forces(model, friction).max() / _forces(base, friction).max() - 1)


def normal_details() -> float:
    r"""Largest relative change of the largest peak of a $\mu$, Hertz' compliance for linear."""
    return max(_effect(contact.without_micro_slip, mu) for mu in (0.1, 0.4, 1.0))


def stiffness_matters_more() -> float:
    r"""Change of the largest peak from $\nu = 0$ to 0.5, over that by Hertz' compliance.

    $\zeta^2$ is 1 for $\nu = 0$ and 1.5 for 0.5. The smallest ratio for $\mu = 0.1$, 0.4 and 1.
    """

    def sphere(poisson_ratio: float) -> Model:
        zeta2 = bodies.stiffness_ratio(bodies.Material(1.0, poisson_ratio))
        return lambda x: lumped.rebound(x, contact.MASS_RATIO, zeta2)

    frictions = (0.1, 0.4, 1.0)
    ratios = [
        _effect(sphere(0.5), mu, sphere(0.0)) / _effect(contact.without_micro_slip, mu)
        for mu in frictions
    ]
    return min(ratios)
