"""Whoever owns the paper can fill an awaited series by dropping in a table: tried on a copy.

The points are made up from the solver's own curves, and never enter data/. These tests
load and compare as the jobs of a run do; a whole run is in test_run.py.
"""

from pathlib import Path

import numpy as np
import pytest

from planarimpact import continuum, lumped
from stronge1994 import csv_tables, plan, reference_data
from stronge1994.figures.fig8 import curves as fig8
from stronge1994.judging import compare
from stronge1994.plan import config as configuration

ROOT = Path(__file__).parents[2]
CONFIG = configuration.load(ROOT)
SCHEMA = reference_data.load_yaml(ROOT / "workflow/schemas/source.schema.yaml")
JOHNSON, LEWIS = "johnson1983", "lewis_rogers1988"
RUBBER = f"{JOHNSON}/rubber_sphere"
# The awaited series, and what is compared with each.
AWAITED = {
    RUBBER: "fig5-rubber-sphere",
    f"{LEWIS}/normal_force": "fig8-normal-force-measured",
    f"{LEWIS}/friction_force": "fig8-friction-force-measured",
}


def made_up():
    """Incidence and velocity of a rubber sphere with a little scatter."""
    rng = np.random.default_rng(3)
    x = np.linspace(0.3, 7.5, 25)
    w = lumped.rebound(x, 3.5, 1.5, 1.0).velocity
    return x + rng.normal(0, 0.02, x.size), w + rng.normal(0, 0.02, x.size)


def filled(name, points):
    """The source.yaml of an awaited series, which says that it is digitised."""
    source, series = name.split("/")
    text = (ROOT / f"data/{source}/source.yaml").read_text()
    awaited = f"  {series}:\n    kind: awaited\n"
    assert awaited in text
    said = f"    points: {points}\n    digitised_by: a test, with made-up points\n"
    return text.replace(awaited, f"  {series}:\n    kind: digitised\n{said}")


def written(name, x, y):
    """Text of the table of an awaited series."""
    header = (
        "angle [deg],peak_force [N]"
        if LEWIS in name
        else "incidence [mu v2(0)],velocity [mu v2(0)]"
    )
    return "\n".join([header, *(f"{a:.6f},{b:.6f}" for a, b in zip(x, y, strict=True))]) + "\n"


@pytest.fixture(scope="module")
def curves(inventory, tmp_path_factory):
    """Tables of Figs 5 and 8 as the config has them: of Fig. 5 the curve that is judged."""
    folder = tmp_path_factory.mktemp("curves")
    x = np.linspace(0.0, 20.0, 2001)
    rubber = CONFIG["figures"]["fig5"]["rubber"]["stiffness_ratio"]
    w = lumped.rebound(x, CONFIG["mass_ratio"], rubber, 1.0).velocity
    of_rubber = {"incidence [mu v2(0)]": x, "velocity [mu v2(0)]": w}
    csv_tables.write(folder / "fig5.csv", {"lumped, rubber": of_rubber})
    settings = plan.settings(CONFIG, inventory, "fig8") | {"samples": 180}
    csv_tables.write(folder / "fig8.csv", fig8.curves(**settings))
    return folder


@pytest.fixture
def judged(inventory, curves, tmp_path):
    """Row of the verdict table for points, after edits of source.yaml and of the comparison."""

    def row(name, x, y, edits=None, **change):
        source, figure = name.split("/")[0], AWAITED[name].split("-")[0]
        folder = tmp_path / source
        folder.mkdir(exist_ok=True)
        (tmp_path / f"{name}.csv").write_text(written(name, x, y))
        words = filled(name, len(x))
        for old, new in (edits or {}).items():
            assert old in words
            words = words.replace(old, new)
        (folder / "source.yaml").write_text(words)
        found = inventory | {source: reference_data.load(folder, SCHEMA)}
        entry = CONFIG["comparisons"][AWAITED[name]] | change
        references = plan.references(CONFIG, found, figure)
        path, significance = curves / f"{figure}.csv", CONFIG["significance"]
        rows = {AWAITED[name]: entry}
        return compare(figure, rows, references, path, significance)[1]

    return row


def test_points_that_scatter_about_the_model_agree(judged):
    row = judged(RUBBER, *made_up())
    assert row["verdict"] == "agrees" and row["points"] == 25


def line(name, curves):
    """The curve that a series is compared with."""
    figure, *words = AWAITED[name].split("-")
    table = csv_tables.read(curves / f"{figure}.csv")
    return list(table["lumped, rubber" if name == RUBBER else words[0]].values())[:2]


def on_the_curve(name, curves, points):
    """Points evenly spread over the figure."""
    x = np.linspace(0.5, 7.5, points) if name == RUBBER else np.linspace(5.0, 80.0, points)
    return x, np.interp(x, *line(name, curves))


@pytest.mark.parametrize(
    ("name", "off"),
    [
        (RUBBER, 0.2),  # mu v2(0), a tenth of the largest velocity
        (f"{LEWIS}/normal_force", 7.0),  # N, of 94
        (f"{LEWIS}/friction_force", 1.6),  # N, of 15
    ],
)
def test_nine_points_that_are_all_off_diverge(name, off, curves, judged):
    x, y = on_the_curve(name, curves, 9)
    for shift, verdict in ((0.0, "agrees"), (off, "diverges"), (-off, "diverges")):
        row = judged(name, x, y + shift)
        assert (row["points"], row["verdict"]) == (9, verdict), shift


def test_every_awaited_comparison_is_tried_here(inventory):
    awaited = {
        name: comparison
        for comparison, entry in CONFIG["comparisons"].items()
        if (name := entry.get("reference"))
        and configuration.reference(inventory, name).get("kind") == "awaited"
    }
    assert awaited == AWAITED


def test_few_points_on_the_curve_are_inconclusive(curves, judged):
    """Three are enough to agree, as they would not agree if they lay two sigmas off."""
    verdicts = [judged(RUBBER, *on_the_curve(RUBBER, curves, n))["verdict"] for n in (2, 3)]
    assert verdicts == ["inconclusive", "agrees"]


def continuum_says(name):
    """Points that the elastic continuum gives over the range that the figure shows."""
    if name == RUBBER:
        x = np.linspace(0.0, 8.0, 33)
        return x, continuum.rebound(x, stiffness_ratio=1.5, tolerance=1e-3).velocity
    settings = CONFIG["figures"]["fig8"]
    angle = np.linspace(0.0, 88.0, 34)
    normal, friction = np.cos(np.radians(angle)), settings["friction"]
    # Hertz' force at normal incidence, 93.6 N, and as the 6/5th power of the normal velocity.
    force = 93.6 * normal**1.2
    if name.endswith("normal_force"):
        return angle, force
    incidence = np.tan(np.radians(angle)) / friction
    peak = continuum.rebound(incidence, stiffness_ratio=1.21, tolerance=1e-3).peak_friction
    return angle, friction * force * peak


@pytest.mark.parametrize("name", AWAITED)
def test_the_allowance_is_what_is_known_of_the_form_of_the_model(name, curves, judged):
    """So points read without error do not fail a model that is known to be off by that much."""
    x, y = continuum_says(name)
    rms = np.sqrt(np.mean((y - np.interp(x, *line(name, curves))) ** 2))
    allowance = CONFIG["comparisons"][AWAITED[name]]["allowance"]
    assert allowance == {"x": 0.0, "y": pytest.approx(rms, rel=0.05)}
    expected = "sigma: 0.03" if name == RUBBER else "sigma: 0.5"
    row = judged(name, x, y, {expected: "sigma: 1.0e-4"})
    # The continuum's friction lies below the model's nearly everywhere, by about one allowance.
    assert row["verdict"] == ("inconclusive" if "friction" in name else "agrees")
    assert f" {allowance['y']:g} " in row["allowed"]


def test_with_the_most_that_is_admitted_the_comparison_can_still_fail(curves, judged):
    """The largest sigmas and the largest allowance, each a share of the range of its axis."""
    spans, edits = {"x": (0, 10), "y": (-3, 3)}, {}
    for low, high in spans.values():
        most = reference_data.LARGEST_SIGMA * (high - low)
        range_ = f", range: [{low}, {high}]"
        edits[f"sigma: 0.03{range_}"] = f"sigma: {most}{range_}"
    allowance = {
        axis: configuration.LARGEST_ALLOWANCE * (high - low) for axis, (low, high) in spans.items()
    }
    x, y = on_the_curve(RUBBER, curves, 9)
    for shift in (0.42, -0.42):
        row = judged(RUBBER, x, y + shift, edits, allowance=allowance)
        assert row["verdict"] == "diverges"


@pytest.mark.parametrize(
    ("regime", "points"),
    [(None, 5), ("initial stick", 2), ("slip and stick", 2), ("slip throughout", 1)],
)
def test_a_regime_chooses_its_points(regime, points, judged):
    """Of the rubber sphere they begin at zeta^2 = 1.5 and 2 beta - zeta^2 = 5.5."""
    x, y = [-0.05, 1.49, 1.51, 5.49, 5.51], [0.0, 0.0, 0.0, 0.0, 0.0]
    assert judged(RUBBER, x, y, **({"regime": regime} if regime else {}))["points"] == points


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"allowance": {"x": 0.3}}, "allowance: 'y' is a required property"),
        ({"allowance": {"x": 0.3, "y": -1}}, "allowance.y: -1 is less than the minimum of 0"),
        ({"metric": "small", "columns": ["a"]}, "metric: 'small' is not one of"),
    ],
)
def test_an_allowance_that_means_nothing_is_refused(change, words):
    comparisons = CONFIG["comparisons"]
    entry = comparisons["fig5-rubber-sphere"] | change
    config = CONFIG | {"comparisons": comparisons | {"fig5-rubber-sphere": entry}}
    with pytest.raises(reference_data.SourceError, match=words):
        reference_data.refuse_invalid(config, configuration.schema(), "config")
