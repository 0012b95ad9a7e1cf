"""What the Summary and the Introduction say, pp. 435 and 436."""

from collections.abc import Iterator

import numpy as np

from planarimpact import continuum, lumped, rigid
from planarimpact.common.arrays import Array
from planarimpact.continuum import ContinuumHistory
from planarimpact.models import laws
from stronge1994.paper import contact
from stronge1994.paper.contact import HARD, INCIDENCE, Gaps
from stronge1994.paper.entry import entry
from stronge1994.printed import equations


@entry(
    "compliance-reduces-friction",
    "p. 435, Summary, 4th sentence",
    "Tangential compliance makes the largest friction smaller",
    at_least=-1e-12,
    only_if=r"$v_1(0)/(\mu v_2(0)) < m_2/m_1$",
    holds=r"From $v_1(0)/(\mu v_2(0)) = m_2/m_1$ on, the largest friction is the same with "
    "tangential compliance and without",
)
def compliance_reduces() -> float:
    r"""Smallest excess of the peak without tangential compliance over that with it, in $\mu$."""
    x = np.linspace(0, 8, 2001)
    return float(
        np.min(contact.rigid_sphere(x).peak_friction - contact.lumped_sphere(x).peak_friction)
    )


@entry(
    "restitution-leaves-peak",
    "p. 435, Summary, 5th sentence; p. 445, 1st full sentence of the text; p. 449, Conclusions, "
    "6th sentence",
    "The coefficient of restitution has no effect on the largest friction",
    at=lambda: contact.PAIRS,
    only_if=r"$\omega > \Omega$",
    holds=r"This is right for $\omega > \Omega$, a condition that Summary and Conclusions leave "
    "out. In a continuum that is viscous or yields, the peak changes with $e$",
)
def restitution_immaterial(pair: tuple[float, float]) -> Gaps:
    r"""Change of the peak of friction with $e$, $\omega > \Omega$.

    From $e = 0$ on, where there is compression alone.
    """
    x, e = np.linspace(0, 8, 401), np.linspace(0, 1, 21)[:, None]
    yield np.ptp(lumped.rebound(x, *pair, e).peak_friction, axis=0)


ANGLES = np.linspace(0.0, 89.95, 17991)[1:]  # degrees


def dissipated(friction: float, restitution: float) -> Array:
    """Share of m2 S^2/2 that friction takes at each of ANGLES."""
    theta = np.radians(ANGLES)
    lost = lumped.rebound(np.tan(theta) / friction, *contact.SPHERE, restitution).dissipation
    return 2 * (friction * np.cos(theta)) ** 2 * lost


@entry(
    "dissipation-limited-by-restitution",
    "p. 435, Summary, 5th sentence",
    "The coefficient of restitution limits what friction can dissipate",
    at_least=0.0,
    only_if="the largest share over all angles is meant",
    holds="This is right for the largest share over all angles. At one incidence friction can "
    "dissipate more if restitution is less",
)
def limited_by_restitution() -> float:
    """Smallest gain of the largest share dissipated from one $e$ to the next larger."""
    shares = [
        [dissipated(mu, e).max() for e in np.linspace(0, 1, 11)] for mu in (0.1, 0.3, 0.5, 1.0)
    ]
    return float(np.min(np.diff(shares, axis=1)))


@entry(
    "velocity-unaffected-in-slip",
    "p. 435, Summary, 3rd sentence",
    "Tangential compliance changes the velocities unless slip is continuous",
    at=lambda: (0.0, *contact.RESTITUTIONS),
    holds=r"This is right from $v_1(0)/(\mu v_2(0)) = (1 + e) m_2/m_1$ on, the paper's range of "
    "gross slip. Between the corrected limit, see slip-throughout-limit, and the printed one, the "
    "contact slides throughout, but tangential compliance turns the contact point round",
)
def compliance_immaterial(e: float) -> Gaps:
    r"""What tangential compliance changes in velocity and dissipation above $x = (1 + e) \beta$."""
    x = equations.slip_throughout_limit(contact.MASS_RATIO, e) * np.array([1.0, 1.1, 3.0])
    soft = lumped.rebound(x, *contact.SPHERE, e)
    hard = rigid.rebound(x, contact.MASS_RATIO, restitution=e)
    yield soft.velocity - hard.velocity
    yield soft.dissipation / hard.dissipation - 1


entry(
    "impulse-stresses",
    "p. 435, Introduction, 2nd and 4th sentence",
    "A hammer exerts several tons. Stresses fall off with the square of the distance from the "
    "contact",
    verdict="not testable",
    why="Neither forces of tools nor stresses away from the contact are modelled here",
)


def continuum_histories(*incidences: float) -> Iterator[ContinuumHistory]:
    """Impacts of the elastic continuum."""
    return (contact.once(continuum.history, x, *contact.SPHERE) for x in incidences)


def annulus_slips(until: float) -> list[float]:
    """Shares of the times up to `until` with a slipping annulus around stick, by incidence."""
    shares = []
    for history in continuum_histories(0.1, 0.5, 1.0):
        stick, edge = history.stick_radius, history.contact_radius
        slips = (stick > 0) & (stick < 0.999 * edge)
        shares.append(float(np.mean(slips[history.time < until])))
    return shares


@entry(
    "micro-slip-annulus",
    "p. 435, Introduction, 12th and 13th sentence, the 5th and 4th from the foot of the page",
    "Maw et al. found an outer annulus that slips around a centre that sticks",
    at_least=0.05,
    reading="The annulus must be there during a twentieth of the impact at least",
)
def micro_slip() -> float:
    """Shortest share of an impact in which the continuum sticks inside a slipping annulus.

    Of those sampled, incidences 0.1, 0.5 and 1.
    """
    return min(annulus_slips(np.inf))


def velocities() -> list[Array]:
    """Rebound velocities of lumped model and continuum at the incidences of Fig. 5."""
    exact = contact.once(continuum.rebound, INCIDENCE, *contact.SPHERE, tolerance=1e-5)
    return [lumped.rebound(INCIDENCE, *contact.SPHERE).velocity, exact.velocity]


@entry(
    "slip-can-reverse",
    "p. 435, Introduction, 15th sentence, the last but one of the page; p. 449, Conclusions, 3rd "
    "sentence",
    "If the incidence is small, tangential compliance can turn the contact point round, in the "
    "lumped model and in the continuum",
    at_most=0.0,
)
def continuum_reverses() -> float:
    """Lowest rebound velocity of the continuum and the lumped model, the higher of the two."""
    return float(max(velocity.min() for velocity in velocities()))


@entry(
    "no-reversal-without-compliance",
    "p. 435, last sentence; p. 444, Tangential velocity at separation, 6th sentence; p. 446, "
    "Maximum friction for negligible tangential compliance, 2nd sentence",
    "In collinear impact only tangential compliance turns the contact point round",
    at_least=-0.02,
    reading=r"In the lumped model $\zeta^2 = 10^{-4}$ stands for no tangential compliance. The "
    r"velocity that is left, $0.018 \mu v_2(0)$, has the size of $\sqrt{\zeta^2 m_2/m_1}$",
)
def reversal_without_compliance() -> float:
    r"""Lowest velocity at separation without tangential compliance; reversed is negative.

    The lower one of the rigid limit and of the lumped model with $\zeta^2 = 10^{-4}$.
    """
    x, e, beta = INCIDENCE[::10], np.linspace(0, 1, 6)[:, None], contact.MASS_RATIO
    rebounds = rigid.rebound(x, beta, restitution=e), lumped.rebound(x, beta, HARD, e)
    return float(min(rebound.velocity.min() for rebound in rebounds))


def _bilbao(x: float, mass_ratio: float, e: float) -> np.float64:
    """Velocity w = x - 2 x (1 - exp(-B/(2 x))), B = (1 + e) beta: our reconstruction.

    Stronge cites Bilbao et al. (1989) for a velocity ratio that is exponential in mu v2/v1, and
    prints no formula. This one is exponential in it and has both limits right: w = -x for small x,
    w = x - B for large x.
    """
    return x - 2 * (x * -np.expm1(-((1 + e) * mass_ratio / 2 / x)))


@entry(
    "other-laws",
    "p. 436, 5th sentence from the top of the page",
    "The laws of Bilbao, Smith and Brach tend to full friction at large incidence",
    at=lambda: contact.RESTITUTIONS,
    at_most=0.001,
    holds="This was tried at $x = 10^4$ with $e$ from 0 to 1. Bilbao's law is our reconstruction, "
    "as the paper gives no formulas",
    reading=r"Friction is full where the tangential impulse is $\mu$ times the normal impulse",
)
def other_laws(e: float) -> Gaps:
    """Largest part of full friction that Bilbao's, Smith's and Brach's laws lack at $x = 10^4$."""
    others = [law(1e4, *contact.SPHERE, e).velocity for law in (laws.smith, laws.brach)]
    for velocity in (_bilbao(1e4, contact.MASS_RATIO, e), *others):
        yield (1e4 - velocity) / contact.MASS_RATIO / (1 + e) - 1


entry(
    "agreement-with-measurements",
    "p. 436, last sentence but one of the Introduction; p. 447, Comparison with measurement, 10th "
    "sentence",
    "The velocities agree with Maw et al. (1981), and the forces with Lewis and Rogers",
    verdict="not testable",
    why="The measurements are not at hand. Their comparisons wait for points",
)
