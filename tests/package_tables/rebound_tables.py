"""Write rebound_grid and fig5_rebound of data/elastic_continuum: the package's annuli.

    python -m tests.package_tables.rebound_tables data/elastic_continuum

As in data/maw1976, for other contacts, and checked in the same way by the continuum solver. Takes
some minutes. Histories in the same folder are of tests/reference_solutions/continuum_tables.py.
"""

import functools
import sys
from itertools import product

import numpy as np

from tests.package_tables import annuli_tables
from tests.reference_solutions import table_files
from tests.reference_solutions.exact_tables import INCIDENCE, RUBBER, VELOCITY, ZETA2
from tests.reference_solutions.table_files import digits, table

INCIDENCES = (0.0, 0.2, 0.4, 0.6, 0.8, 1.0, 1.1, 1.2, 1.3, 1.4, 1.6, 1.8, 2.0, 2.3, 2.6, 3.0, 3.3)
INCIDENCES += (3.5, 3.7, 4.0, 4.3, 4.6, 5.0, 5.2, 5.4, 5.6, 5.7, 5.8, 6.0, 7.0, 8.0, 10.0, 12.0)
INCIDENCES += (14.0,)
# Of what data/model_errors measures errors against.
GRID = tuple(round(0.1 * k, 1) for k in range(81))


def tables():
    """Both tables, `{name: Table}`."""
    return {"rebound_grid": _grid(), "fig5_rebound": _fig5()}


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
    force, lost = "peak_friction [mu F2max]", "dissipation [mu^2 m2 v2(0)^2]"
    return table([INCIDENCE, VELOCITY, force, lost], _on_grid, [(x,) for x in GRID])


def _on_grid(x):
    at, found = _sphere_rebound(ZETA2)
    fields = found.velocity, found.peak_friction, found.dissipation
    return [x, *(digits(field[at.index(x)], 6) for field in fields)]


def _fig5():
    header = ["model", "variant", INCIDENCE, VELOCITY, "spin [mu v2(0)/R]"]
    return table(header, _sphere, product((None, "rubber"), INCIDENCES))


def _sphere(variant, x):
    at, found = _sphere_rebound(RUBBER if variant else ZETA2)
    velocity = found.velocity[at.index(x)]
    spin = None if variant else digits(-5 / 7 * (x - velocity), 5)
    return ["continuum", variant, x, digits(velocity, 5), spin]


if __name__ == "__main__":
    table_files.write(sys.argv[1], tables())
