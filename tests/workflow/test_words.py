"""What a run says: signs of life, and the end."""

import logging
import time
from types import SimpleNamespace

import pytest
from snakemake.exceptions import LockException, WorkflowError, print_exception
from snakemake.logging import logger

from stronge1994 import csv_tables, job, records
from stronge1994.gate import closing
from stronge1994.judging import verdict_table

VERDICT = {
    **dict.fromkeys(verdict_table.COLUMNS, ""),
    "figure": "fig6", "comparison": "fig6-rebound", "verdict": "agrees", "reference": "a/b",
    "points": 5, "rms [sigma]": 0.1, "max [sigma]": 0.2, "allowed": "max <= 1",
}  # fmt: skip
ENTRY = {
    "verdict": "wrong", "holds": "yes", "entry": "eq-25", "where": "Eq. 25", "problem": "0.1 > 0",
}  # fmt: skip


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    for name in ("logs", "benchmarks"):
        (tmp_path / "results" / name).mkdir(parents=True)
    return tmp_path


def test_a_long_job_shows_life_and_a_short_one_is_silent(folder, monkeypatch, capsys):
    with job.log_to("results/logs/short.log"):
        print("to the log")
    assert capsys.readouterr() == ("", "")
    (folder / "results/benchmarks/long.tsv").write_text("s\th:m:s\n25.13\t0:00:25\n")
    monkeypatch.setattr(job, "SIGN_OF_LIFE", 0.05)
    with job.log_to("results/logs/long.log"):
        time.sleep(0.4)
        print("to the log")
    said = capsys.readouterr().err.splitlines()
    assert len(said) > 2
    assert set(said) == {"... long: 0 s (the last time it took 25 s)"}
    assert (folder / "results/logs/long.log").read_text() == "to the log\n"


@pytest.mark.parametrize("table", [None, "", "s\n", "s\noh\n"])
def test_a_sign_of_life_needs_no_earlier_run(folder, table, monkeypatch, capsys):
    if table is not None:
        (folder / "results/benchmarks/first.tsv").write_text(table)
    monkeypatch.setattr(job, "SIGN_OF_LIFE", 0.05)
    with job.log_to("results/logs/first.log"):
        time.sleep(0.2)
    assert set(capsys.readouterr().err.splitlines()) == {"... first: 0 s"}


@pytest.fixture
def before(folder):
    """What `closing.state` says before a run in a folder that had one already."""
    ended(folder, "gate", passed=True)
    return closing.state()


def test_an_input_that_is_edited_meanwhile_fails_the_job(folder):
    (folder / "data.csv").write_text("1")
    (folder / "made.csv").write_text("1")
    told = SimpleNamespace(input=["data.csv"], output=["made.csv"], log=["results/logs/a.log"])
    with job.recorded(told):
        pass
    assert records.faults(["made.csv"]) == []
    words = "data.csv was edited while the job ran"
    with pytest.raises(RuntimeError, match=words), job.recorded(told):
        (folder / "data.csv").write_text("2")
    assert "made from another data.csv" in records.faults(["made.csv"])[0]


def test_the_last_words_on_a_locked_folder_are_what_helps(monkeypatch):
    said = []
    handler = logging.Handler()
    handler.emit = lambda record: said.append(record.getMessage())
    monkeypatch.setattr(logger, "handlers", [handler])
    monkeypatch.setattr(logger, "filters", [closing.add_unlock])
    for error in (LockException(), WorkflowError("oh")):
        print_exception(error)
    assert "cannot be locked" in said[0] and said[0].splitlines()[-1] == closing.UNLOCK
    assert "oh" in said[1] and closing.UNLOCK not in said[1]


def ended(folder, gate=None, passed=False, verdict="agrees", holds="yes"):
    """Tables as a run leaves them that came as far as the gate, or just to its door."""
    for path, row in (
        (closing.VERDICTS, VERDICT | {"verdict": verdict}),
        (closing.LEDGER, ENTRY | {"holds": holds}),
    ):
        csv_tables.write_rows(folder / path, list(row), [list(row.values())])
    if gate is not None:
        (folder / closing.GATE_LOG).unlink(missing_ok=True)
        (folder / closing.GATE_LOG).write_text(gate)
    passed_file = folder / "results/PASSED"
    passed_file.write_text("passed") if passed else passed_file.unlink(missing_ok=True)


def test_a_passed_run_says_where_to_look_and_what_next(folder, before):
    ended(folder, "\n", passed=True)
    words = closing.words(before)
    assert "1 agrees" in words and "PASSED." in words
    for path in ("figures/report.html", "figures/explorer.html", "workflow/config.yaml"):
        assert path in words


def test_a_failed_run_names_its_rows_last_and_repeats_the_config(folder, before):
    faults = [f"diverges: row-{i}: far off" for i in range(closing.SHOWN + 2)]
    ended(folder, "\n".join(faults), verdict="diverges")
    words = closing.words(before, ["a=1", "figures={fig6: {restitution: [0, 1]}}"], stopped=True)
    assert "PASSED" not in words and "Play" not in words and "figures/report.html" in words
    assert "figures --config a=1 'figures={fig6: {restitution: [0, 1]}}'" in words
    last = words.strip().splitlines()[-closing.SHOWN - 2 :]
    assert last[0] == f"FAILED. Reasons: {len(faults)}"
    assert last[1:-1] == [f"  {fault}" for fault in faults[: closing.SHOWN]]
    assert last[-1] == f"  and 2 more: {closing.GATE_LOG}"


def test_tables_without_the_gate_are_no_verdict(folder, before):
    ended(folder, verdict="diverges")
    words = closing.words(before)
    assert (
        "No verdict in this run" in words and "diverges or no longer holds: fig6-rebound" in words
    )
    assert "stopped" not in words and "On purpose" not in words


@pytest.mark.parametrize(
    ("said", "words"),
    [
        ("Error in rule draw:\n  x\nError in rule draw:\nError in rule scene:", "draw, scene."),
        (f"{closing.ON_REQUEST}, this might\nError in rule draw:", "Nothing needs mending"),
    ],
)
def test_a_stopped_run_says_why_and_no_older_table(folder, before, said, words):
    (folder / "snakemake.log").write_text(said)
    found = closing.words(before, stopped=True, logs=["snakemake.log"])
    assert words in found and "No verdict in this run" in found and "finished work" in found
    assert "agrees" not in found and "PASSED" not in found
    assert "stopped" not in closing.words(before)
