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
# A row has normal, velocity, spin, stiffness ratio, restitution and loss.
C = """\
#include <stdio.h>
#include <time.h>
#include "balls.h"
static double x[COUNT][12];
int main(void)
{
    FILE *file = fopen("collisions", "rb");
    if (!file || fread(x, sizeof *x, COUNT, file) != COUNT)
        return 1;
    struct balls_body ball = balls_solid_sphere(0.01, 0.01);
    double best = 1e9, sum = 0;
    for (int repeat = 0; repeat < REPEATS; ++repeat) {
        clock_t start = clock();
        sum = 0;
        for (int i = 0; i < COUNT; ++i) {
            const double *a = x[i];
            struct balls_pair pair = {0.3, a[9], a[10], 0, 0, 0, (int)a[11]};
            struct balls_vector n = {a[0], a[1], a[2]}, v = {a[3], a[4], a[5]};
            struct balls_vector w = {a[6], a[7], a[8]};
            struct balls_collision hit = balls_bounce(pair, n, ball, v, w);
            sum += hit.velocity.x + hit.spin.y;
        }
        double taken = (double)(clock() - start) / CLOCKS_PER_SEC;
        best = taken < best ? taken : best;
    }
    printf("%.17g %.17g\\n", best, sum);
    return 0;
}
"""
JAVASCRIPT = """\
import { readFileSync } from "node:fs";
import { bounce, solid_sphere } from "./balls.mjs";
const bytes = readFileSync("collisions"), ball = solid_sphere(0.01, 0.01), impacts = [];
const x = new Float64Array(bytes.buffer, bytes.byteOffset, COUNT * 12);
for (let i = 0; i < x.length; i += 12) {
    const [stiffness_ratio, restitution, loss] = x.subarray(i + 9, i + 12);
    impacts.push([
        { friction: 0.3, stiffness_ratio, restitution, loss },
        ...[0, 3, 6].map((at) => Array.from(x.subarray(i + at, i + at + 3))),
    ]);
}
let best = 1e9, sum = 0;
for (let repeat = 0; repeat < REPEATS; repeat += 1) {
    const start = process.cpuUsage();
    sum = 0;
    for (const [pair, n, v, w] of impacts) {
        const hit = bounce(pair, n, ball, v, w);
        sum += hit.velocity[0] + hit.spin[1];
    }
    const taken = process.cpuUsage(start);
    best = Math.min(best, (taken.user + taken.system) / 1e6);
}
console.log(best, sum);
"""
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
    for file, text in (("speed.c", C), ("speed.mjs", JAVASCRIPT)):
        text = text.replace("COUNT", str(COUNT)).replace("REPEATS", str(REPEATS))
        (folder / file).write_text(text)
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
