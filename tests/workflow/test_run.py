"""The workflow as a user meets it: what runs, what reruns, what a figure alone does."""

import os
import re
import subprocess
import sys

from stronge1994 import csv_tables
from stronge1994.settings import figures
from stronge1994.verdict_tables.verdict_table import FAILS, QUESTIONS
from tests.workflow.project import ROOT, config, copy_of

FIGURES = list(config()["figures"])
SLIDES = figures.with_trait("slide")


def test_a_good_run_passes_and_leaves_everything(first_run):
    project, result = first_run
    assert result.returncode == 0 and "PASSED." in result.stdout, result.stdout
    assert (project / "results/PASSED").exists()
    for figure in FIGURES:
        for path in (f"figures/{figure}.svg", f"figures/{figure}.png"):
            assert (project / path).stat().st_size > 100
        header = (project / f"results/curves/{figure}.csv").read_text().splitlines()[0]
        assert all("[" in name for name in header.split(",") if name not in WORDS), header
    slides = {f"{figure}_{ground}.png" for figure in SLIDES for ground in ("light", "dark")}
    assert slides == {path.name for path in (project / "figures/slides").iterdir()}
    for table in ("trade", "which_model"):
        assert (project / f"results/{table}.csv").stat().st_size > 100
    for scene, count in (("shot_peening", 200), ("billiard_cushion", 21), ("superball", 3)):
        assert len(csv_tables.read_rows(project / f"results/scenes/{scene}.csv")) == count
        assert f"{count} impacts" in (project / f"results/logs/scene_{scene}.log").read_text()


# Columns of words, which have no unit.
WORDS = {"curve", "event", "regime", "model", "loss", "pair", "body", "other", "set", "contact"}
WORDS |= {"run", "impact", "ball"}


def test_the_verdicts_of_a_good_run(first_run, inventory):
    """Our own second codes are never called agreement."""
    rows = csv_tables.read_rows(first_run[0] / "results/verdicts.csv")
    found = [row["verdict"] for row in rows]
    assert not set(found) & set(FAILS) and found.count("awaited") == 3
    for row in rows:
        source, _, name = row["reference"].partition("/")
        series = inventory.get(source, {}).get("series", {}).get(name, {})
        assert row["question"] in QUESTIONS, row
        if series.get("kind") == "computed" and not series.get("others"):
            assert row["verdict"] != "agrees", row
        assert (row["verdict"] == "right") <= (row["question"] == "solved right"), row


def test_the_terminal_shows_a_job_a_line_and_all_figures_on_one_screen(first_run):
    said = first_run[1].stdout
    assert len(said.encode()) <= 12_000
    table = said[said.index("figure solved right") :].split("\n\n")[0].splitlines()
    assert len(table) <= 30 and max(map(len, table)) <= 80
    names = [line.split()[0] for line in table if not line.startswith(" ")][1:]
    paper = [f"fig{number}" for number in range(2, 10)]
    assert names == [*paper, *sorted({*FIGURES} - {*paper}), "scenes"]
    drawn = re.findall(r"^ *\d+ of \d+  (draw_\w+)  \d+\.\d s$", said, flags=re.M)
    assert drawn[:1] == ["draw_fig3"] or len(drawn) < len(FIGURES)  # not all were drawn anew


EDITED = {
    "src/stronge1994/figures/fig6/curves.py": ("", "# edited\n"),
    "src/stronge1994/figures/rod/drawing.py": ("", "# edited\n"),
    "src/stronge1994/run/last_words.py": ("", "# edited\n"),
    "data/kharaz2001/spin.csv": ("kratos,69.96", "kratos,69.97"),
    "data/stronge1994/source.yaml": ("", "# edited\n"),
    "workflow/report/ledger.html": ("", "<!-- edited -->\n"),
    # A tolerance compares again, that of a scene solves it; so does a setting of a figure, below.
    "src/stronge1994/figures/fig5/figure.yaml": ("rms: [717.0,", "rms: [716.0,"),
    "workflow/config.yaml": ("superball: {tolerance: 1.0e-4", "superball: {tolerance: 0.1"),
}
# Plans that these settings change.
PLANS = ["judge_fig5", "scene_superball", "curves_fig2", "draw_fig2", "report", "note", "all"]


def test_a_change_reruns_what_it_concerns_and_nothing_more(finished):
    """The records say what reads a file. Data of an older date count too, and a touch does not."""
    made = finished.records()
    for folder in ("src", "data"):
        for path in (finished / folder).rglob("*.*"):
            path.touch()
    for path, (old, new) in EDITED.items():
        text = (finished / path).read_text()
        assert old in text, path
        (finished / path).write_text(text.replace(old, new) if old else text + new)
        if not path.startswith("workflow"):  # the gate would name it, see test_proof.py
            os.utime(finished / path, (0, 0))
    edited = set(EDITED) | {f"results/plans/{job}.json" for job in PLANS}
    jobs, before = set(), None
    while jobs != before:
        before = set(jobs)
        jobs |= {job for job, kept in made.items() if edited & set(kept["read"])}
        edited |= {path for job in jobs for path in made[job]["wrote"]}
    counts = finished.planned("--config", "figures={fig2: {restitution: 0.4}}")
    assert sum(counts.values()) == len(jobs) + 1, (counts, jobs)
    for rule, names in (("curves", ["fig2", "fig6"]), ("scene", ["superball"])):
        assert {f"{rule}_{name}" for name in names} <= jobs and counts[rule] == len(names)
    assert {"draw_rod", "judge_fig5", "ledger"} <= jobs and counts["judge"] < len(FIGURES)


def test_figures_are_drawn_without_judgement(finished):
    """With numbers and truths of the command line."""
    change = "figures={fig6: {as_printed: false}, superball: {throw: {bounces: 5}}}"
    counts = finished.planned("figures", "--config", change)
    draws = counts.pop("draw", 0) + counts.pop("draw_with_slide", 0)
    assert draws == 2 and counts == {"curves": 2, "figures": 1}


def test_a_figure_is_judged_alone_in_any_folder_with_any_home(tmp_path):
    """The name of the folder needs quotes in a shell; HOME is a file, and cannot be written."""
    project = copy_of(ROOT, tmp_path / "OneDrive - user's folder (1)")
    (project / ".venv").symlink_to(sys.prefix)
    (tmp_path / "home").touch()
    change = ["stiffness_ratio=1.5", "figures={fig3: {restitution: [1, 0.9]}}"]
    result = subprocess.run(
        [project / ".venv/bin/python", "-m", "snakemake", "--cores", "2", "fig3"]
        + ["--config", *change],
        cwd=project.folder,
        env=os.environ | {"HOME": str(tmp_path / "home")},
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    )
    said = result.stdout
    assert result.returncode != 0 and "PASSED." not in said, said
    assert not (project / "results/PASSED").exists()
    assert (project / "figures/fig3.svg").stat().st_size > 100
    # It fails where a row does, also where a curve is missing.
    assert "no curve 'e = 0.5'; the figure has e = 1, e = 0.9" in said
    assert "fig3: FAILED. Reasons: 2\n  wrong: fig3-events: " in said
    assert re.search("^fig3-events .* wrong$", said, flags=re.M) and "fig6" not in said
