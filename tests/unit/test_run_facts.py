"""On what a run was made: this checkout, whatever git is told."""

import shutil
import subprocess

import pytest

from stronge1994.pages import run_facts


def test_the_commit_is_that_of_the_folder_whatever_git_is_told(tmp_path, monkeypatch):
    assert run_facts.commit(tmp_path) == run_facts.NO_COMMIT
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
    (tmp_path / "ours/inside").mkdir()
    assert run_facts.commit(tmp_path / "ours/inside") == run_facts.NO_COMMIT
    (tmp_path / "ours/file").write_text("new")
    assert run_facts.commit(tmp_path / "ours") == f"{commits['ours']}, with uncommitted changes"
