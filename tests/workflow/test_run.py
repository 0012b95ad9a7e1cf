"""The workflow as a user meets it: what a run leaves, what runs again, and what stops it.

Most is asked of Snakemake's `--summary`, which runs nothing: it says which files a run would make.
"""

import os
import re
import signal
import time
import zipfile

import pytest
import yaml

from stronge1994 import tables, versions
from stronge1994.settings import figures
from stronge1994.verdict_table import Group
from tests.workflow.project import LEFT, PARTS, ROOT, TIMEOUT, awaited, config, copy_of
from tests.workflow.test_refusals import explained

FIGURES = list(config()["figures"])
SLIDES = figures.with_trait("slide")
FOLDER = "src/stronge1994/figures"
# Columns of words, which have no unit.
WORDS = {"event", "regime", "loss", "pair", "spread", "body", "other", "set", "contact"}
WORDS |= {"run", "impact", "ball", "curve", "model", "variant", "shifted"}
# Parameters in which curves differ.
PARAMETERS = {"e", "mu", "nu", "x", "zeta2", "velocity_ratio", "sigmas"}
PARAMETERS |= {"steps", "knots", "tolerance"}


def test_a_good_run_passes_and_leaves_everything(first_run):
    project, result = first_run
    assert result.returncode == 0 and "PASSED: " in result.stdout, result.stdout
    for figure in FIGURES:
        for path in (f"figures/{figure}.svg", f"figures/{figure}.png"):
            assert (project / path).stat().st_size > 100
        header = (project / f"results/curves/{figure}.csv").read_text().splitlines()[0]
        assert all("[" in name for name in header.split(",") if name not in WORDS | PARAMETERS), (
            header
        )
    manifest = yaml.safe_load((ROOT / "codecheck.yml").read_text(encoding="utf-8"))["manifest"]
    assert all((project / entry["file"]).is_file() and entry["comment"] for entry in manifest)
    slides = {f"{figure}_{ground}.png" for figure in SLIDES for ground in ("light", "dark")}
    assert slides == {path.name for path in (project / "figures/slides").iterdir()}
    for scene, count in (("shot_peening", 200), ("billiard_cushion", 21), ("superball", 3)):
        assert len(tables.read_rows(project / f"results/scenes/{scene}.csv")) == count
        assert f"{count} impacts" in (project / f"results/logs/scene_{scene}.log").read_text()


def test_the_verdicts_of_a_good_run(first_run, inventory):
    """Our own second codes are never called agreement."""
    rows = tables.read_rows(first_run[0] / "results/verdicts.csv")
    found = [row["verdict"] for row in rows]
    assert "FAILS" not in found and found.count("not compared") == len(awaited())
    for row in rows:
        source, _, name = row["reference"].partition("/")
        series = inventory.get(source, {}).get("series", {}).get(name, {})
        assert row["group"] in list(Group), row
        if series.get("kind") == "computed" and not series.get("others"):
            assert row["verdict"] != "agrees", row
        assert (row["verdict"] == "passed") <= (row["group"] == Group.SOLVER), row


def test_the_wheel_has_the_package_of_this_checkout_and_nothing_else(first_run):
    with zipfile.ZipFile(first_run[0] / f"figures/{versions.WHEEL}") as wheel:
        made = {name: wheel.read(name) for name in wheel.namelist() if ".dist-info/" not in name}
    files = [path for path in (ROOT / "src/planarimpact").rglob("*") if path.is_file()]
    files = [path for path in files if path.suffix not in (".pyc", ".md")]
    assert made == {f"{path.relative_to(ROOT / 'src')}": path.read_bytes() for path in files}


def test_a_file_of_its_output_is_short_and_ends_on_one_screen(first_run):
    said = first_run[1].stdout
    assert len(said.encode()) <= 6_000
    last = "results/verdicts.txt"
    answers = f"{said[said.index('Does the solver') :].split(last)[0]}{last}".splitlines()
    assert len(answers) <= 26 and max(map(len, answers)) <= 80
    assert sum(line.endswith("?") for line in answers) == 7 and "PASSED: " in answers[-3]


def test_the_table_by_figure_says_aloud_what_is_not_compared(first_run):
    table = (first_run[0] / "results/verdicts.txt").read_text(encoding="utf-8")
    assert max(map(len, table.splitlines())) <= 80
    heads = re.findall(r"^(Fig. \d) ((?:.|\n {8}(?! ))*)", table, flags=re.M)
    assert [name for name, _ in heads] == [f"Fig. {number}" for number in range(2, 10)]
    for _, head in heads:
        assert "not compared: printed curve" in " ".join(head.split())


@pytest.fixture(scope="module")
def tree(first_run, tmp_path_factory):
    """A copy of the project after a full run, in which files are changed and changed back."""
    return copy_of(first_run[0].folder, tmp_path_factory.mktemp("tree"), PARTS + LEFT)


OF_FIG2 = {"curves_fig2", "judge_fig2", "draw_fig2"}
PAGES = {"report", "your_copy"}  # of the curves of the paper
GATE = {"verdicts", "gate"}
REPORT = {"report", *GATE}


def changed(path, old="", new=""):
    """Change a file; what changes it back."""
    text = path.read_text(encoding="utf-8")
    assert old in text
    path.write_text(text.replace(old, new, 1) if old else f"{text}{new}\n", encoding="utf-8")
    return lambda: path.write_text(text, encoding="utf-8")


@pytest.mark.parametrize(
    ("path", "words", "jobs"),
    [
        (f"{FOLDER}/fig6/drawing.py", ("", "# edited"), {"draw_fig6", "report", "gate"}),
        (f"{FOLDER}/fig2/curves.py", ("", "# edited"), OF_FIG2 | PAGES | GATE),
        ("data/kharaz2001/spin.csv", ("69.96", "69.97"), {"draw_fig5", "judge_fig5", *REPORT}),
        ("data/stronge1994/source.yaml", ("tolerance: 0.005", "tolerance: 0.006"),
         {"ledger", "draw_fig5", "judge_fig5", *REPORT}),
        ("data/accepted/verdicts.csv", ("", "a,differs,,1,m,1"), {"report", "gate"}),
        ("workflow/config.yaml", ("superball: {tolerance: 1.0e-4", "superball: {tolerance: 0.1"),
         {"scene_superball", "judge_scene_superball", *REPORT}),
    ],
)  # fmt: skip
def test_an_edit_runs_again_what_it_concerns(path, words, jobs, tree):
    back = changed(tree / path, *words)
    assert tree.jobs()[1] == jobs
    back()


@pytest.mark.parametrize("path", ["src/planarimpact/spheres/__init__.py", "environment.txt"])
def test_an_edit_of_the_solver_or_another_version_runs_everything_again(path, tree):
    back = changed(tree / path, new="# edited")
    every, again = tree.jobs()
    assert every == again > {"explorer", "ledger", "draw_fig9"}
    back()


def test_the_paper_is_eight_figures_drawn_and_judged(tree):
    figures = [f"{job}_fig{n}" for job in ("curves", "draw", "judge") for n in range(2, 10)]
    assert tree.jobs("paper") == ({"-", *figures}, {"-"})  # the gate, which has not run


def test_settings_of_the_command_line_are_drawn_without_judgement(tree):
    change = "figures={fig6: {as_printed: false}, rod: {restitution: 0.8}}"
    assert tree.jobs("figures", "--config", change)[1] == {
        f"{job}_{figure}" for job in ("curves", "draw") for figure in ("fig6", "rod")
    }  # fmt: skip


def test_touching_everything_runs_nothing_and_what_is_missing_is_made_again(finished):
    for path in finished.folder.rglob("*.*"):
        path.touch()
    result = finished.run("--dry-run")
    assert result.returncode == 0 and "Nothing to be done" in result.stdout
    kinds = "curves/fig2.csv", "verdicts/fig3.csv", "residuals/fig4.csv", "ledger.csv"
    slide = next((finished / "figures/slides").glob("fig7_*"))
    pictures = [finished / f"figures/{name}" for name in ("fig5.svg", "explorer.html")]
    for path in (*(finished / f"results/{kind}" for kind in kinds), slide, *pictures):
        path.unlink()
    again = {"judge_fig3", "judge_fig4", "ledger", "draw_fig5", "draw_fig7", "explorer"}
    assert finished.jobs()[1] == OF_FIG2 | PAGES | GATE | again


def test_pages_that_are_made_again_have_the_same_bytes_but_for_the_file_with_the_date(
    first_run, finished
):
    pages = [f"figures/{name}.html" for name in ("report", "explorer", "your_copy")]
    pages.append(f"figures/{versions.WHEEL}")
    for page in pages:
        (finished / page).unlink()
    assert finished.run(*pages).returncode == 0
    files = [path for part in ("figures", "results") for path in (finished / part).rglob("*.*")]
    names = [path.relative_to(finished.folder) for path in files if path.parent.name != "logs"]
    different = {
        str(name) for name in names if content(finished / name) != content(first_run[0] / name)
    }
    assert different <= {"figures/run.txt"} < set(map(str, names))


def content(path):
    """What a file holds, but for the commit, which a copy of this checkout does not know."""
    return re.sub(rb">Commit [^;]*;", b"", path.read_bytes())


def test_a_job_that_raises_is_named_at_the_end_and_the_others_are_done(finished):
    raising = "raise ValueError('oh')"
    broken = [finished / f"{FOLDER}/{path}" for path in ("fig3/curves.py", "fig4/drawing.py")]
    mend = [changed(path, new=raising) for path in broken]
    changed(finished / f"{FOLDER}/fig2/curves.py", new="# edited")
    result = finished.run()
    assert result.returncode == 1 and "PASSED" not in result.stdout
    for log in ("curves_fig3", "draw_fig4"):
        assert f" Log file: results/logs/{log}.log " in result.stdout
        assert "ValueError: oh" in (finished / f"results/logs/{log}.log").read_text()
    assert result.stdout.count("ValueError: oh") == 2 and "Fig. 2 " not in result.stdout
    assert "CalledProcessError" not in result.stdout
    for back in mend:
        back()
    missing = {"curves_fig3", "draw_fig3", "judge_fig3", "draw_fig4", *PAGES, *GATE}
    assert finished.jobs()[1] == missing


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGKILL])
def test_a_run_that_was_stopped_goes_on(number, finished):
    """One job works while the other has been done."""
    slow = "import pathlib, time\npathlib.Path('reached').touch()\ntime.sleep(600)"
    back = changed(finished / f"{FOLDER}/fig3/curves.py", new=slow)
    changed(finished / f"{FOLDER}/fig4/drawing.py", new="# edited")
    running, deadline = finished.start("fig3", "fig4"), time.monotonic() + TIMEOUT
    for path in ("reached", "results/gates/fig4.txt"):
        while not (finished / path).exists():
            assert running.poll() is None and time.monotonic() < deadline
            time.sleep(0.05)
    os.killpg(running.pid, number)
    said, _ = running.communicate(timeout=TIMEOUT)
    back()
    if number == signal.SIGKILL:
        assert "--unlock" in explained(finished.run("fig3"))
        assert finished.run("--unlock").returncode == 0
    else:
        assert running.returncode == 1 and "What was finished\nis kept" in said
    again = finished.jobs("fig3", "fig4")[1] - {
        "gate_fig3",
        "-",
    }  # a gate that never was has no log
    assert again == {"curves_fig3", "draw_fig3", "judge_fig3"}


def test_a_gate_that_failed_fails_again_until_a_row_is_accepted(finished):
    """Then there is nothing to be done."""
    accepted = finished / "data/accepted/verdicts.csv"
    whole = accepted.read_text()
    changed(accepted, "fig3-events,passed,,0,", "fig3-events,passed,,1,")
    for _ in range(2):
        result = finished.run("fig3")
        assert result.returncode == 1, result.stdout
        assert (
            "\nchanged: fig3-events: size 1 m2 Omega v2(0) -> 0 m2 Omega v2(0)\n" in result.stdout
        )
    assert finished.run("accept").returncode == 0 and accepted.read_text() == whole
    assert finished.run("fig3").returncode == 0
    assert "Nothing to be done" in finished.run("fig3", "--dry-run").stdout


def test_a_command_in_another_folder_says_where_it_belongs(fresh, tmp_path_factory):
    other = str(tmp_path_factory.mktemp("other"))
    result = fresh.run("--directory", other)
    assert result.returncode == 1 and "belongs into the folder of the project: cd " in result.stdout
    assert os.listdir(other) in ([], [".snakemake"])
