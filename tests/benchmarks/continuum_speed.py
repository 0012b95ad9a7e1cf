"""Time of 400 incidences of the continuum, on one core, and what its accuracy costs.

    OMP_NUM_THREADS=1 python tests/benchmarks/continuum_speed.py

Prints the time at each tolerance, its largest true error, and its ratio to the lumped model
on the same 400 incidences in the same run; the same for annuli. Below e = 1 it does so for each
loss.
"""

import time

import numpy as np

from planarimpact import continuum, lumped
from planarimpact.continuum import annuli, inelastic
from planarimpact.ground import sliding

INCIDENCE = np.linspace(0.0, 10.0, 400)
GROUPS = INCIDENCE, 3.5, 17 / 14
LOSSY = 0.95, 0.8, 0.6, 0.3
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
    for loss in continuum.LOSSES:
        for e in LOSSY:
            _lossy(loss, e, unit)


def _lossy(loss, e, unit):
    exact = _fine(loss, e)
    for tolerance in (1e-2, 1e-3, 1e-4):
        taken, found = seconds(
            lambda t=tolerance: continuum.rebound(*GROUPS, e, loss=loss, tolerance=t).velocity
        )
        _print(f"{loss}, e = {e:g}, tolerance {tolerance:g}", taken, unit, found - exact)


def _fine(loss, e):
    """Velocities with many steps, extrapolated; slip throughout in closed form."""
    x = INCIDENCE
    groups = np.broadcast_arrays(x, *(np.float64(group) for group in (*GROUPS[1:], e)))
    limit = sliding.limit_alike(groups[1], groups[2], e)
    coarse, fine = (
        inelastic.path(*groups, inelastic.MOTIONS[loss], steps).velocity[-1]
        for steps in (512, 1024)
    )
    return np.where(x < limit, fine + (fine - coarse) / 3, sliding.velocity(x, groups[1], e))


def _print(name, taken, unit, error):
    words = f"{taken:8.4f} s  {taken / unit:8.0f} x  largest error {np.max(np.abs(error)):.1e}"
    print(f"{words}  {name}")


if __name__ == "__main__":
    main()
