"""Tables of scenes in files, piece by piece: CSV, or Parquet where pyarrow is installed."""

import os
import sys
from contextlib import contextmanager
from pathlib import Path

import pandas as pd

from planarimpact.checks import InputError
from planarimpact.scene.solver import Solver

ROWS = 250_000  # read, solved and written at a time


def solve(source, target, tolerance=1e-3, skip_bad=False, rows=ROWS, progress=None):
    """Solve the scene of one file into another, which appears whole or not at all.

    Parameters
    ----------
    source, target : str or Path
        Tables as `planarimpact.scene.solve` takes and returns them; `.parquet` is Parquet, all
        else CSV.
    tolerance : float
        As there.
    skip_bad : bool
        Leave bad rows out and list them in a file beside the target, `<its name>.bad.csv`, instead
        of refusing the table.
    rows : int
        How many are held at a time.
    progress : callable, optional
        Called with the share that is done, 0 to 1, and the impacts so far.

    Returns
    -------
    Solver
        With `rows`, `bad` and `explain()`.

    Raises
    ------
    InputError
        As `planarimpact.scene.solve`, or if a file cannot be read or written.
    """
    source, target = Path(source), Path(target)
    if source.resolve() == target.resolve():
        raise InputError(f"{target}: it is the table that is read; the result needs another name")
    solver = Solver(tolerance)
    try:
        with _written(target) as write:
            for share, table in _pieces(source, rows):
                write(solver.solve(table, skip_bad))
                if progress:
                    progress(share, solver.rows)
    except OSError as error:
        raise InputError(f"{error.filename or source}: {error.strerror or error}") from None
    except InputError as error:
        raise InputError(f"{source}: {error}") from None
    if solver.bad:
        bad = pd.DataFrame(solver.bad, columns=["row", "problem"])
        with _written(target.with_name(f"{target.name}.bad.csv")) as write:
            write(bad)
    return solver


def bar(share, impacts):
    """Draw a bar of progress on the terminal, in place."""
    done = round(30 * share)
    line = f"\r[{'#' * done}{'.' * (30 - done)}] {100 * share:3.0f} %  {impacts:,} impacts"
    print(line, end="\n" if share >= 1 else "", file=sys.stderr, flush=True)


def _pieces(source, rows):
    """Tables of some rows each, with the share of the file read."""
    if source.suffix == ".parquet":
        parquet = _pyarrow_parquet(source).ParquetFile(source)
        whole, so_far = max(parquet.metadata.num_rows, 1), 0
        for batch in parquet.iter_batches(rows):
            so_far += batch.num_rows
            yield so_far / whole, batch.to_pandas()
        if not so_far:
            yield 1.0, parquet.schema_arrow.empty_table().to_pandas()
        return
    whole = max(source.stat().st_size, 1)
    with open(source, "rb") as file:
        try:
            for table in pd.read_csv(file, chunksize=rows):
                yield min(file.tell() / whole, 1.0), table
        except (ValueError, UnicodeError) as error:  # pandas' own errors are among the first
            if isinstance(error, InputError):
                raise
            raise InputError(f"not a table in CSV: {error}") from None


@contextmanager
def _written(target):
    """A function that appends tables to a file; it gets its name when all are written."""
    partial = target.with_name(f"{target.name}.partial")
    writer = _ParquetWriter if target.suffix == ".parquet" else _CsvWriter
    output = writer(partial)
    try:
        yield output.write
        output.close()
        os.replace(partial, target)
    except BaseException:
        output.close()
        partial.unlink(missing_ok=True)
        raise


class _CsvWriter:
    def __init__(self, path):
        self.file = open(path, "w", encoding="utf-8", newline="")  # noqa: SIM115 (closed by close)
        self.first = True

    def write(self, table):
        table.to_csv(self.file, index=False, header=self.first, lineterminator="\n")
        self.first = False

    def close(self):
        self.file.close()


class _ParquetWriter:
    def __init__(self, path):
        self.arrow, self.path, self.writer = _pyarrow_parquet(path), path, None

    def write(self, table):
        import pyarrow

        content = pyarrow.Table.from_pandas(table, preserve_index=False)
        if self.writer is None:
            self.writer = self.arrow.ParquetWriter(self.path, content.schema)
        self.writer.write_table(content)

    def close(self):
        if self.writer is not None:
            self.writer.close()


def _pyarrow_parquet(path):
    try:
        from pyarrow import parquet
    except ImportError:
        raise InputError(
            f"{path}: Parquet needs pyarrow: pip install pyarrow, or use CSV"
        ) from None
    return parquet
