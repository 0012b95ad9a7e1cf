"""What a run says: signs of life, and the end."""

import os
import time

import closing
import csv_tables
import job
import pytest

VERDICT = {
    "figure": "fig6", "comparison": "fig6-e1", "verdict": "agrees", "reference": "a/b",
    "points": 5, "rms [sigma]": 0.1, "max [sigma]": 0.2, "found": "", "stated": "",
    "allowed": "max <= 1", "note": "", "reason": "",
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


def ended(folder, *rules, verdict="agrees", holds="yes"):
    """Tables as a run leaves them that came as far as these rules."""
    for path, row in (
        (closing.VERDICTS, VERDICT | {"verdict": verdict}),
        (closing.LEDGER, ENTRY | {"holds": holds}),
    ):
        csv_tables.write_rows(folder / path, list(row), [list(row.values())])
    for rule in rules:
        (folder / f"results/benchmarks/{rule}.tsv").touch()
        (folder / f"results/logs/{rule}.log").touch()


def test_a_passed_run_says_where_to_look_and_what_next(folder):
    ended(folder, "verdicts", "ledger", "gate")
    words = closing.words(0)
    assert "1 agrees" in words and "PASSED" in words
    for path in ("figures/report.html", "figures/explorer.html", "workflow/config.yaml"):
        assert path in words


@pytest.mark.parametrize(
    ("change", "bad"),
    [
        ({"verdict": "diverges"}, "FAILED: 1 diverging comparisons"),
        ({"holds": "no"}, "FAILED: 1 entries of the ledger that no longer hold"),
    ],
)
def test_a_failed_run_says_why_and_how_to_draw_without_judging(folder, change, bad):
    ended(folder, "verdicts", "ledger", "gate", **change)
    words = closing.words(0, stopped=True)
    assert bad in words and "PASSED" not in words and "Play" not in words
    assert "figures/report.html" in words and "--cores 2 figures" in words


def test_one_page_with_a_failing_row_is_neither_judged_nor_stopped(folder):
    ended(folder, "verdicts", "ledger", verdict="diverges")
    words = closing.words(0)
    assert "FAILED: 1 diverging" in words
    assert "stopped" not in words and "On purpose" not in words


def test_a_stopped_run_says_so_and_no_older_table(folder):
    ended(folder, "verdicts", "ledger", "gate")
    for path in (folder / "results").glob("*/*"):
        os.utime(path, (1, 1))
    words = closing.words(2, stopped=True)
    assert "No verdict in this run" in words and "finished work is kept" in words
    assert "agrees" not in words
    assert "stopped" not in closing.words(2)
