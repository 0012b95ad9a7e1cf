"""Files that appear whole or not at all, and what JSON writes for no number."""

import math
import os
import secrets
import signal
import stat
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from types import FrameType

from planarimpact.ground.checks import InputError

# Signals that end the process, each with its default handler.
SIGNALS = {
    getattr(signal, name): handler
    for name, handler in (
        ("SIGTERM", signal.SIG_DFL),
        ("SIGHUP", signal.SIG_DFL),
        ("SIGINT", signal.default_int_handler),
    )
    if hasattr(signal, name)
}


@contextmanager
def written(path: str | Path) -> Iterator[Path]:
    """Give a path to write to; the file gets its own name when the block ends well.

    Several may write to one path at a time: it has the whole file of the last one.

    Parameters
    ----------
    path : str or Path
        A new file or one that is there, whose mode is kept; links are followed.

    Yields
    ------
    Path
        An empty file beside it that nobody else has. An error, Ctrl-C, SIGTERM or SIGHUP removes
        it. The signals still end the process.

    Raises
    ------
    InputError
        If `path` is there and no regular file, or its folder is not, or links go in a circle.

    Examples
    --------
    >>> import tempfile
    >>> path = Path(tempfile.mkdtemp()) / "words"
    >>> with written(path) as partial:
    ...     _ = partial.write_text("all of them")
    >>> path.read_text(), partial.exists()
    ('all of them', False)
    """
    target = Path(os.path.realpath(path))
    if target.is_symlink():
        raise InputError(f"{path}: it is a symbolic link that leads back to itself")
    if target.exists() and not target.is_file():
        raise InputError(f"{path}: it is there already, and no regular file")
    if not target.parent.is_dir():
        raise InputError(f"{path}: there is no folder {target.parent}")
    # 40 characters of the name leave room: file systems allow 255 bytes.
    partial = target.with_name(f"{target.name[:40]}.{secrets.token_hex(8)}.partial")
    mode = stat.S_IMODE(target.stat().st_mode) if target.exists() else None
    with _unwound_by_signals():
        try:
            # `exist_ok=False` follows no link; a new file has the mode that `open` would give it.
            partial.touch(0o666 if mode is None else 0o600, exist_ok=False)
            yield partial
            if mode is not None:
                partial.chmod(mode)
            partial.replace(target)
        finally:
            partial.unlink(missing_ok=True)


class _Ended(BaseException):
    """A signal that ends the process, raised so that every `finally` runs before."""

    def __init__(self, number: int) -> None:
        self.number = number


@contextmanager
def _unwound_by_signals() -> Iterator[None]:
    """Make signals that would end the process at once raise an exception in the block first.

    Ctrl-C does so anyway; it is among them so that a second one does not interrupt the cleaning
    after the first. Signals that somebody else handles are left alone. Python allows this in the
    main thread only.
    """
    main = threading.current_thread() is threading.main_thread()
    numbers = [n for n, handler in SIGNALS.items() if main and signal.getsignal(n) is handler]

    def leave(number: int, frame: FrameType | None) -> None:
        for n in numbers:  # a second one would interrupt the cleaning
            signal.signal(n, signal.SIG_IGN)
        if number == signal.SIGINT:
            raise KeyboardInterrupt
        raise _Ended(number)

    try:
        try:
            for n in numbers:
                signal.signal(n, leave)
            yield
        finally:
            for n in numbers:
                signal.signal(n, SIGNALS[n])
    except _Ended as ended:
        if ended.number not in numbers:  # of a block around this one, which has files too
            raise
        signal.raise_signal(ended.number)


def or_null(value: object) -> object:
    """A value for JSON, which knows neither NaN nor infinity: None for these.

    Examples
    --------
    >>> [or_null(value) for value in (1.5, float("inf"), "words")]
    [1.5, None, 'words']
    """
    return None if isinstance(value, float) and not math.isfinite(value) else value
