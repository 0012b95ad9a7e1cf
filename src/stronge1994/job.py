"""What every job does: write to a log, show that it is alive, record what it read and wrote."""

import contextlib
import sys
import threading
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any, TextIO

from stronge1994 import records

# A job says every so many seconds that it is alive. Most jobs end before the first time.
SIGN_OF_LIFE = 5.0


@contextlib.contextmanager
def log_to(path: str) -> Iterator[None]:
    """Send output and errors of a block to a log file; an error also to the terminal, in one line.

    A block that takes long says on the terminal how long it has taken so far.
    """
    terminal, ended = sys.stderr, threading.Event()
    watch = threading.Thread(target=_show_life, args=(Path(path), terminal, ended), daemon=True)
    with open(path, "w", encoding="utf-8") as log:
        watch.start()
        try:
            with contextlib.redirect_stdout(log), contextlib.redirect_stderr(log):
                yield
        except Exception as error:
            words = f"{type(error).__name__}: {error}"
            print(words, file=log)
            print(f"{words} (log: {path})", file=terminal)
            raise
        finally:
            ended.set()
            watch.join()


@contextlib.contextmanager
def recorded(snakemake: Any) -> Iterator[None]:
    """Do a job of Snakemake: its output goes to its log, and what it read and wrote is recorded.

    Raises
    ------
    RuntimeError
        If an input has changed meanwhile: then nobody knows which version the job has read.
    """
    inputs = {path: records.fingerprint(path) for path in snakemake.input}
    with log_to(snakemake.log[0]):
        yield
        for path, before in inputs.items():
            if records.fingerprint(path) != before:
                raise RuntimeError(f"{path} was edited while the job ran: run again")
        records.write(snakemake.output, inputs)


def _show_life(log: Path, terminal: TextIO, ended: threading.Event) -> None:
    began, last_time = time.monotonic(), _last_time(log)
    while not ended.wait(SIGN_OF_LIFE):
        seconds = f"{time.monotonic() - began:.0f} s"
        print(f"... {log.stem}: {seconds}{last_time}", file=terminal, flush=True)


def _last_time(log: Path) -> str:
    """How long the job took in an earlier run, by its benchmark, in words."""
    try:
        with open(log.parents[1] / "benchmarks" / f"{log.stem}.tsv", encoding="utf-8") as file:
            seconds = float(list(file)[1].split("\t")[0])
    except (OSError, IndexError, ValueError):
        return ""
    return f" (the last time it took {seconds:.0f} s)"
