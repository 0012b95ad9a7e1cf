"""Scenes: a million impacts of 20 material pairs at tolerance 1e-3, on one core, and the memory.

OMP_NUM_THREADS=1 python tests/benchmarks/scene_speed.py [loss=LOSS] [share | yield] ...

`share` is the elastic share of the pairs, by default 0.5. Without a loss, half of the other pairs
are viscous and half plastic. With `yield`, 20 000 impacts have a yield pressure in place of
restitution, so that no two of them that yield have the same. Times are those of the processor, and
in brackets those of the clock.
"""

import resource
import sys
import time

import numpy as np
import pandas as pd

from planarimpact import scene

COUNT, PAIRS = 1_000_000, 20
OF_THEIR_OWN = 20_000  # impacts that have each its own restitution


def table(elastic, loss=None, count=COUNT, seed=1):
    """Random solid spheres of 20 materials on a surface of another; every value is made up.

    `loss` is that of all pairs. By default half of them are viscous and half plastic.
    """
    rng = np.random.default_rng(seed)
    pair = rng.integers(0, PAIRS, count)
    restitution = np.where(np.arange(PAIRS) < elastic * PAIRS, 1.0, rng.uniform(0.3, 0.99, PAIRS))
    losses = np.array([loss] * PAIRS if loss else ["viscous", "plastic"] * (PAIRS // 2))
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
            "loss": losses[pair],
            "velocity_x [m/s]": rng.normal(0, 2, count),
            "velocity_y [m/s]": rng.normal(0, 2, count),
            "velocity_z [m/s]": -rng.uniform(0.1, 5, count),
            "spin_x [rad/s]": rng.normal(0, 50, count),
            "spin_y [rad/s]": rng.normal(0, 50, count),
            "spin_z [rad/s]": rng.normal(0, 50, count),
        }
    )


def of_yield_pressure(count=OF_THEIR_OWN):
    """The same materials; they yield at a pressure in place of having a restitution."""
    rows = table(0.0, count=count).drop(columns=["restitution", "loss"])
    return rows.assign(**{"yield_pressure [Pa]": rows["young_modulus [Pa]"] / 50})


def measure(name, impacts):
    solver = scene.Solver(1e-3)
    clock, start = time.perf_counter(), time.process_time()
    after = solver.solve(impacts)
    taken, clock = time.process_time() - start, time.perf_counter() - clock
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 2**20
    print(f"{name}: {taken:.2f} s ({clock:.2f} s), {peak:.2f} GB at most in all")
    low, high = after["restitution"].quantile([0.05, 0.95])
    print(f"restitution {low:.2f} to {high:.2f} (5 % to 95 %)")
    print(solver.explain(), flush=True)


def main():
    words = sys.argv[1:] or ["0.5"]
    loss = None
    for word in words:
        if word == "yield":
            measure("each impact its own restitution", of_yield_pressure())
        elif word.startswith("loss="):
            loss = word.removeprefix("loss=")
        else:
            name = loss or "viscous and plastic"
            measure(f"elastic share {word}, {name}", table(float(word), loss))


if __name__ == "__main__":
    main()
