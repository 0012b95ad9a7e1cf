"""Write the tables of data/slender_rod: a rod strikes with its tip, by integration and by impulses.

    python -m tests.reference_solutions.rod_tables data/slender_rod

With compliance the equations of motion are integrated by SciPy (noncollinear_integration.py);
without, velocities are stepped from event to event in normal impulse. Axes of the paper: the normal
velocity is negative before the impact. The tables have the signs of the figure, where it is
positive. Units: v2(0), 1/Omega and m2, the normal effective mass.
"""

import functools
import math
import sys
from itertools import product

from tests.reference_solutions import table_files
from tests.reference_solutions.noncollinear_integration import Contact
from tests.reference_solutions.table_files import Table

ZETA2, FRICTION, RESTITUTION = 1.21, 1.6, 0.9
RATIOS = (0.6, 2.5)  # v1(0)/v2(0)
# Degrees. The contact jams between 15 and 43, on one side.
TILTS = (-80.0, -60.0, -45.0, -35.0, -25.0, -17.0, -13.0, -5.0, 0.0, 5.0, 13.0, 17.0, 22.0, 27.0)
TILTS += (32.0, 37.0, 41.0, 45.0, 52.0, 60.0, 70.0, 80.0)
FOLLOWED = {"tilt": 25.0, "ratio": 10.0}
DIGITS = 10  # decimal places written
EVENTS = {
    "turn": "maximum compression",
    "reload": "reloading",
    "stop": "stick",
    "forward": "slip",
    "backward": "slip",
    "separation": "separation",
}

VELOCITIES = ["tangential_velocity [v2(0)]", "normal_velocity [v2(0)]"]
ENERGIES = ["energy_lost [K0]", "friction_work [K0]", "hysteresis [K0]", "energy_dissipated [K0]"]
FORCES = ["normal_force [m2 Omega v2(0)]", "friction_force [m2 Omega v2(0)]"]


def tables():
    """All tables, `{name: Table}`."""
    solvers = _compliant, functools.partial(_rigid, None), functools.partial(_rigid, "Newton")
    rebound, events, instants = [], [], []
    for ratio, solve in product(RATIOS, solvers):
        rebound += [functools.partial(solve, ratio, tilt) for tilt in TILTS]
    columns = [*VELOCITIES, "kinetic_energy [K0]", "jams [1]", *ENERGIES]
    header = ["time [1/Omega]", *FORCES, *VELOCITIES]
    for mu in (FRICTION, 0.0):
        # As many rows as `followed` has: SciPy is not asked before a row is.
        count = len(EVENT_ROWS[mu])
        events += [functools.partial(_event, mu, row) for row in range(count)]
        instants += [functools.partial(_instant, mu, time) for time in INSTANTS[mu]]
    return {
        "rebound": Table(["model", "variant", "velocity_ratio", "tilt [deg]", *columns], rebound),
        "contact_events": Table(["variant", "mu", "event", *header], events),
        "contact_instants": Table(["variant", "mu", *header], instants),
    }


# What is expected of the contacts that are followed, by friction; `followed` refuses others.
EVENT_ROWS = {
    FRICTION: ("slip", "stick", "maximum compression", "slip", "separation"),
    0.0: ("slip", "maximum compression", "separation"),
}
INSTANTS = {
    FRICTION: tuple(round(0.25 * k, 2) for k in range(1, 21)),
    0.0: tuple(round(0.25 * k, 2) for k in range(1, 12)),
}


class Rod:
    """A uniform slender rod of length 1 whose tip has the normal effective mass 1."""

    def __init__(self, tilt):
        sine, cosine = math.sin(math.radians(tilt)), math.cos(math.radians(tilt))
        # 1/m2 = (1 + x1^2/k^2)/M with k^2 = 1/12, x1 = sine/2: M = 1 + 3 sine^2 makes m2 = 1.
        mass = 1 + 3 * sine**2
        self.body = mass, 12**-0.5, sine / 2, -cosine / 2
        # Eqs 1 and 2: inverse mass matrix [[a, c], [c, b]].
        self.a, self.b, self.c = (1 + 3 * cosine**2) / mass, 1.0, 3 * sine * cosine / mass

    def energy(self, v1, v2):
        """Kinetic energy v m v/2, less what no impulse at the tip can change."""
        determinant = self.a * self.b - self.c**2
        return (self.b * v1**2 - 2 * self.c * v1 * v2 + self.a * v2**2) / (2 * determinant)

    def jams(self, direction):
        """Whether sliding in a direction presses the rod into the surface: dv2/dp < 0."""
        return self.b - FRICTION * direction * self.c < 0


def _rounded(cells):
    return [table_files.digits(cell, DIGITS) for cell in cells]


# With compliance -----------------------------------------------------------------------------


def _compliant(ratio, tilt):
    rod = Rod(tilt)
    contact = Contact(ratio, -1.0, rod.body, FRICTION, RESTITUTION, ZETA2, 1.0).run()
    v1, v2 = contact.state[2:]
    before = rod.energy(ratio, -1.0)
    left = rod.energy(v1, v2) / before
    # A reload follows the line of unloading, so that one triangle is lost, of the deepest point.
    hysteresis = (1 - RESTITUTION**2) * contact.deepest**2 / 2 / before
    work = contact.friction_work / before
    jams = any(rod.jams(phase[2]) for phase in contact.phases if phase[2])
    numbers = [v1, -v2, left, jams, 1 - left, work, hysteresis, work + hysteresis]
    return ["lumped", None, ratio, tilt, *_rounded(numbers)]


@functools.cache
def followed(friction):
    """The contact that is followed through, with all its phases."""
    rod = Rod(FOLLOWED["tilt"])
    contact = Contact(FOLLOWED["ratio"], -1.0, rod.body, friction, RESTITUTION, ZETA2, 1.0)
    return contact.run()


def _columns(contact, phase, elapsed):
    """Forces and velocities in a phase, some time after it begins.

    As in the figure, friction is positive where it opposes a positive velocity.
    """
    _, found, contact.g, contact.loading, contact.deepest, _ = phase
    u1, u2, v1, v2, _ = found.sol(elapsed)
    return [contact.normal(u2), -contact.tangential(u1, u2), v1, -v2]


def _event(mu, row):
    contact = followed(mu)
    names = ["slip", *(EVENTS[phase[-1]] for phase in contact.phases)]
    if tuple(names) != EVENT_ROWS[mu]:
        raise SystemExit(f"mu = {mu:g}: events {names}")
    if row == 0:
        phase, elapsed = contact.phases[0], 0.0
    else:
        phase = contact.phases[row - 1]
        elapsed = phase[1].t[-1]
    columns = _columns(contact, phase, elapsed)
    return ["contact", mu, names[row], *_rounded([phase[0] + elapsed, *columns])]


def _instant(mu, time):
    contact = followed(mu)
    phase = next(phase for phase in reversed(contact.phases) if phase[0] <= time)
    return ["contact", mu, time, *_rounded(_columns(contact, phase, time - phase[0]))]


# Without compliance --------------------------------------------------------------------------


def _rigid(variant, ratio, tilt):
    rod = Rod(tilt)
    v1, v2 = rigid(ratio, rod, kinematic=variant == "Newton")
    left = rod.energy(v1, v2) / rod.energy(ratio, -1.0)
    numbers = _rounded([v1, -v2, left, rod.jams(1)])
    return ["rigid", variant, ratio, tilt, *numbers, None, None, None, None]


def rigid(v1, rod, kinematic):
    """Velocities after the impact, from v1 > 0 and v2 = -1.

    The tip slides until it comes to rest, then sticks if friction can hold it, or slides with the
    coupling. `kinematic`: the normal velocity at the end is e; else the normal force's work in
    restitution is e^2 of that in compression.
    """
    v2, work, compressing = -1.0, 0.0, True  # `work` is taken in, then given back
    while True:
        if v1 != 0 or abs(rod.c) > FRICTION * rod.a:
            direction = math.copysign(1, v1 if v1 != 0 else rod.c)
            share = FRICTION * direction
        else:
            share = rod.c / rod.a  # friction that keeps v1 = 0
        drift, lift = rod.c - share * rod.a, rod.b - share * rod.c
        steps = {}
        if v1 * drift < 0:
            steps["rest"] = -v1 / drift
        if compressing and lift > 0:
            steps["turn"] = -v2 / lift
        if not compressing:
            # From v2 s + lift s^2/2 = work, the work still to be done.
            last = RESTITUTION if kinematic else math.sqrt(v2**2 + 2 * lift * work)
            steps["end"] = (last - v2) / lift
        name = min(steps, key=steps.get)
        step = steps[name]
        work -= v2 * step + lift * step**2 / 2
        v1, v2 = v1 + drift * step, v2 + lift * step
        if name == "rest":
            v1 = 0.0
        elif name == "turn":
            v2, compressing = 0.0, False
            work *= RESTITUTION**2
        else:
            return v1, v2


if __name__ == "__main__":
    table_files.write(sys.argv[1], tables())
