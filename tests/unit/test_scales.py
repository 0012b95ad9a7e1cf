"""A scale that nobody states is fitted to all points that share it, and costs a degree."""

import numpy as np
import pandas as pd
import pytest

from stronge1994 import tables, verdict_table
from stronge1994.judging import compare, scales
from stronge1994.judging.comparisons import Comparison
from stronge1994.judging.metrics import measure

ANGLE = np.linspace(0.0, 80.0, 81)
SHAPES = {"normal": 90.0 * np.cos(np.radians(ANGLE)), "friction": 15 - ((ANGLE - 30) / 15) ** 2}


@pytest.fixture
def judged(tmp_path):
    """Rows of some forces, and the factor that was fitted, for points `{force: (x, y)}`."""
    path = tmp_path / "curves.csv"
    own = ({"angle [deg]": ANGLE, "peak_force [N]": force} for force in SHAPES.values())
    curves = map(tables.curve, own, ["lumped"] * len(SHAPES), SHAPES)
    table = tables.join(curves)
    tables.write(path, table)
    axis = {"sigma": 0.5, "range": [-90, 400]}
    axes = {"x": axis | {"column": "angle", "unit": "deg"}}
    axes |= {"y": axis | {"column": "peak_force", "unit": "N"}}

    def rows(points):
        entries = {
            force: {"metric": "distance", "scale": "force", "reason": "so"}
            | {"curve": {"variant": force}, "reference": f"they/{force}"}
            for force in SHAPES
        }
        references = {f"they/{force}": {"kind": "awaited", **axes} for force in SHAPES}
        for force, (x, y) in points.items():
            file = tmp_path / f"{force}.csv"
            pd.DataFrame({"angle [deg]": x, "peak_force [N]": y}).to_csv(file, index=False)
            references[f"they/{force}"] |= {"kind": "digitised", "path": str(file)}
        every = [Comparison.of(force, entries[force], references) for force in entries]
        together = scales.sharing("force", every, {})
        found = compare("fig0", str(path), entries, references, 0.01, {})
        return (
            {row["comparison"]: row for row in found},
            lambda: scales.fit(together, table),
            (
                lambda factor: sum(
                    (measure(one, scales.scaled(one, table, factor)).sigmas ** 2).sum()
                    for one in together
                )
            ),
        )

    return rows


def points(force, factor, number, off=0.0):
    x = np.linspace(3.0, 77.0, number)
    return x, factor * np.interp(x, ANGLE, SHAPES[force]) + off


@pytest.mark.parametrize("factor", [0.3, 0.876, 1.0, 4.0])
@pytest.mark.parametrize("numbers", [{"normal": 9}, {"friction": 9}, {"normal": 9, "friction": 6}])
def test_points_of_the_right_shape_give_the_scale(factor, numbers, judged):
    rows, fitted, _ = judged({name: points(name, factor, n) for name, n in numbers.items()})
    assert fitted() == pytest.approx(factor, rel=1e-6)
    for name, row in rows.items():
        degrees = numbers.get(name, 0) * (1 - 1 / sum(numbers.values()))
        expected = ("agrees", f"{degrees:.1f}".removesuffix(".0"))
        awaited = ("not compared", "")
        found = row["verdict"], row["degrees of freedom"]
        assert found == (expected if name in numbers else awaited)
    told = [row["note"] for name, row in rows.items() if name in numbers]
    assert all(
        f"{90 * factor:#.3g}".rstrip(".") + " N at 0 deg, 90.0 N assumed" in note for note in told
    )
    if "friction" in numbers:
        assert "; the points are largest at " in told[-1] and "the curve at 30 deg" in told[-1]


def test_the_scale_is_that_of_the_least_squares_of_all_distances(judged):
    rng = np.random.default_rng(5)
    made = {name: points(name, 0.8, 8, rng.normal(size=8)) for name in SHAPES}
    rows, fitted, loss = judged(made)
    assert loss(fitted()) < min(loss(fitted() * factor) for factor in (0.9999, 1.0001, 0.5, 2.0))
    assert sum(float(row["chi^2"]) for row in rows.values()) == pytest.approx(loss(fitted()), 0.01)
    said = verdict_table.chance({key: f"{cell}" for key, cell in rows["normal"].items()})
    assert " of 7.5 degrees of freedom: p = " in said


def test_what_a_scale_cannot_tell(judged):
    """One point has any scale; points in another unit have none; at an end there is no peak."""
    rows, *_ = judged({"normal": ([20.0], [70.0])})
    assert (rows["normal"]["verdict"], rows["normal"]["p"]) == ("cannot tell", "1")
    rows, *_ = judged({"normal": points("normal", 0.1, 9)})
    assert rows["normal"]["verdict"] == "FAILS"
    assert rows["normal"]["note"].startswith("the best scale of force is not between 0.2 and 5")
    x = np.linspace(40.0, 77.0, 6)
    rows, *_ = judged({"friction": (x, np.interp(x, ANGLE, SHAPES["friction"]))})
    assert "largest at 40 deg, an end of theirs, the curve at 30 deg" in rows["friction"]["note"]
