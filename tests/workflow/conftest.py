"""A copy of the project in a temporary folder, and one run of it that all tests share."""

import json
import os
import re
import shutil
import subprocess
import sys
import time
from pathlib import Path

import browser
import pytest

from stronge1994 import explorer_answers as explorer_curves
from stronge1994 import plan
from stronge1994.pages import explorer as write_explorer
from stronge1994.plan import config as configuration
from stronge1994.run import record

ROOT = Path(__file__).parents[2]
PARTS = ["Snakefile", "profiles", "workflow", "src", "data", "figures/README.md", ".gitignore"]
LEFT = ["results", "figures", ".snakemake"]  # by a run


collect_ignore = ["toy"]  # a workflow for test_proof.py
TIMEOUT = 3600  # s, of one run: against one that hangs, not against a busy machine


class Project:
    """A copy of the project in which snakemake can be run."""

    def __init__(self, folder):
        self.folder = folder

    def run(self, *arguments):
        """Run snakemake here; output and errors come back as one text in `stdout`."""
        return subprocess.run(
            [sys.executable, "-m", "snakemake", "--cores", "2", *arguments],
            cwd=self.folder,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            timeout=TIMEOUT,
        )

    def refuses_to_pass(self, *arguments):
        """Run, and check that nothing says PASSED; what was printed."""
        result = self.run(*arguments)
        assert result.returncode != 0, result.stdout
        assert "PASSED." not in result.stdout
        assert not (self / "results/PASSED").exists()
        return result.stdout

    def passes(self, *arguments):
        """Run, and check that all of it says PASSED; what was printed."""
        result = self.run(*arguments)
        assert result.returncode == 0 and "PASSED." in result.stdout, result.stdout
        assert (self / "results/PASSED").exists()
        return result.stdout

    def planned(self, *arguments):
        """Jobs that a run would do: `{message: reason}`, and how often each rule runs."""
        result = self.run("--dry-run", *arguments)
        assert result.returncode == 0, result.stdout
        words = result.stdout
        jobs = dict(re.findall(r"^Job \d+: (.*)\nReason: (.*)$", words, flags=re.M))
        table = words.split("Job stats:")[-1].split("total")[0]
        return jobs, {rule: int(n) for rule, n in re.findall(r"^(\w+) +(\d+)$", table, flags=re.M)}

    def edit(self, path, old, new):
        """Replace a text that must be there."""
        file = self.folder / path
        text = file.read_text()
        assert old in text, (path, old)
        file.write_text(text.replace(old, new))

    def records(self):
        """What each job has read and written: `{job: record}`."""
        found = (self / record.FOLDER).glob("*.json")
        return {path.stem: record.read(str(path)) for path in found}

    def refuses(self, words, *arguments):
        """Check that a run is refused before any work, with these words (a pattern)."""
        result = self.run(*arguments)
        assert result.returncode != 0
        assert re.search(words, result.stdout), result.stdout
        assert "Traceback" not in result.stdout
        assert not (self / "results/logs").exists()

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


def pytest_collection_modifyitems(items):
    """What needs a whole run of the workflow is slow."""
    for item in items:
        if {"first_run", "cluster"} & set(getattr(item, "fixturenames", ())):
            item.add_marker("slow")


@pytest.fixture
def fresh(tmp_path):
    """A copy in which nothing has run."""
    return copy_of(ROOT, tmp_path)


@pytest.fixture(scope="session")
def first_run(tmp_path_factory):
    """The project after a full run, and what that run printed. Do not change it.

    Where this checkout has results, the run begins with a copy of them and makes anew only what
    they lack. Processes of pytest-xdist share it: the first one to get here runs it.
    """
    base = tmp_path_factory.getbasetemp()
    base = base.parent if "PYTEST_XDIST_WORKER" in os.environ else base
    folder, words = base / "finished", base / "finished.json"
    try:
        folder.mkdir()
    except FileExistsError:
        deadline = time.monotonic() + TIMEOUT
        while not words.exists() and time.monotonic() < deadline:
            time.sleep(0.2)
    else:
        found = copy_of(ROOT, folder, PARTS + LEFT).run()
        partial = base / "finished.partial"
        partial.write_text(json.dumps([found.returncode, found.stdout]))
        partial.replace(words)
    code, text = json.loads(words.read_text())
    return Project(folder), subprocess.CompletedProcess([], code, text)


@pytest.fixture
def finished(first_run, tmp_path):
    """A copy of the project after a full run, free to change."""
    return copy_of(first_run[0].folder, tmp_path, PARTS + LEFT)


@pytest.fixture(scope="session")
def explorer(tmp_path_factory):
    """The explorer page, written as a run writes it."""
    path = tmp_path_factory.mktemp("explorer") / "explorer.html"
    config = configuration.load(ROOT)
    sources = sorted((ROOT / "workflow/explorer").iterdir())
    answers = explorer_curves.answers(write_explorer.LIMITS)
    text = write_explorer.page(plan.settings_of_explorer(config), sources, answers)
    path.write_text(text, encoding="utf-8")
    return path


@pytest.fixture(scope="session")
def tab():
    """A tab of one browser for all tests of the explorer; they are skipped where none is found."""
    with browser.page() as found:
        yield found


@pytest.fixture
def show(tab, explorer):
    """Open the explorer anew, paused, with this behind # in its address, and without problems."""
    tab.problems.clear()

    def opened(address="", width=1280, height=900, motion="reduce"):
        tab.prefer(prefers_reduced_motion=motion)
        tab.resize(width, height, mobile=width < 500)
        tab.open("about:blank")
        tab.open(f"{explorer.as_uri()}#{address}")
        return tab

    yield opened
    assert tab.problems == []
