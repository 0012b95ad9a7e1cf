"""What the Conclusions alone say, p. 449."""

import numpy as np

from planarimpact import bodies, lumped, noncollinear
from planarimpact.common.results import EventKind
from stronge1994.paper import contact
from stronge1994.paper.contact import Gaps, NormalMotion, lumped_sphere
from stronge1994.paper.entry import entry
from stronge1994.paper.peak_force import Model, forces


def _effect(model: Model, friction: float, base: Model = lumped_sphere) -> float:
    """Relative change of the largest peak of one mu from a model to another."""
    return abs(forces(model, friction).max() / forces(base, friction).max() - 1)


@entry(
    "normal-details",
    "p. 449, Conclusions, 8th sentence",
    "The details of normal compliance hardly change the largest friction",
    at_most=0.1,
    holds=r"Over all angles the largest friction of the lumped model is larger by 0.06 % ($\mu = "
    r"0.1$) to 5.6 % ($\mu = 1$). At one small incidence it is larger by 9 %",
    reading="“Hardly” is read as by less than a tenth, for the largest friction over all angles, "
    "if Hertz' compliance takes the place of the linear one",
)
def normal_details() -> float:
    r"""Largest relative change of the largest peak of a $\mu$, Hertz' compliance for linear."""
    return max(_effect(contact.without_micro_slip, mu) for mu in (0.1, 0.4, 1.0))


@entry(
    "stiffness-matters-more",
    "p. 449, Conclusions, 9th sentence",
    r"For the largest friction the ratio $\zeta^2$ matters more than the details of normal "
    "compliance",
    at_least=1.0,
    reading=r"The sentence is judged for every $\mu$. The change with $\zeta^2$ from 1 ($\nu = 0$) "
    r"to 1.5 ($\nu = 0.5$), which are all elastic spheres, is compared with the change from the "
    r"linear compliance to Hertz'. From $\nu = 0.3$ to 0.5 alone $\zeta^2$ matters less for $\mu = "
    r"0.1$, 0.76 of the change that Hertz' compliance makes, and as much for $\mu = 1$",
)
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


def _not_harmonic(tilt: float) -> float:
    place = np.sin(np.radians(tilt)) / 2, np.cos(np.radians(tilt)) / 2
    rod = noncollinear.inverse_mass(1.0, 12**-0.5, *place)
    history = noncollinear.history(-0.5, 1.0, rod, friction=1.0, samples=2001)
    end = next(e.time for e in history.events if e.kind == EventKind.MAXIMUM_COMPRESSION)
    sticks = history.time <= end
    impulse = contact.cumulative(history.normal_force[sticks], history.time[sticks])
    # F2' = kappa v2 in compression: over each step, the second derivative over kappa, and F2.
    change, force = np.diff(history.normal[sticks]), np.diff(impulse)
    unexplained = change - force * (change @ force) / (force @ force)
    return float(np.linalg.norm(unexplained) / np.linalg.norm(change))


@entry(
    "noncollinear",
    "p. 449, Conclusions, 11th sentence",
    "In non-collinear impact the motions are coupled and not simple harmonic",
    at_least=0.05,
    only_if="the body does not approach in one of its two natural modes of stick",
    holds="The exception is a body that approaches in one of its two natural modes of stick, see "
    "formula-natural-frequencies",
    reading="A tilted rod is tried. “Not simple harmonic” is read so: while the rod sticks, even "
    "the best single frequency leaves more than a twentieth of the second derivative of $F_2$. It "
    "leaves 6 %, and nothing where the rod stands upright",
)
def noncollinear_stick() -> float:
    """Part of the second derivative of $F_2$ that no single frequency explains, root mean square.

    Over compression of a slender rod that sticks with its tip, $v_1/v_2 = -0.5$: tilted by 25°,
    less upright.
    """
    return _not_harmonic(25.0) - _not_harmonic(0.0)


@entry(
    "losses-decoupled",
    "p. 449, Conclusions, last sentence but three",
    "In the paper's model the energy that hysteresis dissipates and the energy that friction "
    "dissipates stay decoupled",
    at=lambda: contact.RESTITUTIONS,
    holds="This is right in collinear impact only. The tip of a slender rod, tilted by 45°, with "
    "$e = 0.5$ and $v_1 = v_2$, loses 15 % of its energy in the normal element without friction, "
    r"and 21 % with $\mu = 0.5$",
    reading="The sentence is judged for collinear impact, to which p. 438 limits the analysis. "
    "“Decoupled” is read so: the loss in the normal element does not depend on slip and stick. "
    "What friction takes does depend on $e$",
)
def losses_decoupled(e: float) -> Gaps:
    r"""Spread of the hysteresis over $m_2 v_2(0)^2/2$ with incidence and $\zeta^2$."""
    shares = []
    for x, zeta2 in ((0.3, 1.21), (2.0, 1.21), (8.0, 1.21), (2.0, 0.5)):
        motion = NormalMotion(x, contact.MASS_RATIO, zeta2, e, samples=2001)
        shares.append(-motion.work[-1] / (motion.m2 * motion.v2**2 / 2))
    yield np.ptp(shares)
