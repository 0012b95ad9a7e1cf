"""Write data/maw1976: the rebound curve by annuli, checked by the continuum solver.

    python -m tests.package_tables.annuli_tables data/maw1976

Takes some minutes. Refuses to write where the two methods differ by more than the sigma that the
source states.
"""

import csv
import sys
from pathlib import Path

import numpy as np

from planarimpact import continuum
from planarimpact.continuum import annuli

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


def table(stiffness_ratio, incidence=INCIDENCE):
    """Velocity at separation by annuli."""
    return checked(stiffness_ratio, incidence).velocity


def write(folder):
    """Write one CSV a stiffness ratio, all or none of them."""
    tables = {name: table(ratio) for name, ratio in STIFFNESS_RATIO.items()}
    for name, velocity in tables.items():
        with open(Path(folder) / f"{name}.csv", "w", newline="", encoding="utf-8") as file:
            rows = csv.writer(file, lineterminator="\n")
            rows.writerow(["incidence [mu v2(0)]", "velocity [mu v2(0)]"])
            # No "-0.00000".
            rows.writerows(
                [f"{x:.1f}", f"{w + 0.0:.5f}"]
                for x, w in zip(INCIDENCE, np.round(velocity, 5), strict=True)
            )


if __name__ == "__main__":
    write(sys.argv[1])
