"""The metric and the verdicts: each must be able to fail."""

import numpy as np
import pytest
from scipy import stats
from scipy.optimize import minimize

from stronge1994 import csv_tables
from stronge1994.goodness import chi_squared
from stronge1994.judging import compare, landmarks, write
from stronge1994.judging.distances import (
    Residuals,
    curve_residuals,
    fact_residuals,
    vertex_residuals,
)
from stronge1994.judging.metrics import Measured, measure
from stronge1994.judging.points import points
from stronge1994.judging.verdicts import judge
from stronge1994.verdict_tables import verdict_table
from stronge1994.verdict_tables.verdict_table import COLUMNS, Verdict

LINE = (np.linspace(0, 2, 21), np.abs(np.linspace(0, 2, 21) - 1.0))


def test_distance_is_shortest_in_sigmas_not_vertical_and_signed():
    """Of points on the curve there is none, even at the kink; signs tell the side."""
    x = np.array([0.0, 0.95, 1.0, 1.05, 2.0])
    assert np.abs(curve_residuals((x, np.abs(x - 1)), LINE, (0.1, 0.1)).sigmas).max() < 1e-12
    # A shift of 0.1 along x of a line of slope 1 is 0.1/sqrt(2) away where both sigmas are 1. Each
    # point may have its own, and a line may be drawn from either end.
    for line in (LINE, [axis[::-1] for axis in LINE]):
        found = curve_residuals(([0.5, 1.5], [0.6, 0.4]), line, ([1.0, 3.0], [1.0, 4.0])).sigmas
        assert found == pytest.approx([0.1 / np.sqrt(2), -0.1 / 5])


def test_the_nearest_vertex_of_a_label_counts():
    vertices = ([4.0, 0.0, 4.0], [1.0, 2.0, 4.5], ["stick", "slip", "slip"])
    for label, y, sigmas, plain in (("slip", 4.5, 0, 0), ("stick", 2, 2, 1), ("slip", 4, -1, -0.5)):
        found = vertex_residuals(([4.0], [y], [label]), vertices, (8.0, 0.5))
        assert (found.sigmas[0], found.plain[0]) == (sigmas, plain)
        found = vertex_residuals(([4.0 + 8.0], [y], [label]), vertices, (8.0, 0.5))
        assert found.sigmas[0] == np.copysign(np.hypot(sigmas, 1), plain)


def test_landmarks_of_a_curve_are_where_it_gets_there_to_rounding():
    x = np.array([0.0, 1.0, 3.0, 3.5, 4.0])
    assert landmarks.find("peak", x, -((x - 1.7) ** 2)) == pytest.approx(1.7, rel=1e-14)
    y = [0.2, 1 - 1e-13, 1 - 1e-15, 2.0, 0.5]
    assert [landmarks.find(kind, x, y, 1.0) for kind in ("first", "last")] == [3.0, 3.5]


def test_facts():
    assert fact_residuals(21.0, {"value": 20.0, "tolerance": 2.0}).sigmas[0] == -0.5
    for kind, holds in (
        ("less_than", [True, False, False]),
        ("greater_than", [False, False, True]),
    ):
        found = [fact_residuals(value, {kind: 1.0}).sigmas[0] for value in (0.9, 1.0, 1.1)]
        assert np.isfinite(found).tolist() == holds


@pytest.mark.parametrize("known", ["", "explained", "unexplained", "untested"])
@pytest.mark.parametrize("limit", [{}, {"limit": 0.25}, {"limit": 2.0}])
def test_verdicts(known, limit):
    """A known difference must be there, and keep its sizes and its sign."""
    entry = {"reference": "maw1976/limit"} | limit
    entry |= {"documented": {"as": known}} if known else {}
    differs = Verdict(f"{known} difference") if known else Verdict.DIVERGES

    def verdict(size, **bounds):
        both = size * np.array([[-1.0, 0.5], [-3.0, 9.0]])  # in sigmas, and in units of the axis
        measured = Measured("x", Residuals(np.zeros(2), *both), ["y"] * 2)
        return judge(entry | {"regression": bounds}, {"value": 0.0}, measured, 0.01)

    most = limit.get("limit", 1.0)
    for size in (most, -most):
        assert verdict(size) == (Verdict.DIVERGES if known else Verdict.AGREES)
        size *= 1.001
        found = {"rms": abs(size) * 0.625**0.5, "max": abs(size), "difference": 3 * size}
        bounds = {key: sorted([0.99 * value, 1.01 * value]) for key, value in found.items()}
        assert verdict(size, **bounds) == differs
        for key, value in found.items():
            for low, high in ((0.9, 0.99), (1.01, 1.1), (-1.1, -0.9)):
                wrong = bounds | {key: sorted([low * value, high * value])}
                assert verdict(size, **wrong) == Verdict.DIVERGES


@pytest.mark.parametrize("of_sigma", [None, 4, 40])
@pytest.mark.parametrize("number", [1, 5, 17])
@pytest.mark.parametrize("parameter", [0.0, 1.0])
def test_points_that_fit_a_wrong_curve_too_are_inconclusive(number, of_sigma, parameter):
    """Of points that all lie as far beside the curve: two sigmas farther must be too far."""
    known = {"kind": "digitised", "sigma_values": of_sigma}
    shifts = parameter * np.ones((1, number))  # an uncertain parameter moves all points
    # Where p is 0.01. A sigma that very many values gave is as good as known.
    far = np.sqrt(stats.f.isf(0.01, number, of_sigma or 1e9) * (1 + parameter * number))

    def verdict_at(sigmas, reference=known, **entry):
        residuals = Residuals(np.zeros(number), np.full(number, sigmas), np.zeros(number))
        measured = Measured("x", residuals, ["y"] * number, shifts)
        return judge({"reference": "a/b"} | entry, reference, measured, 0.01)

    for sigmas in (-1.0, -0.5, 0.0, 0.5, 1.0, 0.999 * far, -0.999 * far, 1.001 * far, -1.001 * far):
        expected = [Verdict.DIVERGES] * 2
        if abs(sigmas) < far:
            noticed = far < 2.0 - abs(sigmas)
            expected = [Verdict.AGREES if noticed else Verdict.INCONCLUSIVE, Verdict.UNCHANGED]
        assert [verdict_at(sigmas), verdict_at(sigmas, fitted=True)] == expected
    for size, verdict in ((1.0, Verdict.RIGHT), (1.001, Verdict.WRONG)):
        assert {verdict_at(size, {"kind": "computed"}), verdict_at(-size, {})} == {verdict}


@pytest.mark.parametrize("values", [[3e-16, 0.0], [1.95, 2.0], [-0.5, 16.0]])
def test_the_ends_of_a_range_are_a_sigma_from_its_middle(values):
    """Up to the widest that is allowed."""
    curves = {"a": {"x [1]": np.arange(2.0), "y [1]": np.array(values)}}
    least, largest = min(0.0, 100 * values[0]), max(values)

    def measured(low, high):
        entry = {"metric": "range", "columns": ["y [1]"], "range": [low, high]}
        return np.abs(measure(entry, {}, curves).residuals.sigmas).max()

    assert measured(least, largest) == pytest.approx(1.0)
    assert measured(least, 99 * largest) <= 1.0


def test_chi_squared_is_that_of_a_fit_held_to_the_stated_parameters():
    rng = np.random.default_rng(4)
    distance, shifts = rng.normal(size=9), rng.normal(size=(2, 9))

    def loss(parameters):
        return np.sum((distance - parameters @ shifts) ** 2) + parameters @ parameters

    fitted = minimize(loss, np.zeros(2), tol=1e-12).fun
    assert chi_squared(distance, shifts).value == pytest.approx(fitted, rel=1e-9)
    assert not chi_squared([np.nan, 0.0]).p > 0.01


@pytest.mark.parametrize(
    ("entry", "chosen"),
    [
        ({"regime": "initial stick"}, [0, 1]),
        ({"regime": "slip and stick"}, [2, 3]),
        ({"regime": "slip throughout"}, [4, 5]),
        ({"points": {"reader": "me", "run": "1"}}, [0, 2]),
        ({"curve": "e = 1"}, [1, 3]),
        ({"curve": "e = 1", "as_printed": True}, [1, 3, 5]),
    ],
)
@pytest.mark.parametrize("axis", ["incidence", "angle"])
def test_a_comparison_is_of_the_points_that_it_names(entry, chosen, axis, tmp_path):
    """Regimes begin at zeta^2 = 0.5 and beta + e beta - zeta^2/e = 3.5, with the points there."""
    path, x = tmp_path / "a.csv", np.array([0.0, 0.4999, 0.5, 3.4999, 3.5, 9.0])
    x = np.degrees(np.arctan(0.2 * x)) if axis == "angle" else x
    curves = ["e = 0", "e = 1"] * 2 + ["as printed, e = 0", "as printed, e = 1"]
    rows = zip(x.tolist(), range(6), ["me", "you"] * 3, "111222", curves, strict=True)
    columns = {"unit": "", "sigma": 1, "range": [0, 90]}
    reference = {"kind": "computed", "path": path, "labels": ["reader", "run", "curve"]}
    reference |= {"x": columns | {"column": axis}, "y": columns | {"column": "row"}}
    groups = {"mass_ratio": 3.0, "stiffness_ratio": 0.5, "restitution": 0.5, "friction": 0.2}
    csv_tables.write_rows(path, [axis, "row", *reference["labels"]], rows)
    assert points(entry, reference | {"parameters": groups})["row"].tolist() == chosen


def test_a_contraction_is_of_the_curves_that_it_names():
    """Neighbours of one curve leave further apart than they arrive; the worst of each place counts.

    Rows may stand in any order. What is off by a sigma, and what is printed, need not obey.
    """
    x = np.array([2.0, 0.0, 1.0])
    slopes = {"e = 0": 1.5, "e = 1": -0.5, "continuum, e = 1": -3.0, "as printed, e = 1": 9.0}
    slopes |= {"e = 0; mu + 1 sigma": 9.0, "e = 0; mu - 1 sigma": 9.0}
    curves = {name: {"x": x, "w": slope * x} for name, slope in slopes.items()}
    entry = {"metric": "contraction", "columns": ["x", "w"]}
    for beginning, excess in (("e = 1", 0.0), ("e = ", 0.5), ("continuum", 2.0), ("", 2.0)):
        found = measure(entry | {"beginning": beginning}, None, curves).residuals
        assert found.x.tolist() == [1.0, 2.0] and found.sigmas.tolist() == [excess] * 2


# Comparison, verdict, and the cells from the number of points to what is allowed.
CELLS = """
law,right,3,,,,,0.5,0.5,0.5,0.5,,a,,,max <= 2
pair,wrong,3,,,,,1.5e+12,1.5e+12,1.5,1.5,,a,,,max <= 1
fact,explained difference,1,,,,,2,2,0.5,0.5,N,a,0.5,1 N,max <= 1
sign,diverges,1,,,,,inf,inf,0.5,0.5,1,a,0.5,< 0,max <= 1
points,inconclusive,3,10.8,3,4,0.12,2.83,4,1.41,2,N,a,,,ALLOWED
same,diverges,3,10.8,3,4,0.12,2.83,4,1.41,2,N,a,,,ALLOWED
later,awaited,,,,,,,,,,,a,,,
both,wrong,4,,,,,3.16,4,1.58,2,,a,,,max <= 1
none,wrong,,,,,,,,,,,a,,,
""".replace("ALLOWED", "p > 0.01; the model may be off by x 0 s, y 0.4 N")
NOTES = {
    "pair": "largest for y [N] at x [s] = 0",
    "fact": "ledger: eq-1",
    "same": "ledger: eq-1; largest for y [N] of a at x [s] = 1",
    "later": "Fig. 1",
    "both": "largest for y [N] of a at x [s] = 1",
    "none": "curve 'a' does not have the columns z",
}


def test_a_row_has_what_was_measured(tmp_path):
    """Chi-squared by the covariance of an allowance and of uncertain parameters, common and own."""
    path, x = tmp_path / "a.csv", np.arange(3.0)
    shifts = {"": 0, "; e + 1 sigma": 0.5, "; e - 1 sigma": -0.25}
    shifts |= {"; each ball's mu + 1 sigma": 0.5, "; each ball's mu - 1 sigma": -0.5}
    curves = {
        f"a{end}": {"x [s]": x, "y [N]": np.full(3, 0.5 + shift), "v [m]": np.full(3, 2.0)}
        for end, shift in shifts.items()
    }
    measured = [[0, 1.5, ""], [1, 2.5, ""], [2, -0.5, 4.0]]
    csv_tables.write_rows(tmp_path / "p.csv", ["x [s]", "y [N]", "v [m]"], measured)
    csv_tables.write(path, curves)
    axis = {"range": [-9, 9], "sigma": 0.3}
    series = {"kind": "digitised", "path": tmp_path / "p.csv", "sigma_values": 4}
    axes = {name: axis | {"column": name, "unit": unit} for name, unit in ("xs", "yN", "vm")}
    series |= {"x": axes["x"], "y": axes["y"]}
    references = {
        "they/fact": {"value": 1.0, "tolerance": 0.25, "unit": "N"},
        "they/sign": {"less_than": 0.0, "unit": "1"},
        "they/points": series,
        "they/both": series | {"kind": "computed", "y": [axes["y"], axes["v"]]},
        "they/later": {"kind": "awaited", "figure": "Fig. 1"},
    }
    landmark = {"kind": "value", "x": "x [s]", "y": "y [N]", "at": 1}
    value = {"metric": "landmark", "landmark": landmark}
    known = {"documented": {"as": "explained", "entry": "eq-1"}}
    fact = {"reference": "they/fact", "regression": {"difference": [-0.6, -0.4]}}
    beside = {"metric": "distance", "reference": "they/points", "allowance": {"x": 0.0, "y": 0.4}}
    entries = {
        "law": {"metric": "small", "columns": ["y [N]"], "limit": 2.0},
        "pair": {"metric": "small", "columns": ["y [N]", "v [m]"]},
        "fact": fact | value | known,
        "sign": {"reference": "they/sign"} | value,
        "points": beside,
        "same": beside | known | {"regression": {"rms": [2, 3]}},
        "later": beside | {"reference": "they/later"},
        "both": beside | {"reference": "they/both"},
        "none": {"metric": "small", "columns": ["z"]},
    }
    entries = {name: entry | {"curve": "a"} for name, entry in entries.items()}
    rows = compare("fig0", path, entries, references, 0.01)
    cells = [[f"{row[key]}" for key in ("comparison", "verdict", *COLUMNS[5:-3])] for row in rows]
    assert [",".join(own) for own in cells] == CELLS.split("\n")[1:-1]
    assert {row["comparison"]: row["note"] for row in rows if row["note"]} == NOTES
    assert rows[2]["regression"] == "-0.6 <= difference <= -0.4"
    printed = rows[4] | {"question": "as printed", "p": ""}
    assert verdict_table.measured(printed) == "rms 1.41, max 2 N"
    changed = "chi^2 10.8 of 3, p = 0.12; allowed is a difference, and as before 2 <= rms <= 3"
    assert verdict_table.why(rows[5]) == f"{NOTES['same']}: {changed}"
    write(rows, tmp_path / "verdicts.csv", tmp_path / "residuals.csv")
    residuals = csv_tables.read(tmp_path / "residuals.csv")
    assert residuals["fact"]["quantity"].tolist() == ["y [N]"]
    assert residuals["points"]["at"].tolist() == [0, 1, 2]
    assert residuals["points"]["distance [sigma]"].tolist() == pytest.approx([2, 4, -2])
    curves["a"]["y [N]"][1] = np.inf
    csv_tables.write(path, curves)
    with pytest.raises(ValueError, match="allowed are finite numbers"):
        compare("fig0", path, entries, references, 0.01)
