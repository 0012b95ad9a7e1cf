"""Checks of what the paper says of restitution that are asked of a model, by its name.

All are taken on the paper's sphere, for restitutions from 0.5 to 1 and incidences up to 8, as in
Figs 5 and 6. Restitution was measured down to 0.6. Of the models one loses its energy in a viscous
material and one in a material that yields, both with micro-slip. The other two are lumped: the
paper's, and the same with e^2 zeta^2 in place of zeta^2. That is a ratio of elastic stiffnesses,
and the elastic normal stiffness of the paper's contact is that of unloading, kappa/e^2. Without a
name a check is asked of the paper's model, which decides the first verdict of some entries.
"""

from itertools import product
from types import ModuleType

import numpy as np

from planarimpact import continuum, lumped
from planarimpact.common.arrays import Array, ArrayLike
from planarimpact.common.results import History, Rebound, Regime
from planarimpact.continuum import ContinuumHistory
from stronge1994.ledger import contact
from stronge1994.ledger.contact import MASS_RATIO
from stronge1994.ledger.finding import PAPER, PLASTIC, UNLOADING_STIFFNESS, VISCOUS
from stronge1994.printed import dissipation, slip

# Solver and loss of each model.
SOLVERS: dict[str, tuple[ModuleType, str]] = {
    PAPER: (lumped, "hysteretic"),
    UNLOADING_STIFFNESS: (lumped, "unloading-stiffness"),
    VISCOUS: (continuum, "viscous"),
    PLASTIC: (continuum, "plastic"),
}
# Error of the continua. It is small compared with every bound of the ledger.
TOLERANCE = 1e-3
RESTITUTIONS = np.array([0.5, 0.6, 0.7, 0.8, 0.9, 1.0])
INCIDENCE = np.linspace(0.1, 8.0, 80)
# Histories take longer, so they have fewer restitutions, and few incidences of each first phase.
FEW = np.array([0.5, 0.6, 0.8, 1.0])
FIRST_PHASES = {"stick": (0.3, 1.0), "slip": (1.5, 2.0, 2.5, 3.4)}
ALL_PHASES = sum(FIRST_PHASES.values(), ())
# Search for the limit of slip throughout: its range, incidences in one call, and refinements. One
# call for many incidences costs hardly more than one for a few.
LIMIT_RANGE, LIMIT_SAMPLES, LIMIT_REFINEMENTS = (3.0, 8.0), 40, 3


def _rebound(model: str, x: ArrayLike, e: ArrayLike) -> Rebound:
    """Rebounds of one of the models.

    >>> from stronge1994.ledger.finding import MODELS
    >>> [round(float(_rebound(model, 3.0, 0.5).velocity), 1) for model in MODELS]
    [-2.0, -0.6, -0.6, -0.8]
    """
    solver, loss = SOLVERS[model]
    settings: dict[str, float | str] = {} if solver is lumped else {"tolerance": TOLERANCE}
    return contact.once(solver.rebound, x, *contact.SPHERE, e, loss=loss, **settings)


def _histories(model: str, *incidences: float) -> list[History | ContinuumHistory]:
    """Contacts of a model, for each incidence one of each of the `FEW` restitutions."""
    solver, loss = SOLVERS[model]
    settings = {"samples": 513} if solver is lumped else {"tolerance": TOLERANCE}
    return [
        contact.once(solver.history, x, *contact.SPHERE, e, loss=loss, **settings)
        for x, e in product(incidences, FEW)
    ]


def _impulse(history: History | ContinuumHistory) -> Array:
    """Normal impulse over that of compression."""
    impulse = contact.cumulative(history.normal, history.time)
    return impulse / np.interp(1.0, history.time, impulse)


def peak_spread(model: str = PAPER) -> float:
    r"""Largest change of peak friction with $e$, over $\mu$ times the largest normal force."""
    peak = _rebound(model, INCIDENCE, RESTITUTIONS[:, None]).peak_friction
    return float(np.ptp(peak, axis=0).max())


def peak_time(model: str = PAPER) -> float:
    """Latest time at which friction is largest, in $t_c$."""
    times = []
    for history in _histories(model, *ALL_PHASES):
        size = np.abs(history.friction_force)
        # Friction may reach the same peak twice.
        times.append(history.time[np.argmax(size >= (1 - 1e-3) * size.max())])
    return float(max(times))


def duration(model: str = PAPER) -> float:
    """Largest distance of $t_f/t_c$ from $1 + e$."""
    ends = np.array([history.time[-1] for history in _histories(model, 1.0)])
    return float(np.abs(ends - 1 - FEW).max())


def indentation(model: str = PAPER) -> float:
    """Largest distance of $u_2(t_f)/u_2(t_c)$ from $1 - e^2$."""
    left = []
    for history in _histories(model, 1.0):
        deflection = contact.cumulative(1 - _impulse(history), history.time)
        left.append(deflection[-1] / np.interp(1.0, history.time, deflection))
    return float(np.abs(left - (1 - FEW**2)).max())


def compression_spread(model: str = PAPER) -> float:
    r"""Largest change of $v_1(t_c)/(\mu v_2(0))$ with $e$."""
    at_compression, _ = _velocities(model)
    return float(np.ptp(at_compression, axis=1).max())


def _velocities(model: str) -> tuple[Array, Array]:
    """v1(t_c) and v1(tf) over mu v2(0), each by incidence and restitution."""
    histories, shape = _histories(model, *ALL_PHASES), (len(ALL_PHASES), len(FEW))
    at_compression = [np.interp(1.0, one.time, one.velocity) for one in histories]
    at_separation = [one.velocity[-1] for one in histories]
    return np.reshape(at_compression, shape), np.reshape(at_separation, shape)


def restitution_change(model: str = PAPER) -> float:
    r"""Largest gain of $|v_1(t_f) - v_1(t_c)|/(\mu v_2(0))$ as $e$ falls."""
    at_compression, at_separation = _velocities(model)
    change = np.abs(at_separation - at_compression)
    return float(np.max(np.maximum.accumulate(change, axis=1) - change))


def reversal(e: float, model: str = PAPER) -> float:
    r"""Largest reversed velocity over $\mu v_2(0)$ at $e = {e}$."""
    return -float(_rebound(model, INCIDENCE, e).velocity.min())


def limit_gap(model: str = PAPER) -> float:
    """Largest distance of the limit of slip throughout from $(1 + e) m_2/m_1$."""
    gaps = slip.slip_throughout_limit(MASS_RATIO, FEW) - _limits(model)
    return float(np.abs(gaps).max())


def limit_half(model: str = PAPER) -> float:
    """Limit of slip throughout at $e = 0.5$."""
    return float(_limits(model)[0])


def limit_rise(model: str = PAPER) -> float:
    """Largest rise of the limit of slip throughout from one $e$ to the next smaller."""
    return -float(np.diff(_limits(model)).min())


def _limits(model: str) -> Array:
    """Incidence from which a contact slides throughout, by restitution, in ever finer grids."""
    low, high = (np.full(len(FEW), edge) for edge in LIMIT_RANGE)
    for _ in range(LIMIT_REFINEMENTS):
        x = np.linspace(low, high, LIMIT_SAMPLES + 2)
        slides = _rebound(model, x[1:-1], FEW).regime == Regime.SLIP_THROUGHOUT
        first = np.where(slides.any(axis=0), slides.argmax(axis=0), LIMIT_SAMPLES)
        lanes = np.arange(len(FEW))
        low, high = x[first, lanes], x[first + 1, lanes]
    return (low + high) / 2


def kept_after(phase: str, model: str = PAPER) -> float:
    """Share of contacts, of those that {phase} first, whose last slip runs as the incident one."""
    kept = []
    for history in _histories(model, *FIRST_PHASES[phase]):
        before_separation = history.time < 0.999 * history.time[-1]
        kept.append(history.friction_force[before_separation][-1] > 0)
    return float(np.mean(kept))


def dissipation_gain(model: str = PAPER) -> float:
    """Smallest gain of the largest share that friction takes from one $e$ to the next larger."""
    tangent = np.tan(np.radians(np.linspace(2.0, 88.0, 44)))
    gains = []
    for mu in (0.1, 0.5):
        lost = _rebound(model, tangent / mu, RESTITUTIONS[:, None]).dissipation
        share = 2 * mu**2 * lost / (1 + tangent**2)
        gains.append(np.diff(share.max(axis=1)).min())
    return float(min(gains))


def slip_velocity(model: str = PAPER) -> float:
    r"""Largest distance of $v_1(0) - (\mu/m_1) p(t_f)$ from the rebound, in $\mu v_2(0)$.

    Above $(1 + e) m_2/m_1$, with the normal impulse $p(t_f)$ by quadrature.
    """
    x = slip.slip_throughout_limit(MASS_RATIO, FEW) * 1.1
    impulse = np.array([_impulse(history)[-1] for history in _histories(model, 1.0)])
    gaps = _rebound(model, x, FEW).velocity - (x - MASS_RATIO * impulse)
    return float(np.abs(gaps).max())


def slip_work(model: str = PAPER) -> float:
    """Largest relative distance of Eq. 41 from the work of friction above $(1 + e) m_2/m_1$."""
    x = slip.slip_throughout_limit(MASS_RATIO, RESTITUTIONS) * 1.1
    stated = dissipation.eq_41_friction(x, MASS_RATIO, 1.0, RESTITUTIONS) / 2
    return float(np.abs(_rebound(model, x, RESTITUTIONS).dissipation / stated - 1).max())


def distance(other: str, e: float, below: float, model: str = PAPER) -> float:
    """Distance of the rebounds from the {other} continuum at $e = {e}$, root mean square.

    Incidences below {below}. Above $(1 + e) m_2/m_1$ at $e = 1$ all models have the same rebound.
    """
    x = INCIDENCE[below > INCIDENCE]
    gap = _rebound(model, x, e).velocity - _rebound(other, x, e).velocity
    return float(np.sqrt(np.mean(gap**2)))
