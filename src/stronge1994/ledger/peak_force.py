"""Checks of Eqs 28 to 35, and of what pp. 435 and 444 to 449 say of the largest forces."""

from collections.abc import Callable, Iterable, Sequence
from itertools import product

import numpy as np
from scipy.interpolate import CubicHermiteSpline, CubicSpline

from planarimpact import bodies, lumped, rigid
from planarimpact.ground.arrays import Array, Numbers
from planarimpact.ground.results import EventKind, Rebound
from stronge1994.judging import landmarks
from stronge1994.ledger import contact
from stronge1994.ledger.contact import Contact, State
from stronge1994.ledger.finding import Finding, largest
from stronge1994.ledger.slip import boundary
from stronge1994.printed import peak_force

FRICTIONS = (0.1, 0.2, 0.4, 0.6, 0.8, 1.0)
ANGLES = np.linspace(0.0, 89.9, 1799)[1:]  # degrees, 0.05 apart


def _forces(model: Callable[[Array], Rebound], friction: float) -> Array:
    """F1max/(m2 Omega S) at each of ANGLES; `model` takes incidences."""
    theta = np.radians(ANGLES)
    return friction * np.cos(theta) * model(np.tan(theta) / friction).peak_friction


def _lumped(x: Array) -> Rebound:
    return contact.once(lumped.rebound, x, *contact.SPHERE)


def _rigid(x: Array) -> Rebound:
    return rigid.rebound(x, contact.MASS_RATIO)


def _speed(impact: Contact) -> tuple[float, float]:
    """S(0) of a contact, and v1(0)/v2(0)."""
    return np.hypot(impact.v1, impact.v2), impact.v1 / impact.v2


def _against(
    contacts: Iterable[Contact],
    printed: Callable[[Contact, float], Numbers],
    force: Callable[[Contact], Numbers] = lambda impact: np.abs(impact.path.force_1).max(),
) -> float:
    """Largest distance of a printed force over m2 Omega S from that of exact contacts, in mu."""
    gaps = []
    for impact in contacts:
        speed, slope = _speed(impact)
        scale = impact.m2 * impact.normal_frequency * speed
        gaps.append((printed(impact, slope) - force(impact) / scale) / impact.friction)
    return largest(gaps)


def normal() -> Finding:
    """Eq. 28 against the exact normal force, which is largest at $t_c$."""

    def at_compression(impact: Contact) -> Numbers:
        top = impact.first(EventKind.MAXIMUM_COMPRESSION).force_2
        return top if top == impact.path.force_2.max() else np.nan

    contacts = [*contact.initial_stick(), *contact.slip_throughout()]
    return Finding(
        _against(contacts, lambda _, slope: peak_force.eq_28_normal(slope), at_compression)
    )


def _peak(impact: Contact) -> Array:
    """Exact peak of friction."""
    return impact.rebound.peak_friction * impact.friction_scale


def stick() -> Finding:
    """Eq. 29 against the exact peak of friction, initial stick."""
    gaps = []
    for impact in contact.initial_stick():
        printed = peak_force.eq_29_friction(impact.v1, impact.m1, impact.tangential_frequency)
        gaps.append(printed / _peak(impact) - 1)
    return Finding(largest(gaps))


def stick_over_speed() -> Finding:
    """Eq. 30 against the exact peak of friction, initial stick."""
    return Finding(
        _against(
            contact.initial_stick(),
            lambda impact, slope: peak_force.eq_30_friction(
                slope, impact.mass_ratio, impact.stiffness_ratio
            ),
            _peak,
        )
    )


def stick_velocity() -> Finding:
    r"""$v_1$ at $t = \pi/(2 \omega)$, where friction is largest in initial stick, over $v_1(0)$."""
    gaps = []
    for beta, zeta2 in contact.PAIRS:
        impact = contact.contact(zeta2 / 2, beta, zeta2, samples=2001)
        path = impact.path
        # dv1/dt is known at the samples too: F1/m1.
        velocity = CubicHermiteSpline(path.t, path.v1, path.force_1 / impact.m1)
        gaps.append(velocity(np.pi / 2 / impact.tangential_frequency) / impact.v1)
    return Finding(largest(gaps))


def _start(impact: Contact) -> tuple[State, tuple[Numbers, Numbers]]:
    """Both values of Eq. 32 at the exact start of stick, and that start."""
    start = impact.first(EventKind.STICK)
    angle = impact.normal_frequency * start.t
    groups = impact.incidence, impact.mass_ratio, impact.stiffness_ratio
    return start, peak_force.eq_32_start(angle, *groups)


def _along_stick(
    impact: Contact, values: tuple[Numbers, Numbers] | None = None
) -> tuple[State, Numbers]:
    """States of the stick after the first slip, and Eq. 31 there; `values` default to Eq. 32."""
    start, of_eq_32 = _start(impact)
    values = of_eq_32 if values is None else values
    path = impact.between(start.t, impact.last(EventKind.SLIP).t)
    speed, slope = _speed(impact)
    elapsed = impact.normal_frequency * (path.t - start.t)
    ratio = impact.tangential_frequency / impact.normal_frequency
    groups = slope, impact.friction, impact.stiffness_ratio, ratio
    force = peak_force.eq_31_friction(elapsed, *values, *groups)
    return path, force * impact.m2 * impact.normal_frequency * speed


def stick_after_slip() -> Finding:
    r"""Eq. 31 with Eq. 32 in the stick that begins in compression, over $\mu F_{2\mathrm{max}}$."""
    gaps = []
    for impact in contact.slip_stick_slip(late=False):
        path, printed = _along_stick(impact)
        gaps.append((printed - path.force_1) / impact.friction_scale)
    return Finding(largest(gaps))


def signs_of_deflection() -> Finding:
    r"""How far the legible plus in Eq. 31 and one sign of $u_1(t_2)$ in Eqs 18 and 32 are apart.

    In units of $\mu$: the largest distance of Eq. 31 from the exact force, or of Eq. 32 from the
    exact $u_1(t_2)$, whichever is larger, under the best choice of the signs that the scan may have
    lost: before the $u_1(t_2)$ of Eq. 32, and before the brace of Eq. 31. Corrected: $u_1(t_2)$
    with a minus, as in Eq. 18, and a minus before sine and brace, as Eq. 7c asks.
    """
    printed: dict[tuple[int, int], list[Numbers]] = {
        signs: [] for signs in product((-1, 1), (-1, 1))
    }
    corrected = []
    for impact in contact.slip_stick_slip(late=False):
        start, (stretch, velocity) = _start(impact)
        exact = impact.normal_frequency * start.u1 / impact.velocity_scale
        for (sign, leading), gaps in printed.items():
            path, force = _along_stick(impact, (sign * stretch, velocity))
            gaps.append(sign * stretch - exact)
            gaps.append((leading * force - path.force_1) / impact.friction_scale)
        path, force = _along_stick(impact, (-stretch, -velocity))
        corrected += [-stretch - exact, (-force - path.force_1) / impact.friction_scale]
    return Finding(min(largest(gaps) for gaps in printed.values()), largest(corrected))


def peak_after_late_stick() -> Finding:
    r"""Largest value of Eq. 31 over the stick that begins in restitution, less the exact peak.

    In $\mu F_{2\mathrm{max}}$, at $e = 1$, where both formulas of Table 1 coincide; corrected by
    Eq. 33.
    """
    printed, corrected = [], []
    for impact in contact.slip_stick_slip((1.0,), late=True):
        _, force = _along_stick(impact)
        exact = _peak(impact) / impact.friction_scale
        printed.append(np.abs(force).max() / impact.friction_scale - exact)
        corrected.append(peak_force.eq_33_friction(0.0, 1.0) - exact)
    return Finding(largest(printed), largest(corrected))


def slip_throughout() -> Finding:
    r"""Eq. 33 against the exact peak of friction above $x = (1 + e) \beta$, and from $\beta$ on."""
    contacts = [*contact.slip_throughout(), *contact.slip_stick_slip(late=True)]
    return Finding(
        _against(
            contacts, lambda impact, slope: peak_force.eq_33_friction(slope, impact.friction), _peak
        )
    )


def _rigid_gap(formula: Callable[..., Numbers], shares: Sequence[float]) -> Finding:
    """Distance of a formula of the rigid limit from mu F2, in mu; x = shares of beta."""
    motion = contact.normal_motion(1.0)
    impact, top = motion.impact, motion.top + 1
    force = impact.path.force_2[:top] / impact.force_scale
    share = motion.impulse[:top] / (-impact.m2 * impact.v2)
    # Slip halts at a known impulse p. F2 rises with p in compression, and dp/dF2 is 0 at t_c, so
    # F2^2 is smooth there.
    at_impulse = CubicSpline(share, force**2)
    gaps = []
    for beta, _ in contact.PAIRS:
        x = beta * np.array(shares)
        slope = contact.FRICTION * x
        cosine = peak_force.eq_28_normal(slope)
        for exact in (
            np.sqrt(at_impulse(np.minimum(x / beta, 1.0))),
            rigid.rebound(x, beta).peak_friction,
        ):
            gaps.append(formula(slope, beta) / contact.FRICTION - exact * cosine)
    return Finding(largest(gaps))


def rigid_halted() -> Finding:
    """Eq. 34 where slip halts in compression, against quadrature and `rigid`."""
    return _rigid_gap(
        lambda slope, beta: peak_force.eq_34_friction(slope, contact.FRICTION, beta),
        (0.05, 0.4, 0.9, 0.99),
    )


def rigid_sliding() -> Finding:
    """Eq. 35 where slip goes through compression, against quadrature and `rigid`."""
    return _rigid_gap(
        lambda slope, _: peak_force.eq_35_friction(slope, contact.FRICTION), (1.0, 1.7, 2.5)
    )


def compliance_reduces() -> Finding:
    r"""Smallest excess of the peak without tangential compliance over that with it, in $\mu$."""
    x = np.linspace(0, 8, 2001)
    return Finding(float(np.min(_rigid(x).peak_friction - _lumped(x).peak_friction)))


def restitution_immaterial() -> Finding:
    r"""Change of the peak of friction with $e$, $\omega > \Omega$."""
    x = np.linspace(0, 8, 401)
    e = np.linspace(0, 1, 21)[:, None]
    gaps = [np.ptp(lumped.rebound(x, *pair, e).peak_friction, axis=0) for pair in contact.PAIRS]
    return Finding(largest(gaps))


def in_compression() -> Finding:
    """Largest excess of the peak of friction over that of compression alone, $e = 0$."""
    x = np.linspace(0, 8, 401)
    e = np.linspace(0, 1, 21)[:, None]
    gaps = [
        lumped.rebound(x, *pair, e).peak_friction - lumped.rebound(x, *pair, 0.0).peak_friction
        for pair in contact.PAIRS
    ]
    return Finding(float(np.max(gaps)))


def late_stick() -> Finding:
    """Share of the incidences of slip, stick, slip ($e = 1$) whose stick begins after $t_c$."""
    beta, zeta2 = contact.SPHERE
    limit = float(lumped.slip_throughout_limit(beta, zeta2, 1.0))
    x = np.linspace(zeta2, limit, 202)[1:-1]
    starts = [contact.contact(value, samples=2).first(EventKind.STICK) for value in x]
    top = contact.contact(1.0, samples=2).compression_time
    return Finding(float(np.mean([state.t > top for state in starts])))


def velocity_at_stick() -> Finding:
    r"""Lowest $v_1(t_2)/(\mu v_2(0))$ over slip, stick, slip, $e = 1$, of those sampled.

    Negative means that the body has turned round.
    """
    lowest = min(
        impact.first(EventKind.STICK).v1 / impact.velocity_scale
        for impact in contact.slip_stick_slip((1.0,))
        if (impact.mass_ratio, impact.stiffness_ratio) == contact.SPHERE
    )
    return Finding(float(lowest))


def peak_after_stick() -> Finding:
    """Share of the incidences of slip, stick, slip ($e = 1$) with the peak before stick."""
    beta, zeta2 = contact.SPHERE
    limit = float(lumped.slip_throughout_limit(beta, zeta2, 1.0))
    shares = []
    for x in np.linspace(zeta2, limit, 102)[1:-1]:
        impact = contact.contact(x, samples=401)
        largest_at = impact.path.t[np.argmax(np.abs(impact.path.force_1))]
        shares.append(largest_at < impact.first(EventKind.STICK).t)
    return Finding(float(np.mean(shares)))


def simultaneous() -> Finding:
    """Distance of the instants of both peaks in slip throughout, in $t_c$."""
    gaps = []
    for impact in contact.slip_throughout():
        path = impact.path
        instants = path.t[path.force_1.argmax()], path.t[path.force_2.argmax()]
        gaps.append((instants[1] - instants[0]) / impact.compression_time)
    return Finding(largest(gaps))


def _angle_of_peak(friction: float, model: Callable[[Array], Rebound] = _lumped) -> float:
    return landmarks.peak(ANGLES, _forces(model, friction))


def peak_angle_small_friction() -> Finding:
    r"""Angle of the largest peak of friction, $\mu = 0.1$, in degrees."""
    return Finding(_angle_of_peak(0.1))


def peak_angle_large_friction() -> Finding:
    r"""Angle of the largest peak of friction, $\mu = 1$, in degrees."""
    return Finding(_angle_of_peak(1.0))


def peak_angle_lewis_rogers() -> Finding:
    r"""Angle of the largest peak of friction, $\mu = 0.18$, in degrees."""
    return Finding(_angle_of_peak(0.18))


def peak_angle_rises() -> Finding:
    r"""Smallest rise of the angle of the largest peak from one $\mu$ of Fig. 7 to the next.

    In degrees.
    """
    return Finding(float(np.min(np.diff([_angle_of_peak(mu) for mu in FRICTIONS]))))


def peak_at_intermediate_incidence() -> Finding:
    r"""Least distance of the incidence of the largest peak from $\zeta^2$ and $(1 + e) \beta$."""
    beta, zeta2 = contact.SPHERE
    x = np.array([np.tan(np.radians(_angle_of_peak(mu))) / mu for mu in FRICTIONS])
    return Finding(float(min((x - zeta2).min(), (2 * beta - x).min())))


def _reductions() -> Array:
    """How much less the largest peak is than without tangential compliance, one a friction."""
    shares = [1 - _forces(_lumped, mu).max() / _forces(_rigid, mu).max() for mu in FRICTIONS]
    return np.array(shares)


def largest_reduction() -> Finding:
    """Share by which tangential compliance makes the largest peak of friction smaller.

    The largest share over the frictions of Fig. 7.
    """
    return Finding(float(_reductions().max()))


def smallest_reduction() -> Finding:
    """Share by which tangential compliance makes the largest peak of friction smaller.

    The smallest share over the frictions of Fig. 7.
    """
    return Finding(float(_reductions().min()))


def peak_below_gross_slip() -> Finding:
    """Largest incidence of the largest peak, with tangential compliance and without."""
    incidences = [
        np.tan(np.radians(_angle_of_peak(mu, model))) / mu
        for model in (_lumped, _rigid)
        for mu in FRICTIONS
    ]
    return Finding(float(max(incidences)))


def compliance_immaterial() -> Finding:
    r"""Difference of both peaks from $x = \beta$ on, in $\mu$."""
    x = np.linspace(contact.MASS_RATIO, 20, 200)
    return Finding(largest([_lumped(x).peak_friction - _rigid(x).peak_friction]))


def full_friction_angle() -> Finding:
    r"""Angle from which peak friction is $\mu$ times the largest normal force; $\mu = 0.18$."""

    def below(angle: float) -> bool:
        return bool(_lumped(np.tan(np.radians(angle)) / 0.18).peak_friction < 1 - 1e-15)

    return Finding(boundary(below, 0.0, 80.0))


def ball_mass() -> Finding:
    """Mass of a steel ball of 25.4 mm and half as much for its holder, kg."""
    return Finding(1.5 * float(bodies.solid_sphere(0.0127, 7850.0).mass))


def _effect(
    model: Callable[[Array], Rebound],
    friction: float,
    base: Callable[[Array], Rebound] = _lumped,
) -> float:
    """Relative change of the largest peak of one mu from a model to another."""
    return abs(_forces(model, friction).max() / _forces(base, friction).max() - 1)


def _hertz(x: Array) -> Rebound:
    """Rebound of a Hertz contact; beyond 8 it slides throughout, where the peak is the same."""
    return contact.without_micro_slip(np.minimum(x, 8.0))


def normal_details() -> Finding:
    r"""Largest relative change of the largest peak, Hertz' normal compliance for linear."""
    return Finding(float(max(_effect(_hertz, mu) for mu in (0.1, 0.4, 1.0))))


def stiffness_matters_more() -> Finding:
    r"""Change of the largest peak from $\nu = 0$ to 0.5, over that by Hertz' compliance.

    $\zeta^2$ is 1 for $\nu = 0$ and 1.5 for 0.5. The smallest ratio for $\mu = 0.1$, 0.4 and 1.
    """

    def sphere(poisson_ratio: float) -> Callable[[Array], Rebound]:
        zeta2 = bodies.stiffness_ratio(bodies.Material(1.0, poisson_ratio))
        return lambda x: lumped.rebound(x, contact.MASS_RATIO, zeta2)

    frictions = (0.1, 0.4, 1.0)
    ratios = [_effect(sphere(0.5), mu, sphere(0.0)) / _effect(_hertz, mu) for mu in frictions]
    return Finding(float(min(ratios)))
