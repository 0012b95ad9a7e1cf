"""A superball that is thrown under a table comes back: its path between floor and table."""

from collections.abc import Mapping
from typing import Any

import numpy as np
import pandas as pd

from planarimpact import scene
from stronge1994 import tables
from stronge1994.tables import Table

TOLERANCE = 1e-4


def curves(throw: Mapping[str, Any]) -> Table:
    """Path of a ball between a floor and the underside of a table, and each impact.

    There is one row before the first impact, one at each, one after the last; velocity and spin
    are those after it. They have the names and signs of a scene in space, x along the floor and z
    up: spin_y is positive where the ball turns as if it rolled forward on the floor, and -`spin`
    before the first impact. Gravity is left out.

    >>> ball = {"radius": 0.025, "density": 1100.0, "young_modulus": 5e6, "poisson_ratio": 0.5}
    >>> throw = {"friction": 0.8, "restitution": 0.9, "loss": "viscous"}
    >>> throw |= {"velocity": [6, -5], "spin": 0, "gap": 0.7, "bounces": 3}
    >>> path = curves(ball | throw)
    >>> path["velocity_x [m/s]"].round(1).tolist()  # before, after each impact, at the end
    [6.0, 3.6, -0.5, -2.0, -2.0]
    """
    before, after = impacts(throw)
    reach = throw["gap"] - 2 * throw["radius"]
    along, up = (
        np.append(before[f"velocity_{axis} [m/s]"][:1], after[f"velocity_{axis}_after [m/s]"])
        for axis in "xz"
    )
    # The path begins half way above the floor, and ends half way after the last impact.
    height = np.resize([0.0, reach], len(after))
    last = height[-1] + np.sign(up[-1]) * reach / 2
    height = np.concatenate([[reach / 2], height, [last]])
    flight = np.abs(np.diff(height)) / np.abs(up)
    place = np.cumsum(np.concatenate([[0.0], along * flight]))
    spin = np.append(before["spin_y [rad/s]"][:1], after["spin_y_after [rad/s]"])
    path = {
        "place [m]": place - place[1],
        "height [m]": throw["radius"] + height,
        "velocity_x [m/s]": np.append(along, along[-1]),
        "velocity_z [m/s]": np.append(up, up[-1]),
        "spin_y [rad/s]": np.append(spin, spin[-1]),
        "regime": ["before", *after["regime"], "after"],
    }
    return tables.curve(path, f"continuum.{throw['loss']}")


def impacts(throw: Mapping[str, Any]) -> tuple[pd.DataFrame, pd.DataFrame]:
    """Impacts of a throw as tables of a scene, each from the state after the last, and results."""
    of_throw = ("velocity", "spin", "gap", "bounces")
    ball = {name: value for name, value in throw.items() if name not in of_throw}
    along, up = throw["velocity"]
    state = {"velocity_x": along, "velocity_y": 0.0, "velocity_z": up}
    state |= {"spin_x": 0.0, "spin_y": -throw["spin"], "spin_z": 0.0}
    rows, results = [], []
    for bounce in range(throw["bounces"]):
        floor = bounce % 2 == 0
        normal = {"normal_x": 0.0, "normal_y": 0.0, "normal_z": 1.0 if floor else -1.0}
        known = {scene.header(name): value for name, value in (ball | state | normal).items()}
        rows.append({"id": f"{bounce + 1}, {'floor' if floor else 'table'}", **known})
        results.append(scene.solve(pd.DataFrame(rows[-1:]), TOLERANCE))
        after = results[-1].iloc[0]
        state = {name: float(after[scene.header(name, "_after")]) for name in state}
    return pd.DataFrame(rows), pd.concat(results, ignore_index=True)
