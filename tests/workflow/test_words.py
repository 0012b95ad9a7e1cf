"""What a run says in the end."""

import pytest
from stronge1994.run import gate, last_words, plans, record

from stronge1994 import csv_tables
from stronge1994.verdict_tables import verdict_table

VERDICT = {
    **dict.fromkeys(verdict_table.COLUMNS, ""),
    "figure": "fig6", "comparison": "fig6-rebound", "question": "beside others",
    "verdict": "agrees", "reference": "a/b", "points": 5, "rms [sigma]": 0.1, "max [sigma]": 0.2,
    "rms [axis units]": 0.01, "max [axis units]": 0.02, "unit": "1", "allowed": "max <= 1",
}  # fmt: skip
ENTRY = {
    "verdict": "wrong", "holds": "yes", "entry": "eq-25", "where": "Eq. 25", "problem": "0.1 > 0",
}  # fmt: skip


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "results/logs").mkdir(parents=True)
    return tmp_path


def ended(folder, log=None, passed=False, verdict="agrees", holds="yes"):
    """Tables as a run leaves them that came as far as the gate, or just to its door."""
    for path, row in (
        (gate.TABLES[0], VERDICT | {"verdict": verdict}),
        (gate.TABLES[1], ENTRY | {"holds": holds}),
    ):
        csv_tables.write_rows(folder / path, list(row), [list(row.values())])
    if log is not None:
        (folder / plans.GATE_LOG).unlink(missing_ok=True)
        (folder / plans.GATE_LOG).write_text(log)
    passed_file = folder / "results/PASSED"
    passed_file.write_text("passed") if passed else passed_file.unlink(missing_ok=True)


def test_a_passed_run_says_where_to_look_and_what_next(folder):
    ended(folder, "\n", passed=True)
    words = last_words.text()
    assert "beside others: 1 agrees" in words and "a 5 0.01 0.1 agrees" in words
    assert "PASSED." in words
    for path in ("figures/report.html", "figures/explorer.html", "workflow/config.yaml"):
        assert path in words


def test_a_failed_run_names_its_rows_last_and_repeats_the_config(folder):
    faults = [f"diverges: row-{i}: far off" for i in range(last_words.MOST_FAULTS + 2)]
    ended(folder, "\n".join(faults), verdict="diverges")
    words = last_words.text(["a=1", "figures={fig6: {restitution: [0, 1]}}"], stopped=True)
    assert "PASSED" not in words and "Play" not in words and "figures/report.html" in words
    assert "figures --config a=1 'figures={fig6: {restitution: [0, 1]}}'" in words
    last = words.strip().splitlines()[-last_words.MOST_FAULTS - 2 :]
    assert last[0] == f"FAILED. Reasons: {len(faults)}"
    assert last[1:-1] == [f"  {fault}" for fault in faults[: last_words.MOST_FAULTS]]
    assert last[-1] == f"  and 2 more: {plans.GATE_LOG}"


@pytest.mark.parametrize("log", [None, "", "\n"])
def test_a_gate_that_found_nothing_and_let_nothing_pass_is_no_verdict(folder, log):
    """It has not run, was stopped or touched, or other jobs came after it."""
    ended(folder, log, verdict="diverges")
    words = last_words.text()
    assert "No verdict in this run" in words and "FAILED" not in words
    assert "diverges" not in words and "stopped" not in words and "Verdicts:" not in words


@pytest.mark.parametrize(
    ("said", "words"),
    [
        ("Error in rule draw:", "A job stopped: draw_fig2, scene_golf."),
        (f"{last_words.ON_REQUEST[0]}, this might", "Nothing needs mending"),
    ],
)
def test_a_stopped_run_says_why_and_no_older_table(folder, said, words):
    (folder / "snakemake.log").write_text(said)
    jobs = "4\nstopped draw_fig2\ndraw_fig3\nstopped scene_golf\n"
    (folder / record.JOBS).write_text(jobs)
    found = last_words.text(stopped=True, logs=["snakemake.log"])
    assert words in found and "No verdict in this run" in found and "finished work" in found
    assert "agrees" not in found and "PASSED" not in found
    assert "stopped" not in last_words.text()
