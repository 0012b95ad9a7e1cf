"""Tangential velocity at separation, p. 444, with what p. 449 says of it."""

import numpy as np

from planarimpact import lumped, rigid
from planarimpact.common.arrays import Array
from stronge1994.paper import contact
from stronge1994.paper.contact import ELASTIC_LIMIT, INCIDENCE, Contact, Gaps, boundary
from stronge1994.paper.entry import entry
from stronge1994.paper.introduction import continuum_histories, velocities
from stronge1994.printed import equations


@entry(
    "rigid-rebound-limit",
    "p. 444, Tangential velocity at separation, 8th sentence",
    "Without tangential compliance the contact point leaves with a tangential velocity only above "
    "the incidence $(1 + e) m_2/m_1$",
    at=contact.normal_motions,
)
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
    yield limit / motion.printed(equations.slip_throughout_limit) - 1


@entry(
    "last-slip-prolonged",
    "p. 444, Tangential velocity at separation, 4th sentence",
    "Strain energy makes the last slip of the lumped model last longer than that of the continuum",
    at_least=0.0,
    reading="“Lasts longer” is read as “begins earlier”. The last slip of the continuum is its "
    "gross slip, not its micro-slip",
)
def last_slip_prolonged() -> float:
    """How much earlier the last slip begins in the lumped model than in the continuum, in $t_c$.

    The smallest lead at incidences 0.5, 1, 2 and 3; gross slip is meant.
    """
    leads, incidences = [], (0.5, 1.0, 2.0, 3.0)
    for x, history in zip(incidences, continuum_histories(*incidences), strict=True):
        whole = (history.stick_radius == 0) & (history.contact_radius > 0) & (history.time > 1)
        leads.append(history.time[whole][0] - Contact(x).t1 / Contact.compression_time)
    return float(min(leads))


def _models_apart() -> Array:
    """Distance of lumped model and continuum at the incidences of Fig. 5."""
    ours, exact = velocities()
    return np.abs(ours - exact)


@entry(
    "models-differ-most",
    "p. 444, Tangential velocity at separation, 4th sentence",
    "Lumped model and continuum differ most at small and intermediate incidence",
    at_most=0.01,
    reading="“Most” is read as more than a hundred times as much as in slip throughout",
)
def models_differ_most() -> float:
    """Largest distance of lumped model and continuum in slip throughout, over that below it."""
    gap, slides = _models_apart(), INCIDENCE > ELASTIC_LIMIT
    return float(gap[slides].max() / gap[~slides].max())


@entry(
    "mostly-reversed",
    "p. 444, Tangential velocity at separation, 5th sentence",
    "Over most of small and intermediate incidence, lumped model and continuum leave with the "
    "velocity turned round",
    at_least=0.5,
    reading=r"Most of the range of incidence is meant. By angle it is less, 32 % at $\mu = 1$",
)
def mostly_reversed() -> float:
    r"""Share of small and intermediate incidence with reversed velocity, of the smaller model.

    Up to the limit of slip throughout, $2 \beta - \zeta^2$.
    """
    shares = [np.mean(velocity[INCIDENCE <= ELASTIC_LIMIT] < 0) for velocity in velocities()]
    return float(min(shares))


@entry(
    "practically-identical",
    "p. 444, Tangential velocity at separation, 7th sentence",
    "Lumped model and continuum hardly differ in nearly anything",
    at_most=0.05,
    verdict="wrong",
    grade="matter of judgement",
    cause="lumped-and-continuum",
    explorer={"angle": 31.2, "friction": 0.5, "restitution": 1, "view": "velocity"},
    correction=r"The models differ by up to $0.215 \mu v_2(0)$, at $v_1(0)/(\mu v_2(0)) = "
    r"\zeta^2$. This is an eighth of the largest reversed velocity",
    derivation="Two differences of the models partly cancel: Hertz' compliance without micro-slip "
    r"would raise the velocity of the lumped model by up to $0.39 \mu v_2(0)$, and micro-slip "
    r"lowers it by up to $0.52 \mu v_2(0)$, see micro-slip-insignificant. The continuum itself is "
    r"known to $5 \times 10^{-5} \mu v_2(0)$ from two methods (comparison fig5-continuum-maw and "
    "comparison fig5-continuum-rubber-maw).",
    holds=r"The models agree on the limits of gross slip, and within $0.02 \mu v_2(0)$ above "
    r"$v_1(0)/(\mu v_2(0)) = 3.5$",
    reading="The sentence is judged by the largest difference of the velocities at separation, "
    r"$0.215 \mu v_2(0)$. “Identical” is read as within $0.05 \mu v_2(0)$, which can be told apart "
    r"in Fig. 5. Whoever allows $0.22 \mu v_2(0)$, or 3 % of the range of Fig. 5, finds the "
    "sentence true. In kind the models are alike: they have the same three sequences and the same "
    "limit of gross slip. The same paragraph says that the models differ most at small and "
    "intermediate angles, see models-differ-most; read together with that, the sentence claims "
    "less",
)
def practically_identical() -> float:
    r"""Largest distance of lumped model and continuum in $v_1(t_f)/(\mu v_2(0))$."""
    return float(_models_apart().max())


@entry(
    "identical-at-almost-all",
    "p. 449, Conclusions, 1st sentence",
    "At nearly every angle lumped model and continuum respond alike",
    at_least=0.9,
    verdict="wrong",
    grade="matter of judgement",
    cause="lumped-and-continuum",
    correction=r"The models agree within $0.05 \mu v_2(0)$ at 85 % of the angles for $\mu = 0.1$, "
    r"72 % for $\mu = 0.2$, 47 % for $\mu = 0.5$ and 33 % for $\mu = 1$. They differ by more for "
    r"$0.15 < v_1(0)/(\mu v_2(0)) < 2.5$",
    derivation="For the causes of the difference see practically-identical.",
    reading=r"“Alike” is read as within $0.05 \mu v_2(0)$, and “nearly every angle” as nine tenths "
    r"of the angles, for every $\mu$ of Fig. 7. For $\mu = 0.1$ alone the sentence is nearly true, "
    r"and with $0.22 \mu v_2(0)$ in place of $0.05 \mu v_2(0)$ it is true",
)
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


entry(
    "micro-slip-insignificant",
    "p. 449, Conclusions, 2nd sentence",
    "Micro-slip has no significant effect on the velocities",
    at_most=0.05,
    verdict="wrong",
    grade="matter of judgement",
    cause="lumped-and-continuum",
    correction=r"Lumped model and continuum differ by up to $0.215 \mu v_2(0)$. The effect of "
    r"micro-slip alone is larger: it turns the contact point further round, by up to $0.52 \mu "
    "v_2(0)$",
    derivation="The number 0.52 is found between two contacts with Hertz' compliance, the elastic "
    r"continuum and one that sticks and slips as a whole, at $v_1(0)/(\mu v_2(0)) = 1.4$. In the "
    "lumped model most of this effect is hidden, because Hertz' compliance alone has an effect of "
    r"the opposite sign, up to $0.39 \mu v_2(0)$.",
    reading="The sentence is judged by what the paper compares, its lumped model without "
    r"micro-slip and the elastic continuum: they differ by $0.215 \mu v_2(0)$ at most. “No "
    r"significant effect” is read as none above $0.05 \mu v_2(0)$. Whoever allows $0.22 \mu "
    "v_2(0)$ finds the sentence true, see practically-identical. What micro-slip does by itself "
    r"is another number, $0.52 \mu v_2(0)$",
)(practically_identical)  # rebound


@entry(
    "limit-falls-with-losses",
    "p. 444, Tangential velocity at separation, 10th sentence",
    "With more internal dissipation gross slip begins at a smaller angle",
    at_most=0.0,
    verdict="wrong",
    grade="matter of judgement",
    cause="slip-limit",
    explorer={"angle": 66, "friction": 0.5, "restitution": 0.5, "view": "velocity"},
    correction=r"For $e < \Omega/\omega$ the limit stays at $v_1(0)/(\mu v_2(0)) = m_2/m_1$",
    derivation="For the limit see slip-throughout-limit. The printed limit, $(1 + e) m_2/m_1$, "
    "falls with every loss.",
    holds=r"This is right for $e > \Omega/\omega$, which is 0.588 for the paper's sphere. In a "
    "viscous continuum the limit falls with $e$ throughout, see slip-throughout-limit",
    reading="The sentence is judged as falling at every $e$. Read as smaller or equal, with any "
    "loss, it is true: for $e = 1$, 0.5 and 0, which the caption of Fig. 6 names, the limits are "
    "5.79, 3.5 and 3.5",
)
def limit_falls_with_losses() -> float:
    """Largest $e$ below which more internal dissipation leaves the limit of slip throughout."""
    e = np.linspace(0, 1, 2001)
    limit = lumped.slip_throughout_limit(*contact.SPHERE, e)
    return float(e[np.flatnonzero(np.diff(limit) > 0)[0]])


@entry(
    "compression-unaffected",
    "p. 444, Tangential velocity at separation, 11th sentence, first half",
    "Restitution has an effect only after $t_c$",
    holds="In a continuum that is viscous or yields, the velocity changes with $e$ in compression "
    "already",
)
def compression_spread() -> float:
    r"""Largest change of $v_1(t_c)/(\mu v_2(0))$ with $e$."""
    velocities = [
        [
            np.interp(1.0, history.time, history.velocity)
            for e in (0.5, 0.6, 0.8, 1.0)
            for history in [lumped.history(x, *contact.SPHERE, e, samples=513)]
        ]
        for x in (0.3, 1.0, 1.5, 2.0, 2.5, 3.4)
    ]
    return float(np.ptp(velocities, axis=1).max())


@entry(
    "restitution-change-falls",
    "p. 444, Tangential velocity at separation, 11th sentence, second half",
    "The change of velocity during restitution becomes smaller as $e$ does",
    verdict="wrong",
    grade="matter of judgement",
    cause="restitution-swing",
    explorer={"angle": 56.3, "friction": 0.5, "restitution": 0.5, "view": "velocity"},
    correction=r"With stick the change may become larger as $e$ falls: at $v_1(0)/(\mu v_2(0)) = "
    r"3$ it is $0.87 \mu v_2(0)$ for $e = 1$ and $1.54 \mu v_2(0)$ for $e = 0.5$",
    derivation="The tangential spring turns the contact point back and forth with the frequency "
    r"$\omega$, whatever $e$ is. Restitution lasts $e t_c$, and so it ends that swing at another "
    "phase for another $e$.",
    holds=r"This is right in slip throughout, where the change is $e (m_2/m_1) \mu v_2(0)$. As $e$ "
    "falls from 1 to 0.5, the largest reversed velocity grows by the paper's equations, and falls "
    "in a continuum that is viscous or yields",
    reading="The sentence is judged by the tangential velocity at all incidences, of which p. 444 "
    "speaks. For the normal velocity the sentence is right",
)
def restitution_change_falls() -> float:
    r"""Largest gain of $|v_1(t_f) - v_1(t_c)|/(\mu v_2(0))$ as $e$ falls, sphere of the paper."""
    e = np.linspace(0, 1, 101)[:, None]
    velocity = lumped.rebound(INCIDENCE, *contact.SPHERE, e).velocity
    change = np.abs(velocity - velocity[0])
    # Largest change at any smaller e, less that at each e.
    return float(np.max(np.maximum.accumulate(change, axis=0) - change))
