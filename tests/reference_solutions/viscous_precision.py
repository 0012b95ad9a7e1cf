"""Reference solution of two Kelvin-Voigt elements in impact, in multiple precision.

Written from the equations of motion alone, independently of the package, to prove its results:

    u'' + tau u' + u = 0,  N = u + tau u';   w' = -beta T,  s + tau s' = zeta^2 T,
    stick: s' = w while |T| <= N;            slip in direction g: T = g N.

In a phase every quantity is a sum of exponentials, two for each oscillator, which may be complex,
one for the relaxation, and a constant. The coefficients follow from the differential equations,
term by term.

Where a phase ends is found by a march that cannot pass a root. For a sum f, M bounds |f''| for all
later times: an oscillator p'' + d p' + c p = 0 never gains c p^2 + p'^2, p'' obeys the same
equation, and a real exponential falls. So f + f' h - M h^2/2 is a lower bound of f, and the march
only ever steps to its first zero. It comes to a simple root quadratically, from below. Where two
nearly equal oscillators cancel, so that f is small for long, M bounds |f''| for a while only, by
Taylor's series of their sum.
"""

from typing import NamedTuple

from mpmath import mp

GUARD_DIGITS = 40  # nearly equal exponents, at critical damping, cost half of them
MOST_STEPS = 20_000
# A step shorter than SMALL asks Taylor's series for a bound for a while, LONGEST at most.
SMALL, LONGEST, ORDER = 0.01, 0.3, 24


class Event(NamedTuple):
    """State at one instant; ``time`` is in 1/Omega, the normal force in m2 Omega |v2(0)|."""

    kind: str
    time: mp.mpf
    normal: mp.mpf
    friction_force: mp.mpf
    velocity: mp.mpf
    spring: mp.mpf


class Answer(NamedTuple):
    """Outcome of one impact; energies in mu^2 m2 v2(0)^2."""

    velocity: mp.mpf
    peak_friction: mp.mpf  # in mu times the largest normal force
    dissipation: mp.mpf  # the work of friction
    tangential_viscous: mp.mpf
    tangential_strain: mp.mpf  # left at separation
    duration: mp.mpf
    events: tuple


class Sum:
    """A sum of exponentials of the time since the start of the phase, by the name of its block."""

    def __init__(self, terms, stiffness):
        self.terms, self.stiffness = terms, stiffness  # {block: [(coefficient, exponent)]}
        self._known = None, {}  # a time, and the terms of each block at it

    def __call__(self, time, order=0):
        return mp.fsum(self._block(name, time, order) for name in self.terms)

    def _block(self, name, time, order):
        # Exponentials take most of the time, and the march asks for four orders at each instant.
        if self._known[0] != time:
            self._known = time, {}
        if name not in self._known[1]:
            self._known[1][name] = [(a * mp.exp(p * time), p) for a, p in self.terms[name]]
        return mp.re(mp.fsum(a * p**order for a, p in self._known[1][name]))

    def bend(self, time):
        """A bound of the size of the second derivative from this time on."""
        total = mp.zero
        for name in self.terms:
            value = self._block(name, time, 2)
            if name in self.stiffness:
                total += mp.sqrt(value**2 + self._block(name, time, 3) ** 2 / self.stiffness[name])
            else:
                total += abs(value)
        return total

    def local_bend(self, time):
        """A bound of the second derivative over a span of time from now on, as a function of it."""
        swings = [pair for name in self.stiffness for pair in self.terms.get(name, [])]
        rest = mp.fsum(abs(self._block(n, time, 2)) for n in self.terms if n not in self.stiffness)
        last = mp.zero
        for name in self.stiffness:
            value, slope = (self._block(name, time, ORDER + k) for k in (2, 3))
            last += mp.sqrt(value**2 + slope**2 / self.stiffness[name])
        now, sizes = [(a * p**2 * mp.exp(p * time), p) for a, p in swings], []
        for k in range(ORDER):
            sizes.append(abs(mp.re(mp.fsum(a for a, _ in now))) / mp.factorial(k))
            now = [(a * p, p) for a, p in now]
        sizes.append(last / mp.factorial(ORDER))
        return lambda span: rest + mp.fsum(a * span**k for k, a in enumerate(sizes))

    def plus(self, other, factor):
        terms = {name: list(pairs) for name, pairs in self.terms.items()}
        for name, pairs in other.terms.items():
            terms.setdefault(name, []).extend((factor * a, p) for a, p in pairs)
        return Sum(terms, {**self.stiffness, **other.stiffness})

    def rate(self):
        terms = {name: [(a * p, p) for a, p in pairs] for name, pairs in self.terms.items()}
        return Sum(terms, self.stiffness)

    def flat(self):
        return [pair for pairs in self.terms.values() for pair in pairs]

    def integral(self, other, time):
        """Integral of the product, from the start of the phase."""
        total = mp.zero
        for a, p in self.flat():
            for b, q in other.flat():
                both = p + q
                total += a * b * (mp.expm1(both * time) / both if both else time)
        return mp.re(total)


def _oscillator(name, stiffness, damping, value, slope):
    """The solution of p'' + damping p' + stiffness p = 0 with these starts."""
    root = mp.sqrt(mp.mpc(damping**2 / 4 - stiffness))
    if not root:
        raise ArithmeticError("critically damped to the last digit")
    first, second = -damping / 2 + root, -damping / 2 - root
    a = (slope - second * value) / (first - second)
    return Sum({name: [(a, first), (value - a, second)]}, {name: stiffness})


def _first_root(f, end, tiny):
    """First time in (0, end] at which f falls through 0, or None; f may start from 0, rising."""
    time = mp.zero
    for _ in range(MOST_STEPS):
        value, slope, bend = f(time), f(time, 1), f.bend(time)
        if max(abs(value), abs(slope), bend) <= tiny:
            return None  # f vanishes throughout: x = zeta^2 = beta
        if value <= tiny:
            if slope < 0:
                return time
            value = max(value, mp.zero)
        if not bend:
            return None  # f is constant: x > zeta^2 = beta
        step = (slope + mp.sqrt(slope**2 + 2 * bend * value)) / bend
        at_root = slope < 0 and slope**2 > 8 * bend * value  # the bend no longer matters
        if step < SMALL and not at_root:
            span, bound = LONGEST, f.local_bend(time)
            while span > step:
                near = bound(span)
                free = (slope + mp.sqrt(slope**2 + 2 * near * value)) / near if near else span
                step = max(step, min(span, free))
                span /= 10
        step = max(step, mp.sqrt(tiny))  # two roots as close as this are none
        time += step
        if time >= end:
            return None
    raise ArithmeticError("too many steps")


def damping_ratio(restitution):
    """xi with this restitution, from the motion of the normal element alone."""

    def surplus(xi):
        root = mp.sqrt(abs(1 - xi**2))
        if xi < 1:
            time = mp.atan2(2 * xi * root, 2 * xi**2 - 1) / root
            odd, even = mp.sin(root * time) / root, mp.cos(root * time)
        else:
            time = mp.atanh(2 * xi * root / (2 * xi**2 - 1)) / root
            odd, even = mp.sinh(root * time) / root, mp.cosh(root * time)
        return mp.log(mp.exp(-xi * time) * (xi * odd - even)) - mp.log(restitution)

    speck = mp.mpf(10) ** (-mp.dps // 2)
    if restitution > mp.exp(-2):
        bracket = speck, 1 - speck
    else:
        bracket = 1 + speck, 1 / mp.sqrt(restitution) + 1
    return mp.findroot(surplus, bracket, solver="anderson", tol=mp.mpf(10) ** (-2 * mp.dps + 20))


def rebound(incidence, mass_ratio, stiffness_ratio, restitution, digits=40):
    """Solve one impact, 0 <= x, 0 < e < 1; the arguments count as exact."""
    with mp.workdps(digits + GUARD_DIGITS):
        return _Impact(*map(mp.mpf, (incidence, mass_ratio, stiffness_ratio, restitution))).solve()


class _Impact:
    def __init__(self, x, beta, zeta2, e):
        self.x, self.beta, self.zeta2, self.e = x, beta, zeta2, e
        self.tau = 2 * damping_ratio(e)
        self.tiny = mp.mpf(10) ** (GUARD_DIGITS // 2 - mp.dps)
        force = self._normal(mp.zero, mp.one)[0]
        self.duration = self._far(force, mp.mpf(10))
        self.peak_normal = force(self._far(force.rate(), self.duration) or 0)
        if self.tau >= 1:
            self.peak_normal = self.tau
        if abs(self._normal(mp.zero, mp.one)[1](self.duration) + e) > self.tiny:
            raise ArithmeticError("the damping ratio does not give the restitution")
        self.friction = self.work = self.viscous = mp.zero

    def _far(self, f, end):
        return _first_root(f, end, self.tiny) if f(mp.zero) > 0 else None

    def _normal(self, u, v):
        compression = _oscillator("normal", mp.one, self.tau, u, v)
        velocity = compression.rate()
        return compression.plus(velocity, self.tau), velocity

    def solve(self):
        time, u, v, s, w = mp.zero, mp.zero, mp.one, mp.zero, self.x
        sticks = w < self.zeta2 or (w == self.zeta2 and self.beta > self.zeta2)
        side, events = 1, []
        first = True
        while True:
            left = self.duration - time
            force, velocity = self._normal(u, v)
            here = force(mp.zero)
            if sticks:
                b = self.beta / self.zeta2
                spring = _oscillator("tangential", b, b * self.tau, s, w)
                body = spring.rate()
                friction = Sum(
                    {n: [(a / self.zeta2, p) for a, p in c] for n, c in spring.terms.items()},
                    spring.stiffness,
                ).plus(body, self.tau / self.zeta2)
            else:
                # w' = -g beta N and s + tau s' = g zeta^2 N, exponential by exponential.
                pairs = force.flat()
                gain = [(-side * self.beta * a / p, p) for a, p in pairs]
                start = w - mp.re(mp.fsum(a for a, _ in gain))
                body = Sum({"normal": gain, "constant": [(start, mp.zero)]}, force.stiffness)
                forced = [(side * self.zeta2 * a / (1 + self.tau * p), p) for a, p in pairs]
                rest = s - mp.re(mp.fsum(a for a, _ in forced))
                relaxing = {"normal": forced, "layer": [(rest, -1 / self.tau)]}
                spring = Sum(relaxing, force.stiffness)
                friction = Sum({"normal": [(side * a, p) for a, p in pairs]}, force.stiffness)
            events.append(Event("stick" if sticks else "slip", time, here, friction(mp.zero), w, s))
            if sticks:
                roots = [_first_root(force.plus(friction, -g), left, self.tiny) for g in (1, -1)]
                span, following = min(
                    ((root, g) for root, g in zip(roots, (1, -1), strict=True) if root is not None),
                    default=(None, 0),
                )
                self._crest(friction, left if span is None else span)
            else:
                gap = Sum(
                    {n: [(side * a, p) for a, p in c] for n, c in body.terms.items()},
                    body.stiffness,
                ).plus(spring.rate(), -side)
                span, following = _first_root(gap, left, self.tiny), side
                if first and span is None and gap(mp.zero) < -self.tiny:
                    raise ArithmeticError("slip against its direction")
            until = left if span is None else span
            if not sticks:
                top = self._far(force.rate(), until)
                ends = here, force(until), force(top) if top else mp.zero
                self.friction = max(self.friction, *ends)
                self.work += force.integral(gap, until)
            slope = spring.rate()
            self.viscous += self.tau / self.zeta2 * slope.integral(slope, until)
            time += until
            w, s, v = body(until), spring(until), velocity(until)
            u = force(until) - self.tau * v
            if span is None:
                break
            sticks, side, first = not sticks, following, False
        at_end = friction(until)
        events.append(Event("separation", time, force(until), at_end, w, s))
        return Answer(
            w,
            self.friction / self.peak_normal,
            self.work,
            self.viscous,
            s**2 / (2 * self.zeta2),
            self.duration,
            tuple(events),
        )

    def _crest(self, friction, until):
        """Largest |T| of a stick: at its ends, or at the first crest, as later ones are lower."""
        values = [abs(friction(mp.zero)), abs(friction(until))]
        rate = friction.rate()
        sign = mp.sign(rate(mp.zero))
        rate = Sum(
            {n: [(sign * a, p) for a, p in c] for n, c in rate.terms.items()}, rate.stiffness
        )
        top = self._far(rate, until)
        self.friction = max(self.friction, *values, abs(friction(top)) if top else mp.zero)
