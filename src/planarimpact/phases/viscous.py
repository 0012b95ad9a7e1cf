"""Impact of two Kelvin-Voigt elements: both directions lose energy by viscosity.

Each element is a spring beside a dashpot, and both have the relaxation time tau (Schwager and
Poeschel 2007, DOI 10.1007/s10035-007-0065-z, for the normal one). Units 1/Omega, |v2(0)| and
m2 Omega |v2(0)| for time, velocity and force; what is tangential has the factor mu. Symbols: u
compression, v its rate, N normal force; s deflection of the tangential spring, w velocity of the
contact point, T friction; beta mass ratio, zeta^2 stiffness ratio; g = +1 or -1 direction of slip.

    u' = v,   v' = -N,   N = u + tau v;   w' = -beta T,   T = (s + tau s')/zeta^2,
    stick: s' = w while |T| <= N;   slip: T = g N.

Contact ends where N = 0. In slip s comes to g zeta^2 u: the difference r falls as exp(-t/tau).
When it has fallen to exp(-LAYER) of itself it counts as zero, and steps need no longer follow it.
In slip the state has r in place of s.

**Restitution.** The compression obeys u'' + tau u' + u = 0. With tau = 2 cos(delta)

    N = e exp(-tau t/2) sin(-omega t)/omega,   omega = sin(delta),   e = exp(-2 delta cot(delta)),

where t counts back from separation. For e < exp(-2) delta is imaginary, and cos(delta) above 1.
"""

from typing import Any

import numpy as np

from planarimpact.common import roots
from planarimpact.common.arrays import Array, Booleans, Integers
from planarimpact.common.floats import HALF_PI
from planarimpact.phases import TIE, Passed
from planarimpact.phases.runs import Order

U, V, S, W = range(4)  # states
CONSTANT = 4  # the last entry of a row
SEPARATION, FORWARD, BACKWARD = range(3)  # events; in slip FORWARD ends it, BACKWARD ends r
STICK, LAYER_SLIP, SLIP = range(3)
LAYER = 40.0
# Squares of delta this small have the slope -1/3, to rounding; and no divisor is 0.
LEAST_SQUARE, LEAST = 1e-12, 1e-30


def damping(restitution: Array) -> tuple[Array, Array]:
    """Relaxation time tau, and the largest normal force, of elements with 0 < e < 1.

    Examples
    --------
    >>> tau, largest = damping(np.array([0.1, 0.5]))
    >>> tau.round(6).tolist(), largest.round(6).tolist()
    ([2.486376, 0.510551], [2.486376, 0.810367])
    """
    goal = -np.log(restitution) / 2

    def surplus(which: Any, square: Array) -> tuple[Array, Array]:
        """delta cot(delta) above its goal, with the slope to delta^2."""
        angle, real = np.sqrt(np.maximum(np.abs(square), LEAST)), square > 0
        value = angle / np.where(real, np.tan(np.where(real, angle, 0.1)), np.tanh(angle))
        near = np.abs(square) < LEAST_SQUARE
        slope = (value - value * value - square) / (2 * np.where(near, 1.0, square))
        return value - goal[which], np.where(near, -1 / 3, slope)

    # For goal > 1 |delta| coth |delta| exceeds |delta|.
    low, high = np.where(goal > 1, -goal * goal, 0.0), np.where(goal > 1, 0.0, HALF_PI**2)
    square = roots.crossing(surplus, low, high, start=(1 - goal) * (goal + 2))
    angle, real = np.sqrt(np.maximum(np.abs(square), LEAST)), square > 0
    sine = np.where(real, np.sin(angle), np.sinh(np.where(real, 0.1, angle)))
    tau = 2 * goal * sine / angle  # 2 cos(delta), with all digits near e = 1 too
    inner = np.exp(np.minimum(np.pi - 3 * angle, 0.0) * goal / angle)  # where N' = 0
    return tau, np.where(real & (angle > np.pi / 3), inner, tau)


class Viscous:
    """n contacts, arrays of shape (n,): states z, sums and order as in `off_centre.OffCentre`."""

    def __init__(self, x: Array, beta: Array, zeta2: Array, tau: Array) -> None:
        """At contact; x = w."""
        n, self.groups = np.size(x), np.array([beta, zeta2, tau])
        self.g = np.where(x > zeta2, 1.0, 0.0)
        self.kind = np.where(x > zeta2, SLIP, STICK)
        self.z = np.array([np.zeros(n), np.ones(n), np.zeros(n), x])
        self.layer, self.work, self.peak_friction = np.zeros((3, n))
        self.order = Order(n)

    def phase(self) -> float:
        """Of a single contact: the direction of slip."""
        return float(self.g[0])

    def matrix(self, who: Integers) -> Array:
        """Rates of the present phases."""
        beta, zeta2, tau = self.groups[:, who]
        kind, a = self.kind[who], np.zeros((4, 4, who.size))
        a[U, V], a[V, U], a[V, V] = 1.0, -1.0, -tau
        a[S, W], a[S, S] = kind == STICK, np.where(kind == LAYER_SLIP, -1 / tau, 0.0)
        a[W] = -beta * self._friction(who)[:CONSTANT]
        return a

    def rows(self, who: Integers) -> Array:
        """Separation, the end of stick or slip, and that of the layer."""
        stick, layer = self.kind[who] == STICK, self.kind[who] == LAYER_SLIP
        normal, friction = self._normal(who), self._friction(who)
        left = np.zeros_like(normal)
        left[S] = layer * np.sign(self.z[S, who])
        left[CONSTANT] = np.where(layer, -self.layer[who], 1.0)
        ends = np.where(stick, normal - friction, self.g[who] * self._slip_velocity(who))
        return np.array([normal, ends, np.where(stick, normal + friction, left)])

    def power(self, who: Integers) -> Array:
        """Friction and the velocity of slip."""
        return np.array([self._friction(who), self._slip_velocity(who)])

    def _normal(self, who: Integers) -> Array:
        """The row of N."""
        row = np.zeros((5, who.size))
        row[U], row[V] = 1.0, self.groups[2, who]
        return row

    def _friction(self, who: Integers) -> Array:
        """The row of T."""
        _, zeta2, tau = self.groups[:, who]
        stick, row = self.kind[who] == STICK, self.g[who] * self._normal(who)
        row[S], row[W] = stick / zeta2, stick * tau / zeta2
        return row

    def _slip_velocity(self, who: Integers) -> Array:
        """The row of w - s', which is zero in stick."""
        _, zeta2, tau = self.groups[:, who]
        kind, row = self.kind[who], np.zeros((5, who.size))
        row[W], row[V] = kind != STICK, -self.g[who] * zeta2
        row[S] = np.where(kind == LAYER_SLIP, 1 / tau, 0.0)
        return row

    def switch(self, who: Integers, z: Array, event: Integers, passed: Passed) -> Booleans:
        """Stick, slip with its layer, slip without; or stick again."""
        _, zeta2, tau = self.groups[:, who]
        kind, g = self.kind[who], self.g[who]
        stick, ends, forward = kind == STICK, event == SEPARATION, event == FORWARD
        slides, stops, settles = ~ends & stick, ~stick & forward, ~stick & (event == BACKWARD)
        impulse = passed.integral[U] + tau * passed.integral[V]
        self.order.add(who, ~stick, impulse)
        self.work[who] += passed.work
        self.peak_friction[who] = np.maximum(self.peak_friction[who], passed.largest)
        # Where slip begins or ends its velocity is zero, as T has no jump. That gives r with all
        # its digits, where the difference of s and what it comes to has few.
        side = np.where(slides, np.where(forward, 1.0, -1.0), g)
        decline = side * zeta2 * z[V] - z[W]  # r/tau
        rounding = 3 * TIE * (zeta2 * np.abs(z[V]) + np.abs(z[W]))
        is_zero = (slides | stops) & (np.abs(decline) <= rounding)
        z[W] = np.where(is_zero, side * zeta2 * z[V], z[W])
        left = np.where(is_zero, 0.0, tau * decline)
        z[S] = np.where(slides, left, np.where(stops, side * zeta2 * z[U] + left, z[S]))
        z[S] = np.where(settles, 0.0, z[S])
        # Slip that ended at once was one of rounding: T is put below N by more than that.
        size = np.abs(z[U]) + tau * np.abs(z[V]) + (np.abs(z[S]) + tau * np.abs(z[W])) / zeta2
        z[S] -= (stops & (passed.time == 0)) * side * zeta2 * (8 * TIE * size)
        self.g[who] = np.where(stops, 0.0, side)
        self.kind[who] = np.select(
            [slides & (z[S] != 0), stops, slides | settles], [LAYER_SLIP, STICK, SLIP], kind
        )
        self.layer[who] = np.where(slides, np.abs(z[S]) * np.exp(-LAYER), self.layer[who])
        return ends
