"""Scenes: a million impacts on one core, and the memory.

OMP_NUM_THREADS=1 python tests/benchmarks/scene_speed.py [WORD] ...

`restitution`, `relaxation_time` or `yield_pressure` (by default all three): solid spheres, each
impact with its own Poisson's ratio and its own value of that column, so that no two have the same
groups. The tolerance is 0.005, so that the table of spheres takes them all; how much of the time is
its own is told too.

A number from 0 to 1: a thousand spheres with a heavy core, of 20 material pairs, which the table
does not cover, at the tolerance 0.001. The number is the elastic share of the pairs. Half of the
other pairs are viscous and half plastic, or all are of one loss after the word `loss=LOSS`.

Times are those of the processor, and in brackets those of the clock.
"""

import resource
import sys
import time

import numpy as np
import pandas as pd

from planarimpact import bodies, scene, spheres

COUNT, SOLVED, PAIRS = 1_000_000, 1000, 20
# Of the spheres with a heavy core.
MASS_RATIO = 6.0
OWN = "restitution", "relaxation_time", "yield_pressure"


def state(rng, count):
    """Velocities and spins."""
    return {
        "velocity_x [m/s]": rng.normal(0, 2, count),
        "velocity_y [m/s]": rng.normal(0, 2, count),
        "velocity_z [m/s]": -rng.uniform(0.1, 5, count),
        "spin_x [rad/s]": rng.normal(0, 50, count),
        "spin_y [rad/s]": rng.normal(0, 50, count),
        "spin_z [rad/s]": rng.normal(0, 50, count),
    }


def own(column, count=COUNT, seed=1):
    """Random solid spheres on a half-space; e is 0.3 to 1, and 1 for a twentieth of them."""
    rng = np.random.default_rng(seed)
    rows = {
        "radius [m]": rng.uniform(1e-3, 2e-2, count),
        "density [kg/m^3]": rng.uniform(1e3, 8e3, count),
        "young_modulus [Pa]": 10 ** rng.uniform(9, 11.5, count),
        "poisson_ratio": rng.uniform(0.0, 0.5, count),
        "friction": rng.uniform(0.05, 0.6, count),
        **state(rng, count),
    }
    e = np.where(rng.random(count) < 0.05, 1.0, rng.uniform(0.301, 1.0, count))
    radius, speed = rows["radius [m]"], -rows["velocity_z [m/s]"]
    modulus = bodies.effective_modulus(
        bodies.Material(rows["young_modulus [Pa]"], rows["poisson_ratio"])
    )
    contact = speed, bodies.solid_sphere(radius, rows["density [kg/m^3]"]).mass, modulus, radius
    if column == "relaxation_time":
        rows["relaxation_time [s]"] = bodies.relaxation_time(e, *contact)
    elif column == "yield_pressure":
        rows["yield_pressure [Pa]"] = bodies.yield_pressure(e, *contact)
    else:
        rows["restitution"], rows["loss"] = e, rng.choice(["viscous", "plastic"], count)
    return pd.DataFrame(rows)


def of_pairs(elastic, loss=None, count=SOLVED, seed=1):
    """Random spheres of 20 materials on a surface of another; every value is made up."""
    rng = np.random.default_rng(seed)
    pair = rng.integers(0, PAIRS, count)
    restitution = np.where(np.arange(PAIRS) < elastic * PAIRS, 1.0, rng.uniform(0.3, 0.99, PAIRS))
    losses = np.array([loss] * PAIRS if loss else ["viscous", "plastic"] * (PAIRS // 2))
    radius = rng.uniform(1e-3, 2e-2, count)
    return pd.DataFrame(
        {
            "radius [m]": radius,
            "mass [kg]": rng.uniform(1e3, 8e3, PAIRS)[pair] * 4 * radius**3,
            "gyration [m]": radius / (MASS_RATIO - 1) ** 0.5,
            "young_modulus [Pa]": 10 ** rng.uniform(9, 11.5, PAIRS)[pair],
            "poisson_ratio": rng.uniform(0.2, 0.5, PAIRS)[pair],
            "other_young_modulus [Pa]": 10 ** rng.uniform(9, 11.5, PAIRS)[pair],
            "other_poisson_ratio": rng.uniform(0.2, 0.5, PAIRS)[pair],
            "friction": rng.uniform(0.05, 0.6, PAIRS)[pair],
            "restitution": restitution[pair],
            "loss": losses[pair],
            **state(rng, count),
        }
    )


class Timed:
    """The table of spheres, with the time that it has taken."""

    def __init__(self, rebound):
        self.rebound, self.taken = rebound, 0.0

    def __call__(self, *groups, **loss):
        start = time.process_time()
        found = self.rebound(*groups, **loss)
        self.taken += time.process_time() - start
        return found


def measure(name, impacts, tolerance):
    solver = scene.Solver(tolerance)
    spheres.rebound = table = Timed(spheres.rebound)
    clock, start = time.perf_counter(), time.process_time()
    after = solver.solve(impacts)
    taken, clock = time.process_time() - start, time.perf_counter() - clock
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 2**20
    spheres.rebound = table.rebound
    print(f"{name}: {taken:.2f} s ({clock:.2f} s), {peak:.2f} GB at most in all")
    print(f"of which the table of spheres takes {table.taken:.2f} s")
    low, high = after["restitution"].quantile([0.05, 0.95])
    print(f"restitution {low:.2f} to {high:.2f} (5 % to 95 %)")
    print(solver.explain(), flush=True)


def main():
    loss = None
    for word in sys.argv[1:] or OWN:
        if word in OWN:
            measure(f"each impact its own {word}", own(word), 5e-3)
        elif word.startswith("loss="):
            loss = word.removeprefix("loss=")
        else:
            name = loss or "viscous and plastic"
            measure(f"elastic share {word}, {name}", of_pairs(float(word), loss), 1e-3)


if __name__ == "__main__":
    main()
