"""Write the table of data/lumped_viscous: impacts of two viscous elements, with their energy.

python -m tests.reference_solutions.viscous_tables data/lumped_viscous
"""

import math
import random
import sys

import numpy as np
from mpmath import mp

from tests.reference_solutions import table_files, viscous_precision
from tests.reference_solutions.extreme_tables import bisected, one_of, rounded

CRITICAL = math.exp(-2)  # restitution of a critically damped normal element
DISTANCES = (1e-12, 1e-9, 1e-6, 1e-3)
OUTPUTS = ("velocity", "peak_friction", "dissipation")
HEADER = [
    "incidence [mu v2(0)]",
    "mass_ratio [1]",
    "stiffness_ratio [1]",
    "restitution [1]",
    "velocity [mu v2(0)]",
    "peak_friction [mu F2max]",
    "dissipation [mu^2 m2 v2(0)^2]",
    "tangential_viscous [mu^2 m2 v2(0)^2]",
    "tangential_strain_left [mu^2 m2 v2(0)^2]",
    "phases [1]",
]
# What `lumped.rebound` promises in this box, beside `scales`.
PROMISED = 1e-12
# Impacts elsewhere, and at or beside a threshold or a switch of course.
ELSEWHERE, BESIDE, SWITCHES = 300, 400, 8


def points():
    """Impacts of the table, each once; the same on every machine."""
    dice = random.Random(2007)
    found = [_anywhere(dice) for _ in range(ELSEWHERE)]
    while len(found) < ELSEWHERE + BESIDE:
        point = _beside(dice)
        if _in_box(point):
            found.append(point)
    for _ in range(SWITCHES):
        found += filter(_in_box, _around_switch(dice))
    return list(dict.fromkeys(found))


def thresholds(beta, zeta2, e):
    """Incidences at which the order of phases changes, or another model says so."""
    return [zeta2, beta, max(zeta2, beta + e * (beta - zeta2)), (1 + e) * beta]


def row(point):
    """One impact: groups as float64, outputs with 20 digits."""
    answer = viscous_precision.rebound(*point)
    outputs = [getattr(answer, name) for name in OUTPUTS]
    energies = answer.tangential_viscous, answer.tangential_strain
    return [*point, *outputs, *energies, float(len(answer.events) - 1)]


def scales(x, beta, _, e):
    """What errors of the outputs count beside; shape (3, ...)."""
    work = np.minimum(np.divide(x, 2 * beta), 1 + e) * x
    size = np.maximum(np.maximum(x, beta), 1)
    return np.stack([size, np.ones_like(size), np.maximum(work, 1e-300)])


def course(point):
    """Order of phases, and direction of the last slip."""
    events = viscous_precision.rebound(*point).events[:-1]
    return [event.kind for event in events], mp.sign(events[-1].friction)


def tables():
    """`{name: Table}`."""
    return {"impacts": table_files.table(HEADER, row, [(point,) for point in points()])}


def _anywhere(dice):
    beta, zeta2 = 1 + 7 * dice.random(), 10 ** (2 * dice.random() - 1)
    x = one_of([20 * dice.random(), 4 * dice.random(), 10 ** (-12 * dice.random())], dice)
    return tuple(map(rounded, (x, beta, zeta2))) + (_restitution(dice),)


def _restitution(dice):
    near_one = 1 - 10 ** (-1 - 13 * dice.random())
    spread = 0.01 + 0.99 * dice.random()
    return one_of([rounded(spread), rounded(10 ** (-2 * dice.random())), near_one], dice)


def _beside(dice):
    e = one_of([CRITICAL, math.nextafter(1, 0), _restitution(dice), _restitution(dice)], dice)
    e = _near(e, dice) if e < 0.9 else e
    beta = rounded(one_of([1.0, 3.5, 8.0, 1 + 7 * dice.random()], dice))
    with mp.workdps(60):
        xi = float(viscous_precision.damping_ratio(mp.mpf(e)))
    spread = rounded(10 ** (2 * dice.random() - 1))
    # Tangential critical damping, resonance, and elsewhere.
    zeta2 = _near(one_of([beta * xi * xi, beta, spread, spread], dice), dice)
    places = thresholds(beta, zeta2, e)
    x = _near(one_of([*places, rounded(places[2] * dice.random())], dice), dice)
    return x, beta, zeta2, e


def _around_switch(dice):
    """Neighbouring incidences of different courses, and more on both sides."""
    while True:
        _, beta, zeta2, e = _anywhere(dice)
        high = thresholds(beta, zeta2, e)[2]
        low, high = sorted(rounded(high * dice.random()) for _ in range(2))
        if course((low, beta, zeta2, e)) != course((high, beta, zeta2, e)):
            break
    low, high = bisected(low, high, lambda x: course((x, beta, zeta2, e)))
    sides = [low * (1 - d) for d in DISTANCES] + [high * (1 + d) for d in DISTANCES]
    return [(x, beta, zeta2, e) for x in (low, high, *sides)]


def _near(value, dice):
    beside = math.nextafter(value, 0), math.nextafter(value, math.inf)
    away = value * (1 + one_of([-1, 1], dice) * one_of(DISTANCES, dice))
    return one_of([value, *beside, away], dice)


def _in_box(point):
    x, beta, zeta2, e = point
    return 0 <= x <= 20 and 1 <= beta <= 8 and 0.1 <= zeta2 <= 10 and 0.01 <= e < 1


if __name__ == "__main__":
    table_files.write(sys.argv[1], tables())
