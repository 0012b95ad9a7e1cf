"""Files of scenes: Parquet beside CSV, text of numbers, and workers."""

import contextlib
import csv
import io
import json
import multiprocessing
import os
import signal
import subprocess
import sys
import time
from decimal import Decimal

import numpy as np
import pandas as pd
import psutil
import pyarrow as pa
import pyarrow.parquet as pq
import pytest

from planarimpact import InputError
from planarimpact.__main__ import main
from planarimpact.scene import files, places, reading, workers, writing

COUNT = 7


def impacts(**more):
    """Spheres that slide throughout, but for one without friction: all of them are formulas."""
    rng = np.random.default_rng(4)
    row = {
        "radius [m]": 0.01,
        "density [kg/m^3]": 7800,  # whole numbers
        "young_modulus [Pa]": 207e9,
        "poisson_ratio": 0.3,
        "friction": [0.05] * 6 + [0.0],
        "restitution": [0.8, 0.8, 0.01, 0.8, 0.8, 0.8, 0.8],  # one without peak forces
        "loss": "viscous",
        "velocity_tangential [m/s]": rng.uniform(1, 2, COUNT),
        "velocity_normal [m/s]": np.float32(2.5),
        "spin [rad/s]": 0.0,
    }
    return pd.DataFrame(row | more)


def same(found, wanted):
    """Whether two tables have the same columns, words and bits, whatever they take for no value."""
    pd.testing.assert_frame_equal(
        found, wanted, check_dtype=False, check_exact=True, check_categorical=False
    )
    return True


@pytest.fixture
def table(tmp_path):
    path = tmp_path / "in.csv"
    impacts().to_csv(path, index=False)
    return path


def test_the_same_table_in_parquet_has_the_same_answers(tmp_path):
    rows = impacts(id=["7", "a,b", 'say "c"', "", "two\nlines", "NA", "1.50"])
    rows.to_csv(tmp_path / "in.csv", index=False)
    # Parquet has whole numbers, short ones, text and dictionaries, CSV has text.
    text = rows.assign(**{"radius [m]": "0.01", "id": rows["id"].astype("category")})
    text.to_parquet(tmp_path / "in.parquet", row_group_size=3)
    for source in ("in.csv", "in.parquet"):
        for target in (f"{source}.csv", f"{source}.parquet"):
            files.solve(tmp_path / source, tmp_path / target, rows=2)
    plain = (tmp_path / "in.csv.csv").read_bytes()
    assert (tmp_path / "in.parquet.csv").read_bytes() == plain
    wanted = pd.read_csv(io.BytesIO(plain), keep_default_na=False, dtype={"id": str})
    unknown = "model_form [m/s]", "peak_normal_force [N]", "peak_friction_force [N]"
    for name in ("incidence", *unknown):
        wanted[name] = pd.to_numeric(wanted[name], errors="coerce")
    found = pd.read_parquet(tmp_path / "in.csv.parquet")
    assert found["peak_normal_force [N]"].isna().tolist() == [i == 2 for i in range(COUNT)]
    assert same(found, wanted) and same(pd.read_parquet(tmp_path / "in.parquet.parquet"), wanted)


def test_whole_numbers_are_an_id_in_parquet_and_some_may_be_missing(tmp_path):
    source, target = tmp_path / "in.parquet", tmp_path / "out.parquet"
    label = pa.array([2**53 + 1, None, 3, 4, 5, 6, 7])
    pq.write_table(pa.Table.from_pandas(impacts()).append_column("id", label), source)
    files.solve(source, target, rows=2)
    assert pq.read_table(target)["id"].combine_chunks() == label
    for kind, missing in ((".csv", ""), (".json", None)):
        out = tmp_path / f"out{kind}"
        files.solve(source, out)
        text = out.read_text()
        found = json.loads(text) if kind == ".json" else list(csv.DictReader(text.splitlines()))
        assert [str(row["id"]) for row in found[:3:2]] == [str(2**53 + 1), "3"]
        assert found[1]["id"] == missing


def test_columns_of_the_user_alone_are_carried_over(tmp_path):
    """As text from CSV, cell by cell; with their types from Parquet, also where some are missing"""
    rows = impacts(colour=["red", "", "a,b", "NA", "1.50", "é", "1"], batch=[1, 2, 3] + [None] * 4)
    rows = rows.astype({"batch": "Int64"}).assign(good=[True, False] * 3 + [None], age=0.1)
    rows.to_csv(tmp_path / "in.csv", index=False)
    rows.to_parquet(tmp_path / "in.parquet")
    for source in ("in.csv", "in.parquet"):
        said = []
        files.solve(tmp_path / source, tmp_path / "out.json", rows=2, notice=said.append)
        found = json.loads((tmp_path / "out.json").read_text())
        is_csv = source == "in.csv"
        assert [row["colour"] for row in found] == rows["colour"].tolist()
        assert [row["batch"] for row in found[2:4]] == (["3", ""] if is_csv else [3, None])
        assert [row["good"] for row in found[5:]] == (["False", ""] if is_csv else [False, None])
        assert found[0]["age"] == ("0.1" if is_csv else 0.1)
        words = "not known, and carried over as they are: columns 'colour', 'batch', 'good', 'age'"
        assert said == [words]


NO_PARQUET = [
    ({"friction": -1.0}, "row 1: friction = -1.0: allowed are"),
    ({"friction": [0.1, None] * 3 + [1]}, "row 2: friction = nan: allowed are"),
    ({"friction": "1_0"}, "row 1: friction = '1_0': allowed are"),
    ({"friction": True}, "row 1: friction = True: allowed are"),
    ({"id": [["a"]] * COUNT}, "column 'id' has cells of type list<"),
    ({"Friction": "red"}, "column 'Friction': unknown; did you mean 'friction'?"),
    (impacts()[:0], "it has a header, but no rows"),
    (b"radius [m]\n1\n", "it is no whole Parquet file: Parquet magic bytes not found"),
    (b"", "it is no whole Parquet file"),
]


@pytest.mark.parametrize(("given", "words"), NO_PARQUET, ids=[words for _, words in NO_PARQUET])
def test_parquet_is_refused_as_csv_is(tmp_path, given, words, capsys):
    source = tmp_path / "in.parquet"
    if isinstance(given, bytes):
        source.write_bytes(given)
    else:
        (impacts(**given) if isinstance(given, dict) else given).to_parquet(source)
    assert main(["scene", str(source), str(tmp_path / "out.parquet")]) == 2
    said = capsys.readouterr().err
    assert f"in.parquet: {words}" in said and said.count("\n") == 1
    assert os.listdir(tmp_path) == ["in.parquet"]


def test_half_a_file_of_parquet_is_named(tmp_path):
    source = tmp_path / "in.parquet"
    impacts().to_parquet(source)
    whole = source.read_bytes()
    source.write_bytes(whole[:4] + bytes(len(whole) // 2) + whole[4 + len(whole) // 2 :])
    with pytest.raises(InputError, match="in.parquet: it is no whole Parquet file"):
        files.solve(source, tmp_path / "out.csv")


def test_text_reads_back_to_the_same_bits():
    bits = np.random.default_rng(1).integers(0, 2**64, 20_000, dtype=np.uint64)
    numbers = np.concatenate([bits.view(float), np.random.default_rng(2).normal(0, 50, 20_000)])
    numbers = numbers[~np.isnan(numbers)]
    special = [0.0, -0.0, 5e-324, -np.inf, np.inf]
    special += [1e9, 1e10, 1e15, 1e16, 2.0**53, 1e22, 207e9, 1e-5]
    numbers = np.concatenate([special, numbers])
    table = pd.DataFrame({"x": numbers})
    cells = writing.encoded(table, places.CSV, header=False).decode().splitlines()
    found = np.array([float(cell) for cell in cells])
    assert np.array_equal(found.view(np.uint64), numbers.view(np.uint64))
    assert list(map(Decimal, cells)) == list(map(Decimal, map(repr, found.tolist())))  # shortest
    objects = json.loads(f"[{writing.encoded(table, places.JSON, header=False).decode()}]")
    kept = np.isfinite(numbers)
    assert [row["x"] for row in objects] == np.where(kept, numbers, None).tolist()


def test_spaces_around_numbers_are_no_part_of_them(table, tmp_path):
    plain, spaced = tmp_path / "plain.csv", tmp_path / "spaced.csv"
    files.solve(table, plain)
    text = table.read_text().split("\n", 1)
    table.write_text("\n".join([text[0], text[1].replace(",", " , ").replace("\n", " \n \n")]))
    files.solve(table, spaced, rows=3)
    assert spaced.read_text().replace(" viscous ", "viscous") == plain.read_text()


def test_a_quotation_mark_without_a_second_one_does_not_read_the_whole_table(table, monkeypatch):
    monkeypatch.setattr(reading, "MOST_LINES", 2)
    lines = impacts(id="x").to_csv(index=False).splitlines(keepends=True)
    source = io.BytesIO("".join([*lines[1:3], '"', *lines[3:]]).encode())
    assert next(reading._cut(source, 3)).count(b"\n") == 3 + 2


# Workers.


def test_workers_do_not_show(table, tmp_path, capsys):
    rows = impacts(id=[f'"{i}", ball' for i in range(COUNT)])
    rows.loc[4, "friction"] = -1
    rows.to_csv(table, index=False)
    for kind, several in (("csv", 3), ("parquet", 2)):
        shares, said, results = {}, {}, {}
        for count in (1, several):
            out, seen = tmp_path / f"{count}.{kind}", []
            solver = files.solve(
                table,
                out,
                skip_bad=True,
                rows=2,
                progress=lambda *done, seen=seen: seen.append(done),
                workers=count,
            )
            shares[count], said[count] = seen, solver.explain()
            results[count] = out.read_bytes()
            assert solver.rows == COUNT and [row for row, _ in solver.bad] == [5]
            assert pd.read_csv(f"{out}.bad.csv")["row"].tolist() == [5]
        for found in (shares, said, results):
            assert found[1] == found[several]
    assert main(["scene", str(table), str(tmp_path / "1.csv"), "--workers", "2"]) == 2
    assert "row 5: friction = -1.0: allowed are" in capsys.readouterr().err


@pytest.mark.parametrize("count", [1, 2])
def test_what_takes_long_moves_on_and_is_told(table, tmp_path, monkeypatch, count):
    """Rows for which the continuum is solved are cut into parts, and the first one tells how long.

    The result is the same. An elastic impact takes a twentieth of a viscous one.
    """
    e = np.tile([0.8, 1.0, 0.2, 0.8, 0.2, 0.8], 2)
    rows = pd.DataFrame([impacts().iloc[0]] * e.size).assign(restitution=e, friction=0.4)
    rows.loc[:, "velocity_tangential [m/s]"] = 1.0
    rows.iloc[0, list(rows).index("friction")] = 0.0
    rows.to_csv(table, index=False)
    plain, parts = tmp_path / "plain.parquet", tmp_path / "parts.parquet"
    files.solve(table, plain, 1e-4, rows=8)
    monkeypatch.setattr(files, "PART", 2)
    monkeypatch.setattr(files, "LONG", 0.0)
    done, said = [], []
    solver = files.solve(
        *(table, parts, 1e-4),
        rows=8,
        progress=lambda *now: done.append(now),
        workers=count,
        notice=said.append,
    )
    shares = [share for share, _ in done]
    assert [count for _, count in done] == [4, 6, 8, 10, 12] and shares[-1] == 1
    np.testing.assert_allclose(np.diff(shares[:3]), np.diff(shares[:2])[0])
    assert shares == sorted(shares) and solver.rows == 12
    (words,) = said
    assert words.startswith(
        "rows 1 to 8: the continuum is solved for 7 impacts, as the table of spheres is too coarse "
        "for 5 (with tolerance 0.00016 it is not) and does not cover 2 at any tolerance; about "
    )
    assert words.endswith(" s from there to the end, at the speed of the first of them")
    pd.testing.assert_frame_equal(pd.read_parquet(parts), pd.read_parquet(plain), rtol=1e-9)
    assert pq.ParquetFile(parts).num_row_groups == 1


def test_of_many_refusals_workers_find_the_first(table, tmp_path):
    lines = table.read_text().splitlines()
    lines[3] = lines[3].replace("0.05", "-1")  # row 3, in the second piece
    lines[6] += ",8"  # row 6, in the third
    table.write_text("\n".join([*lines, lines[1], '"']))
    out = tmp_path / "out.csv"
    for words in (
        r"row 3: friction = -1.0",
        "row 6: 11 cells where 10 belong",
        "row 9: its quot",
    ):
        for count in (1, 2):
            with pytest.raises(InputError, match=f"in.csv: {words}"):
                files.solve(table, out, rows=2, workers=count)
        assert os.listdir(tmp_path) == ["in.csv"]
        lines = table.read_text().splitlines()
        bad = 3 if "row 3" in words else 6
        table.write_text("\n".join([*lines[:bad], lines[1], *lines[bad + 1 :]]))


def killed(*_):
    os.kill(os.getpid(), signal.SIGKILL)


def ended(*_):
    os._exit(3)


@pytest.mark.parametrize("end", [killed, ended])
def test_a_worker_that_ends_leaves_nothing_behind(table, tmp_path, monkeypatch, end):
    monkeypatch.setattr(workers, "solved", end)
    out = tmp_path / "out.csv"
    words = "in.csv: a worker ended before its work was done: it may lack memory"
    with pytest.raises(InputError, match=words):
        files.solve(table, out, rows=2, workers=2, skip_bad=True)
    assert os.listdir(tmp_path) == ["in.csv"]
    assert not multiprocessing.active_children()


ENDLESS = """
import signal, sys
from planarimpact.scene import files
signal.signal(signal.SIGINT, signal.default_int_handler)
files.solve(sys.argv[1], sys.argv[2], rows=1, workers=2)
"""


@pytest.mark.parametrize(
    "number", [signal.SIGINT, pytest.param(signal.SIGKILL, marks=pytest.mark.long)]
)
def test_workers_end_with_their_master(table, tmp_path, number):
    waiting, out = tmp_path / "waiting", tmp_path / "out.csv"
    os.mkfifo(waiting)
    held = os.open(waiting, os.O_RDWR)  # a table that never ends
    command = [sys.executable, "-c", ENDLESS, str(waiting), str(out)]
    process = subprocess.Popen(command, stderr=subprocess.PIPE, text=True)
    os.write(held, "".join(table.read_text().splitlines(keepends=True)[:6]).encode())
    while len(found := psutil.Process(process.pid).children()) < 3:  # two, and Python's tracker
        assert process.poll() is None
        time.sleep(0.01)
    # A signal that comes while a worker starts may go to another thread, and wake nobody who waits
    # for a pipe: then it takes a second one.
    said = None
    while said is None:
        process.send_signal(number)
        with contextlib.suppress(subprocess.TimeoutExpired):
            said = process.communicate(timeout=2)[1]
    os.close(held)
    assert process.returncode == -number and "spawn" not in said
    assert not psutil.wait_procs(found, timeout=30)[1]
    assert number == signal.SIGKILL or sorted(os.listdir(tmp_path)) == ["in.csv", "waiting"]
