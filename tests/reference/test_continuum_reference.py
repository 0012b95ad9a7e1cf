"""The scheme of annuli: its errors, closed forms, and the table that it writes."""

import csv
from functools import partial
from pathlib import Path

import numpy as np
import pytest

from planarimpact import continuum
from planarimpact.continuum import annuli, cattaneo_mindlin
from tests.package_tables import annuli_tables

STEEL = 17 / 14
DATA = Path(__file__).parents[2] / "data"


def read(name):
    """Rows of a table of numbers."""
    with open(DATA / name, newline="", encoding="utf-8") as file:
        return np.array([[float(cell) for cell in row] for row in [*csv.reader(file)][1:]])


def rebounds(x):
    """Those of spheres of steel at some incidences."""
    rows = read("maw1976/rebound_nu_0.3.csv")
    return rows[np.isin(rows[:, 0], x), 1]


def test_the_two_methods_agree_in_forces_and_losses():
    """The table of data/elastic_continuum, by annuli, within the sigmas of its source."""
    x, *columns = read("elastic_continuum/rebound_grid.csv")[3::7].T
    found = continuum.rebound(x, 3.5, 1.21, tolerance=5e-6)
    for name, column, sigma in zip(found._fields, columns, (1e-4, 2e-5, 2e-5), strict=False):
        assert np.max(np.abs(getattr(found, name) - column)) <= sigma, name


@pytest.mark.slow
@pytest.mark.long
def test_the_table_is_what_its_command_writes():
    """A row, computed anew with the same circles and steps."""
    x = np.array([4.0])
    again = annuli_tables.table(STEEL, incidence=x)
    np.testing.assert_allclose(again, rebounds(x), atol=5.1e-6)


def test_the_table_is_not_written_where_the_methods_differ(monkeypatch, tmp_path):
    monkeypatch.setattr(annuli_tables, "CIRCLES", 16)
    monkeypatch.setattr(annuli_tables, "STEPS", 64)
    monkeypatch.setattr(annuli_tables.table, "__defaults__", (np.array([2.0]),))
    monkeypatch.setattr(continuum, "rebound", partial(continuum.rebound, tolerance=1e-4))
    with pytest.raises(SystemExit, match="the two methods differ by"):
        annuli_tables.write(tmp_path)
    assert not list(tmp_path.iterdir())


def test_annuli_converge_with_the_square_of_the_circles():
    """To the table, extrapolated too: its own circles are four times as many."""
    x = np.array([2.0, 3.0, 4.0])  # where the steps matter least
    exact = rebounds(x)
    circles = 4, 8, 16, 32
    found = [annuli.rebound(x, 3.5, STEEL, circles=n, steps=1024).velocity for n in circles]
    error = np.max(np.abs(found - exact), axis=1)
    assert all(3.0 < a / b < 5.5 for a, b in zip(error, error[1:], strict=False)), error
    assert 1.8 < -np.polyfit(np.log(circles), np.log(error), 1)[0] < 2.2, error
    assert np.max(np.abs(found[3] + (found[3] - found[2]) / 3 - exact)) < 5e-5


def test_annuli_converge_with_the_steps():
    x = np.array([0.5, 0.9, 1.2])  # where the steps matter most
    *found, finest = (
        annuli.rebound(x, 3.5, STEEL, circles=12, steps=n).velocity for n in (128, 256, 512, 4096)
    )
    error = np.max(np.abs(np.array(found) - finest), axis=1)
    assert all(2.0 < a / b < 4.5 for a, b in zip(error, error[1:], strict=False)), error


def test_annuli_under_constant_normal_force_are_cattaneo_and_mindlin():
    path = [0.0, 0.3, 0.6, 0.9, 0.5, 0.1, -0.4, -0.9]
    force = annuli.friction(np.ones(8), path, circles=80)
    np.testing.assert_allclose(force[:4], cattaneo_mindlin.friction(path[:4]), atol=1e-4)
    np.testing.assert_allclose(force[3:], cattaneo_mindlin.unloading(path[3:], 0.9), atol=1e-4)
