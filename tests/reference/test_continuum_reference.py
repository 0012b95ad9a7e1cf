"""The scheme of annuli: its errors, and its table; the continua against second codes."""

import numpy as np
import pytest

from planarimpact import continuum
from tests.package_tables import annuli_tables
from tests.reference_solutions import annuli, cattaneo_mindlin, inelastic_contact, table_files

# Error of the second code of the continuum with a loss, extrapolated from 800 and 1600 steps. With
# twice as many steps its answers change by up to 3.4e-4 (e = 0.9, next to x = zeta^2), with four
# times as many by 2e-5 more.
SECOND_CODE = 5e-4
MORE = [(0.9, 3.5, 1.21), (0.7, 7.5, 0.85), (0.5, 1.2, 1.9)]


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


@pytest.mark.parametrize("loss", continuum.LOSSES)
@pytest.mark.parametrize(
    ("e", "beta", "zeta2"),
    [(0.35, 2.5, 0.9), *(pytest.param(*case, marks=pytest.mark.long) for case in MORE)],
)
def test_velocities_meet_their_tolerance_by_a_second_code(loss, e, beta, zeta2):
    limit = float(continuum.slip_throughout_limit(beta, zeta2, e, loss=loss))
    # In each regime, and next to each threshold.
    x = np.array([0.3 * zeta2, 0.99 * zeta2, 1.01 * zeta2, 0.98 * beta, (beta + limit) / 2])
    x = np.minimum([*x, 0.97 * limit], 0.97 * limit)
    model, groups = f"continuum.{loss}", (beta, zeta2, e)
    coarse, fine = (inelastic_contact.rebound(model, x, *groups, n, n // 4) for n in (800, 1600))
    second = 2 * fine - coarse  # its error falls with the number of steps
    for tolerance in (1e-2, 1e-3, 1e-4):
        found = continuum.rebound(x, *groups, loss=loss, tolerance=tolerance)
        np.testing.assert_allclose(found.velocity, second, atol=tolerance + SECOND_CODE)


@pytest.mark.slow
@pytest.mark.long
def test_the_table_is_what_its_command_writes():
    """A row, computed anew with the same circles and steps."""
    (row,) = (row for row in read("maw1976/rebound_nu_0.3") if row[0] == 4)
    again = annuli_tables.checked(17 / 14, (row[0],)).velocity
    np.testing.assert_allclose(again, row[1], atol=5.1e-6)


def test_annuli_under_constant_normal_force_are_cattaneo_and_mindlin():
    path = np.array([0.0, 0.3, 0.6, 0.9, 0.5, 0.1, -0.4, -0.9])
    force = annuli.friction(np.ones(8), path, circles=80)
    np.testing.assert_allclose(force[:4], cattaneo_mindlin.friction(path[:4]), atol=1e-4)
    np.testing.assert_allclose(force[3:], cattaneo_mindlin.unloading(path[3:], 0.9), atol=1e-4)
