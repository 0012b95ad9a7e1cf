"""Time of 400 incidences of the elastic continuum, on one core, and what its accuracy costs.

    OMP_NUM_THREADS=1 python tests/benchmarks/continuum_speed.py

Prints the time at each tolerance, its largest true error, and its ratio to the exact lumped model
on the same 400 incidences in the same run; the same for annuli.
"""

import time

import numpy as np

from planarimpact import continuum, lumped
from planarimpact.continuum import annuli

INCIDENCE = np.linspace(0.0, 10.0, 400)
GROUPS = INCIDENCE, 3.5, 17 / 14
REPEATS = 3


def seconds(work):
    """Median time of `work`, and its answer."""
    times = []
    for _ in range(REPEATS):
        start = time.perf_counter()
        answer = work()
        times.append(time.perf_counter() - start)
    return float(np.median(times)), answer


def main():
    exact = continuum.rebound(*GROUPS, tolerance=1e-8).velocity
    unit, simple = seconds(lambda: lumped.rebound(*GROUPS).velocity)
    _print("lumped model", unit, unit, simple - exact)
    for tolerance in (1e-2, 1e-4, 1e-6):
        taken, found = seconds(lambda t=tolerance: continuum.rebound(*GROUPS, tolerance=t).velocity)
        _print(f"continuum, tolerance {tolerance:g}", taken, unit, found - exact)
    for circles, steps in ((16, 256), (32, 1024)):
        taken, found = seconds(
            lambda c=circles, s=steps: annuli.rebound(*GROUPS, circles=c, steps=s).velocity
        )
        _print(f"annuli, {circles} circles, {steps} steps", taken, unit, found - exact)


def _print(name, taken, unit, error):
    words = f"{taken:8.4f} s  {taken / unit:8.0f} x  largest error {np.max(np.abs(error)):.1e}"
    print(f"{words}  {name}")


if __name__ == "__main__":
    main()
