"""The cushions for pooltool, workflow/examples/pooltool, without pooltool: what they ask it for."""

import runpy
import sys
from pathlib import Path
from types import SimpleNamespace
from unittest.mock import MagicMock

import numpy as np
import pytest

FILE = Path(__file__).parents[2] / "workflow/examples/pooltool/cushions.py"


def test_a_ball_leaves_a_cushion_as_collide_says(monkeypatch):
    core = SimpleNamespace(CoreBallLCushionCollision=object, CoreBallCCushionCollision=object)
    state = SimpleNamespace(BallState=lambda rvw, s: SimpleNamespace(rvw=rvw, s=s))
    modules = {"constants": MagicMock(), "objects": MagicMock(), "objects.ball.datatypes": state}
    modules |= {"physics.resolve.ball_cushion.core": core}
    monkeypatch.setitem(sys.modules, "pooltool", MagicMock())
    for name, module in modules.items():
        monkeypatch.setitem(sys.modules, f"pooltool.{name}", module)
    params = SimpleNamespace(f_c=0.2, e_c=0.85, R=0.028575, m=0.17)
    motion = np.array([[0.0, 0.0, params.R], [3.0, 4.0, 0.0], [0.0, 0.0, 0.0]])
    ball = SimpleNamespace(params=params, state=SimpleNamespace(rvw=motion))
    cushion = SimpleNamespace(get_normal_3d=lambda place: np.array([-1.0, 0.0, 0.0]))
    runpy.run_path(str(FILE))["Linear"]().solve(ball, cushion)
    _, (x, y, z), spin = ball.state.rvw
    # It slides throughout, from v1/(mu v2) = 6.7: friction is mu times the normal impulse.
    assert (x, y, z) == pytest.approx((-0.85 * 3, 4 - 0.2 * 1.85 * 3, 0))
    assert spin == pytest.approx([0, 0, -2.5 * 0.2 * 1.85 * 3 / params.R])
