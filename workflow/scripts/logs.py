"""Where the words of a job go."""

import contextlib
import sys


@contextlib.contextmanager
def to(path):
    """Send output and errors of a block to a log file; an error also to the terminal, in a line."""
    with open(path, "w", encoding="utf-8") as log:
        try:
            with contextlib.redirect_stdout(log), contextlib.redirect_stderr(log):
                yield log
        except Exception as error:
            print(f"{type(error).__name__}: {error}", file=log)
            print(f"{type(error).__name__}: {error} (log: {path})", file=sys.stderr)
            raise
