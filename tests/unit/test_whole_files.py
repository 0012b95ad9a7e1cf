"""Files that appear whole or not at all, whoever else writes and however the writing ends."""

import os
import signal
import stat
import subprocess
import sys
import threading

import pytest

from planarimpact.ground.checks import InputError
from planarimpact.ground.files import written


@pytest.fixture
def path(tmp_path):
    return tmp_path / "words.txt"


def mode(path):
    return stat.S_IMODE(path.stat().st_mode)


def test_two_writers_of_one_file_do_not_mix(path):
    with written(path) as first:
        first.write_text("first")
        with written(path) as second:
            second.write_text("second")
        assert path.read_text() == "second" and first.read_text() == "first"
    assert path.read_text() == "first" and os.listdir(path.parent) == ["words.txt"]


def test_a_link_planted_beside_the_file_is_left_alone(path):
    victim = path.with_name("victim")
    victim.write_text("mine")
    path.with_name("words.txt.partial").symlink_to(victim)
    with written(path) as partial:
        partial.write_text("whole")
    assert victim.read_text() == "mine" and path.read_text() == "whole"


@pytest.mark.parametrize("before", [0o640, 0o400])
def test_the_mode_of_an_existing_file_is_kept(path, before):
    path.touch(before)
    path.chmod(before)
    with written(path) as partial:
        partial.write_text("whole")
        assert not mode(partial) & 0o077  # nobody reads it before its time
    assert mode(path) == before and path.read_text() == "whole"


def test_a_new_file_has_the_mode_that_open_gives(path):
    plain = path.with_name("plain")
    plain.open("w").close()
    with written(path) as partial:
        partial.write_text("whole")
    assert mode(path) == mode(plain)


def test_a_link_to_the_file_stays_one(path):
    link = path.with_name("link")
    link.symlink_to(path)
    with written(link) as partial:
        partial.write_text("whole")
    assert link.is_symlink() and path.read_text() == "whole" and not path.is_symlink()


def test_a_long_name_has_room(path):
    long = path.with_name("ü" * 120)
    with written(long) as partial:
        partial.write_text("whole")
    assert long.read_text() == "whole"


@pytest.mark.parametrize("error", [OSError, KeyboardInterrupt])
def test_an_error_leaves_what_was_there(path, error):
    path.write_text("earlier")
    with pytest.raises(error), written(path) as partial:
        partial.write_text("half")
        raise error
    assert path.read_text() == "earlier" and os.listdir(path.parent) == ["words.txt"]


def test_links_that_go_in_a_circle_are_refused(path):
    other = path.with_name("other")
    path.symlink_to(other)
    other.symlink_to(path)
    with pytest.raises(InputError, match="words.txt: .* link"), written(path):
        pytest.fail("it writes")
    assert path.is_symlink() and len(os.listdir(path.parent)) == 2


def test_a_second_interrupt_does_not_interrupt_the_cleaning(path):
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    try:
        with pytest.raises(KeyboardInterrupt), written(path), written(path.with_name("other")):
            try:
                signal.raise_signal(signal.SIGINT)
            finally:
                signal.raise_signal(signal.SIGINT)
                cleaned = True
        assert cleaned and not os.listdir(path.parent)
        assert signal.getsignal(signal.SIGINT) is signal.default_int_handler
    finally:
        signal.signal(signal.SIGINT, before)


# Two files at a time, as a page and its notebook are written.
ENDED = """
import signal, sys
from planarimpact.ground.files import written
number = int(sys.argv[2])
signal.signal(number, signal.SIG_DFL)  # whoever runs the tests may ignore it
with written(sys.argv[1]) as partial, written(sys.argv[1] + ".other") as other:
    partial.write_text("half"), other.write_text("half")
    signal.raise_signal(number)
    print("still here")
"""


@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGHUP])
def test_a_signal_that_ends_the_process_leaves_what_was_there(path, number):
    path.write_text("earlier")
    command = [sys.executable, "-c", ENDED, str(path), str(int(number))]
    result = subprocess.run(command, capture_output=True, text=True)
    assert result.returncode == -number and not result.stdout and not result.stderr
    assert path.read_text() == "earlier" and os.listdir(path.parent) == ["words.txt"]


def test_signals_are_taken_only_where_nobody_else_has_them(path):
    def own(number, frame):
        pass

    before = {n: signal.getsignal(n) for n in (signal.SIGTERM, signal.SIGHUP)}
    try:
        signal.signal(signal.SIGTERM, own)
        signal.signal(signal.SIGHUP, signal.SIG_DFL)
        with written(path) as partial:
            partial.write_text("whole")
            assert signal.getsignal(signal.SIGTERM) is own
            assert signal.getsignal(signal.SIGHUP) is not signal.SIG_DFL
        assert signal.getsignal(signal.SIGTERM) is own
        assert signal.getsignal(signal.SIGHUP) is signal.SIG_DFL
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)


def test_another_thread_may_write(path):
    def write():
        with written(path) as partial:
            partial.write_text("whole")

    thread = threading.Thread(target=write)
    thread.start()
    thread.join()
    assert path.read_text() == "whole"
