"""Presets: their numbers are those of their sources, in C too."""

import csv
import re
from pathlib import Path

import numpy as np
import pytest
import yaml

from planarimpact import collision, export

DATA = Path(__file__).parents[2] / "data"
PRESETS = collision.presets()
FIELDS = "friction stiffness_ratio restitution relaxation_time yield_pressure effective_modulus"


def test_beads_are_those_of_the_chart():
    with open(DATA / "cornell1999/pairs.csv", newline="") as file:
        chart = {row["pair"]: row for row in csv.DictReader(file)}
    glass, steel = PRESETS["glass_beads"].pair, PRESETS["steel_beads"].pair
    for given, name in ((glass, "soda-lime glass"), (steel, "chrome steel")):
        assert given.friction == float(chart[name]["friction [1]"])
    assert glass.restitution == float(chart["soda-lime glass"]["restitution [1]"])
    assert float(chart["chrome steel"]["restitution [1]"]) == 1.0


def test_balls_are_those_of_their_sources():
    cross = yaml.safe_load((DATA / "cross2014/source.yaml").read_text(encoding="utf-8"))
    superball, tennis = PRESETS["superball"], PRESETS["tennis_ball"]
    assert superball.pair.friction == cross["parameters"]["friction"]["value"]
    assert superball.pair.stiffness_ratio == cross["parameters"]["stiffness_ratio"]["value"]
    assert superball.body.mass == pytest.approx(0.0462, rel=1e-3)
    assert (135 / 254) ** 0.5 < tennis.pair.restitution < (147 / 254) ** 0.5
    for name in ("billiard_balls", "billiard_ball_on_cushion"):
        body = PRESETS[name].body
        assert body.radius == 2.25 * 0.0254 / 2
        assert body.mass == pytest.approx(6 * 0.028349523125, rel=1e-3)


def test_a_header_has_the_same_numbers(tmp_path):
    export.write_spheres(tmp_path / "balls.h", "c", tolerance=max(export.TABLES))
    code = (tmp_path / "balls.h").read_text()
    losses = {"BALLS_VISCOUS": False, "BALLS_PLASTIC": True}
    found = re.findall(r"_preset balls_(\w+) = {\s*{(.*)},\s*{([^{}]*), (\w+)}};\n", code)
    assert [name for name, *_ in found] == list(PRESETS)
    for name, body, pair, loss in found:
        preset = PRESETS[name]
        assert [float(number) for number in body.split(",")] == list(preset.body)
        wanted = np.nan_to_num([getattr(preset.pair, field) for field in FIELDS.split()])
        assert [float(number) for number in pair.split(",")] == wanted.tolist()
        by_law = np.isnan(preset.pair.restitution)
        assert by_law if loss == "0" else losses[loss] == preset.pair.plastic
