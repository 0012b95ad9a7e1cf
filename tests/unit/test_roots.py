"""The finder of events: every number of derivatives, every kind of corner."""

import numpy as np
import pytest

from planarimpact.common import roots

PLACES = np.array([1e-70, 1e-8, 0.3, 1 - 1e-12, 1.0, 7.0, 1e12])


def cubic(which, x):
    """Falls through PLACES, and is steep on one side."""
    ratio = x / PLACES[which]
    return 1 - ratio**3, -3 * ratio**2 / PLACES[which], -6 * ratio / PLACES[which] ** 2


@pytest.mark.parametrize("known", [0, 1, 2, 3])
@pytest.mark.parametrize("width", [1.0, 1 + 1e-9, 50.0])
def test_places_are_right_to_rounding(known, width):
    """By a sign alone, the value, or with derivatives."""

    def function(which, x):
        return cubic(which, x)[:known] or (np.where(x < PLACES[which], 1.0, -1.0),)

    with np.errstate(over="ignore", under="ignore", invalid="ignore", divide="ignore"):
        place = roots.crossing(function, np.zeros(PLACES.size), width * PLACES)
    np.testing.assert_allclose(place, PLACES, rtol=3e-15)


def test_a_coarse_place_costs_few_turns():
    turns = []

    def function(which, x):
        turns.append(x.size)
        return (np.where(x < 0.3, 1.0, -1.0),)

    place = roots.crossing(function, np.zeros(1), np.ones(1), resolution=2.0**-10)
    assert abs(place[0] - 0.3) < 2.0**-9
    assert len(turns) <= 12


def test_a_function_that_stays_positive_ends_at_the_end():
    place = roots.crossing(lambda which, x: (1 + x, 1 + 0 * x), np.zeros(2), np.array([1.0, 5.0]))
    np.testing.assert_allclose(place, [1.0, 5.0], rtol=1e-14)


def test_steps_without_a_bracket_come_back_to_it():
    """From 0 the first step leaves the bracket, or is no number."""
    place = roots.crossing(
        lambda which, x: (1 - x * x, -2 * x),
        np.zeros(1),
        np.ones(1) * 4,
        start=np.zeros(1),
        unguarded=3,
    )
    np.testing.assert_allclose(place, 1.0, rtol=1e-15)


def test_a_steep_end_does_not_pass_for_a_root():
    """The secant from there is nearly upright, and its step is nothing."""
    place = roots.crossing(
        lambda which, x: (0.716 - x - 1e-15 / (1 - x + 1e-30),), np.full(1, 0.4), np.ones(1)
    )
    np.testing.assert_allclose(place, 0.716, rtol=1e-13)
