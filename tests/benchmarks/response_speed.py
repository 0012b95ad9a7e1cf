"""Compiled responses: time to build one, and time of an impact in a batch of a million, one core.

    OMP_NUM_THREADS=1 python tests/benchmarks/response_speed.py

Each beside its model in the same run.
"""

import statistics
import time

import numpy as np

from planarimpact import continuum, lumped, response

COUNT, REPEATS = 1_000_000, 7


def seconds(work, repeats=REPEATS):
    """Median time of `work`, and what it returned last."""
    times = []
    for _ in range(repeats):
        start = time.perf_counter()
        found = work()
        times.append(time.perf_counter() - start)
    return statistics.median(times), found


def report(name, model, tolerance, solve, count, **parameters):
    """Print one line on a response and its model."""
    x = np.random.default_rng(1).uniform(-10, 10, COUNT)
    repeats = 1 if model == "continuum" else REPEATS
    build, compiled = seconds(
        lambda: response.compile(model, incidence_max=10, tolerance=tolerance, **parameters),
        repeats,
    )
    compiled.velocity(x)
    taken, velocity = seconds(lambda: compiled.velocity(x))
    whole, _ = seconds(lambda: compiled(x))
    direct, exact = seconds(lambda: solve(x[:count]).velocity, 1)
    error = np.max(np.abs(velocity[:count] - exact))
    print(
        f"{name}: built in {build:.3f} s; {1e9 * taken / COUNT:.1f} ns an impact, velocity alone, "
        f"{1e9 * whole / COUNT:.0f} ns with all; model {1e9 * direct / count:.0f} ns, "
        f"{direct / count * COUNT / taken:.0f} times as long; error {error:.1e}"
    )


def main():
    for e, beta, zeta2 in ((1.0, 3.5, 1.21), (0.5, 3.5, 1.21), (0.9, 7.0, 0.2), (1.0, 8.0, 0.1)):
        groups = {"mass_ratio": beta, "stiffness_ratio": zeta2, "restitution": e}
        name = f"lumped, beta = {beta:g}, zeta2 = {zeta2:g}, e = {e:g}, tolerance 1e-10"
        report(
            name,
            "lumped.hysteretic",
            1e-10,
            lambda x, g=groups: lumped.rebound(x, **g),
            COUNT,
            **groups,
        )
    for tolerance in (1e-3, 1e-6):
        groups = {"mass_ratio": 3.5, "stiffness_ratio": 17 / 14}
        name = f"continuum, tolerance {tolerance:g}"

        def solve(x, g=groups, t=tolerance):
            return continuum.rebound(x, **g, tolerance=t / 4)

        report(name, "continuum", tolerance, solve, 400, **groups)


if __name__ == "__main__":
    main()
