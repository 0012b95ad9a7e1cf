"""Scenes: a million impacts from file to file, and the memory, on one core.

OMP_NUM_THREADS=1 python tests/benchmarks/scene_speed.py

First each sphere has its own pair, so that no two have the same groups. Then there are 20 pairs of
materials and bodies that the table of spheres does not cover, half of them elastic:
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

COUNT = 1_000_000
# Number of pairs, m2/m1 (3.5 of solid spheres, 6 with a heavy core), and share of elastic pairs.
TABLES = {"own pairs": (COUNT, 3.5, 0.05), "20 pairs": (20, 6.0, 0.5)}


def impacts(pairs, mass_ratio, elastic):
    """Random spheres, each of one of the pairs of materials; every value is made up."""
    rng = np.random.default_rng(1)
    e = np.where(rng.random(pairs) < elastic, 1.0, rng.uniform(0.301, 1.0, pairs))
    of_pairs = {
        "density": rng.uniform(1e3, 8e3, pairs),
        "young_modulus [Pa]": 10 ** rng.uniform(9, 11.5, pairs),
        "poisson_ratio": rng.uniform(0.0, 0.5, pairs),
        "other_young_modulus [Pa]": 10 ** rng.uniform(9, 11.5, pairs),
        "other_poisson_ratio": rng.uniform(0.0, 0.5, pairs),
        "friction": rng.uniform(0.05, 0.6, pairs),
        "restitution": e,
        "loss": rng.choice(["viscous", "plastic"], pairs),
    }
    rows = pd.DataFrame(of_pairs).iloc[rng.permutation(COUNT) % pairs].reset_index(drop=True)
    radius = rng.uniform(1e-3, 2e-2, COUNT)
    columns = {f"spin_{axis} [rad/s]": rng.normal(0, 50, COUNT) for axis in "xyz"}
    columns |= {f"velocity_{axis} [m/s]": rng.normal(0, 2, COUNT) for axis in "xy"}
    columns |= {"velocity_z [m/s]": -rng.uniform(0.1, 5, COUNT), "radius [m]": radius}
    columns |= {"mass [kg]": rows.pop("density") * 4 * radius**3}
    return rows.assign(**columns, **{"gyration [m]": radius / (mass_ratio - 1) ** 0.5})


def measure(name, folder):
    """Print time and memory of one command; its file is made by another process."""
    source, target = (f"{folder}/{word}.csv" for word in ("in", "out"))
    if not os.fork():  # the memory of this process would count for those that it starts
        impacts(*TABLES[name]).to_csv(source, index=False)
        os._exit(0)
    os.wait()
    clock = time.perf_counter()
    process = subprocess.Popen([sys.executable, "-m", "planarimpact", "scene", source, target])
    _, status, used = os.wait4(process.pid, 0)
    if status:
        raise SystemExit("it failed")
    clock, memory = time.perf_counter() - clock, used.ru_maxrss / 1e6
    print(f"{name}: {clock:.1f} s ({used.ru_utime + used.ru_stime:.1f} s), {memory:.2f} GB")


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as folder:
        for name in TABLES:
            measure(name, folder)
