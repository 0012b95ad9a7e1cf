"""Presets and materials: their numbers are those of their sources, in C and JavaScript too."""

import re

import numpy as np
import pytest
import yaml

from planarimpact import collision, export, models
from planarimpact.spheres.table import shipped
from tests.reference_solutions import table_files

PRESETS = collision.presets()
FIELDS = ["friction", "stiffness_ratio", "restitution", "relaxation_time", "yield_pressure"]
FIELDS += ["effective_modulus"]


def test_beads_are_those_of_the_chart():
    chart = {row["pair"]: row for row in table_files.read("cornell1999/pairs")}
    glass, steel = PRESETS["glass_beads"].pair, PRESETS["steel_beads"].pair
    for given, name in ((glass, "soda-lime glass"), (steel, "chrome steel")):
        assert given.friction == float(chart[name]["friction [1]"])
    assert glass.restitution == float(chart["soda-lime glass"]["restitution [1]"])
    assert float(chart["chrome steel"]["restitution [1]"]) == 1.0


def test_a_caller_cannot_change_what_others_get():
    assert collision.presets().pop("superball") and list(collision.presets()) == list(PRESETS)
    parts = [part for panel in shipped().panels.values() for part in panel[1:]]
    assert not any(values.flags.writeable for values in (shipped().limits, *parts))


def test_balls_are_those_of_their_sources():
    cross = yaml.safe_load((table_files.DATA / "cross2014/source.yaml").read_text(encoding="utf-8"))
    superball, tennis = PRESETS["superball"], PRESETS["tennis_ball"]
    assert superball.pair.friction == cross["parameters"]["friction"]["value"]
    assert superball.pair.stiffness_ratio == cross["parameters"]["stiffness_ratio"]["value"]
    assert superball.body.mass == pytest.approx(0.0462, rel=1e-3)
    assert (tennis.body.mass, 2 * tennis.body.radius) == pytest.approx((0.0577, 0.067))
    assert (135 / 254) ** 0.5 < tennis.pair.restitution < (147 / 254) ** 0.5
    balls, n = PRESETS["billiard_balls"], r"([\d.]+)"
    for field, *ends in re.findall(rf"(\w+) {n} to {n}", balls.source):
        assert getattr(balls.pair, field) == np.mean([*map(float, ends)])
    for name in ("billiard_balls", "billiard_ball_on_cushion"):
        body = PRESETS[name].body
        assert body.radius == 2.25 * 0.0254 / 2
        assert body.mass == pytest.approx(6 * 0.028349523125, rel=1e-3)


WRITTEN = {
    "h": r"_preset balls_(\w+) = {\s*{(.*)},\s*{([^{}]*), (\w+)}};\n",
    "mjs": r"\b(\w+): {\s*body: {(.*)},\s*pair: {([^{}]*), loss: (\w+),\s*}",
}


@pytest.mark.parametrize("ending", WRITTEN)
def test_c_and_javascript_have_the_same_numbers(ending, tmp_path):
    path = tmp_path / f"balls.{ending}"
    export.write_spheres(path, {"h": "c", "mjs": "js"}[ending], tolerance=max(export.TABLES))
    code = path.read_text()
    found = re.findall(WRITTEN[ending], code)
    assert [name for name, *_ in found] == list(PRESETS)
    for name, *texts, loss in found:
        body, pair = PRESETS[name].body, PRESETS[name].pair
        numbers = np.nan_to_num([getattr(pair, field) for field in FIELDS])
        parts = (body, body._fields), (numbers, FIELDS)
        for text, (wanted, fields) in zip(texts, parts, strict=True):
            assert [float(one) for one in re.findall(r"(?<!\w)\d[\d.e+-]*", text)] == list(wanted)
            assert re.findall(r"(\w+):", text) in ([], list(fields))
        law = "0" if np.isnan(pair.restitution) else str(pair.loss).upper()
        assert loss.removeprefix("BALLS_") == law
    # Squares of the radius of gyration over the radius: of a solid sphere, and of a thin shell.
    assert [eval(root) for root in re.findall(r"radius \* .*?sqrt\((.*?)\)", code)] == [
        2 / 5,
        2 / 3,
    ]


def test_materials_are_those_of_their_sources():
    materials = models.materials()
    assert len(materials) == 10
    pairs = {row["pair"]: row for row in table_files.read("cornell1999/pairs")}
    charts = {
        "steel": ("chrome_steel", "chrome steel"),
        "glass": ("soda_lime_glass", "soda-lime glass"),
        "polyurethane": ("polyurethane", "polyurethane"),
        "acetal": ("delrin", "Delrin"),
        "aluminium": ("", "glass on aluminium"),
    }
    for name, (prefix, pair) in charts.items():
        known = materials[name]
        assert known["restitution"]["value"] == float(pairs[pair]["restitution [1]"])
        for field in ("young_modulus", "poisson_ratio") if prefix else ():
            assert known[field]["value"] == parameter("cornell1999", f"{prefix}_{field}")
    for field in ("young_modulus", "poisson_ratio"):
        found = materials["alumina"][field]["value"]
        assert found == parameter("kharaz2001", f"sphere_{field}")
    assert materials["alumina"]["restitution"]["value"] == parameter("kharaz2001", "restitution")
    for name, known in materials.items():
        assert {"young_modulus", "poisson_ratio", "loss"} <= known.keys(), name
        assert all(value.keys() == {"value", "source"} for value in known.values())


def parameter(source, name):
    path = table_files.DATA / source / "source.yaml"
    return yaml.safe_load(path.read_text(encoding="utf-8"))["parameters"][name]["value"]
