"""Scenes from file to file: a million impacts in CSV and Parquet, by one worker and by two.

OMP_NUM_THREADS=1 python tests/benchmarks/table_speed.py [rows]

Three quarters of the impacts slide throughout, the others are of one elastic pair, so that the
solver has little to do. Times are those of the clock from the start of the command to its end, and
in brackets those of all its processors. The memory is the largest sum of the resident memory of all
its processes, which counts what they share in each.
"""

import resource
import subprocess
import sys
import tempfile
import time
from contextlib import suppress
from pathlib import Path

import numpy as np
import pandas as pd
import psutil

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


def resident(process):
    """Bytes of a process and its children; 0 for those that have just ended."""
    total = 0
    for one in [process, *process.children()]:
        with suppress(psutil.NoSuchProcess):
            total += one.memory_info().rss
    return total


def measure(source, target, workers):
    """Seconds of the clock and of the processors, and GB, of a scene from file to file."""
    command = [sys.executable, "-m", "planarimpact", "scene", source, target]
    before, clock, most = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter(), 0
    process = psutil.Popen([*command, "--workers", str(workers)], stdout=subprocess.DEVNULL)
    while process.poll() is None:
        try:
            most = max(most, resident(process))
        except psutil.NoSuchProcess:
            break
        time.sleep(0.02)
    if process.wait():
        raise SystemExit(process.returncode)
    clock = time.perf_counter() - clock
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    taken = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return clock, taken, most / 1e9


def main():
    count = int(sys.argv[1]) if len(sys.argv) > 1 else COUNT
    impacts = table(count)
    start = time.process_time()
    scene.solve(impacts)
    print(f"{count} rows; the solver alone: {time.process_time() - start:.2f} s of a processor")
    with tempfile.TemporaryDirectory() as folder:
        tables = {"CSV": "csv", "Parquet": "parquet"}
        impacts.to_csv(f"{folder}/in.csv", index=False)
        impacts.to_parquet(f"{folder}/in.parquet", index=False)
        del impacts
        for name, ending in tables.items():
            source, target = (f"{folder}/{word}.{ending}" for word in ("in", "out"))
            for workers in (1, 2):
                clock, taken, memory = measure(source, target, workers)
                print(
                    f"{name} to {name}, {workers} worker{'s' * (workers > 1)}: {clock:.1f} s "
                    f"({taken:.1f} s), {memory:.2f} GB",
                    flush=True,
                )
            sizes = (Path(path).stat().st_size / 1e6 for path in (source, target))
            print("{}: {:.0f} MB in, {:.0f} MB out".format(name, *sizes))


if __name__ == "__main__":
    main()
