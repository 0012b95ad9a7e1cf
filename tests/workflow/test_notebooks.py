"""The lectures: how they fail, what their texts state, and the notebooks for students."""

import ast
import inspect
import itertools
import json
import os
import re
import subprocess
import symtable
import sys
import venv
from pathlib import Path

import matplotlib
import matplotlib.pyplot as plt
import nbformat
import pytest
from nbconvert.filters import strip_ansi

from planarimpact.lumped import stick_slip
from stronge1994 import versions
from stronge1994.pages import lectures, stated_numbers, structure, student
from tests.workflow.project import ROOT

TEMPLATES = {
    "page": ROOT / "workflow/report/notebook.html",
    "slides": ROOT / "workflow/report/slides.html",
}
KINDS = "page", "slides", "answers", "student", "after"
PAGES = "", "slides_", "answers_"  # how the files of these pages begin
FOLDER = ROOT / "workflow/notebooks"
NAMES = sorted(path.stem for path in FOLDER.glob("*.ipynb"))


def code_of(book):
    return [cell for cell in book.cells if cell.cell_type == "code"]


def lecture(name):
    """A lecture as it is kept."""
    return nbformat.read(FOLDER / f"{name}.ipynb", as_version=4)


def written(path, *sources, check=""):
    """A notebook of these cells of code and of a text with this check, at `path`."""
    cells = [nbformat.v4.new_code_cell(source) for source in sources]
    cells.append(nbformat.v4.new_markdown_cell("Three is 3, not four.", id="said"))
    if check:
        source = f"from stronge1994.pages.stated_numbers import says\n{check}"
        cells.append(nbformat.v4.new_code_cell(source, metadata={"tags": ["check"]}, id="check"))
    path.write_text(nbformat.writes(nbformat.v4.new_notebook(cells=cells)), encoding="utf-8")
    return path


def run(notebook, folder):
    """What is made of a notebook, by its kind."""
    results = {kind: folder / kind for kind in KINDS}
    lectures.run(notebook, TEMPLATES, results)
    return {kind: path.read_text(encoding="utf-8") for kind, path in results.items()}


def executed(book, sliders=False):
    """Run cells of code in this process, with sliders to their ends if asked."""
    matplotlib.use("Agg")
    names = {}
    with matplotlib.rc_context():
        try:
            for cell in code_of(book):
                source = re.sub(r"^%xmode .*", "", cell.source, flags=re.M)
                source = re.sub(r"^ +%pip .*", "    raise", source, flags=re.M)
                source = re.sub(r"^%%after .*", "", source)
                exec(compile(source, cell.id, "exec"), names)
                names |= {"play": at_both_ends} if sliders and "play" in names else {}
                plt.close("all")
        finally:
            plt.close("all")


def at_both_ends(show, **ranges):
    """Show what a student sees first, and with each slider at its ends, or each of its choices."""
    assert set(ranges) <= set(inspect.signature(show).parameters)
    show()
    for name, reach in ranges.items():
        for value in reach[:2] if isinstance(reach, tuple) else reach:
            show(**{name: value})
            plt.close("all")


@pytest.mark.parametrize("name", NAMES)
def test_a_wrong_solver_makes_a_stated_number_wrong(name, monkeypatch):
    solve = stick_slip.solve

    def too_soft(impacts, *trace):
        return solve(impacts._replace(zeta2=1.05 * impacts.zeta2), *trace)

    monkeypatch.setattr(stick_slip, "solve", too_soft)
    monkeypatch.chdir(FOLDER)
    with pytest.raises(AssertionError) as failure:
        executed(lecture(name))
    assert any(str(entry.path).endswith("-check") for entry in failure.traceback)


@pytest.mark.parametrize(
    ("check", "words"),
    [
        ("says('is 3, not', three + 1)", "said: the text says 'is 3, not', its cells give 4"),
        ("says('is 3, not', [three, 3])", "said: the text says 'is 3, not', its cells give 3, 3"),
        ("says('is 3')", "said: the text says 'is 3', its cells give nothing"),
        (
            "assert (three\n> 3), 'not four'",
            "said: the text says 'not four', its cells give no truth of three > 3",
        ),
        (
            "says('is 3', four)",
            r"cell 3: says\('is 3', four\): NameError: name 'four' is not defi",
        ),
        ("says('four', 4)", ".*ValueError: 'four' has no number: assert belongs here"),
        ("says('is 4', 4)", "said: the text does not say 'is 4'"),
        ("words = 'is 3'\nsays(words, 3)", "said: line 3 of its check quotes no words of the text"),
        ("assert three", "said: line 2 of its check quotes no words of the text"),
        ("three = says('is 3', 3)", "said: its check leaves three behind; let a function make it"),
        ("import sys", "said: its check leaves sys behind"),
        ("says('is 3' 3", "said: line 2 of its check: "),
    ],
)
def test_a_text_that_states_what_its_cells_do_not_give_fails_the_run(check, words, tmp_path):
    """In one line: the lecture, the cell, both numbers."""
    bad = written(tmp_path / "bad.ipynb", "three = 3", check=check)
    with pytest.raises(lectures.NotebookError, match=rf"^bad\.ipynb, {words}") as refusal:
        run(bad, tmp_path)
    assert "\n" not in str(refusal.value)


def test_a_check_stands_below_a_text():
    said = nbformat.v4.new_markdown_cell("Three is 3.", id="said")
    check = nbformat.v4.new_code_cell("", metadata={"tags": ["check"]}, id="check")
    for cells in ([check, said], [said, check, check]):
        assert stated_numbers.fault(cells).startswith("check: a check stands directly below the te")
    assert stated_numbers.fault([said, check, said]) == ""


@pytest.mark.parametrize("name", NAMES)
def test_a_throw_to_play_is_that_of_its_text(name):
    """A check quotes each address whole, so a run compares all numbers there."""
    cells = lecture(name).cells
    checks = {text.id: check.source for text, check in stated_numbers.checked(cells)}
    for cell in cells:
        if cell.cell_type == "markdown":
            found = stated_numbers.quotations(checks.get(cell.id, ""))
            compared = [words for words, node in found if isinstance(node, ast.Call)]
            for address in re.findall(r"explorer\.html\S*?(#[^)]*)", cell.source):
                assert any(address in words for words in compared), cell.id


@pytest.mark.parametrize("name", NAMES)
def test_whoever_opens_a_lecture_sees_its_checks_folded(name):
    checks = [check for _, check in stated_numbers.checked(lecture(name).cells)]
    assert len(checks) > 20
    assert all(check.metadata["jupyter"] == {"source_hidden": True} for check in checks)


@pytest.mark.parametrize("name", NAMES)
def test_pages_are_built_and_need_nothing_but_the_explorer(first_run, name):
    project, _ = first_run
    pages = {kind: (project / f"figures/{kind}{name}.html").read_text() for kind in PAGES}
    linked_by = {}
    for kind, page in pages.items():
        assert not re.search(r'src="(?!explorer\.html\?stage[&;a-z]*#|data:)|url\(|@import', page)
        linked = {re.split("[?#]", file)[0] for file in re.findall(r'href="([^#"][^"]*)"', page)}
        linked_by[kind] = linked
        assert all(
            re.fullmatch(r"[\w/]+\.(html|csv|ipynb)|planarimpact-[\w.-]+\.whl", file)
            for file in linked
        )
        assert not [file for file in linked if file.startswith("answers_")], "of the teacher"
        assert "says(" not in re.sub("<.*?>", "", page), "a check"
    told = {kind: "Answer to exercise" in page for kind, page in pages.items()}
    assert told == {"": False, "slides_": False, "answers_": True}
    for kind in ("", "slides_"):
        needed = {f"student_{name}.ipynb", f"after_{name}.ipynb", versions.WHEEL}
        assert needed <= linked_by[kind]
    log = (project / f"results/logs/lecture_{name}.log").read_text()
    assert not re.search("warning|error|traceback", log, flags=re.I), log


def test_the_plan_of_one_lesson_names_the_slides_that_are_there(first_run):
    name = "why_a_superball_comes_back"
    page = (first_run[0] / f"figures/slides_{name}.html").read_text()
    slides = dict(enumerate(page.split('<section class="slide')[1:], 1))
    text = "\n".join(cell.source for cell in lecture(name).cells)
    rows = re.findall(r"^\| \d+ to \d+ \| (.*?) \| (.*?) \|$", text, flags=re.M)
    planned = {words: [int(one) for one in re.findall(r"\d+", numbers)] for numbers, words in rows}
    begins = {"hands up": "<iframe", "the question": "The question"}
    begins |= {
        "predict": "Predict.",
        "vote": "Predict.",
        "the spring": "A spring",
        "summary": "Summary",
    }
    assert len(planned) == len(begins)
    for (words, numbers), (first, shown) in zip(planned.items(), begins.items(), strict=True):
        assert words.startswith(first) and shown in slides[numbers[0]], words
    *_, spring, last = planned.values()
    assert "<iframe" in slides[spring[-1]] and last[-1] == len(slides)


# A lecture of one question, with what a fold may hold.
QUESTION = "> **Predict.** How many\n> are three?"
ONE = [
    "# Counting",
    f"## 1. A question\n\nWords.\n\n{QUESTION}",
    "### The picture and the answer",
    "print(three := 3)\nthree;",
    "Three are 3.\n\n[Play it: *three*](../../figures/explorer.html?stage#angle=5)",
    "#### Why",
    "## 2. Next\n\n[Play it: more?](../../figures/explorer.html?stage&ask#angle=6)\n\nMore words.",
    "print('later', three)",
    "### Exercise 1",
    "Count in [the explorer](../../figures/explorer.html#angle=7).",
    "#### Answer to exercise 1",
    "### Exercise 2",
]


def counting(*folded):
    """That lecture, or one with these cells in its fold. What begins with p or r is code."""
    cells = []
    for n, source in enumerate([*ONE[:3], *folded, *ONE[6:]] if folded else ONE):
        new = nbformat.v4.new_code_cell if source[0] in "pr" else nbformat.v4.new_markdown_cell
        cells.append(new(source, id=f"c{n}"))
        if source.startswith(("### The picture", "#### Answer")):
            cells[-1].metadata["jp-MarkdownHeadingCollapsed"] = True
        if source.startswith("#### Answer"):
            cells[-1].metadata["tags"] = ["answer"]
    return nbformat.v4.new_notebook(cells=cells)


def answered(book, folder, words):
    """The notebook of a student, run in a kernel, with these words for each prediction."""
    for cell in code_of(book):
        cell.source = re.sub(
            r'^(PREDICTION_\d+ = """\n)', rf"\g<1>{words}", cell.source, flags=re.M
        )
    lectures._execute(book, str(folder / "book.ipynb"))
    return {cell.id: cell.outputs for cell in code_of(book)}


def test_a_page_folds_what_the_notebook_folds_and_has_a_box_for_each_prediction(tmp_path):
    last = tmp_path / "counting.ipynb"
    last.write_text(nbformat.writes(counting()), encoding="utf-8")
    made = run(last, tmp_path)
    for kind in ("page", "answers"):
        fold = re.search(r'<details class="fold">.*?(?=<h2)', made[kind], flags=re.S)[0]
        assert "Three are 3." in fold and "<h3>Why</h3>" in fold
        assert fold.count("<details") == fold.count("</details>") == 2
    assert "<h3>Why</h3>" in made["slides"] and "<details" not in made["slides"]
    boxes = {kind: made[kind].count("<textarea") for kind in ("page", "answers", "slides")}
    assert boxes == {"page": 1, "answers": 0, "slides": 0}
    for kind, flags in (("page", ["", "&amp;ask"]), ("slides", ["&amp;hall", "&amp;hall&amp;ask"])):
        assert re.findall(r'src="explorer\.html\?stage([^#]*)#angle=[56]"', made[kind]) == flags
    captions = re.findall(r"<p>(Play it.*?)<a href=\"([^\"]*)", made["page"])
    assert captions == [
        ("Play it: <em>three</em>. ", "explorer.html#angle=5"),
        ("Play it: more? ", "explorer.html?stage&amp;ask#angle=6"),
    ]


def test_a_fold_at_the_end_of_a_lecture_is_closed(tmp_path):
    book = counting()
    book.cells = book.cells[:4]
    (tmp_path / "last.ipynb").write_text(nbformat.writes(book), encoding="utf-8")
    page = run(tmp_path / "last.ipynb", tmp_path)["page"]
    assert page.count("<details") == page.count("</details>") == 2


def test_a_heading_of_its_own_or_a_higher_level_ends_a_fold():
    for end, fold in (("Why", 1), ("#### Why", 1), ("### Why", 0), ("## Why", 0)):
        assert structure.folds(counting("Three.", end).cells)[2:5] == [1, 1, fold], end


def test_a_slide_without_a_heading_has_that_of_its_section(tmp_path):
    book = counting()
    for place in (0, 1, 4, 6):  # the fifth cell has no heading
        book.cells[place].metadata["slideshow"] = {"slide_type": "slide"}
    (tmp_path / "slides.ipynb").write_text(nbformat.writes(book), encoding="utf-8")
    _, *slides = run(tmp_path / "slides.ipynb", tmp_path)["slides"].split('<section class="slide')
    headings = [re.search(r"<h[12][^>]*>(.*?)</h", slide)[1] for slide in slides]
    assert headings == ["Counting", "1. A question", "1. A question", "2. Next", "Now you"]


def test_what_a_fold_says_is_in_a_notebook_of_its_own():
    book = student.notebook(counting(), FOLDER, "counting")
    cells = [cell.source for cell in book.cells if cell.id not in ("begin", "install", "tools")]
    assert cells == [
        ONE[0],
        ONE[1],
        student.PREDICTION.format(fold=1),
        f"%%after 1\n{ONE[3]}",
        '%%after 1\nstage("angle=5")',
        student.SEEN.format(fold=1, name="counting"),
        "## 2. Next\n\nPlay it: more?",
        'stage("angle=6", ask=True)',
        "More words.",
        *ONE[7:9],
        "Count in the explorer (`explorer.html#angle=7`).",
        "# Exercise 1: calculate here.",
        ONE[11],
        "# Exercise 2: calculate here.",
    ]
    after = student.after(counting(), FOLDER, "counting")
    assert [cell.source for cell in after.cells[1:]] == [
        f"## Prediction 1\n\n{QUESTION}",
        "Three are 3.\n\nPlay it: *three* (in your notebook)",
        "### Why",
    ]
    for one in (book, after):
        nbformat.validate(one)
        assert len({cell.id for cell in one.cells}) == len(one.cells)


SENTENCE = "Write your prediction in PREDICTION_1 first, then run this cell again.\n"


def test_a_student_sees_nothing_before_a_prediction(tmp_path):
    """Names are defined all the same, so that later cells run."""
    (tmp_path / "explorer.html").write_text('<!DOCTYPE html><html lang="en">"A page"</html>')
    for words, shown in ((" ", SENTENCE), ('I said "three"', "3\n")):
        book = student.notebook(counting(), FOLDER, "counting")
        seen = answered(book, tmp_path, words)
        assert [one["text"] for one in seen["c3"]] == [shown]
        assert seen["c7"][0]["text"] == "later 3\n"
        frame, line = seen["c6-stage-0"]
        assert line["text"] == "angle 6. Its address: explorer.html?stage&ask#angle=6\n"
        kept = "&lt;html data-address=&quot;?stage&amp;amp;ask#angle=6&quot; lang=&quot;en&quot;"
        assert kept in frame["data"]["text/html"]
        played = [one.get("text") for one in seen["c4-stage-0"]]
        assert played == (
            [SENTENCE]
            if shown == SENTENCE
            else [None, "angle 5. Its address: explorer.html#angle=5\n"]
        )


def test_a_stage_without_the_explorer_says_what_is_missing(tmp_path):
    seen = answered(student.notebook(counting(), FOLDER, "counting"), tmp_path, "")
    said = "angle 6. To play it, put the file explorer.html beside this notebook.\n"
    assert [one["text"] for one in seen["c6-stage-0"]] == [said]


@pytest.mark.parametrize("words", ["", "Three."])
def test_a_cell_that_fails_says_so_once_whatever_was_predicted(tmp_path, words):
    source = "print('begins')\nraise ValueError('no number')"
    book = student.notebook(counting(source), FOLDER, "counting")
    with pytest.raises(lectures.NotebookError, match="ValueError: no number"):
        answered(book, tmp_path, words)
    printed, error = next(cell.outputs for cell in book.cells if cell.id == "c3")
    assert printed["text"] == "begins\n" and error["evalue"] == "no number"


@pytest.mark.parametrize(
    ("name", "words"),
    # One lecture shows it daily, without predictions and with them.
    [
        pytest.param(name, words, marks=pytest.mark.long if n else ())
        for n, name in enumerate(sorted(NAMES, reverse=True))
        for words in ("", "It comes back.")
    ],
)
def test_the_notebook_of_a_student_runs_to_its_end(name, words, first_run, tmp_path):
    """Before its predictions it shows no picture of an answer, and after them all."""
    book = of_student(name, first_run)
    seen = answered(book, tmp_path, words)
    waiting = [cell for cell in code_of(book) if cell.source.startswith("%%after")]
    count = len([one for one in seen if one.startswith("prediction-")])
    assert count == max(structure.folds(lecture(name).cells)) >= 4 and len(waiting) > count
    if words:
        shown = {
            cell.source.split()[1]
            for cell in waiting
            if any("image/svg+xml" in one.get("data", {}) for one in cell.outputs)
        }
        assert len(shown) == count
        assert not any("Text(" in str(cell.outputs) for cell in waiting), "a semicolon hides it"
    else:
        for cell in waiting:
            sentence = SENTENCE.replace("_1", f"_{cell.source.split()[1]}")
            assert [one["text"] for one in cell.outputs] == [sentence]
    folds = zip(structure.folds(lecture(name).cells), lecture(name).cells, strict=True)
    said = [cell.source for fold, cell in folds if fold and cell.cell_type == "markdown"]
    assert not {cell.source for cell in book.cells} & set(said)


@pytest.mark.parametrize("name", NAMES)
def test_cells_need_the_package_alone_and_check_nothing(name):
    cells = code_of(lecture(name))
    source = "\n".join(cell.source for cell in cells if not stated_numbers.is_check(cell))
    assert not re.search(r"stronge1994|^ *assert ", source, flags=re.M)
    assert not [cell.id for cell in cells if cell.outputs or cell.execution_count]


def of_student(name, first_run):
    """The notebook that a run has made of a lecture for students."""
    return nbformat.read(first_run[0] / f"figures/student_{name}.ipynb", as_version=4)


# What a student may change first, in every cell that has it.
EDITS = {
    "friction": (r"\b((?i:friction|mu) ?= ?)\d[\d.e-]*", r"\g<1>0.5"),
    "restitution": (r"\b((?i:restitution|e) ?= ?)\d[\d.e-]*", r"\g<1>0.6"),
    "material": (r"\b((?i:poisson_ratio) ?= ?)\d[\d.e-]*", r"\g<1>0.4"),
    "steel": (r"\b((?i:poisson_ratio) ?= ?)\d[\d.e-]*", r"\g<1>0.3"),
    "size": (r"\b((?:radius|diameter) ?= ?)\d[\d.e-]*", r"\g<1>0.04"),
    "body": (r"\b((?:mass_ratio|BETA) ?= ?)\d[\d.e-]*", r"\g<1>2.5"),
    "constants": (r"(?m)^([A-Z_]+ = )(\d+\.\d+)\b", lambda one: f"{one[1]}{0.8 * float(one[2])}"),
    "slow": (r"\b((?i:tangential|speed|along|down) ?= ?)\d[\d.e-]*", r"\g<1>1.5"),
}


# Daily most of them at once, which changes what each changes; each alone belongs to a long run.
AT_ONCE = "friction", "restitution", "steel", "size", "slow"
LONG = [pytest.param([edit], id=edit, marks=pytest.mark.long) for edit in EDITS]


@pytest.mark.parametrize("edits", [[], AT_ONCE, *LONG])
@pytest.mark.parametrize("name", NAMES)
def test_a_student_may_edit_numbers_and_needs_no_file(
    name, edits, first_run, tmp_path, monkeypatch
):
    monkeypatch.chdir(tmp_path)
    book = of_student(name, first_run)
    for cell, edit in itertools.product(code_of(book), edits):
        cell.source = re.sub(*EDITS[edit], cell.source)
    executed(book, sliders=not edits)


@pytest.mark.parametrize("name", NAMES)
def test_the_notebook_for_students_has_no_answers_and_all_that_it_needs(name, first_run):
    book = of_student(name, first_run)
    nbformat.validate(book)
    assert len(nbformat.writes(book)) < 150_000 and book.metadata.kernelspec.name == "python3"
    assert [cell.id for cell in code_of(book)[:2]] == ["install", "tools"]
    text = "\n".join(cell.source for cell in book.cells if cell.id != "tools")
    assert not re.search(
        r"says\(|stated_numbers|Answer to exercise|\.\./|\?stage|\(explorer\.html#|mplstyle", text
    )
    kept = {cell.id: cell for cell in lecture(name).cells}
    assert len(kept) == len(lecture(name).cells)
    tags = {tag for cell in book.cells for tag in kept.get(cell.id, cell).metadata.get("tags", [])}
    games = [
        cell.source for cell in code_of(book) if re.search(r"^play\(", cell.source, flags=re.M)
    ]
    assert tags == {"student"} and len(games) >= 2
    for kind in PAGES:
        page = (first_run[0] / f"figures/{kind}{name}.html").read_text()
        assert not re.search(r"^play\(", re.sub("<.*?>", "", page), flags=re.M)


@pytest.mark.parametrize(
    ("name", "place", "derived"),
    [
        ("why_a_superball_comes_back", "numbers", {"BETA", "THROWN", "bounce", "throw"}),
        ("why_a_superball_comes_back", "readings", {"EXAMPLE", "readings", "FILMED"}),
        ("where_friction_turns_round", "numbers", {"ZETA2", "PACE"}),
        ("choosing_a_model", "numbers", {"GROUPS", "yardstick"}),
    ],
)
def test_a_number_that_is_changed_reaches_what_follows_from_it(name, place, derived, first_run):
    """Who runs only the cell that he changed has no old numbers in those below."""
    (cell,) = [cell for cell in code_of(of_student(name, first_run)) if cell.id == place]
    assert "source_hidden" not in str(cell.metadata)
    table = symtable.symtable(cell.source, place, "exec")
    assert all(table.lookup(one).is_assigned() for one in derived)


def test_a_student_gets_pictures_and_installs_what_a_cell_imports(tmp_path):
    (tmp_path / "notebooks").mkdir()
    (tmp_path / "drawing.svg").write_text("<svg/>")
    assert student.text("![A ball](../drawing.svg)", tmp_path / "notebooks") == (
        '<img alt="A ball" src="data:image/svg+xml;base64,PHN2Zy8+">'
    )
    said = student.install("import pandas as pd\nfrom planarimpact import lumped")
    assert "import numpy, pandas, scipy\n" in said
    assert f"%pip install -q ./{versions.WHEEL} numpy pandas scipy\n" in said


@pytest.fixture
def empty_python(tmp_path):
    """A Python with all that ours has but planarimpact, and its folder of packages."""
    venv.create(tmp_path / "venv", symlinks=True)
    python = tmp_path / "venv" / Path(sys.executable).relative_to(sys.prefix)
    (packages,) = (tmp_path / "venv").glob("lib/python*/site-packages")
    for path in Path(nbformat.__file__).parents[1].iterdir():
        if not re.match(r"planarimpact|__editable__", path.name) and path.suffix != ".pth":
            (packages / path.name).symlink_to(path)
    return python, packages


@pytest.mark.parametrize("case", ["beside a clone", "older, elsewhere", "no wheel"])
def test_the_first_cell_installs_the_wheel_beside_it_and_asks_no_index(
    case, empty_python, first_run, tmp_path
):
    (python, packages), folder = empty_python, tmp_path / "My lectures"
    folder.mkdir()
    cell = student.install("import numpy")
    if case == "beside a clone":
        (folder / "planarimpact/src/planarimpact").mkdir(parents=True)
        cell = f"import planarimpact\n{cell}"
    if case == "older, elsewhere":  # as in VS Code
        (packages / "planarimpact").mkdir()
        (packages / "planarimpact/__init__.py").write_text('__version__ = "0.3.0"')
        cell = f"__vsc_ipynb_file__ = {str(folder / 'a.ipynb')!r}\n{cell}"
    if case != "no wheel":
        (folder / versions.WHEEL).symlink_to(first_run[0] / f"figures/{versions.WHEEL}")
    ending = "import planarimpact\nprint(planarimpact.__file__, planarimpact.lumped.rebound(8.0))"
    (tmp_path / "cell.ipy").write_text(f"{cell}\n{ending}", encoding="utf-8")
    result = subprocess.run(
        [python, "-m", "IPython", "--no-banner", tmp_path / "cell.ipy"],
        cwd=tmp_path if "elsewhere" in case else folder,
        env={"PATH": os.environ["PATH"], "IPYTHONDIR": str(tmp_path), "PIP_NO_INDEX": "1"},
        capture_output=True,
        text=True,
    )
    said = strip_ansi(result.stdout)
    if case == "no wheel":
        error = (
            rf"\nFileNotFoundError: Put {versions.WHEEL} .* {folder} .* run this cell again\.\s*$"
        )
        assert re.search(error, said), said
    else:
        assert f"{packages}/planarimpact/__init__.py Rebound(" in said, said


def test_a_file_that_a_student_lacks_is_refused(tmp_path):
    book = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell("open('../a.txt')", id="a")])
    with pytest.raises(ValueError, match=r"^a: a student has no such file: \"open\('\.\./a"):
        student.notebook(book, tmp_path, "lost")


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
        run(lost, tmp_path)
    assert "\n" not in str(refusal.value)
    assert {path.stem for path in tmp_path.iterdir()} == {"lost"}


def test_the_kernel_is_this_python_whatever_is_registered(tmp_path, monkeypatch):
    """And it needs no home; the sources of this checkout come first."""
    trap = tmp_path / "kernels/python3"
    trap.mkdir(parents=True)
    (trap / "kernel.json").write_text(json.dumps({"argv": ["false"], "display_name": "no"}))
    monkeypatch.setenv("JUPYTER_PATH", str(tmp_path))
    monkeypatch.setenv("HOME", "/nonexistent")
    source = "import sys, planarimpact\nprint(sys.executable, planarimpact.__file__, sep='\\n')"
    page = run(written(tmp_path / "where.ipynb", source), tmp_path)["page"]
    assert f"{sys.executable}\n{ROOT / 'src/planarimpact/__init__.py'}\n" in page
