"""Write micro_slip_instants of data/elastic_continuum: histories of the elastic continuum.

    python -m tests.reference_solutions.continuum_tables data/elastic_continuum

By a divided row of springs in small equal steps of time: the method of dimensionality reduction as
published (Popov & Hess), without any of the package's code. Springs at given radii have each their
own deflection, cut back to their own friction at every step. Hertz's normal motion is a closed
form; the tangential one is a leapfrog. Half the springs and steps must agree. Rebounds in the same
folder are of tests/package_tables/annuli_tables.py.
"""

import functools
import math
import sys
from itertools import product
from typing import NamedTuple

import numpy as np
from mpmath import mp
from scipy.special import betaincinv

from tests.reference_solutions import table_files
from tests.reference_solutions.exact_tables import BETA, HERTZ_FORCES, VELOCITY, ZETA2
from tests.reference_solutions.table_files import digits

COURSES = (0.5, 1.0, 2.5, 4.5)  # incidences of the histories
INSTANTS = tuple(round(0.1 * k, 1) for k in range(1, 20))
SPRINGS, STEPS = 4000, 16000
# Own errors of the row of springs, estimated by its change from half the springs and steps.
ROW_ERROR = {"friction": 5e-5, "velocity": 1e-4, "stick_radius": 5e-4}
# From first contact to greatest compression, in d_max/v2(0): (2/5) B(2/5, 1/2).
TO_MAXIMUM = 0.4 * math.gamma(0.4) * math.gamma(0.5) / math.gamma(0.9)


def tables():
    """The one table, `{name: Table}`."""
    radii = ["contact_radius [a_max]", "stick_radius [a_max]"]
    header = ["model", "x", "time [t_c]", *HERTZ_FORCES, VELOCITY, *radii]
    return {"micro_slip_instants": table_files.table(header, _course, product(COURSES, INSTANTS))}


@functools.cache
def by_springs():
    """Course of every contact, after half the springs and steps have agreed."""
    coarse, fine = (
        course(COURSES, BETA, ZETA2, INSTANTS, SPRINGS // n, STEPS // n) for n in (2, 1)
    )
    for name, most in ROW_ERROR.items():
        change = float(np.max(np.abs(getattr(fine, name) - getattr(coarse, name))))
        if change > most:
            raise SystemExit(f"{name} changes by {change:.1e}, more than {most:g}")
    return fine


def _course(x, time):
    at = INSTANTS.index(time), COURSES.index(x)
    friction, velocity, stick = (float(part[at]) for part in by_springs())
    edge = hertz_radius(time)
    columns = [edge**3, digits(friction, 6), digits(velocity, 6), edge, digits(stick, 6)]
    return ["continuum", x, time, *columns]


def hertz_radius(time):
    """Radius of contact in a_max: t = I(a^5; 2/5, 1/2), the incomplete beta function, by mpmath."""
    share = mp.mpf(min(time, 2 - time))
    whole = mp.beta(mp.mpf(2) / 5, mp.mpf(1) / 2)

    def ahead(radius):
        passed = mp.betainc(mp.mpf(2) / 5, mp.mpf(1) / 2, 0, radius**5) / whole
        return passed - share

    if share == 1:
        return mp.one
    return mp.findroot(ahead, (mp.sqrt(share) / 2, mp.mpf("0.9999999")), solver="anderson")


class Course(NamedTuple):
    """Arrays of shape (instants, impacts): friction in mu F2max, velocity in mu v2(0)."""

    friction: np.ndarray
    velocity: np.ndarray
    stick_radius: np.ndarray  # in a_max


def contact_radius(time):
    """Radius of a Hertz contact in a_max at a time in t_c, by the inverse incomplete beta function.

    With y = d^(5/2) = a^5 the energy v^2 = 1 - y gives t = (2/5) B(2/5, 1/2; y).
    """
    return betaincinv(0.4, 0.5, np.minimum(time, 2 - np.asarray(time))) ** 0.2


def course(x, beta, zeta2, instants, springs, steps):
    """Friction, velocity and radius of stick at some ascending instants, in t_c.

    Springs are counted over the largest contact, steps over the whole of it.
    """
    wanted = np.round(np.asarray(instants) * steps / 2).astype(int)
    if not np.allclose(wanted * 2 / steps, instants, rtol=0, atol=1e-12):
        raise ValueError("an instant is not that of a step")
    radius = (np.arange(springs) + 0.5) / springs
    area = radius**2
    depth = contact_radius(np.arange(steps + 1) * 2 / steps) ** 2
    step = 2 * TO_MAXIMUM / steps
    velocity = np.asarray(x, float).copy()  # half a step ahead; no force yet slows it
    deflection = np.zeros((len(velocity), springs))
    found = []
    for n in range(1, wanted[-1] + 1):
        limit = np.maximum(depth[n] - area, 0.0)
        # Deflections in zeta^2 mu d_max, so that the largest normal density is 1 in the middle.
        deflection += (step / zeta2 * velocity)[:, None]
        if n in wanted:
            slips = (np.abs(deflection) > limit) & (limit > 0)
        np.clip(deflection, -limit, limit, out=deflection)
        friction = 1.5 * deflection.mean(axis=1)  # 1 where all springs carry their most at d = 1
        kick = beta * 1.25 * step / 2 * friction  # F2max = (5/4) m2 v2(0)^2/d_max
        if n in wanted:
            edge = math.sqrt(depth[n])
            inside = np.where(slips.any(axis=1), radius[slips.argmax(axis=1)], edge)
            inside = np.where(inside == radius[0], 0.0, inside)  # gross slip
            found.append((friction, velocity - kick, inside))
        velocity = velocity - 2 * kick
    return Course(*(np.array(part) for part in zip(*found, strict=True)))


if __name__ == "__main__":
    table_files.write(sys.argv[1], tables())
