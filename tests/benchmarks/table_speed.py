"""Scenes from file to file: a million impacts in CSV and Parquet.

OMP_NUM_THREADS=1 python tests/benchmarks/table_speed.py [rows]

Three quarters of the impacts slide throughout, the others are of one elastic pair, so that the
solver has little to do. Times are those of the clock from the start of the command to its end, and
in brackets those of the processor. The memory is the largest that was resident.
"""

import multiprocessing
import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np
import pandas as pd

from planarimpact import scene

PAIR = {
    "density [kg/m^3]": 7800.0,
    "young_modulus [Pa]": 207e9,
    "poisson_ratio": 0.3,
    "other_young_modulus [Pa]": 70e9,
    "other_poisson_ratio": 0.33,
    "friction": 0.1,
    "restitution": 1.0,
    "loss": "viscous",
}
COUNT = 1_000_000


def table(count):
    """Random spheres on a surface, of one pair of materials."""
    rng = np.random.default_rng(1)
    rows = {"radius [m]": rng.uniform(1e-3, 2e-2, count)} | PAIR
    for axis in "xyz":
        rows[f"spin_{axis} [rad/s]"] = rng.normal(0, 50, count)
        rows[f"velocity_{axis} [m/s]"] = rng.normal(0, 2, count)
    return pd.DataFrame(rows | {"velocity_z [m/s]": -rng.uniform(0.1, 5, count)})


def written(folder, count):
    """Seconds of a processor that the solver alone takes for the table that this writes."""
    impacts = table(count)
    start = time.process_time()
    scene.solve(impacts)
    taken = time.process_time() - start
    impacts.to_csv(f"{folder}/in.csv", index=False)
    impacts.to_parquet(f"{folder}/in.parquet", index=False)
    return taken


def measure(source, target):
    """Seconds of the clock and of the processor, and GB, of a scene from file to file."""
    clock = time.perf_counter()
    process = subprocess.Popen([sys.executable, "-m", "planarimpact", "scene", source, target])
    _, status, used = os.wait4(process.pid, 0)
    if status:
        raise SystemExit("it failed")
    return time.perf_counter() - clock, used.ru_utime + used.ru_stime, used.ru_maxrss / 1e6


def main():
    count = int(sys.argv[1]) if len(sys.argv) > 1 else COUNT
    # In a process of its own, as the memory of this one would count for those that it starts.
    with tempfile.TemporaryDirectory() as folder, multiprocessing.Pool(1) as pool:
        taken = pool.apply(written, (folder, count))
        print(f"{count} rows; the solver alone: {taken:.2f} s of a processor", flush=True)
        for name, ending in {"CSV": "csv", "Parquet": "parquet"}.items():
            source, target = (f"{folder}/{word}.{ending}" for word in ("in", "out"))
            clock, taken, memory = measure(source, target)
            print(f"{name} to {name}: {clock:.1f} s ({taken:.1f} s), {memory:.2f} GB", flush=True)
            sizes = (Path(path).stat().st_size / 1e6 for path in (source, target))
            print("{}: {:.0f} MB in, {:.0f} MB out".format(name, *sizes))


if __name__ == "__main__":
    main()
