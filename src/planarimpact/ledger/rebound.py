"""Checks of what pp. 435 to 449 say of the order of stick and slip, and of the rebound."""

import numpy as np

from planarimpact import bodies, continuum, lumped, rigid
from planarimpact.ledger import contact
from planarimpact.ledger.finding import Finding, largest
from planarimpact.ledger.slip import boundary
from planarimpact.printed import slip
from planarimpact.results import EventKind, Regime

# Incidences of Figs 5 and 6, 0 left out.
INCIDENCE = np.linspace(0, 8, 2001)[1:]
# Solid spheres of nu = 0.3 and 0.5.
SPHERES = (contact.SPHERE, (3.5, 1.5))


def first_slip_in_restitution():
    """Earliest onset of slip after initial stick, in t_c, where omega > Omega."""
    return Finding(
        float(
            min(
                found.last(EventKind.SLIP).t / found.compression_time
                for found in contact.initial_stick()
            )
        )
    )


def deflection_when_slip_reverses():
    """Share of contacts with reversed last slip, s = +1, whose u1 is positive there."""
    found = [c for c in contact.initial_stick() if c.last_slip_direction > 0]
    return Finding(float(np.mean([c.last(EventKind.SLIP).u1 > 0 for c in found])))


def _largest_restitution_of_kept_direction(incidences):
    """Largest e at which the last slip runs in the incident direction, sphere of the paper."""

    def kept(e):
        return any(
            contact.contact(x, *contact.SPHERE, e, samples=2).last_slip_direction < 0
            for x in incidences
        )

    return boundary(kept, 0.01, 1.0)


def reversal_after_stick():
    """Largest e at which slip after initial stick does not reverse."""
    return Finding(_largest_restitution_of_kept_direction([0.1, 0.6, 1.2]))


def reversal_after_slip():
    """Largest e at which the second slip does not reverse."""
    return Finding(_largest_restitution_of_kept_direction([1.3, 2.0, 3.0, 3.499999]))


def three_sequences():
    """Share of impacts, omega/Omega from 1 to 6, whose last slip is not their second phase.

    Those are contacts that stick again, a fourth phase.
    """
    ratio = np.linspace(1.02, 6, 60)[:, None]
    x = np.linspace(0.01, 1, 60)
    beta = contact.SPHERE[0]
    found = lumped.rebound(2 * beta * x, beta, beta / ratio**2, 1.0)
    return Finding(float(np.mean(found.regime == Regime.MULTIPLE)))


def three_sequences_of_spheres():
    """The same share for omega/Omega of elastic spheres, and every e."""
    e = np.linspace(0, 1, 60)[:, None]
    x = np.linspace(0.01, 8, 200)
    share = [np.mean(lumped.rebound(x, b, z, e).regime == Regime.MULTIPLE) for b, z in SPHERES]
    return Finding(float(max(share)))


def sphere_mass_ratio():
    """m2/m1 of a solid sphere."""
    return Finding(float(bodies.mass_ratio(bodies.solid_sphere(0.01, 7800.0))))


def sphere_stiffness_ratio():
    """zeta^2 for nu = 0.3."""
    return Finding(float(bodies.stiffness_ratio(bodies.Material(2e11, 0.3))))


def rubber_stiffness_ratio():
    """zeta^2 for nu = 0.5."""
    return Finding(float(bodies.stiffness_ratio(bodies.Material(1e6, 0.5))))


def _frequency_ratio(poisson_ratio):
    beta = bodies.mass_ratio(bodies.solid_sphere(0.01, 7800.0))
    return float(np.sqrt(beta / bodies.stiffness_ratio(bodies.Material(2e11, poisson_ratio))))


def sphere_frequency_ratio():
    """omega/Omega of a solid sphere, nu = 0.3."""
    return Finding(_frequency_ratio(0.3))


def rubber_frequency_ratio():
    """omega/Omega of a solid sphere, nu = 0.5."""
    return Finding(_frequency_ratio(0.5))


def vanishing_compliance():
    """Distance of velocity and peak friction at zeta^2 = 1e-4 from the rigid limit."""
    x = INCIDENCE[::50]
    soft, hard = lumped.rebound(x, 3.5, 1e-4), rigid.rebound(x, 3.5)
    gaps = soft.velocity - hard.velocity, soft.peak_friction - hard.peak_friction
    return Finding(largest(gaps))


def transition_at_compression():
    """Time of stick in t_c at x = beta, where Eq. 21 changes its form."""
    gaps = []
    for beta, zeta2 in contact.PAIRS:
        found = contact.contact(beta, beta, zeta2, 1.0)
        gaps.append(found.first(EventKind.STICK).t / found.compression_time - 1)
    return Finding(largest(gaps))


def sliding_slows():
    """Gain of the particle's sliding speed over restitution, slip throughout with e = 0.5.

    The particle slides with v1 + du1/dt; du1/dt follows mu F2.
    """
    found = contact.contact(8.0, *contact.SPHERE, 0.5)
    groups = found.v2, found.m2, found.normal_frequency, found.restitution
    rate = slip.eq_20_normal_force_rate((1 + 0.5) * found.compression_time, *groups)
    particle = found.friction * rate * found.stiffness_ratio / found.stiffness
    before = found.first(EventKind.MAXIMUM_COMPRESSION).v1
    after = found.final_velocity + particle
    return Finding(float((after - before) / (found.friction * found.v2)))


def reversal_without_compliance():
    """Lowest rebound velocity without tangential compliance; reversal would be negative."""
    e = np.linspace(0, 1, 11)[:, None]
    lowest = rigid.rebound(INCIDENCE, contact.SPHERE[0], e).velocity.min()
    compliant = lumped.rebound(INCIDENCE, *contact.SPHERE, 1.0).velocity.min()
    return Finding(float(lowest) if compliant < 0 else np.nan)


def rigid_rebound_limit():
    """Incidence over (1 + e) beta above which the rigid limit leaves with velocity, less 1."""
    gaps = []
    for e in contact.RESTITUTIONS:
        limit = boundary(lambda x, e=e: rigid.rebound(x, 3.5, e).velocity == 0, 0.0, 20.0)
        gaps.append(limit / slip.slip_throughout_limit(3.5, e) - 1)
    return Finding(largest(gaps))


def unaffected_velocity():
    """Difference that tangential compliance makes to the velocity above the printed limit."""
    gaps = []
    for e in (0.0, *contact.RESTITUTIONS):
        x = slip.slip_throughout_limit(3.5, e) * np.array([1.0, 1.1, 3.0])
        gap = lumped.rebound(x, 3.5, 1.21, e).velocity - rigid.rebound(x, 3.5, e).velocity
        gaps.append(gap)
    return Finding(largest(gaps))


def _models_apart():
    """Incidences of Fig. 5, and distance of lumped model and continuum there."""
    exact = continuum.rebound(INCIDENCE, *contact.SPHERE, 1e-5).velocity
    return INCIDENCE, np.abs(lumped.rebound(INCIDENCE, *contact.SPHERE).velocity - exact)


def models_differ_most():
    """Largest distance of lumped model and continuum above 2 beta - zeta^2, over that below."""
    x, gap = _models_apart()
    limit = 2 * contact.SPHERE[0] - contact.SPHERE[1]
    return Finding(float(gap[x > limit].max() / gap[x <= limit].max()))


def practically_identical():
    """Largest distance of lumped model and continuum in v1(tf)/(mu v2(0))."""
    return Finding(float(_models_apart()[1].max()))


def identical_at_almost_all():
    """Share of incidences up to the printed limit, 7, where the models are within 0.05."""
    x, gap = _models_apart()
    return Finding(float(np.mean(gap[x <= 7] < 0.05)))


def mostly_reversed():
    """Share of small and intermediate incidence with reversed velocity, the smaller of both models.

    Up to the limit of slip throughout, 2 beta - zeta^2.
    """
    limit = 2 * contact.SPHERE[0] - contact.SPHERE[1]
    x = INCIDENCE[limit >= INCIDENCE]
    models = lumped.rebound(x, *contact.SPHERE), continuum.rebound(x, *contact.SPHERE, 1e-4)
    return Finding(float(min(np.mean(found.velocity < 0) for found in models)))


def early_micro_slip():
    """Longest share of the first quarter of an impact with a slipping annulus around stick.

    Elastic continuum, incidences below zeta^2.
    """
    shares = []
    for x in (0.1, 0.5, 1.0):
        found = continuum.history(x, *contact.SPHERE)
        early = (found.time > 0) & (found.time < 0.5)
        stick, edge = found.stick_radius[early], found.contact_radius[early]
        shares.append(np.mean((stick > 0) & (stick < 0.999 * edge)))
    return Finding(float(max(shares)))


def micro_slip():
    """Shortest share of an impact in which the continuum sticks inside a slipping annulus."""
    shares = []
    for x in (0.1, 0.5, 1.0):
        found = continuum.history(x, *contact.SPHERE)
        inside = (found.stick_radius > 0) & (found.stick_radius < 0.999 * found.contact_radius)
        shares.append(np.mean(inside))
    return Finding(float(min(shares)))


def continuum_reverses():
    """Lowest rebound velocity of the continuum and the lumped model, the higher of the two."""
    models = (
        lumped.rebound(INCIDENCE, *contact.SPHERE),
        continuum.rebound(INCIDENCE, *contact.SPHERE, 1e-4),
    )
    return Finding(float(max(found.velocity.min() for found in models)))


def limit_falls_with_losses():
    """Largest e below which more internal dissipation leaves the limit of slip throughout."""
    e = np.linspace(0, 1, 2001)
    limit = lumped.slip_throughout_limit(*contact.SPHERE, e)
    return Finding(float(e[np.flatnonzero(np.diff(limit) > 0)[0]]))


def compression_unaffected():
    """Change of the velocity at t_c with e."""
    gaps = []
    for x in (0.3, 1.0, 2.0, 3.3, 5.0, 9.0):
        ends = [
            contact.contact(x, restitution=e).first(EventKind.MAXIMUM_COMPRESSION).v1
            for e in contact.RESTITUTIONS
        ]
        gaps.append(np.ptp(ends) / (contact.FRICTION * contact.NORMAL_VELOCITY))
    return Finding(largest(gaps))


def restitution_change_falls():
    """Largest gain of |v1(tf) - v1(tc)|/(mu v2(0)) as e falls, sphere of the paper."""
    e = np.linspace(0, 1, 101)[:, None]
    velocity = lumped.rebound(INCIDENCE, *contact.SPHERE, e).velocity
    change = np.abs(velocity - velocity[0])
    # Largest change at any smaller e, less that at each e.
    return Finding(float(np.max(np.maximum.accumulate(change, axis=0) - change)))
