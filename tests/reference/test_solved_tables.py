"""Scenes against independent tables, and which faults these would show."""

import csv
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from planarimpact import bodies, continuum, lumped, rigid, scene, spheres
from planarimpact.collision import mechanics
from stronge1994 import reference_data
from tests.reference_solutions import solved_tables

ROOT = Path(__file__).parents[2]
CONFIG = reference_data.load_yaml(ROOT / "workflow/config.yaml")
SERIES = reference_data.load_yaml(ROOT / "data/scenes_solved/source.yaml")["series"]
NAMES = solved_tables.SCENES
# Zero throughout, as the ball stays in its plane: a factor or sign cannot show.
ZERO = {"superball": {"velocity_y_after [m/s]", "spin_x_after [rad/s]", "spin_z_after [rad/s]"}}
ZERO["billiard_cushion"] = {"model_form [m/s]"}  # all slide throughout


def stated(name):
    """Entry of a series in its source.yaml, and its table as text."""
    with open(ROOT / f"data/scenes_solved/{name}.csv", newline="", encoding="utf-8") as file:
        return SERIES[name], pd.DataFrame(csv.DictReader(file))


def solved(name, **changes):
    """What the package answers at the points of a series; of a scene with some columns changed."""
    _, table = stated(name)
    before = pd.read_csv(ROOT / f"data/scenes/{name}.csv").assign(**changes)
    after = scene.solve(before, CONFIG["scenes"][name]["tolerance"])
    return after.iloc[table["row [1]"].astype(int) - 1].reset_index(drop=True)


def differing(name, found):
    """Columns that leave the series: by more than a sigma, or by another word."""
    series, table = stated(name)
    headers = [*table.columns[len(series["labels"]) + 1 :]]
    assert [axis["column"] for axis in series["y"]] == [text.split(" [")[0] for text in headers]
    assert series["points"] == len(table)
    far = {
        column
        for column, axis in zip(headers, series["y"], strict=True)
        if (np.abs(found[column] - table[column].astype(float)) > axis["sigma"]).any()
    }
    return far | {
        label for label in series["labels"] if [*found[label].astype(str)] != [*table[label]]
    }


@pytest.mark.parametrize("name", NAMES)
def test_the_package_answers_as_the_table(name):
    assert differing(name, solved(name)) == set()


@pytest.mark.parametrize("name", NAMES)
def test_the_table_is_what_the_mechanics_gives(name):
    series, table = stated(name)
    step = 1 if len(table) < 100 else 23
    header, rows = solved_tables.scene_table(name, step)
    assert header == [*table]
    anew, table = pd.DataFrame(rows, columns=header), table.iloc[::step].reset_index(drop=True)
    labels = [*series["labels"], header[len(series["labels"])]]
    assert anew[labels].equals(table[labels])
    for column, axis in zip(header[len(labels) :], series["y"], strict=True):
        # The second code computes in floating point, which may round otherwise elsewhere.
        numbers = (frame[column].astype(float) for frame in (anew, table))
        np.testing.assert_allclose(*numbers, rtol=0, atol=axis["sigma"] / 100, err_msg=column)


@pytest.mark.parametrize("name", NAMES)
def test_a_factor_or_a_sign_leaves_the_table(name):
    found = solved(name)
    series, table = stated(name)
    numbers = {*table.columns[len(series["labels"]) + 1 :]}
    for column in numbers - ZERO.get(name, set()):
        for factor in (1.3, -1.0):
            wrong = found.assign(**{column: found[column].astype(float) * factor})
            assert differing(name, wrong) == {column}
    for column in ZERO.get(name, set()):
        assert (found[column] == 0).all()


FAULTS = {
    "a spin by a wrong lever": (
        mechanics,
        "_after_impulse",
        lambda right: (
            lambda state, body, *rest: right(
                state, body._replace(gyration=body.gyration * 1.1), *rest
            )
        ),
    ),
    "an impulse of the wrong sign": (
        mechanics,
        "_after_impulse",
        lambda right: (
            lambda state, body, m2, impulse, towards: right(state, body, m2, -impulse, towards)
        ),
    ),
    "the loss of energy": (
        mechanics,
        "energy_lost",
        lambda right: lambda *args: 1.3 * right(*args),
    ),
    "the normal force": (bodies, "peak_force", lambda right: lambda *args: 1.3 * right(*args)),
}


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("fault", FAULTS)
def test_a_fault_in_the_code_leaves_the_table(name, fault, monkeypatch):
    module, function, wrong = FAULTS[fault]
    monkeypatch.setattr(module, function, wrong(getattr(module, function)))
    assert differing(name, solved(name))


CHEAPER = {
    "rigid": lambda loss, *groups: rigid.rebound(*groups),
    "lumped.hysteretic": lambda loss, *groups: lumped.rebound(*groups),
    "lumped with the loss": lambda loss, *groups: lumped.rebound(
        *groups, loss={"viscous": "viscous"}.get(loss, "unloading-stiffness")
    ),
}


@pytest.mark.parametrize("name", ["shot_peening", "superball"])
@pytest.mark.parametrize("model", CHEAPER)
def test_a_cheaper_model_leaves_the_table(name, model, monkeypatch):
    """The cushion's impacts slide throughout: there every model has one answer."""

    def cheaply(*groups, loss, **settings):
        return CHEAPER[model](loss, *groups)

    monkeypatch.setattr(spheres, "rebound", cheaply)
    monkeypatch.setattr(continuum, "rebound", cheaply)
    column = "velocity_tangential_after" if name == "shot_peening" else "velocity_x_after"
    assert f"{column} [m/s]" in differing(name, solved(name))


@pytest.mark.parametrize("name", NAMES)
def test_the_other_loss_leaves_the_table(name):
    """Where contacts slide throughout, it still changes the forces."""
    (loss,) = set(pd.read_csv(ROOT / f"data/scenes/{name}.csv")["loss"])
    (other,) = set(continuum.LOSSES) - {loss}
    far = differing(name, solved(name, loss=other))
    assert {"peak_normal_force [N]", "peak_friction_force [N]"} <= far
    if name != "billiard_cushion":
        assert "energy_lost [J]" in far
