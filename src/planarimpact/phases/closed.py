"""Contacts without restitution that friction holds closed: the limit e -> 0 of `off_centre`.

Unloading takes a time of the order e, in which V does not change. A contact in stick with
mu |C| > 1 may then not let go. N oscillates about C F with an amplitude A that does not vanish
with e; at first A is the earlier peak less C F. The contact may slip once in the first oscillation.
There N'' = (mu |C| - 1) N in the scaled time, so y^2 - (mu |C| - 1) N^2 stays constant: either N
reaches zero, and the contact separates, or N turns. If it turns, or does not slip, friction holds
the contact closed, and the mean of N is C F. F, A and V then obey linear phases:

    V' = -(beta - C^2) F, and
    held:      F' = V/zeta^2,          A' = 0
    squeezed:  F' = V/zeta^2,          A' = -C F',   as C F + A stays at the peak
    creep:     F' = mu |C| V/zeta^2,   as C F - A comes down to |F|/mu once in each oscillation

In creep each oscillation slips a little, and leaves N at its lowest value. So friction falls
mu |C| times as fast as in stick, and A stays (|C| - 1/mu) |F|. Compression goes on where C F comes
to the peak; the contact separates where F falls to zero. Here signs are those in the direction of
friction, so that F and C are positive.
"""

import numpy as np

from planarimpact.common.arrays import Array, Booleans, Integers
from planarimpact.phases import Passed, Step, follow, off_centre
from planarimpact.phases.off_centre import OffCentre, Q, Y

F, A, V = range(3)  # states
CONSTANT = 3
HELD, SQUEEZED, CREEP = range(3)
# Events: C F is at the peak; creep begins, or F is zero in it; C F + A is at the peak; F is at its
# largest.
PEAK, CRITICAL, SQUEEZE, CREST = range(4)


class Closed:
    """Contacts `who` of `contacts`, in stick at a maximum of compression."""

    def __init__(self, contacts: OffCentre, who: Integers) -> None:
        """Before the first oscillation."""
        self.side = np.where(contacts.z[off_centre.F, who] < 0, -1.0, 1.0)
        self.beta, coupling, self.zeta2, self.mu, _ = contacts.groups[:, who]
        self.coupling, self.peak = self.side * coupling, contacts.z[off_centre.N, who]
        states = contacts.z[[off_centre.F, off_centre.F, off_centre.Q]][:, who]
        self.z = self.side * states
        self.kind, self.reloads = np.full(who.size, HELD), np.zeros(who.size, bool)
        self.slips, self.duration, self.work = np.zeros((3, who.size))
        self.impulse, self.peak_friction = np.zeros((2, who.size))

    def first_oscillation(self) -> Integers:
        """Which are held closed; those that slip at once have less friction after that."""
        coupling, mu, peak, force = self.coupling, self.mu, self.peak, self.z[F]
        excess, onset = mu * coupling - 1, force / np.where(mu > 0, mu, 1.0)  # N where slip begins
        bottom = 2 * coupling * force - peak  # of the oscillation, without slip
        safe = np.where(excess > 0, excess, 1.0)
        turn = onset**2 - (onset - bottom) * (peak - onset) / safe  # square of N where it turns
        sticks = bottom >= onset
        held = (force > 0) & (excess > 0) & (sticks | (turn > 0))
        after = np.where(sticks, force, mu * np.sqrt(np.maximum(turn, 0.0)))
        self.peak_friction, self.slips = np.where(held, force, 0.0), held & ~sticks
        self.work = self.zeta2 / 2 * (force - after) * (force + after)
        self.z[F] = after
        self.z[A] = np.where(sticks, peak - coupling * after, coupling * after - after / mu)
        return np.flatnonzero(held)

    def phase(self) -> off_centre.Phase:
        """Of a single contact."""
        return off_centre.Phase(bool(self.kind[0] == CREEP), True, float(self.side[0]))

    def matrix(self, who: Integers) -> Array:
        """Rates of the present phases."""
        coupling, kind, a = self.coupling[who], self.kind[who], np.zeros((3, 3, who.size))
        a[F, V] = np.where(kind == CREEP, self.mu[who] * coupling, 1.0) / self.zeta2[who]
        a[A, V] = np.where(kind == SQUEEZED, -coupling * a[F, V], 0.0)
        a[V, F] = coupling**2 - self.beta[who]
        return a

    def rows(self, who: Integers) -> Array:
        """The peak, the begin or end of creep, the begin of squeezing, the crest of friction."""
        coupling, mu, peak, kind = (f[who] for f in (self.coupling, self.mu, self.peak, self.kind))
        held, creeps, rises = kind == HELD, kind == CREEP, self.z[V, who] > 0
        rows = np.zeros((4, 4, who.size))
        rows[PEAK, F], rows[PEAK, CONSTANT] = -coupling, peak
        rows[CRITICAL, F] = held * (coupling - 1 / mu) + creeps
        rows[CRITICAL, A], rows[CRITICAL, CONSTANT] = -1.0 * held, ~(held | creeps)
        rows[SQUEEZE, F], rows[SQUEEZE, A] = -coupling * held, -1.0 * held
        rows[SQUEEZE, CONSTANT] = np.where(held, peak, 1.0)
        rows[CREST, V], rows[CREST, CONSTANT] = rises, ~rises
        return rows

    def power(self, who: Integers) -> Array:
        """Friction; its work is what `switch` adds."""
        power = np.zeros((2, 4, who.size))
        power[0, F] = 1.0
        return power

    def switch(self, who: Integers, z: Array, event: Integers, passed: Passed) -> Booleans:
        """Held, squeezed where F rises far, held, creep where it falls; or compression goes on."""
        kind, critical = self.kind[who], event == CRITICAL
        self.duration[who] += passed.time
        self.impulse[who] += passed.integral[F]
        self.peak_friction[who] = np.maximum(self.peak_friction[who], passed.largest)
        starts, ends = critical & (kind == HELD), critical & (kind == CREEP)
        lost = self.zeta2[who] / 2 * z[F] ** 2 * (1 - 1 / (self.mu[who] * self.coupling[who]))
        self.work[who] += np.where(starts, lost, 0.0)
        z[V] = np.where(event == CREST, 0.0, z[V])
        z[F] = np.where(ends, 0.0, z[F])
        self.reloads[who] = event == PEAK
        self.kind[who] = np.select([critical, event == SQUEEZE], [CREEP, SQUEEZED], HELD)
        return self.reloads[who] | ends

    def end(self, contacts: OffCentre, who: Integers, kept: Integers) -> None:
        """Put those that were `kept` closed back among the contacts, where they are `who`."""
        side, coupling = self.side[kept], self.coupling[kept]
        force, _, velocity = self.z[:, kept]
        reloads = self.reloads[kept]
        normal = np.where(reloads, self.peak[kept], 0.0)
        contacts.z[:, who] = normal, np.zeros_like(normal), side * force, side * velocity
        contacts.impulses[:, who] += self.impulse[kept] * [side, coupling]
        contacts.work[who] += self.work[kept]
        contacts.duration[who] += self.duration[kept]
        largest = np.maximum(contacts.peak_friction[who], self.peak_friction[kept])
        contacts.peak_friction[who] = largest
        # A slip in the first oscillation is followed by a new stick, and creep has many.
        contacts.order.sticks[who] += self.slips[kept] + 2 * ~reloads
        contacts.jams[who] |= (self.slips[kept] > 0) | ~reloads
        contacts.unloading[who] = ~reloads
        contacts.s[who] = 1.0


def solve(contacts: OffCentre, steps: list[Step] | None = None) -> Integers:
    """Follow contacts to separation, where y and V are its velocities; see `OffCentre`.

    The `steps` of a single contact are listed. Returns the indices of those that are given up.
    """
    who, given_up = np.arange(contacts.z.shape[1]), np.zeros(0, int)
    while who.size:
        given_up = np.append(given_up, follow(contacts, contacts.z, who, steps))
        at_turn = contacts.ends_at_turn[who] & (contacts.g[who] == 0)
        who = who[at_turn & ~np.isin(who, given_up)]
        if not who.size:
            break
        closed = Closed(contacts, who)
        kept = closed.first_oscillation()
        given_up = np.append(given_up, who[follow(closed, closed.z, kept, steps)])
        closed.end(contacts, who[kept], kept)
        who = who[kept[closed.reloads[kept]]]
    # At separation friction vanishes by slip, also by one that is as short as rounding.
    contacts.order.ends_in_slip |= ~contacts.ends_at_turn & (contacts.peak_friction > 0)
    contacts.z[Y] *= contacts.s
    contacts.z[Q] -= contacts.groups[1] * contacts.z[Y]
    contacts.work += contacts.groups[2] * contacts.z[off_centre.F] ** 2 / 2
    return given_up
