"""One run in a copy of the project that all tests share, and the explorer in a browser."""

import json
import os
import subprocess
import time

import pytest

from stronge1994 import settings
from stronge1994.explorer import answers as explorer_answers
from stronge1994.explorer import page as write_explorer
from tests.workflow import browser, node, project
from tests.workflow.project import LEFT, PARTS, ROOT, TIMEOUT, Project, copy_of


def pytest_collection_modifyitems(items):
    """What needs a whole run of the workflow is slow."""
    for item in items:
        if "first_run" in getattr(item, "fixturenames", ()):
            item.add_marker("slow")


@pytest.fixture
def fresh(tmp_path):
    """A copy in which nothing has run."""
    return copy_of(ROOT, tmp_path)


@pytest.fixture(scope="session")
def first_run(tmp_path_factory):
    """The project after a full run, and what that run printed. Do not change it.

    Where this checkout has results, the run begins with a copy of them and makes anew only what
    they lack, and the gate. Processes of pytest-xdist share it: the first one to get here runs it.
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
        begun = copy_of(ROOT, folder, PARTS + LEFT)
        (begun / "results/gate.txt").unlink(missing_ok=True)
        found = begun.run()
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
def inventory():
    """All sources of data/. Do not change them."""
    return project.sources()


@pytest.fixture(scope="session")
def answers():
    """Rebounds of the package with which the explorer compares itself."""
    return explorer_answers.answers(write_explorer.LIMITS)


@pytest.fixture(scope="session")
def explorer(tmp_path_factory, answers):
    """The explorer page, written as a run writes it."""
    path = tmp_path_factory.mktemp("explorer") / "explorer.html"
    sources = sorted((ROOT / "workflow/explorer").iterdir())
    text = write_explorer.page(settings.of_explorer(project.config()), sources, answers)
    path.write_text(text, encoding="utf-8")
    return path


@pytest.fixture(scope="session")
def scripts():
    """The scripts of the explorer in node, which needs no browser. Do not change their state."""
    with node.scripts(node.explorer()) as found:
        yield found


@pytest.fixture(scope="module")
def tab():
    """A tab of one browser for all tests of a file; they are skipped where none is found."""
    with browser.page() as found:
        yield found


@pytest.fixture
def show(tab, explorer):
    """Open the explorer anew, paused, with this behind # in its address, and without problems."""
    tab.problems.clear()

    def opened(address="", width=1280, height=900, motion="reduce", query=""):
        tab.prefer(reduced_motion=motion)
        tab.resize(width, height, mobile=width < 500)
        tab.open("about:blank")
        tab.open(f"{explorer.as_uri()}{query}#{address}")
        return tab

    yield opened
    assert tab.problems == []
