"""A scene in many tables: which are solved again, what is refused, and the same through SLURM."""

import csv
import gzip
import json
import re
import subprocess
from pathlib import Path

import pytest

from planarimpact.ground.checks import InputError
from planarimpact.scene import places
from stronge1994 import csv_tables, reference_data, scene_parts
from stronge1994.plan import config as configuration
from stronge1994.plan import parts
from tests.workflow import test_slurm

ROOT = Path(__file__).parents[2]
SHOTS = ROOT / "data/scenes/shot_peening.csv"
SCHEMA = configuration.schema()
cluster = test_slurm.cluster


@pytest.fixture
def folder(tmp_path):
    """The first 90 shots in three tables, packed, cut by the command of the README."""
    found = tmp_path / "outside/parts"
    found.mkdir(parents=True)
    lines = SHOTS.read_text().splitlines(keepends=True)
    (found.parent / "huge.csv").write_text("".join(lines[:91]))
    (command,) = re.findall(r"^tail .*$", (ROOT / "workflow/README.md").read_text(), flags=re.M)
    command = command.replace("1000000", "30").replace("/data/run7", "parts")
    subprocess.run(["bash", "-c", command], cwd=found.parent, check=True)
    # One of them is not packed.
    packed = found / "part_0001.csv.gz"
    (found / "part_0001.csv").write_bytes(gzip.decompress(packed.read_bytes()))
    packed.unlink()
    return found


NAMES = ["part_0000.csv.gz", "part_0001.csv", "part_0002.csv.gz"]


def asked(folder, **settings):
    words = "".join(f", {key}: {value}" for key, value in settings.items())
    return ["scene_parts", "--config", f"scene_parts={{tables: {folder}{words}}}"]


@pytest.mark.long
def test_a_failed_table_stops_no_other(fresh, folder):
    fresh.refuses("scene_parts.tables: not there; allowed is a folder", "scene_parts")
    good = (folder / NAMES[1]).read_text()
    (folder / NAMES[1]).write_text(good.replace("\n0.0", "\n-0.0", 1))
    first = fresh.run(*asked(folder))
    assert first.returncode != 0 and "A job stopped: solve_part" in first.stdout
    assert re.search(r"part_0001.csv: row 1: radius \[m\] = -0.0.*: allowed are", first.stdout)
    results = fresh / "results/scene_parts"
    assert {path.name for path in (results / "tables").iterdir()} == {NAMES[0], NAMES[2]}
    assert not (results / "summary.csv").exists()

    (folder / NAMES[1]).write_text(good)
    second = fresh.run(*asked(folder))
    assert second.returncode == 0, second.stdout
    assert re.findall(r"Solving the table (\S+)", second.stdout) == NAMES[1:2]
    assert "\n3 tables, 90 rows, 0 of them bad and left out\n" in second.stdout
    rows = [row["rows"] for row in csv_tables.read_rows(results / "summary.csv")]
    assert rows == ["30"] * 3 + ["90"]
    assert sorted(path.name for path in (results / "tables").iterdir()) == NAMES
    assert sorted(path.name for path in results.iterdir()) == [
        "accounts", "bad_rows.csv", "summary.csv", "tables",
    ]  # fmt: skip


@pytest.mark.long
def test_the_tables_go_through_slurm(cluster, fresh, folder):
    """A job a table, with the memory that its rule asks for."""
    options = ["--slurm-init-seconds-before-status-checks", "1"]
    options += ["--set-resources", "solve_part:runtime=120"]
    code, words = cluster.snakemake(fresh, *asked(f"{folder}/*.gz"), *options)
    assert code == 0, words
    jobs = cluster.says("scontrol", "show", "jobs", "--oneliner").splitlines()
    assert len(jobs) == 2, words
    for part in (
        "JobState=COMPLETED",
        "Comment=rule_solve_part",
        "NumCPUs=1 ",
        "MinMemoryNode=2000M",
    ):
        assert all(part in job for job in jobs), (part, jobs)
    assert "\n2 tables, 60 rows, 0 of them bad and left out\n" in words


def test_bad_rows_are_counted_and_listed(tmp_path):
    """Also losses that nobody gave, and models that only one of the tables needs."""
    header, *rows = csv.reader(SHOTS.read_text().splitlines())
    table = [dict(zip(header, row, strict=True)) for row in rows[:4]]
    for row in table:
        del row["loss"]
    slides = [dict(row, friction="0.001") for row in table]
    table[2]["restitution"] = "2"
    (tmp_path / "tables").mkdir()
    names = ["sticks.csv", "slides.csv"]
    results, accounts = (
        [str(tmp_path / f"tables/{n}{end}") for n in names] for end in ("", ".json")
    )
    for name, rows, result, account in zip(names, (table, slides), results, accounts, strict=True):
        csv_tables.write_table(tmp_path / name, rows, list(rows[0]))
        scene_parts.solve(str(tmp_path / name), result, account, 1e-3, None, True)
    summary, bad = str(tmp_path / "summary.csv"), str(tmp_path / "bad_rows.csv")
    scene_parts.gather(results, accounts, summary, bad)
    found = csv_tables.read_rows(summary)
    assert list(found[0]) == [
        "table", "rows", "bad_rows", "slip throughout", "continuum.viscous, table", "loss_assumed"
    ]  # fmt: skip
    assert [list(row.values()) for row in found] == [
        ["sticks.csv", "4", "1", "0", "3", "yes"],
        ["slides.csv", "4", "0", "4", "0", "yes"],
        ["all", "8", "1", "4", "3", "yes"],
    ]
    (row,) = csv_tables.read_rows(bad)
    assert list(row.values())[:2] == ["sticks.csv", "3"] and "restitution = 2" in row["problem"]
    assert scene_parts.words(summary).startswith("2 tables, 8 rows, 1 of them bad and left out\n")
    assert sorted(path.name for path in (tmp_path / "tables").glob("*.csv")) == sorted(names)


def config(**settings):
    found = configuration.load(ROOT)
    return found | {"scene_parts": found["scene_parts"] | settings}


@pytest.mark.parametrize(
    ("settings", "words"),
    [
        ({"tolerance": 2}, "scene_parts.tolerance: 2 is greater than the maximum of 1"),
        ({"loss": "hysteretic"}, r"loss: 'hysteretic' is not one of \['viscous', 'plastic'\]"),
        ({"skip_bad": "perhaps"}, "skip_bad: 'perhaps' is not of type 'boolean'"),
        ({"tables": ""}, "scene_parts.tables: "),
        ({"table": "in"}, "'table' was unexpected"),
    ],
)
def test_settings_are_refused(settings, words):
    reference_data.refuse_invalid(config(tables="in"), SCHEMA, "config")
    with pytest.raises(reference_data.SourceError, match=words):
        reference_data.refuse_invalid(config(**settings), SCHEMA, "config")


@pytest.mark.parametrize(
    ("tables", "files", "words"),
    [
        ("in", None, "'in': there is no folder in$"),
        ("in/deep/*.csv", ["a.csv"], "there is no folder in/deep$"),
        ("in/a.csv", ["a.csv"], "there is no folder in/a.csv$"),
        (
            "in",
            [".hidden.csv"],
            r"no table; allowed are files that end in .* or .parquet$",
        ),
        ("in/b*", ["a.csv"], r"'in/b\*': no table"),
        ("in", ["a.csv", "notes.txt"], r"notes.txt is no table; .* such as in/\*.csv"),
        ("in/*.csv", ["folder.csv/a.csv"], "folder.csv is no table"),
        ("in", ["a.csv", "b.csv", "b.csv.gz"], "b.csv and b.csv.gz differ only by their endings"),
        ("in", ["$(date).csv"], r"\$\(date\).csv: allowed are letters"),
        ("in/{1}", ["{1}/a.csv"], "allowed is a folder without braces"),
        ("results/scene_parts/tables", None, "results are written there"),
    ],
)
def test_folders_are_refused(tables, files, words, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    Path("results/scene_parts/tables").mkdir(parents=True)
    for name in files or []:
        path = Path("in", name)
        path.parent.mkdir(parents=True, exist_ok=True)
        path.touch()
    with pytest.raises(configuration.ConfigError, match=f"^config: scene_parts.tables = .*{words}"):
        found = config(tables=tables)
        parts.check(found, parts.tables(found))


def test_tables_are_found_by_folder_and_by_pattern(tmp_path, monkeypatch):
    monkeypatch.setenv("HOME", str(tmp_path))
    for name in ("b.csv.gz", "a.CSV", ".hidden", "run[1]/c.csv"):
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).touch()
    assert list(parts.tables(config(tables=f"{tmp_path}/run[1]"))) == ["c.csv"]
    found = parts.tables(config(tables="~/*.*"))
    assert list(found) == ["a.CSV", "b.csv.gz"]
    parts.check(config(tables="~/*.*"), found)
    assert parts.tables(config(tables="~/b*")) == {"b.csv.gz": str(tmp_path / "b.csv.gz")}
    assert parts.tables(config()) == {}


def test_results_of_other_tables_are_refused(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    path = Path("results/scene_parts/tables/old.csv")
    path.parent.mkdir(parents=True)
    path.touch()
    parts.refuse_unusable(["old.csv", "new.csv"])
    with pytest.raises(configuration.ConfigError, match=f"^{path}: .* remove it .1 such files"):
        parts.refuse_unusable(["new.csv"])
    with pytest.raises(configuration.ConfigError, match="scene_parts.tables: not there; allowed"):
        parts.refuse_unusable([])


def test_all_endings_that_scenes_read_are_tables():
    def is_read(ending):
        try:
            return not places.source(f"a{ending}").stream
        except InputError:
            return False

    known = (".csv", ".csv.gz", ".json", ".parquet")
    assert {ending for ending in known if is_read(ending)} == set(parts.ENDINGS)
    assert json.dumps(parts.settings(config(tables="in", loss="plastic")))
