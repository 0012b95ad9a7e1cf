"""Time of an impact from the table of spheres, a batch of a million on one core.

OMP_NUM_THREADS=1 python tests/benchmarks/spheres_speed.py
"""

import time

import numpy as np

from planarimpact import spheres

COUNT, RUNS = 1_000_000, 7


def main():
    generator = np.random.default_rng(20)
    x = generator.uniform(0.0, 8.0, COUNT)
    beta = generator.choice([2.5, 3.5], COUNT)
    zeta2 = generator.uniform(1.0, 1.6, COUNT)
    e = generator.uniform(0.3, 1.0, COUNT)
    words = generator.choice(["viscous", "plastic"], COUNT)
    sticks = x * 2 / 3  # few of them slide throughout
    begin = time.process_time()
    spheres.rebound(1.0)
    print(f"reading the table: {time.process_time() - begin:.2f} s, once")
    for name, arguments, loss in (
        ("viscous, x 0 to 8", (x, beta, zeta2, e), "viscous"),
        ("plastic, x 0 to 8", (x, beta, zeta2, e), "plastic"),
        ("both, loss an array of words, x 0 to 8", (x, beta, zeta2, e), words),
        ("both, x 0 to 5.3", (sticks, beta, zeta2, e), words),
    ):
        taken = []
        for _ in range(RUNS):
            begin = time.process_time()
            found = spheres.rebound(*arguments, loss=loss)
            taken.append(time.process_time() - begin)
        share = np.mean(found.regime != 4)
        print(f"{name}: {min(taken) / COUNT * 1e9:.0f} ns an impact; {share:.0%} from the table")


if __name__ == "__main__":
    main()
