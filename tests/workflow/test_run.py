"""The workflow as a user meets it: what runs, what reruns, what fails."""

import csv
import json
import re
import shlex
import subprocess

import pytest

FIGURES = [f"fig{number}" for number in range(2, 10)]
FIGURES += ["micro_slip", "convergence", "trade", "superball", "stability", "rod"]

# The figure that takes longest, of which tests of something else need not see everything.
SHORT = (
    "figures={trade: {samples: 10, tolerance: 0.001, batches: [1, 10],"
    " tolerances: [0.01], circles: [4, 5]}}"
)


def verdicts(project):
    with open(project / "results/verdicts.csv", newline="") as file:
        return {row["comparison"]: row["verdict"] for row in csv.DictReader(file)}


def test_a_good_run_passes_and_leaves_everything(first_run):
    project, result = first_run
    assert result.returncode == 0, result.stdout
    assert (project / "results/PASSED").exists()
    for figure in FIGURES:
        for path in (
            f"figures/{figure}.svg",
            f"figures/{figure}.png",
            f"results/curves/{figure}.csv",
        ):
            assert (project / path).stat().st_size > 100
        assert (project / f"results/benchmarks/draw_{figure}.tsv").exists()
    for table in ("trade", "which_model", "stability"):
        assert (project / f"results/{table}.csv").stat().st_size > 100
    found = verdicts(project)
    assert "diverges" not in found.values()
    assert list(found.values()).count("awaited") == 3
    table = result.stdout[result.stdout.index("verdict  ") :]
    assert "differs as documented  fig5-lumped-fem-initial-stick " in table
    assert "PASSED" in table


def test_headers_carry_units(first_run):
    for figure in FIGURES:
        header = (first_run[0] / f"results/curves/{figure}.csv").read_text().splitlines()[0]
        words = {"curve", "event", "regime", "model"}
        assert all("[" in name for name in header.split(",") if name not in words), header


def test_report_has_every_picture_with_its_caption(finished):
    result = finished.run("--report", "report.html")
    assert result.returncode == 0, result.stdout
    page = (finished / "report.html").read_text()
    results, categories = (
        json.JSONDecoder().raw_decode(page.split(f'<script id="{name}">\n    var {name} = ')[1])[0]
        for name in ("results", "categories")
    )
    filed = [path for parts in categories.values() for paths in parts.values() for path in paths]
    # Our own report would only say it all twice.
    pages = {f"figures/{path.name}" for path in (finished / "figures").glob("*.html")}
    pages.remove("figures/report.html")
    assert {*pages, *(f"figures/{figure}.svg" for figure in FIGURES)} <= set(results)
    assert sorted(filed) == sorted(results) and "Other" not in categories
    assert all(len(result["caption"]) > 30 for result in results.values())
    captions = (finished / "workflow/report/figures.rst").read_text()
    for figure in FIGURES:
        first = re.search(rf'"{figure}":\n  "(.{{20}})', captions)[1]
        assert first in page and f"{figure}.svg" in page
    assert "The paper verified" in page
    assert "which_model.csv" in page and "Which model for which tolerance" in page


def test_a_second_run_has_nothing_to_do(finished):
    assert finished.planned() == ({}, {})
    assert "Nothing to be done" in finished.run().stdout


def test_lint_is_clean(fresh):
    result = fresh.run("--lint")
    assert result.returncode == 0, result.stdout


def test_dry_run_is_clean(fresh):
    result = fresh.run("--dry-run")
    assert result.returncode == 0
    assert "warning" not in result.stdout.lower()
    assert fresh.planned()[1]["draw"] == len(FIGURES)


def test_every_rule_has_log_benchmark_and_message(fresh):
    for file in (fresh / "workflow/rules").glob("*.smk"):
        for rule in re.split(r"^rule ", file.read_text(), flags=re.M)[1:]:
            for part in ("input:", "log:", "benchmark:", "message:", "modules="):
                assert part in rule, (file.name, rule.split(":")[0], part)


ALL = [f"Solving {figure}" for figure in FIGURES]
LEDGER, PAGE = "Verifying the paper", "Writing the ledger's page"
REPORT = "Writing the report"
EXPLORER = "Writing the explorer"
TABLES = "Tabulating error against time"
DECADES = "Tabulating digits by decades"
SCENES = [f"Solving the scene {s}" for s in ("shot_peening", "billiard_cushion", "superball")]
SCENES += ["Solving superball"]
ALL_MODELS = ["Solving trade", *SCENES]
CHUNKS = ("0-32260", "32260-64521", "64521-96781", "96781-129042")
STUDY = [f"Solving the points {chunk} of the study" for chunk in CHUNKS]
LECTURES = [
    f"Running the notebook {name}"
    for name in ("choosing_a_model", "where_friction_turns_round", "why_a_superball_comes_back")
]
TABLES_JUDGED = ["scene_shot_peening", "scene_billiard_cushion", "scene_superball", "study"]
CHOOSING, REVERSAL, SUPERBALL = LECTURES
AS_PRINTED = [f"Solving fig{number}" for number in (5, 6, 7, 9)]


# Jobs that have an edited file among their inputs. Edits that are tried together must not follow
# from each other: the reason of a job that another one starts names that one alone.
EDITS = {
    "solvers": {
        "src/planarimpact/curves/fig6.py": ["Solving fig6"],
        "src/planarimpact/rigid.py": [
            *(f"Solving fig{number}" for number in (5, 7, 9)),
            *(*ALL_MODELS, *STUDY, LEDGER, CHOOSING, SUPERBALL),
        ],
        "src/planarimpact/bodies.py": [
            *("Solving fig8", "Solving rod", *SCENES, LEDGER, EXPLORER, SUPERBALL),
        ],
        "src/planarimpact/annuli.py": ["Solving convergence", *ALL_MODELS, *STUDY, CHOOSING],
        "src/planarimpact/response.py": [*ALL_MODELS, CHOOSING],
        "src/planarimpact/piecewise.py": [*ALL_MODELS, CHOOSING],
        "src/planarimpact/ladder.py": [*ALL_MODELS, *STUDY, CHOOSING],
        "src/planarimpact/laws.py": [*ALL_MODELS, *STUDY, LEDGER, CHOOSING],
        "src/planarimpact/timestep.py": [*ALL_MODELS, *STUDY, LEDGER, CHOOSING, REVERSAL],
    },
    "parts of solvers": {
        "workflow/scripts/one_thread.py": [*ALL, *STUDY, *LECTURES],
        "src/planarimpact/hertz.py": [
            *(f"Solving {figure}" for figure in ("fig5", "micro_slip", "convergence")),
            *(*ALL_MODELS, *STUDY, LEDGER, *LECTURES),
        ],
        "src/planarimpact/slip_onset.py": [*ALL[1:], *SCENES[:3], *STUDY, LEDGER, *LECTURES],
    },
    "the paper and data": {
        "src/planarimpact/printed/dissipation.py": [*AS_PRINTED, LEDGER],
        "src/planarimpact/ledger/slip.py": [LEDGER],
        "workflow/scripts/ledger_entries.py": [LEDGER],
        "data/stronge1994/ledger.yaml": [LEDGER],
        "data/chung_ooi2011/rebound.csv": ["Reading the series of chung_ooi2011"],
        "data/lumped_extremes/impacts.csv": [
            "Solving stability",
            "Reading the series of lumped_extremes",
        ],
    },
    "what reads curves": {
        "src/planarimpact/landmarks.py": [
            *(f"Comparing {name} with references" for name in (*FIGURES, *TABLES_JUDGED)),
            *(f"Finding what the comparisons of {figure} catch" for figure in FIGURES),
            LEDGER,
        ],
        "workflow/scripts/draw_study.py": ["Drawing the study"],
        "workflow/scripts/trade_table.py": ["Drawing trade", TABLES],
    },
    "pages": {
        "workflow/report/ledger.html": [PAGE],
        "workflow/report/figures.rst": [REPORT],
        "workflow/scripts/closing.py": [],
    },
}


@pytest.mark.parametrize("edits", EDITS.values(), ids=EDITS)
def test_an_edit_reruns_what_it_must_and_nothing_more(finished, edits):
    for path in edits:
        text = (finished / path).read_text()
        comment = "" if path.endswith(".csv") else "\n# edited\n"
        (finished / path).write_text(text.replace("0.586", "0.587") + comment)
    jobs, _ = finished.planned()
    direct = set()
    for path, expected in edits.items():
        documented = [REPORT] if path.startswith("src/") else []
        named = [job for job, why in jobs.items() if path in why and job not in documented]
        assert sorted(named) == sorted(expected), (path, jobs)
        direct |= set(named)
    follow = {"Judging", "Gathering the verdicts", PAGE, TABLES, DECADES, REPORT}
    follow |= {"Gathering what the comparisons catch"}
    follow |= {f"Comparing {name} with references" for name in TABLES_JUDGED}
    follow |= {"Gathering the study", "Drawing the study"}
    figures = {word for job in direct for word in job.split() if word in FIGURES} or {"fig5"}
    rest = set(jobs) - direct - follow
    assert all(any(figure in job.split() for figure in figures) for job in rest), jobs


def test_an_edit_of_a_drawing_redraws_and_reports(finished):
    with open(finished / "workflow/scripts/draw_fig7.py", "a") as file:
        file.write("# edited\n")
    assert finished.planned()[1] == {"draw": 1, "report": 1, "gate": 1, "all": 1}


def test_a_run_that_stops_before_the_gate_has_not_passed(finished):
    """Older tables are not printed, new ones without a verdict on the whole."""
    finished.edit("workflow/scripts/draw_fig7.py", "def draw(", "def draw_(")
    finished.edit("data/stronge1994/ledger.yaml", "\nequations:", "\n# edited\nequations:")
    result = finished.run()
    assert result.returncode != 0
    assert "ledger of the paper" in result.stdout and "No verdict in this run" in result.stdout
    assert "PASSED" not in result.stdout and "comparison " not in result.stdout
    assert "finished work is kept" in result.stdout
    assert not (finished / "results/PASSED").exists()


def test_touching_a_file_reruns_nothing(finished):
    (finished / "src/planarimpact/lumped.py").touch()
    assert finished.planned() == ({}, {})


def test_a_changed_tolerance_compares_again(finished):
    finished.edit("workflow/config.yaml", "rms: [717.0, 791.0]", "rms: [716.0, 791.0]")
    counts = {"compare": 1, "sensitivity": 1, "verdicts": 1, "gates": 1}
    counts |= {"report": 1, "gate": 1, "all": 1}
    assert finished.planned()[1] == counts


def test_wrong_physics_fails_after_everything_is_written(finished):
    """Also a second time, where nothing is left to do but judge."""
    wrong = ["--config", "stiffness_ratio=2.5", SHORT]
    first = finished.run(*wrong)
    assert first.returncode != 0
    found = verdicts(finished)
    assert found["fig5-lumped-exact"] == found["fig6-rebound"] == "diverges"
    assert not (finished / "results/PASSED").exists()
    assert all((finished / f"figures/{figure}.png").exists() for figure in FIGURES)
    table = first.stdout[first.stdout.index("verdict  ") :].splitlines()
    assert table[2].startswith("diverges")
    # The last words say which rows, and how to have the same without being judged.
    failed = next(i for i, line in enumerate(table) if line.startswith("FAILED. Reasons: "))
    assert table[failed + 1].startswith("  diverges: fig") and len(table) - failed < 16
    assert f"snakemake --cores 2 figures {shlex.join(wrong)}" in table[failed - 1]

    again = finished.run(*wrong)
    assert again.returncode != 0 and "FAILED" in again.stdout
    assert "Drawing" not in again.stdout


def test_figures_are_drawn_without_judgement(finished):
    wrong = "figures={fig6: {restitution: [0, 0.6, 1]}}"
    result = finished.run("figures", "--config", wrong)
    assert result.returncode == 0, result.stdout
    assert "Drawing fig6" in result.stdout and "Drawing fig5" not in result.stdout
    assert "No verdict in this run" in result.stdout and "agrees" not in result.stdout


@pytest.mark.parametrize(
    ("change", "comparison"),
    [
        ("figures={fig5: {restitution: 0.9}}", "fig5-lumped-exact"),
        ("figures={fig3: {restitution: [1.0, 0.4]}}", "fig3-events"),
    ],
)
def test_wrong_restitution_fails(finished, change, comparison):
    result = finished.run("--config", change)
    assert result.returncode != 0
    assert verdicts(finished)[comparison] == "diverges"


def test_a_run_passes_again_once_mended(finished):
    wrong = finished.run("--config", "figures={fig6: {restitution: [0, 0.6, 1]}}")
    assert wrong.returncode != 0
    assert verdicts(finished)["fig6-rebound"] == "diverges"
    mended = finished.run()
    assert mended.returncode == 0 and "PASSED" in mended.stdout, mended.stdout
    assert (finished / "results/PASSED").exists()


def test_a_crash_of_one_solver_is_a_failed_verdict_of_its_figure(finished):
    finished.edit(
        "src/planarimpact/curves/fig7.py", "    named = {", "    raise ArithmeticError('oh')\n    {"
    )
    result = finished.run()
    assert result.returncode != 0
    found = verdicts(finished)
    bad = {name for name, verdict in found.items() if verdict == "diverges"}
    assert bad == {name for name in found if name.startswith("fig7")}
    assert "no curves: ArithmeticError: oh" in result.stdout
    assert 'class="result bad"' in (finished / "figures/report.html").read_text()
    assert (finished / "figures/fig7.svg").exists()


def test_whole_numbers_of_the_command_line_stay_whole(finished):
    few = "{steps: [16, 32], circles: [4, 8], fixed: {steps: 64, circles: 4}, tolerance: 0.01}"
    table = "results/curves/convergence.csv"
    result = finished.run(table, "--config", f"figures={{convergence: {few}}}")
    assert result.returncode == 0, result.stdout
    rows = (finished / table).read_text().splitlines()
    assert rows[0].startswith("curve,steps [1]") and rows[1].startswith("row of springs,16,")


def test_truths_of_the_command_line_are_truths(finished):
    table = "results/curves/fig6.csv"
    for text, shown in (("false", False), ("True", True)):
        change = f"figures={{fig6: {{as_printed: {text}}}}}"
        assert finished.run(table, "--config", change).returncode == 0
        assert ("as printed" in (finished / table).read_text()) is shown


def test_everything_built_is_ignored_by_git(first_run):
    folder = str(first_run[0].folder)
    subprocess.run(["git", "init", "-q", folder], check=True)
    status = ["git", "-C", folder, "status", "--porcelain", "-uall"]
    found = subprocess.run(status, capture_output=True, text=True, check=True).stdout
    assert not re.search(r"^\?\? (results|figures/(?!README)|[.]snakemake)", found, flags=re.M), (
        found
    )
