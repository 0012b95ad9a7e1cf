"""One contact of the paper's model, solved to rounding, in the symbols and signs of the paper.

v1(0), v2(0) < 0, F2 > 0, F1 = (kappa/zeta^2) u1 and du1/dt = -v1 in stick. The scales have no
common factor, so that a formula with a wrong factor cannot agree by accident.

Generators of contacts, `initial_stick` to `slip_throughout`, are the places at which a printed
equation is compared with the model.
"""

import inspect
from collections.abc import Callable, Iterator, Sequence
from typing import Any, NamedTuple

import numpy as np

from planarimpact import lumped, models, rigid
from planarimpact.common.arrays import Array, ArrayLike, Numbers
from planarimpact.common.results import Event, EventKind, History, Rebound
from stronge1994.printed import equations

# The sphere of the paper's examples (p. 444), and others, all with omega > Omega as it assumes,
# and omega < 2 Omega, beyond which stick can come back (`rebound.three_sequences`).
SPHERE = MASS_RATIO, STIFFNESS_RATIO = 3.5, 1.21
PAIRS = (SPHERE, (MASS_RATIO, 1.5), (2.5, 1.1), (4.0, 1.2))
RESTITUTIONS = (0.05, 0.15, 0.3, 0.6, 0.9, 1.0)
# Stiffness ratio of a contact that is all but without tangential compliance.
HARD = 1e-4
# Incidences of Figs 5 and 6, 0 left out.
INCIDENCE = np.linspace(0, 8, 2001)[1:]
# Where slip throughout begins on the paper's sphere at e = 1: 2 m2/m1 - zeta^2.
ELASTIC_LIMIT = 2 * MASS_RATIO - STIFFNESS_RATIO

# What a check yields at one place.
Gaps = Iterator[ArrayLike]
_KNOWN: dict[tuple[Any, ...], Any] = {}


def once(solver: Callable[..., Any], *groups: ArrayLike, **settings: float | str) -> Any:
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


class State(NamedTuple):
    """Time, forces, tangential velocity and deflection at one instant, or at many."""

    t: Array
    force_2: Array
    force_1: Array
    v1: Array
    u1: Array


# Of a contact without such an event.
NEVER = State(*5 * [np.array(np.nan)])


def cumulative(values: Array, time: Array) -> Array:
    """Integral of values over time up to each place, by Simpson's rule.

    >>> cumulative(np.array([0.0, 1.0, 4.0]), np.array([0.0, 1.0, 2.0])).tolist()[::2]
    [0.0, 2.6666666666666665]
    """
    # Each start of Snakemake imports this package, and SciPy would take longer than all else in it.
    from scipy.integrate import cumulative_simpson

    return cumulative_simpson(values, x=time, initial=0)


class Contact:
    """A solved contact: its symbols, its `path` (states at all samples), and its `events`.

    The symbols are named as in `stronge1994.printed`. Instants are named as in the paper, t2 at the
    start of stick, t1 or t3 at the onset of the last slip; they are nan where there is none.

    >>> impact = Contact(1.0)
    >>> bool(impact.v1 < 0 and impact.t2 == 0)
    True
    """

    friction = 0.3
    m2 = 1.7
    v2 = -2.3
    stiffness = 5.9
    compression_impulse = -m2 * v2
    normal_frequency = np.sqrt(stiffness / m2)
    compression_time = np.pi / 2 / normal_frequency
    force_scale = -m2 * normal_frequency * v2
    friction_scale = friction * force_scale
    velocity_scale = friction * v2  # negative

    def __init__(
        self,
        incidence: float,
        mass_ratio: float = MASS_RATIO,
        stiffness_ratio: float = STIFFNESS_RATIO,
        restitution: float = 1.0,
        samples: int = 65,
    ) -> None:
        self.incidence, self.restitution = incidence, restitution
        self.mass_ratio, self.stiffness_ratio = mass_ratio, stiffness_ratio
        self.groups = incidence, mass_ratio, stiffness_ratio, restitution
        self.m1 = self.m2 / mass_ratio
        self.v1 = incidence * self.velocity_scale
        self.slope = self.v1 / self.v2
        self.tangential_frequency = np.sqrt(self.stiffness / (stiffness_ratio * self.m1))
        history = once(lumped.history, *self.groups, samples=samples)
        self.path = self._state(history)
        self.events = [(event.kind, self._state(event)) for event in history.events]
        first, last = dict(reversed(self.events)), dict(self.events)
        self.top = first[EventKind.MAXIMUM_COMPRESSION]
        self.end = last[EventKind.SEPARATION]
        self.start = first.get(EventKind.STICK, NEVER)
        self.onset = last.get(EventKind.SLIP, NEVER)
        self.t2, self.v1_t2, self.u1_t2 = self.start.t, self.start.v1, self.start.u1
        self.t1 = self.t3 = self.onset.t
        self.v1_t1 = self.v1_t3 = self.onset.v1
        # s of the last slip, from the force there: F1 = -mu s F2.
        self.slip_direction = -float(np.sign(self.onset.force_1))

    def _state(self, event_or_history: Event | History) -> State:
        return State(
            np.asarray(event_or_history.time) * self.compression_time,
            np.asarray(event_or_history.normal) * self.force_scale,
            np.asarray(event_or_history.friction_force) * self.friction_scale,
            np.asarray(event_or_history.velocity) * self.velocity_scale,
            np.asarray(event_or_history.spring) * -self.velocity_scale / self.normal_frequency,
        )

    def printed(self, formula: Callable[..., Any], **others: Any) -> Any:
        """A formula of `stronge1994.printed` with the symbols of this contact.

        `others` are arguments that a contact does not have, or that take the place of its own.

        >>> Contact(8.0).printed(equations.eq_27_rebound)
        1.0
        """
        names = inspect.signature(formula).parameters
        return formula(**{n: others[n] if n in others else getattr(self, n) for n in names})

    def between(self, start: Numbers, end: Numbers) -> State:
        """States of the path from one time to another, both included."""
        inside = (self.path.t >= start) & (self.path.t <= end)
        return State(*(column[inside] for column in self.path))

    @property
    def rebound(self) -> Rebound:
        """The rebound by `lumped.rebound`, which is not computed from the path."""
        return once(lumped.rebound, *self.groups)

    @property
    def final(self) -> float:
        """v1(tf), of `rebound`."""
        return float(self.rebound.velocity) * self.velocity_scale

    def impulse(self, t: Numbers) -> Array:
        """p(t) by Table 1."""
        return self.printed(equations.table_1_impulse, t=t)

    def angle(self, t: Numbers) -> Numbers:
        """Angle of restitution at t."""
        return self.printed(equations.restitution_angle, t=t)

    def by_half(
        self,
        t: Numbers,
        in_compression: Callable[[Numbers], Array],
        in_restitution: Callable[[Numbers], Array],
    ) -> Array:
        """A formula for each half of the contact, as in Table 1: functions of the angle."""
        ways = {"in_compression": in_compression, "in_restitution": in_restitution}
        return self.printed(equations.halves, t=t, **ways)

    def strain_energy(self, state: State) -> Array:
        """Tangential strain energy in a state."""
        return self.stiffness / self.stiffness_ratio * state.u1**2 / 2

    @property
    def impulse_left(self) -> Array:
        """p(tf) less p at the onset of the last slip, by Table 1."""
        return -(1 + self.restitution) * self.m2 * self.v2 - self.impulse(self.t1)

    @property
    def g1(self) -> Array:
        """Normal impulse after t1 over that of compression, by the formula after Eq. 14."""
        return self.printed(equations.impulse_ratio)

    def integral(self, values: Array) -> Array:
        """Integral over time of values along the path, piece by piece between its kinks.

        >>> impact = Contact(1.0, samples=2001)
        >>> gained = impact.integral(impact.path.force_2)[-1] / impact.compression_impulse
        >>> round(float(gained), 9)  # 1 + e
        2.0
        """
        t = self.path.t
        result, total = np.zeros_like(t), 0.0
        kinks = [state.t for _, state in self.events]
        for start, end in zip(kinks, kinks[1:], strict=False):
            inside = (t >= start) & (t <= end)
            if inside.sum() > 1:
                result[inside] = total + cumulative(values[inside], t[inside])
                total = result[inside][-1]
        return result


class NormalMotion(Contact):
    """A contact with its normal motion by quadrature, all along the path.

    `brought` is the normal impulse; `at_top` is the index of maximum compression.
    """

    def __init__(self, *groups: Any, **settings: Any) -> None:
        super().__init__(*groups, **settings)
        force = self.path.force_2
        self.brought = self.integral(force)
        self.velocity = self.v2 + self.brought / self.m2
        self.displacement = self.integral(self.velocity)
        self.work = self.integral(force * self.velocity)
        self.at_top = int(np.flatnonzero(self.path.t == self.compression_time)[0])


def normal_motions(restitutions: Sequence[float] = RESTITUTIONS) -> Iterator[NormalMotion]:
    """Normal motions of the paper's sphere, good to 1e-9."""
    return (NormalMotion(0.7, restitution=e, samples=4001) for e in restitutions)


def of_sphere(*incidences: float, **settings: float) -> Callable[[], list[Contact]]:
    """Finely sampled contacts of the paper's sphere, as a function that solves them."""
    return lambda: [Contact(x, samples=2001, **settings) for x in incidences]


def initial_stick() -> Iterator[Contact]:
    """Contacts over the paper's range of initial stick, 0 < x < zeta^2."""
    for beta, zeta2 in PAIRS:
        for e in RESTITUTIONS:
            for share in (0.02, 0.4, 0.8, 0.99):
                yield Contact(share * zeta2, beta, zeta2, e)


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
                yield from (Contact(x, beta, zeta2, e) for x in early)
            if late is not False and limit > beta:
                yield from (Contact(x, beta, zeta2, e) for x in later)


def with_stick() -> Iterator[Contact]:
    """Contacts that stick, at first or after slip, and slip to the end."""
    yield from initial_stick()
    yield from slip_stick_slip()


def reversed_after_stick() -> Iterator[Contact]:
    """Contacts of initial stick whose last slip runs against the incident direction, s = +1."""
    return (impact for impact in initial_stick() if impact.slip_direction > 0)


def reversed_after_slip() -> Iterator[Contact]:
    """Contacts that slip, stick and slip back, s = +1."""
    return (impact for impact in slip_stick_slip() if impact.slip_direction > 0)


def slip_throughout() -> Iterator[Contact]:
    """Contacts over the paper's range of slip throughout, x > (1 + e) beta."""
    for beta, zeta2 in PAIRS:
        for e in RESTITUTIONS:
            for factor in (1.001, 1.3, 4.0):
                yield Contact(factor * (1 + e) * beta, beta, zeta2, e)


def lumped_sphere(x: Array) -> Rebound:
    """Rebounds of the paper's sphere, e = 1."""
    return once(lumped.rebound, x, *SPHERE)


def rigid_sphere(x: Array) -> Rebound:
    """The same without tangential compliance."""
    return rigid.rebound(x, MASS_RATIO)


def without_micro_slip(incidence: Array) -> Rebound:
    """Rebound of the paper's sphere, e = 1, by a Hertz contact that slips as a whole; to 1e-3.

    An incidence above 8 is taken as 8, where it slides throughout with the same peak.
    """
    solver = models.get("timestep.mindlin_rescaled").rebound
    return once(solver, np.minimum(incidence, 8.0), *SPHERE, steps=4096)


def boundary(holds: Callable[[float], bool], low: float, high: float) -> float:
    """Where a property that holds at `low` and not at `high` is lost, by bisection.

    >>> round(boundary(lambda x: x < 2, 0.0, 8.0), 12)
    2.0
    """
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if holds(middle) else (low, middle)
    return low
