"""Whoever owns the paper can fill an awaited series by dropping in one file: tried on a copy.

The points are made up from the solver's own curves, and never enter data/. These tests
load and compare as the jobs of a run do; a whole run is in test_run.py.
"""

import shutil

import numpy as np
import pandas as pd
import pytest

from planarimpact import continuum, lumped
from stronge1994 import reference_data, tables
from stronge1994 import settings as figure_settings
from stronge1994.figures.fig8 import curves as fig8
from stronge1994.judging import compare
from tests.workflow.project import ROOT, awaited, config, head, schema

CONFIG = config()
RUBBER, LEWIS = "johnson1983/rubber_sphere", "lewis_rogers1988"
# The awaited series, and what is compared with each.
AWAITED = {CONFIG["comparisons"][name]["reference"]: name for name in awaited()}


# What is off by so much diverges.
OFF = {
    RUBBER: 0.2,  # mu v2(0), a tenth of the largest velocity
    f"{LEWIS}/normal_force": 7.0,  # N, of 94
    f"{LEWIS}/friction_force": 1.6,  # N, of 15
}


@pytest.fixture(scope="module")
def curves(inventory, tmp_path_factory):
    """Tables of Figs 5 and 8 as the config has them: of Fig. 5 the curve that is judged."""
    folder = tmp_path_factory.mktemp("curves")
    x = np.linspace(0.0, 20.0, 2001)
    rubber = CONFIG["figures"]["fig5"]["rubber"]["stiffness_ratio"]
    w = lumped.rebound(x, CONFIG["mass_ratio"], rubber, 1.0).velocity
    of_rubber = {"incidence [mu v2(0)]": x, "velocity [mu v2(0)]": w}
    tables.write(folder / "fig5.csv", tables.curve(of_rubber, "lumped", "rubber"))
    settings = figure_settings.physics(CONFIG, inventory, "fig8") | {"samples": 180}
    tables.write(folder / "fig8.csv", fig8.curves(**settings))
    return folder


@pytest.fixture
def judged(inventory, curves, tmp_path):
    """Row of the verdict table for points."""

    def row(name, x, y):
        source, figure = name.split("/")[0], AWAITED[name].split("-")[0]
        folder = tmp_path / source
        folder.mkdir(exist_ok=True)
        series = inventory[source]["series"][name.split("/")[1]]
        known = reference_data.Series(**series)
        points = pd.DataFrame({known.x.name: x, known.y.name: y})
        sigmas = {"sigma_x": known.x.sigma, "sigma_y": known.y.sigma}
        (tmp_path / f"{name}.csv").write_text(head(**sigmas) + points.to_csv(index=False))
        shutil.copy(ROOT / f"data/{source}/source.yaml", folder)
        found = inventory | {source: reference_data.load(folder, schema("source"))}
        references = figure_settings.references(CONFIG, found, figure)
        path, rows = curves / f"{figure}.csv", {AWAITED[name]: CONFIG["comparisons"][AWAITED[name]]}
        return compare(figure, path, rows, references, CONFIG["significance"], {})[0]

    return row


def line(name, curves):
    """The curve that a series is compared with."""
    table = tables.read(curves / f"{AWAITED[name].split('-')[0]}.csv")
    own = tables.select(table, **CONFIG["comparisons"][AWAITED[name]]["curve"])
    return own[list(filter(tables.is_quantity, own))[:2]].to_numpy().T


@pytest.mark.parametrize("name", OFF)
def test_nine_points_that_are_all_off_diverge(name, curves, judged):
    """Those that scatter about the curve agree."""
    x = np.linspace(0.5, 7.5, 9) if name == RUBBER else np.linspace(5.0, 80.0, 9)
    y = np.interp(x, *line(name, curves))
    scatter = 0.1 * OFF[name] * np.random.default_rng(3).normal(size=9)
    for shift, verdict in ((scatter, "agrees"), (OFF[name], "FAILS"), (-OFF[name], "FAILS")):
        row = judged(name, x, y + shift)
        assert (row["points"], row["verdict"]) == (9, verdict), shift


def continuum_says(name):
    """Points that the elastic continuum gives over the range that the figure shows."""
    if name == RUBBER:
        x = np.linspace(0.0, 8.0, 33)
        return x, continuum.rebound(x, stiffness_ratio=1.5, tolerance=1e-3).velocity
    friction, angle = CONFIG["figures"]["fig8"]["friction"], np.linspace(0.0, 88.0, 34)
    # Hertz' force at normal incidence, 93.6 N, and as the 6/5th power of the normal velocity.
    force = 93.6 * np.cos(np.radians(angle)) ** 1.2
    if name.endswith("normal_force"):
        return angle, force
    incidence = np.tan(np.radians(angle)) / friction
    peak = continuum.rebound(incidence, stiffness_ratio=1.21, tolerance=1e-3).peak_friction
    return angle, friction * force * peak


@pytest.mark.parametrize("name", OFF)
def test_the_allowance_is_what_is_known_of_the_form_of_the_model(name, curves):
    """So points read without error do not fail a model that is known to be off by that much."""
    x, y = continuum_says(name)
    rms = np.sqrt(np.mean((y - np.interp(x, *line(name, curves))) ** 2))
    allowance = CONFIG["comparisons"][AWAITED[name]]["allowance"]
    assert allowance == {"x": 0.0, "y": pytest.approx(rms, rel=0.05)}
