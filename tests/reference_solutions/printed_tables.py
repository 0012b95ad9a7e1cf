"""Write the tables of data/printed_40_digits: what the paper's printed equations give.

    python -m tests.reference_solutions.printed_tables data/printed_40_digits

Transcribed from the paper, independently of the package, and solved with 50 digits. Units: time
1/Omega, velocities mu v2(0), forces m2 Omega v2(0) (friction: mu times that); w is
v1/(mu v2(0)), positive at first. The paper has v1, v2 < 0, so that its signs of v1 turn round.
"""

import functools
import sys

from mpmath import mp

from tests.reference_solutions import exact_tables, table_files
from tests.reference_solutions.exact_tables import BETA, INCIDENCE, VELOCITY, ZETA2, inside_angles
from tests.reference_solutions.table_files import table

# Offset from the start of stick at which |F1| < mu F2 surely, in units of 1/Omega: the two are
# equal there with equal slopes, and the search for where they are equal again starts behind it.
AFTER = 1e-3
SCAN = 400  # points of the search; the roots that are looked for are simple and far apart


def tables():
    """All tables, `{name: Table}`."""
    return {
        "fig6_rebound": _fig6(),
        "fig7_peak_force": _fig7(),
        "fig9_dissipation": _fig9(),
    }


def _fig6():
    """From 3 to beta at e = 0.5 the last slip goes forward, and the paper has it backward.

    The two differ most just below beta, by 2 e beta.
    """
    incidences = (3.05, 3.1, 3.15, 3.2, 3.25, 3.3, 3.35, 3.4, 3.45, 3.4999)
    return table(["model", "e", INCIDENCE, VELOCITY], _rebound, [(x, 0.5) for x in incidences])


def _rebound(x, e):
    return ["printed", e, x, impact(x, e).velocity]


def _fig7():
    """From x = beta to the largest for which Eq. 21 has a root: Eq. 32 where t2 > tc.

    The distance from the exact answer grows up to there, 2 beta - zeta^2.
    """
    places = [
        (mu, angle)
        for mu in exact_tables.FRICTIONS
        for angle in inside_angles(mu, 3.6, 4.0, 4.4, 4.8, 5.2, 5.5, 5.7, 5.789)
    ]
    return table(["model", *exact_tables.FIG7_COLUMNS], _peak_force, places)


def _peak_force(mu, angle):
    theta = mp.radians(angle)
    printed = impact(mp.tan(theta) / mp.mpf(mu), 1.0)
    return ["printed", mu, angle, mp.mpf(mu) * mp.cos(theta) * printed.peak]


PRINTED_FIG9 = {
    (0.1, 1.0): (0.5, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 6.75, 7.0, 8.0, 10.0, 12.5, 15.0, 17.5, 19.0)
    + (19.5, 20.0, 22.0, 24.0, 26.0, 28.0, 29.5),
    (0.1, 0.5): (0.5, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 6.75, 7.0, 8.0, 10.0, 12.5, 15.0, 17.5, 19.0),
    # At 56.2 deg, and 58.265 deg at e = 0.5, Fig. 9 and its printed equations differ most.
    (0.5, 1.0): (1.0, 5.0, 10.0, 15.0, 20.0, 25.0, 30.0, 31.0, 31.5, 35.0, 40.0, 45.0, 50.0, 55.0)
    + (56.2, 60.0, 61.0, 65.0, 70.0, 70.75),
    (0.5, 0.5): (1.0, 5.0, 10.0, 15.0, 20.0, 25.0, 30.0, 31.0, 31.5, 35.0, 40.0, 45.0, 50.0, 55.0)
    + (58.265, 60.0),
}


def _fig9():
    places = [(*pair, angle) for pair, angles in PRINTED_FIG9.items() for angle in angles]
    return table(["model", *exact_tables.FIG9_COLUMNS], _dissipation, places)


def _dissipation(mu, e, angle):
    theta = mp.radians(angle)
    lost = impact(mp.tan(theta) / mp.mpf(mu), e).dissipation
    # 2 D1/(mu^2 m2 v2(0)^2) to 2 D1/(m2 S^2)
    scale = (mp.mpf(mu) * mp.cos(theta)) ** 2
    return ["printed", mu, e, angle, scale * lost]


class Printed:
    """Velocity at separation, peak friction and 2 D1/(mu^2 m2 v2(0)^2) by Eqs 10 to 41."""

    def __init__(self, x, e):
        self.x, self.e = mp.mpf(x), mp.mpf(e)
        self.beta, self.zeta2 = mp.mpf(BETA), mp.mpf(ZETA2)
        self.omega = mp.sqrt(self.beta / self.zeta2)  # Eq. 4
        self.end = mp.pi / 2 * (1 + self.e)
        if self.x <= self.zeta2:  # Eq. 11
            self._initial_stick()
        else:
            self._initial_slip()

    def _angle(self, t):
        """Argument of Table 1: Omega t, in restitution Omega t/e + (pi/2)(1 - 1/e)."""
        return t if t <= mp.pi / 2 else t / self.e + mp.pi / 2 * (1 - 1 / self.e)

    def _normal(self, t):
        """F2 of Table 1."""
        return mp.sin(self._angle(t))

    def _impulse(self, t):
        """p of Table 1."""
        return 1 - (self.e if t > mp.pi / 2 else 1) * mp.cos(self._angle(t))

    def _slip_again(self, start, friction):
        """First instant after `start` at which |F1|/(mu F2) is 1: Eqs 10 and 23."""

        def excess(t):
            return abs(friction(t)) - self._normal(t)

        low = start + AFTER
        step = (self.end - low) / SCAN
        for _ in range(SCAN):
            if excess(low + step) > 0:
                return mp.findroot(excess, (low, low + step), solver="anderson")
            low += step
        raise ValueError("no end of stick")

    def _initial_stick(self):
        """Eqs 10, 12, 14, 15, 30, 39."""
        x, beta, omega = self.x, self.beta, self.omega
        t1 = self._slip_again(mp.zero, lambda t: x / self.zeta2 * mp.sin(omega * t) / omega)
        left = self.e * (1 + mp.cos(self._angle(t1)))  # g1
        self.velocity = x * mp.cos(omega * t1) + beta * left
        self.peak = x / mp.sqrt(self.zeta2 * beta)
        self.dissipation = -2 * left * (x * mp.cos(omega * t1) + beta / 2 * left)

    def _initial_slip(self):
        """Eqs 18, 19, 21, 22, 23, 25, 31, 32, 40."""
        x, beta, zeta2, omega = self.x, self.beta, self.zeta2, self.omega
        t2 = self._stick_again()
        stretch, velocity = zeta2 * self._normal(t2), x - beta * self._impulse(t2)

        def friction(t):
            turned = omega * (t - t2)
            return (stretch * mp.cos(turned) + velocity / omega * mp.sin(turned)) / zeta2

        def moving(t):
            turned = omega * (t - t2)
            return velocity * mp.cos(turned) - omega * stretch * mp.sin(turned)

        t3 = self._slip_again(t2, friction)
        self.velocity = moving(t3) + beta * (1 + self.e - self._impulse(t3))
        self.peak = self._largest(t2, t3)
        squares = x**2 - velocity**2 + moving(t3) ** 2 - self.velocity**2
        self.dissipation = squares / beta

    def _stick_again(self):
        """Eq. 21, solved for t2; both halves are linear in the cosine."""
        x, beta, zeta2, e = self.x, self.beta, self.zeta2, self.e
        if x <= beta:
            return mp.acos((beta - x) / (beta - zeta2))
        cosine = (beta - x) / (e * beta - zeta2 / e)
        if not -1 < cosine <= 0:
            raise ValueError("Eq. 21 has no root")
        return mp.pi / 2 + e * (mp.acos(cosine) - mp.pi / 2)

    def _largest(self, t2, t3):
        """Largest of Eq. 31 over the stick from t2 to t3, its start by Eq. 32.

        Eq. 32 is printed for compression only, and used for any t2.
        """
        stretch, velocity = self.zeta2 * mp.sin(t2), self.x - self.beta * (1 - mp.cos(t2))

        def size(turned):
            swing = velocity / self.omega * mp.sin(turned)
            return abs(stretch * mp.cos(turned) + swing) / self.zeta2

        lead, end = mp.atan2(velocity / self.omega, stretch), self.omega * (t3 - t2)
        crests = [lead + k * mp.pi for k in (-1, 0, 1, 2)]
        return max(size(turned) for turned in (0, end, *crests) if 0 <= turned <= end)


impact = functools.lru_cache(maxsize=None)(Printed)

if __name__ == "__main__":
    table_files.write(sys.argv[1], tables())
