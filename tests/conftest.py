"""Profiles of Hypothesis, for every test of a property.

`house` tries the same few examples each time, so that the suite is quick and never fails by
chance. `long` tries 75 times as many at random, and takes an hour:

    python -m pytest -n 0 tests/property tests/reference --hypothesis-profile=long

or with the environment variable HYPOTHESIS_PROFILE=long. It also runs the tests marked `long`:
more random impacts where other tests already try the thresholds.
"""

import os

import pytest
from hypothesis import settings

from tests import programs

# Before numpy. Two workers with two threads each on two cores wait for each other: small systems of
# equations then take ten times as long.
os.environ |= {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}

EXAMPLES = 100


def pytest_report_header():
    """What will be skipped, so that nobody wonders at the end."""
    return programs.report()


settings.register_profile("house", max_examples=EXAMPLES, deadline=None, derandomize=True)
settings.register_profile("long", max_examples=75 * EXAMPLES, deadline=None)
settings.load_profile(os.environ.get("HYPOTHESIS_PROFILE", "house"))


@pytest.hookimpl(trylast=True)  # once tests of the workflow are marked slow
def pytest_collection_modifyitems(config, items):
    if settings.get_current_profile_name() != "long":
        left_out = [item for item in items if item.get_closest_marker("long")]
        config.hook.pytest_deselected(items=left_out)
        items[:] = [item for item in items if not item.get_closest_marker("long")]
    items.sort(key=lambda item: _turn(item.path))


def _turn(path):
    """Stories of runs take longest and start first. What is short comes last, so that no process is
    left alone with a long file."""
    if path.name == "test_run.py":
        return 0
    return {"property": 1, "reference": 1, "workflow": 2}.get(path.parent.name, 3)
