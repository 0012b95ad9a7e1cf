"""The workflow as a user meets it: what runs, what reruns, what fails."""

import csv
import json
import os
import re
import subprocess
from collections import Counter
from pathlib import Path

import pytest

from stronge1994.plan import config as configuration

FIGURES = list(configuration.load(Path(__file__).parents[2])["figures"])


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
        words = {"curve", "event", "regime", "model", "loss", "pair", "body", "other"}
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
    """Also with files that were touched and hold what they did."""
    for folder in ("src", "data"):
        for path in (finished / folder).rglob("*.*"):
            path.touch()
    assert "Nothing to be done" in finished.run().stdout


@pytest.mark.slow
def test_lint_is_clean(fresh):
    result = fresh.run("--lint")
    assert result.returncode == 0, result.stdout


def test_dry_run_is_clean(fresh):
    result = fresh.run("--dry-run")
    assert result.returncode == 0
    assert "warning" not in result.stdout.lower()
    assert re.search(rf"^draw +{len(FIGURES)}$", result.stdout, flags=re.M)
    assert "peers" not in result.stdout, "they are for those who ask"


def test_every_rule_has_what_every_rule_needs(fresh):
    for file in (fresh / "workflow/rules").glob("*.smk"):
        for rule in re.split(r"^rule ", file.read_text(), flags=re.M)[1:]:
            for part in ("input:", "log:", "benchmark:", "message:", "modules="):
                assert part in rule, (file.name, rule.split(":")[0], part)


# Rules whose jobs read more than they import: the interface is that of modules which are only read;
# the smallest change of what measures time is not asked for.
MORE = {"interface", "sensitivity"}


def test_inputs_of_a_job_are_the_modules_that_it_imports(first_run):
    """One that is left out would leave stale results, one too many costs a run for nothing."""
    jobs = {Path(r["log"][0]).stem: r for r in first_run[0].records().values()}
    assert {path.name for path in (first_run[0] / "imported").iterdir()} == set(jobs)
    for job, record in jobs.items():
        imported = {*(first_run[0] / "imported" / job).read_text().split()}
        scripts = {path for path in record["input"] if path.startswith("workflow/scripts/")}
        given = {path for path in record["input"] if re.match(r"src/.*\.pyi?$", path)}
        assert len(scripts) == 1 and imported, job
        assert imported <= given, (job, imported - given)
        if record["rule"] not in MORE:
            assert imported == given, (job, given - imported)


EDITED = [
    "src/stronge1994/curves/fig6.py",
    "src/stronge1994/drawings/rod.py",
    "src/stronge1994/gate/closing.py",
    "data/kharaz2001/spin.csv",
    "data/scenes/superball.csv",
    "workflow/report/ledger.html",
]


def test_an_edit_reruns_what_reads_the_file_and_nothing_more(finished):
    """The records say what reads it. Data of an older date count too, as an archive leaves them."""
    passed = (finished / "results/PASSED").read_text()
    made = finished.records()
    for path in EDITED:
        text = (finished / path).read_text()
        for old, new in {"kratos,69.96": "kratos,69.97", ",0.025,": ",0.026,"}.items():
            text = text.replace(old, new)
        (finished / path).write_text(text if path.endswith(".csv") else f"{text}\n# edited\n")
        if path.startswith("data/"):
            os.utime(finished / path, (0, 0))
    direct = {out for out, record in made.items() if set(EDITED) & set(record["input"])}
    assert {made[out]["rule"] for out in direct} >= {"curves", "draw", "series", "scene"}
    follow, more = set(), direct
    while more:
        follow |= more
        more = {out for out, record in made.items() if follow & set(record["input"])} - follow
    jobs = Counter(
        made[out]["rule"] for out in {made[out]["log"][0]: out for out in follow}.values()
    )
    _, counts = finished.planned()
    assert counts == jobs | {"gate": 1, "all": 1}
    assert (finished / "results/PASSED").read_text() == passed, "a plan changes nothing"


def test_a_change_of_the_config_reruns_what_it_concerns(finished):
    """A tolerance compares again; that of a scene solves it, the study's grid the study."""
    file, old = "workflow/config.yaml", "rms: [717.0, 791.0]"
    finished.edit("workflow/comparisons.yaml", old, old.replace("7.0", "6.0"))
    finished.edit(file, "superball: {tolerance: 1.0e-4}", "superball: {tolerance: 0.1}")
    _, counts = finished.planned("--config", "study={grid: {incidence: {points: 100}}}")
    once = ["scene", "sensitivity", "verdicts", "gather_sensitivity", "report", "gate", "all"]
    once += ["gather_chunks", "draw_study"]
    assert counts == dict.fromkeys(once, 1) | {"compare": 3, "solve_chunk": 4}


def test_figures_are_drawn_without_judgement(finished):
    """With numbers and truths of the command line; what an earlier run said is not about them."""
    stale = finished / "results/benchmarks/curves_fig99.tsv"
    bytecode = finished / "src/planarimpact/__pycache__/rigid.cpython-1.pyc"
    for path in (stale, bytecode):
        path.parent.mkdir(exist_ok=True)
        path.write_text("old")
    few = "{steps: [16, 32], circles: [4, 8], fixed: {steps: 64, circles: 4}, tolerance: 0.01}"
    throw = "{throw: {bounces: 5, friction: 0.2}}"
    fig6 = "{restitution: [0, 0.6, 1], as_printed: false}"
    change = f"figures={{fig6: {fig6}, superball: {throw}, convergence: {few}}}"
    table = "results/curves/convergence.csv"
    result = finished.run("figures", table, "--config", change)
    assert result.returncode == 0, result.stdout
    assert "Drawing fig6" in result.stdout and "Drawing fig5" not in result.stdout
    assert "No verdict in this run" in result.stdout and "agrees" not in result.stdout
    assert not (finished / "results/PASSED").exists()
    assert not stale.exists() and not bytecode.exists()
    assert "as printed" not in (finished / "results/curves/fig6.csv").read_text()
    rows = (finished / table).read_text().splitlines()
    assert rows[0].startswith("curve,steps [1]") and rows[1].startswith("row of springs,16,")
    rows = (finished / "results/curves/superball.csv").read_text().splitlines()
    assert sum(row.startswith("path,") for row in rows) == 7


def test_everything_built_is_ignored_by_git(first_run):
    folder = str(first_run[0].folder)
    subprocess.run(["git", "init", "-q", folder], check=True)
    status = ["git", "-C", folder, "status", "--porcelain", "-uall"]
    found = subprocess.run(status, capture_output=True, text=True, check=True).stdout
    assert not re.search(r"^\?\? (results|figures/(?!README)|[.]snakemake)", found, flags=re.M), (
        found
    )
