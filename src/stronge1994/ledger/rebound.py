"""Checks of what pp. 435 to 449 say of the order of stick and slip, and of the rebound."""

from collections.abc import Sequence
from functools import partial

import numpy as np

from planarimpact import bodies, continuum, lumped, rigid
from planarimpact.ground.arrays import Array
from planarimpact.ground.results import EventKind, Rebound, Regime
from planarimpact.models import laws
from stronge1994.ledger import contact
from stronge1994.ledger.finding import Finding, largest
from stronge1994.ledger.slip import boundary
from stronge1994.printed import slip

# Incidences of Figs 5 and 6, 0 left out.
INCIDENCE = np.linspace(0, 8, 2001)[1:]
# Solid spheres of nu = 0, 0.3 and 0.5.
SPHERES = tuple((contact.MASS_RATIO, zeta2) for zeta2 in (1.0, contact.STIFFNESS_RATIO, 1.5))


def first_slip_in_restitution() -> Finding:
    r"""Earliest onset of slip after initial stick of those sampled, in $t_c$.

    Where $\omega > \Omega$.
    """
    return Finding(
        float(
            min(
                impact.last(EventKind.SLIP).t / impact.compression_time
                for impact in contact.initial_stick()
            )
        )
    )


def deflection_when_slip_reverses() -> Finding:
    """Share of contacts with reversed last slip, $s = +1$, whose $u_1$ is positive as it begins."""
    impacts = [impact for impact in contact.initial_stick() if impact.last_slip_direction > 0]
    return Finding(float(np.mean([impact.last(EventKind.SLIP).u1 > 0 for impact in impacts])))


def _largest_restitution_of_kept_direction(incidences: Sequence[float]) -> float:
    """Largest e at which the last slip runs in the incident direction, sphere of the paper."""

    def kept(e: float) -> bool:
        return any(
            contact.contact(x, *contact.SPHERE, e, samples=2).last_slip_direction < 0
            for x in incidences
        )

    grid = np.linspace(0, 1, 51)[1:]
    last = max((e for e in grid if kept(e)), default=0.0)
    return boundary(kept, float(last), 1.0) if last else 0.0


def reversal_after_stick() -> Finding:
    """Largest $e$ at which slip after initial stick does not reverse, sphere of the paper.

    The largest of those sampled, incidences 0.1, 0.6 and 1.2.
    """
    return Finding(_largest_restitution_of_kept_direction([0.1, 0.6, 1.2]))


def reversal_after_slip() -> Finding:
    """Largest $e$ at which the second slip does not reverse, sphere of the paper.

    The largest of those sampled, incidences 1.3, 2, 3 and just below 3.5.
    """
    return Finding(_largest_restitution_of_kept_direction([1.3, 2.0, 3.0, 3.499999]))


def three_sequences() -> Finding:
    r"""Share of the impacts sampled whose second slip does not last: they stick and slip again.

    Over $\omega/\Omega$ from 1 to 6 and incidence up to $2 m_2/m_1$, at $e = 1$.
    """
    ratio = np.linspace(1.02, 6, 60)[:, None]
    x = np.linspace(0.01, 1, 60)
    beta = contact.MASS_RATIO
    rebound = lumped.rebound(2 * beta * x, beta, beta / ratio**2, 1.0)
    return Finding(float(np.mean(rebound.regime == Regime.MULTIPLE)))


def three_sequences_of_spheres() -> Finding:
    """Share of the impacts on elastic spheres whose second slip does not last to separation."""
    e = np.linspace(0, 1, 60)[:, None]
    x = np.linspace(0.01, 8, 200)
    share = [np.mean(lumped.rebound(x, b, z, e).regime == Regime.MULTIPLE) for b, z in SPHERES]
    return Finding(float(max(share)))


def sphere_mass_ratio() -> Finding:
    """$m_2/m_1$ of a solid sphere."""
    return Finding(float(bodies.mass_ratio(bodies.solid_sphere(0.01, 7800.0))))


def sphere_stiffness_ratio() -> Finding:
    r"""$\zeta^2$ for $\nu = 0.3$."""
    return Finding(float(bodies.stiffness_ratio(bodies.Material(2e11, 0.3))))


def rubber_stiffness_ratio() -> Finding:
    r"""$\zeta^2$ for $\nu = 0.5$."""
    return Finding(float(bodies.stiffness_ratio(bodies.Material(1e6, 0.5))))


def _frequency_ratio(poisson_ratio: float) -> float:
    beta = bodies.mass_ratio(bodies.solid_sphere(0.01, 7800.0))
    return float(np.sqrt(beta / bodies.stiffness_ratio(bodies.Material(2e11, poisson_ratio))))


def sphere_frequency_ratio() -> Finding:
    r"""$\omega/\Omega$ of a solid sphere, $\nu = 0.3$."""
    return Finding(_frequency_ratio(0.3))


def rubber_frequency_ratio() -> Finding:
    r"""$\omega/\Omega$ of a solid sphere, $\nu = 0.5$."""
    return Finding(_frequency_ratio(0.5))


def smallest_frequency_ratio() -> Finding:
    r"""Smallest $\omega/\Omega$ of solid spheres, thin shells and discs, $\nu$ from 0 to 0.5."""
    shapes = bodies.solid_sphere(0.01, 7800.0), bodies.thin_shell(1.0, 1.0), bodies.disc(1.0, 1.0)
    beta = min(float(bodies.mass_ratio(body)) for body in shapes)
    nu = np.linspace(0, 0.5, 51)
    zeta2 = bodies.stiffness_ratio(bodies.Material(2e11, nu))
    return Finding(float(np.sqrt(beta / zeta2.max())))


def vanishing_compliance() -> Finding:
    r"""Distance of velocity and peak friction at $\zeta^2 = 10^{-4}$ from the rigid limit."""
    x = INCIDENCE[::50]
    soft, hard = lumped.rebound(x, contact.MASS_RATIO, 1e-4), rigid.rebound(x, contact.MASS_RATIO)
    gaps = soft.velocity - hard.velocity, soft.peak_friction - hard.peak_friction
    return Finding(largest(gaps))


def transition_at_compression() -> Finding:
    """Time of stick over $t_c$, less 1, at incidence $m_2/m_1$, $e = 0.9$ and 1."""
    gaps = []
    for beta, zeta2 in contact.PAIRS:
        for e in (0.9, 1.0):
            impact = contact.contact(beta, beta, zeta2, e)
            gaps.append(impact.first(EventKind.STICK).t / impact.compression_time - 1)
    return Finding(largest(gaps))


def sliding_slows() -> Finding:
    r"""Largest gain of the body's tangential speed from one instant to a later one.

    In $\mu |v_2(0)|$. Slip throughout above $(1 + e) \beta$, up to the separation that
    `lumped.rebound` finds.
    """
    gains = []
    for impact in contact.slip_throughout():
        speed = np.append(impact.path.v1, impact.final_velocity) / impact.velocity_scale
        gains.append(np.diff(np.abs(speed)).max())
    return Finding(float(max(gains)))


def reversal_without_compliance() -> Finding:
    r"""Lowest velocity at separation without tangential compliance; reversed is negative.

    The lower one of the rigid limit and of the lumped model with $\zeta^2 = 10^{-4}$.
    """
    x, e = INCIDENCE[::10], np.linspace(0, 1, 6)[:, None]
    models = (
        rigid.rebound(x, contact.MASS_RATIO, restitution=e),
        lumped.rebound(x, contact.MASS_RATIO, 1e-4, e),
    )
    return Finding(float(min(rebound.velocity.min() for rebound in models)))


def _halts(e: float, x: float) -> bool:
    return bool(rigid.rebound(x, contact.MASS_RATIO, restitution=e).velocity == 0)


def rigid_rebound_limit() -> Finding:
    """Incidence above which the rigid limit leaves with velocity, over the impulse it takes.

    The impulse is $m_2/m_1$ times the exact normal impulse by quadrature, which Eq. 26 has as
    $(1 + e) p(t_c)$.
    """
    gaps, beta = [], contact.MASS_RATIO
    for e in contact.RESTITUTIONS:
        limit = boundary(partial(_halts, e), 0.0, 20.0)
        motion = contact.normal_motion(e)
        impulse = motion.impulse[-1] / (-motion.impact.m2 * motion.impact.v2)
        gaps += [
            limit / (beta * impulse) - 1,
            limit / slip.slip_throughout_limit(beta, e) - 1,
        ]
    return Finding(largest(gaps))


def rigid_sequence() -> Finding:
    r"""Share of rigid contacts below $(1 + e) \beta$ that do not slip first and then stick."""
    e, beta = np.linspace(0, 1, 11)[:, None], contact.MASS_RATIO
    x = slip.slip_throughout_limit(beta, e) * np.linspace(0.001, 0.999, 50)
    return Finding(
        float(np.mean(rigid.rebound(x, beta, restitution=e).regime != Regime.SLIP_STICK))
    )


def unaffected_velocity() -> Finding:
    r"""Difference that tangential compliance makes to the velocity above $x = (1 + e) \beta$."""
    gaps, beta = [], contact.MASS_RATIO
    for e in (0.0, *contact.RESTITUTIONS):
        x = slip.slip_throughout_limit(beta, e) * np.array([1.0, 1.1, 3.0])
        gap = (
            lumped.rebound(x, *contact.SPHERE, e).velocity
            - rigid.rebound(x, beta, restitution=e).velocity
        )
        gaps.append(gap)
    return Finding(largest(gaps))


def _models_apart() -> tuple[Array, Array]:
    """Incidences of Fig. 5, and distance of lumped model and continuum there."""
    exact = contact.once(continuum.rebound, INCIDENCE, *contact.SPHERE, tolerance=1e-5).velocity
    return INCIDENCE, np.abs(lumped.rebound(INCIDENCE, *contact.SPHERE).velocity - exact)


def models_differ_most() -> Finding:
    """Largest distance of lumped model and continuum in slip throughout, over that below it."""
    x, gap = _models_apart()
    limit = 2 * contact.MASS_RATIO - contact.STIFFNESS_RATIO
    return Finding(float(gap[x > limit].max() / gap[x <= limit].max()))


def practically_identical() -> Finding:
    r"""Largest distance of lumped model and continuum in $v_1(t_f)/(\mu v_2(0))$."""
    return Finding(float(_models_apart()[1].max()))


def identical_at_almost_all() -> Finding:
    """Share of the angles 0 to 90° at which the models are within 0.05.

    The smallest over the frictions of Fig. 7.
    """
    angles = np.linspace(0, 90, 1802)[1:-1]
    x, gap = _models_apart()
    # Beyond 8 both slide throughout, and agree.
    shares = [
        np.mean(np.interp(np.tan(np.radians(angles)) / mu, x, gap, right=0.0) < 0.05)
        for mu in (0.1, 0.2, 0.4, 0.6, 0.8, 1.0)
    ]
    return Finding(float(min(shares)))


def last_slip_prolonged() -> Finding:
    """How much earlier the last slip begins in the lumped model than in the continuum, in $t_c$.

    The smallest lead at incidences 0.5, 1, 2 and 3; gross slip is meant.
    """
    leads = []
    for x in (0.5, 1.0, 2.0, 3.0):
        history = contact.once(continuum.history, x, *contact.SPHERE)
        whole = (history.stick_radius == 0) & (history.contact_radius > 0) & (history.time > 1)
        start = contact.contact(x).last(EventKind.SLIP).t / contact.contact(x).compression_time
        leads.append(history.time[whole][0] - start)
    return Finding(float(min(leads)))


def _both_models() -> tuple[Rebound, Rebound]:
    """Rebound of lumped model and continuum at the incidences of Fig. 5."""
    return (
        lumped.rebound(INCIDENCE, *contact.SPHERE),
        contact.once(continuum.rebound, INCIDENCE, *contact.SPHERE, tolerance=1e-4),
    )


def mostly_reversed() -> Finding:
    r"""Share of small and intermediate incidence with reversed velocity.

    The smaller of both models. Up to the limit of slip throughout, $2 \beta - \zeta^2$.
    """
    limit = 2 * contact.MASS_RATIO - contact.STIFFNESS_RATIO
    return Finding(
        float(min(np.mean(rebound.velocity[limit >= INCIDENCE] < 0) for rebound in _both_models()))
    )


def early_micro_slip() -> Finding:
    """Longest share of the first quarter of an impact with a slipping annulus around stick.

    Elastic continuum; the longest of those sampled, incidences 0.1, 0.5 and 1.
    """
    shares = []
    for x in (0.1, 0.5, 1.0):
        history = contact.once(continuum.history, x, *contact.SPHERE)
        early = (history.time > 0) & (history.time < 0.5)
        stick, edge = history.stick_radius[early], history.contact_radius[early]
        shares.append(np.mean((stick > 0) & (stick < 0.999 * edge)))
    return Finding(float(max(shares)))


def micro_slip() -> Finding:
    """Shortest share of an impact in which the continuum sticks inside a slipping annulus.

    Of those sampled, incidences 0.1, 0.5 and 1.
    """
    shares = []
    for x in (0.1, 0.5, 1.0):
        history = contact.once(continuum.history, x, *contact.SPHERE)
        inside = (history.stick_radius > 0) & (
            history.stick_radius < 0.999 * history.contact_radius
        )
        shares.append(np.mean(inside))
    return Finding(float(min(shares)))


def continuum_reverses() -> Finding:
    """Lowest rebound velocity of the continuum and the lumped model, the higher of the two."""
    return Finding(float(max(rebound.velocity.min() for rebound in _both_models())))


def limit_falls_with_losses() -> Finding:
    """Largest $e$ below which more internal dissipation leaves the limit of slip throughout."""
    e = np.linspace(0, 1, 2001)
    limit = lumped.slip_throughout_limit(*contact.SPHERE, e)
    return Finding(float(e[np.flatnonzero(np.diff(limit) > 0)[0]]))


def compression_unaffected() -> Finding:
    """Change of the velocity at $t_c$ with $e$."""
    gaps = []
    for x in (0.3, 1.0, 2.0, 3.3, 5.0, 9.0):
        ends = [
            contact.contact(x, restitution=e).first(EventKind.MAXIMUM_COMPRESSION).v1
            for e in contact.RESTITUTIONS
        ]
        gaps.append(np.ptp(ends) / (contact.FRICTION * contact.NORMAL_VELOCITY))
    return Finding(largest(gaps))


def restitution_change_falls() -> Finding:
    r"""Largest gain of $|v_1(t_f) - v_1(t_c)|/(\mu v_2(0))$ as $e$ falls, sphere of the paper."""
    e = np.linspace(0, 1, 101)[:, None]
    velocity = lumped.rebound(INCIDENCE, *contact.SPHERE, e).velocity
    change = np.abs(velocity - velocity[0])
    # Largest change at any smaller e, less that at each e.
    return Finding(float(np.max(np.maximum.accumulate(change, axis=0) - change)))


def other_laws() -> Finding:
    """Largest part of full friction that the laws of Bilbao, Smith and Brach lack, $x = 10^4$."""
    gaps = []
    for e in contact.RESTITUTIONS:
        others = [law(1e4, *contact.SPHERE, e).velocity for law in (laws.smith, laws.brach)]
        for velocity in (_bilbao(1e4, contact.MASS_RATIO, e), *others):
            gaps.append((1e4 - velocity) / contact.MASS_RATIO / (1 + e) - 1)
    return Finding(largest(gaps))


def _bilbao(x: float, mass_ratio: float, e: float) -> Array:
    """Velocity w = x - 2 x (1 - exp(-B/(2 x))), B = (1 + e) beta: our reconstruction.

    Stronge cites Bilbao et al. (1989) for a velocity ratio that is exponential in mu v2/v1, and
    prints no formula. This one is exponential in it and has both limits right: w = -x for small x,
    w = x - B for large x.
    """
    return x - 2 * (x * -np.expm1(-((1 + e) * mass_ratio / 2 / x)))
