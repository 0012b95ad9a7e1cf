"""Scenes from file to file, piece by piece: from CSV to CSV or JSON."""

import os
import sys
from collections.abc import Callable, Iterator
from contextlib import ExitStack
from pathlib import Path

import pandas as pd

from planarimpact.ground.checks import InputError
from planarimpact.scene import columns, places, reading, writing
from planarimpact.scene.places import Place
from planarimpact.scene.solver import ASSUMED as ASSUMED
from planarimpact.scene.solver import Solver

ROWS = 250_000  # read, solved and written at a time


def solve(
    source: str | Path,
    target: str | Path,
    tolerance: float = 1e-3,
    skip_bad: bool = False,
    rows: int = ROWS,
    progress: Callable[[float | None, int], None] | None = None,
    loss: str | None = None,
) -> Solver:
    """Solve the scene of one file into another, which appears whole or not at all.

    Parameters
    ----------
    source, target : str or Path
        Tables as `solve` takes and returns them: `.csv` or `.csv.gz` by the ending of the name,
        the target also `.json`, an array of objects. `-` is standard input or output; it, pipes
        and devices are CSV, and a target of this kind has each piece as soon as it is solved.
    tolerance : float
        As there.
    skip_bad : bool
        Leave bad rows out instead of refusing the table. They are listed in a file beside the
        target, `<its name>.bad.csv`, unless that is no file, and in `bad` of the result; the list
        is written also where no row is bad.
    rows : int
        How many are held at a time.
    progress : callable, optional
        Called with the share that is done, 0 to 1, or None where nobody knows it, and the impacts
        so far.
    loss : str, optional
        As in `solve`.

    Returns
    -------
    Solver
        With `rows`, `bad` and `explain()`.

    Raises
    ------
    InputError
        As `solve`, or if a file is no table, or cannot be read or written.
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
    solver = Solver(tolerance, loss)
    with ExitStack() as stack:
        write_bad = stack.enter_context(writing.appended(bad)) if bad else None
        with writing.appended(result) as write:
            for share, table in _solved(solver, read, skip_bad, rows):
                write(table)
                if progress:
                    progress(share, solver.rows)
        if write_bad:  # also where there are none: an old list says nothing of a new result
            write_bad(pd.DataFrame(solver.bad, columns=["row", "problem"]))
    return solver


def _same(path: Path, other: Path) -> bool:
    return path.exists() and other.exists() and path.samefile(other)


def _solved(
    solver: Solver, source: Place, skip_bad: bool, rows: int
) -> Iterator[tuple[float | None, pd.DataFrame]]:
    """Pieces of the result; a refusal names the source."""
    try:
        for share, table in reading.pieces(source, rows):
            found = solver.solve(table, skip_bad)
            # A column has one type in all pieces, whatever a piece has in it.
            names = columns.named(table.columns)
            kinds = {names[name]: float for name in (names.keys() & columns.KNOWN) - {"loss"}}
            yield share, found.astype(kinds)
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
