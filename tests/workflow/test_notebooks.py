"""The lectures: how they are kept, how they fail, and that their asserts see a wrong solver."""

import json
import re
import shutil
import sys

import matplotlib
import matplotlib.pyplot as plt
import nbformat
import pytest

from planarimpact.lumped import stick_slip
from stronge1994.pages import lectures
from tests.workflow.project import ROOT

TEMPLATES = {
    "page": ROOT / "workflow/report/notebook.html",
    "slides": ROOT / "workflow/report/slides.html",
}
KINDS = "executed", "page", "slides", "answers"
PAGES = "", "slides_", "answers_"  # how the files of these pages begin
FOLDER = ROOT / "workflow/notebooks"
NAMES = sorted(path.stem for path in FOLDER.glob("*.ipynb"))


def code_of(book):
    return [cell for cell in book.cells if cell.cell_type == "code"]


def written(path, *sources):
    """A notebook of these cells of code, at `path`."""
    cells = [nbformat.v4.new_code_cell(source) for source in sources]
    path.write_text(nbformat.writes(nbformat.v4.new_notebook(cells=cells)), encoding="utf-8")
    return path


def executed(book):
    """Run the cells in this process."""
    matplotlib.use("Agg")
    names = {}
    with matplotlib.rc_context():
        try:
            for cell in code_of(book):
                exec(cell.source, names)
        finally:
            plt.close("all")


@pytest.mark.parametrize("name", NAMES)
def test_a_wrong_solver_trips_an_assert(name, monkeypatch):
    book = nbformat.read(FOLDER / f"{name}.ipynb", as_version=4)
    solve = stick_slip.solve

    def too_soft(impacts, *trace):
        return solve(impacts._replace(zeta2=1.05 * impacts.zeta2), *trace)

    monkeypatch.setattr(stick_slip, "solve", too_soft)
    monkeypatch.chdir(FOLDER)
    with pytest.raises(AssertionError):
        executed(book)


@pytest.mark.parametrize("name", NAMES)
def test_pages_are_built_and_need_nothing_but_the_explorer(first_run, name):
    project, _ = first_run
    pages = {kind: (project / f"figures/{kind}{name}.html").read_text() for kind in PAGES}
    for page in pages.values():
        assert not re.search(r'src="(?!explorer\.html\?stage(=micro)?#|data:)|url\(|@import', page)
        linked = {file.split("#")[0] for file in re.findall(r'href="([^#"][^"]*)"', page)}
        assert all(re.fullmatch(r"[a-z0-9_]+\.html", file) for file in linked)
    told = {kind: "Answer to exercise" in page for kind, page in pages.items()}
    assert told == {"": False, "slides_": False, "answers_": True}
    executed = nbformat.read(project / f"results/notebooks/{name}.ipynb", as_version=4)
    assert all(cell.execution_count for cell in code_of(executed))
    assert "stronge1994" not in str([cell.source for cell in code_of(executed)]), "not installed"
    log = (project / f"results/logs/lecture_{name}.log").read_text()
    assert not re.search("warning|error|traceback", log, flags=re.I), log


def test_a_notebook_of_the_site_finds_its_table(first_run, tmp_path, monkeypatch, capsys):
    """Also where the folder of the site is all there is; without a table it says what makes it."""
    shutil.copytree(FOLDER, tmp_path / "notebooks")
    monkeypatch.chdir(tmp_path / "notebooks")
    book = nbformat.read(FOLDER / "choosing_a_model.ipynb", as_version=4)
    with pytest.raises(Exception, match=r"trade\.csv is missing: snakemake"):
        executed(book)
    shutil.copytree(first_run[0] / "figures/tables", tmp_path / "tables")
    executed(book)
    assert "looked up: " in capsys.readouterr().out


@pytest.mark.parametrize(
    ("source", "words"),
    [
        (
            "# Two\nx = 2\nassert x * x == 5, 'no\\nfive'",
            r", cell 2: assert x \* x == 5, .*: no five",
        ),
        ("import os; os._exit(1)", ": .*died"),
        ("while True: pass", ": .*timed out"),
    ],
    ids=["fails", "ends", "hangs"],
)
def test_a_cell_that_fails_ends_the_kernel_or_hangs_is_named_in_one_line(
    source, words, tmp_path, monkeypatch
):
    monkeypatch.setattr(lectures, "CELL_TIMEOUT", 1)
    lost = written(tmp_path / "lost.ipynb", "x = 1", source)
    with pytest.raises(lectures.NotebookError, match=rf"^lost\.ipynb{words}") as refusal:
        lectures.run(lost, TEMPLATES, {kind: tmp_path / kind for kind in KINDS})
    assert "\n" not in str(refusal.value)
    assert list(tmp_path.iterdir()) == [lost]


def test_the_kernel_is_this_python_whatever_is_registered(tmp_path, monkeypatch):
    """And it needs no home; the sources of this checkout come first."""
    trap = tmp_path / "kernels/python3"
    trap.mkdir(parents=True)
    (trap / "kernel.json").write_text(json.dumps({"argv": ["false"], "display_name": "no"}))
    monkeypatch.setenv("JUPYTER_PATH", str(tmp_path))
    monkeypatch.setenv("HOME", "/nonexistent")
    source = "import sys, planarimpact\nprint(sys.executable, planarimpact.__file__, sep='\\n')"
    results = {kind: tmp_path / kind for kind in KINDS}
    lectures.run(written(tmp_path / "where.ipynb", source), TEMPLATES, results)
    said = nbformat.read(results["executed"], as_version=4).cells[0].outputs[0].text.splitlines()
    assert said == [sys.executable, str(ROOT / "src/planarimpact/__init__.py")]
