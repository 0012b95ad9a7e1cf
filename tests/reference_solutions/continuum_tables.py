"""Write micro_slip_instants of data/elastic_continuum: histories of the elastic continuum.

    python -m tests.reference_solutions.continuum_tables data/elastic_continuum

By a divided row of springs, checked by itself with half the springs and steps, Hertz's normal
motion in closed form. Rebounds in the same folder are of tests/package_tables/annuli_tables.py.
"""

import functools
import sys
from itertools import product

import numpy as np
from mpmath import mp

from tests.reference_solutions import spring_row, table_files
from tests.reference_solutions.exact_tables import BETA, HERTZ_FORCES, VELOCITY, ZETA2
from tests.reference_solutions.table_files import digits

COURSES = (0.5, 1.0, 2.5, 4.5)  # incidences of the histories
INSTANTS = tuple(round(0.1 * k, 1) for k in range(1, 20))
SPRINGS, STEPS = 4000, 16000
# Own errors of the row of springs, estimated by its change from half the springs and steps.
ROW_ERROR = {"friction": 5e-5, "velocity": 1e-4, "stick_radius": 5e-4}


def tables():
    """The one table, `{name: Table}`."""
    radii = ["contact_radius [a_max]", "stick_radius [a_max]"]
    header = ["model", "x", "time [t_c]", *HERTZ_FORCES, VELOCITY, *radii]
    return {"micro_slip_instants": table_files.table(header, _course, product(COURSES, INSTANTS))}


@functools.cache
def by_springs():
    """Course of every contact, after half the springs and steps have agreed."""
    coarse, fine = (
        spring_row.course(COURSES, BETA, ZETA2, INSTANTS, SPRINGS // n, STEPS // n) for n in (2, 1)
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


if __name__ == "__main__":
    table_files.write(sys.argv[1], tables())
