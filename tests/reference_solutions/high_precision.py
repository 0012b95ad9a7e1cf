"""Reference solution of the lumped collinear impact in multiple precision.

Written from the equations of motion alone, independently of the package, to prove its results.

Both halves of the collision are described by one angle ``y`` with normal force ``N = sin(y)``:
in compression ``y`` runs from 0 to pi/2 at ``dy = dtau``; in restitution it runs back from pi/2
to 0 at ``dy = -dtau/e``, so that the last instants before separation keep full *relative*
precision. ``sense`` (+1, -1) is the sign of ``dy``, ``rate`` (1, e) is ``dtau/|dy|``.

*Stick* turns ``(T, w/Z)``, ``Z = sqrt(beta zeta2)``, by ``nu = rate sqrt(beta/zeta2)`` radians per
unit of ``y``. The distance to the Coulomb limit in direction ``g``, ``f = N - g T``, obeys
``f'' + nu^2 f = (nu^2 - 1) N`` (primes: by |y|), so that exactly, with ``psi = nu t``,

    f(t) = f cos psi + (f'/nu) sin psi + (nu^2 - 1)/nu * int_0^t N(s) sin(nu (t - s)) ds.

The kernel is not negative for psi <= pi; with N replaced by its least (nu > 1) or greatest
(nu < 1) value on the interval, the right-hand side is a proven lower bound of f. The march below
only ever steps to the first zero of that bound, so it cannot pass a root of f. The bound has the
value and slope of f, hence the march converges to a simple root quadratically, from below.

*Slip* has closed forms: with ``m = int N |dy|``, ``rate * slip velocity`` falls by ``excess * m``,
``excess = rate^2 beta - zeta2``; its sign is that of nu - 1.
"""

from typing import NamedTuple

from mpmath import mp

GUARD_DIGITS = 25


class Event(NamedTuple):
    """State at one instant; ``time`` is in units of the time to greatest compression."""

    kind: str
    time: mp.mpf
    normal: mp.mpf
    friction_force: mp.mpf
    velocity: mp.mpf


class Answer(NamedTuple):
    """Outcome of one impact: every number is an mpf, correct to the digits asked for."""

    velocity: mp.mpf
    peak_friction: mp.mpf
    dissipation: mp.mpf
    friction_work: mp.mpf
    events: tuple


class _Half(NamedTuple):
    """Constants of compression or restitution."""

    sense: int
    rate: mp.mpf
    nu: mp.mpf
    excess: mp.mpf
    end: mp.mpf


def rebound(incidence, mass_ratio, stiffness_ratio, restitution, digits=40):
    """Solve one impact; the arguments count as exact, and answers carry some digits more.

    For e = 0 the collision ends at greatest compression, and the last event shows the forces just
    before they are lost. A phase of zero length is not an event.
    """
    with mp.workdps(digits + GUARD_DIGITS):
        x, beta, zeta2, e = map(mp.mpf, (incidence, mass_ratio, stiffness_ratio, restitution))
        mirror = -1 if x < 0 else 1
        return _Impact(mirror * x, beta, zeta2, e, digits).solve(mirror)


class _Impact:
    """One impact with incidence x >= 0, carried forward in time."""

    def __init__(self, x, beta, zeta2, e, digits):
        self.x, self.beta, self.zeta2, self.e = x, beta, zeta2, e
        self.impedance = mp.sqrt(beta * zeta2)
        # Grazing: where f or the slip velocity misses zero, or passes it, by less than this,
        # the contact is taken to touch the limit without crossing it. Friction is then wrong
        # by no more than this. Two solutions approach each other in the energy norm, so the
        # error cannot grow later.
        self.tiny = mp.mpf(10) ** -(digits + 10)
        self.noise = mp.mpf(10) ** -(digits + GUARD_DIGITS - 4)  # relative rounding error of f
        self.y, self.friction, self.velocity = mp.zero, mp.zero, x
        self.peak, self.work, self.events = mp.zero, mp.zero, []
        # At x = zeta2 friction and limit leave zero together and f = (nu^2 - 1) tau^3/6.
        sticks = x < zeta2 or (x == zeta2 and beta >= zeta2)
        self.slip = 0 if sticks else 1  # direction of slip; 0 in stick

    def solve(self, mirror):
        """Run both halves of the collision; give the result times `mirror`."""
        compression = self._half(1, mp.one, mp.pi / 2)
        self._log("contact", compression)
        self._log_phase(compression)
        self._traverse(compression)
        last = compression
        self._log("compression ends", compression)
        if self.e > 0:
            last = self._half(-1, self.e, mp.zero)
            self._traverse(last)
        self._log("separation", last)
        loss = (self.x - self.velocity) * (self.x + self.velocity) / (2 * self.beta)
        events = tuple(
            v._replace(friction_force=mirror * v.friction_force, velocity=mirror * v.velocity)
            for v in self.events
        )
        return Answer(mirror * self.velocity, self.peak, loss, self.work, events)

    def _half(self, sense, rate, end):
        nu = rate * mp.sqrt(self.beta / self.zeta2)
        return _Half(sense, rate, nu, rate**2 * self.beta - self.zeta2, end)

    def _log(self, kind, half):
        time = 2 * self.y / mp.pi
        if half.sense < 0:
            time = 1 + self.e * (1 - time)
        self.events.append(Event(kind, time, mp.sin(self.y), self.friction, self.velocity))

    def _log_phase(self, half):
        self._log("slip" if self.slip else "stick", half)

    def _traverse(self, half):
        """Alternate stick and slip to the end of this half."""
        while self.y != half.end:
            following = self._slide(half) if self.slip else self._stick(half)
            if following is None:
                continue
            self.slip = following
            self._log_phase(half)

    # Slip ----------------------------------------------------------------------------------

    def _slide(self, half):
        """Slip until the slip velocity vanishes (return 0) or the half ends (None)."""
        g, start = self.slip, self.y
        # rate * slip velocity; at the start of slip rounding may put it below zero.
        sliding = half.rate * g * self.velocity - half.sense * self.zeta2 * mp.cos(start)
        sliding = max(sliding, mp.zero)
        stop = self._slip_end(half, sliding)
        self.y = half.end if stop is None else stop
        # m = sense (cos start - cos y), written so that nothing cancels
        impulse = 2 * mp.sin((start + self.y) / 2) * mp.sin(abs(start - self.y) / 2)
        self.work += impulse * (sliding - half.excess * impulse / 2)
        self.velocity -= g * half.rate * self.beta * impulse
        self.friction = g * mp.sin(self.y)
        self.peak = max(self.peak, mp.sin(start), mp.sin(self.y))  # N is monotone in y
        return None if stop is None else 0

    def _slip_end(self, half, sliding):
        """Angle at which the slip velocity vanishes inside this half, or None."""
        if sliding <= self.tiny:
            # Zero already (x = beta at the start of restitution): stick if it would turn
            # negative, slip on if it grows. Zero throughout (excess = 0) is stick.
            return self.y if half.excess >= -self.tiny else None
        if half.excess <= 0:
            return None
        # In sin^2(y/2) = (1 - cos y)/2 the condition is linear and exact near y = 0. Slip that
        # would stop within rounding of the end of a half is left to reach that end.
        goal = mp.sin(self.y / 2) ** 2 + half.sense * sliding / (2 * half.excess)
        inside = goal < 0.5 - self.tiny if half.sense > 0 else goal > self.tiny
        return 2 * mp.asin(mp.sqrt(goal)) if inside else None

    # Stick ---------------------------------------------------------------------------------

    def _stick(self, half):
        """Stick until the first |T| = N (return the slip direction) or the half ends (None)."""
        start, initial = self.y, (self.friction, self.velocity / self.impedance)
        amplitude = mp.hypot(*initial)
        self.y, onset = self._march(half, start, initial, amplitude)
        turned = half.nu * abs(self.y - start)
        # |T| = amplitude |cos(psi - lead)| peaks where psi equals the lead, modulo pi.
        crest = amplitude > 0 and mp.atan2(initial[1], initial[0]) % mp.pi <= turned
        friction, velocity = _turn(initial, turned)
        self.peak = max(self.peak, amplitude if crest else max(abs(initial[0]), abs(friction)))
        self.velocity = velocity * self.impedance
        # At the onset of slip T = g N to rounding: put the state exactly on the limit.
        self.friction = onset * mp.sin(self.y) if onset else friction
        return onset or None

    def _march(self, half, start, initial, amplitude):
        """Find the first angle from `start` on with |T| = N, and the direction, 0 if none.

        `reach` is the interval on which N is bounded. It follows the size of the steps, as N
        is close to constant on a short interval and the bound on f then close to f itself.
        """
        y, reach = start, mp.pi
        while y != half.end:
            normal = mp.sin(y)
            if normal > amplitude * 1.000002:
                # |T| <= amplitude < N: nothing can happen until N has fallen that far.
                if half.sense > 0:
                    return half.end, 0
                y = mp.asin(amplitude * 1.000001)
                continue
            if half.sense < 0 and y <= amplitude * (1 + half.nu) * self.noise:
                # T vanishes with N, to rounding: nu (1 + 1/e) is an even integer.
                return half.end, 0
            state = normal, mp.cos(y), _turn(initial, half.nu * abs(y - start))
            reach = min(reach, mp.pi / half.nu, abs(half.end - y))
            steps = [self._free_step(half, y, g, reach, state) for g in (1, -1)]
            step = min(steps)
            if step <= self.noise * y:
                return y + half.sense * step, 1 if steps[0] <= steps[1] else -1
            if step >= abs(half.end - y):
                return half.end, 0
            y += half.sense * step
            reach = 4 * reach if step == reach else 2 * step
        return y, 0

    def _free_step(self, half, y, g, reach, state):
        """Length from y, up to `reach`, on which N - g T provably has no root; 0 at a root."""
        normal, cosine, (friction, velocity) = state
        gap = normal - g * friction
        slope = half.sense * cosine / half.nu - g * velocity  # df/dpsi
        weight = half.excess / (self.zeta2 * half.nu**2)  # (nu^2 - 1)/nu^2
        bend = max(weight * normal, self.tiny)
        sliding = abs(slope) * half.nu * self.zeta2  # what _slip_end compares with `tiny`
        flat = sliding <= self.tiny or slope**2 <= 2 * bend * self.tiny
        if gap <= self.tiny and flat:
            # Double zero: the start of stick after slip, x = zeta2 at first contact, a graze,
            # or f = 0 throughout (nu = 1). What follows has the sign of nu^2 - 1, because only
            # the integral with its positive kernel is left, and it has no zero for psi <= pi.
            return reach if half.excess >= -self.tiny else mp.zero
        if gap <= self.noise * normal:
            if slope < 0:
                return mp.zero
            gap = max(gap, mp.zero)
        far = mp.sin(y + half.sense * reach)
        bound = min(normal, far) if weight > 0 else max(normal, far)
        angle = _first_zero(gap, slope, weight * bound)
        return reach if angle is None else min(reach, angle / half.nu)


def _turn(state, angle):
    """Rotate (T, w/Z) by the phase angle of the tangential oscillator."""
    cosine, sine = mp.cos_sin(angle)
    friction, velocity = state
    return friction * cosine + velocity * sine, velocity * cosine - friction * sine


def _first_zero(gap, slope, load):
    """First psi in (0, pi) with gap cos(psi) + slope sin(psi) + load (1 - cos(psi)) = 0, or None.

    In q = tan(psi/2): (gap - 2 load) q^2 - 2 slope q - gap = 0. `gap` must not be negative,
    and is positive wherever `slope` is not.
    """
    leading = gap - 2 * load
    discriminant = slope**2 + gap * leading
    if discriminant < 0:
        return None
    root = mp.sqrt(discriminant)
    if slope > 0:
        return 2 * mp.atan((slope + root) / leading) if leading > 0 else None
    return 2 * mp.atan(gap / (root - slope)) if root > slope else None
