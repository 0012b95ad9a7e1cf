"""The parameter study through snakemake: time on two cores, and the memory of its largest job.

python tests/benchmarks/study_speed.py [points in millions] [chunks] ...
"""

import resource
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).parents[2]
PARTS = ("workflow", "profiles", "src", "data")


def run(millions, chunks):
    """Solve, gather and draw two slices of so many points in all, in a copy of the project."""
    points = int((millions * 1e6 / 2) ** 0.5)
    grid = f"{{incidence: {{points: {points}}}, restitution: {{points: {points}}}}}"
    study = f"study={{chunks: {chunks}, grid: {grid}}}"
    with tempfile.TemporaryDirectory() as folder:
        for part in PARTS:
            shutil.copytree(ROOT / part, Path(folder) / part)
        shutil.copy(ROOT / "Snakefile", folder)
        command = [sys.executable, "-m", "snakemake", "--cores", "2", "study", "--config", study]
        start = time.perf_counter()
        subprocess.run(command, cwd=folder, check=True, capture_output=True)
        taken = time.perf_counter() - start
    # Of children that have ended, and theirs: the largest process of all runs so far.
    peak = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 2**20
    print(f"{2 * points**2} points in {chunks} chunks: {taken:.1f} s, at most {peak:.2f} GB a job")


def main():
    numbers = sys.argv[1:] or ("10", "4", "10", "16", "10", "64")
    for millions, chunks in zip(numbers[::2], numbers[1::2], strict=True):
        run(float(millions), int(chunks))


if __name__ == "__main__":
    main()
