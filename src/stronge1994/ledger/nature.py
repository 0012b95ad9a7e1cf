"""Measures of what the paper says of restitution. Each takes a model of `nature_models`.

All are taken on the paper's sphere, for restitutions from 0.5 to 1 and incidences up to 8, as in
Figs 5 and 6. Restitution was measured down to 0.6.
"""

from collections.abc import Iterator

import numpy as np
from scipy.integrate import cumulative_simpson

from planarimpact.continuum import ContinuumHistory
from planarimpact.ground.arrays import Array
from planarimpact.ground.results import History, Regime
from stronge1994.ledger import contact
from stronge1994.ledger.nature_models import LOSSES, Model
from stronge1994.ledger.nature_models import model as _model
from stronge1994.printed import dissipation, slip

RESTITUTIONS = np.array([0.5, 0.6, 0.7, 0.8, 0.9, 1.0])
INCIDENCE = np.linspace(0.1, 8.0, 80)
# Histories take longer, so they have fewer restitutions, and few incidences of each first phase.
HISTORY_RESTITUTIONS = (0.5, 0.6, 0.8, 1.0)
STICK, SLIP = (0.3, 1.0), (1.5, 2.0, 2.5, 3.4)
# The restitution of the least elastic pair that was measured.
LEAST_MEASURED = 0.6
# Search for the limit of slip throughout: its range, incidences in one call, and refinements. One
# call for many incidences costs hardly more than one for a few.
LIMIT_RANGE, LIMIT_SAMPLES, LIMIT_REFINEMENTS = (3.0, 8.0), 40, 3
# Above this incidence, (1 + e) m2/m1 at e = 1, all models have the same rebound.
WITH_STICK = 2 * contact.MASS_RATIO


def peak_spread(model: Model) -> float:
    r"""Largest change of the peak of friction with $e$, over $\mu$ times the peak normal force."""
    peak = model.rebound(INCIDENCE, RESTITUTIONS[:, None]).peak_friction
    return float(np.ptp(peak, axis=0).max())


def peak_time(model: Model) -> float:
    """Latest time at which friction is largest, in $t_c$."""
    times = []
    for history in _histories(model, (*STICK, *SLIP)):
        size = np.abs(history.friction)
        # Friction may reach the same peak twice.
        times.append(history.time[np.argmax(size >= (1 - 1e-3) * size.max())])
    return float(max(times))


def duration(model: Model) -> float:
    """Largest distance of $t_f/t_c$ from $1 + e$."""
    ends = np.array([model.history(1.0, e).time[-1] for e in HISTORY_RESTITUTIONS])
    return float(np.abs(ends - 1 - HISTORY_RESTITUTIONS).max())


def indentation(model: Model) -> float:
    """Largest distance of $u_2(t_f)/u_2(t_c)$ from $1 - e^2$."""
    return float(
        max(abs(_indentation(model.history(1.0, e)) - (1 - e**2)) for e in HISTORY_RESTITUTIONS)
    )


def _indentation(history: History | ContinuumHistory) -> float:
    """u2(tf)/u2(t_c), from the normal force integrated twice."""
    deflection = cumulative_simpson(1 - _impulse(history), x=history.time, initial=0)
    return float(deflection[-1] / np.interp(1.0, history.time, deflection))


def _impulse(history: History | ContinuumHistory) -> Array:
    """Normal impulse over that of compression."""
    impulse = cumulative_simpson(history.normal, x=history.time, initial=0)
    return impulse / np.interp(1.0, history.time, impulse)


def compression_spread(model: Model) -> float:
    r"""Largest change of $v_1(t_c)/(\mu v_2(0))$ with $e$."""
    ends = [
        [_at_compression(model.history(x, e)) for e in HISTORY_RESTITUTIONS]
        for x in (*STICK, *SLIP)
    ]
    return float(np.ptp(ends, axis=1).max())


def _at_compression(history: History | ContinuumHistory) -> float:
    return float(np.interp(1.0, history.time, history.velocity))


def restitution_change(model: Model) -> float:
    r"""Largest gain of $|v_1(t_f) - v_1(t_c)|/(\mu v_2(0))$ as $e$ falls."""
    change = np.abs(
        [
            [history.velocity[-1] - _at_compression(history) for history in _histories(model, [x])]
            for x in (*STICK, *SLIP)
        ]
    )
    return float(np.max(np.maximum.accumulate(change, axis=1) - change))


def reversal_elastic(model: Model) -> float:
    r"""Largest reversed velocity over $\mu v_2(0)$ at $e = 1$."""
    return _reversal(model, 1.0)


def reversal_half(model: Model) -> float:
    r"""Largest reversed velocity over $\mu v_2(0)$ at $e = 0.5$."""
    return _reversal(model, 0.5)


def _reversal(model: Model, e: float) -> float:
    velocity = model.rebound(INCIDENCE, RESTITUTIONS[:, None]).velocity
    return float(-velocity[np.flatnonzero(e == RESTITUTIONS)[0]].min())


def limit_gap(model: Model) -> float:
    """Largest distance of the limit of slip throughout from $(1 + e) m_2/m_1$."""
    gaps = slip.slip_throughout_limit(contact.MASS_RATIO, np.array(HISTORY_RESTITUTIONS)) - _limits(
        model
    )
    return float(np.abs(gaps).max())


def limit_half(model: Model) -> float:
    """Limit of slip throughout at $e = 0.5$."""
    return float(_limits(model)[0])


def limit_fall(model: Model) -> float:
    """Smallest fall of the limit of slip throughout from one $e$ to the next smaller."""
    return float(np.diff(_limits(model)).min())


def limit_rise(model: Model) -> float:
    """Largest rise of the limit of slip throughout from one $e$ to the next smaller."""
    return -limit_fall(model)


def _limits(model: Model) -> Array:
    """Incidence from which a contact slides throughout, by restitution, in ever finer grids."""
    low, high = (np.full(len(HISTORY_RESTITUTIONS), edge) for edge in LIMIT_RANGE)
    for _ in range(LIMIT_REFINEMENTS):
        x = np.linspace(low, high, LIMIT_SAMPLES + 2)
        slides = model.rebound(x[1:-1], HISTORY_RESTITUTIONS).regime == Regime.SLIP_THROUGHOUT
        first = np.where(slides.any(axis=0), slides.argmax(axis=0), LIMIT_SAMPLES)
        lanes = np.arange(len(HISTORY_RESTITUTIONS))
        low, high = x[first, lanes], x[first + 1, lanes]
    return (low + high) / 2


def kept_after_stick(model: Model) -> float:
    """Share of contacts whose slip after initial stick runs in the incident direction."""
    return _kept(model, STICK)


def kept_after_slip(model: Model) -> float:
    """Share of contacts with a second slip, after stick, that runs in the incident direction."""
    return _kept(model, SLIP)


def _kept(model: Model, incidences: tuple[float, ...]) -> float:
    kept = []
    for history in _histories(model, incidences):
        before_separation = history.time < 0.999 * history.time[-1]
        kept.append(history.friction[before_separation][-1] > 0)
    return float(np.mean(kept))


def dissipation_gain(model: Model) -> float:
    """Smallest gain of the largest share that friction takes from one $e$ to the next larger."""
    tangent = np.tan(np.radians(np.linspace(2.0, 88.0, 44)))
    gains = []
    for mu in (0.1, 0.5):
        lost = model.rebound(tangent / mu, RESTITUTIONS[:, None]).dissipation
        share = 2 * mu**2 * lost / (1 + tangent**2)
        gains.append(np.diff(share.max(axis=1)).min())
    return float(min(gains))


def slip_velocity(model: Model) -> float:
    r"""Distance of $v_1(0) - (\mu/m_1) p(t_f)$ from the rebound above $(1 + e) m_2/m_1$.

    The largest, over $\mu v_2(0)$, with the normal impulse $p(t_f)$ by quadrature.
    """
    x = slip.slip_throughout_limit(contact.MASS_RATIO, np.array(HISTORY_RESTITUTIONS)) * 1.1
    impulse = np.array([_impulse(model.history(STICK[-1], e))[-1] for e in HISTORY_RESTITUTIONS])
    velocity = model.rebound(x, HISTORY_RESTITUTIONS).velocity
    return float(np.abs(velocity - (x - contact.MASS_RATIO * impulse)).max())


def slip_work(model: Model) -> float:
    """Largest relative distance of Eq. 41 from the work of friction above $(1 + e) m_2/m_1$."""
    x = slip.slip_throughout_limit(contact.MASS_RATIO, RESTITUTIONS) * 1.1
    stated = dissipation.eq_41_friction(x, contact.MASS_RATIO, 1.0, RESTITUTIONS) / 2
    return float(np.abs(model.rebound(x, RESTITUTIONS).dissipation / stated - 1).max())


def from_elastic(model: Model) -> float:
    """Distance of the rebounds from the elastic continuum at $e = 1$, root mean square."""
    return _from(model, LOSSES[0], 1.0)


def from_viscous(model: Model) -> float:
    """Distance of the rebounds from the viscous continuum at $e = 0.6$, root mean square."""
    return _from(model, LOSSES[0], LEAST_MEASURED)


def from_plastic(model: Model) -> float:
    """Distance of the rebounds from the continuum that yields at $e = 0.6$, root mean square."""
    return _from(model, LOSSES[1], LEAST_MEASURED)


def stick_from_viscous(model: Model) -> float:
    """The same from the viscous continuum, where the contact sticks at first, at $e = 0.8$."""
    return _from(model, LOSSES[0], 0.8, contact.STIFFNESS_RATIO)


def stick_from_plastic(model: Model) -> float:
    """The same from the continuum that yields, where the contact sticks at first, at $e = 0.8$."""
    return _from(model, LOSSES[1], 0.8, contact.STIFFNESS_RATIO)


def _from(model: Model, loss: str, e: float, below: float = WITH_STICK) -> float:
    """Distance of the rebounds from those of a continuum, over mu v2(0), below an incidence."""
    x = INCIDENCE[below > INCIDENCE]
    gap = model.rebound(x, e).velocity - _model(loss).rebound(x, e).velocity
    return float(np.sqrt(np.mean(gap**2)))


def _histories(
    model: Model, incidences: tuple[float, ...] | list[float]
) -> Iterator[History | ContinuumHistory]:
    """Histories of incidences, for each of `FEW` restitutions."""
    return (model.history(x, e) for x in incidences for e in HISTORY_RESTITUTIONS)
