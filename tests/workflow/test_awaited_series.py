"""Whoever owns the paper can fill an awaited series by dropping in an export: tried on a copy.

The points are made up from the solver's own curves, and never enter data/. These tests
load, convert and compare as the jobs of a run do; a whole run is in test_verdict.py.
"""

from pathlib import Path

import numpy as np
import pytest

from planarimpact import continuum, lumped
from stronge1994 import csv_tables, plan, reference_data
from stronge1994.figures.fig5 import curves as fig5
from stronge1994.figures.fig5 import drawing as draw_fig5
from stronge1994.figures.fig8 import curves as fig8
from stronge1994.figures.fig8 import drawing as draw_fig8
from stronge1994.judging import compare
from stronge1994.plan import config as configuration
from stronge1994.reference_data import conversion

ROOT = Path(__file__).parents[2]
CONFIG = configuration.load(ROOT)
SCHEMA = reference_data.load_yaml(ROOT / "workflow/schemas/source.schema.yaml")
UNSIGNED, SIGNED = "digitised_by: null", "digitised_by: a test, with made-up points"
JOHNSON, LEWIS = "johnson1983", "lewis_rogers1988"
RUBBER = f"{JOHNSON}/rubber_sphere"
# The awaited series, and what is compared with each.
AWAITED = {
    RUBBER: "fig5-rubber-sphere",
    f"{LEWIS}/normal_force": "fig8-normal-force-measured",
    f"{LEWIS}/friction_force": "fig8-friction-force-measured",
}


def made_up(shift=0.0, scatter=0.02):
    """Incidence and velocity of a rubber sphere with a little scatter."""
    rng = np.random.default_rng(3)
    x = np.linspace(0.3, 7.5, 25)
    w = lumped.rebound(x, 3.5, 1.5, 1.0).velocity + shift
    return x + rng.normal(0, scatter, x.size), w + rng.normal(0, scatter, x.size)


def export(x, y, name=None):
    """The two forms of WebPlotDigitizer's export: one dataset, or all under two headers."""
    rows = [f"{a:.6f}, {b:.6f}" for a, b in zip(x, y, strict=True)]
    if name:
        rows = [f"Default Dataset,,{name},", "X,Y,X,Y", *(f"1.0, 1.0, {row}" for row in rows)]
    return "\n".join(rows) + "\n"


@pytest.fixture(scope="module")
def inventory():
    return reference_data.load_all(ROOT / "data", SCHEMA)


@pytest.fixture(scope="module")
def curves(inventory, tmp_path_factory):
    """Tables of Figs 5 and 8 as the config has them, the continuum left coarse."""
    folder, coarse = (
        tmp_path_factory.mktemp("curves"),
        {
            "tolerance": 1e-2,
            "loss_tolerance": 1e-2,
            "as_printed": False,
        },
    )
    for module, change in ((fig5, coarse), (fig8, {})):
        figure = module.__name__.split(".")[-2]
        settings = plan.settings(CONFIG, inventory, figure) | change
        settings["samples"] //= 5
        csv_tables.write(folder / f"{figure}.csv", module.curves(**settings))
    return folder


@pytest.fixture
def judged(inventory, curves, tmp_path):
    """Row of the verdict table for an export, after edits of source.yaml and of the comparison."""

    def row(name, text, edits=None, **change):
        source, figure = name.split("/")[0], AWAITED[name].split("-")[0]
        folder = tmp_path / source
        folder.mkdir()
        (tmp_path / f"{name}.wpd.csv").write_text(text)
        words = (ROOT / f"data/{source}/source.yaml").read_text()
        for old, new in ({UNSIGNED: SIGNED} if edits is None else edits).items():
            assert old in words
            words = words.replace(old, new)
        (folder / "source.yaml").write_text(words)
        found = inventory | {source: reference_data.load(folder, SCHEMA)}
        conversion.convert(found[source], folder / "series.csv")
        entry = CONFIG["comparisons"][AWAITED[name]] | change
        references = plan.references(CONFIG, found, figure)
        tables = {source: folder / "series.csv"}
        path, significance = curves / f"{figure}.csv", CONFIG["significance"]
        rows = {AWAITED[name]: entry}
        return compare(figure, rows, references, path, tables, significance)[1]

    return row


@pytest.mark.parametrize("name", [None, "rubber_sphere"])
def test_both_forms_of_an_export_agree_with_the_model(name, judged):
    row = judged(RUBBER, export(*made_up(), name))
    assert row["verdict"] == "agrees" and row["points"] == 25


def test_points_off_the_curve_diverge(judged):
    assert judged(RUBBER, export(*made_up(shift=1.0)))["verdict"] == "diverges"


@pytest.mark.parametrize(
    ("name", "x", "y"),
    [
        (RUBBER, np.linspace(0.5, 6, 12), 2.0),
        (f"{LEWIS}/normal_force", np.linspace(5, 60, 12), 5.0),
        (f"{LEWIS}/friction_force", np.linspace(5, 60, 12), 60.0),
    ],
)
def test_every_awaited_gate_can_fail(name, x, y, judged):
    assert judged(name, export(x, np.full(12, y)))["verdict"] == "diverges"


def test_every_awaited_comparison_is_tried_here(inventory):
    awaited = {
        name: comparison
        for comparison, entry in CONFIG["comparisons"].items()
        if (name := entry.get("reference"))
        and configuration.reference(inventory, name)[1].get("kind") == "awaited"
    }
    assert awaited == AWAITED


def test_careful_points_do_not_fail_the_form_of_the_model(judged):
    """What the continuum says of rubber, read without error: off by up to 0.12 mu v2(0)."""
    x = np.linspace(0.0, 7.5, 31)
    exact = continuum.rebound(x, stiffness_ratio=1.5, tolerance=1e-3).velocity
    careful = {UNSIGNED: SIGNED, "sigma: 0.03": "sigma: 1.0e-4"}
    row = judged(RUBBER, export(x, exact), careful)
    assert row["verdict"] == "agrees"
    assert row["allowed"] == (
        "p > 0.01; 1 is incidence 0.3 mu v2(0), velocity 0.3 mu v2(0): allowance for the "
        "model and sigma together"
    )


def test_careless_points_do_not_pass_a_bad_model(judged):
    """With the largest sigmas that are admitted, the tolerance is still near the allowance."""
    careless = {
        UNSIGNED: SIGNED,
        "sigma: 0.03, range: [0, 20]": "sigma: 0.2, range: [0, 20]",
        "sigma: 0.03, range: [-5, 20]": "sigma: 0.25, range: [-5, 20]",
    }
    row = judged(RUBBER, export(*made_up(shift=1.0)), careless)
    assert row["verdict"] == "diverges" and "velocity 0.391 mu v2(0)" in row["allowed"]


@pytest.mark.parametrize(
    ("name", "size"),
    [
        (RUBBER, "incidence 0.301 mu v2(0), velocity 0.301 mu v2(0)"),  # was 10 sigmas of 0.03
        (f"{LEWIS}/normal_force", "angle 1.49 deg, peak force 1.49 N"),  # was 3 sigmas of 0.5
        (f"{LEWIS}/friction_force", "angle 1.49 deg, peak force 1.49 N"),
    ],
)
def test_at_the_expected_sigmas_the_tolerance_is_what_it_was(name, size, judged):
    assert f"; 1 is {size}: " in judged(name, export([1.0], [1.0]))["allowed"]


@pytest.mark.parametrize(
    ("regime", "points"),
    [(None, 5), ("initial stick", 2), ("slip and stick", 2), ("slip throughout", 1)],
)
def test_a_regime_chooses_its_points(regime, points, judged):
    """Of the rubber sphere they begin at zeta^2 = 1.5 and 2 beta - zeta^2 = 5.5."""
    text = export([-0.05, 1.49, 1.51, 5.49, 5.51], [0.0, 0.0, 0.0, 0.0, 0.0])
    assert judged(RUBBER, text, **({"regime": regime} if regime else {}))["points"] == points


@pytest.mark.parametrize(
    ("module", "name"),
    [(draw_fig5, RUBBER), *((draw_fig8, name) for name in list(AWAITED)[1:])],
)
def test_a_point_just_outside_the_axes_is_drawn(module, name, inventory, curves):
    figure = module.__name__.split(".")[-2]
    points = {
        name: {"x": np.array([-0.05, 1.0]), "y": np.array([0.0, 0.1]), "sigma": (0.1, 0.1),
               "line": False, "parameters": {}}
    }  # fmt: skip
    settings = plan.settings(CONFIG, inventory, figure)
    drawn = module.draw(csv_tables.read(curves / f"{figure}.csv"), settings, points)
    assert drawn.axes[0].get_xlim()[0] == -0.05


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"allowance": {"x": 0.3}}, "allowance: 'y' is a required property"),
        ({"allowance": {"x": 0.3, "y": -1}}, "allowance.y: -1 is less than the minimum of 0"),
        ({"metric": "balance", "columns": ["a", "b"]}, "metric: 'balance' is not one of"),
    ],
)
def test_an_allowance_that_means_nothing_is_refused(change, words):
    comparisons = CONFIG["comparisons"]
    entry = comparisons["fig5-rubber-sphere"] | change
    config = CONFIG | {"comparisons": comparisons | {"fig5-rubber-sphere": entry}}
    with pytest.raises(reference_data.SourceError, match=words):
        reference_data.refuse_invalid(config, configuration.schema(), "config")


def test_an_export_without_provenance_is_refused(judged):
    with pytest.raises(reference_data.SourceError, match="whose work.*digitised_by"):
        judged(RUBBER, export(*made_up()), {})


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("0.5, -0.1\n1.0, many\n", "line 2, column .*: 'many' is not a decimal number"),
        ("0.5, -0.1\n100.0, 0.0\n", "line 2, .*: 100.0 is outside 0 to 20"),
        ("0.5\n", "line 1: '0.5' has one column; put a comma between x and y"),
        ("", "no points"),
        ("a,,b,\nX,Y,X,Y\n1,1,2,2\n", "datasets 'a', 'b'; call one 'rubber_sphere'"),
    ],
)
def test_a_bad_export_is_refused(text, words, judged):
    with pytest.raises(reference_data.SourceError, match=words):
        judged(RUBBER, text)
