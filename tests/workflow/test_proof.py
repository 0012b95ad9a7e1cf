"""Whatever goes wrong, a run that must not pass never says so: a workflow of three jobs.

The toy has the real plans, records, gate and last words, and jobs that can be told to fail.
"""

import os
import re
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from stronge1994.run import last_words
from tests.workflow.project import ROOT, Project

HERE = Path(__file__).parent
PROFILE = "keep-going: true\nrerun-incomplete: true\nquiet: [host, reason]\n"


@pytest.fixture(scope="module")
def passed(tmp_path_factory):
    """A toy that has passed."""
    folder = tmp_path_factory.mktemp("toy")
    shutil.copytree(HERE / "toy", folder, dirs_exist_ok=True)
    shutil.copy(ROOT / "workflow/scripts/gate.py", folder)
    ignore = shutil.ignore_patterns("__pycache__", "*.npz")
    shutil.copytree(ROOT / "src", folder / "src", ignore=ignore)
    (folder / "config.yaml").write_text("factor: 2\n")
    (folder / "data.csv").write_text("1.0\n")
    (folder / "law.py").write_text("def law(x, factor):\n    return factor * x\n")
    (folder / "profiles/default").mkdir(parents=True)
    (folder / "profiles/default/config.yaml").write_text(PROFILE)
    toy = Project(folder)
    toy.passes()
    return toy


@pytest.fixture
def toy(passed, tmp_path):
    """A copy of it, with what its jobs have done before."""
    shutil.copytree(passed.folder, tmp_path, dirs_exist_ok=True)
    return Project(tmp_path)


def write_old(path, text):
    """Write a file as a backup or an archive brings it back, older than all that was made of it."""
    path.write_text(text)
    os.utime(path, (0, 0))


LAW, DATA, CONFIG = "law.py", "data.csv", "config.yaml"
EDITS = {
    LAW: "def law(x, factor):\n    return 9 * factor * x\n",
    DATA: "9.0\n",
    CONFIG: "factor: 18\n",
}


def test_what_a_job_is_told_and_reads_is_solved_again(toy):
    """Whatever its date is. Each of these lets a row diverge; a run of the same fails again."""
    before = {path: (toy / path).read_text() for path in EDITS}
    for path, text in EDITS.items():
        write_old(toy / path, text)
        assert "  diverges: row" in toy.refuses_to_pass()
        assert (toy / "results/curves.csv").read_text() == "curve\n18.0\n"
        if path != CONFIG:
            write_old(toy / path, before[path])
    said = toy.refuses_to_pass()
    assert "FAILED. Reasons: 1" in said and "rule curves" not in said
    write_old(toy / CONFIG, before[CONFIG])
    toy.passes()


def test_what_its_job_has_not_left_does_not_pass(toy):
    """Restored, cut, emptied or planted: the gate names it, twice in a row, and says what helps."""
    changed = {
        "results/curves.csv": "curve\n2.5\n",
        "figures/picture.svg": "<svg>",
        "results/verdicts.csv": "comparison,verdict\n",
        "results/PASSED": "planted",
    }
    for path, text in changed.items():
        (toy / path).write_text(text)
    (toy / "results/records/judge.json").write_text("{}")
    toy.run("--touch")  # so that Snakemake takes all of it for new
    first, second = toy.refuses_to_pass(), toy.refuses_to_pass()
    assert "FAILED. Reasons: " in first and "FAILED. Reasons: " in second
    for path in ("results/curves.csv", "figures/picture.svg"):
        assert f"{path}: not as its job left it: remove results/records/" in second
    for record in {line.split(": remove ")[1].split(" ")[0] for line in faults(second)}:
        (toy / record).unlink()
    toy.passes()
    assert (toy / "figures/picture.svg").read_text() == "<svg>2.0</svg>\n"


def faults(said):
    return [line for line in said.splitlines() if ": remove results/records/" in line]


# Each could hide a fault from Snakemake.
HIDING = [
    "--rerun-triggers mtime", "--ignore-incomplete", "--keep-incomplete", "--no-hooks", "--nolock",
    "--consider-ancient curves=plan", "--drop-metadata",
]  # fmt: skip
TOUCHING = ["--touch", "--touch --no-hooks", "--allowed-rules all", "--touch --no-hooks"]


@pytest.mark.parametrize(
    "options",
    [
        TOUCHING,
        ["--until draw", "--batch all=1/3", *[" ".join(HIDING)] * 2],
        *(pytest.param([option] * 2, marks=pytest.mark.long) for option in HIDING + TOUCHING),
    ],
)
def test_no_option_makes_a_wrong_verdict(toy, options):
    """In a tree that has passed; a fault for Snakemake and one for the gate; twice in a row."""
    write_old(toy / CONFIG, EDITS[CONFIG])
    (toy / "figures/picture.svg").write_text("<svg>")
    for option in options:
        found = toy.run(*option.split())
        assert not (toy / "results/PASSED").exists() and "PASSED." not in found.stdout


def test_options_that_users_need_do_what_they_should(toy):
    for option in ("-n", "--lint", "--report x.html"):
        toy.run(*option.split())
        assert (toy / "results/PASSED").exists(), option
    assert "rule curves" in toy.passes("-F", "--rerun-triggers", "mtime")
    assert toy.run("--touch").returncode == 0 and not (toy / "results/PASSED").exists()
    assert "rule curves" not in toy.passes()


STORIES = [
    {"curves.within": "kill", "draw.before": "fail", "judge.behind": "kill"},
    {"curves.behind": "fail", "draw.within": "fill", "judge.before": "kill"},
]


@pytest.mark.parametrize("story", STORIES)
def test_a_job_that_stops_does_not_pass(toy, story):
    """From a tree that has passed; the next run goes on from there, and judges all."""
    write_old(toy / DATA, EDITS[DATA])  # all jobs must run again, to divergence
    for job, how in story.items():
        (toy / job).write_text(how)
    for stopped in ({"curves"}, {"draw", "judge"}):
        said = toy.refuses_to_pass()
        assert stopped == set(re.findall(r"^Error in rule (\w+):", said, flags=re.M))
        assert "A job stopped: " in said and "finished work is kept" in said
        assert "No verdict in this run" in said and "agrees" not in said
    assert not [job for job in story if (toy / job).exists()]
    assert "FAILED. Reasons: 1\n" in toy.refuses_to_pass()


def started(toy, *arguments):
    command = [sys.executable, "-m", "snakemake", "--cores", "2", *arguments]
    with open(toy / "words.txt", "w") as words:
        return subprocess.Popen(
            command, cwd=toy.folder, stdout=words, stderr=words, start_new_session=True
        )


def wait_for(path, running):
    while not path.exists():
        assert running.poll() is None, "it has ended before"
        time.sleep(0.01)


def test_a_run_that_is_asked_to_end_says_so(toy):
    """SIGTERM, as a scheduler of a cluster sends it."""
    (toy / "draw.within").write_text("wait")
    running = started(toy, "-R", "draw")
    wait_for(toy / "draw.reached", running)
    running.terminate()
    while "Will exit" not in (toy / "words.txt").read_text():
        time.sleep(0.01)
    (toy / "draw.within").unlink()
    assert running.wait() != 0 and last_words.INTERRUPTED in (toy / "words.txt").read_text()
    toy.passes()


def test_a_job_that_raises_is_a_fault_of_the_run_and_all_the_rest_is_done(toy):
    """What it should have made says why; once mended, the same command passes."""
    good = (toy / LAW).read_text()
    (toy / LAW).write_text("def law(x, factor):\n    raise ArithmeticError('oh')\n")
    why = "curves: ArithmeticError: oh"
    said = toy.refuses_to_pass()
    assert f"FAILED. Reasons: 1\n  failed: {why} (log: results/logs/curves.log)" in said
    for made in ("results/curves.csv", "figures/picture.svg", "figures/report.html"):
        assert why in (toy / made).read_text()
    for target in (), ("figures/picture.svg",), ("figures/picture.svg",):
        assert f"failed: {why}" in toy.refuses_to_pass(*target)
    (toy / LAW).write_text(good)
    toy.passes()


def test_a_run_that_is_killed_goes_on(toy):
    (toy / "draw.within").write_text("wait")
    write_old(toy / DATA, EDITS[DATA])
    running = started(toy)
    wait_for(toy / "draw.reached", running)
    os.killpg(running.pid, signal.SIGKILL)
    running.wait()
    (toy / "draw.within").unlink()
    assert "--unlock" in toy.refuses_to_pass()
    assert toy.run("--unlock").returncode == 0
    assert "diverges: row" in toy.refuses_to_pass("--ignore-incomplete")
    assert "18" in (toy / "figures/picture.svg").read_text()


@pytest.mark.parametrize(
    "other", [["-n"], pytest.param(["--nolock"], marks=pytest.mark.long)], ids=["dry", "nolock"]
)
def test_two_runs_with_other_settings_do_not_mix(toy, other):
    """A second command writes its plans while the jobs of the first one work."""
    (toy / "draw.within").write_text("wait")
    running = started(toy, "-R", "draw")
    wait_for(toy / "draw.reached", running)
    toy.run(*other, "--config", "factor=3", "--until", "curves")
    (toy / "draw.within").unlink()
    assert running.wait() != 0 and not (toy / "results/PASSED").exists()
    toy.passes()
    assert (toy / "figures/picture.svg").read_text() == "<svg>2.0</svg>\n"


def test_a_syntax_error_does_not_pass(toy):
    (toy / "law.py").write_text("def law(:\n")
    assert "SyntaxError" in toy.refuses_to_pass()


def test_a_copy_without_what_snakemake_keeps_passes_only_if_it_is_whole(toy):
    shutil.rmtree(toy / ".snakemake")
    toy.passes()
    (toy / "figures/picture.svg").write_text("<svg>2.5</svg>")
    shutil.rmtree(toy / ".snakemake")
    assert "picture.svg: not as its job left it" in toy.refuses_to_pass()
