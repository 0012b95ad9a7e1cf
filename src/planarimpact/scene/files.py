"""Scenes from file to file, piece by piece: CSV or Parquet, and JSON for the result."""

import os
import sys
from collections.abc import Callable, Generator
from contextlib import ExitStack, closing
from pathlib import Path

import pandas as pd

from planarimpact.ground import checks
from planarimpact.ground.checks import InputError
from planarimpact.scene import places
from planarimpact.scene.places import Place
from planarimpact.scene.solver import Solver

try:
    from planarimpact.scene import reading, writing
except ImportError as error:
    message = f"planarimpact.scene.files needs pyarrow: pip install 'planarimpact[scene]' ({error})"
    raise ImportError(message, name=error.name) from None

from planarimpact.scene.workers import Done, Task, solved, solved_by_workers

# Rows that are read, solved and written at a time. Less would take longer, more would take memory.
ROWS = 100_000
# Each worker takes some 0.3 GB: a larger number is probably a typing error.
MOST_WORKERS = 64


def solve(
    source: str | Path,
    target: str | Path,
    tolerance: float = 1e-3,
    skip_bad: bool = False,
    rows: int = ROWS,
    progress: Callable[[float | None, int], None] | None = None,
    loss: str | None = None,
    workers: int = 1,
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
        Called with the share that is done, 0 to 1, or None where nobody knows it, and the impacts
        so far.
    loss : str, optional
        As in `solve`.
    workers : int
        How many processes share the pieces, 1 to 64; with 1 it is this process alone. The result is
        the same. This process reads and writes, which takes some 3 s for a million rows of CSV. A
        script that calls this with more than one stands below `if __name__ == "__main__":`, as
        each worker reads it too.

    Returns
    -------
    Solver
        With `rows`, `bad` and `explain()`.

    Raises
    ------
    InputError
        As `solve`, or if a file is no table, or cannot be read or written, or a worker ends before
        its work is done.
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
    task, solver = Task(tolerance, loss, skip_bad, result.kind), Solver(tolerance, loss)
    with ExitStack() as stack:
        write_bad = stack.enter_context(writing.appended(bad)) if bad else None
        with (
            writing.appended(result) as write,
            closing(_solved(task, read, rows, workers)) as pieces,
        ):
            for piece in pieces:
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


def _solved(task: Task, source: Place, rows: int, workers: int) -> Generator[Done, None, None]:
    """Solved pieces, in order; a refusal names the source."""
    try:
        pieces = reading.pieces(source, rows)
        if workers == 1:
            yield from (solved(task, piece) for piece in pieces)
        else:
            yield from solved_by_workers(task, pieces, workers)
    except InputError as error:
        raise InputError(f"{source.name}: {error}") from None
    except OSError as error:
        raise InputError(f"{source.name}: {error.strerror or error}") from None


def bar(share: float | None, impacts: int) -> None:
    """Draw a bar of progress on the terminal, in place; a line each time if no share is known."""
    if share is None:
        print(f"{impacts:,} impacts", file=sys.stderr, flush=True)
        return
    done = round(30 * share)
    line = f"\r[{'#' * done}{'.' * (30 - done)}] {100 * share:3.0f} %  {impacts:,} impacts"
    print(line, end="\n" if share >= 1 else "", file=sys.stderr, flush=True)
