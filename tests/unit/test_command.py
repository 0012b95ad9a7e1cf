"""The command line, in and out."""

import csv
import json
import os
import subprocess
import sys

import pandas as pd
import pytest

from planarimpact import ladder, lumped
from planarimpact.__main__ import main
from planarimpact.scene import files

ROW = {
    "radius [m]": 0.01,
    "density [kg/m^3]": 7800.0,
    "young_modulus [Pa]": 207e9,
    "poisson_ratio": 0.3,
    "friction": 0.3,
    "restitution": 0.8,
    "velocity_tangential [m/s]": 1.0,
    "velocity_normal [m/s]": 2.0,
    "spin [rad/s]": 0.0,
}


@pytest.fixture
def table(tmp_path):
    path = tmp_path / "in.csv"
    pd.DataFrame([ROW] * 5).to_csv(path, index=False)
    return path


def rows_of(text):
    return list(csv.DictReader(text.splitlines()))


def test_rebound_prints_what_the_model_says(capsys):
    assert main(["rebound", "--incidence", "0.5", "-2", "8", "--restitution", "0.5"]) == 0
    rows = rows_of(capsys.readouterr().out)
    exact = lumped.rebound([0.5, -2.0, 8.0], restitution=0.5)
    assert [float(row["velocity"]) for row in rows] == exact.velocity.tolist()
    assert [row["regime"] for row in rows][2] == "SLIP_THROUGHOUT"


def test_angles_settings_and_json(capsys):
    command = ["rebound", "--angle", "45", "--friction", "0.5", "--format", "json"]
    assert main([*command, "--model", "timestep.linear", "--set", "steps=256"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["incidence"] == pytest.approx([2.0])
    assert found["velocity"] == [
        ladder.rebound("timestep.linear", found["incidence"][0], steps=256)[0]
    ]
    assert main([*command, "--model", "laws.smith"]) == 0
    assert json.loads(capsys.readouterr().out)["peak_friction"] == [None]


def test_history_of_both_models(capsys):
    for model in ("lumped", "continuum"):
        assert main(["history", "--incidence", "1", "--model", model, "--tolerance", "0.01"]) == 0
        rows = rows_of(capsys.readouterr().out)
        assert float(rows[0]["time"]) == 0 and float(rows[-1]["time"]) == 2


def test_compile_and_use(capsys, tmp_path):
    path = str(tmp_path / "ball.json")
    assert main(["compile", path, "--tolerance", "1e-9", "--restitution", "0.7"]) == 0
    assert main(["rebound", "--incidence", "2", "--response", path]) == 0
    row = rows_of(capsys.readouterr().out.split("\n", 1)[1])[0]
    assert float(row["velocity"]) == pytest.approx(
        lumped.rebound(2.0, restitution=0.7)[0], abs=1e-9
    )


def test_models_are_listed(capsys):
    assert main(["models"]) == 0
    assert [row["model"] for row in rows_of(capsys.readouterr().out)] == list(ladder.MODELS)


REFUSED = [
    (["rebound", "--incidence", "nan"], "incidence[0] = nan"),
    (["rebound", "--incidence", "1", "--set", "steps"], "--set steps: allowed is NAME=NUMBER"),
    (["rebound", "--incidence", "1", "--set", "steps=4"], "lumped has no settings"),
    (["rebound", "--incidence", "1", "--model", "annuli", "--restitution", "0.5"], "is elastic"),
    (["rebound", "--incidence", "1", "--response", "none.json"], "none.json: No such file"),
    (["rebound", "--incidence", "1", "--response", "x", "--mass-ratio", "2"], "has its own"),
    (["history", "--incidence", "1", "--samples", "1"], "samples = 1"),
    (["history", "--incidence", "1", "--model", "continuum", "--restitution", "0.5"], "is elastic"),
    (["compile", "no/ball.json"], "no/ball.json"),
    (["scene", "none.csv", "out.csv"], "none.csv: No such file"),
    (["scene", "none.csv", "none.csv"], "it is the table that is read"),
]


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
    assert "5 impacts" in words and "lumped, solved" in words
    assert len(pd.read_csv(out)) == 5
    assert sorted(p.name for p in table.parent.iterdir()) == ["in.csv", "out.csv"]


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


@pytest.mark.parametrize("text", ["", "\x00\x01", 'a,"b\n1', "radius [m],radius [m]\n1,1\n"])
def test_what_is_no_table_is_refused(table, text, capsys):
    table.write_text(text)
    assert main(["scene", str(table), str(table.with_name("out.csv"))]) == 2
    assert "in.csv" in capsys.readouterr().err


def test_parquet_without_pyarrow_says_what_to_install(table, capsys, monkeypatch):
    monkeypatch.setitem(sys.modules, "pyarrow", None)
    assert main(["scene", str(table), str(table.with_name("out.parquet"))]) == 2
    assert "pip install pyarrow" in capsys.readouterr().err


def test_parquet(table):
    pytest.importorskip("pyarrow", reason="pyarrow is not installed")
    source, out = table.with_name("in.parquet"), table.with_name("out.parquet")
    pd.read_csv(table).to_parquet(source)
    files.solve(source, out, rows=2)
    plain = table.with_name("out.csv")
    files.solve(table, plain)
    pd.testing.assert_frame_equal(pd.read_parquet(out), pd.read_csv(plain), check_dtype=False)


def test_help_speaks_of_every_command():
    command = [sys.executable, "-m", "planarimpact", "--help"]
    text = subprocess.run(
        command, capture_output=True, text=True, check=True, env=os.environ
    ).stdout
    assert all(word in text for word in ("rebound", "history", "compile", "scene", "models"))
