"""The examples of src/README.md that serve other codes: two spheres in space, and pooltool."""

import importlib.util
import os
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from planarimpact import bodies, scene

SECTION = (Path(__file__).parents[2] / "src/README.md").read_text(encoding="utf-8")
SECTION = SECTION.split("## In other codes")[1].split("\n## ")[0]
SPHERES, POOLTOOL = (
    re.search(rf"```{words}\n(.*?)```", SECTION, flags=re.S)[1]
    for words in ("python", "python pooltool")
)
# pooltool imports its graphics.
ABSENT = [name for name in ("pooltool", "panda3d") if importlib.util.find_spec(name) is None]


@pytest.fixture
def example():
    """Names of the example with two spheres."""
    names = {}
    exec(compile(SPHERES, "src/README.md", "exec"), names)
    return names


def test_two_spheres_in_space_keep_momentum_and_move_as_in_a_scene(example):
    random, count = np.random.default_rng(1994), 20
    radii, density = random.uniform(0.01, 0.03, (count, 2)), np.array([2500.0, 7800.0])
    masses = density * 4 / 3 * np.pi * radii**3
    normals = random.normal(size=(count, 3))
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    spins = random.normal(scale=30, size=(count, 2, 3))
    velocities = random.uniform(-0.8, 0.8, (count, 2, 3))
    velocities[:, 1] += 3 * normals  # they approach
    given = list(zip(normals, radii, masses, velocities, spins, strict=True))
    found = [example["collide"](*row) for row in given]

    for (normal, r, m, *before), after in zip(given, found, strict=True):
        arms = np.outer(r * [1, -1], normal)  # from the point of contact to the centres
        (p, turn), (p_after, turn_after) = (
            (m @ v, m @ np.cross(arms, v) + 0.4 * m * r**2 @ s) for v, s in (before, after)
        )
        # Of sums of some ten terms of this size.
        assert p_after == pytest.approx(p, abs=1e-14 * np.sum(m[:, None] * np.abs(before[0])))
        assert turn_after == pytest.approx(turn, abs=1e-14 * np.max(r) * np.sum(m) * 30)

    constants = {"friction": example["MU"], "restitution": example["E"], "loss": "viscous"}
    columns = {f"normal_{axis}": normals[:, i] for i, axis in enumerate("xyz")}
    for body, prefix in enumerate(("", "other_")):
        columns |= {f"{prefix}radius [m]": radii[:, body]}
        columns |= {f"{prefix}density [kg/m^3]": density[body]}
        constants |= {f"{prefix}young_modulus [Pa]": 7e10, f"{prefix}poisson_ratio": 0.3}
        for i, axis in enumerate("xyz"):
            columns |= {f"{prefix}velocity_{axis} [m/s]": velocities[:, body, i]}
            columns |= {f"{prefix}spin_{axis} [rad/s]": spins[:, body, i]}
    after = scene.solve(pd.DataFrame(columns | constants), tolerance=1e-3)
    v2 = -np.sum((velocities[:, 0] - velocities[:, 1]) * normals, axis=1)
    # Both answers are within 1e-3 mu v2(0) of the continuum. P1 = m1 times the change of v1, and
    # m1 = m2/3.5: the velocity changes by P1/m, the spin by 2.5 P1/(m r).
    allowed = 2e-3 * example["MU"] * v2 * (masses.prod(1) / masses.sum(1)) / 3.5
    assert np.any(after["regime"] != "SLIP") and v2.min() > 0
    for body, prefix in enumerate(("", "other_")):
        for i, axis in enumerate("xyz"):
            gap = after[f"{prefix}velocity_{axis}_after [m/s]"] - [v[body, i] for v, _ in found]
            assert np.all(np.abs(gap) <= allowed / masses[:, body])
            gap = after[f"{prefix}spin_{axis}_after [rad/s]"] - [s[body, i] for _, s in found]
            assert np.all(np.abs(gap) <= 2.5 * allowed / masses[:, body] / radii[:, body])


def test_any_two_solid_spheres_have_the_mass_ratio_of_the_examples():
    pair = bodies.solid_sphere(0.01, 2500.0), bodies.solid_sphere(0.03, 7800.0)
    assert bodies.mass_ratio(*pair) == pytest.approx(3.5, rel=1e-15)


# Run behind the example, in a process of its own: pooltool writes into the home of its user.
BREAK_SHOT = """
import random
from types import SimpleNamespace

import pooltool as pt
from planarimpact import lumped
from pooltool.physics.engine import PhysicsEngine
from pooltool.physics.resolve.ball_cushion.stronge_compliant import StrongeCompliantLinear

random.seed(1994), np.random.seed(1994)  # the rack is not quite regular
table = pt.Table.default()
balls = pt.get_rack(pt.GameType.NINEBALL, table)
shot = pt.System(cue=pt.Cue(cue_ball_id="cue"), table=table, balls=balls)
shot.strike(V0=8, phi=pt.aim.at_ball(shot, "1"), a=0.2, b=0.3)
played = pt.simulate(shot, engine=PhysicsEngine(resolver))


def energy(ball):
    return pt.ptmath.get_ball_energy(ball.state.rvw, ball.params.R, ball.params.m)


hits = [event for event in played.events if "cushion" in event.event_type]
assert len(hits) > 5, len(hits)
for hit in hits:
    assert 0 < energy(hit.agents[0].final) < energy(hit.agents[0].initial)
assert all(energy(ball) == 0 for ball in played.balls.values())

# With the same answer for each impact both strategies do the same.
zeta2 = 3.5 / 1.8**2
cushion_of = lambda e: SimpleNamespace(velocity=lambda x: lumped.rebound(x, 3.5, zeta2, e).velocity)
theirs, compared = StrongeCompliantLinear(omega_ratio=1.8), 0
for hit in hits:
    if hit.event_type == pt.EventType.BALL_LINEAR_CUSHION:
        segment = table.cushion_segments.linear[hit.ids[1]]
        found = [
            strategy.resolve(hit.agents[0].initial, segment)[0].state.rvw
            for strategy in (linear, theirs)
        ]
        np.testing.assert_allclose(*found, rtol=0, atol=1e-9)
        compared += 1
assert compared > 5, compared
print("played")
"""


@pytest.mark.skipif(bool(ABSENT), reason=f"needs {', '.join(ABSENT)}: workflow/envs/pooltool.txt")
def test_pooltool_plays_a_break_shot_with_our_cushion(tmp_path):
    result = subprocess.run(
        [sys.executable, "-c", POOLTOOL + BREAK_SHOT],
        capture_output=True,
        text=True,
        env=os.environ | {"HOME": str(tmp_path)},
    )
    assert result.stdout == "played\n", result.stderr
