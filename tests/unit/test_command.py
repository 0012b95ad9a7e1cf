"""The command line: each option reaches its function, and columns say what they are.

What it refuses stands in tests/refusals/planarimpact/command.toml; `scene` in test_scene_files.py.
"""

import csv
import os
import shlex
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from planarimpact import continuum, export, lumped, models
from planarimpact.__main__ import main
from planarimpact.common import sliding

REBOUND = "incidence [mu v2(0)],velocity [mu v2(0)],peak_friction [mu F2max],"
REBOUND += "dissipation [mu^2 m2 v2(0)^2],regime,{}model,loss"
HISTORY = "time [t_c],normal [m2 Omega v2(0)],friction [mu m2 Omega v2(0)],velocity [mu v2(0)],"
HISTORY += "spring [mu v2(0)/Omega],model,loss"
CONTINUUM_HISTORY = "time [t_c],normal [F2max],friction [mu F2max],velocity [mu v2(0)],"
CONTINUUM_HISTORY += "contact_radius [a_max],stick_radius [a_max],model,loss"
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


@pytest.mark.parametrize(
    ("model", "header", "option"),
    [
        (lumped, HISTORY, {"samples": 9}),
        (continuum, CONTINUUM_HISTORY, {"tolerance": 0.05}),
    ],
)
def test_history_prints_what_the_model_says_with_units(model, header, option, capsys):
    name = model.__name__.split(".")[-1] + ".viscous"
    ((key, value),) = option.items()
    assert main(["history", "--incidence=1", f"--model={name}", *GIVEN, f"--{key}={value}"]) == 0
    exact = model.history(1.0, **GROUPS, **option, loss="viscous")
    columns = exact._asdict() | {"friction": exact.friction_force}
    assert_are(capsys.readouterr().out, header, columns, "viscous")


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


# Models, and their errors against the continuum.

RMS, LARGEST, SEEN = "rms [mu v2(0)]", "max [mu v2(0)]", "seen [1]"


def test_models_are_listed(capsys):
    assert main(["models"]) == 0
    assert [row["model"] for row in rows_of(capsys.readouterr().out)] == list(models.MODELS)


def test_models_are_measured_against_the_continuum(monkeypatch, capsys):
    """Of the loss that is asked for: here some models at three incidences."""
    names = "lumped", "lumped.viscous", "continuum.plastic"
    monkeypatch.setattr(models, "MODELS", {name: models.MODELS[name] for name in names})
    monkeypatch.setattr(sys.modules[main.__module__], "INCIDENCES", 3)
    groups = {"mass_ratio": 3.5, "stiffness_ratio": 1.21, "restitution": 0.8}
    given = [f"--{name.replace('_', '-')}={value:g}" for name, value in groups.items()]
    assert main(["models", *given, "--loss", "plastic"]) == 0
    said = capsys.readouterr()
    assert "for mass_ratio 3.5, stiffness_ratio 1.21, restitution 0.8" in said.err
    rows = [[float(row[c]) for c in (RMS, LARGEST, SEEN)] for row in rows_of(said.out)]
    numbers = dict(zip(names, rows, strict=True))
    assert np.isnan(numbers.pop("lumped")).all()  # elastic alone
    for rms, largest, seen in numbers.values():
        assert 0 < rms <= largest and 0 <= seen <= 1
    assert numbers["continuum.plastic"][1] <= 1e-4 and numbers["continuum.plastic"][2] == 0
    limit = sliding.limit_alike(*map(np.array, groups.values()))
    x = np.linspace(0.0, float(limit), 3)
    other = lumped.rebound(x, **groups, loss="viscous").velocity
    error = np.abs(other - continuum.rebound(x, **groups, loss="plastic", tolerance=1e-3).velocity)
    wanted = [np.sqrt(np.mean(error**2)), error.max()]
    assert numbers["lumped.viscous"][:2] == pytest.approx(wanted, rel=0.06)


def test_a_reader_that_has_had_enough_is_no_error():
    result = in_a_shell("history --incidence 1 --samples 20000", "| :")
    assert result.returncode == 0 and "Traceback" not in result.stderr


def in_a_shell(command, more, **environment):
    """What a command does in bash, with something behind it."""
    line = f"{shlex.quote(sys.executable)} -m planarimpact {command} {more}"
    bash = ["bash", "-o", "pipefail", "-c", line]
    return subprocess.run(bash, capture_output=True, text=True, env=os.environ | environment)


@pytest.mark.parametrize(
    "command", ["models", "rebound --incidence 1", "export {folder}/a.h --as c"]
)
def test_a_closed_standard_output_is_refused_in_one_line(command, tmp_path):
    result = in_a_shell(command.format(folder=tmp_path), ">&-")
    assert (result.returncode, result.stdout) == (2, "") and not list(tmp_path.iterdir())
    assert result.stderr == "planarimpact: standard output is closed\n"


@pytest.mark.parametrize("closed", ["2>&-", "<&-", "<&- 2>&-"])
def test_other_closed_streams_change_nothing(closed, table, capfd):
    """What is told on standard error does not get into a table, nor does a file take its place."""
    outs = [table.with_name(f"{name}.csv") for name in "ab"]
    result = in_a_shell(f"scene {table} {outs[0]}", closed)
    assert main(["scene", f"{table}", f"{outs[1]}"]) == 0 and result.returncode == 0
    assert result.stdout.replace("a.csv", "b.csv") == capfd.readouterr().out
    assert outs[0].read_text() == outs[1].read_text()


@pytest.mark.parametrize("more", [">{}/out 2>/dev/full", "2>&1 >{}/out | :"])
def test_that_nobody_reads_errors_changes_no_result(more, table, tmp_path):
    assert in_a_shell("rebound --incidence 1 --restitution 5", "2>/dev/full").returncode == 2
    result = in_a_shell(f"scene {table} {tmp_path}/out.csv", more.format(tmp_path))
    assert result.returncode == 0 and "3 impacts" in (tmp_path / "out").read_text()
    assert len((tmp_path / "out.csv").read_text().splitlines()) == 4


def test_a_terminal_of_ascii_shows_letters_as_codes(table):
    linked = table.with_name("Kügelchen.csv")
    result = in_a_shell(f"scene {table} {linked}", "", PYTHONIOENCODING="ascii")
    assert (result.returncode, "Traceback" in result.stderr) == (0, False) and linked.is_file()
    assert r"K\xfcgelchen.csv: 3 impacts" in result.stdout


@pytest.fixture
def table(tmp_path):
    """A table, with a column that is told on standard error."""
    text = (Path(__file__).parents[2] / "data/scenes/superball.csv").read_text()
    (tmp_path / "in.csv").write_text(text.replace("id,", "batch,", 1))
    return tmp_path / "in.csv"


@pytest.mark.parametrize("x", ["-1e-3", "-0.5e0", "-1E1", "-.5", "-2"])
@pytest.mark.parametrize(
    "option", ["rebound --incidence", "history --incidence", "rebound --friction 0.5 --angle"]
)
def test_a_negative_number_may_have_any_notation(option, x, capsys):
    assert main([*option.split(), x]) == 0
    apart = capsys.readouterr().out
    assert main(f"{option}={x}".split()) == 0
    assert apart == capsys.readouterr().out
