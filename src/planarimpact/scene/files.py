"""Scenes from file to file, piece by piece: CSV or Parquet, and JSON for the result."""

import os
import sys
import time
from collections.abc import Callable, Generator, Iterator
from contextlib import ExitStack, closing
from pathlib import Path

from planarimpact.collision import TOLERANCE
from planarimpact.ground import checks
from planarimpact.ground.checks import InputError
from planarimpact.scene import columns, places
from planarimpact.scene.places import Place
from planarimpact.scene.solver import Solver

try:
    import pandas as pd

    from planarimpact.scene import reading, writing
except ImportError as error:
    message = "planarimpact.scene.files needs pandas and pyarrow: pip install 'planarimpact[scene]'"
    raise ImportError(f"{message} ({error})", name=error.name) from None

from planarimpact.scene.reading import Piece
from planarimpact.scene.workers import Cut, Done, Task, solved_by_workers, solved_here

# Rows that are read, solved and written at a time. Less would take longer, more would take memory.
ROWS = 100_000
# Each worker takes some 0.3 GB: a larger number is probably a typing error.
MOST_WORKERS = 64
# A piece for which the continuum is solved more often is cut into parts of about so many impacts.
# They take some seconds each; less would take longer, as NumPy solves many at a time.
PART = 1000
# From this time on it is told why a table takes so long [s].
LONG = 5.0


def solve(
    source: str | Path,
    target: str | Path,
    tolerance: float = TOLERANCE,
    skip_bad: bool = False,
    rows: int = ROWS,
    progress: Callable[[float | None, int], None] | None = None,
    loss: str | None = None,
    workers: int = 1,
    notice: Callable[[str], None] | None = None,
) -> Solver:
    """Solve the scene of one file into another, which appears whole or not at all.

    Parameters
    ----------
    source, target : str or Path
        Tables as `solve` takes and returns them: `.csv`, `.csv.gz` or `.parquet` by the ending of
        the name, the target also `.json`, an array of objects. `-` is standard input or output;
        it, pipes and devices are CSV, and a target of this kind has each piece as soon as it is
        solved. NaN is an empty cell in CSV, else null.
    tolerance : float
        As in `solve`.
    skip_bad : bool
        Leave bad rows out instead of refusing the table. They are listed in a file beside the
        target, `<its name>.bad.csv`, unless that is no file, and in `bad` of the result; the list
        is written also where no row is bad.
    rows : int
        How many a process holds at a time.
    progress : callable, optional
        Called with the share that is done, 0 to 1, or None where nobody knows it, and the rows so
        far: every 1000 impacts or so where the continuum is solved, else with each piece.
    loss : str, optional
        As in `solve`.
    workers : int
        How many processes share the pieces, 1 to 64; with 1 it is this process alone. The result is
        the same. This process reads and writes, which takes some 3 s for a million rows of CSV. A
        script that calls this with more than one stands below `if __name__ == "__main__":`, as
        each worker reads it too.
    notice : callable, optional
        Called with a line of text: which columns are not known and so are carried over, and, if
        solving is expected to take more than some seconds, why, how long, and which tolerance would
        avoid it. The time is that of the first 1000 impacts or so for which the continuum is
        solved, times how many there would be if the rest were like this piece.

    Returns
    -------
    Solver
        With `rows`, `bad` and `explain()`.

    Raises
    ------
    InputError
        As `solve`, or if a file is no table, has no rows, or cannot be read or written, or a worker
        ends before its work is done. Row 1 is the first one below the header; blank lines do not
        count.
    ConvergenceError
        As `solve`.
    """
    read, result = places.source(source), places.target(target)
    bad = places.beside(result) if skip_bad else None
    for place in (result, bad):
        if place and not read.stream and _same(Path(place.name), Path(read.name)):
            raise InputError(
                f"{place.name}: it is the table that is read; the result needs another name"
            )
    if bad and os.path.realpath(bad.name) == os.path.realpath(result.name):
        raise InputError(
            f"{bad.name}: it is a link to the result; bad rows need a file of their own"
        )
    workers = checks.count("workers", workers, 1, MOST_WORKERS)
    task, solver = Task(tolerance, loss, skip_bad, result.kind, PART), Solver(tolerance, loss)
    notice, slow = notice or _silent, _Slow(workers)
    with ExitStack() as stack:
        write_bad = stack.enter_context(writing.appended(bad)) if bad else None
        with (
            writing.appended(result) as write,
            closing(_solved(task, read, rows, workers, notice)) as pieces,
        ):
            for piece in pieces:
                if words := slow.words(piece):
                    notice(words)
                if isinstance(piece, Cut):
                    continue
                write(piece.content)
                solver.join(piece.solver)
                if progress:
                    progress(piece.share, solver.rows)
        if bad and write_bad:  # also without a bad row: an old list is not about the new result
            table = pd.DataFrame(solver.bad, columns=["row", "problem"])
            write_bad(writing.encoded(table, bad.kind, header=True))
    return solver


def _same(path: Path, other: Path) -> bool:
    return path.exists() and other.exists() and path.samefile(other)


def _silent(words: str) -> None:
    """Say nothing."""


def _solved(
    task: Task, source: Place, rows: int, workers: int, notice: Callable[[str], None]
) -> Generator[Done | Cut, None, None]:
    """Solved pieces, in order; a refusal names the source."""
    try:
        pieces = _with_notice(reading.pieces(source, rows), notice)
        if workers == 1:
            yield from solved_here(task, pieces)
        else:
            yield from solved_by_workers(task, pieces, workers)
    except InputError as error:
        raise InputError(f"{source.name}: {error}") from None
    except OSError as error:
        raise InputError(f"{source.name}: {error.strerror or error}") from None


def _with_notice(pieces: Iterator[Piece], notice: Callable[[str], None]) -> Iterator[Piece]:
    """The pieces, and a notice of the columns that are carried over."""
    told = False
    for piece in pieces:
        own = [name for name in columns.carried(piece.rows.column_names) if name != columns.LABEL]
        if own and not told:
            notice(f"not known, and carried over as they are: columns {', '.join(map(repr, own))}")
        told = True
        yield piece


class _Slow:
    """Words about the first piece that takes long, once its first part is solved."""

    def __init__(self, workers: int) -> None:
        self.workers, self.start = workers, 0.0
        self.cut: Cut | None = None

    def words(self, result: Done | Cut) -> str:
        """A line after the first part of the first piece that is cut, else nothing."""
        if isinstance(result, Cut):
            if not self.start:
                self.cut, self.start = result, time.perf_counter()
            return ""
        cut, self.cut = self.cut, None
        if not cut:
            return ""
        # A worker has one part, and at the same time the others have more.
        taken = (time.perf_counter() - self.start) * (len(cut.cuts) + 1) / self.workers
        reach = "for them"
        if cut.since is not None and cut.share is not None:
            taken *= (1 - cut.since) / (cut.share - cut.since)
            reach = "from there to the end"
        if taken < LONG:
            return ""
        return f"{cut.words}; about {_duration(taken)} {reach}, at the speed of the first of them"


def _duration(seconds: float) -> str:
    """A time in seconds, minutes or hours.

    >>> _duration(12.3), _duration(2400), _duration(9000)
    ('12 s', '40 min', '2.5 h')
    """
    if seconds < 100:
        return f"{seconds:.0f} s"
    return f"{seconds / 60:.0f} min" if seconds < 6000 else f"{seconds / 3600:.1f} h"


class Bar:
    """Draws progress on the terminal, in place, with the time that is left; a line if no share."""

    def __init__(self) -> None:
        self.start = time.perf_counter()

    def __call__(self, share: float | None, rows: int) -> None:
        """Show the share that is done, and the rows so far."""
        if share is None:
            print(f"{rows:,} impacts", file=sys.stderr, flush=True)
            return
        done, left = round(30 * share), ""
        if 0 < share < 1:  # if the rest takes as long as what is done
            taken = time.perf_counter() - self.start
            left = f", about {_duration(taken * (1 - share) / share)} left"
        line = f"[{'#' * done}{'.' * (30 - done)}] {100 * share:3.0f} %  {rows:,} impacts{left}"
        print(f"\r{line:<79}", end="\n" if share >= 1 else "", file=sys.stderr, flush=True)
