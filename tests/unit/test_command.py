"""The command line: each option reaches its function, and columns say what they are.

What it refuses stands in tests/refusals/planarimpact/command.toml; `scene` in test_scene_files.py.
"""

import csv
import shlex
import subprocess
import sys

import pytest

from planarimpact import export, models
from planarimpact.__main__ import main

REBOUND = "incidence [mu v2(0)],velocity [mu v2(0)],peak_friction [mu F2max],"
REBOUND += "dissipation [mu^2 m2 v2(0)^2],regime,{}model,loss"
# Options of the groups.
GROUPS = {"mass_ratio": 3.0, "stiffness_ratio": 1.1, "restitution": 0.9}
GIVEN = [f"--{name.replace('_', '-')}={value}" for name, value in GROUPS.items()]


def rows_of(text):
    return list(csv.DictReader(text.splitlines()))


def assert_are(text, header, expected, loss):
    """The columns, by name and unit, hold the fields of a result, or the values beside them."""
    rows = rows_of(text)
    assert text.splitlines()[0] == header and {row["loss"] for row in rows} == {loss}
    for name in header.split(",")[:-2]:
        kind, values = str if name == "regime" else float, expected[name.split(" [")[0]]
        assert [kind(row[name]) for row in rows] == list(values), name


@pytest.mark.parametrize(
    ("model", "settings", "more"),
    [("lumped.viscous", {}, ""), ("continuum.plastic", {"tolerance": 0.1}, "reversals [1],")],
)
def test_rebound_prints_what_the_model_says_with_units(model, settings, more, capsys):
    given = [*GIVEN, *(f"--set={name}={value}" for name, value in settings.items())]
    assert main(["rebound", "--incidence", "0.5", "-2", "8", "--model", model, *given]) == 0
    x = [0.5, -2.0, 8.0]
    exact = models.rebound(model, x, **GROUPS, **settings)._asdict() | {"incidence": x}
    exact["regime"] = ["STICK_SLIP", "SLIP_STICK_SLIP", "SLIP_THROUGHOUT"]
    assert_are(capsys.readouterr().out, REBOUND.format(more), exact, model.split(".")[1])


def test_rebound_says_beside_the_table_where_a_law_is_not_known_to_hold(capsys):
    given = "rebound --angle 30 --restitution 0.8 --model continuum.plastic --set tolerance=0.1"
    for friction, words in (("0.2", ""), ("0.3", "caution: friction is above")):
        assert main([*given.split(), "--friction", friction]) == 0
        said = capsys.readouterr().err
        assert said.startswith(words) and bool(said) == bool(words)
    given = "rebound --incidence 2 --restitution 0.9 --model lumped.hysteretic"
    assert main(given.split()) == 0
    assert "caution: restitution is below" in capsys.readouterr().err


def test_what_takes_the_energy_of_models_without_the_option(capsys):
    for model, e, loss in (
        ("rigid", "0.8", "any"),
        ("timestep.linear", "0.8", "hysteretic"),
        ("lumped.viscous", "1", "none"),
    ):
        assert main(["rebound", "--incidence", "2", "--model", model, "--restitution", e]) == 0
        (row,) = rows_of(capsys.readouterr().out)
        assert (row["model"], row["loss"]) == (model, loss)


def test_an_angle_and_what_a_model_does_not_know(capsys):
    command = ["rebound", "--angle", "45", "--friction", "0.5"]
    assert main([*command, "--model", "laws.smith"]) == 0
    (row,) = rows_of(capsys.readouterr().out)
    assert float(row["incidence [mu v2(0)]"]) == pytest.approx(2.0)
    assert (row["peak_friction [mu F2max]"], row["regime"]) == ("nan", "UNRESOLVED")


def test_export_writes_the_table_of_spheres(capsys, tmp_path):
    path, same = tmp_path / "ball.mjs", tmp_path / "same" / "ball.mjs"
    same.parent.mkdir()
    assert main(["export", str(path), "--as", "js", "--tolerance", "0.04"]) == 0
    assert capsys.readouterr().out == f"{path}: the table of spheres, within 0.04\n"
    export.write_spheres(same, "js", 0.04)
    assert path.read_text() == same.read_text()


def test_models_are_listed(capsys):
    assert main(["models"]) == 0
    assert [row["model"] for row in rows_of(capsys.readouterr().out)] == list(models.MODELS)


def test_a_reader_that_has_had_enough_is_no_error():
    incidences = "1 " * 5000
    line = f"{shlex.quote(sys.executable)} -m planarimpact rebound --incidence {incidences} | :"
    bash = ["bash", "-o", "pipefail", "-c", line]
    result = subprocess.run(bash, capture_output=True, text=True)
    assert result.returncode == 0 and "Traceback" not in result.stderr


@pytest.mark.parametrize("x", ["-1e-3", "-0.5e0", "-1E1", "-.5", "-2"])
@pytest.mark.parametrize("option", ["rebound --incidence", "rebound --friction 0.5 --angle"])
def test_a_negative_number_may_have_any_notation(option, x, capsys):
    assert main([*option.split(), x]) == 0
    apart = capsys.readouterr().out
    assert main(f"{option}={x}".split()) == 0
    assert apart == capsys.readouterr().out
