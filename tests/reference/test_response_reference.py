"""Compiled responses against answers that share no code with them."""

import csv
from pathlib import Path

import numpy as np
import pytest

from planarimpact import continuum, response
from tests.reference_solutions import high_precision

DATA = Path(__file__).parents[2] / "data"
STEEL = 17 / 14  # nu = 0.3
TOLERANCE = 1e-5


def compiled(zeta2):
    return response.compile(
        "continuum", incidence_max=10, tolerance=TOLERANCE, mass_ratio=3.5, stiffness_ratio=zeta2
    )


@pytest.fixture(scope="module")
def steel():
    return compiled(STEEL)


@pytest.mark.parametrize("name", ["rebound_nu_0.3", "rebound_nu_0.5"])
def test_the_continuum_against_the_scheme_of_1976(name, steel):
    with open(DATA / "maw1976" / f"{name}.csv", newline="") as file:
        x, velocity = np.array(list(csv.reader(file))[1:], float).T
    found = steel if name == "rebound_nu_0.3" else compiled(1.5)
    assert np.abs(found.velocity(x) - velocity).max() < 1.2e-4


@pytest.mark.long
def test_the_continuum_against_itself_a_hundred_times_as_fine(steel):
    x = np.random.default_rng(8).uniform(0, 6, 40)
    exact = continuum.rebound(x, 3.5, STEEL, tolerance=1e-7)
    result = steel(x)
    for field in ("velocity", "peak_friction"):
        assert np.abs(getattr(result, field) - getattr(exact, field)).max() <= TOLERANCE
    np.testing.assert_array_equal(result.regime, exact.regime)


@pytest.mark.parametrize(
    "groups", [(3.5, 1.21, 1.0), (3.5, 1.21, 0.5), (8.0, 0.1, 0.9), (2.0, 5.0, 0.0)]
)
def test_the_lumped_model_against_40_digits(groups):
    names = "mass_ratio", "stiffness_ratio", "restitution"
    found = response.compile(
        "lumped.hysteretic",
        incidence_max=20,
        tolerance=1e-10,
        **dict(zip(names, groups, strict=True)),
    )
    for x in (0.013, 0.9, 2.3, -4.4, 7.1):
        exact = high_precision.rebound(x, *groups)
        result = found(x)
        for field in ("velocity", "peak_friction"):
            assert abs(getattr(result, field) - float(getattr(exact, field))) <= 1e-10
        assert abs(result.dissipation - float(exact.dissipation)) <= 1e-10 * max(1, abs(x))


def test_the_lumped_curve_of_fig_6_against_its_table():
    """At every threshold and the two numbers next to it, too."""
    with open(DATA / "lumped_40_digits/fig6_rebound.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    for e in (0.0, 0.5, 1.0):
        table = [list(row.values())[1:3] for row in rows if row["curve"] == f"e = {e:g}"]
        x, velocity = np.array(table, float).T
        found = response.compile(
            "lumped.hysteretic", incidence_max=8, tolerance=1e-10, restitution=e
        )
        assert x.size > 30 and np.abs(found.velocity(x) - velocity).max() <= 1e-10
