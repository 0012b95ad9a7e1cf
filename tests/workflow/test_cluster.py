"""The example that solves a folder of tables, a job each: workflow/examples/cluster."""

import gzip
import re
import shutil
import subprocess

import pytest

from tests.workflow.project import ROOT, Project

SHOTS = (ROOT / "data/scenes/shot_peening.csv").read_text().splitlines(keepends=True)
# What a shell would read otherwise, names in capitals, and what is no table.
NAMES = ["it's $HOME (x); touch a & b.csv", "D.CSV"]
NO_TABLES = ["notes.txt", "._a.csv"]


@pytest.fixture
def example(tmp_path):
    """The example with a folder of tables."""
    folder = tmp_path / "own"
    (folder / "tables").mkdir(parents=True)
    shutil.copy(ROOT / "workflow/examples/cluster/Snakefile", folder)
    return Project(folder)


def test_each_table_of_a_folder_is_a_job(example):
    """Also by any name; and the parts of a table that the command of the README has cut."""
    (example / "huge.csv").write_text("".join(SHOTS[:21]))
    (split,) = re.findall(
        r"^tail .*$", (ROOT / "workflow/examples/cluster/README.md").read_text(), flags=re.M
    )
    split = split.replace("1000000", "10")
    subprocess.run(["bash", "-c", split], cwd=example.folder, check=True)
    for name in [*NAMES, *NO_TABLES]:
        (example / "tables" / name).write_text("".join(SHOTS[:2]))
    result = example.run("--keep-going")
    assert result.returncode == 0, result.stdout
    parts = ["part_0000.csv.gz", "part_0001.csv.gz"]
    assert {path.name for path in (example / "results").iterdir()} == {*NAMES, *parts}
    assert all(len((example / "results" / name).read_text().splitlines()) == 2 for name in NAMES)
    packed = (example / "results/part_0001.csv.gz").read_bytes()
    assert len(gzip.decompress(packed).splitlines()) == 11
    assert {path.name for path in example.folder.iterdir()} == {
        "Snakefile", "huge.csv", "tables", "results", "logs", ".snakemake",
    }  # fmt: skip


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("notes.txt", "tables/: no table is there; allowed are names that end in .csv, "),
        ("{e}.csv", "tables/'{e}.csv': allowed are files whose names have no { } < >"),
        ("away.csv", "tables/'away.csv': allowed are files"),  # a link that leads nowhere
    ],
)
def test_what_is_no_folder_of_tables_is_refused(example, name, words):
    table = example / "tables" / name
    table.symlink_to("nowhere") if name == "away.csv" else table.touch()
    result = example.run()
    assert result.returncode != 0 and words in result.stdout
    assert not (example / "results").exists()
