"""The example that solves a folder of tables, a job each: workflow/examples/cluster."""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from tests.workflow.project import ROOT


def run(folder, *arguments):
    """Run Snakemake there, with the programs of this Python, and return what it prints."""
    programs = {"PATH": f"{Path(sys.executable).parent}:{os.environ['PATH']}"}
    result = subprocess.run(
        [sys.executable, "-m", "snakemake", "--cores", "1", *arguments],
        cwd=folder,
        env=os.environ | programs,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    )
    assert result.returncode == 0, result.stdout
    return result.stdout


@pytest.mark.slow
def test_each_table_of_a_folder_is_a_job(tmp_path):
    """Tables are cut by the command of the README; one is not packed."""
    shutil.copy(ROOT / "workflow/examples/cluster/Snakefile", tmp_path)
    shots = (ROOT / "data/scenes/shot_peening.csv").read_text().splitlines(keepends=True)
    (tmp_path / "huge.csv").write_text("".join(shots[:21]))
    (tmp_path / "tables").mkdir()
    (split,) = re.findall(r"^tail .*$", (ROOT / "workflow/README.md").read_text(), flags=re.M)
    split = split.replace("1000000", "10")
    subprocess.run(["bash", "-c", split], cwd=tmp_path, check=True)
    subprocess.run(["gunzip", tmp_path / "tables/part_0001.csv.gz"], check=True)
    (tmp_path / "tables/notes.txt").touch()

    planned = run(tmp_path, "--dry-run")
    assert re.search(r"^scene +2$", planned, flags=re.M), planned
    run(tmp_path)
    names = ["part_0000.csv.gz", "part_0001.csv"]
    assert sorted(path.name for path in (tmp_path / "results").iterdir()) == names
    assert len((tmp_path / "results/part_0001.csv").read_text().splitlines()) == 11
