"""The metric and the verdicts: each must be able to fail."""

import numpy as np
import pytest

from planarimpact import landmarks
from planarimpact.comparison import (
    Distance,
    Verdict,
    curve_residuals,
    difference_residuals,
    distances_to_polyline,
    fact_residuals,
    judge,
    vertex_residuals,
)

LINE = (np.linspace(0, 2, 21), np.abs(np.linspace(0, 2, 21) - 1.0))


def test_points_on_the_curve_have_no_distance_even_at_the_kink():
    x = np.array([0.0, 0.95, 1.0, 1.05, 2.0])
    assert curve_residuals((x, np.abs(x - 1)), LINE, (0.1, 0.1)).summary().max < 1e-12


def test_distance_is_shortest_in_sigmas_not_vertical():
    # A shift of 0.1 along x of a line of slope 1 is 0.1/sqrt(2) away.
    x = np.array([1.5])
    assert distances_to_polyline(x, x - 1.1, *LINE, 1.0, 1.0)[0] == pytest.approx(0.1 / np.sqrt(2))


def test_sigma_scales_the_axes():
    near = curve_residuals(([1.0], [-0.2]), LINE, (1e6, 0.1)).summary()
    assert near.max == pytest.approx(2.0)
    assert near.plain_rms == pytest.approx(0.2)


def test_spike_between_points_is_seen_both_ways_only():
    spiked = (LINE[0], LINE[1].copy())
    spiked[1][3] = 5.0
    points = LINE[0][::4], LINE[1][::4]
    assert curve_residuals(points, spiked, (0.1, 0.1)).summary().max < 1e-9
    assert curve_residuals(points, spiked, (0.1, 0.1), both_ways=True).summary().max > 10


def test_sides_are_those_on_which_the_reference_lies():
    points = [0.5, 1.5], [0.6, 0.4]
    assert np.sign(curve_residuals(points, LINE, (1, 1)).sigmas).tolist() == [1, -1]
    # The line of two points passes over the kink of the curve.
    found = curve_residuals(([0.0, 2.0], [1.0, 1.0]), LINE, (1, 1), both_ways=True)
    assert found.x[2 + 10] == 1.0 and found.sigmas[2 + 10] == 1.0
    assert vertex_residuals(([0.0], [3.0], [""]), ([0.0], [1.0], [""]), (1, 1)).sigmas[0] == 2
    assert fact_residuals(3.0, {"value": 1.0, "tolerance": 1.0}).sigmas[0] == -2


def test_empty_window_and_broken_curve_are_refused():
    with pytest.raises(ValueError, match="no points"):
        curve_residuals(([], []), LINE, (1, 1))
    with pytest.raises(ValueError, match="not finite"):
        curve_residuals(([1.0], [1.0]), ([0.0, 1.0], [0.0, np.nan]), (1, 1))
    with pytest.raises(ValueError, match="two vertices"):
        curve_residuals(([1.0], [1.0]), ([0.0], [0.0]), (1, 1))


def test_the_nearest_of_several_vertices_counts():
    vertices = [0.0, 0.0], [3.0, 1.5], ["slip", "slip"]
    assert vertex_residuals(([0.0], [1.0], ["slip"]), vertices, (1, 1)).sigmas.tolist() == [-0.5]


def test_vertices_are_matched_by_label():
    vertices = ([0.0, 0.0], [1.0, 2.0], ["stick", "slip"])
    assert vertex_residuals(([0.0], [2.0], ["slip"]), vertices, (1, 1)).summary().max == 0
    assert vertex_residuals(([0.0], [2.0], ["stick"]), vertices, (1, 1)).summary().max == 1
    with pytest.raises(ValueError, match="no vertex 'end'"):
        vertex_residuals(([0.0], [2.0], ["end"]), vertices, (1, 1))


@pytest.mark.parametrize(
    ("found", "fact", "expected"),
    [
        (21.0, {"value": 20.0, "tolerance": 2.0}, 0.5),
        (25.0, {"value": 20.0, "tolerance": 2.0}, 2.5),
        (0.9, {"less_than": 1.0}, 0.0),
        (1.0, {"less_than": 1.0}, np.inf),
        (1.1, {"greater_than": 1.0}, 0.0),
        (1.0, {"greater_than": 1.0}, np.inf),
    ],
)
def test_facts(found, fact, expected):
    assert fact_residuals(found, fact).summary().max == expected


@pytest.mark.parametrize(
    ("rms", "largest", "verdict"),
    [(0.9, 2.9, Verdict.AGREES), (1.1, 2.9, Verdict.DIVERGES), (0.9, 3.1, Verdict.DIVERGES)],
)
def test_agreement_is_bounded_by_rms_and_max(rms, largest, verdict):
    assert judge(Distance(rms, largest, 0.0, 5), {"rms": 1.0, "max": 3.0}) == verdict


@pytest.mark.parametrize(
    ("rms", "verdict"),
    [(2.5, Verdict.DOCUMENTED), (1.9, Verdict.DIVERGES), (3.1, Verdict.DIVERGES)],
)
def test_a_documented_difference_is_bounded_on_both_sides(rms, verdict):
    documented = {"entry": "known", "rms": [2.0, 3.0]}
    assert judge(Distance(rms, 9.0, 0.0, 5), documented=documented) == verdict


@pytest.mark.parametrize("nothing", [{}, None])
def test_no_tolerance_is_no_agreement(nothing):
    assert judge(Distance(0.0, 0.0, 0.0, 1), nothing) == Verdict.DIVERGES
    assert judge(Distance(0, 0, 0, 1), documented={"entry": "known"}) == Verdict.DIVERGES


def test_not_a_number_never_agrees():
    assert judge(Distance(np.nan, np.nan, 0.0, 1), {"max": 1.0}) == Verdict.DIVERGES


def test_difference_of_columns():
    found = difference_residuals([0.0, 1.0], [1.0, 2.0], [1.0, 2.5], 0.25)
    assert found.x.tolist() == [0.0, 1.0] and found.sigmas.tolist() == [0.0, -2.0]


def test_landmarks():
    x = np.linspace(0, 2, 41)
    assert landmarks.peak(x, -((x - 1.234) ** 2)) == pytest.approx(1.234, abs=1e-12)
    assert landmarks.first_reaching(x, np.minimum(x, 1.0), 1.0) == 1.0
    assert landmarks.value_at(x, 2 * x, 0.33) == pytest.approx(0.66)
    regimes = np.where(x < 1, "STICK_SLIP", "SLIP_THROUGHOUT")
    assert landmarks.regime_end(x, regimes, "STICK_SLIP") == pytest.approx(0.95)
    assert landmarks.regime_start(x, regimes, "SLIP_THROUGHOUT") == 1.0


@pytest.mark.parametrize(
    ("landmark", "arguments", "words"),
    [
        (landmarks.peak, ([0, 1, 2], [0, 1, 2]), "at an end"),
        (landmarks.first_reaching, ([0, 1], [0, 1], 2.0), "never reaches 2"),
        (landmarks.value_at, ([0, 1], [0, 1], 2.0), "outside the curve"),
        (landmarks.regime_start, ([0, 1], ["STICK", "STICK"], "MULTIPLE"), "nowhere"),
    ],
)
def test_a_missing_landmark_says_so(landmark, arguments, words):
    with pytest.raises(ValueError, match=words):
        landmark(*arguments)
