"""The table of spheres in C and JavaScript: time of an impact, on one core.

    OMP_NUM_THREADS=1 python tests/benchmarks/export_speed.py

A loop over a million random impacts, best of several, beside Python's batch in the same run. None
of them slides throughout: that would be quicker. They all have their own restitution, ratio of
stiffnesses, mass ratio and loss. The time is that of the processor. The sums
of all answers must be Python's; they also keep the compiler from leaving the loop out. C is left
out where no compiler is, JavaScript where node is missing.
"""

import math
import shutil
import subprocess
import tempfile
import time
from pathlib import Path

import numpy as np

from planarimpact import export, spheres

COUNT, REPEATS = 1_000_000, 21
C = """\
#include <stdio.h>
#include <stdlib.h>
#include <time.h>
#include "balls.h"
#define IMPACT x[i][0], x[i][1], x[i][2], x[i][3], (int)x[i][4]
static double x[COUNT][5];
int main(void)
{
    FILE *file = fopen("x", "rb");
    if (!file || fread(x, sizeof *x, COUNT, file) != COUNT)
        return 1;
    double best[2] = {1e9, 1e9}, sum[2];
    for (int repeat = 0; repeat < REPEATS; ++repeat) {
        for (int all = 0; all < 2; ++all) {
            double total = 0;
            clock_t start = clock();
            for (int i = 0; i < COUNT; ++i) {
                if (all) {
                    struct balls_result found = balls_rebound(IMPACT);
                    total += found.velocity + found.peak_friction + found.dissipation
                        + found.regime;
                } else {
                    total += balls_velocity(IMPACT);
                }
            }
            double taken = (double)(clock() - start) / CLOCKS_PER_SEC;
            best[all] = taken < best[all] ? taken : best[all];
            sum[all] = total;
        }
    }
    printf("%.17g %.17g %.17g %.17g\\n", best[0], best[1], sum[0], sum[1]);
    return 0;
}
"""
JAVASCRIPT = """\
import { readFileSync } from "node:fs";
import { rebound, velocity } from "./balls.mjs";
const bytes = readFileSync("x"), best = [1e9, 1e9], sum = [0, 0];
const x = new Float64Array(bytes.buffer, bytes.byteOffset, COUNT * 5);
const loops = [
    () => {
        let total = 0;
        for (let i = 0; i < x.length; i += 5)
            total += velocity(x[i], x[i + 1], x[i + 2], x[i + 3], x[i + 4]);
        return total;
    },
    () => {
        let total = 0;
        for (let i = 0; i < x.length; i += 5) {
            const found = rebound(x[i], x[i + 1], x[i + 2], x[i + 3], x[i + 4]);
            total += found.velocity + found.peak_friction + found.dissipation + found.regime;
        }
        return total;
    },
];
for (let repeat = 0; repeat < REPEATS; repeat += 1) {
    loops.forEach((loop, all) => {
        const start = process.cpuUsage();
        sum[all] = loop();
        const taken = process.cpuUsage(start);
        best[all] = Math.min(best[all], (taken.user + taken.system) / 1e6);
    });
}
console.log(...best, ...sum);
"""
# Collisions: a row has normal, velocity, spin, stiffness ratio, restitution and loss.
COLLISIONS_C = """\
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
    double best[3] = {1e9, 1e9, 1e9}, sum[3];
    for (int repeat = 0; repeat < REPEATS; ++repeat) {
        for (int what = 0; what < 3; ++what) {
            double total = 0;
            clock_t start = clock();
            for (int i = 0; i < COUNT; ++i) {
                const double *a = x[i];
                struct balls_pair pair = {0.3, a[9], a[10], 0, 0, 0, (int)a[11]};
                struct balls_vector n = {a[0], a[1], a[2]}, v = {a[3], a[4], a[5]};
                struct balls_vector w = {a[6], a[7], a[8]}, zero = {0, 0, 0};
                if (what == 2) {
                    total += balls_model_form(pair, n, ball, v, w, ball, zero, zero);
                } else {
                    struct balls_collision hit = what
                        ? balls_collide(pair, n, ball, v, w, ball, zero, zero)
                        : balls_bounce(pair, n, ball, v, w);
                    total += hit.velocity.x + hit.spin.y;
                }
            }
            double taken = (double)(clock() - start) / CLOCKS_PER_SEC;
            best[what] = taken < best[what] ? taken : best[what];
            sum[what] = total;
        }
    }
    printf("%.17g %.17g %.17g %.17g %.17g %.17g\\n",
        best[0], best[1], best[2], sum[0], sum[1], sum[2]);
    return 0;
}
"""
COLLISIONS_JAVASCRIPT = """\
import { readFileSync } from "node:fs";
import { bounce, collide, model_form, solid_sphere } from "./balls.mjs";
const bytes = readFileSync("collisions"), best = [1e9, 1e9, 1e9], sum = [0, 0, 0];
const x = new Float64Array(bytes.buffer, bytes.byteOffset, COUNT * 12);
const ball = solid_sphere(0.01, 0.01), zero = [0, 0, 0], impacts = [];
for (let i = 0; i < x.length; i += 12) {
    const [stiffness_ratio, restitution, loss] = x.subarray(i + 9, i + 12);
    impacts.push([
        { friction: 0.3, stiffness_ratio, restitution, loss },
        ...[0, 3, 6].map((at) => Array.from(x.subarray(i + at, i + at + 3))),
    ]);
}
const works = [
    ([pair, n, v, w]) => bounce(pair, n, ball, v, w),
    ([pair, n, v, w]) => collide(pair, n, ball, v, w, ball, zero, zero),
    ([pair, n, v, w]) => model_form(pair, n, ball, v, w, ball, zero, zero),
];
for (let repeat = 0; repeat < REPEATS; repeat += 1) {
    works.forEach((work, what) => {
        let total = 0;
        const start = process.cpuUsage();
        for (const impact of impacts) {
            const hit = work(impact);
            total += what === 2 ? hit : hit.velocity[0] + hit.spin[1];
        }
        const taken = process.cpuUsage(start);
        best[what] = Math.min(best[what], (taken.user + taken.system) / 1e6);
        sum[what] = total;
    });
}
console.log(...best, ...sum);
"""
COMPILERS = [name for name in ("cc", "gcc", "clang") if shutil.which(name)][:1]


def seconds(work):
    """Best processor time of `work`, and the sum of all that it returns."""
    best = math.inf
    for _ in range(REPEATS):
        start = time.process_time()
        found = work()
        best = min(best, time.process_time() - start)
    return best, sum(float(np.sum(column)) for column in found)


def measured(commands, folder):
    """Times and sums that the last of some commands prints."""
    for command in commands:
        done = subprocess.run(command, cwd=folder, check=True, capture_output=True, text=True)
    return [float(word) for word in done.stdout.split()]


def report_spheres(folder):
    """The table of spheres, with each impact on its own; one line for each language."""
    random = np.random.default_rng(1)
    beta, e = random.choice([2.5, 3.5], COUNT), random.uniform(0.3, 1, COUNT)
    zeta2, plastic = random.uniform(1, 1.6, COUNT), np.arange(COUNT) % 2
    x = random.uniform(-1, 1, COUNT) * (beta + e * (beta - zeta2))
    loss = np.array(spheres.LOSSES)[plastic]
    np.column_stack([x, beta, zeta2, e, plastic + 1]).tofile(folder / "x")
    for file, text in (("speed.c", C), ("speed.mjs", JAVASCRIPT)):
        text = text.replace("COUNT", str(COUNT)).replace("REPEATS", str(REPEATS))
        (folder / file).write_text(text)
    sizes = [(folder / file).stat().st_size / 1024 for file in ("balls.h", "balls.mjs")]
    print("spheres: header of {:.0f} KB, module of {:.0f} KB".format(*sizes))
    fast, first = seconds(lambda: [spheres.rebound(x, beta, zeta2, e, loss=loss).velocity])
    whole, second = seconds(lambda: spheres.rebound(x, beta, zeta2, e, loss=loss)[:4])
    found = {"Python, in a batch": [fast, whole, first, second]}
    for compiler in COMPILERS:
        compiled = [compiler, "-std=c99", "-O2", "speed.c", "-o", "speed", "-lm"]
        found[f"{compiler} -O2"] = measured([compiled, ["./speed"]], folder)
    if shutil.which("node"):
        found["node"] = measured([["node", "speed.mjs"]], folder)
    for language, (fast, whole, *sums) in found.items():
        same = np.allclose(sums, [first, second], rtol=1e-9, atol=0)
        print(
            f"  {language}: {1e9 * fast / COUNT:.1f} ns an impact, velocity alone, "
            f"{1e9 * whole / COUNT:.1f} ns with all; sums {sums[0]:.6f}, {sums[1]:.6f}"
            f"{'' if same else ', WRONG'}"
        )


def report_collisions(folder):
    """Vectors in and out: none of the contacts slides throughout."""
    random, count, repeats = np.random.default_rng(1), COUNT // 10, REPEATS // 3
    normal, sideways = random.normal(size=(2, count, 3))
    normal /= np.linalg.norm(normal, axis=1)[:, None]
    sideways = np.cross(sideways, normal)
    sideways /= np.linalg.norm(sideways, axis=1)[:, None]
    zeta2, e = random.uniform(1, 1.5, count), random.uniform(0.3, 1, count)
    x = random.uniform(0, 1, count) * (3.5 + e * (3.5 - zeta2))
    velocity = 0.3 * x[:, None] * sideways - normal
    spin = 20 * random.normal(size=(count, 1)) * normal  # does not move the contact point
    rows = [normal, velocity, spin, zeta2, e, 1 + np.arange(count) % 2]
    np.column_stack(rows).tofile(folder / "collisions")
    for file, text in (("collide.c", COLLISIONS_C), ("collide.mjs", COLLISIONS_JAVASCRIPT)):
        text = text.replace("COUNT", str(count)).replace("REPEATS", str(repeats))
        (folder / file).write_text(text)
    print("collisions, every one its own pair: bounce, collide, model_form")
    found = {}
    for compiler in COMPILERS:
        compiled = [compiler, "-std=c99", "-O2", "collide.c", "-o", "collide", "-lm"]
        found[f"{compiler} -O2"] = measured([compiled, ["./collide"]], folder)
    if shutil.which("node"):
        found["node"] = measured([["node", "collide.mjs"]], folder)
    for language, numbers in found.items():
        times = ", ".join(f"{1e9 * best / count:.0f}" for best in numbers[:3])
        print(f"  {language}: {times} ns; sums {numbers[3:]}")


def main():
    with tempfile.TemporaryDirectory() as folder:
        export.write_spheres(Path(folder) / "balls.h", "c")
        export.write_spheres(Path(folder) / "balls.mjs", "js")
        report_spheres(Path(folder))
        report_collisions(Path(folder))


if __name__ == "__main__":
    main()
