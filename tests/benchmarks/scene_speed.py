"""Scenes: a million impacts from file to file, and the memory, on one core.

OMP_NUM_THREADS=1 python tests/benchmarks/scene_speed.py

First each sphere has its own pair, so that no two have the same groups. Then there are 20 pairs of
materials that the table of spheres does not cover, half of them elastic:
workflow/examples/cluster/README.md states 80 s and 0.75 GB. Times are those of the clock from the
start of the command to its end, and in brackets those of the processor. The memory is the largest
that was resident.
"""

import os
import subprocess
import sys
import tempfile
import time

import numpy as np
import pandas as pd

COUNT, PAIRS = 1_000_000, 20
MASS_RATIO = 6.0  # of spheres with a heavy core


def state(rng):
    """Velocities and spins."""
    columns = {f"spin_{axis} [rad/s]": rng.normal(0, 50, COUNT) for axis in "xyz"}
    columns |= {f"velocity_{axis} [m/s]": rng.normal(0, 2, COUNT) for axis in "xy"}
    return columns | {"velocity_z [m/s]": -rng.uniform(0.1, 5, COUNT)}


def own_pairs(rng):
    """Random solid spheres on a half-space; e is 0.3 to 1, and 1 for a twentieth of them."""
    e = np.where(rng.random(COUNT) < 0.05, 1.0, rng.uniform(0.301, 1.0, COUNT))
    return {
        "radius [m]": rng.uniform(1e-3, 2e-2, COUNT),
        "density [kg/m^3]": rng.uniform(1e3, 8e3, COUNT),
        "young_modulus [Pa]": 10 ** rng.uniform(9, 11.5, COUNT),
        "poisson_ratio": rng.uniform(0.0, 0.5, COUNT),
        "friction": rng.uniform(0.05, 0.6, COUNT),
        "restitution": e,
        "loss": rng.choice(["viscous", "plastic"], COUNT),
        **state(rng),
    }


def twenty_pairs(rng):
    """Random spheres of 20 materials on a surface of another; every value is made up."""
    pair = rng.integers(0, PAIRS, COUNT)
    restitution = np.where(np.arange(PAIRS) < PAIRS / 2, 1.0, rng.uniform(0.3, 0.99, PAIRS))
    radius = rng.uniform(1e-3, 2e-2, COUNT)
    return {
        "radius [m]": radius,
        "mass [kg]": rng.uniform(1e3, 8e3, PAIRS)[pair] * 4 * radius**3,
        "gyration [m]": radius / (MASS_RATIO - 1) ** 0.5,
        "young_modulus [Pa]": 10 ** rng.uniform(9, 11.5, PAIRS)[pair],
        "poisson_ratio": rng.uniform(0.2, 0.5, PAIRS)[pair],
        "other_young_modulus [Pa]": 10 ** rng.uniform(9, 11.5, PAIRS)[pair],
        "other_poisson_ratio": rng.uniform(0.2, 0.5, PAIRS)[pair],
        "friction": rng.uniform(0.05, 0.6, PAIRS)[pair],
        "restitution": restitution[pair],
        "loss": np.array(["viscous", "plastic"] * (PAIRS // 2))[pair],
        **state(rng),
    }


def measure(make, folder):
    """Print time and memory of one command; its file is made by another process."""
    source, target = (f"{folder}/{word}.csv" for word in ("in", "out"))
    if not os.fork():  # the memory of this process would count for those that it starts
        pd.DataFrame(make(np.random.default_rng(1))).to_csv(source, index=False)
        os._exit(0)
    os.wait()
    clock = time.perf_counter()
    process = subprocess.Popen([sys.executable, "-m", "planarimpact", "scene", source, target])
    _, status, used = os.wait4(process.pid, 0)
    if status:
        raise SystemExit("it failed")
    clock, memory = time.perf_counter() - clock, used.ru_maxrss / 1e6
    print(
        f"{make.__name__}: {clock:.1f} s ({used.ru_utime + used.ru_stime:.1f} s), {memory:.2f} GB"
    )


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as folder:
        for make in (own_pairs, twenty_pairs):
            measure(make, folder)
