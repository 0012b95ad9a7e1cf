"""What the READMEs say is so."""

import re
import shlex
import textwrap
from pathlib import Path

import pytest

from planarimpact.__main__ import main
from stronge1994 import answers, reference_data, tables, words
from stronge1994.settings import figures

ROOT = Path(__file__).parents[2]
PATHS = [ROOT / "README.md", *sorted(ROOT.glob("[a-z]*/README.md"))]
PATHS += [ROOT / "data/scenes/README.md", ROOT / "src/planarimpact/README.md"]
TEXTS = {str(path.relative_to(ROOT)): path.read_text(encoding="utf-8") for path in PATHS}
MAIN = TEXTS["README.md"]
# Pages whose examples have a test of their own, or none.
PAGES = ["CONTRIBUTING.md", "workflow/notebooks/README.md"]
PAGES += [f"workflow/examples/{name}/README.md" for name in ("cluster", "pooltool")]
PAGES += [
    f"workflow/{name}.md" for name in ("add_a_figure", "models_and_codes", "your_model_your_data")
]
EXAMPLES = [
    pytest.param(block, id=f"{name}-{number}")
    for name, text in TEXTS.items()
    for number, block in enumerate(re.findall(r"```python\n(.*?)```", text, flags=re.S), 1)
    if "print(" in block  # not the files of a new figure, see test_new_figure.py
]
# What a run builds, what a reader is told to add, and what is no path.
NOT_THERE = re.compile(
    r"(?<!stronge1994/)figures/(?!README|preview)|rubber_sphere.csv$|fig10|data/sliding_line|marble"
)
# A table, between its marks.
MARKED = r"<!-- (?:figures|sources) -->\n(.*?)<!-- end -->"


@pytest.fixture
def somewhere(tmp_path, monkeypatch):
    """A folder where examples find data/ and may write."""
    (tmp_path / "data").symlink_to(ROOT / "data")
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.mark.parametrize("block", EXAMPLES)
def test_examples_run_alone_and_print_what_they_say(block, somewhere, capsys):
    exec(compile(block, "README.md", "exec"), {})
    said = re.findall(r"^print\(.*\)  # (.*)$", block, flags=re.M)
    assert said and capsys.readouterr().out.splitlines() == said


COMMANDS = [
    line
    for text in TEXTS.values()
    for block in re.findall(r"```sh\n(.*?)```", text, flags=re.S)
    for line in block.splitlines()
    if re.search(r"\bplanarimpact \w", line) and "install" not in line
]


@pytest.mark.parametrize("line", COMMANDS)
def test_commands_run_as_printed(line, somewhere, capsys):
    (somewhere / "shots.csv").symlink_to(ROOT / "data/scenes/superball.csv")
    assert not main(shlex.split(re.split(r"\bplanarimpact ", line)[1]))
    assert capsys.readouterr().out or list(somewhere.glob("spheres.*"))


def test_the_main_readme_is_short_and_answers_as_the_run_does(first_run):
    """The answers end within 40 lines of 80 columns. If they are old, they are written anew."""
    verdicts, ledger = (
        tables.read_rows(first_run[0] / f"results/{name}.csv") for name in ("verdicts", "ledger")
    )
    found = answers.of_run(verdicts, ledger)
    asked = [("question", "answer"), ("---", "---")]
    asked += [(one.question, ". ".join(one.told) + " see below" * bool(one.table)) for one in found]
    (changes,) = (one.table for one in found if one.table)
    changed = [("result", "as printed", "by the model", "entries of the ledger"), ("---",) * 4]
    changed += [(*row[:3], ", ".join(map(words.entry, row.entries))) for row in changes]
    text = MAIN
    for name, rows in (("answers", asked), ("changes", changed)):
        start, end = re.search(f"<!-- {name} -->\n(.*?)<!-- end -->", text, flags=re.S).span(1)
        text = text[:start] + "".join(f"| {' | '.join(r)} |\n" for r in rows) + text[end:]
    written_anew(ROOT / "README.md", MAIN, text)
    assert len(MAIN.encode()) <= 6_500
    first = MAIN.split("<!-- answers -->")[0] + MAIN.split("<!-- answers -->")[1].split("<!--")[0]
    assert sum(len(textwrap.wrap(line, 80)) or 1 for line in first.splitlines()) <= 40


def written_anew(path, there, text):
    """Write a list that its folders or a run have changed, for somebody to look at, and fail."""
    if there != text:
        path.write_text(text, encoding="utf-8")
    assert there == text, f"{path}: written anew, look at it and run this again"


@pytest.mark.parametrize("name", [*TEXTS, *PAGES])
def test_paths_and_links_lead_somewhere(name):
    text, folder = (ROOT / name).read_text(encoding="utf-8"), (ROOT / name).parent
    named = re.findall(r"`((?:data|workflow|src|tests|figures|profiles)/[\w./]+)`", text)
    missing = [path for path in named if not (ROOT / path).exists()]
    for link in re.findall(r"\]\((?!http)([^)]+)\)", text):
        path, _, section = link.partition("#")
        target = (folder / path).resolve() if path else ROOT / name
        if not target.exists() or (section and section not in sections(target)):
            missing.append(link)
    assert [path for path in missing if not NOT_THERE.search(path)] == []


def test_the_picture_of_the_workflow_has_all_rules():
    """But for targets that are left out of it, such as `figures`."""
    paths = [ROOT / "Snakefile", *ROOT.glob("workflow/rules/*.smk")]
    text = "".join(path.read_text(encoding="utf-8") for path in paths)
    rules = set(re.findall(r"^(?:rule|use rule \w+ as) (\w+)", text, flags=re.M))
    picture = (ROOT / "workflow/rulegraph.svg").read_text(encoding="utf-8")
    assert set(re.findall(r">(\w+)</text>", picture)) == rules - {"figures", "lite", "notebooks"}


def sections(path):
    """Anchors of the headings of a page, as GitHub makes them."""
    headings = re.findall(r"^#+ (.*)$", path.read_text(encoding="utf-8"), flags=re.M)
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings}


def with_table(folder):
    """A README, its text, and that with the table that its folder asks for."""
    pictures = [(f"`{name}`", content["shows"]) for name, content in figures.stated().items()]
    sources = [
        (f"`{path.parent.name}`", content["holds"], content["made"])
        for path in sorted(ROOT.glob("data/*/source.yaml"))
        for content in [reference_data.load_yaml(path)]
    ]
    tables = {
        "figures": [("figure", "what it shows"), ("---",) * 2, *pictures],
        "data": [("source", "what it holds", "how it was made"), ("---",) * 3, *sources],
    }
    path, rows = ROOT / folder / "README.md", tables[folder]
    there = path.read_text(encoding="utf-8")
    start, end = re.search(MARKED, there, flags=re.S).span(1)
    return (
        path,
        there,
        there[:start] + "".join(f"| {' | '.join(r)} |\n" for r in rows) + there[end:],
    )


@pytest.mark.parametrize("folder", ["figures", "data"])
def test_figures_and_sources_are_listed_as_their_folders_say(folder):
    """If not, this writes them anew."""
    written_anew(*with_table(folder))
