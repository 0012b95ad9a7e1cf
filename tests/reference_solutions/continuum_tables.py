"""Write data/elastic_continuum: curves of the elastic continuum by methods without its solver.

    python tests/reference/continuum_tables.py data/elastic_continuum

Rebound by annuli as in data/maw1976, checked in the same way by the solver; histories by a divided
row of springs, checked by itself with half the springs and steps, Hertz's normal motion in closed
form. Takes some minutes.
"""

import functools
import sys

import numpy as np
from mpmath import mp

from tests.reference_solutions import annuli_tables, spring_row, table_files
from tests.reference_solutions.exact_tables import (
    BETA,
    HERTZ_FORCES,
    INCIDENCE,
    RUBBER,
    VELOCITY,
    ZETA2,
)
from tests.reference_solutions.table_files import Table

INCIDENCES = (0.0, 0.2, 0.4, 0.6, 0.8, 1.0, 1.1, 1.2, 1.3, 1.4, 1.6, 1.8, 2.0, 2.3, 2.6, 3.0, 3.3)
INCIDENCES += (3.5, 3.7, 4.0, 4.3, 4.6, 5.0, 5.2, 5.4, 5.6, 5.7, 5.8, 6.0, 7.0, 8.0, 10.0, 12.0)
INCIDENCES += (14.0,)
# Of what data/model_errors measures errors against.
GRID = tuple(round(0.1 * k, 1) for k in range(81))
COURSES = (0.5, 1.0, 2.5, 4.5)  # incidences of the histories
INSTANTS = tuple(round(0.1 * k, 1) for k in range(1, 20))
SPRINGS, STEPS = 4000, 16000
# Own errors of the row of springs, estimated by its change from half the springs and steps.
ROW_ERROR = {"friction": 5e-5, "velocity": 1e-4, "stick_radius": 5e-4}


def tables():
    """All tables, `{name: Table}`."""
    return {
        "rebound_grid": _grid(),
        "fig5_rebound": _fig5(),
        "micro_slip_instants": _micro_slip(),
    }


def digits(number, places):
    """A number rounded to decimal places, without -0."""
    return round(float(number), places) + 0.0


# Rebound -------------------------------------------------------------------------------------


@functools.cache
def by_annuli(zeta2, incidences):
    """Rebounds by annuli; refused where the continuum solver differs by more than sigma."""
    return annuli_tables.checked(zeta2, np.array(incidences))


# Both tables of the paper's sphere come from one run: its time hardly depends on how many impacts.
STEEL = tuple(sorted({*INCIDENCES, *GRID}))


def _sphere_rebound(zeta2):
    """Incidences and rebounds by annuli of the sphere of steel or of rubber."""
    at = STEEL if zeta2 == ZETA2 else INCIDENCES
    return at, by_annuli(zeta2, at)


def _grid():
    rows = [functools.partial(_on_grid, x) for x in GRID]
    force, lost = "peak_friction [mu F2max]", "dissipation [mu^2 m2 v2(0)^2]"
    return Table([INCIDENCE, VELOCITY, force, lost], rows)


def _on_grid(x):
    at, found = _sphere_rebound(ZETA2)
    fields = found.velocity, found.peak_friction, found.dissipation
    return [x, *(digits(field[at.index(x)], 6) for field in fields)]


def _fig5():
    rows = []
    for curve, zeta2, spins in (("continuum", ZETA2, True), ("continuum, rubber", RUBBER, False)):
        rows += [functools.partial(_sphere, curve, x, zeta2, spins) for x in INCIDENCES]
    return Table(["curve", INCIDENCE, VELOCITY, "spin [mu v2(0)/R]"], rows)


def _sphere(curve, x, zeta2, spins):
    at, found = _sphere_rebound(zeta2)
    velocity = found.velocity[at.index(x)]
    spin = digits(-5 / 7 * (x - velocity), 5) if spins else None
    return [curve, x, digits(velocity, 5), spin]


# Histories -----------------------------------------------------------------------------------


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


def _micro_slip():
    rows = []
    for x in COURSES:
        rows += [functools.partial(_course, x, time) for time in INSTANTS]
    radii = ["contact_radius [a_max]", "stick_radius [a_max]"]
    return Table(["curve", "time [t_c]", *HERTZ_FORCES, VELOCITY, *radii], rows)


def _course(x, time):
    at = INSTANTS.index(time), COURSES.index(x)
    friction, velocity, stick = (float(part[at]) for part in by_springs())
    edge = hertz_radius(time)
    columns = [edge**3, digits(friction, 6), digits(velocity, 6), edge, digits(stick, 6)]
    return [f"continuum, x = {x:g}", time, *columns]


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
