"""A copy of the project in a folder, in which Snakemake can be run."""

import contextlib
import functools
import os
import shutil
import subprocess
import sys
from pathlib import Path

from stronge1994 import judging, paper, reference_data
from stronge1994.settings import config as configuration

ROOT = Path(__file__).parents[2]
PARTS = ["Snakefile", "profiles", "workflow", "src", "data", "figures/README.md", ".gitignore"]
PARTS += ["LICENSE", "CITATION.cff", "environment.txt", "pyproject.toml"]
LEFT = ["results", "figures", ".snakemake"]  # by a run
TIMEOUT = 3600  # s, against a run that hangs, not against a busy machine


@functools.cache
def sources():
    """All sources of data/. Do not change them."""
    return reference_data.load_all(ROOT / "data")


@functools.cache
def config():
    """The config of the project, whole."""
    return configuration.load([ROOT / configuration.FILE])


@functools.cache
def ledger():
    """Entries of the ledger."""
    return paper.entries(sources()["stronge1994"]["facts"])


@functools.cache
def awaited():
    """Names of the comparisons with a series of which there are no points yet."""
    every = checked({}).items()
    return [name for name, one in every if getattr(one.reference, "kind", "") == "awaited"]


def head(**other):
    """Head of a file that fills an awaited series; a key that is None is left out."""
    keys = {
        "who": "a test, with made-up points",
        "when": "2020-02-29",
        "from": "Fig. 5, p. 444 of my copy: a scan",
        "how": "your_copy.html, 6 marks",
        "sigma_x": 0.012,
        "sigma_y": 0.01,
        "sigma_origin": "two readings; marks",
        "axes": "0 to 8; -3 to 1",
        "marks": "0 0; 4 0; 8 0; 0 1; 0 -3; 8 -3",
        "mark_sigma_x": 0.01,
        "mark_sigma_y": 0.005,
    }
    said = (keys | other).items()
    return "".join(f"# {key}: {value}\n" for key, value in said if value is not None)


def checked(change, data=None, folder=ROOT):
    """Comparisons of a changed config, as a start of Snakemake checks them; with other data."""
    changed = configuration.overridden(config(), change)
    with contextlib.chdir(folder):
        return configuration.comparisons(changed, data or sources(), ledger())


def rows_of_a_run(folder, begin, project):
    """What a finished run would say with this folder of data/: rows whose names begin so."""
    every = checked({}, sources() | {folder.name: reference_data.load(folder)})
    own = [one for name, one in every.items() if name.startswith(begin)]
    figure = begin.split("-")[0]
    curves = project / f"results/curves/{figure}.csv"
    rows = judging.compare(figure, curves, own, config()["significance"], {})
    return {row["comparison"]: row for row in rows}


class Project:
    """A copy of the project in which snakemake can be run."""

    def __init__(self, folder):
        self.folder = folder

    def start(self, *arguments, python=sys.executable, **environment):
        """Start snakemake here in an activated environment, with its own group of processes."""
        environment = {"PATH": f"{Path(python).parent}:{os.environ['PATH']}"} | environment
        return subprocess.Popen(
            [python, "-m", "snakemake", "--cores", "2", *arguments],
            cwd=self.folder,
            env=os.environ | environment,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            start_new_session=True,
        )

    def run(self, *arguments, **more):
        """Run snakemake here; output and errors come back as one text in `stdout`."""
        process = self.start(*arguments, **more)
        said, _ = process.communicate(timeout=TIMEOUT)
        return subprocess.CompletedProcess([], process.returncode, said)

    def jobs(self, *arguments, **environment):
        """Jobs of a run, by the names of their logs, and those of them that have work to do."""
        table = self.run(*arguments, "--summary", **environment).stdout.partition("output_file")[2]
        rows = [line.split("\t") for line in table.splitlines()[1:] if "\t" in line]
        logs = {Path(log).stem: plan for *_, log, _, plan in rows}
        assert logs, table
        return set(logs), {job for job, plan in logs.items() if plan == "update pending"}

    def __truediv__(self, path):
        return self.folder / path


def copy_of(source, folder, parts=PARTS):
    """Copy the parts of a project that a run reads, or more."""
    for part in dict.fromkeys(parts):
        origin = source / part
        if origin.is_dir():
            # The pictures of the README are in the repository, and no run makes them. The lock of a
            # run that goes on in the origin is not one of the copy.
            ignore = shutil.ignore_patterns("__pycache__", "*.egg-info", "preview*.png", "locks")
            shutil.copytree(origin, folder / part, ignore=ignore, dirs_exist_ok=True)
        elif origin.exists():
            (folder / part).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(origin, folder / part)
    return Project(folder)
