"""The paper's collinear lumped model, solved to rounding (Stronge 1994, Eqs 4-27).

A linear normal element (stiffness kappa, kappa/e^2 in restitution) and a linear tangential
element (kappa/zeta^2) join the body to a massless particle that sticks to the surface or slips
on it with Coulomb friction. `stick_slip` holds the phases, `slip_onset` the search for the start of
slip, `normal` the normal motion, `extremes` what makes groups of any size possible.

The keyword `loss` says what takes the normal energy where e < 1. At e = 1 all are the same model.

- "hysteretic": the paper's element, of which only the normal direction loses energy.
- "plastic": as the paper's, but with the elastic normal stiffness in the ratio. The elastic
  stiffness of the hysteretic element is the one of unloading, kappa/e^2, so the tangential one is
  kappa/(e^2 zeta^2): e^2 zeta^2 takes the place of zeta^2.
- "viscous": a dashpot beside the spring in both directions, with one relaxation time. `viscous`
  holds it.

Errors that these functions state are those of the solution. The model itself is further off. For a
solid sphere of Poisson's ratio 0.3 and e = 1 its velocity differs from the elastic continuum by up
to 0.21 mu v2(0). Measurements contradict the hysteretic loss: at e = 0.8 it differs by up to 0.73
from the viscous continuum and by up to 0.90 from the plastic one.
"""

import numpy as np

from planarimpact.ground import checks, sliding
from planarimpact.ground.arrays import Array, ArrayLike, Numbers
from planarimpact.ground.results import Event, EventKind, History, Rebound
from planarimpact.lumped import normal, stick_slip, viscous
from planarimpact.lumped.extremes import scaling
from planarimpact.lumped.stick_slip import Impacts

# What may take the normal energy.
LOSSES = ("hysteretic", "plastic", "viscous")
# Impacts solved together: few enough for the cache, enough to hide Python's overhead.
CHUNK = 32768
# Nodes and weights of Gauss on -1 to 1, for the work of friction within a phase.
QUADRATURE = np.polynomial.legendre.leggauss(20)


@checks.default_errors
def rebound(
    incidence: ArrayLike,
    mass_ratio: ArrayLike = 3.5,
    stiffness_ratio: ArrayLike = 1.21,
    restitution: ArrayLike = 1.0,
    *,
    loss: str = "hysteretic",
) -> Rebound:
    """State at separation; all arguments broadcast.

    Parameters
    ----------
    incidence : array_like
        x = v1(0)/(mu v2(0)), tangential over normal speed and friction. Any number to 8e307;
        a negative one gives the mirror image.
    mass_ratio : array_like
        beta = m2/m1 >= 1 (Eqs 1, 2); 3.5 for a solid sphere on a half-space.
    stiffness_ratio : array_like
        zeta^2 > 0, normal over tangential stiffness; (2 - nu)/(2 (1 - nu)) for elastic spheres.
    restitution : array_like
        Energetic coefficient e, 0 to 1 (Eq. 5).
    loss : str
        "hysteretic" (the paper's, which measurements contradict), "plastic" or "viscous": what
        takes the normal energy.

    Returns
    -------
    Rebound
        velocity, peak_friction, dissipation, regime, in the broadcast shape (scalars for
        scalars); velocity has the sign of `incidence` where the direction is kept. With viscous
        loss the peak is in mu times the largest normal force of that very impact, and the
        dissipation is the work of friction alone: what the tangential dashpot takes, and the
        strain left in the tangential spring at separation, are lost besides.

    Raises
    ------
    InputError
        If an argument is not a finite real number in its range, or shapes do not broadcast. With
        viscous loss and e < 1 the range is smaller: restitution from 1e-3 (a viscous element does
        not stop a body for good), mass ratio to 1e6, stiffness ratio from 1e-4 to 1e6 times the
        mass ratio.

    Notes
    -----
    The errors of velocity, peak friction and dissipation, as a solution of the model, are at most a
    hundred times the effect of rounding the four arguments. This holds in every regime, and at the
    thresholds. The exception is a dissipation below 1e-16 of the energy, where T and N fall
    together (zeta^2 next to beta, e = 1). The time does not depend on the number of phases, which
    grows as omega/Omega: see `extremes.many_phases`. Stronge's printed equations differ in two
    places: the limit of slip throughout (see `slip_throughout_limit`) and the direction of the last
    slip, which at small e is the incident one.

    With viscous loss the errors are at most 1e-12: of the velocity beside max(1, x, beta), of the
    peak beside 1, of the dissipation beside x^2/(2 beta) or, if that is smaller, (1 + e) x.

    Examples
    --------
    >>> from planarimpact import Regime
    >>> result = rebound([0.5, 2.0, 8.0])
    >>> [Regime(code).name for code in result.regime]
    ['STICK_SLIP', 'SLIP_STICK_SLIP', 'SLIP_THROUGHOUT']
    >>> float(result.velocity[2])  # x - (1 + e) beta
    1.0
    >>> losses = ("hysteretic", "plastic", "viscous")
    >>> [round(float(rebound(2.0, restitution=0.8, loss=loss).velocity), 6) for loss in losses]
    [-1.068366, -0.293096, -0.349825]
    """
    checks.loss(loss, LOSSES)
    x, *groups = checks.impact(incidence, mass_ratio, stiffness_ratio, restitution)
    groups = [np.abs(x).reshape(-1), *(group.reshape(-1) for group in groups)]
    if loss == "viscous":
        return Rebound.shaped(x, *_viscous(Impacts(*groups)))
    if loss == "plastic":
        groups[2] = _plastic(groups[2], groups[3])
    velocity, peak, work, regime = _hysteretic(Impacts(*groups))
    return Rebound.shaped(x, velocity, peak, work, regime)


def _hysteretic(impacts: Impacts) -> stick_slip.Outcome:
    """Outcome of impacts x >= 0, arrays of shape (n,), chunk by chunk."""
    x = impacts.x
    velocity, peak, work = (np.empty(x.size) for _ in range(3))
    regime = np.empty(x.size, np.uint8)
    for start in range(0, x.size, CHUNK):
        part = slice(start, start + CHUNK)
        outcome = scaling.solve(Impacts(*(group[part] for group in impacts)))
        velocity[part], peak[part], work[part], regime[part] = outcome
    return stick_slip.Outcome(velocity, peak, work, regime)


def _viscous(impacts: Impacts) -> stick_slip.Outcome:
    """As `_hysteretic`; where e = 1 the elements are the same."""
    damped = impacts.e < 1
    if not damped.any():
        return _hysteretic(impacts)
    lost = impacts if damped.all() else impacts.take(np.flatnonzero(damped))
    viscous.check_range(lost)
    if lost is impacts:
        return viscous.solve(impacts)
    outcome = _hysteretic(impacts)
    for field, values in zip(outcome, viscous.solve(lost), strict=True):
        field[damped] = values
    return outcome


def _plastic(stiffness_ratio: Array, restitution: Array) -> Array:
    """e^2 zeta^2, rounded as in `sliding.restick_coefficient`."""
    return restitution * (restitution * stiffness_ratio)


@checks.default_errors
def slip_throughout_limit(
    mass_ratio: ArrayLike = 3.5,
    stiffness_ratio: ArrayLike = 1.21,
    restitution: ArrayLike = 1.0,
    *,
    loss: str = "hysteretic",
) -> Array:
    """Smallest incidence that slides through the whole contact; all arguments broadcast.

    x = beta + max(0, e beta - zeta^2/e), or zeta^2 where that is larger; `ground.sliding` derives
    it. The paper prints (1 + e) beta (heading of Eq. 26), but its own condition for the end of the
    first slip, Eq. 21, has no root above the value given here.

    With plastic loss e^2 zeta^2 stands for zeta^2: max(e^2 zeta^2, beta + e max(0, beta - zeta^2)).
    With viscous loss it is max(zeta^2, beta + e (beta - zeta^2)). The two are the same for
    zeta^2 <= beta. For a softer tangential element, viscous contact starts in stick up to zeta^2,
    and plastic contact up to e^2 zeta^2 only; from beta on that slip lasts.

    Parameters
    ----------
    mass_ratio, stiffness_ratio, restitution : array_like
        As in `rebound`; with viscous loss of any size, and the limit at e = 0 is that of small e.
    loss : str
        As in `rebound`.

    Returns
    -------
    ndarray of float64 or float
        Incidence v1(0)/(mu v2(0)).

    Raises
    ------
    InputError
        As `rebound`.

    Examples
    --------
    >>> float(slip_throughout_limit(3.5, 1.21, 1.0))
    5.79
    >>> [float(slip_throughout_limit(3.5, 5.0, 0.5, loss=loss)) for loss in ("plastic", "viscous")]
    [3.5, 5.0]
    """
    checks.loss(loss, LOSSES)
    _, beta, zeta2, e = checks.impact(0.0, mass_ratio, stiffness_ratio, restitution)
    if loss == "viscous":
        return sliding.limit_alike(beta, zeta2, e)[()]
    if loss == "plastic":
        zeta2 = _plastic(zeta2, e)
    return sliding.limit(beta, zeta2, e)[()]


@checks.default_errors
def history(
    incidence: float,
    mass_ratio: float = 3.5,
    stiffness_ratio: float = 1.21,
    restitution: float = 1.0,
    samples: int = 400,
    *,
    loss: str = "hysteretic",
) -> History:
    """Forces and velocity over one contact (Figs 3 and 4).

    Parameters
    ----------
    incidence, mass_ratio, stiffness_ratio, restitution : float
        As in `rebound`; scalars.
    samples : int
        At least 2: instants evenly spread over the contact. Events come on top, so that every
        one is a vertex.
    loss : str
        As in `rebound`.

    Returns
    -------
    History
        time in t_c, normal, friction, velocity, spring, events. With viscous loss t_c is half of
        the contact, and both forces jump at contact, as the dashpots act at once.

    Raises
    ------
    InputError
        As `rebound`; also if an argument is not scalar, `samples` is no integer above 1, or
        the contact has more than 100 000 phases.

    Examples
    --------
    >>> contact = history(1.0, restitution=0.5, samples=5)
    >>> [str(event.kind) for event in contact.events]
    ['contact', 'stick', 'maximum compression', 'slip', 'separation']
    >>> float(contact.time[-1])
    1.5
    """
    samples = checks.count("samples", samples, 2)
    checks.loss(loss, LOSSES)
    mirror, impacts = _one(incidence, mass_ratio, stiffness_ratio, restitution, loss)
    if loss == "viscous" and impacts.e[0] < 1:
        return viscous.history(mirror, impacts, samples)
    scale, groups, phases = _phases(impacts)
    zeta2, e = groups[1] / scale, groups[2]
    grid = np.linspace(0.0, 1.0 + e, samples)
    columns, events, before = [], [], None
    for phase, eta_end in phases:
        start, end = (normal.time(eta, e, phase.in_restitution) for eta in (phase.eta, eta_end))
        inside = grid[(grid > start) & (grid < end)]
        time = np.concatenate([[start], inside, [end]])
        eta = np.concatenate([[phase.eta], _angle(inside, e, phase.in_restitution), [eta_end]])
        friction, velocity = stick_slip.state(phase, eta, *groups)
        velocity = mirror * velocity / scale
        columns.append(np.stack([time, normal.force(eta), mirror * friction, velocity]))
        events += [_event(kind, columns[-1][:, 0], zeta2) for kind in _kinds(phase, before)]
        before = phase
    if e == 0:
        events.append(_event(EventKind.MAXIMUM_COMPRESSION, columns[-1][:, -1], zeta2))
    events.append(_event(EventKind.SEPARATION, columns[-1][:, -1], zeta2))
    joined = [piece[:, :-1] for piece in columns[:-1]] + columns[-1:]
    time, force, friction, velocity = np.concatenate(joined, axis=1)
    return History(time, force, friction, velocity, zeta2 * friction, tuple(events))


@checks.default_errors
def friction_work(
    incidence: float,
    mass_ratio: float = 3.5,
    stiffness_ratio: float = 1.21,
    restitution: float = 1.0,
    *,
    loss: str = "hysteretic",
) -> float:
    """Work of friction, integrated over the phases of slip: |F1| times the slip velocity.

    This checks `rebound(...).dissipation`, which comes from the balance of energy. The two differ
    by what the tangential spring loses when e = 0. With viscous loss and e < 1 both are the same
    closed integral.

    Parameters
    ----------
    incidence, mass_ratio, stiffness_ratio, restitution : float
        As in `rebound`; scalars.
    loss : str
        As in `rebound`.

    Returns
    -------
    float
        In mu^2 m2 v2(0)^2.

    Raises
    ------
    InputError
        As `rebound`; also if an argument is not scalar, or the contact has more than 100 000
        phases.

    Examples
    --------
    >>> balance = rebound(2.0).dissipation
    >>> bool(abs(friction_work(2.0) - balance) < 1e-14)
    True
    """
    checks.loss(loss, LOSSES)
    _, impacts = _one(incidence, mass_ratio, stiffness_ratio, restitution, loss)
    if loss == "viscous" and impacts.e[0] < 1:
        return float(viscous.solve(impacts).dissipation[0])
    scale, groups, phases = _phases(impacts)
    _, zeta2, e = groups
    nodes, weights = QUADRATURE
    work = 0.0
    for phase, eta_end in phases:
        if phase.sticks:
            continue
        half = (eta_end - phase.eta) / 2
        eta = phase.eta + half * (1 + nodes)
        friction, velocity = stick_slip.state(phase, eta, *groups)
        # Slip velocity w - s' times dt, in the angle of either half.
        pace = -e if phase.in_restitution else 1.0
        slip = pace * velocity - phase.side * zeta2 * np.cos(eta)
        work += float(half * (weights @ (friction * slip)))
    return work / scale


def _one(
    incidence: float, mass_ratio: float, stiffness_ratio: float, restitution: float, loss: str
) -> tuple[float, Impacts]:
    """Mirror sign and groups of one impact, as the solver of this loss takes them."""
    checked = checks.impact(incidence, mass_ratio, stiffness_ratio, restitution)
    if checked[0].ndim:
        raise checks.InputError(f"shape = {checked[0].shape}: one contact takes scalars")
    x, beta, zeta2, e = (a.reshape(1) for a in checked)
    if loss == "plastic":
        zeta2 = _plastic(zeta2, e)
    impacts = Impacts(np.abs(x), beta, zeta2, e)
    if loss == "viscous" and e[0] < 1:
        viscous.check_range(impacts)
    return float(np.copysign(1.0, x[0])), impacts


def _phases(
    impacts: Impacts,
) -> tuple[float, tuple[float, float, float], list[tuple[stick_slip.Phase, Numbers]]]:
    """One impact: scale, (beta, zeta^2, e), and its phases, each with its last eta.

    Ratios and velocities have been multiplied by the scale.
    """
    impacts, scale = scaling.shrunk(impacts)
    _, beta, zeta2, e = impacts
    trace: list[stick_slip.Phase] = []
    stick_slip.solve(impacts, trace)
    if e[0] == 0:  # separation at maximum compression
        trace = [phase for phase in trace if not phase.in_restitution]
    trace = [stick_slip.Phase._make(np.ravel(field)[0] for field in phase) for phase in trace]
    # A phase ends where the next one starts, or with its half of the contact.
    ends = [
        after.eta if after.in_restitution == phase.in_restitution else np.pi / 2
        for phase, after in zip(trace, trace[1:], strict=False)
    ]
    ends.append(0.0 if trace[-1].in_restitution else np.pi / 2)
    ratios = float(beta[0]), float(zeta2[0]), float(e[0])
    return float(scale[0]), ratios, list(zip(trace, ends, strict=True))


def _angle(time: Array, e: float, in_restitution: bool) -> Array:
    """The angle `eta` of `normal` at a time within one half."""
    return np.pi / 2 * np.clip((1 + e - time) / e if in_restitution else time, 0.0, 1.0)


def _event(kind: EventKind, column: Array, zeta2: float) -> Event:
    time, force, friction, velocity = (float(value) for value in column)
    return Event(kind, time, force, friction, velocity, float(zeta2 * friction))


def _kinds(phase: stick_slip.Phase, before: stick_slip.Phase | None) -> list[EventKind]:
    """Events where a phase starts; one that goes on through maximum compression is not new."""
    kind = EventKind.STICK if phase.sticks else EventKind.SLIP
    if before is None:
        return [EventKind.CONTACT, kind]
    if phase.in_restitution == before.in_restitution:
        return [kind]
    return [EventKind.MAXIMUM_COMPRESSION, *([kind] if phase.sticks != before.sticks else [])]
