"""The command line, in and out."""

import csv
import gzip
import json
import os
import re
import shlex
import signal
import subprocess
import sys
import threading
import time

import numpy as np
import pandas as pd
import pytest

import planarimpact
from planarimpact import InputError, continuum, export, lumped, models, scene
from planarimpact.__main__ import main
from planarimpact.collision import TOLERANCE
from planarimpact.scene import files

ROW = {
    "radius [m]": 0.01,
    "density [kg/m^3]": 7800.0,
    "young_modulus [Pa]": 207e9,
    "poisson_ratio": 0.3,
    "friction": 0.05,  # it slides throughout: its result is a formula, the same to the last digit
    "restitution": 0.8,
    "loss": "viscous",
    "velocity_tangential [m/s]": 1.0,
    "velocity_normal [m/s]": 2.0,
    "spin [rad/s]": 0.0,
}


@pytest.fixture
def table(tmp_path):
    path = tmp_path / "in.csv"
    pd.DataFrame([ROW] * 5).to_csv(path, index=False)
    return path


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
    (["scene", "none.csv", "."], ".: allowed are names that end in .csv, .csv.gz, .json or"),
    (["scene", "none.xlsx", "out.csv"], "none.xlsx: allowed are names that end in .csv, .csv.gz"),
    (["scene", "none.json", "out.csv"], "none.json: allowed are names that end in .csv, .csv.gz"),
    (["scene", "none.parquet", "out.csv"], "none.parquet: No such file"),
    (["scene", "none.csv", "out"], "out: allowed are names that end in .csv, .csv.gz, .json or"),
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


def test_a_scene_from_file_to_file(table, capsys):
    out = table.with_name("out.csv")
    assert main(["scene", str(table), str(out), "--explain"]) == 0
    words = capsys.readouterr().out
    assert f"5 impacts, tolerance {TOLERANCE:g}\n" in words and "slip throughout" in words
    assert len(pd.read_csv(out)) == 5
    assert sorted(p.name for p in table.parent.iterdir()) == ["in.csv", "out.csv"]


def test_columns_of_its_own_are_told_in_one_line(table, capsys):
    pd.read_csv(table).assign(batch=7, id="a", colour="red").to_csv(table, index=False)
    out = table.with_name("out.csv")
    assert main(["scene", str(table), str(out)]) == 0
    words = "not known, and carried over as they are: columns 'batch', 'colour'\n"
    assert capsys.readouterr().err == words
    assert pd.read_csv(out)[["batch", "id", "colour"]].iloc[0].tolist() == [7, "a", "red"]


def test_a_table_is_not_replaced_by_its_result(table, capsys):
    linked = table.with_name("linked.csv")
    linked.hardlink_to(table)
    for source, out in ((table, table), (table, linked), (linked, table)):
        assert main(["scene", str(source), str(out)]) == 2
        assert "it is the table that is read" in capsys.readouterr().err
    table.rename(table.with_name("out.csv.bad.csv"))
    bad, out = table.with_name("out.csv.bad.csv"), table.with_name("out.csv")
    assert main(["scene", str(bad), str(out), "--skip-bad"]) == 2
    assert "it is the table that is read" in capsys.readouterr().err


def test_links_are_followed_and_folders_left_alone(table, capsys):
    real, link = table.with_name("real.csv"), table.with_name("link.csv")
    real.write_text("earlier")
    link.symlink_to(real)
    assert main(["scene", str(table), str(link)]) == 0
    assert link.is_symlink() and len(pd.read_csv(real)) == 5
    folder = table.with_name("folder.csv")
    folder.mkdir()
    assert main(["scene", str(table), str(folder)]) == 2
    assert "no regular file" in capsys.readouterr().err
    circle = table.with_name("circle.csv")
    circle.symlink_to(circle)
    assert main(["scene", str(table), str(circle)]) == 2
    assert "circle.csv: it is there already, and no regular file" in capsys.readouterr().err


def test_infinite_bodies_in_one_piece_do_not_shift_the_next(table):
    rows = pd.read_csv(table)
    other = {"other_radius [m]": 0.01, "other_gyration [m]": 0.005}
    rows = rows.assign(**other, **{"other_mass [kg]": [np.inf, np.inf, 1.0, 2.0, np.inf]})
    rows.to_csv(table, index=False)
    whole, pieces = table.with_name("whole.csv"), table.with_name("pieces.csv")
    files.solve(table, whole)
    files.solve(table, pieces, rows=1)
    assert whole.read_text() == pieces.read_text()
    assert "other_spin_after [rad/s]" in pd.read_csv(whole)


def test_a_number_too_large_is_not_infinite_in_a_file(table):
    other = {"other_radius [m]": 0.01, "other_gyration [m]": 0.005, "other_mass [kg]": "1e99"}
    rows = pd.DataFrame([ROW | other] * 3).assign(**{"other_mass [kg]": ["1e99", "inf", "1e400"]})
    rows.to_csv(table, index=False)
    out = table.with_name("out.csv")
    with pytest.raises(InputError, match=r"row 3: other_mass \[kg\] = '1e400': allowed are"):
        files.solve(table, out)
    assert not out.exists()
    files.solve(table, out, skip_bad=True)
    assert pd.read_csv(out)["other_mass [kg]"].tolist() == [1e99, np.inf]


HEADER = ",".join(ROW)
CELLS = [v if isinstance(v, str) else f"{v:g}" for v in ROW.values()]
LINE = ",".join(CELLS)
NO_TABLES = [
    ("", "it is empty: the first line must name the columns"),
    (" \n\n", "it is empty"),
    ("\x00\x01", "friction: missing; unknown is '\\x00\\x01'; known are radius [m], "),
    (f"{HEADER}\n\n", "it has a header, but no rows"),
    ('a,"b\n1', "line 1: its quotation marks do not match"),
    ("radius [m],radius [m]\n1,1\n", "column 'radius [m]' is there twice"),
    (HEADER.replace(",", ";"), "it is separated by semicolons; allowed are commas"),
    (HEADER.replace(",", "\t"), "it is separated by tabs; allowed are commas"),
    (f"\n{LINE}\n{LINE}\n", "header, line 2: '0.01' stands where the name of a column belongs"),
    (f"{HEADER}\n{LINE}\n\n{LINE},8\n", "row 2: 11 cells where 10 belong"),
    (f"{HEADER}\n{LINE}\n{','.join(CELLS[:-1])}\n", "row 2: 9 cells where 10 belong"),
    (f"{HEADER}\n{','.join(f'{c},0' for c in CELLS)}\n", "decimals have a point, not a comma"),
    (f"{HEADER},id\n{LINE[:-1]}0,5,1,\n", "row 1: 13 cells where 11 belong; decimals have"),
    (f"{HEADER},id\n{LINE},1,\n", "row 1: 12 cells where 11 belong; decimals have a point"),
    (f'{HEADER},id\n{LINE},"1",\n', "row 1: 12 cells where 11 belong; decimals have a point"),
    (f'{HEADER}\n"0,01",{LINE[5:]}\n', "'0,01': allowed are finite numbers above 0; decimals"),
    (f'id,{HEADER}\n"a\nb",{LINE}\n"c,d"{LINE}\n', "row 2: its quotation marks do not match"),
    (f'id,{HEADER}\n"a\nb",{LINE}\n"c,d",{LINE},8\n', "row 2: 12 cells where 11 belong"),
    (f'id,{HEADER}\n"a,{LINE}\n{LINE}\n', "row 1: its quotation marks do not match (unexpected"),
    (f"{HEADER}\r{LINE}\r", "line 1: its quotation marks do not match, or its end is wrong"),
    (f"{HEADER}\n{LINE[:-1]}NA\n", "row 1: spin [rad/s] = 'NA'"),
    (f"{HEADER}\n{LINE}\xe9\n".encode("latin-1"), "it is no text in UTF-8"),
]


@pytest.mark.parametrize(("text", "words"), NO_TABLES, ids=[words for _, words in NO_TABLES])
def test_what_is_no_table_is_named_for_what_it_is(table, text, words, capsys):
    table.write_bytes(text if isinstance(text, bytes) else text.encode())
    assert main(["scene", str(table), str(table.with_name("out.csv"))]) == 2
    found = capsys.readouterr().err
    assert "in.csv: " in found and words in found and found.count("\n") == 1
    assert os.listdir(table.parent) == ["in.csv"]


IDS = [
    "007",
    "1e5",
    "",
    "NA",
    "null",
    " x y ",
    'a "b", c',
    "two\nlines",
    "1.50",
    "-0",
    "a\rb",
    "c\r\n",
]


@pytest.mark.parametrize("rows", [1, 100])
def test_the_result_has_the_table_and_then_what_follows(table, rows):
    given = [{"radius [m]": 0.01, "id": name, **ROW, "spin [rad/s]": 1 / 3} for name in IDS]
    with open(table, "w", encoding="utf-8-sig", newline="") as file:  # as Excel writes it
        writer = csv.DictWriter(file, list(given[0]))
        writer.writeheader()
        writer.writerows(given)
    out = table.with_name("out.csv")
    files.solve(table, out, rows=rows)
    with open(out, encoding="utf-8", newline="") as file:
        found = list(csv.DictReader(file))
    assert [row["id"] for row in found] == IDS
    assert list(found[0])[:11] == list(given[0]) and len(found[0]) == 23
    for name, value in ROW.items():
        assert {type(value)(row[name]) for row in found} == {given[0][name]}


def test_numbers_are_read_and_written_to_the_last_place(table):
    rng = np.random.default_rng(8)
    rows = pd.DataFrame([ROW] * 200).assign(**{"spin [rad/s]": rng.normal(0, 50, 200)})
    rows.to_csv(table, index=False)
    out = table.with_name("out.csv")
    files.solve(table, out)
    wanted = scene.solve(rows)
    with open(out, encoding="utf-8") as file:
        found = list(csv.DictReader(file))
    for name in ("spin [rad/s]", "spin_after [rad/s]", "energy_lost [J]"):
        assert [float(row[name]) for row in found] == wanted[name].tolist()


def test_whole_numbers_and_others_are_one_column(table):
    """A piece of whole numbers is written as one of others is, also after a row of words."""
    spins = ["1", "2", "3", "0.5", "4", "fast"]
    table.write_text("\n".join([HEADER, *(LINE[:-1] + spin for spin in spins)]))
    whole, pieces = table.with_name("whole.csv"), table.with_name("pieces.csv")
    files.solve(table, whole, skip_bad=True)
    files.solve(table, pieces, skip_bad=True, rows=2)
    assert whole.read_text() == pieces.read_text()
    assert pd.read_csv(whole)["spin [rad/s]"].tolist() == [1, 2, 3, 0.5, 4]


@pytest.fixture
def standard_input():
    """A function that makes a file standard input."""
    saved = os.dup(0)

    def take(path):
        with open(path, "rb") as file:
            os.dup2(file.fileno(), 0)

    yield take
    os.dup2(saved, 0)
    os.close(saved)


@pytest.mark.parametrize(
    ("source", "target"), [("-", "-"), ("/dev/stdin", "/dev/stdout"), ("/dev/fd/0", "/dev/fd/1")]
)
def test_from_standard_input_to_standard_output(table, capfd, standard_input, source, target):
    plain = table.with_name("plain.csv")
    files.solve(table, plain)
    standard_input(table)
    assert main(["scene", source, target, "--explain"]) == 0
    found = capfd.readouterr()
    assert found.out == plain.read_text()
    assert "standard output: 5 impacts" in found.err and "slip throughout" in found.err


def test_a_file_by_its_name_is_one_also_where_it_is_standard_input(table, standard_input):
    """Whoever reads a list line by line may have read some of it already."""
    out = table.with_name("out.csv")
    standard_input(table)
    os.lseek(0, 0, os.SEEK_END)
    assert files.solve(table, out).rows == 5


def test_an_interrupt_does_not_speak_of_what_may_be_written(table, monkeypatch, capsys):
    def interrupted(*_, **__):
        raise KeyboardInterrupt

    monkeypatch.setattr(files, "solve", interrupted)
    assert main(["scene", str(table), "-"]) == 130
    assert capsys.readouterr().err == "planarimpact: interrupted\n"


def test_bad_rows_of_a_stream_are_listed_on_standard_error(table, capfd, standard_input):
    table.write_text(f"{HEADER}\n{LINE}\n-{LINE}\n{LINE}\n")
    standard_input(table)
    assert main(["scene", "-", "-", "--skip-bad"]) == 0
    found = capfd.readouterr()
    assert len(rows_of(found.out)) == 2
    assert "row 2, left out: radius [m] = -0.01: allowed are finite numbers above 0" in found.err
    standard_input(table)
    assert main(["scene", "-", "-"]) == 2
    assert "standard input: row 2: radius [m] = -0.01" in capfd.readouterr().err
    assert os.listdir(table.parent) == ["in.csv"]


def test_pipes_are_csv_whatever_they_are_called(table, capsys):
    plain, named = table.with_name("plain.csv"), table.with_name("named.json")
    files.solve(table, plain)
    os.mkfifo(named)
    inner, outer = os.pipe()  # as the shell's <(...)
    shares, found = [], []
    reader = threading.Thread(target=lambda: found.append(named.read_text()), daemon=True)
    reader.start()
    os.write(outer, table.read_bytes())
    os.close(outer)
    files.solve(f"/dev/fd/{inner}", named, rows=2, progress=lambda *done: shares.append(done))
    os.close(inner)
    reader.join()
    assert found == [plain.read_text()] and named.is_fifo()
    assert shares == [(None, 2), (None, 4), (None, 5)]
    files.Bar()(*shares[-1])
    assert capsys.readouterr().err == "5 impacts\n"
    assert sorted(os.listdir(table.parent)) == ["in.csv", "named.json", "plain.csv"]


def test_gzip_in_and_out(table, capsys):
    packed, out = table.with_name("IN.CSV.GZ"), table.with_name("out.csv.gz")
    packed.write_bytes(gzip.compress(table.read_bytes()))
    plain = table.with_name("plain.csv")
    files.solve(table, plain)
    files.solve(packed, out)
    assert gzip.decompress(out.read_bytes()) == plain.read_bytes()
    first = out.read_bytes()
    files.solve(packed, out, rows=5)
    assert out.read_bytes() == first  # no name of a file, no time
    for half in (packed.read_bytes()[:-9], b"radius [m]"):
        packed.write_bytes(half)
        assert main(["scene", str(packed), str(out)]) == 2
        assert "IN.CSV.GZ: it is no whole gzip file" in capsys.readouterr().err
    assert out.read_bytes() == first


def test_a_reader_of_the_table_that_has_had_enough_is_no_error(table):
    command = f"{shlex.quote(sys.executable)} -m planarimpact scene {table} - | :"
    result = subprocess.run(
        ["bash", "-o", "pipefail", "-c", command], capture_output=True, text=True
    )
    assert result.returncode == 0 and "Traceback" not in result.stderr


@pytest.mark.parametrize(("number", "status"), [(signal.SIGTERM, -15), (signal.SIGINT, 130)])
def test_a_scene_that_is_ended_leaves_the_earlier_result(table, number, status):
    waiting, out = table.with_name("waiting"), table.with_name("out.csv")
    out.write_text("earlier")
    os.mkfifo(waiting)
    code = "import signal, sys; from planarimpact.__main__ import main; "
    # Whoever runs the tests may ignore them.
    code += "signal.signal(signal.SIGTERM, signal.SIG_DFL); "
    code += "signal.signal(signal.SIGINT, signal.default_int_handler); sys.exit(main(sys.argv[1:]))"
    command = [sys.executable, "-c", code, "scene", str(waiting), str(out)]
    held = os.open(waiting, os.O_RDWR)  # a table that never ends
    process = subprocess.Popen(command, stderr=subprocess.DEVNULL)
    while process.poll() is None and len(os.listdir(table.parent)) < 4:
        time.sleep(0.01)
    process.send_signal(number)
    assert process.wait() == status
    os.close(held)
    assert out.read_text() == "earlier"
    if number == signal.SIGINT:
        assert sorted(os.listdir(table.parent)) == ["in.csv", "out.csv", "waiting"]


def test_pieces_do_not_show(table):
    whole, pieces = table.with_name("whole.csv"), table.with_name("pieces.csv")
    shares = []
    files.solve(table, whole)
    files.solve(table, pieces, rows=2, progress=lambda share, impacts: shares.append(impacts))
    assert whole.read_text() == pieces.read_text() and shares == [2, 4, 5]


def test_a_bad_row_leaves_nothing_behind(table, capsys):
    rows = pd.read_csv(table)
    rows.loc[3, "friction"] = -1
    rows.to_csv(table, index=False)
    out = table.with_name("out.csv")
    assert main(["scene", str(table), str(out)]) == 2
    assert "in.csv: row 4: friction = -1" in capsys.readouterr().err
    assert [p.name for p in table.parent.iterdir()] == ["in.csv"]
    assert main(["scene", str(table), str(out), "--skip-bad"]) == 0
    assert len(pd.read_csv(out)) == 4
    assert pd.read_csv(f"{out}.bad.csv")["row"].tolist() == [4]


def test_an_earlier_result_survives_a_refusal(table):
    out = table.with_name("out.csv")
    out.write_text("earlier")
    table.write_text("radius [m]\n1\n")
    assert main(["scene", str(table), str(out)]) == 2
    assert out.read_text() == "earlier"


@pytest.mark.parametrize("package", ["pandas", "pyarrow"])
def test_without_a_package_it_says_what_to_install(table, package):
    code = f"import sys; sys.modules[{package!r}] = None; from planarimpact.__main__ import main; "
    code += f"sys.exit(main(['scene', {str(table)!r}, 'out.csv']))"
    result = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert result.returncode == 2
    wanted = "planarimpact.scene.files needs pandas and pyarrow: pip install 'planarimpact[scene]'"
    assert wanted in result.stderr


def test_a_result_in_json(table):
    out, plain = table.with_name("out.json"), table.with_name("out.csv")
    rows = pd.read_csv(table).assign(friction=[0.3, 0.0, 0.3, 0.3, 0.3])
    rows.to_csv(table, index=False)
    files.solve(table, out, rows=2)
    files.solve(table, plain, rows=2)
    found = json.loads(out.read_text())
    assert found[1]["incidence"] is None and len(found) == 5
    exact = pd.read_csv(plain).replace(np.inf, np.nan)
    pd.testing.assert_frame_equal(pd.DataFrame(found), exact, check_dtype=False, rtol=1e-15)
    table.write_text(table.read_text().replace("0.8", "-1"))
    files.solve(table, out, skip_bad=True)
    assert json.loads(out.read_text()) == []


def test_a_reader_that_has_had_enough_is_no_error():
    python = shlex.quote(sys.executable)
    command = f"{python} -m planarimpact history --incidence 1 --samples 20000 | head -1"
    result = subprocess.run(
        ["bash", "-o", "pipefail", "-c", command], capture_output=True, text=True
    )
    assert result.returncode == 0 and not result.stderr and result.stdout.startswith("time [t_c],")


def test_a_list_of_bad_rows_is_written_where_they_are_skipped_and_only_there(table):
    out = table.with_name("out.csv")
    bad = table.with_name("out.csv.bad.csv")
    bad.write_text("mine")
    files.solve(table, out)
    assert bad.read_text() == "mine"
    files.solve(table, out, skip_bad=True)
    assert bad.read_text() == "row,problem\n"
    table.write_text("radius [m]\n1\n")
    bad.write_text("of the result that is there")
    with pytest.raises(InputError):
        files.solve(table, out, skip_bad=True)
    assert bad.read_text() == "of the result that is there"


def test_a_list_of_bad_rows_does_not_replace_the_result(table):
    out, bad = table.with_name("out.csv"), table.with_name("out.csv.bad.csv")
    bad.symlink_to(out)
    with pytest.raises(InputError, match="out.csv.bad.csv: it is a link to the result"):
        files.solve(table, out, skip_bad=True)
    assert not out.exists()


def test_help_speaks_of_every_command():
    command = [sys.executable, "-m", "planarimpact", "--help"]
    text = subprocess.run(
        command, capture_output=True, text=True, check=True, env=os.environ
    ).stdout
    assert all(word in text for word in ("rebound", "history", "scene", "fit", "export", "models"))
