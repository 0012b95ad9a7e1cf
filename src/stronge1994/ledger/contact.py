"""One contact of the paper's model, solved to rounding, in the symbols and signs of the paper.

v1(0), v2(0) < 0, F2 > 0, F1 = (kappa/zeta^2) u1 and du1/dt = -v1 in stick. The scales have no
common factor, so that a formula with a wrong factor cannot agree by accident.
"""

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any, TypeVar

import numpy as np
from scipy.integrate import cumulative_simpson

from planarimpact import lumped, models
from planarimpact.ground.arrays import Array, ArrayLike, Numbers
from planarimpact.ground.results import Event, EventKind, History, Rebound
from stronge1994.printed import dynamics

FRICTION, NORMAL_MASS, NORMAL_VELOCITY, STIFFNESS = 0.3, 1.7, -2.3, 5.9
# The sphere of the paper's examples (p. 444), and others, all with omega > Omega as it assumes,
# and omega < 2 Omega, beyond which stick can come back (`rebound.three_sequences`).
SPHERE = MASS_RATIO, STIFFNESS_RATIO = 3.5, 1.21
PAIRS = (SPHERE, (MASS_RATIO, 1.5), (2.5, 1.1), (4.0, 1.2))
RESTITUTIONS = (0.05, 0.15, 0.3, 0.6, 0.9, 1.0)

_Answer = TypeVar("_Answer")
_KNOWN: dict[tuple[Any, ...], Any] = {}


def once(solver: Callable[..., _Answer], *groups: ArrayLike, **settings: float | str) -> _Answer:
    """What a solver returns, computed once for equal arguments, as many checks share an impact.

    Callers must not change the result.

    >>> once(lumped.rebound, 1.0) is once(lumped.rebound, 1.0)
    True
    """
    arrays = [np.asarray(group, float) for group in groups]
    key = solver, *((array.shape, array.tobytes()) for array in arrays), *settings.items()
    if key not in _KNOWN:
        _KNOWN[key] = solver(*groups, **settings)
    return _KNOWN[key]


@dataclass(frozen=True)
class State:
    """Time, forces, tangential velocity and deflection at one instant, or at many."""

    t: Array
    force_2: Array
    force_1: Array
    v1: Array
    u1: Array


@dataclass(frozen=True)
class Contact:
    """A contact of the paper's model: its parameters, and states along it."""

    incidence: float
    mass_ratio: float
    stiffness_ratio: float
    restitution: float
    history: History

    friction = FRICTION
    m2 = NORMAL_MASS
    v2 = NORMAL_VELOCITY
    stiffness = STIFFNESS

    @property
    def m1(self) -> float:
        """Tangential effective mass."""
        return self.m2 / self.mass_ratio

    @property
    def v1(self) -> float:
        """Tangential velocity at t = 0."""
        return self.incidence * self.velocity_scale

    @property
    def normal_frequency(self) -> float:
        """Omega."""
        return np.sqrt(self.stiffness / self.m2)

    @property
    def tangential_frequency(self) -> float:
        """omega."""
        return np.sqrt(self.stiffness / (self.stiffness_ratio * self.m1))

    @property
    def compression_time(self) -> float:
        """t_c."""
        return np.pi / 2 / self.normal_frequency

    @property
    def force_scale(self) -> float:
        """m2 Omega |v2(0)|."""
        return -self.m2 * self.normal_frequency * self.v2

    @property
    def friction_scale(self) -> float:
        """mu times the scale of normal forces."""
        return self.friction * self.force_scale

    @property
    def velocity_scale(self) -> float:
        """mu v2(0), negative."""
        return self.friction * self.v2

    @property
    def path(self) -> State:
        """States at all samples and events."""
        return self._state(self.history)

    @property
    def events(self) -> list[tuple[EventKind, State]]:
        """States at the events, `(kind, State)` in order."""
        return [(event.kind, self._state(event)) for event in self.history.events]

    def first(self, kind: EventKind) -> State:
        """State at the first event of a kind."""
        return next(state for event_kind, state in self.events if event_kind == kind)

    def last(self, kind: EventKind) -> State:
        """State at the last event of a kind."""
        return [state for event_kind, state in self.events if event_kind == kind][-1]

    def between(self, start: Numbers, end: Numbers) -> State:
        """States of the path from one time to another, both included."""
        path = self.path
        inside = (path.t >= start) & (path.t <= end)
        columns = (path.t, path.force_2, path.force_1, path.v1, path.u1)
        return State(*(column[inside] for column in columns))

    @property
    def rebound(self) -> Rebound:
        """The rebound by `lumped.rebound`, which is not computed from the path."""
        groups = self.mass_ratio, self.stiffness_ratio, self.restitution
        return once(lumped.rebound, self.incidence, *groups)

    @property
    def final_velocity(self) -> float:
        """v1(tf), of `rebound`."""
        return float(self.rebound.velocity) * self.velocity_scale

    def impulse(self, t: Numbers) -> Array:
        """p(t) by Table 1."""
        groups = self.v2, self.m2, self.normal_frequency, self.restitution
        return dynamics.table_1_impulse(t, *groups)

    def impulse_left(self, t: Numbers) -> Array:
        """p(tf) - p(t), by Table 1."""
        return -(1 + self.restitution) * self.m2 * self.v2 - self.impulse(t)

    @property
    def last_slip_direction(self) -> float:
        """s of the last slip, from the force there: F1 = -mu s F2."""
        return -float(np.sign(self.last(EventKind.SLIP).force_1))

    def _state(self, event_or_history: Event | History) -> State:
        return State(
            np.asarray(event_or_history.time) * self.compression_time,
            np.asarray(event_or_history.normal) * self.force_scale,
            np.asarray(event_or_history.friction) * self.friction_scale,
            np.asarray(event_or_history.velocity) * self.velocity_scale,
            np.asarray(event_or_history.spring) * -self.velocity_scale / self.normal_frequency,
        )


def contact(
    incidence: float,
    mass_ratio: float = MASS_RATIO,
    stiffness_ratio: float = STIFFNESS_RATIO,
    restitution: float = 1.0,
    samples: int = 65,
) -> Contact:
    """Solve one contact.

    >>> impact = contact(1.0)
    >>> bool(impact.v1 < 0 and impact.first(EventKind.STICK).t == 0)
    True
    """
    groups = incidence, mass_ratio, stiffness_ratio, restitution
    return Contact(*groups, once(lumped.history, *groups, samples=samples))


def integral(impact: Contact, values: Array) -> Array:
    """Integral over time of values along a path, piece by piece between its kinks.

    >>> impact = contact(1.0, samples=2001)
    >>> gained = integral(impact, impact.path.force_2)[-1] / (-impact.m2 * impact.v2)
    >>> round(float(gained), 9)  # 1 + e
    2.0
    """
    t = impact.path.t
    result, total = np.zeros_like(t), 0.0
    kinks = [state.t for _, state in impact.events]
    for start, end in zip(kinks, kinks[1:], strict=False):
        inside = (t >= start) & (t <= end)
        if inside.sum() > 1:
            result[inside] = total + cumulative_simpson(values[inside], x=t[inside], initial=0)
            total = result[inside][-1]
    return result


@dataclass(frozen=True)
class NormalMotion:
    """Normal impulse, velocity, displacement and work along one contact, by quadrature."""

    impact: Contact
    impulse: Array
    velocity: Array
    displacement: Array
    work: Array

    @property
    def top(self) -> int:
        """Index of maximum compression."""
        return int(np.flatnonzero(self.impact.path.t == self.impact.compression_time)[0])


def without_micro_slip(incidence: Array) -> Rebound:
    """Rebound of the paper's sphere, e = 1, by a Hertz contact that slips as a whole; to 1e-3."""
    return once(models.get("timestep.mindlin_rescaled").rebound, incidence, *SPHERE, steps=4096)


def normal_motions() -> Iterator[tuple[float, NormalMotion]]:
    """Normal motions for all restitutions of the checks: (e, NormalMotion)."""
    for e in RESTITUTIONS:
        yield e, normal_motion(e)


def normal_motion(restitution: float) -> NormalMotion:
    """Normal motion of a contact of the paper's sphere, good to 1e-9."""
    impact = contact(0.7, restitution=restitution, samples=4001)
    force = impact.path.force_2
    impulse = integral(impact, force)
    velocity = impact.v2 + impulse / impact.m2
    work = integral(impact, force * velocity)
    return NormalMotion(impact, impulse, velocity, integral(impact, velocity), work)


def initial_stick() -> Iterator[Contact]:
    """Contacts over the paper's range of initial stick, 0 < x < zeta^2."""
    for beta, zeta2 in PAIRS:
        for e in RESTITUTIONS:
            for share in (0.02, 0.4, 0.8, 0.99):
                yield contact(share * zeta2, beta, zeta2, e)


def slip_stick_slip(
    restitutions: Sequence[float] = RESTITUTIONS, late: bool | None = None
) -> Iterator[Contact]:
    """Contacts that slip, stick and slip; `late` selects whether stick begins in restitution."""
    for beta, zeta2 in PAIRS:
        for e in restitutions:
            limit = float(lumped.slip_throughout_limit(beta, zeta2, e))
            early = [zeta2 + share * (beta - zeta2) for share in (0.02, 0.4, 0.8, 0.99)]
            later = [beta + share * (limit - beta) for share in (0.1, 0.5, 0.9)]
            if late is not True:
                yield from (contact(x, beta, zeta2, e) for x in early)
            if late is not False and limit > beta:
                yield from (contact(x, beta, zeta2, e) for x in later)


def with_stick() -> Iterator[Contact]:
    """Contacts that stick, at first or after slip, and slip to the end."""
    yield from initial_stick()
    yield from slip_stick_slip()


def reversed_last_slip(contacts: Iterable[Contact]) -> Iterator[Contact]:
    """Those contacts whose last slip runs against the incident direction, s = +1."""
    return (impact for impact in contacts if impact.last_slip_direction > 0)


def slip_throughout() -> Iterator[Contact]:
    """Contacts over the paper's range of slip throughout, x > (1 + e) beta."""
    for beta, zeta2 in PAIRS:
        for e in RESTITUTIONS:
            for factor in (1.001, 1.3, 4.0):
                yield contact(factor * (1 + e) * beta, beta, zeta2, e)
