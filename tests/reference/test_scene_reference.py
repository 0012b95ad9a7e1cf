"""A scene keeps its tolerance against the reference rung; its tables are what they say."""

import functools
from pathlib import Path
from typing import NamedTuple

import gap_tables
import numpy as np
import pandas as pd
import pytest
import scene_tables

from planarimpact import bodies, continuum, lumped, models, rigid, scene
from planarimpact.scene import gaps

DATA = Path(__file__).parents[2] / "data" / "scenes"


def random_scene(rng, restitutions, count, pairs):
    """Random pairs, plane impacts of all regimes."""
    pair = rng.integers(0, pairs, count)
    spread = rng.uniform(0, 8, count) * rng.choice([1.0, 0.05], count)
    friction, normal = rng.uniform(0.02, 1.0, pairs)[pair], rng.uniform(0.1, 5.0, count)
    return pd.DataFrame(
        {
            "radius [m]": 0.01,
            "mass [kg]": 0.03,
            "gyration [m]": rng.uniform(0.004, 0.02, pairs)[pair],
            "young_modulus [Pa]": 10 ** rng.uniform(9, 11, pairs)[pair],
            "poisson_ratio": rng.uniform(0.0, 0.5, pairs)[pair],
            "friction": friction,
            "restitution": rng.choice(restitutions, pairs)[pair],
            "velocity_tangential [m/s]": spread * friction * normal,
            "velocity_normal [m/s]": normal,
            "spin [rad/s]": 0.0,
        }
    )


class Scene(NamedTuple):
    """Rows of a table, and what the reference rung says of them, in its units."""

    rows: pd.DataFrame
    unit: np.ndarray
    velocity: np.ndarray
    peak: np.ndarray


@functools.cache
def solved(restitutions, count, pairs):
    rows = random_scene(np.random.default_rng(count), restitutions, count, pairs)
    ball = bodies.Body(*(rows[f"{name}"].to_numpy() for name in BODY))
    material = bodies.Material(rows["young_modulus [Pa]"].to_numpy(), rows["poisson_ratio"])
    beta, zeta2 = bodies.mass_ratio(ball), bodies.stiffness_ratio(material)
    unit = rows["friction"] * rows["velocity_normal [m/s]"]
    x, e = (rows["velocity_tangential [m/s]"] / unit).to_numpy(), rows["restitution"].to_numpy()
    velocity, peak = (np.array(field) for field in lumped.rebound(x, beta, zeta2, e)[:2])
    elastic = e == 1
    exact = continuum.rebound(x[elastic], beta[elastic], zeta2[elastic], tolerance=1e-5)
    velocity[elastic], peak[elastic] = exact[:2]
    return Scene(rows, unit, velocity, peak)


def errors(known, after):
    """Errors of velocity and peak friction, and that of velocity as promised."""
    rows, unit, velocity, peak = known
    contact = after["velocity_tangential_after [m/s]"] + 0.01 * after["spin_after [rad/s]"]
    force = after["peak_friction_force [N]"] / after["peak_normal_force [N]"] / rows["friction"]
    return np.abs(contact / unit - velocity), np.abs(force - peak), after["error [m/s]"] / unit


BODY = "mass [kg]", "gyration [m]", "radius [m]"


@pytest.mark.parametrize("tolerance", [0.5, 0.1, 1e-2, 1e-3])
@pytest.mark.parametrize(
    ("restitutions", "count", "pairs"),
    [((0.0, 0.3, 0.7, 0.95), 3000, 6), ((1.0,), 400, 3), ((1.0, 0.5), 150, 150)],
    ids=["inelastic", "elastic", "few of each"],
)
def test_a_scene_keeps_its_tolerance(tolerance, restitutions, count, pairs):
    known = solved(restitutions, count, pairs)
    velocity, peak, promised = errors(known, scene.solve(known.rows, tolerance))
    slack = 1.1e-5  # of the reference
    assert max(velocity.max(), peak.max()) <= tolerance + slack
    assert (velocity <= promised + slack).all() and promised.max() <= tolerance * (1 + 1e-12)


def test_a_wrong_rung_breaks_the_tolerance(monkeypatch):
    """The test above can fail: a table of gaps that promises too much lets a coarse model in."""
    known = solved((1.0,), 400, 3)
    monkeypatch.setattr(gaps, "MARGIN", 1e-3)
    velocity, _, _ = errors(known, scene.solve(known.rows, 1e-2))
    assert velocity.max() > 2e-2


@pytest.mark.slow
def test_gaps_hold_between_the_entries_of_their_table():
    rng = np.random.default_rng(4)
    for chi in 0.5 * 2.0 ** rng.uniform(0, 4, 5):
        for name, model in (("lumped", lumped), ("rigid", rigid)):
            found = gap_tables.largest(model, chi)
            assert max(found) <= gaps.elastic(name, 2 * chi, 1.0) + 1e-3


@pytest.mark.slow
def test_gaps_are_not_idle():
    """They are near the largest error: at most a fifth more, over the table."""
    for place in (8, 16, 24, 32):
        chi = gaps.CHI[place]
        assert gaps.elastic("lumped", 2 * chi, 1.0) <= 1.2 * max(gap_tables.largest(lumped, chi))


@pytest.mark.parametrize("name", list(scene_tables.SCENES))
def test_example_scenes_are_made_as_stated(name):
    made, there = scene_tables.SCENES[name](), pd.read_csv(DATA / f"{name}.csv")
    pd.testing.assert_frame_equal(made, there, rtol=1e-9, check_dtype=False)
    assert len(scene.solve(there)) == len(there)


def test_a_wrong_rung_breaks_the_tolerance(monkeypatch):
    """The test above can fail: a table of gaps that promises too much lets a coarse model in."""
    known = solved("elastic, many of each")
    monkeypatch.setattr(gaps, "MARGIN", 1e-3)
    velocity, _, _ = errors(known, scene.solve(known.rows, 1e-2))
    assert velocity.max() > 2e-2


@pytest.mark.parametrize("name", ["many of each", "few of each", "viscous material"])
def test_a_wrong_loss_breaks_the_tolerance(name, monkeypatch):
    """So does the continuum of the other loss."""
    elastic, viscous, plastic = choice.REFERENCES
    monkeypatch.setattr(choice, "REFERENCES", (elastic, plastic, viscous))
    known = solved(name)
    velocity, _, _ = errors(known, scene.solve(known.rows, 1e-2))
    assert velocity.max() > 5e-2


def test_the_lumped_model_of_the_loss_breaks_the_tolerance(monkeypatch):
    """So does the lumped model, with either loss."""
    known = solved("few of each")
    monkeypatch.setattr(models, "rebound", lumped_instead)
    velocity, _, _ = errors(known, scene.solve(known.rows, 1e-2))
    for loss in continuum.LOSSES:
        assert velocity[known.rows["loss"] == loss].max() > 5e-2


def lumped_instead(model, *groups, tolerance):
    return lumped.rebound(*groups, loss=model.partition(".")[2] or "hysteretic")


@pytest.mark.slow
def test_gaps_hold_between_the_entries_of_their_table():
    rng = np.random.default_rng(4)
    for chi in 0.5 * 2.0 ** rng.uniform(0, 4, 5):
        for name, model in (("lumped", lumped), ("rigid", rigid)):
            found = gap_tables.largest(model, chi)
            assert max(found) <= gaps.elastic(name, 2 * chi, 1.0) + 1e-3


@pytest.mark.slow
def test_gaps_are_not_idle():
    """They are near the largest error: at most a fifth more, over the table."""
    for place in (8, 16, 24, 32):
        chi = gaps.CHI[place]
        assert gaps.elastic("lumped", 2 * chi, 1.0) <= 1.2 * max(gap_tables.largest(lumped, chi))


@pytest.mark.parametrize("name", list(scene_tables.SCENES))
def test_example_scenes_are_made_as_stated(name):
    made, there = scene_tables.SCENES[name](), pd.read_csv(DATA / f"{name}.csv")
    pd.testing.assert_frame_equal(made, there, rtol=1e-9, check_dtype=False)
    assert len(scene.solve(there)) == len(there)
