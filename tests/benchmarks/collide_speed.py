"""`collide`: one impact from Python, and a million at once, on one core.

OMP_NUM_THREADS=1 python tests/benchmarks/collide_speed.py

These are solid spheres, each with its own pair of materials: half of them viscous and half plastic,
with restitution from 0.3 to 1, or all with a yield pressure, from which restitution follows. Times
are those of the processor.
"""

import time
import timeit

import numpy as np

from planarimpact import Pair, bodies, collide

COUNT, SINGLES = 1_000_000, 10_000
STEEL, RUBBER = bodies.Material(207e9, 0.3), bodies.Material(5e6, 0.5)
UP, VELOCITY, SPIN = np.array([0, 0, 1.0]), np.array([1.0, 0, -3.0]), np.array([0, 20.0, 0])
SINGLE = {
    "viscous, e = 0.9": Pair(RUBBER, friction=0.8, restitution=0.9, loss="viscous"),
    "viscous, relaxation time": Pair(RUBBER, friction=0.8, relaxation_time=2e-4),
    "plastic, e = 0.8": Pair(STEEL, friction=0.2, restitution=0.8, loss="plastic"),
    "plastic, yield pressure": Pair(STEEL, friction=0.2, yield_pressure=3e9),
}


def timed(words, function, count=1, unit="s"):
    """Print the least time of three of what `function` does, called `count` times."""
    times = timeit.repeat(function, number=count, repeat=3, timer=time.process_time)
    print(f"{words:<40} {min(times) * {'us': 1e6, 's': 1}[unit] / count:6.2f} {unit}", flush=True)


def one(pair, body, model=None):
    collide(pair, UP, body, VELOCITY, SPIN, model=model)


def million(seed=1):
    """Arguments of `collide` but for the pairs, and these."""
    rng = np.random.default_rng(seed)
    normal = rng.normal(size=(COUNT, 3))
    normal /= np.linalg.norm(normal, axis=1)[:, None]
    velocity, other_velocity = rng.normal(0, 2, size=(2, COUNT, 3))
    normal *= -np.sign(np.sum((velocity - other_velocity) * normal, axis=1))[:, None]
    spin, other_spin = rng.normal(0, 100, size=(2, COUNT, 3))
    body, other = (
        bodies.solid_sphere(rng.uniform(1e-3, 1e-2, COUNT), density=7800.0) for _ in range(2)
    )
    groups = {
        "friction": rng.uniform(0.05, 0.6, COUNT),
        "stiffness_ratio": rng.uniform(1.0, 1.5, COUNT),
    }
    loss = np.where(rng.random(COUNT) < 0.5, "viscous", "plastic")
    pairs = {
        "own e": Pair(**groups, restitution=rng.uniform(0.3, 1, COUNT), loss=loss),
        "own yield pressure": Pair(
            **groups, yield_pressure=rng.uniform(2e9, 6e9, COUNT), effective_modulus=115e9
        ),
    }
    return pairs, (normal, body, velocity, spin, other, other_velocity, other_spin)


if __name__ == "__main__":
    ball = bodies.solid_sphere(0.01, density=2000.0)
    for words, pair in SINGLE.items():
        timed(f"one impact, {words}", lambda pair=pair: one(pair, ball), SINGLES, "us")
    viscous = SINGLE["viscous, e = 0.9"]
    for name in ("lumped.hysteretic", "rigid"):
        timed(f"one impact, {name}", lambda name=name: one(viscous, ball, name), SINGLES, "us")
    pairs, arguments = million()
    for words, table in pairs.items():
        timed(f"a million, {words}", lambda table=table: collide(table, *arguments))
