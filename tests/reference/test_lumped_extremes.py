"""The table of data/lumped_extremes is what the reference computes, and covers the box."""

import csv
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest

from tests.reference_solutions import extreme_tables

TABLE = Path(__file__).parents[2] / "data/lumped_extremes/impacts.csv"


def rows():
    with open(TABLE, newline="", encoding="utf-8") as file:
        header, *found = csv.reader(file)
    assert header == extreme_tables.HEADER
    return found


@pytest.mark.slow
def test_rows_are_what_the_reference_computes():
    cheap = [row for row in rows() if int(row[-1]) < 30]
    for row in cheap[::60]:
        assert extreme_tables.row(tuple(map(float, row[:4]))) == row


def test_no_condition_is_inflated():
    """A condition too large would let wrong digits pass; these bounds are what the model has."""
    x, beta, zeta2, e, *_, velocity, peak, dissipation, phases = np.array(rows(), float).T
    work = np.minimum(x, 2 * (1 + e) * beta) * (x / (2 * beta))  # the most that friction can do
    assert (velocity <= 5 * np.maximum(x, beta)).all()
    assert (peak <= 2).all()
    assert (dissipation <= 7 * (1 + np.sqrt(beta / zeta2)) * work + 1e-300).all()
    assert (np.minimum(np.minimum(velocity, peak), dissipation) >= 0).all()
    assert (phases >= 1).all()


def test_the_table_covers_the_box():
    x, beta, zeta2, e = np.array([row[:4] for row in rows()], float).T
    assert {0.0, 5e-324, 1e-300, 1.0} <= set(e)
    assert {0.0, 5e-324, 1e-300, 1e300} <= set(x)
    assert (zeta2.min(), zeta2.max()) == (1e-8, 1e12)
    assert (beta.min(), beta.max()) == (1, 1e6)
    assert sum(int(row[-1]) >= 1000 for row in rows()) > 10


def test_every_threshold_and_its_neighbours_occur():
    """At the limit of slip throughout, for one; the others are drawn the same way."""
    beside = set()
    for row in rows():
        x, *ratios = map(float, row[:4])
        for which, place in enumerate(extreme_tables.thresholds(*ratios)):
            for side in (np.nextafter(place, 0), place, np.nextafter(place, np.inf)):
                if x == side:
                    beside.add((which, float(np.sign(x - place))))
    assert beside == {(which, side) for which in range(5) for side in (-1.0, 0.0, 1.0)}


def test_switches_are_bracketed_by_neighbours():
    """Pairs one unit in the last place apart whose phases, or last slips, differ."""
    points = [tuple(map(float, row[:4])) for row in rows()]
    pairs = [(low, high) for low, high in pairwise(points) if one_ulp_apart(low, high)]
    found = sum(extreme_tables.course(low) != extreme_tables.course(high) for low, high in pairs)
    assert found >= extreme_tables.SWITCHES


def one_ulp_apart(low, high):
    moved = [(a, b) for a, b in zip(low, high, strict=True) if a != b]
    return len(moved) == 1 and np.nextafter(moved[0][0], np.inf) == moved[0][1]
