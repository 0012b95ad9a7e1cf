"""Write data/maw1976: the rebound curve by annuli, checked by the continuum solver.

    python -m tests.package_tables.annuli_tables data/maw1976

Takes some minutes. Refuses to write where the two methods differ by more than the sigma that the
source states.
"""

import sys

import numpy as np

from planarimpact import continuum
from tests.reference_solutions import annuli, exact_tables, table_files

CIRCLES, STEPS = 128, 8192
INCIDENCE = np.round(np.linspace(0.0, 10.0, 101), 1)
MASS_RATIO = 3.5
STIFFNESS_RATIO = {"rebound_nu_0.3": 17 / 14, "rebound_nu_0.5": 1.5}
SIGMA = 1e-4


def checked(stiffness_ratio, incidence):
    """Rebounds by annuli, after `continuum` has agreed within SIGMA in every column."""
    groups = incidence, MASS_RATIO, stiffness_ratio
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


def tables():
    """Both tables, `{name: Table}`, all or none of them."""
    header, found = [exact_tables.INCIDENCE, exact_tables.VELOCITY], {}
    for name, ratio in STIFFNESS_RATIO.items():
        places = zip(INCIDENCE, checked(ratio, INCIDENCE).velocity, strict=True)
        found[name] = table_files.table(header, _row, places)
    return found


def _row(x, velocity):
    return [f"{x:.1f}", f"{table_files.digits(velocity, 5):.5f}"]


if __name__ == "__main__":
    table_files.write(sys.argv[1], tables())
