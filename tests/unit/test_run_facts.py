"""On what a run was made: this checkout, whatever git is told, and its jobs as far as known."""

import shutil
import subprocess

import pytest

from stronge1994 import records
from stronge1994.pages import run_facts


def test_the_commit_is_that_of_the_folder_whatever_git_is_told(tmp_path, monkeypatch):
    if shutil.which("git") is None:
        pytest.skip("git is missing")
    commits = {}
    for name in ("ours", "other"):
        git = ["git", "-C", str(tmp_path / name), "-c", "user.name=a", "-c", "user.email=a@b"]
        (tmp_path / name).mkdir()
        for command in (["init", "-q"], ["commit", "-q", "--allow-empty", "-m", name]):
            subprocess.run([*git, *command], check=True)
        commits[name] = run_facts.commit(tmp_path / name)
    assert len(set(commits.values())) == 2
    # As in a hook of the other repository.
    monkeypatch.setenv("GIT_DIR", str(tmp_path / "other/.git"))
    assert run_facts.commit(tmp_path / "ours") == commits["ours"]
    monkeypatch.setenv("GIT_WORK_TREE", str(tmp_path / "ours"))
    monkeypatch.setenv("GIT_INDEX_FILE", str(tmp_path / "other/.git/index"))
    assert run_facts.commit(tmp_path / "ours") == commits["ours"]


@pytest.mark.parametrize(
    "table",
    [b"", b"s\n", b"seconds\n1.0\n", b"h:m:s\ts\n0:01\n", b"s\nmany\n", b"s\nnan\n", b"s\n\xff\n"],
)
def test_a_damaged_benchmark_is_left_out(table, tmp_path):
    (tmp_path / "good.tsv").write_text("s\th:m:s\n1.5\t0:00:01\n")
    (tmp_path / "bad.tsv").write_bytes(table)
    (tmp_path / "folder.tsv").mkdir()
    assert run_facts.times(tmp_path) == [("good", 1.5)]


def test_what_pip_and_python_write_is_no_source_of_a_run(tmp_path, monkeypatch):
    for name in ("Snakefile", "src/a.py", "src/a.egg-info/SOURCES.txt", "src/__pycache__/a.pyc"):
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text("")
    monkeypatch.chdir(tmp_path)
    assert records.files_of_repository() == ["Snakefile", "src/a.py"]
