"""Checks of what the paper says of restitution that are asked of a model, by its name.

All are taken on the paper's sphere, for restitutions from 0.5 to 1 and incidences up to 8, as in
Figs 5 and 6. Restitution was measured down to 0.6. Of the models one loses its energy in a viscous
material and one in a material that yields, both with micro-slip. The other two are lumped: the
paper's, and the same with e^2 zeta^2 in place of zeta^2. That is a ratio of elastic stiffnesses,
and the elastic normal stiffness of the paper's contact is that of unloading, kappa/e^2.
"""

from collections.abc import Sequence
from types import ModuleType

import numpy as np
from scipy.integrate import cumulative_simpson

from planarimpact import continuum, lumped
from planarimpact.continuum import ContinuumHistory
from planarimpact.ground.arrays import Array, ArrayLike
from planarimpact.ground.results import History, Rebound, Regime
from stronge1994.ledger import contact
from stronge1994.ledger.contact import MASS_RATIO, STIFFNESS_RATIO
from stronge1994.ledger.finding import PAPER, PLASTIC, UNLOADING_STIFFNESS, VISCOUS, Finding
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
STICK, SLIP = (0.3, 1.0), (1.5, 2.0, 2.5, 3.4)
# The restitution of the least elastic pair that was measured.
LEAST_MEASURED = 0.6
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


def _history(model: str, x: float, e: float) -> History | ContinuumHistory:
    """One contact of a model."""
    solver, loss = SOLVERS[model]
    settings = {"samples": 513} if solver is lumped else {"tolerance": TOLERANCE}
    return contact.once(solver.history, x, *contact.SPHERE, e, loss=loss, **settings)


def _histories(model: str, incidences: Sequence[float]) -> list[list[History | ContinuumHistory]]:
    """Histories for `FEW` restitutions, of each incidence."""
    return [[_history(model, x, e) for e in FEW] for x in incidences]


def _impulse(history: History | ContinuumHistory) -> Array:
    """Normal impulse over that of compression."""
    impulse = cumulative_simpson(history.normal, x=history.time, initial=0)
    return impulse / np.interp(1.0, history.time, impulse)


def peak_spread(model: str) -> Finding:
    r"""Largest change of peak friction with $e$, over $\mu$ times the largest normal force."""
    peak = _rebound(model, INCIDENCE, RESTITUTIONS[:, None]).peak_friction
    return Finding(float(np.ptp(peak, axis=0).max()))


def peak_time(model: str) -> Finding:
    """Latest time at which friction is largest, in $t_c$."""
    times = []
    for history in sum(_histories(model, STICK + SLIP), []):
        size = np.abs(history.friction)
        # Friction may reach the same peak twice.
        times.append(history.time[np.argmax(size >= (1 - 1e-3) * size.max())])
    return Finding(float(max(times)))


def duration(model: str) -> Finding:
    """Largest distance of $t_f/t_c$ from $1 + e$."""
    (histories,) = _histories(model, [1.0])
    ends = np.array([history.time[-1] for history in histories])
    return Finding(float(np.abs(ends - 1 - FEW).max()))


def indentation(model: str) -> Finding:
    """Largest distance of $u_2(t_f)/u_2(t_c)$ from $1 - e^2$."""
    left = []
    for history in _histories(model, [1.0])[0]:
        deflection = cumulative_simpson(1 - _impulse(history), x=history.time, initial=0)
        left.append(deflection[-1] / np.interp(1.0, history.time, deflection))
    return Finding(float(np.abs(left - (1 - FEW**2)).max()))


def compression_spread(model: str) -> Finding:
    r"""Largest change of $v_1(t_c)/(\mu v_2(0))$ with $e$."""
    at_compression, _ = _velocities(model)
    return Finding(float(np.ptp(at_compression, axis=1).max()))


def _velocities(model: str) -> tuple[Array, Array]:
    """v1(t_c) and v1(tf) over mu v2(0), each by incidence and restitution."""
    histories = _histories(model, STICK + SLIP)
    at = [[np.interp(1.0, one.time, one.velocity) for one in of_x] for of_x in histories]
    return np.array(at), np.array([[one.velocity[-1] for one in of_x] for of_x in histories])


def restitution_change(model: str) -> Finding:
    r"""Largest gain of $|v_1(t_f) - v_1(t_c)|/(\mu v_2(0))$ as $e$ falls."""
    at_compression, at_separation = _velocities(model)
    change = np.abs(at_separation - at_compression)
    return Finding(float(np.max(np.maximum.accumulate(change, axis=1) - change)))


def reversal_elastic(model: str) -> Finding:
    r"""Largest reversed velocity over $\mu v_2(0)$ at $e = 1$."""
    return Finding(float(_reversals(model)[-1]))


def reversal_half(model: str) -> Finding:
    r"""Largest reversed velocity over $\mu v_2(0)$ at $e = 0.5$."""
    return Finding(float(_reversals(model)[0]))


def _reversals(model: str) -> Array:
    """Largest reversed velocity, by restitution."""
    return -_rebound(model, INCIDENCE, RESTITUTIONS[:, None]).velocity.min(axis=1)


def limit_gap(model: str) -> Finding:
    """Largest distance of the limit of slip throughout from $(1 + e) m_2/m_1$."""
    gaps = slip.slip_throughout_limit(MASS_RATIO, FEW) - _limits(model)
    return Finding(float(np.abs(gaps).max()))


def limit_half(model: str) -> Finding:
    """Limit of slip throughout at $e = 0.5$."""
    return Finding(float(_limits(model)[0]))


def limit_fall(model: str) -> Finding:
    """Smallest fall of the limit of slip throughout from one $e$ to the next smaller."""
    return Finding(float(np.diff(_limits(model)).min()))


def limit_rise(model: str) -> Finding:
    """Largest rise of the limit of slip throughout from one $e$ to the next smaller."""
    return Finding(-limit_fall(model).value)


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


def kept_after_stick(model: str) -> Finding:
    """Share of contacts whose slip after initial stick runs in the incident direction."""
    return _kept(model, STICK)


def kept_after_slip(model: str) -> Finding:
    """Share of contacts with a second slip, after stick, that runs in the incident direction."""
    return _kept(model, SLIP)


def _kept(model: str, incidences: Sequence[float]) -> Finding:
    kept = []
    for history in sum(_histories(model, incidences), []):
        before_separation = history.time < 0.999 * history.time[-1]
        kept.append(history.friction[before_separation][-1] > 0)
    return Finding(float(np.mean(kept)))


def dissipation_gain(model: str) -> Finding:
    """Smallest gain of the largest share that friction takes from one $e$ to the next larger."""
    tangent = np.tan(np.radians(np.linspace(2.0, 88.0, 44)))
    gains = []
    for mu in (0.1, 0.5):
        lost = _rebound(model, tangent / mu, RESTITUTIONS[:, None]).dissipation
        share = 2 * mu**2 * lost / (1 + tangent**2)
        gains.append(np.diff(share.max(axis=1)).min())
    return Finding(float(min(gains)))


def slip_velocity(model: str) -> Finding:
    r"""Largest distance of $v_1(0) - (\mu/m_1) p(t_f)$ from the rebound, in $\mu v_2(0)$.

    Above $(1 + e) m_2/m_1$, with the normal impulse $p(t_f)$ by quadrature.
    """
    x = slip.slip_throughout_limit(MASS_RATIO, FEW) * 1.1
    impulse = np.array([_impulse(history)[-1] for history in _histories(model, STICK)[-1]])
    gaps = _rebound(model, x, FEW).velocity - (x - MASS_RATIO * impulse)
    return Finding(float(np.abs(gaps).max()))


def slip_work(model: str) -> Finding:
    """Largest relative distance of Eq. 41 from the work of friction above $(1 + e) m_2/m_1$."""
    x = slip.slip_throughout_limit(MASS_RATIO, RESTITUTIONS) * 1.1
    stated = dissipation.eq_41_friction(x, MASS_RATIO, 1.0, RESTITUTIONS) / 2
    return Finding(float(np.abs(_rebound(model, x, RESTITUTIONS).dissipation / stated - 1).max()))


def from_elastic(model: str) -> Finding:
    """Distance of the rebounds from the elastic continuum at $e = 1$, root mean square."""
    return _apart(model, VISCOUS, 1.0)


def from_viscous(model: str) -> Finding:
    """Distance of the rebounds from the viscous continuum at $e = 0.6$, root mean square."""
    return _apart(model, VISCOUS, LEAST_MEASURED)


def from_plastic(model: str) -> Finding:
    """Distance of the rebounds from the continuum that yields at $e = 0.6$, root mean square."""
    return _apart(model, PLASTIC, LEAST_MEASURED)


def stick_from_viscous(model: str) -> Finding:
    """The same from the viscous continuum, where the contact sticks at first, at $e = 0.8$."""
    return _apart(model, VISCOUS, 0.8, STIFFNESS_RATIO)


def stick_from_plastic(model: str) -> Finding:
    """The same from the continuum that yields, where the contact sticks at first, at $e = 0.8$."""
    return _apart(model, PLASTIC, 0.8, STIFFNESS_RATIO)


def _apart(model: str, other: str, e: float, below: float = 2 * MASS_RATIO) -> Finding:
    """Distance of two models' rebounds over mu v2(0), below an incidence.

    Above (1 + e) m2/m1 at e = 1 all models have the same rebound.
    """
    x = INCIDENCE[below > INCIDENCE]
    gap = _rebound(model, x, e).velocity - _rebound(other, x, e).velocity
    return Finding(float(np.sqrt(np.mean(gap**2))))
