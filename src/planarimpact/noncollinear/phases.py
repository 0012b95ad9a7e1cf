"""Closed forms of stick and slip in a non-collinear contact (Stronge 1994, Eqs 1-5, 8, 9).

Units: 1/Omega, |v2(0)|, m2 Omega |v2(0)| with Omega^2 = kappa/m2, for both directions (friction
is not in units of mu here, so mu = 0 is a case like any other). N normal force, y velocity of
approach, F friction, V tangential velocity, C = m2 c the coupling, beta = m2/m1:

    y' = -N + C F,   V' = -beta F + C N,   stick: F' = V/zeta^2,   slip: F = g mu N.

In compression N' = y. On the line of unloading N' = y/e^2. With time in units of e and y in units
of e this is N' = y again, and V' gets the factor e. This factor is the `pace`, which is 1 in
compression. So e may be as small as one likes.

Slip. N, y and V depend on the normal impulse P alone: y and V are linear in P, N^2 is quadratic.
Every event of slip is the root of a polynomial of degree one or two. The effective normal inverse
mass 1 - g mu C may be negative: then the body jams, and its forces grow exponentially.

Stick. N and zeta F/pace are two oscillators coupled by one symmetric matrix: two modes.
"""

from typing import NamedTuple, Self

import numpy as np

from planarimpact.ground.arrays import Array, Numbers


class Groups(NamedTuple):
    """Groups of impacts, arrays of shape (n,): beta, C, zeta^2, mu, and the pace of this half."""

    mass_ratio: Array
    coupling: Array
    stiffness_ratio: Array
    friction: Array
    pace: Array


class State(NamedTuple):
    """Forces N, F and velocities y, V of contacts, arrays of shape (n,); y in units of the pace."""

    normal: Array
    approach: Array
    friction: Array
    velocity: Array


class Slip(NamedTuple):
    """Slip in the direction g = +1 or -1 from a state on.

    `mass` is 1 - g mu C; the speed of slip, per unit of time at this pace, is
    `speed + slope P`.
    """

    state: State
    groups: Groups
    direction: Numbers
    mass: Array
    speed: Array
    slope: Array

    @classmethod
    def start(cls, state: State, groups: Groups, direction: Numbers) -> Self:
        """Slip that starts at this state."""
        beta, coupling, zeta2, mu, pace = groups
        mass = 1 - direction * mu * coupling
        speed = pace * direction * state.velocity - mu * zeta2 * state.approach
        slope = pace**2 * (direction * coupling - mu * beta) + mu * zeta2 * mass
        return cls(state, groups, direction, mass, np.maximum(speed, 0.0), slope)

    def stop(self) -> Array:
        """Impulse at which the speed of slip vanishes, or inf; never without friction."""
        slows = (self.slope < 0) & (self.groups.friction > 0)
        return np.where(slows, self.speed / np.where(slows, -self.slope, 1.0), np.inf)

    def turn(self) -> Array:
        """Impulse at which approach ends, or inf where the body jams."""
        y = self.state.approach
        return np.where(self.mass > 0, y / np.where(self.mass > 0, self.mass, 1.0), np.inf)

    def separation(self) -> Array:
        """Impulse at which the normal force vanishes, or inf."""
        n, y, m = self.state.normal, self.state.approach, self.mass
        square = y * y + m * n * n
        root = np.sqrt(np.maximum(square, 0.0))
        falls = (y <= 0) & (square >= 0)
        turns = (y > 0) & (m > 0)
        late = (y + root) / np.where(turns, m, 1.0)
        # Without cancellation; no force is left where n = 0.
        early = n * n / np.where(falls & (n > 0), root - y, 1.0)
        return np.where(falls, early, np.where(turns, late, np.inf))

    def reload(self, peak: Array) -> Array:
        """Impulse at which the force reaches its earlier `peak` again, or inf."""
        n, y, m = self.state.normal, self.state.approach, self.mass
        missing = (peak - n) * (peak + n)
        square = y * y - m * missing
        root = np.sqrt(np.maximum(square, 0.0))
        rises = (y > 0) & (square >= 0)
        jams = (y <= 0) & (m < 0)
        early = missing / np.where(rises, y + root, 1.0)
        late = (root - y) / np.where(jams, -m, 1.0)
        return np.where(rises, early, np.where(jams, late, np.inf))

    def after(self, impulse: Array, separation: Array) -> State:
        """State after an impulse, given that of separation (inf where there is none)."""
        n, y = self.state.normal, self.state.approach
        ends = np.isfinite(separation) & (separation > 0)
        last = np.where(ends, separation, 1.0)
        near = (last - impulse) * (self.mass * impulse + n * n / last)  # no cancellation near it
        far = n * n + impulse * (2 * y - self.mass * impulse)
        normal = np.sqrt(np.maximum(np.where(ends, near, far), 0.0))
        return self._state(impulse, normal)

    def work(self, impulse: Array) -> Array:
        """Work of friction over an impulse."""
        return self.groups.friction * impulse * (self.speed + self.slope * impulse / 2)

    def duration(self, impulse: Array, normal_after: Array) -> Array:
        """Time at this pace: by the tangent of its half, which is P/(N + N')."""
        forces = self.state.normal + normal_after
        half = impulse / np.where(forces > 0, forces, 1.0)
        rate = np.sqrt(np.abs(self.mass))
        # An approach to N = 0 may take forever: rounding then decides how long it lasts.
        tangent = np.minimum(rate * half, np.nextafter(1.0, 0.0))
        angle = np.where(self.mass > 0, np.arctan(rate * half), np.arctanh(tangent))
        return 2 * np.where(rate * half > 1e-9, angle / np.maximum(rate, 1e-300), half)

    def at(self, time: Array) -> State:
        """States at times of this pace, for one contact and an array of times."""
        n, y = self.state.normal, self.state.approach
        sine, half = self._sine(time), self._sine(time / 2)
        lag = 2 * half * half  # (1 - cosine)/mass
        impulse = n * sine + y * lag
        normal = n * (1 - self.mass * lag) + y * sine
        return self._state(impulse, normal)

    def _state(self, impulse: Array, normal: Array) -> State:
        """State after an impulse, which leaves this normal force."""
        beta, coupling, _, mu, pace = self.groups
        push = coupling - self.direction * mu * beta
        return State(
            normal,
            self.state.approach - self.mass * impulse,
            self.direction * mu * normal,
            self.state.velocity + pace * push * impulse,
        )

    def _sine(self, time: Array) -> Array:
        """sin(rate t)/rate with rate^2 = mass, of either sign."""
        rate = np.sqrt(np.abs(self.mass))
        if np.all(rate == 0):
            return time
        return (np.sin(rate * time) if np.all(self.mass > 0) else np.sinh(rate * time)) / rate


class Stick(NamedTuple):
    """Stick from a state on, as two modes a cos(rate t) + b sin(rate t).

    `cosine` and `sine` turn modes into forces: N = cosine p + sine q, F scale = cosine q - sine p.
    `p` and `q` hold (a, b). `sizes` are the sizes of the terms of p and q, before any cancellation.
    """

    cosine: Array
    sine: Array
    scale: Array
    zeta: Array
    rate_p: Array
    rate_q: Array
    p: tuple[Array, Array]
    q: tuple[Array, Array]
    sizes: tuple[Array, ...]

    @classmethod
    def start(cls, state: State, groups: Groups) -> Self:
        """Stick that starts at this state."""
        beta, coupling, zeta2, _, pace = groups
        zeta = np.sqrt(zeta2)
        scale = zeta / pace
        # Matrix [[1, -d], [-d, b]] of N and F scale, diagonalised by one rotation of Jacobi's.
        own = pace**2 * beta / zeta2
        mixed = -coupling / scale
        gap = own - 1
        reach = gap + np.where(gap < 0, -1.0, 1.0) * np.hypot(gap, 2 * mixed)
        tangent = 2 * mixed / np.where(reach == 0, 1.0, reach)
        cosine = 1 / np.sqrt(1 + tangent * tangent)
        sine = tangent * cosine
        first, second = 1 - tangent * mixed, own + tangent * mixed
        # The smaller eigenvalue from the determinant, which does not cancel.
        determinant = (pace / zeta) ** 2 * (beta - coupling * coupling)
        first, second = (
            np.where(first < second, determinant / second, first),
            np.where(first < second, second, determinant / first),
        )
        rate_p, rate_q = np.sqrt(first), np.sqrt(second)
        force, swing = scale * state.friction, state.velocity / zeta
        p = cosine * state.normal - sine * force, (cosine * state.approach - sine * swing) / rate_p
        q = sine * state.normal + cosine * force, (sine * state.approach + cosine * swing) / rate_q
        across = np.abs(sine)
        sizes = tuple(
            own * np.hypot(state.normal, state.approach / rate)
            + other * np.hypot(force, swing / rate)
            for own, other, rate in ((cosine, across, rate_p), (across, cosine, rate_q))
        )
        return cls(cosine, sine, scale, zeta, rate_p, rate_q, p, q, sizes)

    def at(self, time: Array) -> State:
        """States at times of this pace, of the shape of the contacts or for one contact."""
        cos_p, sin_p = np.cos(self.rate_p * time), np.sin(self.rate_p * time)
        cos_q, sin_q = np.cos(self.rate_q * time), np.sin(self.rate_q * time)
        p = self.p[0] * cos_p + self.p[1] * sin_p
        q = self.q[0] * cos_q + self.q[1] * sin_q
        p_rate = self.rate_p * (self.p[1] * cos_p - self.p[0] * sin_p)
        q_rate = self.rate_q * (self.q[1] * cos_q - self.q[0] * sin_q)
        return State(
            self.cosine * p + self.sine * q,
            self.cosine * p_rate + self.sine * q_rate,
            (self.cosine * q - self.sine * p) / self.scale,
            self.zeta * (self.cosine * q_rate - self.sine * p_rate),
        )
