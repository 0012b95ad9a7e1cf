"""The example that solves a folder of tables, a job each: workflow/examples/cluster."""

import re
import shutil
import subprocess

from tests.workflow.project import ROOT, Project


def test_each_table_of_a_folder_is_a_job(tmp_path):
    """Tables are cut by the command of the README; one is not packed."""
    folder = tmp_path / "own"
    (folder / "tables").mkdir(parents=True)
    shutil.copy(ROOT / "workflow/examples/cluster/Snakefile", folder)
    shots = (ROOT / "data/scenes/shot_peening.csv").read_text().splitlines(keepends=True)
    (folder / "huge.csv").write_text("".join(shots[:21]))
    (split,) = re.findall(r"^tail .*$", (ROOT / "workflow/README.md").read_text(), flags=re.M)
    split = split.replace("1000000", "10")
    subprocess.run(["bash", "-c", split], cwd=folder, check=True)
    subprocess.run(["gunzip", folder / "tables/part_0001.csv.gz"], check=True)
    (folder / "tables/notes.txt").touch()

    result = Project(folder).run("--keep-going")
    assert result.returncode == 0, result.stdout
    names = ["part_0000.csv.gz", "part_0001.csv"]
    assert sorted(path.name for path in (folder / "results").iterdir()) == names
    assert len((folder / "results/part_0001.csv").read_text().splitlines()) == 11
