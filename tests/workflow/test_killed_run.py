"""A run that is killed, gate included: the next one goes on from there, and judges all."""

import base64
import csv
import os
import shutil
import signal
import subprocess
import sys
import time

from test_awaited_series import JOHNSON, RUBBER, SIGNED, UNSIGNED, export, made_up
from test_troubleshooting import explained

from stronge1994.gate import closing


def test_a_run_that_is_killed_goes_on_and_what_is_gone_is_made_again(finished):
    """The run itself, then the gate behind its work; a series dropped in meanwhile is judged."""
    passed = finished / "results/PASSED"
    gone = ["figures/fig4.png", "figures/report.html", "results/curves/fig2.csv"]
    gone += ["results/series/kharaz2001.csv", "results/residuals/fig3.csv", "results/study.npz"]
    for path in gone:
        (finished / path).unlink()
    (finished / f"data/{RUBBER}.wpd.csv").write_text(export(*made_up()))
    finished.edit(f"data/{JOHNSON}/source.yaml", UNSIGNED, SIGNED)
    finished.break_jobs({"gate": "killed behind"})
    shutil.rmtree(finished / "imported")
    command = [sys.executable, "-m", "snakemake", "--cores", "2"]
    with open(finished / "words.txt", "w") as words:
        running = subprocess.Popen(
            command, cwd=finished.folder, stdout=words, stderr=words, start_new_session=True
        )
        while not (finished / "imported").exists() and running.poll() is None:
            time.sleep(0.02)
        os.killpg(running.pid, signal.SIGKILL)
        running.wait()
    assert not passed.exists()
    locked = finished.run()
    assert "--unlock" in explained(locked) and locked.stdout.rstrip().endswith(closing.UNLOCK)
    assert finished.run("--unlock").returncode == 0

    # The mark that Snakemake leaves at a file which it was writing.
    half_made = "figures/fig8.png"
    mark = base64.b64encode(half_made.encode()).decode()
    (finished / ".snakemake/incomplete" / mark).write_text("")
    (finished / half_made).write_text("half")
    passed.write_text("")
    assert finished.refuses_to_pass().count("Error in rule") == 1
    finished.passes()
    assert "every entry of the ledger holds" in passed.read_text()
    assert all((finished / path).exists() for path in gone)
    assert (finished / half_made).stat().st_size > 1000
    with open(finished / "results/verdicts/fig5.csv", newline="") as file:
        rows = {row["comparison"]: row for row in csv.DictReader(file)}
    assert rows["fig5-rubber-sphere"]["verdict"] == "agrees"
    assert f"data/{RUBBER}.wpd.csv" in finished.records()[f"results/series/{JOHNSON}.csv"]["input"]
