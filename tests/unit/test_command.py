"""The command line: each option reaches its function, and columns say what they are.

What it refuses stands in tests/refusals/planarimpact/command.toml; `scene` in test_scene_files.py.
"""

import csv
import re
import shlex
import subprocess
import sys

import numpy as np
import pytest

import planarimpact
from planarimpact import continuum, export, lumped, models
from planarimpact.__main__ import main
from planarimpact.ground import sliding
from planarimpact.scene import columns as scene_columns

VELOCITY = "velocity [mu v2(0)]"
REBOUND = {
    "incidence [mu v2(0)]": [0.5, -2.0, 8.0],
    VELOCITY: "velocity",
    "peak_friction [mu F2max]": "peak_friction",
    "dissipation [mu^2 m2 v2(0)^2]": "dissipation",
    "regime": ["STICK_SLIP", "SLIP_STICK_SLIP", "SLIP_THROUGHOUT"],
    "reversals [1]": "reversals",
}
COMMON = {"time [t_c]": "time", VELOCITY: "velocity"}
HISTORY = COMMON | {
    "normal [m2 Omega v2(0)]": "normal",
    "friction [mu m2 Omega v2(0)]": "friction",
    "spring [mu v2(0)/Omega]": "spring",
}
CONTINUUM_HISTORY = COMMON | {
    "normal [F2max]": "normal",
    "friction [mu F2max]": "friction",
    "contact_radius [a_max]": "contact_radius",
    "stick_radius [a_max]": "stick_radius",
}
# Options of the groups.
GROUPS = {"mass_ratio": 3.0, "stiffness_ratio": 1.1, "restitution": 0.9}
GIVEN = [f"--{name.replace('_', '-')}={value}" for name, value in GROUPS.items()]


def rows_of(text):
    return list(csv.DictReader(text.splitlines()))


def columns_of(text):
    header, *rows = csv.reader(text.splitlines())
    return dict(zip(header, zip(*rows, strict=True), strict=True))


def assert_are(columns, fields, result, loss):
    """The columns, by name and unit, hold the fields of a result, or the values beside them."""
    assert set(columns) == {*fields, "model", "loss"}
    assert set(columns["loss"]) == {loss}
    for name, field in fields.items():
        expected = getattr(result, field) if isinstance(field, str) else field
        kind = str if name == "regime" else float
        assert [kind(entry) for entry in columns[name]] == list(expected), name


@pytest.mark.parametrize(
    ("model", "settings", "loss"),
    [("lumped.viscous", {}, "viscous"), ("continuum.plastic", {"tolerance": 0.1}, "plastic")],
)
def test_rebound_prints_what_the_model_says_with_units(model, settings, loss, capsys):
    given = [*GIVEN, *(f"--set={name}={value}" for name, value in settings.items())]
    assert main(["rebound", "--incidence", "0.5", "-2", "8", "--model", model, *given]) == 0
    fields = {n: f for n, f in REBOUND.items() if f != "reversals" or "continuum" in model}
    exact = models.rebound(model, [0.5, -2.0, 8.0], **GROUPS, **settings)
    assert_are(columns_of(capsys.readouterr().out), fields, exact, loss)


@pytest.mark.parametrize(
    ("model", "fields", "option", "result"),
    [
        (
            "lumped.viscous",
            HISTORY,
            "--samples=9",
            lambda: lumped.history(1.0, **GROUPS, samples=9, loss="viscous"),
        ),
        (
            "continuum.viscous",
            CONTINUUM_HISTORY,
            "--tolerance=0.05",
            lambda: continuum.history(1.0, **GROUPS, tolerance=0.05, loss="viscous"),
        ),
    ],
)
def test_history_prints_what_the_model_says_with_units(model, fields, option, result, capsys):
    assert main(["history", "--incidence", "1", "--model", model, *GIVEN, option]) == 0
    assert_are(columns_of(capsys.readouterr().out), fields, result(), "viscous")


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
    assert row["peak_friction [mu F2max]"] == "nan"


NUMBERS = ["-0.5", "-.5", "-2", "-0.0", "0", ".0", "0e-999", "5e-324", "1E+3", "+1."]


def test_numbers_are_numbers_however_they_are_written(capsys):
    assert main(["rebound", "--model", "rigid", "--incidence", *NUMBERS]) == 0
    found = columns_of(capsys.readouterr().out)["incidence [mu v2(0)]"]
    assert [float(x) for x in found] == [float(x) for x in NUMBERS]


FIT = ["fit", "--law", "yade", "--restitution", "0.8", "--poisson-ratio", "0.3"]
FIT += [word for n in ("young-modulus", "friction", "radius") for word in (f"--{n}", "0.1")]
FIT += ["--density", "1", "--speed", "0.001"]


@pytest.mark.parametrize(
    "command", [["rebound"], ["history"], ["models"], FIT, ["scene", "a", "b"], ["export", "a.h"]]
)
def test_every_number_is_read_so(command, capsys):
    """Each option that is listed with a value refuses what Python alone takes for a number."""
    with pytest.raises(SystemExit, match="0"):
        main([command[0], "--help"])
    words = capsys.readouterr().out
    metavars = re.findall(r"^  (--[a-z-]+) (?:[A-Z_]+)(?: \[.*)?(?:$|  )", words, flags=re.M)
    options = [option for option in metavars if option != "--set"]
    assert options
    for option in options:
        with pytest.raises(SystemExit, match="2"):
            main([*command, option, "1_0"])
        assert f"argument {option}: '1_0': allowed are" in capsys.readouterr().err


@pytest.mark.parametrize(("name", "language"), [("ball.h", "c"), ("ball.mjs", "js")])
def test_export_writes_the_table_of_spheres(name, language, capsys, tmp_path):
    path, same = tmp_path / name, tmp_path / "same" / name
    same.parent.mkdir()
    assert main(["export", str(path), "--as", language, "--tolerance", "0.04"]) == 0
    assert capsys.readouterr().out == f"{path}: the table of spheres, within 0.04\n"
    export.write_spheres(same, language, 0.04)
    assert path.read_text() == same.read_text()


# Models, and their errors against the continuum.

RMS, LARGEST, SEEN = "rms [mu v2(0)]", "max [mu v2(0)]", "seen [1]"


def test_models_are_listed(capsys):
    assert main(["models"]) == 0
    assert [row["model"] for row in rows_of(capsys.readouterr().out)] == list(models.MODELS)


@pytest.mark.parametrize(("loss", "e", "mass_ratio"), [("plastic", 0.8, 3.5), (None, 1.0, 1.2)])
def test_models_are_measured_against_the_continuum(loss, e, mass_ratio, monkeypatch, capsys):
    """Of the loss that is asked for, or of none at e = 1: here some models at three incidences."""
    names = "lumped", "lumped.viscous", "continuum", *models.losses("continuum").values()
    monkeypatch.setattr(models, "MODELS", {name: models.MODELS[name] for name in names})
    monkeypatch.setattr(sys.modules[main.__module__], "INCIDENCES", 3)
    groups = {"mass_ratio": mass_ratio, "stiffness_ratio": 1.21, "restitution": e}
    given = [f"--{name.replace('_', '-')}={value:g}" for name, value in groups.items()]
    given += ["--loss", loss] if loss else []
    assert main(["models", *given]) == 0
    said = capsys.readouterr()
    assert f"for mass_ratio {mass_ratio}, stiffness_ratio 1.21, restitution {e:g}" in said.err
    rows = {row["model"]: row for row in rows_of(said.out)}
    assert list(rows) == list(names)
    numbers = {name: [float(row[c]) for c in (RMS, LARGEST, SEEN)] for name, row in rows.items()}
    for name in ("lumped", "continuum") if loss else ():  # elastic alone
        assert np.isnan(numbers.pop(name)).all()
    for rms, largest, seen in numbers.values():
        assert 0 < rms <= largest and 0 <= seen <= 1
    bounds = {"continuum.viscous": 1e-4, "continuum": 1e-6}
    for name, bound in ({"continuum.plastic": 1e-4} if loss else bounds).items():
        assert numbers[name][1] <= bound and numbers[name][2] == 0
    limit = sliding.limit_alike(*map(np.array, groups.values()))
    x = np.linspace(0.0, float(limit), 3)
    other = lumped.rebound(x, **groups, loss="viscous").velocity
    exact = continuum.rebound(x, **groups, loss=loss, tolerance=1e-3).velocity
    error = np.abs(other - exact)
    wanted = [np.sqrt(np.mean(error**2)), error.max()]
    assert numbers["lumped.viscous"][:2] == pytest.approx(wanted, rel=0.06)


# Help, and the end of a pipe.


def test_the_version_is_that_of_the_package(capsys):
    with pytest.raises(SystemExit, match="0"):
        main(["--version"])
    assert capsys.readouterr().out == f"planarimpact {planarimpact.__version__}\n"


def test_help_speaks_of_every_command_and_every_column(capsys):
    for command in ([], ["scene"]):
        with pytest.raises(SystemExit, match="0"):
            main([*command, "--help"])
    said = capsys.readouterr().out
    commands = ("rebound", "history", "scene", "fit", "export", "models")
    assert all(f"    {name} " in said for name in commands)
    own = [name for name in scene_columns.KNOWN if not name.startswith("other_")]
    for text in map(scene_columns.header, [*own, *scene_columns.RESULT]):
        assert f"  {text} " in said or f"  {text}\n" in said


@pytest.mark.parametrize("command", ["history --incidence 1 --samples 20000", "scene - -"])
def test_a_reader_that_has_had_enough_is_no_error(command):
    """Of lines, and of a table, which the system writes."""
    table = scene_columns.HELP.split("Example:\n")[1].replace("  ", "")
    pipe = f"{shlex.quote(sys.executable)} -m planarimpact {command} | :"
    result = subprocess.run(
        ["bash", "-o", "pipefail", "-c", pipe], input=table, capture_output=True, text=True
    )
    assert result.returncode == 0 and "Traceback" not in result.stderr
