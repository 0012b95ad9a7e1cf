"""Contacts that lose energy, stepped through time: a second code for what the solver computes.

Two continua, rows of springs by the method of dimensionality reduction: viscoelastic (springs and
dashpots of one relaxation time) and elastic-plastic (Thornton 1997, with shear that flows while
metal yields). The solver has faster ways to both; no code is shared.

The effective mass m2, the incident normal velocity, the effective radius and the modulus E* are 1.
Tangential displacements are divided by mu, so that the normal force itself limits friction.
"""

import functools
from typing import NamedTuple

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import brentq, minimize_scalar

EXACT = {"rtol": 1e-12, "atol": 1e-14, "method": "DOP853"}
LONGEST = 1e3  # time after which a contact has surely ended
SHORT = 0.01  # of the duration: what is no gross slip
FLOW = 0.95  # by exp(-FLOW) a deflection decays while d_y of the approach becomes permanent


class Impact(NamedTuple):
    """What `impact` returns, of each incidence."""

    velocity: np.ndarray  # tangential, at separation, in mu v2(0)
    work: np.ndarray  # of friction, in mu^2 m2 v2(0)^2
    peak_friction: np.ndarray  # largest friction of all steps, in mu times the largest normal force
    gross_slips: np.ndarray  # how often the whole contact slides, see `_runs`


class Normal:
    """The normal motion of one contact: `end`, and deflection and velocity at some times.

    `peak` is the largest normal force, in (E* sqrt(R))^0.4 m2^0.6 v2(0)^1.2.
    """

    def __init__(self, phases):
        self.phases = phases
        self.end = phases[-1].t[-1]
        self.restitution = -phases[-1].y[1, -1]
        self.turn = phases[0].t[-1]

    def at(self, time):
        """Deflections and velocities."""
        first, *later = self.phases
        state = first.sol(np.minimum(time, self.turn))
        if later:
            state = np.where(time <= self.turn, state, later[0].sol(np.maximum(time, self.turn)))
        return state


def _until(force, gap, start, time):
    """Follow d' = v, v' = -force(d, v) until gap(d, v) falls through zero."""

    def over(_, state):
        return gap(*state)

    over.terminal, over.direction = True, -1
    span = time, time + LONGEST
    return solve_ivp(
        lambda _, s: [s[1], -force(*s)], span, start, events=over, dense_output=True, **EXACT
    )


def _two_phases(loading, unloading, over):
    """Loading until the velocity vanishes, unloading as `unloading(greatest deflection)` has it."""
    first = _until(loading, lambda d, v: v, [0.0, 1.0], 0.0)
    top, time = first.y[0, -1], first.t[-1]
    # The velocity is set to zero: a remainder of the root could pass for loading.
    second = _until(unloading(top), over(top), [top, 0.0], time)
    return Normal([first, second])


def viscous_motion(tau):
    """Loading and unloading of a viscoelastic sphere."""

    def force(d, v):
        drive = max(d + tau * v, 0.0)
        a2 = max(min(d, drive) if v < 0 else d, 0.0)
        return 2 * np.sqrt(a2) * (drive - a2 / 3)

    motion = _two_phases(force, lambda _: force, lambda _: lambda d, v: d + tau * v)
    # A dashpot puts the largest force before the greatest compression.
    ends, fine = (0.0, motion.turn), {"xatol": 1e-10}
    highest = minimize_scalar(lambda time: -force(*motion.at(time)), bounds=ends, options=fine)
    motion.peak = -highest.fun
    return motion


def plastic_motion(yield_radius):
    """Loading and unloading of a sphere that yields where its radius of contact reaches a value."""

    def loading(d, _):
        d = max(d, 0.0)
        if d <= yield_radius**2:
            return 4 / 3 * d**1.5
        # Slope pi p_y with the yield pressure p_y = 2 a_y/pi.
        return 4 / 3 * yield_radius**3 + 2 * yield_radius * (d - yield_radius**2)

    def unloading(top):
        radius, rest = residual(top)
        return lambda d, _: 4 / 3 * np.sqrt(radius) * max(d - rest, 0.0) ** 1.5

    def residual(top):
        radius = 4 / 3 * top**1.5 / loading(top, 0.0)
        return radius, top - top / radius

    motion = _two_phases(loading, unloading, lambda top: lambda d, v: d - residual(top)[1])
    motion.radius, motion.rest = residual(motion.phases[0].y[0, -1])
    motion.loading, motion.peak = loading, loading(motion.phases[0].y[0, -1], 0.0)
    return motion


MOTIONS = {
    "continuum.viscous": (viscous_motion, 1e-9, 20.0),
    "continuum.plastic": (plastic_motion, 1e-4, 1.2),
}


@functools.cache
def motion_with(model, restitution):
    """The normal motion with a coefficient of restitution, and the parameter that gives it."""
    make, low, high = MOTIONS[model]
    if restitution == 1.0:
        parameter = high if model == "continuum.plastic" else low
    else:

        def off(logarithm):
            return make(np.exp(logarithm)).restitution - restitution

        parameter = np.exp(brentq(off, np.log(low), np.log(high), xtol=1e-10))
    return make(parameter), parameter


def extrapolated(model, x, beta, zeta2, restitution, steps, springs):
    """As `impact`, with what half of the steps and springs say of the error: it falls with them."""
    fine, coarse = (
        impact(model, x, beta, zeta2, restitution, steps // n, springs // n) for n in (1, 2)
    )
    velocity, work, peak = (2 * a - b for a, b in zip(fine[:3], coarse[:3], strict=True))
    # Friction is no larger than its limit; an extrapolated one may be, by its own error.
    return Impact(velocity, work, np.minimum(peak, 1.0), fine.gross_slips)


def rebound(model, x, beta, zeta2, restitution, steps=600, springs=200):
    """Tangential velocities after impact, as `impact` takes its arguments."""
    return impact(model, x, beta, zeta2, restitution, steps, springs).velocity


# Error of `small_incidences`: twice the steps change it by up to 4e-4, up to this restitution.
# Viscous spheres that lose less relax within a step.
SMALL, LARGEST_RESTITUTION = 5e-4, 0.97


def small_incidences(loss, x, beta, zeta2, restitution):
    """Velocity at separation over x of contacts that slip in thin rings: its error is over x too.

    A ring thinner than a spring makes an error of the first order.
    """
    x = np.atleast_1d(x)
    groups = beta, zeta2, restitution
    coarse, fine = (rebound(f"continuum.{loss}", x, *groups, n, n // 4) / x for n in (800, 1600))
    return np.squeeze(2 * fine - coarse)


def impact(model, x, beta, zeta2, restitution, steps=600, springs=200):
    """Impacts of some incidences, with so many steps of time and springs over the radius."""
    motion, parameter = motion_with(model, float(restitution))
    row = {"continuum.viscous": _Viscous, "continuum.plastic": _Plastic}
    contact = row[model](motion, parameter, zeta2, springs)
    w = np.array(x, float)
    u, before, largest = np.zeros_like(w), np.zeros_like(w), np.zeros_like(w)
    # The steps meet the instant of greatest compression, where some forces jump.
    share = max(2, round(steps * motion.turn / motion.end))
    times = np.concatenate(
        [
            np.linspace(0, motion.turn, share + 1)[:-1],
            np.linspace(motion.turn, motion.end, max(2, steps - share) + 1),
        ]
    )
    middles, slides = (times[:-1] + times[1:]) / 2, []
    for dt, (d, v), loads in zip(
        np.diff(times), motion.at(middles).T, middles <= motion.turn, strict=True
    ):
        normal = max(d, 0.0), v, loads
        middle = u + w * dt / 2
        # Friction may depend on the velocity at the middle of the step: one correction.
        friction = contact.friction(normal, dt, middle, w - beta * before * dt / 2, keep=False)
        friction = contact.friction(normal, dt, middle, w - beta * friction * dt / 2, keep=True)
        w_new = w - beta * friction * dt
        u += (w + w_new) * dt / 2
        w, before, largest = w_new, friction, np.maximum(largest, np.abs(friction))
        slides.append(contact.slides)
    runs = [_runs(column, times / motion.end) for column in np.transpose(slides)]
    work = contact.work + np.zeros_like(w)
    if model == "continuum.plastic":  # and of the flow in shear
        work = (np.array(x, float) ** 2 - w**2) / (2 * beta)
    return Impact(w, work, largest / motion.peak, np.array(runs))


def _runs(slides, times):
    """How often `slides` is true for a while; interruptions shorter than `SHORT` are none.

    A contact that hardly slides flickers: in some steps its last spring still sticks.
    """
    changes = np.flatnonzero(np.diff(np.concatenate([[False], slides, [False]])))
    starts, ends = times[changes[::2]], times[changes[1::2]]
    if not starts.size:
        return 0
    apart = starts[1:] - ends[:-1] > SHORT
    return np.sum(ends[np.append(apart, True)] - starts[np.append(True, apart)] > SHORT)


class _Row:
    """A row of springs, each with what it remembers, c: its deflection is U + c where it sticks."""

    def __init__(self, motion, parameter, zeta2, springs):
        self.motion, self.parameter, self.zeta2 = motion, parameter, zeta2
        radius = np.sqrt(motion.at(np.array([motion.turn]))[0, 0])
        self.width = radius / springs
        self.r = (np.arange(springs) + 0.5) * self.width
        self.c, self.work = None, 0.0

    def _slide(self, before, after, held, share):
        """Keep what the springs remember, and add the work of friction where that has changed."""
        inside = np.count_nonzero(share == 1)
        self.slides = (after != before)[:, :inside].all(1) & (inside > 0)
        slid = before - after
        self.work = self.work + 2 * self.width * (held * share * slid).sum(1) / self.zeta2
        self.c = after

    def _share(self, radius):
        """How much of each spring's width lies inside the contact."""
        return np.clip((radius - self.r) / self.width + 0.5, 0.0, 1.0)


class _Viscous(_Row):
    def friction(self, normal, dt, u, w, keep):
        tau = self.parameter
        d, v, loads = normal
        drive = max(d + tau * v, 0.0)
        share = self._share(np.sqrt(d if loads else min(d, drive)))
        limit = self.zeta2 * np.maximum(drive - self.r**2, 0.0)
        pull = (u + tau * w)[:, None]
        # A spring that has not touched yet has no deflection.
        memory = -np.repeat(u[:, None], len(self.r), 1) if self.c is None else self.c
        memory = np.where(share > 0, memory, -u[:, None])
        wanted = pull + memory
        held = np.clip(wanted, -limit, limit)
        if keep:  # what is beyond the limit relaxes
            after = memory + (held - wanted) * -np.expm1(-dt / tau)
            self._slide(memory, after, held, share)
        return 2 * self.width * (held * share).sum(1) / self.zeta2


class _Plastic(_Row):
    flowed, u = 0.0, 0.0  # at the middle of the last step

    def friction(self, normal, dt, u, _, keep):
        d, v, loads = normal
        radius = self.motion.radius
        a2 = d if loads else radius * max(d - self.motion.rest, 0.0)
        # The pressure has Hertz' shape at all times, with the force and radius of Thornton's law.
        force = self.motion.loading(d, 0.0) if loads else 4 / 3 * a2**1.5 / radius
        share = self._share(np.sqrt(a2))
        limit = self.zeta2 * np.maximum(a2 - self.r**2, 0.0) * force / max(4 / 3 * a2**1.5, 1e-300)
        memory = -np.repeat(u[:, None], len(self.r), 1) if self.c is None else self.c
        memory = np.where(share > 0, memory, -u[:, None])
        flowed = self.flowed
        if loads and d > self.parameter**2:  # what does not spring back, over the approach at yield
            flowed = FLOW * (d - force / (4 / 3 * d**0.5)) / self.parameter**2
        half = np.exp((self.flowed - flowed) / 2)
        before = (self.u + np.zeros_like(u))[:, None]
        wanted = ((memory + before) * half + u[:, None] - before) * half
        held = np.clip(wanted, -limit, limit)
        if keep:
            self._slide(wanted - u[:, None], held - u[:, None], held, share)
            self.flowed, self.u = flowed, u
        return 2 * self.width * (held * share).sum(1) / self.zeta2
