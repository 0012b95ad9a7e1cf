"""Scenes: a million impacts of 20 material pairs at tolerance 1e-3, on one core, and the memory.

OMP_NUM_THREADS=1 python tests/benchmarks/scene_speed.py [elastic share of the pairs]
"""

import resource
import sys
import time

import numpy as np
import pandas as pd

from planarimpact import scene

COUNT, PAIRS = 1_000_000, 20


def table(elastic, count=COUNT, seed=1):
    """Random solid spheres of 20 materials on a surface of another; every value is made up."""
    rng = np.random.default_rng(seed)
    pair = rng.integers(0, PAIRS, count)
    restitution = np.where(np.arange(PAIRS) < elastic * PAIRS, 1.0, rng.uniform(0.3, 0.99, PAIRS))
    return pd.DataFrame(
        {
            "radius [m]": rng.uniform(1e-3, 2e-2, count),
            "density [kg/m^3]": rng.uniform(1e3, 8e3, PAIRS)[pair],
            "young_modulus [Pa]": 10 ** rng.uniform(9, 11.5, PAIRS)[pair],
            "poisson_ratio": rng.uniform(0.2, 0.5, PAIRS)[pair],
            "other_young_modulus [Pa]": 10 ** rng.uniform(9, 11.5, PAIRS)[pair],
            "other_poisson_ratio": rng.uniform(0.2, 0.5, PAIRS)[pair],
            "friction": rng.uniform(0.05, 0.6, PAIRS)[pair],
            "restitution": restitution[pair],
            "velocity_x [m/s]": rng.normal(0, 2, count),
            "velocity_y [m/s]": rng.normal(0, 2, count),
            "velocity_z [m/s]": -rng.uniform(0.1, 5, count),
            "spin_x [rad/s]": rng.normal(0, 50, count),
            "spin_y [rad/s]": rng.normal(0, 50, count),
            "spin_z [rad/s]": rng.normal(0, 50, count),
        }
    )


def main():
    for elastic in map(float, sys.argv[1:] or ("0.5",)):
        impacts = table(elastic)
        solver = scene.Solver(1e-3)
        start = time.perf_counter()
        solver.solve(impacts)
        taken = time.perf_counter() - start
        peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 2**20
        print(f"elastic share {elastic:g}: {taken:.2f} s, {peak:.2f} GB at most in all")
        print(solver.explain())


if __name__ == "__main__":
    main()
