"""The metric and the verdicts: each must be able to fail."""

import itertools

import numpy as np
import pandas as pd
import pytest
from scipy import optimize, stats
from scipy.optimize import minimize

from stronge1994 import reference_data, tables, verdict_table
from stronge1994.goodness import chi_squared
from stronge1994.judging import compare, landmarks, write
from stronge1994.judging.comparisons import Comparison
from stronge1994.judging.distances import (
    curve_residuals,
    fact_residuals,
    vertex_residuals,
)
from stronge1994.judging.metrics import Measured, measure
from stronge1994.judging.verdicts import judge
from stronge1994.reference_data import Fact, Series
from stronge1994.verdict_table import COLUMNS, Verdict, Why

AXIS = {"column": "x", "unit": "s", "sigma": 1.0, "range": [0.0, 1.0]}
LINE = (np.linspace(0, 2, 21), np.abs(np.linspace(0, 2, 21) - 1.0))


def test_distance_is_shortest_in_sigmas_not_vertical_and_signed():
    """Of points on the curve there is none, even at the kink; signs tell the side."""
    x = np.array([0.0, 0.95, 1.0, 1.05, 2.0])
    assert np.abs(curve_residuals((x, np.abs(x - 1)), LINE, (0.1, 0.1))[0]).max() < 1e-12
    # A shift of 0.1 along x of a line of slope 1 is 0.1/sqrt(2) away where both sigmas are 1. Each
    # point may have its own, and a line may be drawn from either end.
    for line in (LINE, [axis[::-1] for axis in LINE]):
        found = curve_residuals(([0.5, 1.5], [0.6, 0.4]), line, ([1.0, 3.0], [1.0, 4.0]))[0]
        assert found == pytest.approx([0.1 / np.sqrt(2), -0.1 / 5])


def test_the_nearest_vertex_counts():
    vertices = ([0.0, 4.0], [2.0, 4.5])
    for y, sigmas, plain in ((4.5, 0, 0), (6.5, 4, 2), (4, -1, -0.5)):
        found = vertex_residuals(([4.0], [y]), vertices, (8.0, 0.5))
        assert [float(part[0]) for part in found[:2]] == [sigmas, plain]
        (off,), *_ = vertex_residuals(([4.0 + 8.0], [y]), vertices, (8.0, 0.5))
        assert off == np.copysign(np.hypot(sigmas, 1), plain)


def test_landmarks_of_a_curve_are_where_it_gets_there_to_rounding():
    x = np.array([0.0, 1.0, 3.0, 3.5, 4.0])
    assert landmarks.find("peak", x, -((x - 1.7) ** 2)) == pytest.approx(1.7, rel=1e-14)
    y = [0.2, 1 - 1e-13, 1 - 1e-15, 2.0, 0.5]
    assert [landmarks.find(kind, x, y, 1.0) for kind in ("first", "last")] == [3.0, 3.5]


def test_facts():
    fact = Fact("a/b", "N", value=20.0, tolerance=2.0)
    assert fact_residuals(21.0, fact)[0] == [-0.5]
    for kind, holds in (
        ("less_than", [True, False, False]),
        ("greater_than", [False, False, True]),
    ):
        found = [
            fact_residuals(value, Fact("a/b", "N", **{kind: 1.0}))[0][0]
            for value in (0.9, 1.0, 1.1)
        ]
        assert np.isfinite(found).tolist() == holds


@pytest.mark.parametrize("known", ["", Why.KNOWN])
def test_verdicts(known):
    """A verdict says what is so, whatever is known of a difference; a solver is right or wrong."""
    fact = Fact("maw1976/limit", "1", value=0.0, tolerance=1.0)
    differs = {"differs": {"why": known}} if known else {}
    for size, of_others, of_solver in (
        (1.0, Verdict.AGREES, Verdict.PASSED),
        (1.001, Verdict.DIFFERS, Verdict.FAILS),
        (np.inf, Verdict.DIFFERS, Verdict.FAILS),
        (np.nan, Verdict.DIFFERS, Verdict.FAILS),
    ):
        for sign, reference in itertools.product((-1, 1), (fact, None)):
            both = sign * size * np.array([[-1.0, 0.5], [-3.0, 1.5]])
            measured = Measured("x", np.zeros(2), *both, np.full(2, 3.0), ["y", "y"])
            own = Comparison("a", "landmark", "so", reference=reference, **differs)
            found = judge(own, measured, 0.01).verdict
            assert found == (of_others if reference else of_solver)


@pytest.mark.parametrize("of_sigma", [None, 4, 40])
@pytest.mark.parametrize("number", [1, 5, 17])
@pytest.mark.parametrize("parameter", [0.0, 1.0])
@pytest.mark.parametrize("error", [0.0995, 0.1005])
def test_points_agree_if_they_would_notice_an_error_of_a_tenth(number, of_sigma, parameter, error):
    """All lie as far beside it; one that is larger by `error` would fail in nine of ten cases."""
    known = Series("digitised", AXIS, AXIS, sigma_values=of_sigma)
    lacks = Series("digitised", AXIS, AXIS, sigma_values=of_sigma, unpublished="scatter of it")
    shifts = parameter * np.ones((1, number))  # an uncertain parameter moves all points
    degrees = number, of_sigma or 1e9
    spread = 1 + parameter * number

    def far(p):  # where p is that
        return np.sqrt(stats.f.isf(p, *degrees) * spread)

    def power(noncentrality):
        return stats.ncf.sf(stats.f.isf(0.001, *degrees), *degrees, noncentrality)

    needed = optimize.brentq(lambda one: power(one) - 0.9, 1.0, 1e4)
    y = np.sqrt(needed * spread / number) / error  # in sigmas

    def judged(sigmas, reference=known):
        numbers = np.zeros(number), np.full(number, sigmas), *np.zeros((2, number))
        places = np.full((number, 2), y)
        directions = np.tile([0.0, 1.0], (number, 1))
        measured = Measured("x", *numbers, ["y"] * number, (), shifts, of_sigma, places, directions)
        return judge(Comparison("a", "distance", "so", reference=reference), measured, 0.001)

    agree = Verdict.AGREES if error < 0.1 else Verdict.CANNOT_TELL
    for p, verdict in (
        (1.0, agree),
        (0.0101, agree),
        (0.0099, Verdict.CANNOT_TELL),
        (0.00101, Verdict.CANNOT_TELL),
        (0.00099, Verdict.DIFFERS),
    ):
        for sign in (-1, 1):
            found = judged(sign * far(p))
            assert found.verdict == verdict
            assert found.error == pytest.approx(error, rel=1e-3)
            # What sigma lacks explains a distance all the more, but nobody knows how far.
            agrees = verdict == Verdict.AGREES
            unknown = judged(sign * far(p), lacks)
            assert unknown.verdict == (Verdict.AGREES if agrees else Verdict.CANNOT_JUDGE)
            assert unknown.chi2 == found.chi2
    for reference in (known, lacks):
        assert judged(np.nan, reference).verdict == Verdict.DIFFERS
    for size, verdict in ((1.0, Verdict.PASSED), (1.001, Verdict.FAILS)):
        computed = Series("computed", AXIS, AXIS)
        found = {judged(size, computed).verdict, judged(-size, None).verdict}
        assert found == {verdict}


@pytest.mark.parametrize("values", [[3e-16, 0.0], [1.95, 2.0], [-0.5, 16.0]])
def test_the_ends_of_a_range_are_a_sigma_from_its_middle(values):
    """Up to the widest that is allowed."""
    curves = tables.curve({"x [1]": np.arange(2.0), "y [1]": values}, "a")
    least, largest = min(0.0, 100 * values[0]), max(values)

    def measured(low, high):
        law = Comparison("a", "range", "so", columns=["y [1]"], range=[low, high])
        return np.abs(measure(law, curves).sigmas).max()

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
        ({"points": {"e": 1}}, [1, 3, 5]),
    ],
)
@pytest.mark.parametrize("axis", ["incidence", "angle"])
def test_a_comparison_is_of_the_points_that_it_names(entry, chosen, axis, tmp_path):
    """Regimes begin at zeta^2 = 0.5 and beta + e beta - zeta^2/e = 3.5, with the points there."""
    path, x = tmp_path / "a.csv", np.array([0.0, 0.4999, 0.5, 3.4999, 3.5, 9.0])
    x = np.degrees(np.arctan(0.2 * x)) if axis == "angle" else x
    labels = {"reader": ["me", "you"] * 3, "run": list("111222"), "e": [0, 1] * 3}
    pd.DataFrame({axis: x, "row": range(6)} | labels).to_csv(path)
    columns = {"unit": "", "sigma": 1, "range": [0, 90]}
    groups = {"mass_ratio": 3.0, "stiffness_ratio": 0.5, "restitution": 0.5, "friction": 0.2}
    both = columns | {"column": axis}, columns | {"column": "row"}
    series = Series("computed", *both, str(path), labels=list(labels), parameters=groups)
    comparison = Comparison("a", "distance", "so", reference=series, **entry)
    assert comparison.selected_points(series)[0]["row"].tolist() == chosen


def test_a_contraction_is_of_the_curves_that_it_names():
    """Neighbours of one curve leave further apart than they arrive; the worst of each place counts.

    Rows may stand in any order. What is off by a sigma, and what is printed, need not obey.
    """
    x = np.array([2.0, 0.0, 1.0])
    slopes = [("lumped", 0, 1.5), ("lumped", 1, -0.5), ("continuum", 1, -3.0), ("printed", 1, 9.0)]
    curves = [tables.curve({"x [1]": x, "w [1]": k * x}, model, e=e) for model, e, k in slopes]
    off = {"x [1]": x, "w [1]": 9.0 * x}
    curves += [tables.curve(off, "lumped", e=0, shifted="mu", sigmas=sign) for sign in (1, -1)]
    table = tables.join(curves)
    for curve, excess in (
        ({"model": "lumped", "e": 1}, 0.0),
        ({"model": "lumped"}, 0.5),
        ({"model": ["lumped", "continuum"]}, 2.0),
        ({}, 2.0),
    ):
        law = Comparison(
            "a", "contraction", "so", curve=curve, columns=["x [1]", "w [1]"], limit=1.0
        )
        found = measure(law, table)
        assert found.at.tolist() == [1.0, 2.0] and found.sigmas.tolist() == [excess] * 2


def test_a_point_selects_its_curve_by_its_labels_unless_the_comparison_does(tmp_path):
    """Empty labels are those of a curve without; a column of another kind of label is no choice."""
    x, path = {"x [s]": [0.0, 1.0]}, tmp_path / "a.csv"
    curves = tables.join(
        tables.curve(x | {"y [N]": [level, level]}, model, variant, **own)
        for model, variant, own, level in (
            ("lumped", "", {"e": 0.5}, 1.0),
            ("lumped", "rubber", {"e": 0.5}, 2.0),
            ("printed", "", {"e": 0.5}, 3.0),
            ("printed", "", {}, 4.0),
        )
    )
    labels = ["model", "variant", "e", "reader"]
    rows = [
        "lumped,,0.5,I,0,1",
        "lumped,rubber,0.50,I,0,2",
        "printed,,0.5,I,0,3",
        "printed,,,I,0,4",
    ]
    path.write_text("\n".join([",".join([*labels, "x [s],y [N]"]), *rows]))
    y = AXIS | {"column": "y", "unit": "N", "range": [0.0, 9.0]}
    series = Series("computed", AXIS, y, str(path), labels=labels)
    for metric in ("distance", "vertices"):
        for curve, distances in (({}, [0, 0, 0, 0]), ({"model": "printed"}, [-2, None, 0, 0])):
            points = {"variant": ""} if curve else {}
            own = Comparison("a", metric, "so", reference=series, curve=curve, points=points)
            found = measure(own, curves)
            assert found.sigmas.tolist() == [gap for gap in distances if gap is not None]
    for curve, problem in (
        ({"model": "printed"}, "no curve has variant = rubber, e = 0.5, model"),
        (
            {"variant": "", "e": 0.5},
            "allowed is one curve, and these are selected: lumped, e = 0.5; pr",
        ),
        ({"model": "lumped", "e": "half"}, "e = 'half': allowed are numbers"),
        ({"variant": "", "e": 0.25}, "no curve has e = 0.25; there are: lumped, e = 0.5"),
    ):
        series = Series("computed", AXIS, y, str(path), labels=["variant", "e"])
        with pytest.raises(ValueError, match=problem):
            measure(Comparison("a", metric, "so", reference=series, curve=curve), curves)


# Comparison, and the cells from the verdict to what was stated, as far as a row has them.
CELLS = """
law,passed,,3,,0.5,0.5,N,,,,,,0.25,0.25,,
pair,FAILS,,3,,1.5,1.5,N,,,,,,1.5e+12,1.5e+12,,
span,passed,,3,,0.5,0.5,N,,,,,,0.5,0.5,0.5 to 0.5,
fact,differs,cause known,1,0.5,0.5,0.5,N,,,,,,2,2,0.5,1 N
sign,differs,cause unknown,1,0.5,0.5,0.5,N,,,,,,inf,inf,0.5,< 0
points,cannot tell,,3,1.41421,1.41,2,N,10.8,3,4,0.12,a curve 1100 % larger,2.83,4,,
same,cannot tell,,3,1.41421,1.41,2,N,10.8,3,4,0.12,a curve 1100 % larger,2.83,4,,
later,not compared,points awaited,,,,,,,,,,,,,,
both,FAILS,,4,1.41421,1.41,2,N,,,,,,3.16,4,,
other,not compared,other settings,,,,,,,,,,,,,,
none,FAILS,,,,,,,,,,,,,,,
"""
NOTES = {
    "pair": "largest for y [N] at x [s] = 0",
    "later": "Fig. 1",
    "other": "the reference is for e 0.5, this run has 0.4, 0.6",
    "both": "largest for y [N] of a at x [s] = 1",
    "none": "no such column: z; there are curve, model, variant, x [s], y [N], v [m], y_sigma [N]",
}
ALLOWED = {
    "law": "max <= 2 N", "pair": "max <= 1e-12 N", "span": "0 to 2", "fact": "max <= 0.25 N",
    "sign": "< 0", "points": "p > 0.01; the model may be off by x 0 s, y 0.4 N",
    "both": "max <= 0.5 N",
}  # fmt: skip


def test_a_row_has_what_was_measured(tmp_path):
    """Chi-squared by the covariance of an allowance and of uncertain parameters, common and own."""
    path, x = tmp_path / "a.csv", np.arange(3.0)

    def curve(y=0.5, **parameters):
        columns = {"x [s]": x, "y [N]": np.full(3, y), "v [m]": np.full(3, 2.0)}
        scattered = {} if parameters else {"y_sigma [N]": np.full(3, 0.5)}
        return tables.curve(columns | scattered, "a", **parameters)

    shifted = [curve(y, shifted="e", sigmas=sign) for y, sign in ((1.0, 1), (0.25, -1))]
    table = tables.join([curve(), *shifted])
    (tmp_path / "p.csv").write_text("x [s],y [N],v [m]\n0,1.5,\n1,2.5,\n2,-0.5,4.0\n")
    tables.write(path, table)
    axis = {"range": [-9, 9], "sigma": 0.3}
    read = {"kind": "digitised", "path": str(tmp_path / "p.csv"), "sigma_values": 4}
    axes = {name: axis | {"column": name, "unit": unit} for name, unit in ("xs", "yN", "vm")}
    read |= {"x": axes["x"], "y": axes["y"]}
    facts = {
        "fact": {"value": 1.0, "tolerance": 0.25, "unit": "N"},
        "sign": {"less_than": 0.0, "unit": "1"},
    }
    series = {
        "points": read,
        "both": read | {"kind": "computed", "y": [axes["y"], axes["v"]]},
        "later": read | {"kind": "awaited", "figure": "Fig. 1"},
        "other": read | {"settings": {"e": 0.5, "mu": 1}},
    }
    landmark = {"kind": "value", "x": "x [s]", "y": "y [N]", "at": 1}
    value = {"metric": "landmark", "landmark": landmark}
    known = {"differs": {"why": "cause known", "entry": "eq-1"}}
    fact = {"reference": "fact"}
    points = {"metric": "distance", "reference": "points", "allowance": {"x": 0.0, "y": 0.4}}
    entries = {
        "law": {"metric": "small", "columns": ["y [N]"], "limit": 2.0},
        "pair": {"metric": "small", "columns": ["y [N]", "v [m]"], "limit": 1e-12},
        "span": {"metric": "range", "columns": ["y [N]"], "range": [0.0, 2.0]},
        "fact": fact | value | known,
        "sign": {"reference": "sign"} | value,
        "points": points,
        "same": points | known,
        "later": points | {"reference": "later"},
        "both": points | {"reference": "both"},
        "other": points | {"reference": "other"},
        "none": {"metric": "small", "columns": ["z"]},
    }
    own = {"curve": {"model": "a"}, "reason": "so"}
    inventory = {"they": {"series": series, "facts": facts}}
    every = []
    for name, entry in entries.items():
        full = entry.get("reference")
        known = reference_data.reference(inventory, f"they/{full}") if full else None
        every.append(Comparison(name, **entry | own | {"reference": known}))
    settings = {"e": [0.4, 0.6], "mu": [1, 2]}
    rows = compare("fig0", path, every, 0.01, settings)
    cells = [[f"{row[key]}" for key in ("comparison", *COLUMNS[3:19])] for row in rows]
    assert [",".join(own) for own in cells] == CELLS.split("\n")[1:-1]
    assert {row["comparison"]: row["note"] for row in rows if row["note"]} == NOTES
    by_name = {row["comparison"]: row for row in rows}
    assert [name for name, row in by_name.items() if row["entry"]] == ["fact"]  # as it differs
    assert {name: by_name[name]["allowed"] for name in ALLOWED} == ALLOWED
    measured = "rms 1.41, max 2 N (rms 2.83 sigma); 3 points"
    assert verdict_table.measured(by_name["points"]) == measured
    said = verdict_table.problem(by_name["points"])
    assert said.startswith(f"{measured}; F test") and said.endswith(f"is {ALLOWED['points']}")
    write(rows, tmp_path / "verdicts.csv", tmp_path / "residuals.csv")
    residuals = pd.read_csv(tmp_path / "residuals.csv").set_index("comparison")
    assert residuals.loc[["fact"], "quantity"].tolist() == ["y [N]"]
    assert residuals.loc["points", "at"].tolist() == [0, 1, 2]
    assert residuals.loc["points", "distance [sigma]"].tolist() == pytest.approx([2, 4, -2])
    for wrong in (np.inf, "nan", "a word"):
        table.astype(object).replace({"y [N]": {0.5: wrong}}).to_csv(path, index=False)
        with pytest.raises(ValueError, match="allowed are finite numbers"):
            compare("fig0", path, every, 0.01, settings)
