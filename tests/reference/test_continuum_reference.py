"""The scheme of annuli: its errors, and its table; the continua against second codes."""

import numpy as np
import pytest

from planarimpact import continuum
from tests.package_tables import annuli_tables
from tests.reference_solutions import annuli, cattaneo_mindlin, table_files


def read(name, model=None):
    """Numbers of a table, or of one model in it."""
    rows = [row for row in table_files.read(name) if row.get("model") == model]
    return np.array([list(row.values())[-4:] for row in rows], float)


@pytest.mark.parametrize(
    ("table", "loss", "e", "sigmas"),
    [
        ("elastic_continuum", None, 1.0, (1e-4, 2e-5, 2e-5)),
        ("inelastic_models", "viscous", 0.8, (8e-5, 1.5e-4, 4e-5)),
        ("inelastic_models", "plastic", 0.8, (8e-5, 1.5e-4, 4e-5)),
    ],
)
def test_velocities_forces_and_losses_are_those_of_a_second_code(table, loss, e, sigmas):
    """The tables of annuli, and of springs in plain time, within the sigmas of their sources."""
    model = f"continuum.{loss}" if loss else None
    x, *columns = read(f"{table}/rebound_grid", model)[3::7].T
    found = continuum.rebound(x, 3.5, 1.21, e, loss=loss, tolerance=5e-6 if e == 1 else 1e-4)
    for name, column, sigma in zip(found._fields, columns, sigmas, strict=False):
        assert np.max(np.abs(getattr(found, name) - column)) <= sigma, name


@pytest.mark.slow
@pytest.mark.long
def test_the_table_is_what_its_command_writes():
    """A row, computed anew with the same circles and steps."""
    (row,) = (row for row in read("maw1976/rebound_nu_0.3") if row[0] == 4)
    again = annuli_tables.checked(17 / 14, row[:1]).velocity
    np.testing.assert_allclose(again, row[1], atol=5.1e-6)


def test_annuli_under_constant_normal_force_are_cattaneo_and_mindlin():
    path = np.array([0.0, 0.3, 0.6, 0.9, 0.5, 0.1, -0.4, -0.9])
    force = annuli.friction(np.ones(8), path, circles=80)
    np.testing.assert_allclose(force[:4], cattaneo_mindlin.friction(path[:4]), atol=1e-4)
    np.testing.assert_allclose(force[3:], cattaneo_mindlin.unloading(path[3:], 0.9), atol=1e-4)
