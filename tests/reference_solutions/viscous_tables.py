"""Write the table of data/lumped_viscous: impacts of two viscous elements, with their energy.

python -m tests.reference_solutions.viscous_tables data/lumped_viscous

The impacts are those of the file, whose source.yaml says how they were chosen.
"""

import sys

import numpy as np

from tests.reference_solutions import table_files, viscous_precision

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


def row(point):
    """One impact: groups as float64, outputs with 20 digits."""
    answer = viscous_precision.rebound(*point)
    outputs = [getattr(answer, name) for name in OUTPUTS]
    energies = answer.tangential_viscous, answer.tangential_strain
    return [*point, *outputs, *energies, float(len(answer.events) - 1)]


def scales(x, beta, _, e):
    """What errors of the outputs count beside; shape (3, ...)."""
    # The solver follows forces with the rounding of the largest normal force, about 1e-16. So the
    # work of weaker friction is known to that times the way, x: 1e-15 x, in units of 1e-12.
    work = (np.minimum(np.divide(x, 2 * beta), 1 + e) + 1e-3) * x
    size = np.maximum(np.maximum(x, beta), 1)
    return np.stack([size, np.ones_like(size), np.maximum(work, 1e-300)])


def tables():
    """`{name: Table}`."""
    return table_files.impacts("lumped_viscous", HEADER, row)


if __name__ == "__main__":
    table_files.write(sys.argv[1], tables())
