"""Whatever goes wrong, a run that must not pass never says so: a workflow of three jobs.

The toy has the real plans, records, gate and last words, and jobs that can be told to fail.
"""

import os
import re
import runpy
import shutil
import signal
import time
from pathlib import Path
from types import SimpleNamespace

import pytest
from stronge1994.run import last_words, plans, record

from tests.workflow.project import ROOT, Project
from tests.workflow.test_refusals import explained

HERE = Path(__file__).parent
PROFILE = "keep-going: true\nrerun-incomplete: true\nquiet: [host, reason]\n"
FILES = {
    "law.py": "def law(x, factor):\n    return factor * x\n",
    "data.csv": "1.0\n",
    "config.yaml": "factor: 2\n",
    "profiles/default/config.yaml": PROFILE,
}


@pytest.fixture(scope="module")
def passed(tmp_path_factory):
    """A toy that has passed."""
    folder = tmp_path_factory.mktemp("toy")
    shutil.copytree(HERE / "toy", folder, dirs_exist_ok=True)
    shutil.copy(ROOT / "workflow/scripts/gate.py", folder)
    ignore = shutil.ignore_patterns("__pycache__", "*.npz")
    shutil.copytree(ROOT / "src", folder / "src", ignore=ignore)
    (folder / "profiles/default").mkdir(parents=True)
    for path, text in FILES.items():
        (folder / path).write_text(text)
    toy = Project(folder)
    toy.passes()
    return toy


@pytest.fixture
def toy(passed, tmp_path):
    """A copy of it, with what its jobs have done before."""
    shutil.copytree(passed.folder, tmp_path / "toy")
    return Project(tmp_path / "toy")


def write_old(path, text):
    """Write a file as a backup or an archive brings it back, older than all that was made of it."""
    path.write_text(text)
    os.utime(path, (0, 0))


def test_a_run_that_is_stopped_or_killed_does_not_pass_and_goes_on(toy):
    """Other data let a row diverge, whatever their date: no start says less of it than the last."""
    write_old(toy / "data.csv", "9.0\n")
    for job, how in (("curves.within", "kill"), ("draw.before", "fail"), ("judge.behind", "kill")):
        (toy / job).write_text(how)
    for stopped in ({"curves"}, {"draw", "judge"}):
        said = toy.refuses_to_pass()
        assert stopped == set(re.findall(r"^Error in rule (\w+):", said, flags=re.M))
        assert "A job stopped: " in said and "finished work is kept" in said
        assert "No verdict in this run" in said and "agrees" not in said

    (toy / "draw.reached").unlink()
    (toy / "draw.within").write_text("wait")
    running = toy.start()
    running.wait_for((toy / "draw.reached").exists)
    os.killpg(running.process.pid, signal.SIGKILL)
    assert running.ended().returncode == -signal.SIGKILL
    (toy / "draw.within").unlink()
    locked = toy.run()
    assert "--unlock" in explained(locked) and locked.stdout.rstrip().endswith(last_words.UNLOCK)
    assert toy.run("--unlock").returncode == 0
    said = toy.refuses_to_pass("--ignore-incomplete")
    assert "FAILED. Reasons: 1\n  diverges: row" in said
    assert (toy / "figures/picture.svg").read_text() == "<svg>18.0</svg>\n"


def test_a_job_that_raises_is_a_fault_of_the_run_and_all_the_rest_is_done(toy):
    """A source is edited, whatever its date. What it should have made says why."""
    write_old(toy / "law.py", "raise ArithmeticError('oh')\n")
    why = "curves: ArithmeticError: oh"
    said = toy.refuses_to_pass()
    assert f"FAILED. Reasons: 1\n  failed: {why} (log: results/logs/curves.log)" in said
    for made in ("results/curves.csv", "figures/picture.svg", "figures/report.html"):
        assert why in (toy / made).read_text()
    assert f"failed: {why}" in toy.refuses_to_pass("figures/picture.svg")
    write_old(toy / "law.py", FILES["law.py"])
    toy.passes()
    assert (toy / "figures/picture.svg").read_text() == "<svg>2.0</svg>\n"


# Each could hide a fault from Snakemake.
HIDING = [
    "--rerun-triggers mtime", "--ignore-incomplete", "--keep-incomplete", "--no-hooks", "--nolock",
    "--consider-ancient curves=plan", "--drop-metadata",
]  # fmt: skip


def test_what_its_job_has_not_left_does_not_pass(toy):
    """Restored, planted or emptied, and all of it new to Snakemake: the gate says what helps."""
    changed = {
        "results/curves.csv": "curve\n2.5\n",
        "figures/picture.svg": "<svg>",
        "results/verdicts.csv": "comparison,verdict\n",
        "results/records/judge.json": "{}",
        "results/PASSED": "planted",
    }
    for path, text in changed.items():
        (toy / path).write_text(text)
    shutil.rmtree(toy / ".snakemake")
    now = time.time()
    for folder in ("results", "figures"):
        for path in (toy / folder).rglob("*.*"):
            os.utime(path, (now, now))
    for options in (" ".join(HIDING).split(), []):
        assert "rule curves" not in toy.refuses_to_pass(*options)
        said = (toy / plans.GATE_LOG).read_text()
        for path in ("results/curves.csv", "figures/picture.svg"):
            assert f"{path}: not as its job left it: remove results/records/" in said
        assert "results/records/judge.json: no record of its job: remove " in said
    for path in set(re.findall(r": remove (results/records/\S+)", said)):
        (toy / path).unlink()
    toy.passes()
    assert (toy / "figures/picture.svg").read_text() == "<svg>2.0</svg>\n"


def test_the_gate_notices_that_another_command_has_changed_the_plans(toy, monkeypatch):
    """As a dry run with another --config does while jobs work."""
    monkeypatch.chdir(toy.folder)
    jobs = [*toy.records(), "all"]
    made = [path for kept in toy.records().values() for path in kept["wrote"]]
    told = SimpleNamespace(
        input=SimpleNamespace(plan=plans.path("all"), made=made),
        params=SimpleNamespace(jobs=jobs, plans=plans.digest(jobs)),
        log=[plans.GATE_LOG],
    )
    made += [record.path(job) for job in toy.records()]

    def passes():
        with pytest.raises(SystemExit) as end:
            runpy.run_path(str(ROOT / "workflow/scripts/gate.py"), {"snakemake": told})
        assert (toy / "results/PASSED").exists() is not end.value.code
        return not end.value.code

    assert passes()
    with open(toy / plans.path("all"), "a") as plan:
        plan.write(" ")
    assert not passes() and "another command" in (toy / plans.GATE_LOG).read_text()


TOUCHING = ["--touch", "--touch --no-hooks", "--allowed-rules all", "--touch --no-hooks"]


@pytest.mark.long
@pytest.mark.parametrize("options", [TOUCHING, *([option] * 2 for option in HIDING + TOUCHING)])
def test_no_option_makes_a_wrong_verdict(toy, options):
    """In a tree that has passed; a fault for Snakemake and one for the gate; twice in a row."""
    write_old(toy / "config.yaml", "factor: 18\n")
    (toy / "figures/picture.svg").write_text("<svg>")
    for option in options:
        found = toy.run(*option.split())
        assert not (toy / "results/PASSED").exists() and "PASSED." not in found.stdout
