"""Write the tables of data/lumped_40_digits from the independent 40-digit reference.

python -m tests.reference_solutions.exact_tables data/lumped_40_digits
"""

import functools
import math
import sys
from itertools import product

from mpmath import mp

from tests.reference_solutions import high_precision, table_files
from tests.reference_solutions.table_files import Table, table

BETA, ZETA2 = 3.5, 1.21
RUBBER = 1.5  # zeta^2 at Poisson's ratio 0.5
# The impacts of Figs 3 and 4, at each of two restitutions.
CONTACTS = {"fig3": 1.0, "fig4": 2.5}
RESTITUTIONS = (1.0, 0.5)
# Parameters of data/kharaz2001; they are float64 numbers, as the solver has them.
SHOT = {"stiffness_ratio": 1.164, "restitution": 0.98, "friction": 0.092}
SHOT |= {"speed": 3.9, "radius": 0.0025}
# The ball of Fig. 8; its plate is of the same steel and as good as plane and infinitely heavy.
BALL = {
    "friction": 0.18,
    "speed": 0.048,
    "mass": 0.101,
    "radius": 0.0127,
    "young_modulus": 207e9,
    "poisson_ratio": 0.3,
}
# The kinds of event as the package names them.
KINDS = {"compression ends": "maximum compression"}
FRICTIONS = (0.1, 0.2, 0.4, 0.6, 0.8, 1.0)  # of Fig. 7

VELOCITY = "velocity [mu v2(0)]"
INCIDENCE = "incidence [mu v2(0)]"
ANGLE = "angle [deg]"
LUMPED_FORCES = ["normal_force [m2 Omega v2(0)]", "friction_force [mu m2 Omega v2(0)]"]
HERTZ_FORCES = ["normal_force [F2max]", "friction_force [mu F2max]"]
FIG7_COLUMNS = ["mu", ANGLE, "peak_force [m2 Omega S]"]
FIG9_COLUMNS = ["mu", "e", ANGLE, "friction_dissipation [m2 S^2/2]"]
# Columns that name a curve; the lumped model's, and its answers where the printed one has none.
CURVE = ["model", "variant"]
SOLVED, UNSOLVED = ["lumped", None], ["printed", "no solution"]

solve = functools.lru_cache(maxsize=None)(high_precision.rebound)


@mp.workdps(table_files.DIGITS)
def tables():
    """All tables, `{name: Table}`."""
    found = {}
    for figure, x in CONTACTS.items():
        found[f"{figure}_events"], found[f"{figure}_instants"] = _contact(x)
    found |= {
        "fig5_rebound": _fig5(),
        "fig5_experiment": _fig5_experiment(),
        "fig6_rebound": _fig6(),
        "fig7_peak_force": _fig7(),
        "fig8_peak_force": _fig8(),
        "fig9_dissipation": _fig9(),
        "micro_slip_events": _micro_slip(),
    }
    return found


def limit(beta, zeta2, e):
    """Incidence from which on the contact slips throughout."""
    return beta + (max(0.0, e * beta - zeta2 / e) if e else 0.0)


def neighbours(x):
    """A float64 number, and the ones next to it."""
    return {x, math.nextafter(x, 0), math.nextafter(x, math.inf)}


# Histories -----------------------------------------------------------------------------------


def _contact(x):
    """Events of a contact, and instants between them."""
    events, instants = [], []
    for e in RESTITUTIONS:
        answer = solve(x, BETA, ZETA2, e)
        for event in answer.events:
            kind = KINDS.get(event.kind, event.kind)
            cells = ["lumped", e, kind, *_numbers(event)]
            events.append(functools.partial(list, cells))
        for time in _between(answer.events):
            instants.append(functools.partial(_instant, x, e, time))
    labels, header = ["model", "e"], ["time [t_c]", *LUMPED_FORCES, VELOCITY]
    return Table([*labels, "event", *header], events), Table([*labels, *header], instants)


def _numbers(event):
    return [event.time, event.normal, event.friction_force, event.velocity]


def _between(events):
    """Instants of float64 at a quarter, half and three quarters of each phase."""
    found = []
    for first, last in zip(events, events[1:], strict=False):
        span = last.time - first.time
        if span > 0:
            found += [float(first.time + span * share / 4) for share in (1, 2, 3)]
    return found


def _instant(x, e, time):
    return ["lumped", e, time, *_numbers(state_at(solve(x, BETA, ZETA2, e), e, time))[1:]]


def state_at(answer, e, time):
    """State of a contact inside one of its phases, from the event that begins it.

    Time is in units of that to greatest compression.
    """
    time = mp.mpf(time)
    started = [event for event in answer.events if event.time <= time]
    sticks = next(v.kind for v in reversed(started) if v.kind in ("stick", "slip")) == "stick"
    last = started[-1]
    first, normal = (_normal_motion(instant, e) for instant in (last.time, time))
    if sticks:
        omega = mp.sqrt(mp.mpf(BETA) / mp.mpf(ZETA2))
        turned = omega * mp.pi / 2 * (time - last.time)
        cosine, sine = mp.cos(turned), mp.sin(turned)
        impedance = omega * mp.mpf(ZETA2)
        friction = last.friction_force * cosine + last.velocity / impedance * sine
        velocity = last.velocity * cosine - impedance * last.friction_force * sine
    else:
        # Slip began where |T| = N; at first contact both are zero and it goes forward.
        forward = -1 if last.friction_force < 0 else 1
        friction = forward * normal[0]
        velocity = last.velocity - forward * BETA * (normal[1] - first[1])
    return high_precision.Event("", time, normal[0], friction, velocity)


def _normal_motion(time, e):
    """Normal force and impulse."""
    if time <= 1:
        return mp.sin(mp.pi / 2 * time), 1 - mp.cos(mp.pi / 2 * time)
    angle = mp.pi / 2 * (1 + (time - 1) / mp.mpf(e))
    return mp.sin(angle), 1 - mp.mpf(e) * mp.cos(angle)


def _micro_slip():
    """The lumped contacts beside those of the continuum: Figs 3 and 4 without losses."""
    rows = []
    for x in CONTACTS.values():
        events = {event.time: event for event in solve(x, BETA, ZETA2, 1.0).events}
        for event in events.values():
            rows.append(functools.partial(list, ["lumped", x, *_numbers(event)]))
    return Table(["model", "x", "time [t_c]", *HERTZ_FORCES, VELOCITY], rows)


# Rebound -------------------------------------------------------------------------------------


def _fig5():
    """Spheres of steel and of rubber, e = 1; also where the printed equations have no solution."""
    grid = {0.25, 0.5, 1.0, 1.5, 2.0, 2.5, 3.0, 3.25, 3.75, 4.0, 4.5, 5.0, 5.25, 5.5, 5.75}
    grid |= {0.0, 6.0, 6.5, 7.0, 8.0, 10.0, 12.0, 14.0}
    places = []
    for variant, zeta2 in ((None, ZETA2), ("rubber", RUBBER)):
        beside = map(neighbours, (zeta2, BETA, limit(BETA, zeta2, 1.0)))
        xs = sorted(grid.union(*beside))
        places += [(["lumped", variant], x, zeta2, not variant) for x in xs]
    unsolved = (5.85, 6.0, 6.25, 6.5, 6.75, 6.95)
    places += [(UNSOLVED, x, ZETA2, False) for x in unsolved]
    return table([*CURVE, INCIDENCE, VELOCITY, "spin [mu v2(0)/R]"], _sphere, places)


def _sphere(curve, x, zeta2, spins):
    velocity = solve(x, BETA, zeta2, 1.0).velocity
    # A solid sphere: the impulse that changes v1 by 7/2 of the centre's change turns it.
    return [*curve, x, velocity, -mp.mpf(5) / 7 * (x - velocity) if spins else None]


SHOT_ANGLES = (0.25, 0.5, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 6.1, 6.2, 7.0, 8.0, 10.0, 12.0, 14.0)
SHOT_ANGLES += (16.0, 17.8, 17.9, 18.5, 20.0, 24.0, 27.7, 27.9, 30.0, 40.0, 50.0, 60.0, 70.0, 80.0)
SHOT_HEADER = [
    INCIDENCE,
    VELOCITY,
    "centre_restitution [1]",
    "spin [rad/s]",
    "centre_rebound_angle [deg]",
    "contact_rebound_angle [deg]",
]


def _fig5_experiment():
    return table([*CURVE, ANGLE, *SHOT_HEADER], _shot, [(angle,) for angle in SHOT_ANGLES])


def _shot(angle):
    x = mp.tan(mp.radians(angle)) / mp.mpf(SHOT["friction"])
    velocity = solve(x, BETA, SHOT["stiffness_ratio"], SHOT["restitution"]).velocity
    return ["lumped.hysteretic", "experiment", angle, *shot_columns(angle, x, velocity)]


def shot_columns(angle, x, velocity):
    """What is seen of a sphere shot without spin, from its incidence and rebound (mpf).

    From the impulse P = M (v1(0) - v1(tf))/beta of friction, v1 the contact's velocity: the centre
    keeps v1(0) - P/M, the spin becomes P R/(2/5 M R^2).
    """
    mu, e = mp.mpf(SHOT["friction"]), mp.mpf(SHOT["restitution"])
    v2 = mp.mpf(SHOT["speed"]) * mp.cos(mp.radians(angle))
    before, after = mu * v2 * x, mu * v2 * velocity
    impulse = (before - after) / mp.mpf(BETA)
    centre = before - impulse
    spin = impulse / (mp.mpf(2) / 5 * mp.mpf(SHOT["radius"]))
    angles = (mp.degrees(mp.atan(along / (e * v2))) for along in (centre, after))
    return [x, velocity, centre / before, spin, *angles]


def _fig6():
    """Incidences on a grid and at every threshold with its two neighbours.

    At the same incidences also where the printed equations have no solution.
    """
    places = []
    for e in (0.0, 0.5, 1.0):
        top = limit(BETA, ZETA2, e)
        grid = {0.25 * k for k in range(33)}.union(*map(neighbours, (ZETA2, BETA, top)))
        places += [(SOLVED, x, e, True) for x in sorted(grid)]
        unsolved = [x for x in sorted(grid) if e and top + 0.1 < x < (1 + e) * BETA]
        places += [(UNSOLVED, x, e, False) for x in unsolved]
    force, lost = "peak_friction_force [mu m2 Omega v2(0)]", "dissipation [mu^2 m2 v2(0)^2]"
    return table([*CURVE, "e", INCIDENCE, VELOCITY, force, lost], _restitution, places)


def _restitution(curve, x, e, whole):
    answer = solve(x, BETA, ZETA2, e)
    more = [answer.peak_friction, answer.dissipation] if whole else [None, None]
    return [*curve, e, x, answer.velocity, *more]


# Against the angle of incidence --------------------------------------------------------------


def threshold_angles(mu, *incidences):
    """Angles in degrees a hundredth of a degree below and above those of some incidences."""
    found = [math.degrees(math.atan(mu * x)) for x in incidences]
    return [round(angle + step, 2) for angle in found for step in (-0.01, 0.01)]


def inside_angles(mu, *incidences):
    """Angles of some incidences, rounded to a thousandth of a degree."""
    return [round(math.degrees(math.atan(mu * x)), 3) for x in incidences]


FIG7_ANGLES = [0.0, 1.0, 2.5, 5.0, 7.5, 10.0, 12.5, 15.0, 17.5, 20.0, 25.0, 30.0, 35.0, 40.0, 45.0]
FIG7_ANGLES += [50.0, 55.0, 60.0, 65.0, 70.0, 75.0, 80.0, 85.0, 89.0]
BEYOND_PRINTED = (5.85, 6.2, 6.6, 6.95)  # incidences where Eq. 21 has no root, e = 1


def fig7_angles(mu):
    """Of Fig. 7, in degrees: a grid and the thresholds' surroundings."""
    return sorted({*FIG7_ANGLES, *threshold_angles(mu, ZETA2, BETA)})


def _fig7():
    places = []
    for mu in FRICTIONS:
        unsolved = inside_angles(mu, *BEYOND_PRINTED)
        places += [(SOLVED, mu, angle) for angle in fig7_angles(mu)]
        places += [(UNSOLVED, mu, angle) for angle in unsolved]
    return table([*CURVE, *FIG7_COLUMNS], _peak_force, places)


def _at_angle(mu, angle, e=1.0):
    """mu times the cosine of the angle, and the impact."""
    theta, mu = mp.radians(angle), mp.mpf(mu)
    return mu * mp.cos(theta), solve(mp.tan(theta) / mu, BETA, ZETA2, e)


def _peak_force(curve, mu, angle):
    scale, answer = _at_angle(mu, angle)
    return [*curve, mu, angle, scale * answer.peak_friction]


FIG8_ANGLES = [float(k) for k in (0, 1, 2, 4, 6, 8, 10, 11, 12.28, 12.3, 14, 16, 18, 20, 22, 24)]
FIG8_ANGLES += [float(k) for k in (26, 27.8, 29, 31, 32.2, 32.22, 35, 40, 46.17, 46.2, 50, 60, 70)]
FIG8_ANGLES += [80.0, 85.0]


def _fig8():
    columns = ["peak_force [N]", "peak_over_mu_normal [1]", "lowest_friction [N]"]
    places = product(("normal", "friction"), FIG8_ANGLES)
    return table([*CURVE, ANGLE, *columns], _newtons, places)


def _hertz():
    """Largest force in N of the ball at normal incidence, by Hertz.

    m v^2/2 = (8/15) E* sqrt(R) d^(5/2), F = (4/3) E* sqrt(R) d^(3/2), 1/E* = 2 (1 - nu^2)/E.
    """
    ball = {key: mp.mpf(value) for key, value in BALL.items()}
    modulus = ball["young_modulus"] / (2 * (1 - ball["poisson_ratio"] ** 2))
    spring = modulus * mp.sqrt(ball["radius"])
    depth = (mp.mpf(15) / 16 * ball["mass"] * ball["speed"] ** 2 / spring) ** (mp.mpf(2) / 5)
    return mp.mpf(4) / 3 * spring * depth ** (mp.mpf(3) / 2)


def _newtons(force, angle):
    if force == "normal":
        return ["lumped", force, angle, _hertz() * mp.cos(mp.radians(angle)), None, None]
    scale, answer = _at_angle(BALL["friction"], angle)
    unit, peak = scale * _hertz(), answer.peak_friction
    return ["lumped", force, angle, unit * peak, peak, unit * lowest_friction(answer)]


def lowest_friction(answer):
    """Least friction over a contact, from its events, e = 1.

    In slip friction is plus or minus the normal force, which is monotone in each half of the
    contact: its extremes stand at the events. In stick it is harmonic, and is least also where the
    velocity turns round from negative to positive: friction grows with the velocity.
    """
    found = min(event.friction_force for event in answer.events)
    omega = mp.sqrt(mp.mpf(BETA) / mp.mpf(ZETA2))
    impedance = omega * mp.mpf(ZETA2)
    sticks = False
    for event, after in zip(answer.events, answer.events[1:], strict=False):
        if event.kind in ("stick", "slip"):
            sticks = event.kind == "stick"
        if sticks:
            # T = A cos(a - lead): least at a = lead + pi, if the phase lasts so long.
            lead = mp.atan2(event.velocity / impedance, event.friction_force)
            turned = omega * mp.pi / 2 * (after.time - event.time)
            if (lead + mp.pi) % (2 * mp.pi) < turned:
                found = min(found, -mp.hypot(event.friction_force, event.velocity / impedance))
    return found


UNSOLVED_FIG9 = {
    (0.1, 1.0): (30.5, 31.5, 33.0, 34.5),
    (0.1, 0.5): (20.0, 22.0, 24.0, 26.0, 27.5),
    (0.5, 1.0): (71.0, 72.0, 73.0, 73.75),
    (0.5, 0.5): (61.0, 63.0, 65.0, 67.0, 69.0),
}


def _fig9():
    places = []
    for (mu, e), unsolved in UNSOLVED_FIG9.items():
        top = limit(BETA, ZETA2, e)
        angles = {float(k) for k in range(5, 90, 5)} | set(threshold_angles(mu, ZETA2, BETA, top))
        places += [(SOLVED, mu, e, angle, True) for angle in sorted(angles)]
        places += [(UNSOLVED, mu, e, angle, False) for angle in unsolved]
    return table([*CURVE, *FIG9_COLUMNS, "friction_work [m2 S^2/2]"], _dissipation, places)


def _dissipation(curve, mu, e, angle, work):
    scale, answer = _at_angle(mu, angle, e)
    share = 2 * scale**2
    spent = share * answer.friction_work if work else None
    return [*curve, mu, e, angle, share * answer.dissipation, spent]


if __name__ == "__main__":
    table_files.write(sys.argv[1], tables())
