"""A short form of tests/simulated_readings.py: right prints do not fail, and wrong ones do."""

import collections

import numpy as np
import pytest

from stronge1994.reference_data.calibration import Calibration
from stronge1994.verdict_table import Verdict
from tests import simulated_readings

HARD = ("8, an L", 0.5, 3e-5)  # marks, a click in pixels, a tilt per pixel


@pytest.fixture(autouse=True)
def of_this_run(first_run, monkeypatch):
    monkeypatch.setattr(simulated_readings, "RUN", first_run[0])


def verdicts(column, trials, factor=1.0):
    return collections.Counter(simulated_readings.cell((HARD, column), trials, factor, 1994))


@pytest.mark.parametrize(
    ("column", "trials"), [(("markers", 9), 60), (("markers", 57), 40), (("line", 2.4), 10)]
)
def test_a_right_print_does_not_fail_and_one_that_is_five_per_cent_off_does(column, trials):
    """In the long form 0.6 % of right ones at most."""
    right, wrong = verdicts(column, trials), verdicts(column, trials // 2, 1.05)
    assert right[Verdict.DIFFERS] == 0 and right[Verdict.AGREES] >= 0.9 * trials
    assert wrong[Verdict.DIFFERS] >= 0.9 * (trials // 2)


def test_without_the_error_of_the_marks_right_prints_would_fail(monkeypatch):
    monkeypatch.setattr(Calibration, "shifts", lambda self, places, _: np.zeros((0, len(places))))
    assert verdicts(("markers", 30), 40)[Verdict.DIFFERS] > 8
