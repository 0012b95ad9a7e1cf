"""A copy of the project in a folder, in which Snakemake can be run."""

import contextlib
import functools
import multiprocessing
import os
import re
import shutil
import subprocess
import tempfile
import time
from pathlib import Path

from stronge1994.run import record

from stronge1994 import reference_data
from stronge1994.ledger import entries
from stronge1994.settings import config as configuration
from tests.workflow import started

ROOT = Path(__file__).parents[2]
PARTS = ["Snakefile", "profiles", "workflow", "src", "data", "figures/README.md", ".gitignore"]
PARTS += ["LICENSE", "CITATION.cff"]
LEFT = ["results", "figures", ".snakemake"]  # by a run
STARTS = multiprocessing.get_context("forkserver")
STARTS.set_forkserver_preload(started.PRELOADED)
TIMEOUT = 3600  # s, against a run that hangs, not against a busy machine


@functools.cache
def sources():
    """All sources of data/. Do not change them."""
    return reference_data.load_all(ROOT / "data", schema("source"))


@functools.cache
def schema(name):
    """A schema of the workflow."""
    return reference_data.load_yaml(ROOT / f"workflow/schemas/{name}.schema.yaml")


@functools.cache
def config():
    """The config of the project, whole."""
    return configuration.load(ROOT)


@functools.cache
def ledger():
    """Entries of the ledger."""
    return entries.load(ROOT / "data/stronge1994/ledger.yaml", schema("ledger"))


def checked(change, data=None, folder=ROOT):
    """Check a change of the config as a start of Snakemake does, with other data if need be."""
    changed = configuration.with_values(configuration.overridden(config(), change))
    with contextlib.chdir(folder):
        configuration.check_config(changed, data or sources(), ledger())


class Run:
    """Snakemake at work, with its own group of processes."""

    def __init__(self, folder, arguments):
        number, words = tempfile.mkstemp(prefix="words", dir=folder.parent)
        os.close(number)
        self.words = Path(words)
        self.process = STARTS.Process(target=started.start, args=(folder, arguments, words))
        self.process.start()

    def wait_for(self, there):
        """Wait until there is what this function looks for."""
        deadline = time.monotonic() + TIMEOUT
        while not there():
            assert time.monotonic() < deadline and "Complete log" not in self.words.read_text()
            time.sleep(0.01)

    def ended(self):
        """Wait for the end. Output and errors are one text, `stdout`."""
        self.process.join()
        words = self.words.read_text(encoding="utf-8")
        return subprocess.CompletedProcess([], self.process.exitcode, words)


class Project:
    """A copy of the project in which snakemake can be run."""

    def __init__(self, folder):
        self.folder = folder

    def start(self, *arguments):
        """Start snakemake here, and do not wait for it."""
        return Run(self.folder, ["--cores", "2", *arguments])

    def run(self, *arguments):
        """Run snakemake here; output and errors come back as one text in `stdout`."""
        return self.start(*arguments).ended()

    def refuses_to_pass(self, *arguments):
        """Run, and check that nothing says PASSED; what was printed."""
        result = self.run(*arguments)
        assert result.returncode != 0, result.stdout
        assert "PASSED." not in result.stdout, result.stdout
        assert not (self / "results/PASSED").exists()
        return result.stdout

    def passes(self, *arguments):
        """Run, and check that all of it says PASSED; what was printed."""
        result = self.run(*arguments)
        assert result.returncode == 0 and "PASSED." in result.stdout, result.stdout
        assert (self / "results/PASSED").exists()
        return result.stdout

    def planned(self, *arguments):
        """How often each rule would run."""
        result = self.run(*arguments, "--dry-run", "--quiet", "host")
        assert result.returncode == 0, result.stdout
        table = result.stdout.split("Job stats:")[-1].split("total")[0]
        return {rule: int(n) for rule, n in re.findall(r"^(\w+) +(\d+)$", table, flags=re.M)}

    def records(self):
        """What each job has read and written: `{job: record}`."""
        found = (self / record.FOLDER).glob("*.json")
        return {path.stem: record.read(str(path)) for path in found}

    def __truediv__(self, path):
        return self.folder / path


def copy_of(source, folder, parts=PARTS):
    """Copy the parts of a project that a run reads, or more."""
    for part in dict.fromkeys(parts):
        origin = source / part
        if origin.is_dir():
            # The pictures of the README are in the repository, and no run makes them.
            ignore = shutil.ignore_patterns("__pycache__", "*.egg-info", "preview*.png")
            shutil.copytree(origin, folder / part, ignore=ignore, dirs_exist_ok=True)
        elif origin.exists():
            (folder / part).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(origin, folder / part)
    return Project(folder)
