"""Makes the table in src/planarimpact/scene/gaps.py: cheaper models against the continuum, e = 1.

    python -m tests.package_tables.gap_tables

prints it. At e = 1 all of them depend on x/zeta^2 and chi = beta/(2 zeta^2) alone, velocities in
zeta^2.
"""

import functools

import numpy as np

from planarimpact import continuum, lumped, rigid
from planarimpact.scene import gaps

SAMPLES = 400
TOLERANCE = 1e-4


def largest(model, chi):
    """Largest gap of velocity in zeta^2, and of peak friction, over all that stick at some time."""
    x, exact = _exact(chi)
    found = model.rebound(x, 2 * chi, 1.0)
    gap = [np.max(np.abs(a - b)) for a, b in zip(found[:2], exact[:2], strict=True)]
    return np.ceil(np.array(gap) * 1e3) / 1e3


@functools.cache
def _exact(chi):
    limit = float(lumped.slip_throughout_limit(2 * chi, 1.0))
    x = limit * np.linspace(0, 1, SAMPLES) ** 2
    return x, continuum.rebound(x, 2 * chi, 1.0, tolerance=TOLERANCE)


if __name__ == "__main__":
    for name, model in (("lumped", lumped), ("rigid", rigid)):
        velocity, peak = zip(*(largest(model, chi) for chi in gaps.CHI), strict=True)
        for row in (velocity, peak):
            print(name, ", ".join(f"{value:.3f}" for value in row))
