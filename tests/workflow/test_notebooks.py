"""The lectures: how they are kept, how they fail, and that their asserts see a wrong solver."""

import ast
import builtins
import json
import math
import re
import shutil
import sys
from pathlib import Path

import matplotlib
import matplotlib.pyplot as plt
import nbformat
import numpy as np
import pytest
from matplotlib.transforms import Bbox

from planarimpact.lumped import stick_slip
from stronge1994.explorer import page as explorer
from stronge1994.pages import lectures

ROOT = Path(__file__).parents[2]
TEMPLATES = {
    "page": ROOT / "workflow/report/notebook.html",
    "slides": ROOT / "workflow/report/slides.html",
}
KINDS = "executed", "page", "slides", "answers"
NOTEBOOKS = sorted((ROOT / "workflow/notebooks").glob("*.ipynb"))
NAMES = [path.stem for path in NOTEBOOKS]


@pytest.fixture
def book(request):
    return nbformat.read(ROOT / f"workflow/notebooks/{request.param}.ipynb", as_version=4)


every_notebook = pytest.mark.parametrize("book", NAMES, indirect=True)


def code_of(book):
    return [cell for cell in book.cells if cell.cell_type == "code"]


def written(path, *sources):
    """A notebook of these cells of code, at `path`."""
    cells = [nbformat.v4.new_code_cell(source) for source in sources]
    path.write_text(nbformat.writes(nbformat.v4.new_notebook(cells=cells)), encoding="utf-8")
    return path


def test_the_three_lectures_are_there():
    lectures = {"why_a_superball_comes_back", "where_friction_turns_round", "choosing_a_model"}
    assert lectures <= set(NAMES)


@every_notebook
def test_sources_are_valid_and_without_outputs(book):
    nbformat.validate(book)
    for cell in code_of(book):
        assert cell.outputs == [] and cell.execution_count is None
        assert cell.source.startswith("# "), "the page takes its first line as a title"
    assert "/home" not in str(book) and "http" not in str(book)
    assert "stronge1994" not in str([cell.source for cell in code_of(book)]), "not installed"


@every_notebook
def test_questions_are_seen_and_answers_fold(book):
    text = "\n".join(cell.source for cell in book.cells if cell.cell_type == "markdown")
    folded = [cell for cell in book.cells if cell.metadata.get("jp-MarkdownHeadingCollapsed")]
    answers = [cell for cell in folded if "answer" in cell.metadata.get("tags", ())]
    assert text.count("**Predict.**") == len(folded) - len(answers)
    exercises = re.findall(r"^### E(xercise \d)$", text, flags=re.M)
    assert [f"#### Answer to e{name}" for name in exercises] == [cell.source for cell in answers]
    inside = False
    for cell in book.cells:
        if cell.cell_type == "markdown" and cell.source.startswith("#"):
            inside = cell in answers
        assert inside == ("answer" in cell.metadata.get("tags", ())), cell.source
    shown = [c.source for c in code_of(book) if "jupyter" not in c.metadata]
    assert len(exercises) >= 3 and 1 <= len(shown) < len(code_of(book))
    assert "**Next:**" in text


@every_notebook
def test_links_to_the_explorer_say_their_incidence(book):
    text = " ".join(cell.source for cell in book.cells if cell.cell_type == "markdown")
    links = re.findall(
        r"\[([^\]]*)\]\(\.\./\.\./figures/explorer\.html(\?stage(?:=micro)?)?#([^)]*)\)", text
    )
    assert [stage for _, stage, _ in links if stage]
    for words, _, address in links:
        state = dict(pair.split("=") for pair in address.split("&"))
        for name in state.keys() & explorer.LIMITS.keys():
            low, high, _ = explorer.LIMITS[name]
            assert low <= float(state[name]) <= high
        said = re.search(r"\*x\* = ([\d.]+)", words)
        if said:
            x = math.tan(math.radians(float(state["angle"]))) / float(state["friction"])
            assert round(x, len(said[1].partition(".")[2])) == float(said[1]), words


@every_notebook
def test_code_on_a_slide_defines_its_names(book):
    slides = [[]]
    for cell in book.cells:
        kind = cell.metadata.get("slideshow", {}).get("slide_type")
        slides += [[]] if kind == "slide" else []
        hidden = kind in ("skip", "notes") or "jupyter" in cell.metadata
        slides[-1] += [] if hidden or cell.cell_type != "code" else [cell.source]
    for shown in slides:
        nodes = list(ast.walk(ast.parse("\n".join(shown))))
        names = [node for node in nodes if isinstance(node, ast.Name)]
        known = {node.id for node in names if isinstance(node.ctx, ast.Store)} | set(dir(builtins))
        known |= {node.asname or node.name for node in nodes if isinstance(node, ast.alias)}
        assert {node.id for node in names} <= known, shown


def words_on_lines(axes):
    """Words of a picture that a line of it crosses."""
    axes.figure.canvas.draw()
    found = []
    for words in [text for text in axes.texts if text.get_text()]:
        for line in axes.lines:
            box = words.get_window_extent()
            seen = Bbox.intersection(box, axes.bbox) if line.get_clip_on() else box
            path = line.get_transform().transform_path(line.get_path())
            if seen and path.intersects_bbox(seen, filled=False):
                found.append(words.get_text())
    return found


def curves_of_other_regimes(axes):
    """Curves against incidence that do not become straight at the last vertical line.

    Where the contact slides throughout, the velocity afterwards is a straight line.
    """
    lines = [line.get_xdata() for line in axes.lines]
    upright = [x[0] for x in lines if len(x) == 2 and x[0] == x[1]]
    if not (upright and axes.get_xlabel().startswith("incidence")):
        return []
    curves = [line.get_xydata() for line in axes.lines if len(line.get_xdata()) > 100]
    bent = [curve[1:-1, 0][np.abs(np.diff(curve[:, 1], 2)) > 1e-9] for curve in curves]
    return [x.max() for x in bent if x.size and abs(x.max() - max(upright)) > 0.05]


@every_notebook
def test_pictures_are_not_drawn_over_their_words_and_regimes(book, first_run, monkeypatch):
    monkeypatch.chdir(first_run[0] / "workflow/notebooks")
    matplotlib.use("Agg")
    names, wrong = {}, {}
    with matplotlib.rc_context():
        for cell in code_of(book):
            exec(cell.source, names)
            for axes in [axes for n in plt.get_fignums() for axes in plt.figure(n).axes]:
                found = words_on_lines(axes) + curves_of_other_regimes(axes)
                wrong[cell.id] = wrong.get(cell.id, []) + found
            plt.close("all")
    assert len(wrong) >= 5 and {cell: found for cell, found in wrong.items() if found} == {}


@every_notebook
def test_a_wrong_solver_trips_an_assert(book, monkeypatch):
    solve = stick_slip.solve

    def too_soft(impacts, *trace):
        return solve(impacts._replace(zeta2=1.05 * impacts.zeta2), *trace)

    monkeypatch.setattr(stick_slip, "solve", too_soft)
    monkeypatch.chdir(ROOT / "workflow/notebooks")
    matplotlib.use("Agg")
    names = {}
    with matplotlib.rc_context(), pytest.raises(AssertionError):
        for cell in code_of(book):
            exec(cell.source, names)
    plt.close("all")


@pytest.mark.parametrize("name", NAMES)
def test_pages_are_built_and_need_nothing_but_the_explorer(first_run, name):
    project, _ = first_run
    for kind in ("", "slides_", "answers_"):
        page = (project / f"figures/{kind}{name}.html").read_text()
        assert len(page) < 1.5e6
        assert "$" not in re.sub(r"<(pre|script).*?</\1>", "", page, flags=re.S)
        assert not re.search(r'src="(?!explorer\.html\?stage(=micro)?#|data:)|url\(|@import', page)
        linked = {file.split("#")[0] for file in re.findall(r'href="([^#"][^"]*)"', page)}
        assert all(re.fullmatch(r"[a-z0-9_]+\.html", file) for file in linked)
        if not kind:
            assert {f"slides_{name}.html", f"answers_{name}.html", "explorer.html"} <= linked
            assert "Answer to exercise" not in page and "<script" not in page
            assert page.count(f"answers_{name}.html") == 1, "only in the line for the teacher"
            pictures = re.findall(r'<img alt="([^"]*)"', page)
            assert len(pictures) >= 4 and all(len(words) > 20 for words in pictures)
    assert page.count("Answer to exercise") >= 3
    executed = nbformat.read(project / f"results/notebooks/{name}.ipynb", as_version=4)
    assert all(cell.execution_count for cell in code_of(executed))
    log = (project / f"results/logs/lecture_{name}.log").read_text()
    assert not re.search("warning|error|traceback", log, flags=re.I), log


@pytest.mark.slow
def test_a_failing_cell_fails_the_job_in_one_line_and_other_lectures_are_written(fresh):
    for name in NAMES:
        (fresh / f"workflow/notebooks/{name}.ipynb").unlink()
    failing = "# Twice two\nx = 2\nassert x * x == 5, 'no\\nfive'"
    written(fresh / "workflow/notebooks/broken.ipynb", "x = 1", failing)
    written(fresh / "workflow/notebooks/sound.ipynb", "# Sound\nprint('as it should')")
    result = fresh.run("figures/broken.html", "figures/sound.html")
    assert result.returncode != 0
    words = r"NotebookError: broken.ipynb, cell 2: assert x \* x == 5, .*: no five"
    said = rf"^failed: lecture_broken: {words} \(log: .*\)$"
    assert len(re.findall(said, result.stdout, flags=re.M)) == 1, result.stdout
    assert "Twice two" in (fresh / "results/logs/lecture_broken.log").read_text()
    assert "as it should" in (fresh / "figures/sound.html").read_text()
    for made in ("figures/broken.html", "results/notebooks/broken.ipynb"):
        assert re.search(words, (fresh / made).read_text())


def test_a_notebook_of_the_site_finds_its_table(first_run, tmp_path, monkeypatch):
    """Also where the folder of the site is all there is; without a table it says what makes it."""
    (tmp_path / "site/notebooks").mkdir(parents=True)
    for file in (ROOT / "workflow/notebooks").iterdir():
        shutil.copy(file, tmp_path / "site/notebooks")
    book = tmp_path / "site/notebooks/choosing_a_model.ipynb"
    results = {kind: tmp_path / kind for kind in KINDS}
    with pytest.raises(lectures.NotebookError, match=r"trade\.csv is missing: snakemake"):
        lectures.run(book, TEMPLATES, results)
    shutil.copytree(first_run[0] / "figures/tables", tmp_path / "site/tables")
    lectures.run(book, TEMPLATES, results)
    assert "looked up: " in results["page"].read_text()


@pytest.mark.parametrize(
    ("source", "words"),
    [("import os; os._exit(1)", "died"), ("while True: pass", "timed out")],
    ids=["ends", "hangs"],
)
def test_a_cell_that_ends_the_kernel_or_takes_too_long_is_given_up(
    source, words, tmp_path, monkeypatch
):
    monkeypatch.setattr(lectures, "CELL_TIMEOUT", 1)
    lost = written(tmp_path / "lost.ipynb", source)
    with pytest.raises(lectures.NotebookError, match=rf"^lost\.ipynb: .*{words}"):
        lectures.run(lost, TEMPLATES, {kind: tmp_path / kind for kind in KINDS})
    assert list(tmp_path.iterdir()) == [lost]


def test_the_kernel_is_this_python_whatever_is_registered(tmp_path, monkeypatch):
    """And it needs no home and no profile; the sources of this checkout come first."""
    trap = tmp_path / "kernels/python3"
    trap.mkdir(parents=True)
    (trap / "kernel.json").write_text(json.dumps({"argv": ["false"], "display_name": "no"}))
    monkeypatch.setenv("JUPYTER_PATH", str(tmp_path))
    monkeypatch.setenv("HOME", "/nonexistent")
    startup = tmp_path / "ipython/profile_default/startup"
    startup.mkdir(parents=True)
    (startup / "mine.py").write_text("profile = True")
    monkeypatch.setenv("IPYTHONDIR", str(tmp_path / "ipython"))
    source = (
        "import sys, planarimpact\n"
        "print(sys.executable, planarimpact.__file__, 'profile' in dir(), sep='\\n')"
    )
    results = {kind: tmp_path / kind for kind in KINDS}
    lectures.run(written(tmp_path / "where.ipynb", source), TEMPLATES, results)
    said = nbformat.read(results["executed"], as_version=4).cells[0].outputs[0].text.splitlines()
    assert said == [sys.executable, str(ROOT / "src/planarimpact/__init__.py"), "False"]
