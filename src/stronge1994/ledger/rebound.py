"""Checks of what pp. 435 to 449 say of the order of stick and slip, and of the rebound."""

from collections.abc import Iterator, Sequence

import numpy as np

from planarimpact import bodies, continuum, lumped, rigid
from planarimpact.common.arrays import Array
from planarimpact.common.results import Regime
from planarimpact.continuum import ContinuumHistory
from planarimpact.models import laws
from stronge1994.ledger import contact
from stronge1994.ledger.contact import ELASTIC_LIMIT, HARD, INCIDENCE, Contact, boundary
from stronge1994.ledger.finding import Gaps, largest, over
from stronge1994.printed import slip

# Solid spheres of nu = 0, 0.3 and 0.5.
SPHERES = tuple((contact.MASS_RATIO, zeta2) for zeta2 in (1.0, contact.STIFFNESS_RATIO, 1.5))


def first_slip_in_restitution() -> float:
    r"""Earliest onset of slip after initial stick, in $t_c$, where $\omega > \Omega$."""
    onsets = [impact.t1 / impact.compression_time for impact in contact.initial_stick()]
    return float(min(onsets))


def deflection_when_slip_reverses() -> float:
    """Share of contacts with reversed last slip, $s = +1$, whose $u_1$ is positive as it begins."""
    positive = [impact.onset.u1 > 0 for impact in contact.reversed_after_stick()]
    return float(np.mean(positive))


def largest_restitution_of_kept_direction(incidences: Sequence[float]) -> float:
    """Largest $e$ at which the last slip runs in the incident direction, sphere of the paper.

    The largest of those sampled, incidences {incidences}.
    """

    def kept(e: float) -> bool:
        return any(Contact(x, restitution=e, samples=2).slip_direction < 0 for x in incidences)

    grid = np.linspace(0, 1, 51)[1:]
    last = max((e for e in grid if kept(e)), default=0.0)
    return boundary(kept, float(last), 1.0) if last else 0.0


def three_sequences() -> float:
    r"""Share of the impacts sampled whose second slip does not last: they stick and slip again.

    Over $\omega/\Omega$ from 1 to 6 and incidence up to $2 m_2/m_1$, at $e = 1$.
    """
    ratio = np.linspace(1.02, 6, 60)[:, None]
    x = np.linspace(0.01, 1, 60)
    beta = contact.MASS_RATIO
    rebound = lumped.rebound(2 * beta * x, beta, beta / ratio**2, 1.0)
    return float(np.mean(rebound.regime == Regime.MULTIPLE))


def three_sequences_of_spheres() -> float:
    """Share of the impacts on elastic spheres whose second slip does not last to separation."""
    e = np.linspace(0, 1, 60)[:, None]
    x = np.linspace(0.01, 8, 200)
    share = [np.mean(lumped.rebound(x, b, z, e).regime == Regime.MULTIPLE) for b, z in SPHERES]
    return float(max(share))


def mass_ratio() -> float:
    """$m_2/m_1$ of a solid sphere."""
    return float(bodies.mass_ratio(bodies.solid_sphere(0.01, 7800.0)))


def stiffness_ratio(poisson_ratio: float) -> float:
    r"""$\zeta^2$ for $\nu = {poisson_ratio}$."""
    return float(bodies.stiffness_ratio(bodies.Material(2e11, poisson_ratio)))


def frequency_ratio(poisson_ratio: float) -> float:
    r"""$\omega/\Omega$ of a solid sphere, $\nu = {poisson_ratio}$."""
    return (mass_ratio() / stiffness_ratio(poisson_ratio)) ** 0.5


def smallest_frequency_ratio() -> float:
    r"""Smallest $\omega/\Omega$ of solid spheres, thin shells and discs, $\nu$ from 0 to 0.5."""
    shapes = bodies.solid_sphere(0.01, 7800.0), bodies.thin_shell(1.0, 1.0), bodies.disc(1.0, 1.0)
    beta = min(float(bodies.mass_ratio(body)) for body in shapes)
    zeta2 = bodies.stiffness_ratio(bodies.Material(2e11, np.linspace(0, 0.5, 51)))
    return float(np.sqrt(beta / zeta2.max()))


def vanishing_compliance() -> float:
    r"""Distance of velocity and peak friction at $\zeta^2 = 10^{-4}$ from the rigid limit."""
    x, beta = INCIDENCE[::50], contact.MASS_RATIO
    soft, hard = lumped.rebound(x, beta, HARD), rigid.rebound(x, beta)
    return largest([soft.velocity - hard.velocity, soft.peak_friction - hard.peak_friction])


@over(lambda: contact.PAIRS)
def transition_at_compression(pair: tuple[float, float]) -> Gaps:
    """Time of stick over $t_c$, less 1, at incidence $m_2/m_1$, $e = 0.9$ and 1."""
    for e in (0.9, 1.0):
        impact = Contact(pair[0], *pair, e)
        yield impact.t2 / impact.compression_time - 1


def sliding_slows() -> float:
    r"""Largest later gain of the body's tangential speed, in $\mu |v_2(0)|$.

    Slip throughout above $(1 + e) \beta$, up to the separation that `lumped.rebound` finds.
    """
    gains = []
    for impact in contact.slip_throughout():
        speed = np.append(impact.path.v1, impact.final) / impact.velocity_scale
        gains.append(np.diff(np.abs(speed)).max())
    return float(max(gains))


def reversal_without_compliance() -> float:
    r"""Lowest velocity at separation without tangential compliance; reversed is negative.

    The lower one of the rigid limit and of the lumped model with $\zeta^2 = 10^{-4}$.
    """
    x, e, beta = INCIDENCE[::10], np.linspace(0, 1, 6)[:, None], contact.MASS_RATIO
    rebounds = rigid.rebound(x, beta, restitution=e), lumped.rebound(x, beta, HARD, e)
    return float(min(rebound.velocity.min() for rebound in rebounds))


@over(contact.normal_motions)
def rigid_rebound_limit(motion: contact.NormalMotion) -> Gaps:
    """Incidence above which the rigid limit leaves with velocity, over the impulse it takes.

    The impulse is $m_2/m_1$ times the exact normal impulse by quadrature, which Eq. 26 has as
    $(1 + e) p(t_c)$.
    """

    def halts(x: float) -> bool:
        rebound = rigid.rebound(x, motion.mass_ratio, restitution=motion.restitution)
        return bool(rebound.velocity == 0)

    limit = boundary(halts, 0.0, 20.0)
    impulse = motion.brought[-1] / motion.compression_impulse
    yield limit / (motion.mass_ratio * impulse) - 1
    yield limit / motion.printed(slip.slip_throughout_limit) - 1


def rigid_sequence() -> float:
    r"""Share of rigid contacts below $(1 + e) \beta$ that do not slip first and then stick."""
    e, beta = np.linspace(0, 1, 11)[:, None], contact.MASS_RATIO
    x = slip.slip_throughout_limit(beta, e) * np.linspace(0.001, 0.999, 50)
    regime = rigid.rebound(x, beta, restitution=e).regime
    return float(np.mean(regime != Regime.SLIP_STICK))


def _velocities() -> list[Array]:
    """Rebound velocities of lumped model and continuum at the incidences of Fig. 5."""
    exact = contact.once(continuum.rebound, INCIDENCE, *contact.SPHERE, tolerance=1e-5)
    return [lumped.rebound(INCIDENCE, *contact.SPHERE).velocity, exact.velocity]


def _models_apart() -> Array:
    """Distance of lumped model and continuum at the incidences of Fig. 5."""
    ours, exact = _velocities()
    return np.abs(ours - exact)


def models_differ_most() -> float:
    """Largest distance of lumped model and continuum in slip throughout, over that below it."""
    gap, slides = _models_apart(), INCIDENCE > ELASTIC_LIMIT
    return float(gap[slides].max() / gap[~slides].max())


def practically_identical() -> float:
    r"""Largest distance of lumped model and continuum in $v_1(t_f)/(\mu v_2(0))$."""
    return float(_models_apart().max())


def identical_at_almost_all() -> float:
    """Share of the angles 0 to 90° at which the models are within 0.05.

    The smallest over the frictions of Fig. 7.
    """
    slope, gap = np.tan(np.radians(np.linspace(0, 90, 1802)[1:-1])), _models_apart()
    # Beyond 8 both slide throughout, and agree.
    shares = [
        np.mean(np.interp(slope / mu, INCIDENCE, gap, right=0.0) < 0.05)
        for mu in (0.1, 0.2, 0.4, 0.6, 0.8, 1.0)
    ]
    return float(min(shares))


def _continuum_histories(*incidences: float) -> Iterator[ContinuumHistory]:
    return (contact.once(continuum.history, x, *contact.SPHERE) for x in incidences)


def last_slip_prolonged() -> float:
    """How much earlier the last slip begins in the lumped model than in the continuum, in $t_c$.

    The smallest lead at incidences 0.5, 1, 2 and 3; gross slip is meant.
    """
    leads, incidences = [], (0.5, 1.0, 2.0, 3.0)
    for x, history in zip(incidences, _continuum_histories(*incidences), strict=True):
        whole = (history.stick_radius == 0) & (history.contact_radius > 0) & (history.time > 1)
        leads.append(history.time[whole][0] - Contact(x).t1 / Contact.compression_time)
    return float(min(leads))


def mostly_reversed() -> float:
    r"""Share of small and intermediate incidence with reversed velocity, of the smaller model.

    Up to the limit of slip throughout, $2 \beta - \zeta^2$.
    """
    shares = [np.mean(velocity[INCIDENCE <= ELASTIC_LIMIT] < 0) for velocity in _velocities()]
    return float(min(shares))


def continuum_reverses() -> float:
    """Lowest rebound velocity of the continuum and the lumped model, the higher of the two."""
    return float(max(velocity.min() for velocity in _velocities()))


def _annulus_slips(until: float) -> list[float]:
    """Shares of the times up to `until` with a slipping annulus around stick, by incidence."""
    shares = []
    for history in _continuum_histories(0.1, 0.5, 1.0):
        stick, edge = history.stick_radius, history.contact_radius
        slips = (stick > 0) & (stick < 0.999 * edge)
        shares.append(float(np.mean(slips[history.time < until])))
    return shares


def early_micro_slip() -> float:
    """Longest share of the first quarter of an impact with a slipping annulus around stick.

    Elastic continuum; the longest of those sampled, incidences 0.1, 0.5 and 1.
    """
    return max(_annulus_slips(0.5))


def micro_slip() -> float:
    """Shortest share of an impact in which the continuum sticks inside a slipping annulus.

    Of those sampled, incidences 0.1, 0.5 and 1.
    """
    return min(_annulus_slips(np.inf))


def limit_falls_with_losses() -> float:
    """Largest $e$ below which more internal dissipation leaves the limit of slip throughout."""
    e = np.linspace(0, 1, 2001)
    limit = lumped.slip_throughout_limit(*contact.SPHERE, e)
    return float(e[np.flatnonzero(np.diff(limit) > 0)[0]])


def restitution_change_falls() -> float:
    r"""Largest gain of $|v_1(t_f) - v_1(t_c)|/(\mu v_2(0))$ as $e$ falls, sphere of the paper."""
    e = np.linspace(0, 1, 101)[:, None]
    velocity = lumped.rebound(INCIDENCE, *contact.SPHERE, e).velocity
    change = np.abs(velocity - velocity[0])
    # Largest change at any smaller e, less that at each e.
    return float(np.max(np.maximum.accumulate(change, axis=0) - change))


@over(lambda: contact.RESTITUTIONS)
def other_laws(e: float) -> Gaps:
    """Largest part of full friction that Bilbao's, Smith's and Brach's laws lack at $x = 10^4$."""
    others = [law(1e4, *contact.SPHERE, e).velocity for law in (laws.smith, laws.brach)]
    for velocity in (_bilbao(1e4, contact.MASS_RATIO, e), *others):
        yield (1e4 - velocity) / contact.MASS_RATIO / (1 + e) - 1


def _bilbao(x: float, mass_ratio: float, e: float) -> Array:
    """Velocity w = x - 2 x (1 - exp(-B/(2 x))), B = (1 + e) beta: our reconstruction.

    Stronge cites Bilbao et al. (1989) for a velocity ratio that is exponential in mu v2/v1, and
    prints no formula. This one is exponential in it and has both limits right: w = -x for small x,
    w = x - B for large x.
    """
    return x - 2 * (x * -np.expm1(-((1 + e) * mass_ratio / 2 / x)))
