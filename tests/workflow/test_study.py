"""The parameter study in the workflow: interrupted, killed, failed and gone on with."""

import os
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

STUDY = "results/study.npz"
SECONDS = 1200  # that anything here may take: against a run that hangs


def stopped(project, sign, ready):
    """Start the study, end it by a signal when it is `ready`; its words."""
    log = project / f"{sign.name}.txt"
    command = [sys.executable, "-m", "snakemake", "--cores", "4", STUDY]
    deadline = time.monotonic() + SECONDS
    with open(log, "w") as file:
        running = subprocess.Popen(
            command,
            cwd=project.folder,
            stdout=file,
            stderr=file,
            start_new_session=True,
            # What is started in the background of a shell ignores Ctrl-C.
            preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
        )
        try:
            while not ready(log.read_text()) and running.poll() is None:
                assert time.monotonic() < deadline, log.read_text()
                time.sleep(0.05)
        finally:
            os.killpg(running.pid, sign)
            assert running.wait(SECONDS) != 0
    return log.read_text()


def test_a_study_goes_on_where_it_was(fresh, first_run):
    """After Ctrl-C, a kill without warning, a chunk that fails: none is lost or solved twice."""
    made = {
        path: Path(record["log"][0]).stem
        for path, record in first_run[0].records().items()
        if record["rule"] == "solve_chunk"
    }
    chunks = sorted(made)
    half, rest = chunks[: len(chunks) // 2], chunks[len(chunks) // 2 :]

    def times():
        return {
            path: (fresh / path).stat().st_mtime_ns for path in chunks if (fresh / path).exists()
        }

    def started():
        """Chunks whose jobs have started since this was last asked."""
        found = [path for path in chunks if (fresh / "imported" / made[path]).exists()]
        shutil.rmtree(fresh / "imported")
        return found

    def waiting(finished):
        def ready(words):
            jobs = [(fresh / "imported" / made[path]).exists() for path in rest]
            return words.count("Finished jobid") == finished and all(jobs)

        return ready

    fresh.break_jobs({made[path]: "waits for-ever" for path in rest})
    words = stopped(fresh, signal.SIGINT, waiting(len(half)))
    assert "Interrupted. Nothing needs mending" in words and "A job stopped" not in words
    done = times()
    assert started() == chunks and sorted(done) == half

    stopped(fresh, signal.SIGKILL, waiting(0))
    assert started() == rest and times() == done

    shutil.rmtree(fresh / "broken")
    fresh.break_jobs({made[rest[0]]: "failed before"})
    assert fresh.run("--unlock").returncode == 0
    # One that fails takes none of the others with it.
    failed = fresh.run(STUDY, "--cores", "1")
    assert failed.returncode != 0 and "A job stopped: solve_chunk" in failed.stdout
    assert started() == rest and len(times()) == len(chunks) - 1 and not (fresh / STUDY).exists()

    done = times()
    last = fresh.run(STUDY)
    assert last.returncode == 0, last.stdout
    assert started() == rest[:1] and done.items() <= times().items()
    assert (fresh / STUDY).read_bytes() == (first_run[0] / STUDY).read_bytes()
