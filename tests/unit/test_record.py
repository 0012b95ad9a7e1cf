"""The record of a job: what it refuses to record, in the process of the test."""

import json
import re
import sys
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
    (tmp_path / "results/PASSED").write_text("passed")
    plans.write("job", ["src/law.py"], {"factor": 2})
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


def test_an_edit_before_the_job_runs_fails_it(told, tmp_path, capsys):
    (tmp_path / "src/law.py").unlink()
    with pytest.raises(SystemExit), record.recorded(told):
        pytest.fail("it works")
    assert "src/law.py was edited after the run began" in capsys.readouterr().err


def test_a_module_that_the_plan_does_not_name_fails_the_job(told, tmp_path, monkeypatch, capsys):
    with pytest.raises(SystemExit), record.recorded(told):
        other = SimpleNamespace(__file__=str(tmp_path / "src/other.py"))
        monkeypatch.setitem(sys.modules, "other", other)
    assert "job imports src/other.py, which its rule does not plan for" in capsys.readouterr().err


def test_a_plan_that_has_not_changed_is_not_written(told, tmp_path):
    (tmp_path / "results/PASSED").write_text("passed")
    before = (tmp_path / plans.path("job")).stat().st_mtime_ns
    plans.write("job", ["src/law.py"], {"factor": 2})
    assert (tmp_path / plans.path("job")).stat().st_mtime_ns == before
    assert (tmp_path / "results/PASSED").exists()
    plans.write("job", ["src/law.py"], {"factor": 3})
    assert json.loads((tmp_path / plans.path("job")).read_text())["settings"] == {"factor": 3}
    assert not (tmp_path / "results/PASSED").exists()


@pytest.mark.parametrize("words", [["-n"], ["-np"], ["--lint=json"], ["--report", "x.html"]])
def test_who_only_asks_leaves_the_verdict(told, tmp_path, words):
    (tmp_path / "results/PASSED").write_text("passed")
    plans.start(["snakemake", *words])
    assert (tmp_path / "results/PASSED").exists()
    plans.start(["snakemake", "--touch"])
    assert not (tmp_path / "results/PASSED").exists()


def test_a_report_behind_a_run_is_a_run(told, tmp_path):
    plans.start(["snakemake", "--report", "x.html", "--report-after-run"])
    assert not (tmp_path / "results/PASSED").exists()


def test_a_plan_that_is_no_text_is_written_anew(told, tmp_path):
    (tmp_path / plans.path("job")).write_bytes(b"\xff\xfe")
    plans.write("job", ["src/law.py"], {"factor": 2})
    assert json.loads((tmp_path / plans.path("job")).read_text())["settings"] == {"factor": 2}
