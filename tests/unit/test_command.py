"""The command line, in and out."""

import csv
import os
import re
import shlex
import subprocess
import sys

import pytest

import planarimpact
from planarimpact import InputError, continuum, export, lumped, models
from planarimpact.__main__ import main

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


def rows_of(text):
    return list(csv.DictReader(text.splitlines()))


def columns_of(text):
    header, *rows = csv.reader(text.splitlines())
    return dict(zip(header, zip(*rows, strict=True), strict=True))


def assert_are(columns, fields, result):
    """The columns, by name and unit, hold the fields of a result, or the values beside them."""
    assert set(columns) == {*fields, "model", "loss"}
    for name, field in fields.items():
        expected = getattr(result, field) if isinstance(field, str) else field
        kind = str if name in ("regime", "model", "loss") else float
        assert [kind(entry) for entry in columns[name]] == list(expected), name


@pytest.mark.parametrize(("model", "settings"), [("lumped", {}), ("continuum", {"tolerance": 0.1})])
def test_rebound_prints_what_the_model_says_with_units(model, settings, capsys):
    given = [f"--set={name}={value}" for name, value in settings.items()]
    assert main(["rebound", "--incidence", "0.5", "-2", "8", "--model", model, *given]) == 0
    fields = {n: f for n, f in REBOUND.items() if f != "reversals" or model == "continuum"}
    exact = models.rebound(model, [0.5, -2.0, 8.0], **settings)
    assert_are(columns_of(capsys.readouterr().out), fields, exact)


@pytest.mark.parametrize(
    ("fields", "option", "result"),
    [
        (HISTORY, "--samples=9", lambda: lumped.history(1.0, samples=9)),
        (CONTINUUM_HISTORY, "--tolerance=0.01", lambda: continuum.history(1.0, tolerance=0.01)),
    ],
)
def test_history_prints_what_the_model_says_with_units(fields, option, result, capsys):
    model = "continuum" if fields is CONTINUUM_HISTORY else "lumped"
    assert main(["history", "--incidence", "1", "--model", model, option]) == 0
    assert_are(columns_of(capsys.readouterr().out), fields, result())


NUMBERS = ["-0.5", "-.5", "-2", "-0.0", "0", ".0", "0e-999", "5e-324", "1E+3", "+1."]


def test_numbers_are_numbers_however_they_are_written(capsys):
    assert main(["rebound", "--model", "rigid", "--incidence", *NUMBERS, "--mass-ratio", "2"]) == 0
    found = columns_of(capsys.readouterr().out)["incidence [mu v2(0)]"]
    assert [float(x) for x in found] == [float(x) for x in NUMBERS]


NO_NUMBERS = ["1_000", "\uff11", "1_0e-4", "0x10", "inf", "nan", "1\n", "", "1,5", "e5"]


@pytest.mark.parametrize("text", NO_NUMBERS)
def test_what_is_no_decimal_number_is_not_read(text, capsys):
    with pytest.raises(SystemExit, match="2"):
        main(["rebound", "--incidence", text])
    assert f"argument --incidence: {text!r}: allowed are decimal numbers" in capsys.readouterr().err


FIT = ["fit", "--law", "yade", "--restitution", "0.8", "--poisson-ratio", "0.3"]
FIT += [word for n in ("young-modulus", "friction", "radius") for word in (f"--{n}", "0.1")]
FIT += ["--density", "1", "--speed", "0.001"]


@pytest.mark.parametrize(
    "command", [["rebound"], ["history"], ["models"], FIT, ["scene", "a", "b"], ["export", "a.h"]]
)
def test_every_number_is_read_so(command, capsys):
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


def test_a_number_out_of_range_is_told_before_advice_about_losses(capsys):
    for command in (["rebound", "--incidence", "2"], ["history", "--incidence", "2"], ["models"]):
        for value in ("1.8", "-0.5"):
            assert main([*command, "--restitution", value]) == 2
            said = capsys.readouterr().err
            assert said == f"planarimpact: restitution = {value}: allowed are numbers from 0 to 1\n"
    assert main([*FIT[:3], *FIT[5:], "--restitution", "1.8"]) == 2
    assert "restitution = 1.8: allowed are numbers from " in capsys.readouterr().err
    for model in ("lumped", "continuum"):
        with pytest.raises(InputError, match="mass_ratio = 0.5: allowed are"):
            models.rebound(model, 2.0, mass_ratio=0.5, restitution=0.8)


@pytest.mark.parametrize("command", ["rebound", "history"])
def test_below_1_the_name_of_the_model_says_the_loss(command, capsys):
    lossy = [command, "--incidence", "2", "--restitution", "0.8"]
    for model, allowed in (
        ("lumped", ["hysteretic (the paper's)", "unloading-stiffness", "viscous"]),
        ("continuum", ["viscous", "plastic"]),
    ):
        assert main([*lossy, "--model", model]) == 2
        (error,) = capsys.readouterr().err.splitlines()
        assert "restitution = 0.8: " in error
        said = error.split("says what takes the energy: ")[1].split(", ")
        assert said == [f"{model}.{loss}" for loss in allowed]
    assert main([*lossy, "--model", "lumped.viscous"]) == 0
    assert "lumped.viscous,viscous" in capsys.readouterr().out


def test_what_takes_the_energy_of_models_without_the_option(capsys):
    for model, e, loss in (
        ("rigid", "0.8", "any"),
        ("timestep.linear", "0.8", "hysteretic"),
        ("lumped.viscous", "1", "none"),
    ):
        assert main(["rebound", "--incidence", "2", "--model", model, "--restitution", e]) == 0
        (row,) = rows_of(capsys.readouterr().out)
        assert (row["model"], row["loss"]) == (model, loss)


def test_angles_and_settings(capsys):
    command = ["rebound", "--angle", "45", "--friction", "0.5"]
    assert main([*command, "--model", "timestep.linear", "--set", "steps=256"]) == 0
    (row,) = rows_of(capsys.readouterr().out)
    incidence = float(row["incidence [mu v2(0)]"])
    assert incidence == pytest.approx(2.0)
    assert float(row[VELOCITY]) == models.rebound("timestep.linear", incidence, steps=256)[0]
    for text in ("steps", "steps=1_0"):
        with pytest.raises(SystemExit, match="2"):
            main([*command, "--set", text])
        assert "argument --set: " in capsys.readouterr().err
    assert main([*command, "--model", "laws.smith"]) == 0
    assert rows_of(capsys.readouterr().out)[0]["peak_friction [mu F2max]"] == "nan"


def test_export_writes_the_table_of_spheres(capsys, tmp_path):
    for name, language in (("ball.h", "c"), ("ball.mjs", "js")):
        path, same = tmp_path / name, tmp_path / "same" / name
        same.parent.mkdir(exist_ok=True)
        assert main(["export", str(path), "--as", language, "--tolerance", "0.04"]) == 0
        assert capsys.readouterr().out == f"{path}: the table of spheres, within 0.04\n"
        export.write_spheres(same, language, 0.04)
        assert path.read_text() == same.read_text()
    with pytest.raises(SystemExit, match="2"):
        main(["export", "ball.rs", "--as", "rust"])
    assert "argument --as: invalid choice: 'rust'" in capsys.readouterr().err


ONCE = [
    ["rebound", "--incidence", "1", "--inc", "2"],
    ["rebound", "--incidence", "1", "--model", "rigid", "--model=rigid"],
    ["rebound", "--incidence", "1", "--restitution", "0.5", "--restitution", "1"],
    ["export", "a.h", "--as", "c", "--as", "js"],
    ["scene", "in.csv", "out.csv", "--tolerance", "1", "--tolerance", "1e-3"],
]


@pytest.mark.parametrize("command", ONCE, ids=lambda command: command[-1])
def test_an_option_is_given_once(command, capsys):
    with pytest.raises(SystemExit, match="2"):
        main(command)
    assert "is a second value, allowed is one" in capsys.readouterr().err


def test_models_are_listed(capsys):
    assert main(["models"]) == 0
    assert [row["model"] for row in rows_of(capsys.readouterr().out)] == list(models.MODELS)


REFUSED = [
    (["rebound", "--incidence", "1", "--set", "steps=4"], "lumped has no settings"),
    (["rebound", "--incidence", "1", "--model", "annuli", "--restitution", "0.5"], "is elastic"),
    (["rebound", "--incidence", "1", "--set", "model=3"], "model = 3: lumped has no settings"),
    (["history", "--incidence", "1", "--samples", "1"], "samples = 1"),
    (["history", "--incidence", "1", "--tolerance", "1"], "--tolerance: it does not apply"),
    (["history", "--incidence", "1", "--model", "continuum", "--samples", "9"], "--samples: it"),
    (
        ["history", "--incidence", "1", "--model", "continuum", "--restitution", "0.5"],
        "says what takes the energy: continuum.viscous, continuum.plastic",
    ),
    (["scene", "none.csv", "out.csv"], "none.csv: No such file"),
    (["scene", "none.csv", "."], ".: allowed are names that end in .csv, .csv.gz, .parquet, and -"),
    (["scene", "none.json", "out.csv"], "none.json: allowed are names that end in .csv, .csv.gz"),
    (["scene", "none.parquet", "out.csv"], "none.parquet: No such file"),
    (["rebound", "--incidence", "1", "--friction", "0.3"], "--angle, --friction: allowed are"),
    (["rebound", "--angle", "90", "--friction", "1"], "theta_deg[0] = 90.0: allowed are"),
    (["rebound", "--angle", "30"], "--angle, --friction: allowed are both"),
    (["rebound", "--angle", "30", "--friction", "0"], "friction = 0.0: allowed are"),
    (["rebound", "--incidence", "1", "--set", "steps=-5"], "steps = -5"),
    (["export", "no/balls.h", "--as", "c"], "no/balls.h: there is no folder"),
    (["export", "ball.h", "--as", "js"], "ball.h: allowed are names that end in .mjs or .js"),
    (["export", "a.h", "--as", "c", "--tolerance", "1e-9"], "tolerance = 1e-09: allowed is 0.004"),
    (["models", "--loss", "viscous"], "--loss: it does not apply, without --restitution"),
    (["rebound", "--incidence", "1", "--set", "n=1", "--set", "n=2"], "--set: a setting is given"),
    (["history", "--incidence", "1", "--samples", f"{10**15}"], f"samples = {10**15}: allowed are"),
]


def test_the_version_is_that_of_the_package(capsys):
    with pytest.raises(SystemExit):
        main(["--version"])
    assert capsys.readouterr().out == f"planarimpact {planarimpact.__version__}\n"


@pytest.mark.parametrize(("command", "words"), REFUSED, ids=[" ".join(c) for c, _ in REFUSED])
def test_refusals_are_one_line(command, words, capsys, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert main(command) == 2
    found = capsys.readouterr()
    assert words in found.err and found.err.count("\n") == 1 and not found.out
    assert not list(tmp_path.iterdir())


def test_a_reader_that_has_had_enough_is_no_error():
    python = shlex.quote(sys.executable)
    command = f"{python} -m planarimpact history --incidence 1 --samples 20000 | head -1"
    result = subprocess.run(
        ["bash", "-o", "pipefail", "-c", command], capture_output=True, text=True
    )
    assert result.returncode == 0 and not result.stderr and result.stdout.startswith("time [t_c],")


def test_help_speaks_of_every_command():
    command = [sys.executable, "-m", "planarimpact", "--help"]
    text = subprocess.run(
        command, capture_output=True, text=True, check=True, env=os.environ
    ).stdout
    assert all(word in text for word in ("rebound", "history", "scene", "fit", "export", "models"))
