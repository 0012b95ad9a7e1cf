"""Compiled responses in C and JavaScript: time of an impact, one after another, on one core.

    OMP_NUM_THREADS=1 python tests/benchmarks/export_speed.py

A loop over a million random incidences, best of several, beside Python's batch in the same run.
None of them slides throughout: that would be quicker. The time is that of the processor. The sums
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

from planarimpact import export, response

COUNT, REPEATS = 1_000_000, 21
PAIRS = {
    "continuum, plastic, e = 0.8, 1e-3": ("continuum.plastic", 1e-3, {"restitution": 0.8}),
    "lumped, e = 1, 1e-10": ("lumped", 1e-10, {}),
    "lumped, many phases, 1e-10": ("lumped", 1e-10, {"mass_ratio": 8.0, "stiffness_ratio": 0.03}),
}
C = """\
#include <stdio.h>
#include <stdlib.h>
#include <time.h>
#include "pair.h"
static double x[COUNT];
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
                    struct pair_result found = pair_rebound(x[i]);
                    total += found.velocity + found.peak_friction + found.dissipation
                        + found.regime;
                } else {
                    total += pair_velocity(x[i]);
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
import { rebound, velocity } from "./pair.mjs";
const bytes = readFileSync("x"), best = [1e9, 1e9], sum = [0, 0];
const x = new Float64Array(bytes.buffer, bytes.byteOffset, COUNT);
const loops = [
    () => {
        let total = 0;
        for (let i = 0; i < x.length; i += 1) total += velocity(x[i]);
        return total;
    },
    () => {
        let total = 0;
        for (let i = 0; i < x.length; i += 1) {
            const found = rebound(x[i]);
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


def report(name, built, folder):
    """Print one line for each language."""
    span = built.pieces.end
    x = np.random.default_rng(1).uniform(-span, span, COUNT)
    x.tofile(folder / "x")
    for file, language in (("pair.h", "c"), ("pair.mjs", "js")):
        export.write(built, folder / file, language)
    for file, text in (("speed.c", C), ("speed.mjs", JAVASCRIPT)):
        text = text.replace("COUNT", str(COUNT)).replace("REPEATS", str(REPEATS))
        (folder / file).write_text(text)
    size = (folder / "pair.h").stat().st_size / 1024
    print(f"{name}: {len(built.pieces.start)} pieces, header of {size:.0f} KB")
    (fast, first), (whole, second) = (
        seconds(lambda: [built.velocity(x)]),
        seconds(lambda: built(x)[:4]),
    )
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


def main():
    with tempfile.TemporaryDirectory() as folder:
        for name, (model, tolerance, groups) in PAIRS.items():
            groups = {"mass_ratio": 3.5, "stiffness_ratio": 17 / 14} | groups
            built = response.compile(model, incidence_max=40, tolerance=tolerance, **groups)
            report(name, built, Path(folder))


if __name__ == "__main__":
    main()
