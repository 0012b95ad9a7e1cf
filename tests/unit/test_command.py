"""The command line, in and out."""

import csv
import json
import os
import shlex
import subprocess
import sys
from itertools import product

import pytest

import planarimpact
from planarimpact import InputError, continuum, export, lumped, models, response
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
def test_history_prints_what_the_model_says_with_units(fields, option, result, capsys, tmp_path):
    model = "continuum" if fields is CONTINUUM_HISTORY else "lumped"
    command = ["history", "--incidence", "1", "--model", model, option]
    assert main(command) == main([*command, "--output", str(tmp_path / "a.JSON")]) == 0
    assert_are(columns_of(capsys.readouterr().out), fields, result())
    assert_are(json.loads((tmp_path / "a.JSON").read_text()), fields, result())


NUMBERS = ["-1e-3", "-1E-300", "-.5e1", "-2", "-1e+1", "-0.0"]


def test_negative_numbers_are_numbers_however_they_are_written(capsys):
    assert main(["rebound", "--model", "rigid", "--incidence", *NUMBERS, "--mass-ratio", "2"]) == 0
    found = columns_of(capsys.readouterr().out)["incidence [mu v2(0)]"]
    assert [float(x) for x in found] == [float(x) for x in NUMBERS]


FIT = ["fit", "--law", "yade", "--restitution", "0.8", "--poisson-ratio", "0.3"]
FIT += [word for n in ("young-modulus", "friction", "radius") for word in (f"--{n}", "0.1")]
FIT += ["--density", "1", "--speed", "0.001"]
REFUSED_NUMBERS = [
    (["rebound", "--incidence", "1"], ["--mass-ratio", "--stiffness-ratio", "--restitution"]),
    (["rebound", "--friction", "0.3"], ["--angle"]),
    (["rebound", "--angle", "30"], ["--friction"]),
    (["rebound"], ["--incidence"]),
    (["history"], ["--incidence"]),
    (["history", "--incidence", "1"], ["--mass-ratio", "--samples"]),
    (["history", "--incidence", "1", "--model", "continuum"], ["--tolerance"]),
    (["models"], ["--restitution"]),
    (["models", "--restitution", "0.8"], ["--mass-ratio", "--stiffness-ratio"]),
    (FIT, ["--radius", "--density", "--friction", "--speed"]),
    (["compile", "x.json"], ["--tolerance", "--incidence-max", "--stiffness-ratio"]),
    (["scene", "in.csv", "out.csv"], ["--tolerance"]),
]


@pytest.mark.parametrize(
    ("command", "option"), [(c, option) for c, options in REFUSED_NUMBERS for option in options]
)
def test_numbers_that_are_none_reach_our_own_words(command, option, capsys, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    at = command.index(option) if option in command else len(command)
    kept = command[:at] + command[at + 2 :]
    lossy = "--restitution" not in (option, *kept) and kept[0] != "scene"
    # The number is told although nobody says what takes the energy.
    for more in ([], ["--restitution", "0.8"]) if lossy else ([],):
        for text in ("-inf", "-nan"):
            assert main([*kept, *more, option, text]) == 2
            error = capsys.readouterr().err
            name = option if option == "--angle" else option[2:].replace("-", "_")
            assert name in error and f"{float(text)}: allowed are" in error
            assert error.count("\n") == 1 and "energy" not in error


def test_a_number_out_of_range_is_told_before_advice_about_losses(capsys, tmp_path):
    for command in (
        ["rebound", "--incidence", "2"],
        ["history", "--incidence", "2"],
        ["compile", str(tmp_path / "a.json")],
        ["models"],
    ):
        for value, more in product(("1.8", "-0.5"), ([], ["--loss", "plastic"])):
            assert main([*command, "--restitution", value, *more]) == 2
            said = capsys.readouterr().err
            assert said == f"planarimpact: restitution = {value}: allowed are numbers from 0 to 1\n"
    assert main([*FIT[:3], *FIT[5:], "--restitution", "1.8"]) == 2
    assert "restitution = 1.8: allowed are numbers from " in capsys.readouterr().err
    for model in ("lumped", "continuum"):
        with pytest.raises(InputError, match="mass_ratio = 0.5: allowed are"):
            models.rebound(model, 2.0, mass_ratio=0.5, restitution=0.8)


@pytest.mark.parametrize("command", ["rebound", "history", "compile"])
def test_below_1_a_loss_is_said_or_refused(command, capsys, tmp_path):
    place = [str(tmp_path / "a.json")] if command == "compile" else ["--incidence", "2"]
    lossy = [command, *place, "--restitution", "0.8"]
    for more, allowed in (
        ([], ["hysteretic (the paper's)", "unloading-stiffness", "viscous"]),
        (["--model", "lumped"], ["hysteretic (the paper's)", "unloading-stiffness", "viscous"]),
        (["--model", "continuum"], ["viscous", "plastic"]),
    ):
        assert main([*lossy, *more]) == 2
        (error,) = capsys.readouterr().err.splitlines()
        assert "restitution = 0.8: " in error
        said = error.split("says what takes the energy: ")[1].split(", ")
        assert [loss.split(".")[-1] for loss in said] == allowed
    assert not list(tmp_path.iterdir())
    said = []
    for more in (["--loss", "viscous"], ["--model", "lumped.viscous"]):
        assert main([*lossy, *more]) == 0
        said.append(capsys.readouterr().out)
    assert said[0] == said[1] and "lumped.viscous" in said[0]


def test_what_takes_the_energy_of_models_without_the_option(capsys):
    for model, e, loss in (
        ("rigid", "0.8", "any"),
        ("timestep.linear", "0.8", "hysteretic"),
        ("lumped.viscous", "1", "none"),
    ):
        assert main(["rebound", "--incidence", "2", "--model", model, "--restitution", e]) == 0
        (row,) = rows_of(capsys.readouterr().out)
        assert (row["model"], row["loss"]) == (model, loss)


def test_compile_shows_its_progress_on_a_terminal(capsys, tmp_path, monkeypatch):
    monkeypatch.setattr(sys.stderr, "isatty", lambda: True)
    assert main(["compile", str(tmp_path / "a.json"), "--model", "lumped"]) == 0
    shown = capsys.readouterr().err.split("\r")
    assert len(shown) > 2 and "impacts solved, " in shown[1] and "100 % of the" in shown[-2]


def test_angles_settings_and_json(capsys):
    command = ["rebound", "--angle", "45", "--friction", "0.5", "--format", "json"]
    assert main([*command, "--model", "timestep.linear", "--set", "steps=256"]) == 0
    found = json.loads(capsys.readouterr().out)
    incidence = found["incidence [mu v2(0)]"]
    assert incidence == pytest.approx([2.0])
    assert found[VELOCITY] == [models.rebound("timestep.linear", incidence[0], steps=256)[0]]
    assert main([*command, "--model", "laws.smith"]) == 0
    assert json.loads(capsys.readouterr().out)["peak_friction [mu F2max]"] == [None]


def test_compile_and_use(capsys, tmp_path):
    path = str(tmp_path / "ball.json")
    lossy = ["--restitution", "0.7", "--loss", "hysteretic"]
    assert main(["compile", path, "--tolerance", "1e-9", *lossy]) == 0
    assert main(["rebound", "--incidence", "2", "--response", path]) == 0
    first, table = capsys.readouterr().out.split("\n", 1)
    assert "lumped.hysteretic" in first and first.endswith("; loss hysteretic")
    row = rows_of(table)[0]
    assert (row["model"], row["loss"]) == ("lumped.hysteretic", "hysteretic")
    assert float(row[VELOCITY]) == pytest.approx(lumped.rebound(2.0, restitution=0.7)[0], abs=1e-9)


def test_compile_for_other_languages(capsys, tmp_path):
    ball = response.compile("rigid", incidence_max=20, tolerance=1e-6, restitution=0.7)
    for name, language in (("ball.h", "c"), ("ball.mjs", "js")):
        path = tmp_path / name
        command = ["compile", str(path), "--as", language, "--model", "rigid"]
        assert main([*command, "--restitution", "0.7"]) == 0
        assert path.read_text() == export.text(ball, path, language)
        tolerance = max(export.TABLES)
        command = ["compile", str(path), "--as", language, "--model", "spheres"]
        assert main([*command, "--tolerance", str(tolerance)]) == 0
        assert path.read_text() == export.spheres_text(path, language, tolerance)
    with pytest.raises(SystemExit, match="2"):
        main(["compile", "ball.rs", "--as", "rust"])
    assert "argument --as: invalid choice: 'rust'" in capsys.readouterr().err


def test_a_response_is_not_replaced_by_what_it_answers(capsys, tmp_path):
    path, linked, hard = (tmp_path / name for name in ("ball.json", "linked.json", "hard.json"))
    assert main(["compile", str(path), "--model", "rigid"]) == 0
    before = path.read_bytes()
    linked.symlink_to(path)
    hard.hardlink_to(path)
    for output in (path, linked, hard):
        command = ["rebound", "--incidence", "2", "--response", str(path), "--output", str(output)]
        assert main(command) == 2
        assert "this is the file of --response" in capsys.readouterr().err
        assert output.read_bytes() == before


ONCE = [
    ["rebound", "--incidence", "1", "--inc", "2"],
    ["rebound", "--incidence", "1", "--model", "rigid", "--model=rigid"],
    ["rebound", "--incidence", "1", "--restitution", "0.5", "--restitution", "1"],
    ["models", "--format", "csv", "--format", "json"],
    ["scene", "in.csv", "out.csv", "--tolerance", "1", "--tolerance", "1e-3"],
]


@pytest.mark.parametrize("command", ONCE, ids=lambda command: command[-1])
def test_an_option_is_given_once(command, capsys):
    with pytest.raises(SystemExit, match="2"):
        main(command)
    assert "is a second value, allowed is one" in capsys.readouterr().err


NO_NUMBERS = ["1_000", "\uff11", "1_0e-4", "0x10", "1e-400", "-0.001e-330", "1\n", "", "1,5", "e5"]


@pytest.mark.parametrize("text", NO_NUMBERS)
def test_what_is_no_decimal_number_or_too_small_for_one_is_not_read(text, capsys):
    with pytest.raises(SystemExit, match="2"):
        main(["rebound", "--incidence", text])
    assert f"argument --incidence: {text!r}: " in capsys.readouterr().err


def test_zeros_are_zero_however_they_are_written(capsys):
    zeros = ["0", "-0.0", ".0", "0e-999", "5e-324", "1E+3", " +1."]
    assert main(["rebound", "--model", "rigid", "--incidence", *zeros]) == 0
    found = columns_of(capsys.readouterr().out)["incidence [mu v2(0)]"]
    assert [float(x) for x in found] == [float(x) for x in zeros]


def test_a_closed_standard_output_is_named(capsys, monkeypatch):
    with monkeypatch.context() as closed:
        closed.setattr(sys, "stdout", None)
        assert main(["rebound", "--incidence", "1"]) == 2
    assert capsys.readouterr().err == "planarimpact: standard output is closed\n"


def test_models_are_listed(capsys):
    assert main(["models"]) == 0
    assert [row["model"] for row in rows_of(capsys.readouterr().out)] == list(models.MODELS)


REFUSED = [
    (["rebound", "--incidence", "nan"], "incidence[0] = nan"),
    (["rebound", "--incidence", "1", "--set", "steps"], "--set steps: allowed is NAME=NUMBER"),
    (["rebound", "--incidence", "1", "--set", "steps=4"], "lumped has no settings"),
    (["rebound", "--incidence", "1", "--model", "annuli", "--restitution", "0.5"], "is elastic"),
    (["rebound", "--incidence", "1", "--response", "none.json"], "none.json: No such file"),
    (["rebound", "--incidence", "1", "--response", "x", "--mass-ratio", "2"], "has its own"),
    (["rebound", "--incidence", "1", "--response", "x", "--model", "rigid"], "has its own"),
    (["rebound", "--incidence", "1", "--set", "model=3"], "model = 3: lumped has no settings"),
    (["compile", "x", "--model", "continuum", "--set", "tolerance=1"], "has one tolerance"),
    (["history", "--incidence", "1", "--samples", "1"], "samples = 1"),
    (["history", "--incidence", "1", "--tolerance", "1"], "--tolerance: it does not apply"),
    (["history", "--incidence", "1", "--model", "continuum", "--samples", "9"], "--samples: it"),
    (
        ["history", "--incidence", "1", "--model", "continuum", "--restitution", "0.5"],
        "unless loss says what takes the energy: viscous, plastic",
    ),
    (["compile", "no/ball.json"], "no/ball.json"),
    (["scene", "none.csv", "out.csv"], "none.csv: No such file"),
    (["scene", "none.csv", "."], ".: allowed are names that end in .csv, .csv.gz, .parquet, and -"),
    (["scene", "none.json", "out.csv"], "none.json: allowed are names that end in .csv, .csv.gz"),
    (["scene", "none.parquet", "out.csv"], "none.parquet: No such file"),
    (["rebound", "--incidence", "1", "--friction", "0.3"], "--friction: it does not apply"),
    (["models", "--output", "no/models.csv"], "there is no folder"),
    (["rebound", "--angle", "30"], "--angle: it needs --friction"),
    (["rebound", "--angle", "30", "--friction", "0"], "friction = 0.0: allowed are"),
    (["rebound", "--incidence", "1", "--friction", "0"], "--friction: it does not apply"),
    (["rebound", "--incidence", "1", "--set", "steps=-5"], "steps = -5"),
    (["models", "--output", "a.txt"], "--output a.txt: allowed are names that end in .csv or"),
    (["models", "--output", "csv"], "--output csv: allowed are"),
    (["history", "--incidence", "1", "--output", "a.csv", "--format", "json"], "ends in .csv"),
    (["rebound", "--incidence", "1", "--output", "a.json", "--format", "csv"], "ends in .json"),
    (["compile", "ball.csv"], "ball.csv: allowed are names that end in .json; with --as c or"),
    (["compile", "ball.json", "--as", "c"], "ball.json: allowed are names that end in .h"),
    (["compile", "ball.h", "--as", "js"], "ball.h: allowed are names that end in .mjs or .js"),
    (["compile", "2.h", "--as", "c"], "2.h: allowed are names of letters from A to Z, digits and"),
    *(
        (["compile", "a.h", "--as", "c", "--model", "spheres", option, value], words)
        for option, value, words in (
            ("--loss", "viscous", "--loss: it does not apply, the table of spheres takes"),
            ("--incidence-max", "9", "--incidence-max: it does not apply"),
            ("--restitution", "0.9", "--restitution: it does not apply"),
            ("--set", "steps=4", "--set: it does not apply"),
            ("--tolerance", "1e-9", "tolerance = 1e-09: allowed is "),
        )
    ),
    (
        ["compile", "a.json", "--model", "spheres"],
        "--as json: allowed with model spheres are c, js",
    ),
    (["compile", "2.h", "--as", "c", "--model", "spheres"], "2.h: allowed are names of letters"),
    (["rebound", "--incidence", "1", "--response", ""], "--response '': allowed are names of"),
    (["rebound", "--incidence", "1", "--set", "n=1", "--set", "n=2"], "--set n=2: n is set twice"),
    (["rebound", "--incidence", "1", "--set", "steps=1_0"], "--set steps: '1_0': allowed are"),
    (["history", "--incidence", "1", "--samples", f"{10**15}"], f"samples = {10**15}: allowed are"),
]


def test_a_bad_name_is_refused_before_any_work(capsys, tmp_path, monkeypatch):
    monkeypatch.setattr(models, "rebound", lambda *_, **__: pytest.fail("it solves"))
    monkeypatch.setattr(response, "compile", lambda *_, **__: pytest.fail("it compiles"))
    for name in (tmp_path / "no" / "a.json", tmp_path / "a.txt", tmp_path):
        assert main(["rebound", "--incidence", "1", "--output", str(name)]) == 2
        assert main(["compile", str(name)]) == 2
        assert main(["compile", str(name), "--as", "c"]) == 2
        assert main(["compile", str(name.with_name("2.h")), "--as", "c"]) == 2
        assert capsys.readouterr().err.count("\n") == 4


@pytest.mark.parametrize("command", [["models"], ["rebound", "--incidence", "1"]])
def test_the_name_of_a_file_says_its_format(command, tmp_path, capsys):
    for ending, kind in (("json", "json"), ("csv", "csv")):
        path = tmp_path / f"table.{ending}"
        assert main([*command, "--output", str(path)]) == 0
        assert main([*command, "--format", kind]) == 0
        assert path.read_text() == capsys.readouterr().out


@pytest.mark.parametrize(
    ("program", "called"),
    [
        ("/bin/planarimpact", "planarimpact"),
        ("/x/planarimpact/__main__.py", "python -m planarimpact"),
        ("/home/me/my_law.py", "python my_law.py"),
    ],
)
def test_the_usage_says_how_it_was_called(program, called, monkeypatch, capsys):
    monkeypatch.setattr(sys, "argv", [program, "models", "--help"])
    with pytest.raises(SystemExit):
        main()
    assert capsys.readouterr().out.startswith(f"usage: {called} models")


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
    assert all(word in text for word in ("rebound", "history", "compile", "scene", "models"))
