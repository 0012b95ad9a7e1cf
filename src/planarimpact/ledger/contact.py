"""One contact, solved exactly, in the symbols and signs of the paper.

v1(0), v2(0) < 0, F2 > 0, F1 = (kappa/zeta^2) u1 and du1/dt = -v1 in stick. Scales are arbitrary
numbers with no common factor, so that a formula with a wrong one cannot agree by accident.
"""

from dataclasses import dataclass

import numpy as np
from scipy.integrate import cumulative_simpson

from planarimpact import lumped, timestep
from planarimpact.printed import dynamics
from planarimpact.results import Event, EventKind, History

FRICTION, NORMAL_MASS, NORMAL_VELOCITY, STIFFNESS = 0.3, 1.7, -2.3, 5.9
# The sphere of the paper's examples (p. 444), and others, all with omega > Omega as it assumes,
# and omega < 2 Omega, beyond which stick can come back (`rebound.three_sequences`).
SPHERE = MASS_RATIO, STIFFNESS_RATIO = 3.5, 1.21
PAIRS = (SPHERE, (MASS_RATIO, 1.5), (2.5, 1.1), (4.0, 1.2))
RESTITUTIONS = (0.05, 0.15, 0.3, 0.6, 0.9, 1.0)


@dataclass(frozen=True)
class State:
    """Time, forces, tangential velocity and deflection at one instant, or at many."""

    t: float
    force_2: float
    force_1: float
    v1: float
    u1: float


@dataclass(frozen=True)
class Contact:
    """An exact contact: parameters of the paper, and states along it."""

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
    def m1(self):
        """Tangential effective mass."""
        return self.m2 / self.mass_ratio

    @property
    def v1(self):
        """Tangential velocity at t = 0."""
        return self.incidence * self.velocity_scale

    @property
    def normal_frequency(self):
        """Omega."""
        return np.sqrt(self.stiffness / self.m2)

    @property
    def tangential_frequency(self):
        """omega."""
        return np.sqrt(self.stiffness / (self.stiffness_ratio * self.m1))

    @property
    def compression_time(self):
        """t_c."""
        return np.pi / 2 / self.normal_frequency

    @property
    def force_scale(self):
        """m2 Omega |v2(0)|."""
        return -self.m2 * self.normal_frequency * self.v2

    @property
    def friction_scale(self):
        """mu times the scale of normal forces."""
        return self.friction * self.force_scale

    @property
    def velocity_scale(self):
        """mu v2(0), negative."""
        return self.friction * self.v2

    @property
    def path(self):
        """States at all samples and events."""
        return self._state(self.history)

    @property
    def events(self):
        """States at the events, `(kind, State)` in order."""
        return [(event.kind, self._state(event)) for event in self.history.events]

    def first(self, kind):
        """State at the first event of a kind."""
        return next(state for found, state in self.events if found == kind)

    def last(self, kind):
        """State at the last event of a kind."""
        return [state for found, state in self.events if found == kind][-1]

    def between(self, start, end):
        """States of the path from one time to another, both included."""
        path = self.path
        inside = (path.t >= start) & (path.t <= end)
        columns = (path.t, path.force_2, path.force_1, path.v1, path.u1)
        return State(*(column[inside] for column in columns))

    @property
    def rebound(self):
        """What `lumped.rebound` finds: another way than the path's."""
        groups = self.mass_ratio, self.stiffness_ratio, self.restitution
        return lumped.rebound(self.incidence, *groups)

    @property
    def final_velocity(self):
        """v1(tf), of `rebound`."""
        return float(self.rebound.velocity) * self.velocity_scale

    def impulse(self, t):
        """p(t) by Table 1."""
        groups = self.v2, self.m2, self.normal_frequency, self.restitution
        return dynamics.table_1_impulse(t, *groups)

    def impulse_left(self, t):
        """p(tf) - p(t), by Table 1."""
        return -(1 + self.restitution) * self.m2 * self.v2 - self.impulse(t)

    @property
    def last_slip_direction(self):
        """s of the last slip, from the force there: F1 = -mu s F2."""
        return -float(np.sign(self.last(EventKind.SLIP).force_1))

    def _state(self, found: Event | History):
        return State(
            np.asarray(found.time) * self.compression_time,
            np.asarray(found.normal) * self.force_scale,
            np.asarray(found.friction) * self.friction_scale,
            np.asarray(found.velocity) * self.velocity_scale,
            np.asarray(found.spring) * -self.velocity_scale / self.normal_frequency,
        )


def contact(
    incidence,
    mass_ratio=MASS_RATIO,
    stiffness_ratio=STIFFNESS_RATIO,
    restitution=1.0,
    samples=65,
):
    """Solve one contact.

    Examples
    --------
    >>> found = contact(1.0)
    >>> bool(found.v1 < 0 and found.first(EventKind.STICK).t == 0)
    True
    """
    groups = incidence, mass_ratio, stiffness_ratio, restitution
    return Contact(*groups, lumped.history(*groups, samples))


def integral(found, values):
    """Integral over time of values along a path, piece by piece between its kinks.

    Examples
    --------
    >>> found = contact(1.0, samples=2001)
    >>> gained = integral(found, found.path.force_2)[-1] / (-found.m2 * found.v2)
    >>> round(float(gained), 9)  # 1 + e
    2.0
    """
    t = found.path.t
    result, total = np.zeros_like(t), 0.0
    kinks = [state.t for _, state in found.events]
    for start, end in zip(kinks, kinks[1:], strict=False):
        inside = (t >= start) & (t <= end)
        if inside.sum() > 1:
            result[inside] = total + cumulative_simpson(values[inside], x=t[inside], initial=0)
            total = result[inside][-1]
    return result


@dataclass(frozen=True)
class NormalMotion:
    """What the exact normal force does along one contact, by quadrature."""

    found: Contact
    impulse: np.ndarray
    velocity: np.ndarray
    displacement: np.ndarray
    work: np.ndarray

    @property
    def top(self):
        """Index of maximum compression."""
        return int(np.flatnonzero(self.found.path.t == self.found.compression_time)[0])


def without_micro_slip(incidence):
    """Rebound of the paper's sphere, e = 1, by a Hertz contact that slips as a whole; to 1e-3."""
    return timestep.mindlin_rescaled(incidence, *SPHERE, steps=4096)


def normal_motions():
    """Normal motions for all restitutions of the checks: (e, NormalMotion)."""
    for e in RESTITUTIONS:
        yield e, normal_motion(e)


def normal_motion(restitution):
    """Normal motion of a contact of the paper's sphere, good to 1e-9."""
    found = contact(0.7, restitution=restitution, samples=4001)
    force = found.path.force_2
    impulse = integral(found, force)
    velocity = found.v2 + impulse / found.m2
    work = integral(found, force * velocity)
    return NormalMotion(found, impulse, velocity, integral(found, velocity), work)


def initial_stick():
    """Contacts over the paper's range of initial stick, 0 < x < zeta^2."""
    for beta, zeta2 in PAIRS:
        for e in RESTITUTIONS:
            for share in (0.02, 0.4, 0.8, 0.99):
                yield contact(share * zeta2, beta, zeta2, e)


def slip_stick_slip(restitutions=RESTITUTIONS, late=None):
    """Contacts that slip, stick and slip; `late`: stick begins in restitution, or not."""
    for beta, zeta2 in PAIRS:
        for e in restitutions:
            limit = float(lumped.slip_throughout_limit(beta, zeta2, e))
            early = [zeta2 + share * (beta - zeta2) for share in (0.02, 0.4, 0.8, 0.99)]
            later = [beta + share * (limit - beta) for share in (0.1, 0.5, 0.9)]
            if late is not True:
                yield from (contact(x, beta, zeta2, e) for x in early)
            if late is not False and limit > beta:
                yield from (contact(x, beta, zeta2, e) for x in later)


def with_stick():
    """Contacts that stick, at first or after slip, and slip to the end."""
    yield from initial_stick()
    yield from slip_stick_slip()


def slip_throughout():
    """Contacts over the paper's range of slip throughout, x > (1 + e) beta."""
    for beta, zeta2 in PAIRS:
        for e in RESTITUTIONS:
            for factor in (1.001, 1.3, 4.0):
                yield contact(factor * (1 + e) * beta, beta, zeta2, e)
