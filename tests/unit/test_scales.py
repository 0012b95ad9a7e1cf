"""A scale that nobody states is fitted to the points of each curve; the ratio of two must be 1."""

import numpy as np
import pandas as pd
import pytest

from stronge1994 import tables, verdict_table
from stronge1994.judging import compare, scales
from stronge1994.judging.comparisons import Comparison
from stronge1994.judging.metrics import measure
from stronge1994.reference_data import Series

ANGLE = np.linspace(0.0, 80.0, 81)
SHAPES = {"normal": 90.0 * np.cos(np.radians(ANGLE)), "friction": 15 - ((ANGLE - 30) / 15) ** 2}
SIGMA, NUMBER = 0.5, 9  # deg and N; points


@pytest.fixture
def judged(tmp_path):
    """Rows, comparisons and curves of some forces, for points `{force: (x, y)}`."""
    path = tmp_path / "curves.csv"
    own = ({"angle [deg]": ANGLE, "peak_force [N]": force} for force in SHAPES.values())
    curves = map(tables.curve, own, ["lumped"] * len(SHAPES), SHAPES)
    table = tables.join(curves)
    tables.write(path, table)
    axis = {"sigma": SIGMA, "range": [-90, 400]}
    axes = {"x": axis | {"column": "angle", "unit": "deg"}}
    axes |= {"y": axis | {"column": "peak_force", "unit": "N"}}

    def rows(points, of_other_settings=(), **allowance):
        every = {}
        for force in SHAPES:
            kind, file = "awaited", tmp_path / f"{force}.csv"
            if force in points:
                x, y = points[force]
                pd.DataFrame({"angle [deg]": x, "peak_force [N]": y}).to_csv(file, index=False)
                kind = "digitised"
            settings = {"speed": 1.0} if force in of_other_settings else {}
            known = Series(kind, **axes, path=str(file), name=f"they/{force}", settings=settings)
            scaled = {"scale": "force", "reference": known}
            own = {"curve": {"variant": force}, **allowance}
            every[force] = Comparison(force, "distance", "so", **scaled, **own)
        every["ratio"] = Comparison("ratio", "ratio", "so", **scaled)  # of the last, friction
        found = compare("fig0", str(path), every.values(), 0.001, {"speed": 2.0})
        return {row["comparison"]: row for row in found}, every, table

    return rows


def points(force, factor, off=0.0, number=NUMBER):
    x = np.linspace(3.0, 77.0, number)
    return x, factor * np.interp(x, ANGLE, SHAPES[force]) + off


@pytest.mark.parametrize("factor", [0.3, 0.876, 1.0, 4.0])
@pytest.mark.parametrize("force", SHAPES)
def test_points_of_the_right_shape_give_the_scale(factor, force, judged):
    rows, every, table = judged({force: points(force, factor)})
    assert scales.measure(every[force], table).factor == pytest.approx(factor, rel=1e-6)
    row, other = rows.pop(force), [one["verdict"] for one in rows.values()]
    enough = force == "normal" or factor > 0.5  # for a small force a sigma of 0.5 N is large
    assert row["verdict"] == ("agrees" if enough else "cannot tell")
    assert row["degrees of freedom"] == NUMBER - 1
    assert other == ["not compared", "not compared"]  # a ratio needs the points of both
    size = f"{factor * SHAPES[force].max():#.3g}".rstrip(".")
    assert row["note"].startswith(f"force scaled by {factor:.3g}: {size} N at ")
    if force == "friction":
        assert "; the points are largest at " in row["note"]
        assert row["note"].endswith("the curve at 30 deg")


def test_the_scale_is_that_of_the_least_squares_of_all_distances(judged):
    rng = np.random.default_rng(5)
    rows, every, table = judged({"friction": points("friction", 0.8, rng.normal(size=NUMBER))})
    own, column = every["friction"], "peak_force [N]"

    def loss(factor):
        scaled = table.assign(**{column: factor * table[column]})
        return (measure(own, scaled).sigmas ** 2).sum()

    factor = scales.measure(own, table).factor
    assert loss(factor) < min(loss(factor * one) for one in (0.999, 1.001, 0.5, 2.0))
    assert float(rows["friction"]["chi^2"]) == pytest.approx(loss(factor), 0.01)
    said = verdict_table.chance({key: f"{cell}" for key, cell in rows["friction"].items()})
    assert " of 8 degrees of freedom: p = " in said


def test_what_a_scale_cannot_tell(judged):
    """One point has any scale; points in another unit have none; at an end there is no peak."""
    rows, *_ = judged({"normal": ([20.0], [70.0])})
    assert (rows["normal"]["verdict"], rows["normal"]["p"]) == ("cannot tell", "1")
    assert rows["normal"]["would fail"] == ""
    rows, *_ = judged({"normal": points("normal", 0.1)})
    assert rows["normal"]["verdict"] == "FAILS"
    assert "best scale of force, 0.1, is not between 0.2 and 5" in rows["normal"]["note"]
    x = np.linspace(40.0, 77.0, 6)
    rows, *_ = judged({"friction": (x, np.interp(x, ANGLE, SHAPES["friction"]))})
    assert "largest at 40 deg, an end of theirs, the curve at 30 deg" in rows["friction"]["note"]


@pytest.mark.parametrize(
    ("friction", "allowed", "verdict"),
    [(0.876, 0.0, "agrees"), (0.876 * 1.15, 0.0, "differs"), (0.876 * 1.15, 1.0, "cannot tell")],
)
def test_the_ratio_of_two_scales_is_judged_apart(friction, allowed, verdict, judged):
    """Friction that is too high fails neither shape; an allowance of both curves hides it."""
    both = {"normal": points("normal", 0.876), "friction": points("friction", friction)}
    rows, *_ = judged(both, **{"allowance": {"x": 0.0, "y": allowed}} if allowed else {})
    assert rows["normal"]["verdict"] == "agrees"
    row = rows["ratio"]
    assert (row["verdict"], row["degrees of freedom"]) == (verdict, 1)
    assert float(row["max"]) == pytest.approx(friction / 0.876 - 1, abs=1e-3)
    assert row["found"] == f"ratio {friction / 0.876:.3g}"
    assert row["note"].startswith(f"factors {friction:.3g} and 0.876: have both axes")
    variance = 0.0
    for name, (x, y) in both.items():  # of least squares, where an error along x is one of y, too
        slope = np.interp(x, ANGLE, np.gradient(SHAPES[name], ANGLE)) * y[0] / SHAPES[name][3]
        squared = SIGMA**2 + allowed**2 + (slope * SIGMA) ** 2
        variance += 1 / np.sum(y**2 / squared) + allowed**2 / np.mean(y**2)
    sigmas = np.log(friction / 0.876) / np.sqrt(variance)
    assert float(row["max [sigma]"]) == pytest.approx(abs(sigmas), rel=0.02, abs=0.01)


@pytest.mark.parametrize("force", SHAPES)
def test_points_of_other_settings_do_not_pull_a_shared_scale(force, judged):
    """They are not compared, nor is the ratio; the other force keeps its own scale."""
    both = {"normal": points("normal", 0.876), "friction": points("friction", 0.876)}
    (other,) = SHAPES.keys() - {force}
    alone, *_ = judged({other: both[other]})
    rows, *_ = judged(both | {force: points(force, 2.0)}, of_other_settings=[force])
    for name in (force, "ratio"):
        assert (rows[name]["verdict"], rows[name]["why"]) == ("not compared", "other settings")
    assert "this run has 2" in rows["ratio"]["note"]
    assert rows[other]["note"] == alone[other]["note"]
