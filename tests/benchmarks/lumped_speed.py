"""Time of one impact in a batch of a million, e = 0.9, on one core.

    python tests/benchmarks/lumped_speed.py

Prints nanoseconds an impact: the best of several runs, in the time of this process, which other
programs disturb least. For comparison between machines it prints the ratio to the time of one sine
and one cosine of the same million numbers in the same run. Then follows the time of a single impact
against the number of its phases.
"""

import time

import numpy as np

from planarimpact import lumped, rigid

COUNT = 1_000_000
REPEATS = 7


def nanoseconds(work, count=COUNT):
    """Shortest time of `work`, an element of its batch."""
    work()
    times = []
    for _ in range(REPEATS):
        start = time.process_time()
        work()
        times.append(time.process_time() - start)
    return min(times) / count * 1e9


def main():
    rng = np.random.default_rng(1)
    x = rng.uniform(0, 10, COUNT)
    slow = rng.uniform(0, 5.3, COUNT)
    beta, zeta2 = rng.uniform(1, 8, COUNT), 10 ** rng.uniform(-1, 1, COUNT)
    e = rng.uniform(0.01, 1, COUNT)
    unit = nanoseconds(lambda: np.sin(x) + np.cos(x))
    print(f"one sine and one cosine: {unit:.1f} ns")
    cases = {
        "solid sphere, incidence 0 to 10 (mixed regimes)": lambda: lumped.rebound(
            x, 3.5, 1.21, 0.9
        ),
        "solid sphere, incidence 0 to 5.3 (every impact sticks)": lambda: lumped.rebound(
            slow, 3.5, 1.21, 0.9
        ),
        "mass ratio 1 to 8, stiffness ratio 0.1 to 10, incidence 0 to 10": lambda: lumped.rebound(
            x, beta, zeta2, 0.9
        ),
        "the same, two viscous elements": lambda: lumped.rebound(
            x, beta, zeta2, 0.9, loss="viscous"
        ),
        "the same, restitution 0.01 to 1": lambda: lumped.rebound(
            x, beta, zeta2, e, loss="viscous"
        ),
        "no tangential compliance": lambda: rigid.rebound(x, 3.5, 1.21, 0.9),
    }
    for name, work in cases.items():
        found = nanoseconds(work)
        print(f"{found:7.1f} ns  {found / unit:5.1f} x  {name}")
    print("a single impact, x = 2, beta = 3.5, e = 0.9:")
    for ratio in (1.21, 1e-2, 1e-4, 1e-6, 1e-8, 1e-12, 1e-300):
        phases = 0.9 * np.sqrt(3.5 / ratio)  # at most; e omega/Omega half-waves, stick and slip
        found = nanoseconds(lambda ratio=ratio: lumped.rebound(2.0, 3.5, ratio, 0.9), 1)
        print(f"{found / 1e6:7.2f} ms  at most {phases:.2g} phases, zeta^2 = {ratio:g}")


if __name__ == "__main__":
    main()
