"""Write data/maw1976, and rebound_grid and fig5_rebound of data/elastic_continuum: by annuli.

    python -m tests.package_tables.annuli_tables data

Takes some minutes. The continuum solver checks every rebound: the program refuses to write where
the two methods differ by more than the sigma that the sources state. Histories of the elastic
continuum are of tests/reference_solutions/continuum_tables.py.
"""

import functools
import sys
from itertools import product
from pathlib import Path

import numpy as np

from planarimpact import continuum
from tests.reference_solutions import annuli, table_files
from tests.reference_solutions.exact_tables import INCIDENCE, RUBBER, VELOCITY, ZETA2
from tests.reference_solutions.table_files import digits, table

CIRCLES, STEPS = 128, 8192
MASS_RATIO = 3.5
SIGMA = 1e-4
# Incidences of data/maw1976; of Fig. 5; and those at which data/model_errors measures errors.
MAW = tuple(round(0.1 * k, 1) for k in range(101))
FIG5 = (0.0, 0.2, 0.4, 0.6, 0.8, 1.0, 1.1, 1.2, 1.3, 1.4, 1.6, 1.8, 2.0, 2.3, 2.6, 3.0, 3.3, 3.5)
FIG5 += (3.7, 4.0, 4.3, 4.6, 5.0, 5.2, 5.4, 5.6, 5.7, 5.8, 6.0, 7.0, 8.0, 10.0, 12.0, 14.0)
GRID = MAW[:81]
# Both tables of the paper's sphere come from one run: its time hardly depends on how many impacts.
STEEL = tuple(sorted({*FIG5, *GRID}))


def tables():
    """All tables, `{folder: {name: Table}}`, all or none of them."""
    maw = {"rebound_nu_0.3": 17 / 14, "rebound_nu_0.5": 1.5}
    force, lost = "peak_friction [mu F2max]", "dissipation [mu^2 m2 v2(0)^2]"
    spheres = ["model", "variant", INCIDENCE, VELOCITY, "spin [mu v2(0)/R]"]
    return {
        "maw1976": {
            name: table([INCIDENCE, VELOCITY], _maw, product([ratio], MAW))
            for name, ratio in maw.items()
        },
        "elastic_continuum": {
            "rebound_grid": table(
                [INCIDENCE, VELOCITY, force, lost], _on_grid, [(x,) for x in GRID]
            ),
            "fig5_rebound": table(spheres, _sphere, product((None, "rubber"), FIG5)),
        },
    }


@functools.cache
def checked(stiffness_ratio, incidences):
    """Rebounds by annuli, after `continuum` has agreed within SIGMA in every column."""
    groups = np.array(incidences), MASS_RATIO, stiffness_ratio
    found = annuli.rebound(*groups, circles=CIRCLES, steps=STEPS)
    check = continuum.rebound(*groups)
    for name in ("velocity", "peak_friction", "dissipation"):
        difference = float(np.max(np.abs(getattr(found, name) - getattr(check, name))))
        if difference > SIGMA:
            raise SystemExit(
                f"{name}: the two methods differ by {difference:.1e}, more than {SIGMA:g}"
            )
        print(f"zeta^2 = {stiffness_ratio:.6g}, {name}: they differ by {difference:.1e} at most")
    return found


def _maw(stiffness_ratio, x):
    velocity = checked(stiffness_ratio, MAW).velocity[MAW.index(x)]
    return [f"{x:.1f}", f"{digits(velocity, 5):.5f}"]


def _on_grid(x):
    found = checked(ZETA2, STEEL)
    fields = found.velocity, found.peak_friction, found.dissipation
    return [x, *(digits(field[STEEL.index(x)], 6) for field in fields)]


def _sphere(variant, x):
    ratio, at = (RUBBER, FIG5) if variant else (ZETA2, STEEL)
    velocity = checked(ratio, at).velocity[at.index(x)]
    spin = None if variant else digits(-5 / 7 * (x - velocity), 5)
    return ["continuum", variant, x, digits(velocity, 5), spin]


if __name__ == "__main__":
    for folder, found in tables().items():
        table_files.write(Path(sys.argv[1]) / folder, found)
