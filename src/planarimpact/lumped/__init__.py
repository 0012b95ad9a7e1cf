"""The paper's collinear lumped model, solved exactly (Stronge 1994, Eqs 4-27).

A linear normal element (stiffness kappa, kappa/e^2 in restitution) and a linear tangential
element (kappa/zeta^2) join the body to a massless particle that sticks to the surface or slips
on it with Coulomb friction. `stick_slip` holds the phases, `slip_onset` the search for the start of
slip, `normal` the normal motion, `extremes` what makes groups of any size possible.
"""

import numpy as np

from planarimpact.ground import checks, sliding
from planarimpact.ground.arrays import Array, ArrayLike, Numbers
from planarimpact.ground.results import Event, EventKind, History, Rebound
from planarimpact.lumped import normal, stick_slip
from planarimpact.lumped.extremes import scaling
from planarimpact.lumped.stick_slip import Impacts

# Impacts solved together: few enough for the cache, enough to hide Python's overhead.
CHUNK = 16384
# Nodes and weights of Gauss on -1 to 1, for the work of friction within a phase.
QUADRATURE = np.polynomial.legendre.leggauss(20)


@checks.default_errors
def rebound(
    incidence: ArrayLike,
    mass_ratio: ArrayLike = 3.5,
    stiffness_ratio: ArrayLike = 1.21,
    restitution: ArrayLike = 1.0,
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

    Returns
    -------
    Rebound
        velocity, peak_friction, dissipation, regime, in the broadcast shape (scalars for
        scalars); velocity has the sign of `incidence` where the direction is kept.

    Raises
    ------
    InputError
        If an argument is not a finite real number in its range, or shapes do not broadcast.

    Notes
    -----
    The errors of velocity, peak friction and dissipation are at most a hundred times the effect of
    rounding the four arguments. This holds in every regime, and at the thresholds. The exception is
    a dissipation below 1e-16 of the energy, where T and N fall together (zeta^2 next to beta,
    e = 1). The time does not depend on the number of phases, which grows as omega/Omega: see
    `extremes.many_phases`. Stronge's printed equations differ in two places: the limit of slip
    throughout (see `slip_throughout_limit`) and the direction of the last slip, which at small e is
    the incident one.

    Examples
    --------
    >>> from planarimpact import Regime
    >>> result = rebound([0.5, 2.0, 8.0])
    >>> [Regime(code).name for code in result.regime]
    ['STICK_SLIP', 'SLIP_STICK_SLIP', 'SLIP_THROUGHOUT']
    >>> float(result.velocity[2])  # x - (1 + e) beta
    1.0
    """
    x, *groups = checks.impact(incidence, mass_ratio, stiffness_ratio, restitution)
    groups = [np.abs(x).reshape(-1), *(group.reshape(-1) for group in groups)]
    velocity, peak, work = (np.empty(x.size) for _ in range(3))
    regime = np.empty(x.size, np.uint8)
    for start in range(0, x.size, CHUNK):
        part = slice(start, start + CHUNK)
        outcome = scaling.solve(Impacts(*(group[part] for group in groups)))
        velocity[part], peak[part], work[part], regime[part] = outcome
    return Rebound.shaped(x, velocity, peak, work, regime)


@checks.default_errors
def slip_throughout_limit(
    mass_ratio: ArrayLike = 3.5, stiffness_ratio: ArrayLike = 1.21, restitution: ArrayLike = 1.0
) -> Array:
    """Smallest incidence that slides through the whole contact; all arguments broadcast.

    x = beta + max(0, e beta - zeta^2/e), or zeta^2 where that is larger; `ground.sliding` derives
    it. The paper prints (1 + e) beta (heading of Eq. 26), but its own condition for the end of the
    first slip, Eq. 21, has no root above the value given here.

    Parameters
    ----------
    mass_ratio, stiffness_ratio, restitution : array_like
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
    """
    _, *groups = checks.impact(0.0, mass_ratio, stiffness_ratio, restitution)
    return sliding.limit(*groups)[()]


@checks.default_errors
def history(
    incidence: float,
    mass_ratio: float = 3.5,
    stiffness_ratio: float = 1.21,
    restitution: float = 1.0,
    samples: int = 400,
) -> History:
    """Forces and velocity over one contact (Figs 3 and 4).

    Parameters
    ----------
    incidence, mass_ratio, stiffness_ratio, restitution : float
        As in `rebound`; scalars.
    samples : int
        At least 2: instants evenly spread over the contact. Events come on top, so that every
        one is a vertex.

    Returns
    -------
    History
        time in t_c, normal, friction, velocity, spring, events.

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
    mirror, scale, groups, phases = _phases(incidence, mass_ratio, stiffness_ratio, restitution)
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
) -> float:
    """Work of friction, integrated over the phases of slip: |F1| times the slip velocity.

    This checks `rebound(...).dissipation`, which comes from the balance of energy. The two differ
    by what the tangential spring loses when e = 0.

    Parameters
    ----------
    incidence, mass_ratio, stiffness_ratio, restitution : float
        As in `rebound`; scalars.

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
    _, scale, groups, phases = _phases(incidence, mass_ratio, stiffness_ratio, restitution)
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


def _phases(
    incidence: float, mass_ratio: float, stiffness_ratio: float, restitution: float
) -> tuple[float, float, tuple[float, float, float], list[tuple[stick_slip.Phase, Numbers]]]:
    """One impact: mirror sign, scale, (beta, zeta^2, e), and its phases, each with its last eta.

    Ratios and velocities have been multiplied by the scale.
    """
    checked = checks.impact(incidence, mass_ratio, stiffness_ratio, restitution)
    if checked[0].ndim:
        raise checks.InputError(f"shape = {checked[0].shape}: one contact takes scalars")
    x, *groups = (a.reshape(1) for a in checked)
    mirror = float(np.copysign(1.0, x[0]))
    impacts, scale = scaling.shrunk(Impacts(np.abs(x), *groups))
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
    return mirror, float(scale[0]), ratios, list(zip(trace, ends, strict=True))


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
