"""On what a run was made: this checkout, whatever git is told."""

import subprocess

from stronge1994 import versions
from tests import programs


def test_the_commit_is_that_of_the_folder_whatever_git_is_told(tmp_path, monkeypatch):
    assert versions.commit(tmp_path) == versions.NO_COMMIT
    program, commits = programs.needed("the commit of a checkout"), {}
    for name in ("ours", "other"):
        git = [program, "-C", str(tmp_path / name), "-c", "user.name=a", "-c", "user.email=a@b"]
        (tmp_path / name).mkdir()
        for command in (["init", "-q"], ["commit", "-q", "--allow-empty", "-m", name]):
            subprocess.run([*git, *command], check=True)
        commits[name] = versions.commit(tmp_path / name)
    assert len(set(commits.values())) == 2
    # As in a hook of the other repository.
    monkeypatch.setenv("GIT_DIR", str(tmp_path / "other/.git"))
    assert versions.commit(tmp_path / "ours") == commits["ours"]
    monkeypatch.setenv("GIT_WORK_TREE", str(tmp_path / "ours"))
    monkeypatch.setenv("GIT_INDEX_FILE", str(tmp_path / "other/.git/index"))
    assert versions.commit(tmp_path / "ours") == commits["ours"]
    (tmp_path / "ours/inside").mkdir()
    assert versions.commit(tmp_path / "ours/inside") == versions.NO_COMMIT
    (tmp_path / "ours/file").write_text("new")
    assert versions.commit(tmp_path / "ours") == f"{commits['ours']}, with uncommitted changes"
    monkeypatch.setenv("PATH", "")
    assert versions.commit(tmp_path / "ours") == versions.NO_COMMIT
