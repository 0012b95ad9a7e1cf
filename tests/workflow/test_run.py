"""The workflow as a user meets it: what runs, what reruns, what fails."""

import csv
import os
import re
import shutil
import signal
import subprocess
import sys
import time

import pytest

from stronge1994 import csv_tables
from stronge1994.plan import config as configuration
from stronge1994.plan import figures
from stronge1994.run import last_words, record
from stronge1994.verdict_tables.verdict_table import FAILS, QUESTIONS
from tests.workflow.project import ROOT, copy_of
from tests.workflow.test_awaited_series import JOHNSON, RUBBER, filled, made_up, written
from tests.workflow.test_troubleshooting import explained

FIGURES = list(configuration.load(ROOT)["figures"])


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
        assert (project / f"results/records/draw_{figure}.json").exists()
    named = figures.with_trait("slide")
    slides = {f"{figure}_{ground}.png" for figure in named for ground in ("light", "dark")}
    assert slides == {path.name for path in (project / "figures/slides").iterdir()}
    for table in ("trade", "which_model"):
        assert (project / f"results/{table}.csv").stat().st_size > 100
    found = verdicts(project)
    assert not set(found.values()) & set(FAILS)
    assert list(found.values()).count("awaited") == 3
    assert "PASSED" in result.stdout


def test_the_terminal_shows_a_job_a_line_and_all_figures_on_one_screen(first_run):
    said = first_run[1].stdout
    assert len(said.encode()) <= 12_000
    table = said[said.index("figure solved right") :].split("\n\n")[0].splitlines()
    assert len(table) <= 30 and max(map(len, table)) <= 80
    names = [line.split()[0] for line in table if not line.startswith(" ")][1:]
    assert names == ["fig2", "fig3", "fig4", "fig5", "fig6", "fig7", "fig8", "fig9"] + sorted(
        {*FIGURES} - {*names[:8]}
    ) + ["scenes"]
    drawn = re.findall(r"^ *\d+ of \d+  (draw_\w+)  \d+\.\d s$", said, flags=re.M)
    assert drawn[:1] == ["draw_fig3"] or len(drawn) < len(FIGURES)  # not all were drawn anew


def test_our_own_second_codes_are_never_called_agreement(first_run, inventory):
    for row in csv_tables.read_rows(first_run[0] / "results/verdicts.csv"):
        source, _, name = row["reference"].partition("/")
        series = inventory.get(source, {}).get("series", {}).get(name, {})
        assert row["question"] in QUESTIONS, row
        if series.get("kind") == "computed" and not series.get("others"):
            assert row["verdict"] != "agrees", row
        assert (row["verdict"] == "right") <= (row["question"] == "solved right"), row


def test_headers_carry_units(first_run):
    for figure in FIGURES:
        header = (first_run[0] / f"results/curves/{figure}.csv").read_text().splitlines()[0]
        words = {"curve", "event", "regime", "model", "loss", "pair", "body", "other"}
        words |= {"set", "contact", "run", "impact", "ball"}
        assert all("[" in name for name in header.split(",") if name not in words), header


def test_a_second_run_only_judges(finished):
    """Also with files that were touched and hold what they did."""
    for folder in ("src", "data"):
        for path in (finished / folder).rglob("*.*"):
            path.touch()
    finished.passes()
    assert (finished / record.JOBS).read_text() == "0\n"


@pytest.mark.slow
def test_lint_is_clean(fresh):
    result = fresh.run("--lint")
    assert result.returncode == 0, result.stdout


@pytest.mark.long
def test_dry_run_is_clean(fresh):
    result = fresh.run("--dry-run", "--quiet", "host")
    assert result.returncode == 0
    assert "warning" not in result.stdout.lower()
    slides = len(figures.with_trait("slide"))
    for rule, number in (("draw", len(FIGURES) - slides), ("draw_with_slide", slides)):
        assert re.search(rf"^{rule} +{number}$", result.stdout, flags=re.M)


def test_every_rule_has_what_every_rule_needs():
    for file in (ROOT / "workflow/rules").glob("*.smk"):
        for rule in re.split(r"^rule ", file.read_text(), flags=re.M)[1:]:
            parts = ["input:", "log:", "message:"]
            parts += ["plan=planned(", "record="] if "output:" in rule else []
            for part in parts:
                assert part in rule, (file.name, rule.split(":")[0], part)


ONE_AT_A_TIME = """
rule all:
    input: expand("{job}.txt", job=["a", "b", "c"])
rule job:
    output: "{job}.txt"
    TIMED
    shell: "mkdir beside && sleep 0.5 && rmdir beside && touch {output}"
"""


def test_one_job_at_a_time_measures_time(tmp_path):
    """The profile says so, so that a plain `snakemake --cores 3` does it too."""
    (timed,) = re.findall(
        r"resources:\n *timed=.*", (ROOT / "workflow/rules/curves.smk").read_text()
    )
    assert timed.endswith("timed=lambda wildcards: int(wildcards.figure in TIMED),")
    shutil.copytree(ROOT / "profiles", tmp_path / "profiles")
    for resources, succeeds in (("resources: timed=1", True), ("resources: timed=0", False)):
        text = ONE_AT_A_TIME.replace("TIMED", resources)
        (tmp_path / "Snakefile").write_text(text)
        command = [sys.executable, "-m", "snakemake", "--cores", "3", "--forceall"]
        result = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True)
        assert (result.returncode == 0) is succeeds, result.stderr


EDITED = {
    "src/stronge1994/figures/fig6/curves.py": "# edited\n",
    "src/stronge1994/figures/rod/drawing.py": "# edited\n",
    "src/stronge1994/run/last_words.py": "# edited\n",
    "data/kharaz2001/spin.csv": "",
    "workflow/report/ledger.html": "<!-- edited -->\n",
}


def test_an_edit_reruns_what_reads_the_file_and_nothing_more(finished):
    """The records say what reads it. Data of an older date count too, as an archive leaves them."""
    made = finished.records()
    for path, text in EDITED.items():
        old = (finished / path).read_text()
        (finished / path).write_text(old.replace("kratos,69.96", "kratos,69.97") + text)
        if not path.startswith("workflow"):  # the gate would name it, see test_proof.py
            os.utime(finished / path, (0, 0))
    edited = set(EDITED) | {"results/plans/all.json"}
    jobs, before = set(), None
    while jobs != before:
        before = set(jobs)
        jobs |= {job for job, kept in made.items() if edited & set(kept["read"])}
        edited |= {path for job in jobs for path in made[job]["wrote"]}
    assert {"curves_fig6", "draw_rod", "report", "ledger_page"} <= jobs
    _, counts = finished.planned()
    assert sum(counts.values()) == len(jobs) + 1, (counts, jobs)


def test_a_change_of_the_config_reruns_what_it_concerns(finished):
    """A tolerance compares again; that of a scene solves it, a setting of a figure the figure."""
    old = "rms: [717.0, 791.0]"
    finished.edit("src/stronge1994/figures/fig5/figure.yaml", old, old.replace("7.0", "6.0"))
    finished.edit(
        "workflow/config.yaml", "superball: {tolerance: 1.0e-4", "superball: {tolerance: 0.1"
    )
    _, counts = finished.planned("--config", "figures={fig2: {restitution: 0.4}}")
    once = [
        "scene",
        "gather",
        "report",
        "all",
        "curves",
        "draw",
        "note",
    ]
    assert counts == dict.fromkeys(once, 1) | {"judge": 3}


def test_a_crash_and_a_new_series_are_judged_and_all_the_rest_is_there(finished):
    """One story in the whole workflow: jobs fail, it is killed, and passes once mended."""
    (finished / f"data/{RUBBER}.csv").write_text(written(RUBBER, *made_up()))
    (finished / f"data/{JOHNSON}/source.yaml").write_text(filled(RUBBER, 25))
    solver = finished / "src/stronge1994/figures/fig7/curves.py"
    good = solver.read_text()
    solver.write_text(good.replace("    named = {", "    raise ArithmeticError('oh')\n    {"))
    picture = finished / "src/stronge1994/figures/fig6/drawing.py"
    drawn = picture.read_text()
    picture.write_text(drawn.replace("    paper = []", "    paper = [][1]", 1))
    said = finished.refuses_to_pass()
    found = verdicts(finished)
    wrong = {name for name, verdict in found.items() if verdict in FAILS}
    assert {name for name in found if name.startswith("fig7")} == wrong
    assert found["fig5-rubber-sphere"] == "agrees"
    assert all((finished / f"figures/{name}.png").exists() for name in FIGURES)
    page = (finished / "figures/report.html").read_text()
    assert 'class="result bad"' in page
    failed = ["curves_fig7: ArithmeticError: oh", "draw_fig6: IndexError: list index out of range"]
    assert failed[0] in page and failed[1] in page
    for name, why in zip(("fig7", "fig6"), failed, strict=True):
        assert why in (finished / f"figures/{name}.svg").read_text().replace("\n", " ")
    table = said[said.index("figure solved right") :].splitlines()
    (row,) = (line for line in table if line.startswith("fig7"))
    assert " WRONG " in row and "DIVERGES" in row
    last = next(i for i, line in enumerate(table) if line.startswith("FAILED. Reasons: "))
    faults = [line.split(" (log")[0].removeprefix("  failed: ") for line in table[last + 1 :][:2]]
    assert faults == failed
    assert table[last + 3].startswith(f"  wrong: fig7-solved: no curves: {failed[0]}")
    assert len(table) - last < 16

    solver.write_text(good)
    picture.write_text(drawn)
    log = finished / "results/logs/curves_fig7.log"
    log.unlink()
    command = [sys.executable, "-m", "snakemake", "--cores", "2"]
    running = subprocess.Popen(
        command,
        cwd=finished.folder,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        start_new_session=True,
    )
    while not log.exists():
        assert running.poll() is None
        time.sleep(0.05)
    os.killpg(running.pid, signal.SIGKILL)
    running.wait()
    assert not (finished / "results/PASSED").exists()
    locked = finished.run()
    assert "--unlock" in explained(locked) and locked.stdout.rstrip().endswith(last_words.UNLOCK)
    assert finished.run("--unlock").returncode == 0
    finished.passes()


def test_one_figure_can_be_judged_alone(finished):
    """Its target fails where a row fails; its table, which does not, says how to ask."""
    change = "--config", "stiffness_ratio=1.5"
    said = finished.run("results/verdicts/fig3.csv", *change)
    assert said.returncode == 0
    judge = "2 fail. To judge it:  snakemake --cores 2 fig3 --config stiffness_ratio=1.5"
    assert f"results/verdicts/fig3.csv: {judge}\n" in said.stdout
    for _ in range(2):
        words = finished.refuses_to_pass("fig3", *change)
        assert "fig3: FAILED. Reasons: 2\n  wrong: fig3-events: " in words
        assert re.search("^fig3-events .* wrong$", words, flags=re.M) and "fig6" not in words
    said = finished.run("fig3")
    assert said.returncode == 0 and "fig3: no comparison fails." in said.stdout
    assert not (finished / "results/PASSED").exists()


def test_a_page_that_the_report_leaves_out_fails_each_run_that_makes_it(finished):
    with open(finished / "src/stronge1994/pages/sources_page.py", "a") as file:
        file.write("\n\ndef page(*given):\n    raise ArithmeticError('oh')\n")
    for _ in range(2):
        words = finished.refuses_to_pass("figures/report.html")
        assert "failed: report: RuntimeError: sources of data: ArithmeticError: oh" in words


def test_a_curve_that_a_changed_setting_leaves_out_is_told(finished):
    words = finished.refuses_to_pass("fig3", "--config", "figures={fig3: {restitution: [1, 0.9]}}")
    assert "no curve 'e = 0.5'; the figure has e = 1, e = 0.9" in words


def test_any_folder_and_home_will_do(tmp_path):
    """The name of the folder needs quotes in a shell; HOME is a file, and cannot be written."""
    project = copy_of(ROOT, tmp_path / "OneDrive - user's folder (1)")
    (tmp_path / "home").touch()
    python = project / ".venv/bin/python"
    subprocess.run([sys.executable, "-m", "venv", "--without-pip", project / ".venv"], check=True)
    own = {"HOME": str(tmp_path / "home"), "PYTHONPATH": os.pathsep.join(filter(None, sys.path))}
    result = subprocess.run(
        [python, "-m", "snakemake", "--cores", "2", "fig3"],
        cwd=project.folder,
        env=os.environ | own,
        capture_output=True,
        text=True,
    )
    assert result.returncode == 0, result.stderr
    assert "fig3: no comparison fails." in result.stdout


def test_an_unknown_target_lists_those_that_there_are(fresh):
    fresh.refuses("No rule to produce fgi6(.|\n)*Targets are\n  all, fig2, fig3, .*fig9,", "fgi6")


def test_figures_are_drawn_without_judgement(finished):
    """With numbers and truths of the command line; what an earlier run said is not about them."""
    throw = "{throw: {bounces: 5, friction: 0.2}}"
    fig6 = "{restitution: [0, 0.6, 1], as_printed: false}"
    change = f"figures={{fig6: {fig6}, superball: {throw}}}"
    result = finished.run("figures", "--config", change)
    assert result.returncode == 0, result.stdout
    assert "  draw_fig6  " in result.stdout and "draw_fig5" not in result.stdout
    assert "No verdict in this run" in result.stdout and "agrees" not in result.stdout
    assert not (finished / "results/PASSED").exists()
    assert "as printed" not in (finished / "results/curves/fig6.csv").read_text()
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
