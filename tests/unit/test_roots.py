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


def test_a_steep_end_does_not_pass_for_a_root():
    """The secant from there is nearly upright, and its step is nothing."""
    place = roots.crossing(
        lambda which, x: (0.716 - x - 1e-15 / (1 - x + 1e-30),), np.full(1, 0.4), np.ones(1)
    )
    np.testing.assert_allclose(place, 0.716, rtol=1e-13)
