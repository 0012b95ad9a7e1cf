"""Whoever owns the paper can fill an awaited series by dropping in an export: tried on a copy.

The points are made up from the solver's own curve, and never enter data/.
"""

import csv
import re

import numpy as np
import pytest

from planarimpact import lumped

RUBBER = "data/johnson1983/rubber_sphere.wpd.csv"


def made_up(shift=0.0):
    """Incidence and velocity of a rubber sphere with a little scatter."""
    rng = np.random.default_rng(3)
    x = np.linspace(0.3, 7.5, 25)
    w = lumped.rebound(x, 3.5, 1.5, 1.0).velocity + shift
    return x + rng.normal(0, 0.02, x.size), w + rng.normal(0, 0.02, x.size)


def write_export(project, x, w, name=None):
    """The two forms of WebPlotDigitizer's export: one dataset, or all under two headers."""
    rows = [f"{a:.6f}, {b:.6f}" for a, b in zip(x, w, strict=True)]
    if name:
        rows = [f"Default Dataset,,{name},", "X,Y,X,Y", *(f"1.0, 1.0, {row}" for row in rows)]
    (project / RUBBER).write_text("\n".join(rows) + "\n")


def sign(project, text="digitised_by: a test, with made-up points"):
    project.edit("data/johnson1983/source.yaml", "digitised_by: null", text)


def verdict(project):
    with open(project / "results/verdicts/fig5.csv", newline="") as file:
        rows = {row["comparison"]: row for row in csv.DictReader(file)}
    return rows["fig5-rubber-sphere"]


@pytest.mark.parametrize("name", [None, "rubber_sphere"])
def test_an_export_dropped_in_is_converted_drawn_and_judged(finished, name):
    write_export(finished, *made_up(), name)
    sign(finished)
    result = finished.run()
    assert result.returncode == 0, result.stdout
    assert verdict(finished)["verdict"] == "agrees"
    assert verdict(finished)["points"] == "25"
    table = (finished / "results/series/johnson1983.csv").read_text()
    assert table.startswith("series,incidence [mu v2(0)],velocity [mu v2(0)]\nrubber_sphere,")
    assert "Drawing fig5" in result.stdout and "Drawing fig6" not in result.stdout


def test_points_off_the_curve_fail_the_run(finished):
    write_export(finished, *made_up(shift=1.0))
    sign(finished)
    assert finished.run().returncode != 0
    assert verdict(finished)["verdict"] == "diverges"


def test_an_export_without_provenance_is_refused(fresh):
    write_export(fresh, *made_up())
    result = fresh.run()
    assert result.returncode != 0
    assert re.search("whose work.*digitised_by", result.stdout, re.S)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("0.5, -0.1\n1.0, many\n", "line 2, column .*: ' many' is not a number"),
        ("0.5, -0.1\n100.0, 0.0\n", "line 2, .*: 100.0 is outside 0 to 20"),
        ("0.5\n", "line 1: 1 cells where 2 belong"),
        ("", "no points"),
        ("a,,b,\nX,Y,X,Y\n1,1,2,2\n", r"several datasets \(a, b\); call one 'rubber_sphere'"),
    ],
)
def test_a_bad_export_is_refused(fresh, text, words):
    (fresh / RUBBER).write_text(text)
    sign(fresh)
    fresh.refuses(words)


def test_every_awaited_gate_can_fail(finished):
    """Each awaited comparison, filled with points far off, diverges."""
    far = {
        "johnson1983/rubber_sphere": [(x, 2.0) for x in np.linspace(0.5, 6, 12)],
        "lewis_rogers1988/normal_force": [(t, 5.0) for t in np.linspace(5, 60, 12)],
        "lewis_rogers1988/friction_force": [(t, 60.0) for t in np.linspace(5, 60, 12)],
    }
    for name, points in far.items():
        source, series = name.split("/")
        rows = "\n".join(f"{x}, {y}" for x, y in points)
        (finished / f"data/{source}/{series}.wpd.csv").write_text(rows + "\n")
        path = f"data/{source}/source.yaml"
        text = (finished / path).read_text()
        (finished / path).write_text(text.replace("by: null", "by: a test, made up"))
    assert finished.run().returncode != 0
    with open(finished / "results/verdicts.csv", newline="") as file:
        bad = {row["comparison"] for row in csv.DictReader(file) if row["verdict"] == "diverges"}
    assert bad == {
        "fig5-rubber-sphere",
        "fig8-normal-force-measured",
        "fig8-friction-force-measured",
    }
