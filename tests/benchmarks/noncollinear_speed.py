"""Time of one non-collinear impact in a batch of 100 000, on one core.

    python tests/benchmarks/noncollinear_speed.py

Prints microseconds an impact, and the ratio to one of the collinear model in the same run.
"""

import time
from functools import partial

import numpy as np

from planarimpact import lumped, noncollinear
from planarimpact.noncollinear import InverseMass

paper_rebound = partial(noncollinear.rebound, loss="hysteretic")

COUNT = 100_000
REPEATS = 5


def microseconds(work):
    """Median time of `work`, an impact of the batch."""
    work()
    times = []
    for _ in range(REPEATS):
        start = time.perf_counter()
        work()
        times.append(time.perf_counter() - start)
    return float(np.median(times)) / COUNT * 1e6


def main():
    rng = np.random.default_rng(1)
    tilt = np.radians(rng.uniform(-85, 85, COUNT))
    rod = noncollinear.inverse_mass(1.0, 12**-0.5, np.sin(tilt) / 2, np.cos(tilt) / 2)
    ratio, share = rng.uniform(0.3, 8, COUNT), rng.uniform(-0.99, 0.99, COUNT)
    any_body = InverseMass(ratio, share * np.sqrt(ratio), np.ones(COUNT))
    friction, e = 10 ** rng.uniform(-2, 0.7, COUNT), rng.uniform(0.01, 1, COUNT)
    zeta2 = 10 ** rng.uniform(-1, 1, COUNT)
    incidence = rng.uniform(-8, 8, COUNT)
    unit = microseconds(lambda: lumped.rebound(np.abs(incidence), 3.5, 1.21, e))
    print(f"{unit:7.3f} us         collinear, solid sphere")
    cases = {
        "slender rod at any tilt, mu = 0.5": lambda: paper_rebound(
            0.5 * incidence, 1.0, rod, 0.5, 0.9
        ),
        "slender rod at any tilt, mu = 1.6, jams": lambda: paper_rebound(
            1.6 * incidence, 1.0, rod, 1.6, 0.9
        ),
        "any body: mass ratio, coupling, mu, e and zeta^2 mixed": lambda: paper_rebound(
            friction * incidence, 1.0, any_body, friction, e, zeta2
        ),
    }
    for name, work in cases.items():
        found = microseconds(work)
        print(f"{found:7.3f} us {found / unit:5.1f} x  {name}")


if __name__ == "__main__":
    main()
