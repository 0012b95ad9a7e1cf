"""A scene keeps its tolerance against the continuum; the example scenes are made as stated."""

from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from planarimpact import bodies, continuum, scene
from planarimpact.common import sliding
from stronge1994 import reference_data
from tests.package_tables import scene_tables
from tests.reference_solutions import solved_tables

DATA = Path(__file__).parents[2] / "data"
BODY = "mass [kg]", "gyration [m]", "radius [m]"
# How far incidences beside a threshold are from it, relative; the first one is some roundings.
BESIDE = (1e-15, 1e-9, 1e-6, 1e-3)
# Tolerances of the references below, elastic and with a loss.
ELASTIC, LOSSY = 1e-5, 1e-4

# Losses and restitutions of pairs.
KINDS = [("viscous", e) for e in (0.3, 0.6, 0.99, 1.0)]
KINDS += [("plastic", e) for e in (0.3, 0.6, 0.9)]


def random_scene(rng, count=21, pairs=21):
    """Random pairs of mass ratios up to 7; half of the impacts stand beside a threshold."""
    of = np.arange(count) % pairs
    friction, normal = rng.uniform(0.02, 1.0, pairs)[of], rng.uniform(0.1, 5.0, count)
    beta = rng.uniform(1.1, 7.0, pairs)[of]
    loss, e = zip(*(KINDS[pair % len(KINDS)] for pair in range(pairs)), strict=True)
    rows = pd.DataFrame(
        {
            "radius [m]": 0.01,
            "mass [kg]": 0.03,
            "gyration [m]": 0.01 / np.sqrt(beta - 1),
            "young_modulus [Pa]": 10 ** rng.uniform(9, 9.5, pairs)[of],
            "poisson_ratio": rng.uniform(0.0, 0.5, pairs)[of],
            "friction": friction,
            "velocity_normal [m/s]": normal,
            "spin [rad/s]": 0.0,
            "restitution": np.array(e)[of],
            "loss": np.array(loss)[of],
        }
    )
    groups = groups_of(rows)
    at = np.stack([groups[1], groups[0], sliding.limit_alike(*groups)])
    beside = at[rng.integers(0, 3, count), np.arange(count)] * (
        1 + rng.choice(BESIDE, count) * rng.choice([-1, 1], count)
    )
    x = np.where(rng.random(count) < 0.5, beside, rng.uniform(0, 1.2 * at[2]))
    return rows.assign(**{"velocity_tangential [m/s]": x * (friction * normal)})


def groups_of(rows):
    """Mass ratio, ratio of stiffnesses and restitution of each row."""
    ball = bodies.Body(*(rows[name].to_numpy() for name in BODY))
    elastic = rows["young_modulus [Pa]"].to_numpy(), rows["poisson_ratio"].to_numpy()
    zeta2 = bodies.stiffness_ratio(bodies.Material(*elastic))
    return bodies.mass_ratio(ball), zeta2, rows["restitution"].to_numpy()


def test_a_scene_keeps_its_tolerance(tmp_path):
    """In velocity, as its error bound promises, and in peak friction."""
    rows = random_scene(np.random.default_rng(2))
    rows.to_csv(tmp_path / "in.csv", index=False)
    beta, zeta2, e = groups_of(rows)
    unit = (rows["friction"] * rows["velocity_normal [m/s]"]).to_numpy()
    x = rows["velocity_tangential [m/s]"].to_numpy() / unit
    velocity, peak = np.empty_like(x), np.empty_like(x)
    slack = np.where(e == 1, ELASTIC, LOSSY)
    for kind, part, tolerance in (
        (None, e == 1, ELASTIC),
        ("viscous", (e < 1) & (rows["loss"] == "viscous"), LOSSY),
        ("plastic", (e < 1) & (rows["loss"] == "plastic"), LOSSY),
    ):
        groups = x[part], beta[part], zeta2[part], e[part]
        found = continuum.rebound(*groups, loss=kind, tolerance=tolerance)
        velocity[part], peak[part] = found[:2]
    for tolerance in (1e-2, 1e-3):
        report = scene.solve_file(tmp_path / "in.csv", tmp_path / "out.csv", tolerance)
        after = pd.read_csv(tmp_path / "out.csv")
        error = np.abs(after["contact_velocity_after [m/s]"] / unit - velocity)
        promised = after["error_bound [m/s]"] / unit
        assert (error <= promised + slack).all() and promised.max() <= tolerance * (1 + 1e-12)
        force = after["peak_friction_force [N]"] / after["peak_normal_force [N]"] / rows["friction"]
        assert (np.abs(force - peak) - slack).max() <= tolerance
        assert ", table" in report.explain() and ", solved" in report.explain()


# The example scenes, and what they must come to by mechanics in 50 digits and a second code. The
# run judges every row of its scenes against these tables.


@pytest.mark.parametrize("name", solved_tables.SCENES)
def test_example_scenes_are_made_as_stated(name):
    made, there = scene_tables.SCENES[name](), pd.read_csv(DATA / f"scenes/{name}.csv")
    pd.testing.assert_frame_equal(made, there, rtol=1e-9, check_dtype=False)


@pytest.mark.parametrize(
    ("name", "step"),
    [
        ("billiard_cushion", 45),
        *(pytest.param(name, 1, marks=pytest.mark.long) for name in solved_tables.SCENES),
    ],
)
def test_the_table_is_what_the_mechanics_gives(name, step):
    series = reference_data.load_yaml(DATA / "scenes_solved/source.yaml")["series"][name]
    table = pd.read_csv(DATA / f"scenes_solved/{name}.csv", dtype=str)
    header, rows = solved_tables.scene_table(name, step)
    assert header == [*table] and series["points"] == len(table)
    anew, table = pd.DataFrame(rows, columns=header), table.iloc[::step].reset_index(drop=True)
    labels = [*series["labels"], header[len(series["labels"])]]
    assert anew[labels].equals(table[labels])
    for column, axis in zip(header[len(labels) :], series["y"], strict=True):
        assert axis["column"] == column.split(" [")[0]
        # The second code computes in floating point, which may round otherwise elsewhere.
        numbers = (frame[column].astype(float) for frame in (anew, table))
        np.testing.assert_allclose(*numbers, rtol=0, atol=axis["sigma"] / 100, err_msg=column)


@pytest.mark.parametrize("name", sorted(path.stem for path in (DATA / "scenes").glob("*.csv")))
def test_a_second_code_has_every_number_of_a_scene(name):
    """But the bound of the error."""
    table, wanted = (
        pd.read_csv(DATA / folder / f"{name}.csv") for folder in ("scenes", "scenes_solved")
    )
    after = scene.solve(table.head(1))
    numbers = after.select_dtypes("number").columns.difference(table.columns)
    assert not {*numbers} - {*wanted} - {"error_bound [m/s]"}
