"""Closed forms of stick and slip in a non-collinear contact (Stronge 1994, Eqs 1-5, 8, 9).

Units: 1/Omega, |v2(0)|, m2 Omega |v2(0)| with Omega^2 = kappa/m2, for both directions (friction
is not in units of mu here, so mu = 0 needs no formula of its own).

Symbols of the solver: N normal force, y velocity of approach, F friction, V tangential velocity, J
normal impulse; C = m2 c coupling, beta = m2/m1 mass ratio, zeta^2 stiffness ratio, mu coefficient
of friction, e restitution; g = +1 or -1 direction of slip; p and q modes of stick. The equations:

    y' = -N + C F,   V' = -beta F + C N,   stick: F' = V/zeta^2,   slip: F = g mu N.

In compression N' = y. On the line of unloading N' = y/e^2. With time in units of e and y in units
of e this is N' = y again, and V' gets the factor e. This factor is the `time_scale`, which is 1 in
compression. So e may have any size above 0.

Slip. N, y and V depend on the normal impulse J alone: y and V are linear in J, N^2 is quadratic.
Every event of slip is the root of a polynomial of degree one or two. The effective normal inverse
mass 1 - g mu C may be negative: then the body jams, and its forces grow exponentially.

Stick. N and zeta F/time_scale are two oscillators coupled by one symmetric matrix. Its two modes p
and q oscillate independently.
"""

from typing import Any, NamedTuple, Self, TypeVar

import numpy as np

from planarimpact.common.arrays import Array, Integers, Numbers

# Two impulses or forces whose relative difference is smaller count as equal.
TIE = 1e-14

Fields = TypeVar("Fields", bound=tuple[Any, ...])


class Groups(NamedTuple):
    """Groups of impacts, arrays of shape (n,): beta, C, zeta^2, mu, and the time scale."""

    mass_ratio: Array
    coupling: Array
    stiffness_ratio: Array
    friction: Array
    time_scale: Array


class State(NamedTuple):
    """Forces N, F and velocities y, V, arrays of shape (n,); y in units of the time scale."""

    normal: Array
    approach: Array
    friction: Array
    velocity: Array


class Mode(NamedTuple):
    """A sinusoid of the time: `cosine` cos(rate t) + `sine` sin(rate t)."""

    rate: Array
    cosine: Array
    sine: Array

    def at(self, time: Array) -> tuple[Array, Array]:
        """The mode and its derivative at a time."""
        return self.turned(np.sin(self.rate * time), np.cos(self.rate * time))

    def turned(self, sine: Array, cosine: Array) -> tuple[Array, Array]:
        """The mode and its derivative, from sine and cosine of rate t."""
        value = self.cosine * cosine + self.sine * sine
        return value, self.rate * (self.sine * cosine - self.cosine * sine)

    def integral(self, time: Array) -> Array:
        """The integral from 0 to a time."""
        versine = 2 * np.sin(self.rate * time / 2) ** 2
        return (self.cosine * np.sin(self.rate * time) + self.sine * versine) / self.rate


class Slip(NamedTuple):
    """Slip in the direction g that begins at a state.

    `inverse_mass` is 1 - g mu C. The speed of slip, in scaled time, is `speed + slope J`.
    """

    state: State
    groups: Groups
    direction: Numbers
    inverse_mass: Array
    speed: Array
    slope: Array

    @classmethod
    def start(cls, state: State, groups: Groups, direction: Numbers) -> Self:
        """Slip that starts at this state."""
        beta, coupling, zeta2, mu, time_scale = groups
        inverse_mass = 1 - direction * mu * coupling
        speed = time_scale * direction * state.velocity - mu * zeta2 * state.approach
        slope = time_scale**2 * (direction * coupling - mu * beta) + mu * zeta2 * inverse_mass
        return cls(state, groups, direction, inverse_mass, np.maximum(speed, 0.0), slope)

    def stop(self) -> Array:
        """Impulse at which the speed of slip vanishes, or inf; never without friction."""
        slows = (self.slope < 0) & (self.groups.friction > 0)
        return np.where(slows, self.speed / np.where(slows, -self.slope, 1.0), np.inf)

    def approach_end(self) -> Array:
        """Impulse at which approach ends, or inf where the body jams."""
        ends = self.inverse_mass > 0
        return np.where(ends, self.state.approach / np.where(ends, self.inverse_mass, 1.0), np.inf)

    def separation(self) -> Array:
        """Impulse at which the normal force vanishes, or inf."""
        n, y, inverse_mass = self.state.normal, self.state.approach, self.inverse_mass
        square = y * y + inverse_mass * n * n
        root = np.sqrt(np.maximum(square, 0.0))
        force_falls = (y <= 0) & (square >= 0)
        force_rises_first = (y > 0) & (inverse_mass > 0)
        after_rise = (y + root) / np.where(force_rises_first, inverse_mass, 1.0)
        # Without cancellation; the contact is at separation already where n = 0.
        without_rise = n * n / np.where(force_falls & (n > 0), root - y, 1.0)
        return np.where(force_falls, without_rise, np.where(force_rises_first, after_rise, np.inf))

    def reload(self, peak: Array) -> Array:
        """Impulse at which the force reaches its earlier `peak` again, or inf."""
        n, y, inverse_mass = self.state.normal, self.state.approach, self.inverse_mass
        gap = (peak - n) * (peak + n)
        square = y * y - inverse_mass * gap
        root = np.sqrt(np.maximum(square, 0.0))
        force_rises = (y > 0) & (square >= 0)
        force_falls_first = (y <= 0) & (inverse_mass < 0)
        without_fall = gap / np.where(force_rises, y + root, 1.0)
        after_fall = (root - y) / np.where(force_falls_first, -inverse_mass, 1.0)
        return np.where(force_rises, without_fall, np.where(force_falls_first, after_fall, np.inf))

    def impulses(self, impulse: Array) -> tuple[Array, Array]:
        """Impulses of F and N, as `Stick.impulses`."""
        return self.direction * self.groups.friction * impulse, impulse

    def after(self, impulse: Array, separation: Array) -> State:
        """State after an impulse, where `separation` is the impulse at separation, or inf."""
        n, y = self.state.normal, self.state.approach
        separates = np.isfinite(separation) & (separation > 0)
        # N^2 has a root at separation: as a product it does not cancel there.
        end = np.where(separates, separation, 1.0)
        factored = (end - impulse) * (self.inverse_mass * impulse + n * n / end)
        expanded = n * n + impulse * (2 * y - self.inverse_mass * impulse)
        normal = np.sqrt(np.maximum(np.where(separates, factored, expanded), 0.0))
        return self._state(impulse, normal)

    def work(self, impulse: Array) -> Array:
        """Work of friction over an impulse."""
        return self.groups.friction * impulse * (self.speed + self.slope * impulse / 2)

    def duration(self, impulse: Array, normal_after: Array) -> Array:
        """Scaled time of an impulse, from tan(rate time/2)/rate = J/(N before + N after)."""
        forces = self.state.normal + normal_after
        half = impulse / np.where(forces > 0, forces, 1.0)
        rate = np.sqrt(np.abs(self.inverse_mass))
        # The time to reach N = 0 may be infinite: it is then as long as rounding permits.
        tangent = np.minimum(rate * half, np.nextafter(1.0, 0.0))
        angle = np.where(self.inverse_mass > 0, np.arctan(rate * half), np.arctanh(tangent))
        return 2 * np.where(rate * half > 1e-9, angle / np.maximum(rate, 1e-300), half)

    def at(self, time: Array) -> State:
        """States of one contact at an array of scaled times."""
        n, y = self.state.normal, self.state.approach
        sine, half_sine = self._sine(time), self._sine(time / 2)
        versine = 2 * half_sine * half_sine  # (1 - cosine)/inverse_mass
        impulse = n * sine + y * versine
        normal = n * (1 - self.inverse_mass * versine) + y * sine
        return self._state(impulse, normal)

    def _state(self, impulse: Array, normal: Array) -> State:
        """State after an impulse, with the normal force that it leaves."""
        beta, coupling, _, mu, time_scale = self.groups
        slope = coupling - self.direction * mu * beta  # of V over J
        return State(
            normal,
            self.state.approach - self.inverse_mass * impulse,
            self.direction * mu * normal,
            self.state.velocity + time_scale * slope * impulse,
        )

    def _sine(self, time: Array) -> Array:
        """sin(rate t)/rate with rate^2 = inverse_mass, of either sign."""
        rate = np.sqrt(np.abs(self.inverse_mass))
        if np.all(rate == 0):
            return time
        sine = np.sin if np.all(self.inverse_mass > 0) else np.sinh
        return sine(rate * time) / rate


class Stick(NamedTuple):
    """Stick that begins at a state, as two modes p and q of the scaled time.

    `cosine` and `sine` turn modes into forces: N = cosine p + sine q, F scale = cosine q - sine p.
    `sizes` are bounds of |p| and |q| from the sizes of their terms, so that rounding errors are in
    proportion to them.
    """

    cosine: Array
    sine: Array
    scale: Array
    zeta: Array
    p: Mode
    q: Mode
    sizes: tuple[Array, Array]

    @classmethod
    def start(cls, state: State, groups: Groups) -> Self:
        """Stick that starts at this state."""
        beta, coupling, zeta2, _, time_scale = groups
        zeta = np.sqrt(zeta2)
        scale = zeta / time_scale
        # One rotation of Jacobi's method diagonalises [[1, mixed], [mixed, tangential]].
        tangential = time_scale**2 * beta / zeta2
        mixed = -coupling / scale
        difference = tangential - 1
        sign = np.where(difference < 0, -1.0, 1.0)
        divisor = difference + sign * np.hypot(difference, 2 * mixed)
        tangent = 2 * mixed / np.where(divisor == 0, 1.0, divisor)
        cosine = 1 / np.sqrt(1 + tangent * tangent)
        sine = tangent * cosine
        square_p, square_q = 1 - tangent * mixed, tangential + tangent * mixed
        # The smaller eigenvalue from the determinant, which does not cancel.
        determinant = (time_scale / zeta) ** 2 * (beta - coupling * coupling)
        square_p, square_q = (
            np.where(square_p < square_q, determinant / square_q, square_p),
            np.where(square_p < square_q, square_q, determinant / square_p),
        )
        rate_p, rate_q = np.sqrt(square_p), np.sqrt(square_q)
        n, y = state.normal, state.approach
        force, force_rate = scale * state.friction, state.velocity / zeta  # F scale, its derivative
        p, q = rotated(n, force, cosine, sine)
        p_rate, q_rate = rotated(y, force_rate, cosine, sine)
        n_share, f_share = cosine, np.abs(sine)
        sizes = (
            n_share * np.hypot(n, y / rate_p) + f_share * np.hypot(force, force_rate / rate_p),
            f_share * np.hypot(n, y / rate_q) + n_share * np.hypot(force, force_rate / rate_q),
        )
        modes = Mode(rate_p, p, p_rate / rate_p), Mode(rate_q, q, q_rate / rate_q)
        return cls(cosine, sine, scale, zeta, *modes, sizes)

    def at(self, time: Array) -> State:
        """States at scaled times: one for each contact, or many for one contact."""
        (p, p_rate), (q, q_rate) = self.p.at(time), self.q.at(time)
        friction, normal = rotated(q, p, self.cosine, self.sine)
        velocity, approach = rotated(q_rate, p_rate, self.cosine, self.sine)
        return State(normal, approach, friction / self.scale, self.zeta * velocity)

    def impulses(self, time: Array) -> tuple[Array, Array]:
        """Impulses of F and N up to a scaled time."""
        p, q = self.p.integral(time), self.q.integral(time)
        friction, normal = rotated(q, p, self.cosine, self.sine)
        return friction / self.scale, normal

    def bounds(self) -> State:
        """Bounds of |N|, |y|, |F| and |V|, from those of the modes."""
        cosine, sine = self.cosine, np.abs(self.sine)
        p, q = self.sizes
        p_rate, q_rate = self.p.rate * p, self.q.rate * q
        return State(
            cosine * p + sine * q,
            cosine * p_rate + sine * q_rate,
            (sine * p + cosine * q) / self.scale,
            self.zeta * (sine * p_rate + cosine * q_rate),
        )


def rotated(one: Array, other: Array, cosine: Array, sine: Array) -> tuple[Array, Array]:
    """Two coordinates in axes rotated by an angle.

    Its cosine is 1 - sine half_tangent: with the rounded cosine as a factor the coordinates, and
    their energy, would grow or shrink alike in each of thousands of phases.
    """
    half_tangent = sine / (1 + cosine)
    return one - sine * (other + half_tangent * one), other + sine * (one - half_tangent * other)


def taken(fields: Fields, chosen: Integers) -> Fields:
    """A named tuple of arrays, or of other such tuples, for the contacts with these indices."""
    parts = (taken(f, chosen) if isinstance(f, tuple) else f.take(chosen, axis=-1) for f in fields)
    return type(fields)(*parts)
