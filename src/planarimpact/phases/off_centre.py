"""Impact of a body on two springs with Coulomb friction, its centre on the contact normal or not.

The springs are those of the paper: linear, and the normal one stiffer in unloading, by 1/e^2
(Stronge 1994, Eqs 1-9). Units 1/Omega, |v2(0)|, m2 Omega |v2(0)| with Omega^2 = kappa/m2, for both
directions. Symbols: N normal force, y velocity of approach, F friction, V tangential velocity of
the contact point; C = m2 c coupling, beta = m2/m1, zeta^2 stiffness ratio, mu coefficient of
friction, e restitution; g = +1 or -1 direction of slip, 0 in stick.

    N' = y,   y' = -N + C F,   V' = -beta F + C N,   stick: F' = V/zeta^2,   slip: F = g mu N.

On the line of unloading N' = y/e^2. With time and y in units of e that is N' = y again, and the
other rates get the factor s = e, which is 1 in loading. What `follow` sums up is in that time too:
impulses get the factor s, and the work has it from the velocity of slip. In place of V the state
has Q = V + C s y: Q' = -s (beta - C^2) F keeps its digits where the mass is nearly singular.

A contact starts in slip where |V| >= mu zeta^2. At that limit the speed of slip starts at zero, and
if it falls the contact sticks at once.
"""

from typing import NamedTuple

import numpy as np

from planarimpact.common.arrays import Array, Booleans, Integers
from planarimpact.common.results import EventKind
from planarimpact.phases import TIE, Passed
from planarimpact.phases.runs import Order

N, Y, F, Q = range(4)  # states
CONSTANT = 4  # the last entry of a row
HALF_END, RELOAD, FORWARD, BACKWARD = range(4)  # events; FORWARD ends slip of both directions


class Phase(NamedTuple):
    """Whether a contact slips and unloads; its side, 1 or -1, where friction holds it `closed`."""

    slips: bool
    unloading: bool
    side: float = 0.0

    def events(self, before: "Phase | None") -> list[EventKind]:
        """Events where it starts, after another phase or at contact."""
        kind = EventKind.SLIP if self.slips else EventKind.STICK
        if before is None:
            return [kind]
        turn = EventKind.MAXIMUM_COMPRESSION if self.unloading else EventKind.RELOADING
        turns = [turn] if self.unloading != before.unloading else []
        return turns + ([kind] if self.slips != before.slips else [])


class OffCentre:
    """n contacts, arrays of shape (n,): groups, the phase that each is in, and sums so far.

    Attributes
    ----------
    z : ndarray, shape (4, n)
        States. After `closed.solve` y has the unit of V, also in unloading, and V is in place of Q.
    impulses : ndarray, shape (2, n)
        Of friction and of the normal force.
    work, duration, peak, peak_friction : ndarray
        Of friction, to which `closed.solve` adds the strain energy that the tangential spring has
        at separation; of the contact; largest N, largest |F|.
    order : Order
        Of stick and slip.
    jams : ndarray of bool
        Whether it slips, for a time, while friction presses it in more than N pushes it off.
    """

    def __init__(
        self, x: Array, beta: Array, coupling: Array, zeta2: Array, mu: Array, e: Array
    ) -> None:
        """At contact; x = V/y."""
        n = np.size(x)
        self.ends_at_turn = e == 0
        self.groups = np.array([beta, coupling, zeta2, mu, np.where(self.ends_at_turn, 1.0, e)])
        self.z = np.array([np.zeros(n), np.ones(n), np.zeros(n), x + coupling])
        slides = np.abs(x) >= mu * zeta2
        self.g = np.where(slides, np.where(x < 0, -1.0, 1.0), 0.0)
        self.s, self.unloading, self.jams = np.ones(n), *np.zeros((2, n), bool)
        self.impulses, self.order = np.zeros((2, n)), Order(n)
        self.work, self.duration, self.peak, self.peak_friction = np.zeros((4, n))

    def phase(self) -> Phase:
        """Of a single contact."""
        return Phase(bool(self.g[0]), bool(self.unloading[0]))

    def matrix(self, who: Integers) -> Array:
        """Rates of the present phases."""
        (beta, coupling, zeta2, mu, _), g, s = self.groups[:, who], self.g[who], self.s[who]
        stick, a = g == 0, np.zeros((4, 4, who.size))
        a[N, Y], a[Y, N], a[Y, F] = 1.0, -1.0, coupling
        a[F, Q], a[F, Y] = stick * s / zeta2, np.where(stick, -s * s * coupling / zeta2, g * mu)
        a[Q, F] = -s * (beta - coupling * coupling)
        return a

    def rows(self, who: Integers) -> Array:
        """The end of loading or unloading, reloading, and the end of stick or slip."""
        mu, g, unloading = self.groups[3, who], self.g[who], self.unloading[who]
        stick, rows = g == 0, np.zeros((4, 5, who.size))
        rows[HALF_END, N], rows[HALF_END, Y] = unloading, ~unloading
        rows[RELOAD, N] = -1.0 * unloading
        rows[RELOAD, CONSTANT] = np.where(unloading, self.peak[who], 1.0)
        rows[FORWARD] = g * self._slip_velocity(who)
        rows[[FORWARD, BACKWARD], N] += mu * stick
        rows[FORWARD, F], rows[BACKWARD, F] = -1.0 * stick, stick
        rows[BACKWARD, CONSTANT] = ~stick
        return rows

    def power(self, who: Integers) -> Array:
        """Friction and the velocity of slip."""
        slip = self._slip_velocity(who)
        friction = np.zeros_like(slip)
        friction[F] = 1.0
        return np.array([friction, slip])

    def _slip_velocity(self, who: Integers) -> Array:
        """The row of V - zeta^2 F', times s; zero in stick."""
        (_, coupling, zeta2, mu, _), g, s = self.groups[:, who], self.g[who], self.s[who]
        slips, row = np.abs(g), np.zeros((5, who.size))
        row[Q], row[Y] = s * slips, -slips * s * s * coupling - g * mu * zeta2
        return row

    def switch(self, who: Integers, z: Array, event: Integers, passed: Passed) -> Booleans:
        """Begin the next phases; what is zero or equal at an event is made so to the last digit."""
        (_, coupling, zeta2, mu, e), g, s = self.groups[:, who], self.g[who], self.s[who]
        unloading, peak, slips = self.unloading[who], self.peak[who], g != 0
        half, reload, changes = event == HALF_END, event == RELOAD, event >= FORWARD
        turns, separates = half & ~unloading, half & unloading
        stops, slides = changes & slips, changes & ~slips
        self.order.add(who, slips, passed.integral[N])
        self.jams[who] |= (g * mu * coupling > 1) & (passed.time > 0)
        self.impulses[:, who] += s * passed.integral[[F, N]]
        self.duration[who] += s * passed.time
        self.work[who] += passed.work
        self.peak_friction[who] = np.maximum(self.peak_friction[who], passed.largest)
        velocity = z[Q] - coupling * s * z[Y]
        z[N] = np.where(separates, 0.0, np.where(reload, peak, z[N]))
        z[N] = np.where(slides & (mu > 1), np.abs(z[F]) / np.maximum(mu, 1.0), z[N])
        # A row that only touches zero may be found behind its minimum. Then no slip has begun, and
        # the speed of slip is not zero but negative, by more than rounding.
        speed = g * s * velocity - mu * zeta2 * z[Y]
        rounding = (
            3 * TIE * (s * (np.abs(z[Q]) + np.abs(coupling * s * z[Y])) + mu * zeta2 * np.abs(z[Y]))
        )
        halts = stops & ((passed.time > 0) | (np.abs(speed) <= rounding))
        velocity = np.where(halts, g * mu * zeta2 * z[Y] / s, velocity)
        z[Y] = np.where(turns, 0.0, np.where(reload, s * z[Y], z[Y]))
        g = np.where(slides, np.where(event == FORWARD, 1.0, -1.0), g)
        z[F] = np.where(g != 0, g * mu * z[N], z[F])
        self.g[who] = np.where(stops, 0.0, g)
        self.peak[who] = np.where(turns, z[N], peak)
        self.unloading[who] = (unloading | turns) & ~reload
        self.s[who] = s = np.where(self.unloading[who], e, 1.0)
        z[Q] = velocity + coupling * s * z[Y]
        return separates | (turns & self.ends_at_turn[who])
