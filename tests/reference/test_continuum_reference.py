"""The elastic continuum against independent methods, and the facts known about it."""

import csv
import functools
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from planarimpact import Regime, continuum, lumped
from planarimpact.continuum import annuli, cattaneo_mindlin
from tests.package_tables import annuli_tables

ROOT = Path(__file__).parents[2]
STEEL, RUBBER = 17 / 14, 1.5
SOLVER = functools.partial(continuum.rebound, tolerance=1e-5)
SCHEME = functools.partial(annuli.rebound, circles=16, steps=4096)
# Of forces, velocity, radii of contact and of stick: the own error of the springs (at most 5e-5,
# 1e-4 and 5e-4 in friction, velocity and stick), and in gross slip the chord between vertices.
HISTORY_SIGMA = 5e-5, 5e-5, 2e-4, 5e-5, 5e-4


def no_slip(ratio):
    """Velocity over incidence with infinite friction, from its linear equations of motion.

    Lyashenko & Popov 2015: only mass ratio over stiffness ratio matters. A spring that comes
    into contact has no deflection; one that leaves takes its own away.
    """
    to_maximum = 1.4716375921623508

    def motion(t, state, entered=None):
        depth, approach, travel, w, force = state
        radius = np.sqrt(max(depth, 0.0))
        rate = radius * w
        if entered is not None and radius > 0:
            lost = travel - entered(2 * to_maximum - t)[2]
            rate += approach / (2 * radius) * lost
        return [approach, -1.25 * radius**3, w, -ratio * 1.25 * force, 1.5 * rate]

    settings = {"rtol": 1e-10, "atol": 1e-12, "max_step": 0.01}
    half = solve_ivp(motion, (0, to_maximum), [0, 1, 0, 1, 0], dense_output=True, **settings)
    end = 2 * to_maximum - 1e-6
    rest = solve_ivp(motion, (to_maximum, end), half.y[:, -1], args=(half.sol,), **settings)
    return rest.y[3, -1]


def read(path):
    with open(ROOT / "data" / path, newline="", encoding="utf-8") as file:
        return np.array([[float(cell) for cell in row] for row in list(csv.reader(file))[1:]])


@pytest.mark.parametrize("name", annuli_tables.STIFFNESS_RATIO)
def test_the_two_methods_agree(name):
    """The table of data/maw1976, by annuli, against the continuum solver."""
    x, w = read(f"maw1976/{name}.csv").T
    ratio = annuli_tables.STIFFNESS_RATIO[name]
    assert x[0] == 0 and x[-1] == 10 and len(x) == 101
    found = continuum.rebound(x, 3.5, ratio, tolerance=1e-5).velocity
    assert np.max(np.abs(found - w)) <= 1e-4


def test_the_two_methods_agree_in_forces_and_losses():
    """The table of data/elastic_continuum, by annuli, within the sigmas of its source."""
    x, *columns = read("elastic_continuum/rebound_grid.csv").T
    found = continuum.rebound(x, 3.5, 1.21, tolerance=5e-6)
    for name, column, sigma in zip(found._fields, columns, (1e-4, 2e-5, 2e-5), strict=False):
        assert np.max(np.abs(getattr(found, name) - column)) <= sigma, name


def test_histories_are_those_of_a_row_of_springs():
    """The table of data/elastic_continuum, by 4000 springs."""
    path = ROOT / "data/elastic_continuum/micro_slip_instants.csv"
    with open(path, newline="", encoding="utf-8") as file:
        rows = list(csv.reader(file))[1:]
    for curve in dict.fromkeys(row[0] for row in rows):
        time, *columns = np.array([row[1:] for row in rows if row[0] == curve], float).T
        found = continuum.history(float(curve.split("= ")[1]), 3.5, 1.21, tolerance=1e-5)
        for name, column, sigma in zip(found._fields[1:], columns, HISTORY_SIGMA, strict=True):
            between = np.interp(time, found.time, getattr(found, name))
            assert np.max(np.abs(between - column)) <= sigma, (curve, name)


@pytest.mark.slow
@pytest.mark.long
def test_the_table_is_what_its_command_writes():
    """A row, computed anew with the same circles and steps."""
    x = np.array([4.0])
    again = annuli_tables.table(STEEL, incidence=x)
    rows = read("maw1976/rebound_nu_0.3.csv")
    np.testing.assert_allclose(again, rows[np.isin(rows[:, 0], x), 1], atol=5.1e-6)


def test_the_table_is_not_written_where_the_methods_differ(monkeypatch, tmp_path):
    monkeypatch.setattr(annuli_tables, "CIRCLES", 16)
    monkeypatch.setattr(annuli_tables, "STEPS", 64)
    with pytest.raises(SystemExit, match="the two methods differ by"):
        annuli_tables.write(tmp_path)
    assert not list(tmp_path.iterdir())


def test_the_two_methods_agree_elsewhere():
    """At the corners of a box of groups, and within it, over all incidences."""
    beta, zeta2 = np.array([[1, 0.3], [1, 5], [8, 0.3], [8, 5], [2.5, 1.5]]).T[..., None]
    limit = lumped.slip_throughout_limit(beta, zeta2)
    x = np.array([0.1, 0.3, 0.5, 0.7, 0.9, 1.05]) * limit
    exact = continuum.rebound(x, beta, zeta2, tolerance=1e-5)
    scheme = annuli.rebound(x, beta, zeta2, circles=40, steps=2000)
    error = np.abs(scheme.velocity - exact.velocity)
    assert (error <= 3e-4 * np.maximum(1, limit / 6)).all()
    np.testing.assert_allclose(scheme.peak_friction, exact.peak_friction, atol=1e-3)
    np.testing.assert_array_equal(scheme.regime, exact.regime)
    np.testing.assert_array_equal(scheme.reversals, exact.reversals)


def test_error_falls_with_the_square_of_the_steps_and_better_extrapolated():
    x = np.linspace(0.1, 5.7, 60)
    exact = continuum.fixed_steps(x, 3.5, STEEL, 4096, True)
    errors = []
    for steps in (64, 128, 256, 512, 1024):
        answers = [continuum.fixed_steps(x, 3.5, STEEL, steps, better) for better in (0, 1)]
        errors.append(np.sqrt(np.mean(np.square(answers - exact), axis=1)))
    plain, extrapolated = np.log2(np.array(errors)[:-1] / np.array(errors)[1:]).T
    assert (np.abs(plain - 2) < 0.1).all(), plain
    assert np.mean(extrapolated) > 2.2, extrapolated


def test_annuli_converge_with_the_square_of_the_circles():
    """To the table, extrapolated too: its own circles are four times as many."""
    rows = read("maw1976/rebound_nu_0.3.csv")
    x = np.array([2.0, 3.0, 4.0])  # where the steps matter least
    exact = rows[np.isin(rows[:, 0], x), 1]
    circles = 4, 8, 16, 32
    found = [annuli.rebound(x, 3.5, STEEL, circles=n, steps=1024).velocity for n in circles]
    error = np.max(np.abs(found - exact), axis=1)
    assert all(3.0 < a / b < 5.5 for a, b in zip(error, error[1:], strict=False)), error
    assert 1.8 < -np.polyfit(np.log(circles), np.log(error), 1)[0] < 2.2, error
    assert np.max(np.abs(found[3] + (found[3] - found[2]) / 3 - exact)) < 5e-5


def test_annuli_converge_with_the_steps():
    x = np.array([0.5, 0.9, 1.2])  # where the steps matter most
    *found, finest = (
        annuli.rebound(x, 3.5, STEEL, circles=24, steps=n).velocity for n in (256, 512, 1024, 8192)
    )
    error = np.max(np.abs(np.array(found) - finest), axis=1)
    assert all(2.0 < a / b < 4.5 for a, b in zip(error, error[1:], strict=False)), error


def test_annuli_under_constant_normal_force_are_cattaneo_and_mindlin():
    path = [0.0, 0.3, 0.6, 0.9, 0.5, 0.1, -0.4, -0.9]
    force = annuli.friction(np.ones(8), path, circles=80)
    np.testing.assert_allclose(force[:4], cattaneo_mindlin.friction(path[:4]), atol=1e-4)
    np.testing.assert_allclose(force[3:], cattaneo_mindlin.unloading(path[3:], 0.9), atol=1e-4)


def test_thresholds_of_the_regimes():
    """Gross slip at the start from psi1 = 1 on, throughout from psi1 = 4 chi - 1 on.

    The scheme of annuli, which knows no threshold, finds them too.
    """
    zeta2 = np.array([STEEL, RUBBER, 0.4])
    for at, below, above in (
        (1.0, Regime.STICK_SLIP, Regime.SLIP_STICK_SLIP),
        (7 / zeta2 - 1, Regime.SLIP_STICK_SLIP, Regime.SLIP_THROUGHOUT),
    ):
        for solve, gap in ((SOLVER, 1e-6), (SCHEME, 0.02)):
            near = 1 + gap * np.array([[-1], [1]])
            found = solve(zeta2 * at * near, 3.5, zeta2).regime
            assert (found == [[below], [above]]).all(), (solve, found)


def test_reversals_of_the_tangential_force_grow_with_chi():
    chi = np.array([0.75, 1.44, 3.0, 6.0, 12.0, 20.0, 40.0])
    found = continuum.rebound(1.2 * STEEL, 2 * STEEL * chi, STEEL, tolerance=1e-4).reversals
    assert found[0] == 1 and (np.diff(found) >= 0).all() and found[-1] >= 8


def test_rebound_at_psi1_of_1_2_changes_its_sign_with_chi():
    chi = np.array([1.0, 1.44, 2.0, 3.0, 4.0, 5.0])
    found = continuum.rebound(1.2 * STEEL, 2 * STEEL * chi, STEEL, tolerance=1e-4).velocity
    assert list(np.sign(found)) == [-1, -1, 1, 1, -1, -1]


@pytest.mark.parametrize("ratio", [0.5, 3.5 / STEEL, 8.0, 30.0])
def test_infinite_friction_is_the_contact_without_slip(ratio):
    """Only mass ratio over stiffness ratio matters (Lyashenko & Popov 2015)."""
    x = 1e-5
    zeta2 = np.array([0.2, 1.2, 5.0])
    zeta2 = zeta2[ratio * zeta2 >= 1]
    found = continuum.rebound(x, ratio * zeta2, zeta2, tolerance=1e-10).velocity / x
    np.testing.assert_allclose(found, no_slip(ratio), atol=2e-5)


def test_without_friction_the_tangential_velocity_stays():
    """mu -> 0 at a fixed angle: v1(tf)/v1(0) = w/x -> 1."""
    mu = np.array([1e-2, 1e-4, 1e-6])
    result = continuum.rebound(1 / mu)
    np.testing.assert_allclose(result.velocity * mu, 1 - 7 * mu, rtol=1e-15)


def test_the_finite_elements_lie_between_bounds_of_compliance():
    """Within 2 sigmas of 0.031, and of what Maw et al. leave out of the surface displacement.

    Elliptic traction displaces the surface like 4 (2 - nu) a^2 - (4 - 3 nu) x^2 - (4 - nu) y^2;
    the mean over the angle is kept, and nu/(4 - 2 nu) = 9 % of its curvature left out either way.
    So the elements may lie between the curves with so much more and less compliance.
    """
    series = read("chung_ooi2011/rebound.csv").T
    left_out = 0.3 / 3.4
    x = np.linspace(0, 14, 2801)
    bounds = [
        continuum.rebound(x, 3.5, STEEL * share, tolerance=1e-4).velocity
        for share in (1 - left_out, 1, 1 + left_out)
    ]
    low, high = np.min(bounds, axis=0), np.max(bounds, axis=0)
    inside = (np.interp(series[0], x, low) <= series[1]) & (
        series[1] <= np.interp(series[0], x, high)
    )
    gap = [
        min(np.min(np.hypot(x - px, edge - py)) for edge in (low, high)) / 0.031
        for px, py in series.T
    ]
    gap = np.where(inside, 0.0, gap)
    assert np.sqrt(np.mean(gap**2)) < 1.0 and gap.max() < 2.0, gap


def assert_met(seed, finest, *tolerances):
    """Impacts all over the box meet each tolerance, against an answer for the finest one."""
    rng = np.random.default_rng(seed)
    beta, zeta2 = rng.uniform(1, 20, 150), 10 ** rng.uniform(-1, 1, 150)
    x = rng.uniform(0, 1, 150) * lumped.slip_throughout_limit(beta, zeta2)
    exact = continuum.rebound(x, beta, zeta2, tolerance=finest)
    for tolerance in tolerances:
        found = continuum.rebound(x, beta, zeta2, tolerance=tolerance)
        for field in ("velocity", "peak_friction"):
            error = np.abs(getattr(found, field) - getattr(exact, field))
            assert np.max(error) <= tolerance, (tolerance, field)


def test_a_coarse_tolerance_is_met_over_the_box():
    """The own error of the exact answer is fifty times smaller at least."""
    assert_met(0, 2e-5, 1e-2, 1e-3)


@pytest.mark.slow
@pytest.mark.long
@pytest.mark.parametrize("seed", [0, 1, 2])
def test_fine_tolerances_are_met_over_the_box(seed):
    assert_met(seed, 2e-6, 1e-2, 1e-3, 1e-4)


def test_the_end_of_slip_within_a_step_is_not_missed():
    """Repeated stick and slip, where a missed turning point would cost 1e-4 by chance."""
    groups = 3.0721553278340115, 2.916339839549625, 0.19124359805672045
    exact = continuum.rebound(*groups, tolerance=1e-7)
    assert exact.regime == Regime.MULTIPLE
    for steps in (128, 256, 512):
        assert abs(continuum.fixed_steps(*groups, steps, True) - exact.velocity) < 1e-5


@pytest.mark.slow
def test_the_estimate_survives_a_change_that_vanishes_by_chance():
    """From 256 to 512 steps the extrapolated answer moves by 1e-6, and is wrong by 3.4e-4."""
    groups = 8.823256960990886, 18.56038953662075, 0.3168530116148592
    exact = continuum.fixed_steps(*groups, 4096, True)  # 8192 steps change it by 3e-8
    for tolerance in (1e-3, 5e-4, 3e-4, 1e-4):
        assert abs(continuum.rebound(*groups, tolerance=tolerance).velocity - exact) <= tolerance
