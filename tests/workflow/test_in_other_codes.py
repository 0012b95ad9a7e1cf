"""The example of src/README.md that serves another code: pooltool with a rubber cushion."""

import importlib.util
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

SECTION = (Path(__file__).parents[2] / "src/README.md").read_text(encoding="utf-8")
SECTION = SECTION.split("## In other codes")[1].split("\n## ")[0]
POOLTOOL = re.search(r"```python pooltool\n(.*?)```", SECTION, flags=re.S)[1]
# pooltool imports its graphics.
ABSENT = [name for name in ("pooltool", "panda3d") if importlib.util.find_spec(name) is None]


# Run behind the example, in a process of its own: pooltool writes into the home of its user.
BREAK_SHOT = """
import random

import pooltool as pt
from pooltool.physics.engine import PhysicsEngine

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
