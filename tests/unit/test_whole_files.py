"""Files that appear whole or not at all, whoever else writes and however the writing ends."""

import errno
import os

import pytest

from planarimpact.common.files import written


@pytest.fixture
def path(tmp_path):
    return tmp_path / "words.txt"


def test_two_writers_of_one_file_do_not_mix(path):
    with written(path) as first:
        first.write_text("first")
        with written(path) as second:
            second.write_text("second")
        assert path.read_text() == "second" and first.read_text() == "first"
    assert path.read_text() == "first" and os.listdir(path.parent) == ["words.txt"]


def test_a_new_file_has_the_mode_that_open_gives(path):
    plain = path.with_name("plain")
    plain.open("w").close()
    with written(path) as partial:
        partial.write_text("whole")
        assert not partial.parent.stat().st_mode & 0o077  # nobody else reads it before its time
    assert path.stat().st_mode == plain.stat().st_mode


def test_a_link_to_the_file_stays_one(path):
    link = path.with_name("link")
    link.symlink_to(path)
    with written(link) as partial:
        partial.write_text("whole")
    assert link.is_symlink() and path.read_text() == "whole" and not path.is_symlink()


@pytest.mark.parametrize("error", [OSError, KeyboardInterrupt])
def test_an_error_leaves_what_was_there(path, error):
    path.write_text("earlier")
    with pytest.raises(error), written(path) as partial:
        partial.write_text("half")
        raise error
    assert path.read_text() == "earlier" and os.listdir(path.parent) == ["words.txt"]


def test_a_folder_that_nobody_may_write_to_is_named(path, monkeypatch):
    def refuse(folder, mode):
        raise PermissionError(errno.EACCES, "Permission denied", folder)

    monkeypatch.setattr(os, "mkdir", refuse)  # root may write everywhere
    with pytest.raises(PermissionError) as refused, written(path):
        pass
    assert refused.value.filename == str(path.parent)
