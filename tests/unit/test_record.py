"""The record of a job: what it refuses to record, in the process of the test."""

import json
import os
import re
import sys
from pathlib import Path
from types import SimpleNamespace

import pytest
from stronge1994.run import plans, record

JOB = "results/records/job.json"


class Files(list):
    """Files of a job by name, as Snakemake gives them."""

    def __init__(self, **files):
        super().__init__(files.values())
        self.__dict__.update(files)


@pytest.fixture
def told(tmp_path, monkeypatch):
    """A job that reads a source and an input, and writes one file."""
    monkeypatch.chdir(tmp_path)
    # The process of the tests has imported far more of the real sources than a job.
    monkeypatch.setattr(record, "SRC", tmp_path / "src")
    for folder in ("src", "results/logs", "results/records"):
        (tmp_path / folder).mkdir(parents=True)
    (tmp_path / "src/law.py").write_text("")
    (tmp_path / "input.csv").write_text("1")
    (tmp_path / "made.csv").write_text("1")
    plans._hash.cache_clear()
    plans.write("job", ["src/law.py"], {"factor": 2})
    (tmp_path / "results/PASSED").write_text("passed")
    return SimpleNamespace(
        input=Files(plan=plans.path("job"), table="input.csv"),
        output=Files(made="made.csv", record=JOB),
        log=["results/logs/job.log"],
    )


def test_a_job_leaves_what_it_read_and_wrote(told, tmp_path, capsys):
    record.begin(12)
    with record.recorded(told) as settings:
        assert settings == {"factor": 2} and not (tmp_path / "results/PASSED").exists()
        print("to the log")
    kept = record.read(JOB)
    assert set(kept["read"]) == {"src/law.py", "input.csv", "results/plans/job.json"}
    assert set(kept["wrote"]) == {"made.csv"}
    assert record.faults(["made.csv", JOB]) == []
    assert (tmp_path / "results/logs/job.log").read_text() == "to the log\n"
    assert re.match(r" 1 of 12  job  \d+\.\d s\n$", capsys.readouterr().out)
    assert record.ended() == ["job"]


@pytest.mark.parametrize("path", ["src/law.py", "input.csv", "results/plans/job.json"])
def test_an_edit_while_the_job_runs_fails_it(told, tmp_path, path, capsys):
    record.begin(1)
    with pytest.raises(SystemExit), record.recorded(told):
        (tmp_path / path).write_text("{} ")
    assert f"{path} was edited after the run began" in capsys.readouterr().err
    assert not (tmp_path / JOB).exists() and record.ended() == ["stopped job"]
    if path == "src/law.py":  # the next job does not begin
        with pytest.raises(SystemExit), record.recorded(told):
            pytest.fail("it works")


def test_a_module_that_the_plan_does_not_name_fails_the_job(told, tmp_path, monkeypatch, capsys):
    with pytest.raises(SystemExit), record.recorded(told):
        other = SimpleNamespace(__file__=str(tmp_path / "src/other.py"))
        monkeypatch.setitem(sys.modules, "other", other)
    assert "job imports src/other.py, which its rule does not plan for" in capsys.readouterr().err


def test_a_plan_is_written_only_if_it_has_changed(told, tmp_path):
    """Its settings, a source, or what a disk has made of it; then no earlier verdict stays."""
    plan, passed = tmp_path / plans.path("job"), tmp_path / "results/PASSED"

    def written(factor, before=None):
        if before:
            plan.write_bytes(before)
        passed.write_text("passed")
        os.utime(plan, (0, 0))
        plans.write("job", ["src/law.py"], {"factor": factor})
        assert json.loads(plan.read_text())["settings"] == {"factor": factor}
        assert passed.exists() is (plan.stat().st_mtime == 0)
        return not passed.exists()

    assert not written(2) and written(3) and not written(3) and written(3, b"\xff\xfe")
    (tmp_path / "src/law.py").write_text("edited")
    plans._hash.cache_clear()  # of one process, in which sources stay
    assert written(3)


@pytest.mark.parametrize(
    ("words", "asks"),
    [
        *((words, True) for words in (["-n"], ["-np"], ["--lint=json"], ["--report", "x.html"])),
        (["--touch"], False),
        (["--report", "x.html", "--report-after-run"], False),
    ],
)
def test_who_only_asks_leaves_the_verdict(told, tmp_path, words, asks):
    plans.start(["snakemake", *words])
    assert (tmp_path / "results/PASSED").exists() is asks


def test_a_damaged_record_is_none(told):
    for text in ("", "{", "[]", '{"seconds": 1}', '{"seconds": 1.5, "read": {}, "wrote": {}}'):
        Path(JOB).write_text(text)
        assert bool(record.read(JOB)) is text.endswith("}}")
