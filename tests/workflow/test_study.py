"""The parameter study in the workflow: killed, failed and gone on with; what reruns."""

import os
import re
import signal
import subprocess
import sys
import time

STUDY = "results/study.npz"
# The second half of the grid waits while there is a file `wait`; a file `fail` fails one chunk.
WAITS = """    import pathlib, time
    while start > 60000 and pathlib.Path("wait").exists():
        time.sleep(0.05)
    if pathlib.Path("fail").exists():
        pathlib.Path("fail").unlink()
        raise ValueError("oh")
    axes ="""
SECONDS = 1200  # that anything here may take: against a run that hangs


def stopped(project, sign):
    """Start the study, end it by a signal when two of four chunks are done; its words."""
    log = project / f"{sign.name}.txt"
    command = [sys.executable, "-m", "snakemake", "--cores", "4", STUDY]
    deadline = time.monotonic() + SECONDS
    with open(log, "w") as file:
        running = subprocess.Popen(
            command, cwd=project.folder, stdout=file, stderr=file, start_new_session=True
        )
        try:
            while not halfway(project, log.read_text()) and running.poll() is None:
                assert time.monotonic() < deadline, log.read_text()
                time.sleep(0.05)
        finally:
            os.killpg(running.pid, sign)
            assert running.wait(SECONDS) != 0
    return log.read_text()


def halfway(project, words):
    """Two chunks are there and known to snakemake, and it has started the two that wait."""
    started = re.findall("Solving the points (6|9)", words)
    expected = 2 if "0-32260" in words else 0
    return len(chunks(project)) == len(started) == 2 and words.count("Finished jobid") == expected


def chunks(project):
    """Chunks that are there, each with its time and that of its log."""
    return {
        path.stem: (
            path.stat().st_mtime_ns,
            (project / f"results/logs/study_{path.stem}.log").stat().st_mtime_ns,
        )
        for path in (project / "results/study").glob("*.npz")
    }


def solved(words):
    return sorted(re.findall(r"Job \d+: Solving the points (\S+) of the study", words))


def test_a_study_goes_on_where_it_was(fresh, first_run):
    """After Ctrl-C, a kill without warning, a chunk that fails: none is lost or solved twice."""
    fresh.edit("workflow/scripts/solve_chunk.py", "    axes =", WAITS)
    (fresh / "wait").touch()
    words = stopped(fresh, signal.SIGINT)
    assert len(solved(words)) == 4
    assert "Interrupted. Nothing needs mending" in words and "A job stopped" not in words
    done = chunks(fresh)
    assert sorted(done) == ["0-32260", "32260-64521"]

    rest = ["64521-96781", "96781-129042"]
    assert solved(stopped(fresh, signal.SIGKILL)) == rest
    assert chunks(fresh) == done

    (fresh / "wait").unlink()
    (fresh / "fail").touch()
    assert fresh.run("--unlock").returncode == 0
    # One after the other: the first to come fails, and the second is solved all the same.
    failed = fresh.run(STUDY, "--cores", "1")
    assert failed.returncode != 0
    assert "ValueError: oh (log: results/logs/study_" in failed.stdout
    assert solved(failed.stdout) == rest
    assert len(chunks(fresh)) == 3 and not (fresh / STUDY).exists()

    done = chunks(fresh)
    last = fresh.run(STUDY)
    assert last.returncode == 0, last.stdout
    assert len(solved(last.stdout)) == 1
    assert {name: times for name, times in chunks(fresh).items() if name in done} == done
    assert (fresh / STUDY).read_bytes() == (first_run[0] / STUDY).read_bytes()


def test_what_a_change_solves_again(finished):
    study = {"solve_chunk": 4, "gather_chunks": 1, "draw_study": 1, "gate": 1, "all": 1}
    grid = finished.planned("--config", "study={grid: {incidence: {points: 100}}}")[1]
    assert {rule: grid.get(rule) for rule in study} == study
    assert "curves" not in grid and "scene" not in grid
