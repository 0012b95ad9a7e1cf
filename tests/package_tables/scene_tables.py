"""Makes the example scenes in data/scenes/: invented impacts, of a kind that is met in practice.

    PYTHONPATH=src python -m tests.package_tables.scene_tables data/scenes

The numbers are typical, not measured; see data/scenes/README.md.
"""

import sys
from pathlib import Path

import numpy as np
import pandas as pd

from planarimpact import scene

SEED = 1994
# Of the ball thrown under a table.
BALL = {
    "radius": 0.025,
    "density": 1100.0,
    "young_modulus": 5.0e6,
    "poisson_ratio": 0.5,
    "friction": 0.8,
    "restitution": 0.9,
    "loss": "viscous",
}
VELOCITY, BOUNCES, TOLERANCE = (6.0, -5.0), 3, 1e-4  # m/s along and up; mu v2(0)


def shot_peening(count=200):
    """Steel shot of 0.6 to 1.2 mm on aluminium: a nozzle at 75 degrees, with scatter."""
    rng = np.random.default_rng(SEED)
    speed, angle = rng.normal(60, 8, count), np.radians(rng.normal(75, 7, count))
    steel = {"density [kg/m^3]": 7800.0, "young_modulus [Pa]": 207e9, "poisson_ratio": 0.3}
    target = {"other_young_modulus [Pa]": 70e9, "other_poisson_ratio": 0.33}
    state = {
        "velocity_tangential [m/s]": (speed * np.cos(angle)).round(2),
        "velocity_normal [m/s]": np.abs(speed * np.sin(angle)).round(2),
        "spin [rad/s]": rng.normal(0, 2000, count).round(0),
    }
    shot = {"radius [m]": rng.uniform(0.3e-3, 0.6e-3, count).round(6)}
    pair = {"friction": 0.3, "restitution": 0.5, "loss": "plastic"}
    return pd.DataFrame(shot | steel | target | pair | state)


def billiard_cushion():
    """A billiard ball that rolls into a cushion under seven angles with three side spins.

    x runs along the cushion, y into it, z up. The nose of the cushion is higher than the centre of
    the ball, so that the normal points down a little.
    """
    radius, height = 0.028575, 0.27  # of the contact over the centre, in radii
    rows = []
    for angle in range(10, 80, 10):  # from the cushion
        for side in (-40.0, 0.0, 40.0):
            along, into = np.cos(np.radians(angle)), np.sin(np.radians(angle))
            speed = 1.5
            rows.append(
                {
                    "id": f"{angle} deg, side spin {side:g} rad/s",
                    "radius [m]": radius,
                    "mass [kg]": 0.17,
                    "gyration [m]": round(radius * np.sqrt(0.4), 9),
                    "young_modulus [Pa]": 5.8e9,
                    "poisson_ratio": 0.34,
                    "other_young_modulus [Pa]": 5.0e6,
                    "other_poisson_ratio": 0.5,
                    "friction": 0.2,
                    "restitution": 0.85,
                    "loss": "viscous",
                    "velocity_x [m/s]": round(speed * along, 6),
                    "velocity_y [m/s]": round(speed * into, 6),
                    "velocity_z [m/s]": 0.0,
                    # Rolling: the point on the cloth is at rest.
                    "spin_x [rad/s]": round(-speed * into / radius, 6),
                    "spin_y [rad/s]": round(speed * along / radius, 6),
                    "spin_z [rad/s]": side,
                    "normal_x": 0.0,
                    "normal_y": -float(np.sqrt(1 - height**2)),
                    "normal_z": -height,
                }
            )
    return pd.DataFrame(rows)


def superball():
    """A rubber ball thrown under a table: its impacts on floor, table and floor again.

    Each begins as the one before ends: gravity is left out. Rounded, so that the last digits of the
    solver do not make another scene.
    """
    along, up = VELOCITY
    state = {"velocity_x": along, "velocity_y": 0.0, "velocity_z": up}
    state |= {"spin_x": 0.0, "spin_y": 0.0, "spin_z": 0.0}
    rows = []
    for bounce in range(BOUNCES):
        floor = bounce % 2 == 0
        normal = {"normal_x": 0.0, "normal_y": 0.0, "normal_z": 1.0 if floor else -1.0}
        known = {scene.header(name): value for name, value in (BALL | state | normal).items()}
        rows.append({"id": f"{bounce + 1}, {'floor' if floor else 'table'}", **known})
        after = scene.solve(pd.DataFrame(rows[-1:]), TOLERANCE).iloc[0]
        state = {name: float(after[scene.header(name, "_after")]) for name in state}
    return pd.DataFrame(rows).round(6)


SCENES = {
    "shot_peening": shot_peening,
    "billiard_cushion": billiard_cushion,
    "superball": superball,
}

if __name__ == "__main__":
    for name, make in SCENES.items():
        make().to_csv(Path(sys.argv[1]) / f"{name}.csv", index=False, lineterminator="\n")
