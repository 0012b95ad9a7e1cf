"""The gate and the report of a finished run, in one process: what is cut is named, not passed."""

import html
import re
import shutil
from pathlib import Path

import pytest
from stronge1994.run import gate, record

from stronge1994 import csv_tables
from stronge1994.ledger import outcome
from stronge1994.pages import report as write_report
from stronge1994.verdict_tables import verdict_table
from tests.workflow.project import ROOT, config

# Not part of a run, but asked for.
OTHERS = {"site"}


def test_every_file_of_a_run_is_asked_for(first_run):
    """Were one not, a job that lost it would not be done again."""
    rules = "".join(path.read_text() for path in (ROOT / "workflow/rules").glob("*.smk"))
    makers = re.split(r"^rule ", rules, flags=re.M)[1:]
    names = {text.split(":")[0] for text in makers if "output:" in text}
    asked = set(re.findall(r"rules\.(\w+)", (ROOT / "Snakefile").read_text()))
    assert names - asked == OTHERS
    project, _ = first_run
    wrote = {path for record in project.records().values() for path in record["wrote"]}
    files = [
        path.relative_to(project.folder)
        for folder in ("results", "figures")
        for path in (project / folder).rglob("*")
        if path.is_file() and path.parent.name not in ("logs", "plans", "records")
    ]
    made = {str(path) for path in files if not {str(p) for p in path.parents} & wrote}
    assert made - wrote == {"results/PASSED", "figures/README.md"}


# What is cut, emptied, restored, of another figure or run; and what a job has read.
CHANGES = {
    "results/ledger.csv": lambda text: b"",
    "results/verdicts.csv": lambda text: text.splitlines(keepends=True)[0],
    "results/verdicts/fig6.csv": lambda text: text.replace(b",361,", b",362,"),
    "results/residuals/fig5.csv": lambda text: b"".join(text.splitlines(keepends=True)[:-1]),
    "results/curves/superball.csv": lambda text: text.replace(b"0.", b"7."),
    "results/problems.csv": lambda text: text + b"fig5: oh\n",
    "results/notebooks/choosing_a_model.ipynb": lambda text: text[: len(text) // 2],
    "figures/fig5.svg": lambda text: Path("figures/fig6.svg").read_bytes(),
    "figures/fig6.png": lambda data: data[: len(data) // 2],
    "figures/report.html": lambda text: text.replace(b"PASSED", b"passed"),
    "data/kharaz2001/spin.csv": lambda text: text.replace(b"69.96", b"69.97"),
    "workflow/explorer/solver.js": lambda text: text + b"// edited\n",
}


def test_what_does_not_belong_together_does_not_pass(first_run, tmp_path, monkeypatch):
    """Each is named by the gate, whatever the others are."""
    project = first_run[0]
    for folder in ("results", "figures", "data", "src", "workflow"):
        shutil.copytree(project / folder, tmp_path / folder)
    monkeypatch.chdir(tmp_path)
    records = {job: kept for job, kept in project.records().items() if job not in OTHERS}
    made = [path for kept in records.values() for path in kept["wrote"]]
    made += [record.path(job) for job in records]
    assert record.faults(made) == []
    for path, change in CHANGES.items():
        Path(path).write_bytes(change(Path(path).read_bytes()))
    Path("figures/fig7.svg").unlink()
    Path(record.path("draw_fig8")).unlink()
    found = record.faults(made)
    for path in (*CHANGES, "figures/fig7.svg", record.path("draw_fig8"), "figures/fig8.svg"):
        assert any(path in fault for fault in found), path
    with open("src/planarimpact/__init__.py", "a") as file:
        file.write("# edited while a job ran")
    found = record.faults(made)
    assert sum("made from another src/planarimpact/__init__.py" in fault for fault in found) > 50


def test_the_report_must_show_every_row_and_have_no_problems(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    for path in (*gate.TABLES, gate.PROBLEMS, gate.REPORT):
        Path(path).parent.mkdir(exist_ok=True)
    verdict = {"comparison": "a-b", "verdict": "agrees"}
    csv_tables.write_table(gate.TABLES[0], [verdict], list(verdict))
    csv_tables.write_rows(gate.TABLES[1], ["entry", "holds"], [])
    csv_tables.write_rows(gate.PROBLEMS, ["problem"], [["fig5: oh"]])
    Path(gate.REPORT).write_text("<html></html>")
    found = gate.faults([], {"a-b": False}, {})
    assert found == ["figures/report.html: it does not show a-b", "report: fig5: oh"]
    # The gate of one figure asks the records of its jobs, too.
    made = Path(record.path("draw"))
    made.parent.mkdir()
    failed = '{"seconds": 1, "read": {}, "wrote": {}, "error": "oh"}'
    for text, fault in ((failed, "failed: oh"), ("", "no record")):
        made.write_text(text)
        assert fault in gate.faults_of_one([str(made)], gate.TABLES[0], {"a-b": False})[0]


COMPARISONS = {"fig6-rebound": False, "fig6-printed": False, "fig8-measured": True}
ENTRIES = {"eq-41": True, "section-2": False}
CHANGED_CELLS = [
    ("fig6-rebound", {"verdict": "wrong"}, "wrong: fig6-rebound: "),
    ("fig6-rebound", {"verdict": "diverges"}, "diverges: fig6-rebound: "),
    ("fig6-rebound", {"verdict": "agree"}, "fig6-rebound = 'agree' cannot be"),
    ("fig6-rebound", {"verdict": "awaited"}, "fig6-rebound = 'awaited' cannot be"),
    ("fig8-measured", {"verdict": "agrees"}, "fig8-measured = 'agrees' cannot be"),
    ("fig6-rebound", {"comparison": "fig6-other"}, "0 rows of fig6-rebound where 1 belongs"),
    ("fig6-rebound", {"comparison": "fig6-printed"}, "2 rows of fig6-printed where 1 belongs"),
    ("eq-41", {"holds": "no", "problem": "oh"}, "no longer holds: eq-41: oh"),
    ("eq-41", {"holds": ""}, "eq-41, holds = '' cannot be"),
    ("eq-41", {"holds": "YES"}, "eq-41, holds = 'YES' cannot be"),
    ("eq-41", {"holds": None}, "eq-41, holds = None cannot be"),
    ("section-2", {"holds": "yes"}, "section-2, holds = 'yes' cannot be"),
    ("section-2", {"entry": "section-3"}, "0 rows of section-2 where 1 belongs"),
]


@pytest.mark.parametrize(("name", "change", "words"), CHANGED_CELLS)
def test_rows_that_cannot_be_do_not_pass(name, change, words):
    blank = dict.fromkeys(verdict_table.COLUMNS, "")
    verdicts = {
        name: blank | {"comparison": name, "verdict": "awaited" if waits else "agrees"}
        for name, waits in COMPARISONS.items()
    }
    ledger = {name: {"entry": name, "holds": "yes" * is_run} for name, is_run in ENTRIES.items()}

    def faults():
        rows = list(verdicts.values()), list(ledger.values())
        return gate.faults_of_tables(*rows, COMPARISONS, ENTRIES)

    assert faults() == []
    (verdicts if name in verdicts else ledger)[name].update(change)
    assert any(words in fault for fault in faults())


TABLES = ("verdicts", "ledger", "which_model", "key_numbers")


@pytest.fixture
def report(first_run, inventory, tmp_path, monkeypatch):
    """Write the report of a finished run from a copy of its tables; page and problems."""
    for folder in ("results", "figures"):
        shutil.copytree(first_run[0] / folder, tmp_path / folder)
    monkeypatch.chdir(tmp_path)
    # The report of the whole run has its strips drawn; here those of Fig. 5, which is damaged, do.
    strips = write_report.draw_residuals.strips
    monkeypatch.setattr(
        write_report.draw_residuals,
        "strips",
        lambda rows, *more: (
            strips(rows, *more) if any("fig5" in row["comparison"] for row in rows) else {}
        ),
    )
    without_slides = config() | {"slides": []}
    names = list(without_slides["figures"])
    verdicts, ledger = (csv_tables.read_rows(path) for path in gate.TABLES)
    settings = {
        "captions": dict.fromkeys(names, "A caption."),
        "config": without_slides,
        "sources": {"cornell1999": inventory["cornell1999"]},
        "comparisons": {row["comparison"]: row["verdict"] == "awaited" for row in verdicts},
        "entries": {row["entry"]: bool(row["holds"]) for row in ledger},
    }

    def written():
        write_report.write(
            "figures/report.html",
            "results/problems.csv",
            {name: f"results/{name}.csv" for name in TABLES},
            {name: f"results/residuals/{name}.csv" for name in names},
            {name: f"figures/{name}.svg" for name in names},
            [],
            ROOT / "workflow/report/report.html",
            settings,
        )
        problems = [row["problem"] for row in csv_tables.read_rows("results/problems.csv")]
        return Path("figures/report.html").read_text(encoding="utf-8"), problems

    return written


# Two ways to damage each table, None if it is missing, and what the report then says.
DAMAGE = [
    {
        "results/verdicts.csv": ("", "results/verdicts.csv"),
        "results/ledger.csv": ("", "results/ledger.csv"),
        "results/which_model.csv": ("a,b\n1\n", "results/which_model.csv, line 2"),
        "figures/fig6.svg": (None, "fig6.svg"),
    },
    {
        "results/verdicts.csv": (
            ",".join(verdict_table.COLUMNS) + "\nfig5,only\n",
            "verdicts.csv, line 2",
        ),
        "results/ledger.csv": (",".join(outcome.COLUMNS[1:]) + "\n", "column 'kind' is missing"),
    },
    {"results/residuals/fig5.csv": ("comparison\nfig5-lumped-fem-initial-stick\n", "Fig. 5: ")},
    {"results/residuals/fig5.csv": (None, "residuals/fig5.csv")},
]


@pytest.mark.parametrize("damage", DAMAGE)
def test_the_report_survives_damaged_tables(report, damage):
    for path, (text, _) in damage.items():
        Path(path).unlink()
        if text is not None:
            Path(path).write_text(text, encoding="utf-8")
    page, problems = report()
    assert "<title>Failed" in page and page.rstrip().endswith("</html>")
    shown = [html.unescape(line) for line in page.splitlines() if "<li>" in line]
    for _, words in damage.values():
        assert any(words in problem for problem in problems), problems
        assert any(words in line for line in shown), words


def test_a_good_run_has_no_problems_and_a_page_that_cannot_be_made_is_left_alone(
    report, monkeypatch
):
    """The error of its job names the page that is not made; Snakemake has removed the old one."""
    page, problems = report()
    assert problems == [] and "<title>Passed" in page
    monkeypatch.setattr(write_report.figure_table, "of_run", lambda _: 1 / 0)
    Path("figures/report.html").write_text("of an earlier run")
    page, problems = report()
    assert page == "of an earlier run"
    assert problems[-1].startswith("report: ZeroDivisionError")
