"""The figure stability: what counts as a correct digit, and impacts that fail."""

import warnings

import numpy as np
import pytest

from planarimpact import lumped
from stronge1994 import tables
from stronge1994.studies.stability import curves as stability

X = [0.0, 0.5, 2.0, 8.0]


def answers(x, zeta2=1.21, phases=1):
    """A table of impacts, with the solver's own answers taken as exact."""
    x = np.atleast_1d(x)
    same = {"mass_ratio": 3.5, "stiffness_ratio": zeta2, "restitution": 1.0, "phases": phases}
    table = {"incidence": x} | {name: np.full(x.size, value) for name, value in same.items()}
    exact = lumped.rebound(x, 3.5, zeta2)
    for name in stability.OUTPUTS:
        table |= {name: np.array(getattr(exact, name)), f"condition_{name}": x.copy()}
    return table


@pytest.fixture
def points():
    """Four impacts, of which two are followed through their phases."""
    return answers(X) | {"phases": [1, 2, 3, 1]}


def variant(name, points):
    """Columns of one variant of the curves of some points."""
    own = tables.select(stability.curves(points, 10), variant=name)
    return {column: values.to_numpy() for column, values in own.items()}


def test_digits_are_lost_beyond_what_the_condition_allows(points):
    points["velocity"][3] *= 1 + 1e-12
    points["condition_velocity"][3] = 999.0
    found = variant("impacts", points)
    assert found["digits_velocity [1]"][3] == pytest.approx(12, abs=1e-3)
    assert found["digits_allowed_velocity [1]"][3] == pytest.approx(52 * np.log10(2) - 3)
    assert found["digits_lost [1]"][3] == pytest.approx(0.653, abs=1e-3)


@pytest.mark.parametrize("how", ["warns", "gives NaN"])
def test_one_impact_that_fails_has_no_digits_and_stops_no_other(points, how, monkeypatch):
    rebound = lumped.rebound

    def failing(incidence, *groups):
        found = rebound(incidence, *groups)
        if how == "gives NaN":
            return found._replace(velocity=np.where(incidence == 2.0, np.nan, found.velocity))
        if 2.0 in incidence:
            warnings.warn("oh", RuntimeWarning, stacklevel=2)
        return found

    monkeypatch.setattr(lumped, "rebound", failing)
    found = variant("impacts", points)
    assert found["digits_lost [1]"].tolist() == [0, 0, stability.DIGITS, 0]


@pytest.mark.parametrize(("friction", "excess"), [(-1.5, 0.5), (np.nan, 1.0)])
def test_friction_beyond_its_limit_is_found_in_either_direction(
    points, friction, excess, monkeypatch
):
    history = lumped.history

    def wrong(*group, samples):
        found = history(*group, samples)
        at_peak = found.normal == found.normal.max()  # at maximum compression, N = 1
        return found._replace(friction_force=np.where(at_peak, friction, found.friction_force))

    monkeypatch.setattr(lumped, "history", wrong)
    found = variant("contacts", points)
    assert found["friction_excess [mu F2max]"] == pytest.approx([excess] * 2)


def test_a_contact_that_cannot_be_followed_counts_as_wrong(points, monkeypatch):
    monkeypatch.delattr(lumped, "history")
    found = variant("contacts", points)
    assert found["friction_excess [mu F2max]"].tolist() == [1, 1]
    assert found["energy_residual [1]"].tolist() == [1, 1]


@pytest.mark.parametrize(
    ("x", "zeta2", "most_work"),
    [
        (2.0, 1.21, 2.0 * 2.0 / 7),  # all tangential energy
        (900.0, 1e3, 2 * 900.0),  # friction at its limit over the whole contact
    ],
)
def test_energy_is_compared_with_the_most_work_of_friction(x, zeta2, most_work, monkeypatch):
    table = answers(x, zeta2, phases=2) | {"condition_dissipation": [0.0]}
    exact = lumped.rebound(x, 3.5, zeta2)
    wrong = exact._replace(dissipation=exact.dissipation + 1e-6 * most_work)
    monkeypatch.setattr(lumped, "rebound", lambda *group: wrong)
    found = variant("contacts", table)
    assert found["energy_residual [1]"] == pytest.approx([1e-6])
