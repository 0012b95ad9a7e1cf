"""A bounce in C and JavaScript: time of an impact, on one core.

    OMP_NUM_THREADS=1 python tests/benchmarks/export_speed.py

A loop over random impacts, best of several: each has its own pair, and none slides throughout,
which would be quicker. The sums of all answers must be alike; they also keep the compiler from
leaving the loop out. The time is that of the processor. C is left out where no compiler is,
JavaScript where node is missing.
"""

import shutil
import subprocess
import tempfile
from pathlib import Path

import numpy as np

from planarimpact import export

COUNT, REPEATS = 100_000, 7
COMPILERS = [name for name in ("cc", "gcc", "clang") if shutil.which(name)][:1]


def impacts():
    """Vectors in: none of the contacts slides throughout."""
    random = np.random.default_rng(1)
    normal, sideways = random.normal(size=(2, COUNT, 3))
    normal /= np.linalg.norm(normal, axis=1)[:, None]
    sideways = np.cross(sideways, normal)
    sideways /= np.linalg.norm(sideways, axis=1)[:, None]
    zeta2, e = random.uniform(1, 1.5, COUNT), random.uniform(0.3, 1, COUNT)
    x = random.uniform(0, 1, COUNT) * (3.5 + e * (3.5 - zeta2))
    velocity = 0.3 * x[:, None] * sideways - normal
    spin = 20 * random.normal(size=(COUNT, 1)) * normal  # does not move the contact point
    return np.column_stack([normal, velocity, spin, zeta2, e, 1 + np.arange(COUNT) % 2])


def main(folder):
    export.write_spheres(folder / "balls.h", "c")
    export.write_spheres(folder / "balls.mjs", "js")
    impacts().tofile(folder / "collisions")
    for ending in ("c", "mjs"):
        text = Path(__file__).with_suffix(f".{ending}").read_text(encoding="utf-8")
        text = text.replace("COUNT", str(COUNT)).replace("REPEATS", str(REPEATS))
        (folder / f"speed.{ending}").write_text(text)
    commands = {"node": ["node", "speed.mjs"]} if shutil.which("node") else {}
    for compiler in COMPILERS:
        compiled = [compiler, "-std=c99", "-O2", "speed.c", "-o", "speed", "-lm"]
        subprocess.run(compiled, cwd=folder, check=True)
        commands[f"{compiler} -O2"] = ["./speed"]
    for language, command in commands.items():
        done = subprocess.run(command, cwd=folder, check=True, capture_output=True, text=True)
        best, total = map(float, done.stdout.split())
        print(f"{language}: {1e6 * best / COUNT:.2f} us a bounce; sum {total:.6f}")


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as name:
        main(Path(name))
