"""Spheres that yield: the tables of finite elements, and the law that is held against them."""

import importlib.util
import shutil
import sys
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from planarimpact.continuum.inelastic.plastic import PlasticMotion
from planarimpact.normal_impact import yielding as law
from stronge1994 import csv_tables, plan, reference_data
from stronge1994.figures.shared.curves import solving
from stronge1994.figures.yielding import curves as yielding
from stronge1994.judging import compare
from stronge1994.plan import config as configuration
from stronge1994.verdict_tables.verdict_table import FAILS

ROOT = Path(__file__).parents[2]
SOURCE = ROOT / "data/finite_elements"
SCHEMA = reference_data.load_yaml(ROOT / "workflow/schemas/source.schema.yaml")
LAW = "yielding-flows-in-shear-nu-0.3-mu-0.1-e-"
W = "velocity [mu v2(0)]"


@pytest.fixture(scope="module")
def make():
    spec = importlib.util.spec_from_file_location("make", SOURCE / "make.py")
    module = importlib.util.module_from_spec(spec)
    with pytest.MonkeyPatch.context() as patch:  # a folder of bytecode would be a stray
        patch.setattr(sys, "dont_write_bytecode", True)
        spec.loader.exec_module(module)
    return module


@pytest.fixture
def verdicts(tmp_path, monkeypatch):
    """Verdicts on the law that flows, with a factor of its constant."""
    inventory = reference_data.load_all(ROOT / "data", SCHEMA)
    config = configuration.load(ROOT)
    nodes = plan.nodes_of(config, inventory, "yielding")
    settings = plan.settings(config, inventory, "yielding") | solving.read_nodes(nodes)
    references = plan.references(config, inventory, "yielding")
    entries = {
        title: entry
        for title, entry in plan.comparisons(config, "yielding").items()
        if title.startswith((LAW, "yielding-pushed-e"))
    }
    table = str(tmp_path / "curves.csv")
    monkeypatch.setattr(yielding, "MODELS", ("continuum.plastic",))

    def judged(factor):
        monkeypatch.setattr(PlasticMotion, "flows", factor * law.FLOW)
        csv_tables.write(table, yielding.curves(**settings | {"samples": 11}))
        rows = compare("yielding", entries, references, table, config["significance"])
        return {row["comparison"]: row["verdict"] for row in rows[1:]}

    return judged


def test_the_constant_is_that_of_the_calibration(verdicts):
    assert not set(verdicts(1.0).values()) & set(FAILS)


@pytest.mark.parametrize("factor", [0.6, 1.4])
def test_a_wrong_constant_trips_the_gate(factor, verdicts):
    """Also runs that it was not fixed on see it, and the contacts that are pushed."""
    found = verdicts(factor)
    wrong = {title for title, verdict in found.items() if verdict in FAILS}
    seen = {title.removeprefix(LAW) for title in wrong}
    assert seen & {"0.66", "0.72", "0.81"}
    assert any(title.startswith("yielding-pushed") for title in wrong)


def test_the_series_follow_from_the_runs(make):
    runs = pd.read_csv(make.RUNS)
    for name, table in make.series(runs).items():
        written = (SOURCE / f"{name}.csv").read_text(encoding="utf-8")
        assert table.to_csv(index=False, lineterminator="\n") == written


def test_what_makes_the_series_is_there_and_nothing_else(tmp_path):
    folder = tmp_path / "finite_elements"
    shutil.copytree(SOURCE, folder)
    reference_data.load(folder, SCHEMA)
    (folder / "stray.csv").write_text("x,y\n")
    with pytest.raises(reference_data.SourceError, match="stray.csv: no series of that name"):
        reference_data.load(folder, SCHEMA)
    (folder / "stray.csv").rename(folder / "series.cpp")
    with pytest.raises(reference_data.SourceError, match="series.cpp: no series of that name"):
        reference_data.load(folder, SCHEMA)
    (folder / "series.cpp").replace(folder / "impact.cpp")
    (folder / "runs.csv").unlink()
    with pytest.raises(reference_data.SourceError, match="runs.csv: missing"):
        reference_data.load(folder, SCHEMA)


def test_sigma_is_that_of_elements_and_meshes(make):
    """The numbers that source.yaml states."""
    found = make.uncertainty(pd.read_csv(make.RUNS))
    stated = reference_data.load(SOURCE, SCHEMA)["series"]["spheres"]
    for number in found.values():
        words = f"{number:g}" if number == int(number) else f"{number:.3f}"
        assert number < 0 or words in stated["sigma_origin"]
    both = np.hypot(*(found[name] for name in found if "root mean square" in name))
    assert both < stated["y"]["sigma"] < 2 * both


def test_every_run_is_in_the_plan(make):
    runs = pd.read_csv(make.RUNS)[make.KEY]
    planned = [tuple(case[name] for name in make.KEY) for case in make.plan()]
    assert set(runs.itertuples(index=False, name=None)) == set(planned)


def test_what_slides_throughout_has_the_velocity_of_its_friction():
    spheres = pd.read_csv(SOURCE / "spheres.csv")
    slides = spheres[(spheres["set"] == "slip throughout") & (spheres["restitution [1]"] > 0.5)]
    line = slides["incidence [mu v2(0)]"] - 3.5 * (1 + slides["restitution [1]"])
    assert len(slides) == 7
    np.testing.assert_allclose(slides[W], line, atol=2e-3)


def test_a_pushed_contact_that_never_yields_stays_elastic():
    approach, share = yielding.share_of_elastic(1.0)
    np.testing.assert_allclose(share, 1.0, rtol=1e-9)
    assert approach[-1] == 1 and np.all(np.diff(approach) > 0)
