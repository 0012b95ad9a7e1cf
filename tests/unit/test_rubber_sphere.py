"""A rubber sphere, measured: what its markers say, and what is said of them in words."""

from pathlib import Path

import numpy as np
import pytest

from stronge1994 import csv_tables, plan, reference_data
from stronge1994.figures.rubber_sphere import curves as rubber
from stronge1994.figures.shared.curves import solving
from stronge1994.plan import config as configuration
from tests.reference_solutions import cross_tables, table_files

ROOT = Path(__file__).parents[2]
FOLDER = ROOT / "data/cross2014"
CONFIG = configuration.load(ROOT)


@pytest.fixture(scope="module")
def inventory():
    schema = reference_data.load_yaml(ROOT / "workflow/schemas/source.schema.yaml")
    return reference_data.load_all(ROOT / "data", schema)


@pytest.fixture(scope="module")
def solved(inventory):
    """Curves of the figure."""
    nodes = plan.nodes_of(CONFIG, inventory, "rubber_sphere")
    settings = plan.settings(CONFIG, inventory, "rubber_sphere") | solving.read_nodes(nodes)
    return rubber.curves(**settings | {"samples": 11, "tolerance": 1e-3})


def test_the_table_is_made_from_the_markers():
    table = cross_tables.tables()["impacts"]
    assert not table_files.differing(FOLDER / "impacts.csv", table, 1, 1.1e-4)


def test_the_markers_of_an_impact_agree_among_themselves():
    """e_t was read, and follows again from other ratios that were read, to two pixels each."""
    rows = csv_tables.read_rows(FOLDER / "impacts.csv")
    for impact, row in enumerate(rows, 1):
        found = cross_tables.quantities(impact)
        along, across = (np.cos(t := np.radians(found["angle"])), np.sin(t))
        after = found["velocity_ratio"] * along * (1 - found["spin_ratio"])
        before = float(row["tangential_before [1]"]) * across
        assert abs(-after / before - found["tangential_restitution"]) < 0.03, impact


def test_both_halves_of_the_measurement_weigh_as_the_source_says(solved, inventory):
    velocity, spin = (solved[half][rubber.E_T] for half in rubber.ALONE)
    e_t = [float(row[rubber.E_T]) for row in csv_tables.read_rows(FOLDER / "impacts.csv")]
    np.testing.assert_allclose(2 / 7 * velocity + 5 / 7 * spin, e_t, rtol=0, atol=0.03)
    ratio, near = (1 + spin) / (1 + velocity), solved[rubber.ALONE[0]][rubber.X] <= 2.5
    note = " ".join(inventory["cross2014"]["note"].split())
    said = f"{ratio.mean():.2f} of the first on average ({ratio.min():.2f} to {ratio.max():.2f})"
    assert f"{said}, and {ratio[near].mean():.2f} below incidence 2.5" in note
    ends = [f"{of(half[near]):.2f}" for half in (velocity, spin) for of in (np.min, np.max)]
    assert "would be {} to {} there, and from the spin alone {} to {}".format(*ends) in note


def test_the_caption_says_which_model_is_nearest(solved):
    """The paper's to what was measured; to the spin alone the viscous one is as near."""
    rms = {model: solved[f"{model}, rms"] for model in (*rubber.MODELS, rubber.ELASTIC)}
    for row in (0, 1):
        measured = {model: found[rubber.RMS[0]][row] for model, found in rms.items()}
        assert min(measured, key=measured.get) == "lumped.hysteretic"
    spin = {model: found[rubber.RMS[2]][1] for model, found in rms.items()}
    assert sorted(spin, key=spin.get)[:2] == ["continuum.viscous", "lumped.hysteretic"]
    assert (
        round(spin["continuum.viscous"], 2) == 0.15 and round(spin["lumped.hysteretic"], 2) == 0.16
    )


def test_what_is_stated_and_what_it_is_solved_with_have_one_angle(inventory):
    stated = inventory["cross2014"]["parameters"]
    for row in csv_tables.read_rows(FOLDER / "stated.csv"):
        angle = stated[f"angle_{rubber.STATED[row['ball']]}"]
        assert float(row["angle [deg]"]) == angle["value"]
        assert float(row["angle_uncertainty [deg]"]) == angle["uncertainty"]
