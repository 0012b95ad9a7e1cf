"""What every job does first: use the sources of this checkout, and send its words to a log."""

import contextlib
import sys
from pathlib import Path

# Those that the rules track, wherever else the package may be installed.
sys.path.insert(0, str(Path(__file__).parents[2] / "src"))


@contextlib.contextmanager
def log_to(path):
    """Send output and errors of a block to a log file; an error also to the terminal, in a line."""
    with open(path, "w", encoding="utf-8") as log:
        try:
            with contextlib.redirect_stdout(log), contextlib.redirect_stderr(log):
                yield
        except Exception as error:
            words = f"{type(error).__name__}: {error}"
            print(words, file=log)
            print(f"{words} (log: {path})", file=sys.stderr)
            raise
