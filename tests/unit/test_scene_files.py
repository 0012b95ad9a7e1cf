"""Scenes from file to file, and on the command line."""

import gzip
import os
import re
import sys

import numpy as np
import pandas as pd
import pytest

from planarimpact import scene
from planarimpact.__main__ import main

COUNT = 7
ROW = {
    "radius [m]": 0.01,
    "density [kg/m^3]": 7800,
    "young_modulus [Pa]": 207e9,
    "poisson_ratio": 0.3,
    "friction": 0.05,  # it slides throughout: its result is a formula, the same to the last digit
    "restitution": 0.8,
    "loss": "viscous",
    "velocity_tangential [m/s]": 1.0,
    "velocity_normal [m/s]": 2.5,
    "spin [rad/s]": 0.0,
}


def impacts(**more):
    """Spheres that slide throughout, but for one without friction: all of them are formulas."""
    rng = np.random.default_rng(4)
    varied = {
        "friction": [0.05] * 6 + [0.0],
        "restitution": [0.8, 0.8, 0.01, 0.8, 0.8, 0.8, 0.8],  # one without peak forces
        "velocity_tangential [m/s]": rng.uniform(1, 2, COUNT),
    }
    return pd.DataFrame(ROW | varied | more)


@pytest.fixture
def table(tmp_path):
    path = tmp_path / "in.csv"
    impacts().to_csv(path, index=False)
    return path


def cells_of(path):
    """Texts of a table, as they stand there."""
    return pd.read_csv(path, dtype=str, keep_default_na=False)


# One table, in all kinds of files.


@pytest.mark.parametrize("kind", scene.KINDS)
def test_every_kind_of_file_has_the_same_answers(tmp_path, table, kind):
    rows = impacts(id=["7", "a,b", 'say "c"', "", "two\nlines", "NA", "1.50"])
    rows.to_csv(table, index=False)
    (tmp_path / "IN.CSV.GZ").write_bytes(gzip.compress(table.read_bytes()))
    # Parquet has whole numbers, short ones, text and dictionaries, CSV has text.
    short = {"velocity_normal [m/s]": "float32", "id": "category", "radius [m]": str}
    rows.astype(short).to_parquet(tmp_path / "in.parquet")
    kept = {"dtype": {"id": str}, "keep_default_na": False, "na_values": {"loss": []}}
    kept["na_values"] |= {
        name: [""] for name in scene.solve(rows) if "force" in name or "form" in name
    }
    for source in ("in.csv", "IN.CSV.GZ", "in.parquet"):
        out = tmp_path / f"{source}{kind}"
        scene.solve_file(tmp_path / source, out, chunk=2)
        found = pd.read_parquet(out) if kind == ".parquet" else pd.read_csv(out, **kept)
        loose = {"check_dtype": False, "check_exact": True, "check_categorical": False}
        pd.testing.assert_frame_equal(found, scene.solve(rows), **loose)


def test_without_arrow_text_is_written_by_pandas(table, monkeypatch):
    rows = impacts(id=["7", "a,b", 'say "c"', "", "two\nlines", "NA", "1.50"])
    rows.to_csv(table, index=False)
    scene.solve_file(table, by_arrow := table.with_name("arrow.csv"), chunk=2)
    monkeypatch.setitem(sys.modules, "pyarrow", None)
    scene.solve_file(table, by_pandas := table.with_name("pandas.csv"), chunk=2)
    found, wanted = cells_of(by_pandas), cells_of(by_arrow)
    assert list(found) == list(wanted)
    for name in wanted:
        pairs = zip(found[name], wanted[name], strict=True)
        assert all(a == b or float(a) == float(b) for a, b in pairs), name


def test_parts_do_not_show(table):
    """A part of whole numbers is written as one of others is, also after a row of words."""
    spins = ["1", "2", "3", "0.5", "4", "fast", "-7"]
    masses = ["inf", "inf", "-1", "2.0", "1e99", "1", "1"]
    other = {"other_radius [m]": 0.01, "other_gyration [m]": 0.005, "other_mass [kg]": masses}
    impacts(**{"spin [rad/s]": spins}, **other).to_csv(table)
    whole, parts = table.with_name("whole.csv"), table.with_name("parts.csv")
    first = scene.solve_file(table, whole, skip_bad=True)
    second = scene.solve_file(table, parts, skip_bad=True, chunk=2)
    assert whole.read_text() == parts.read_text() and first.explain() == second.explain()
    found = pd.read_csv(whole)
    assert found["spin [rad/s]"].tolist() == [1, 2, 0.5, 4, -7]
    assert found["other_mass [kg]"].tolist() == [np.inf, np.inf, 2, 1e99, 1]
    assert first.rows == second.rows == COUNT and first.bad == second.bad
    assert [row for row, _ in first.bad] == [3, 6]


def test_numbers_are_read_and_written_to_the_last_place(tmp_path):
    """From text, and as text: any float64, in a column of the user alone."""
    bits = np.random.default_rng(1).integers(0, 2**64, 5_000, dtype=np.uint64).view(float)
    special = [0.0, -0.0, 5e-324, -np.inf, np.inf, 1e10, 1e16, 2.0**53, 1e22, 207e9, 1e-5]
    numbers = np.concatenate([special, bits[~np.isnan(bits)]])
    spins = np.random.default_rng(8).normal(0, 50, numbers.size)
    rows = pd.DataFrame(ROW | {"own": numbers, "spin [rad/s]": spins})
    rows.to_parquet(tmp_path / "in.parquet")
    scene.solve_file(tmp_path / "in.parquet", tmp_path / "out.csv")
    written = cells_of(tmp_path / "out.csv")
    found = np.array([float(cell) for cell in written["own"]])
    assert np.array_equal(found.view(np.uint64), numbers.view(np.uint64))
    assert list(map(float, written["spin [rad/s]"])) == spins.tolist()
    text = rows[list(ROW)].assign(**{"spin [rad/s]": list(map(repr, spins.tolist()))})
    text.to_csv(tmp_path / "in.csv", index=False)
    scene.solve_file(tmp_path / "in.csv", tmp_path / "out.parquet")
    assert pd.read_parquet(tmp_path / "out.parquet")["spin [rad/s]"].tolist() == spins.tolist()


@pytest.mark.parametrize(
    "change",
    [
        lambda text: text.replace("\n", "\r\n"),
        lambda text: re.sub(r"(\w+) (\[.*?\])", r'"\1\n\2"', text),  # as Excel breaks a cell
        lambda text: text.replace(",", ", "),
        lambda text: "\ufeff" + text.replace("\n", "\n \n\n").rstrip(),
    ],
    ids=["CRLF", "line breaks in the header", "blanks", "blank lines"],
)
def test_text_may_have_any_form(table, change):
    wanted = scene.solve_file(table, table.with_name("plain.csv"))
    table.write_bytes(change(table.read_text()).encode())
    found = scene.solve_file(table, table.with_name("out.csv"), chunk=2)
    assert found.rows == wanted.rows == COUNT
    text = table.with_name("out.csv").read_text().replace('" ', '"')  # cells stay as they are
    assert text == table.with_name("plain.csv").read_text()


def test_rows_of_another_width_are_bad_rows(table, capsys):
    """Before and behind other bad rows, which keep their numbers; and where no good one is left."""
    header, *rows = table.read_text().splitlines()
    fast, slow, parts = (rows[2].replace("2.5", word) for word in ("fast", "slow", "-2.5"))
    rows[1:] = ["1,2", " ", rows[1], f"{rows[3]},1", fast, parts, slow]
    table.write_text("\n".join([header, *rows]))
    out = table.with_name("out.csv")
    assert main(["scene", str(table), str(out)]) == 2 and not out.exists()
    assert "in.csv: row 2: young_modulus [Pa] = ''" in capsys.readouterr().err
    assert main(["scene", str(table), str(out), "--skip-bad", "--chunk", "3"]) == 0
    bad = pd.read_csv(f"{out}.bad.csv").values.tolist()
    assert [row for row, _ in bad] == [2, 4, 5, 6, 7] and len(pd.read_csv(out)) == 2
    wanted = ["young_modulus [Pa] = ''", "11 cells where 10", "= 'fast'", "= -2.5", "= 'slow'"]
    assert all(words in problem for words, (_, problem) in zip(wanted, bad, strict=True))
    table.write_text(f"{header}\n1\n2\n")
    assert main(["scene", str(table), str(out), "--skip-bad"]) == 0
    assert pd.read_csv(f"{out}.bad.csv")["row"].tolist() == [1, 2] and pd.read_csv(out).empty


# Columns of the user alone.

OWN = "007", "1e5", "", "NA", "null", " x y ", 'a "b", c', "two\nlines", "1.50", "-0", "c\r\n", "é"


def test_cells_of_csv_are_carried_over_as_text(table):
    given = pd.DataFrame({"radius [m]": 0.01, "colour": OWN} | ROW)
    # As Excel writes it.
    given.to_csv(table, index=False, encoding="utf-8-sig", lineterminator="\r\n")
    out = table.with_name("out.csv")
    report = scene.solve_file(table, out, chunk=2)
    assert cells_of(out)["colour"].tolist() == list(OWN)
    assert list(cells_of(out))[:11] == list(given)
    assert report.own == ["'colour'"]


def test_cells_of_parquet_keep_their_types(tmp_path):
    own = {"batch": pd.array([2**53 + 1, None, 3, 4, 5, 6, 7], dtype="Int64")}
    own |= {"good": [True, False] + [True] * 5, "names": [["a"], ["b", "c"], *[[]] * 5]}
    impacts(**own).to_parquet(tmp_path / "in.parquet")
    given = pd.read_parquet(tmp_path / "in.parquet")[list(own)]
    scene.solve_file(tmp_path / "in.parquet", tmp_path / "out.parquet", chunk=3)
    found = pd.read_parquet(tmp_path / "out.parquet")[list(own)]
    pd.testing.assert_frame_equal(found, given)
    scene.solve_file(tmp_path / "in.parquet", tmp_path / "out.csv")
    assert cells_of(tmp_path / "out.csv")["batch"].tolist()[:2] == [str(2**53 + 1), ""]


# Nothing is half-written.


def test_a_bad_row_leaves_nothing_behind_or_is_left_out(table, capsys):
    """Also where parts before it are solved already. An earlier result survives."""
    rows = impacts()
    rows.loc[4, "friction"] = -1
    rows.to_csv(table, index=False)
    out, bad = table.with_name("out.csv"), table.with_name("out.csv.bad.csv")
    out.write_text("earlier")
    assert main(["scene", str(table), str(out), "--chunk", "2"]) == 2
    assert "in.csv: row 5: friction = -1" in capsys.readouterr().err
    assert out.read_text() == "earlier" and len(os.listdir(table.parent)) == 2
    assert main(["scene", str(table), str(out), "--skip-bad"]) == 0
    assert "6 impacts\n" in (said := capsys.readouterr().out) and "1 bad rows left out" in said
    assert len(pd.read_csv(out)) == 6
    assert pd.read_csv(bad)["row"].tolist() == [5]
    assert pd.read_csv(bad)["problem"][0].startswith("friction = -1.0: allowed are")
    impacts().to_csv(table, index=False)
    scene.solve_file(table, out, skip_bad=True)
    assert bad.read_text() == "row,problem\n"  # of the result that is there


# The command line.


@pytest.mark.parametrize("loss", ["viscous", "plastic"])
def test_a_scene_on_the_command_line(table, capsys, loss):
    """With each of its options: tolerance, loss and explain."""
    rows = impacts(batch=7, id="a", friction=0.3).drop(columns="loss")[:2]
    rows.to_csv(table, index=False)
    out = table.with_name("out.csv")
    options = ["--explain", "--loss", loss, "--tolerance", "0.02"]
    assert main(["scene", str(table), str(out), *options]) == 0
    said = capsys.readouterr()
    assert "2 impacts, tolerance 0.02\n" in said.out and f"continuum.{loss}, table" in said.out
    assert said.err == "not known, and carried over as they are: columns 'batch'\n"
    found, wanted = pd.read_csv(out), scene.solve(rows, loss=loss)
    assert found[["batch", "id"]].iloc[0].tolist() == [7, "a"]
    name = "velocity_tangential_after [m/s]"
    assert found[name].tolist() == pytest.approx(wanted[name].tolist(), rel=1e-14)
    assert sorted(os.listdir(table.parent)) == ["in.csv", "out.csv"]


@pytest.mark.parametrize(
    ("package", "out", "extra"), [("pandas", "a.csv", "scene"), ("pyarrow", "a.parquet", "parquet")]
)
def test_without_a_package_it_says_what_to_install(table, monkeypatch, capsys, package, out, extra):
    monkeypatch.setitem(sys.modules, package, None)
    assert main(["scene", str(table), str(table.with_name(out))]) == 2
    words = f"needs {package}: pip install 'planarimpact[{extra}]'"
    assert words in capsys.readouterr().err and os.listdir(table.parent) == ["in.csv"]
