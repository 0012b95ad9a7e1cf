"""Tables of scenes in files, piece by piece: CSV, or Parquet where pyarrow is installed.

Results may be JSON too.
"""

import json
import sys
import warnings
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from types import ModuleType
from typing import Any

import pandas as pd

from planarimpact import whole_files
from planarimpact.checks import InputError
from planarimpact.scene import columns
from planarimpact.scene.solver import Solver

ROWS = 250_000  # read, solved and written at a time


def solve(
    source: str | Path,
    target: str | Path,
    tolerance: float = 1e-3,
    skip_bad: bool = False,
    rows: int = ROWS,
    progress: Callable[[float, int], None] | None = None,
) -> Solver:
    """Solve the scene of one file into another, which appears whole or not at all.

    Parameters
    ----------
    source, target : str or Path
        Tables as `planarimpact.scene.solve` takes and returns them; `.parquet` is Parquet, a
        target `.json` an array of objects, all else CSV.
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
    ConvergenceError
        As `planarimpact.scene.solve`.
    """
    source, target = Path(source), Path(target)
    if not target.name:
        raise InputError(f"{target}: it is no name of a file")
    bad = target.with_name(f"{target.name}.bad.csv")
    for path in (target, bad):
        if path.exists() and source.exists() and path.samefile(source):
            raise InputError(f"{path}: it is the table that is read; the result needs another name")
    solver = Solver(tolerance)
    try:
        with _appended(target) as write:
            for share, table in _pieces(source, rows):
                write(_solved(solver, table, skip_bad))
                if progress:
                    progress(share, solver.rows)
            if solver.bad:
                with _appended(bad) as write_bad:
                    write_bad(pd.DataFrame(solver.bad, columns=["row", "problem"]))
            elif bad.is_file():  # of an earlier run
                bad.unlink()
    except OSError as error:
        raise InputError(f"{error.filename or source}: {error.strerror or error}") from None
    except _RefusedTable as error:
        raise InputError(f"{source}: {error}") from None
    return solver


def _solved(solver: Solver, table: pd.DataFrame, skip_bad: bool) -> pd.DataFrame:
    try:
        return solver.solve(table, skip_bad)
    except InputError as error:
        raise _RefusedTable(str(error)) from None


class _RefusedTable(InputError):
    """Something in the table that is read, which the message does not name."""


def bar(share: float, impacts: int) -> None:
    """Draw a bar of progress on the terminal, in place."""
    done = round(30 * share)
    line = f"\r[{'#' * done}{'.' * (30 - done)}] {100 * share:3.0f} %  {impacts:,} impacts"
    print(line, end="\n" if share >= 1 else "", file=sys.stderr, flush=True)


def _pieces(source: Path, rows: int) -> Iterator[tuple[float, pd.DataFrame]]:
    """Tables of some rows each, with the share of the file read."""
    if _is_parquet(source):
        yield from _parquet_pieces(source, rows)
        return
    whole = max(source.stat().st_size, 1)
    with open(source, "rb") as file, warnings.catch_warnings():
        warnings.simplefilter("error", pd.errors.ParserWarning)  # rows that are too long
        try:
            reader = pd.read_csv(file, chunksize=rows, index_col=False, dtype={columns.LABEL: str})
            for table in reader:
                yield min(file.tell() / whole, 1.0), table
        except (ValueError, pd.errors.ParserWarning) as error:  # pandas' own are among the first
            words = f"{error}".strip().splitlines()[-1]
            raise _RefusedTable(f"no table in CSV, separated by commas: {words}") from None


def _parquet_pieces(source: Path, rows: int) -> Iterator[tuple[float, pd.DataFrame]]:
    parquet = _pyarrow_parquet(source)
    try:
        file = parquet.ParquetFile(source)
    except ValueError as error:
        raise _RefusedTable(f"no Parquet file: {error}") from None
    whole, so_far = max(file.metadata.num_rows, 1), 0
    for batch in file.iter_batches(rows):
        so_far += batch.num_rows
        yield so_far / whole, batch.to_pandas()
    if not so_far:
        yield 1.0, file.schema_arrow.empty_table().to_pandas()


@contextmanager
def _appended(target: Path) -> Iterator[Callable[[pd.DataFrame], None]]:
    """A function that appends tables to a file; it gets its name when all are written."""
    with whole_files.written(target) as partial:
        writers: dict[str, type[_CsvWriter | _JsonWriter | _ParquetWriter]] = {
            ".parquet": _ParquetWriter,
            ".json": _JsonWriter,
        }
        output = writers.get(target.suffix.lower(), _CsvWriter)(partial, target)
        try:
            yield output.write
        finally:
            output.close()


def _is_parquet(path: Path) -> bool:
    return path.suffix.lower() == ".parquet"


class _CsvWriter:
    def __init__(self, path: Path, target: Path) -> None:
        self.file = open(path, "w", encoding="utf-8", newline="")  # noqa: SIM115 (see close)
        self.first = True

    def write(self, table: pd.DataFrame) -> None:
        table.to_csv(self.file, index=False, header=self.first, lineterminator="\n")
        self.first = False

    def close(self) -> None:
        self.file.close()


class _JsonWriter:
    """An array of objects, one a line; what is no finite number is null."""

    def __init__(self, path: Path, target: Path) -> None:
        self.file = open(path, "w", encoding="utf-8")  # noqa: SIM115 (see close)
        self.before = "[\n"

    def write(self, table: pd.DataFrame) -> None:
        for row in table.astype(object).to_dict("records"):
            plain = {name: whole_files.or_null(cell) for name, cell in row.items()}
            self.file.write(self.before + json.dumps(plain))
            self.before = ",\n"

    def close(self) -> None:
        self.file.write("[]\n" if self.before == "[\n" else "\n]\n")
        self.file.close()


class _ParquetWriter:
    def __init__(self, path: Path, target: Path) -> None:
        self.parquet, self.path = _pyarrow_parquet(target), path
        self.writer: Any = None

    def write(self, table: pd.DataFrame) -> None:
        import pyarrow

        if columns.LABEL in table:  # of one type, whatever the part of the table
            table = table.astype({columns.LABEL: str})
        schema = None if self.writer is None else self.writer.schema
        content = pyarrow.Table.from_pandas(table, schema, preserve_index=False)
        if self.writer is None:
            self.writer = self.parquet.ParquetWriter(self.path, content.schema)
        self.writer.write_table(content)

    def close(self) -> None:
        if self.writer is not None:
            self.writer.close()


def _pyarrow_parquet(path: Path) -> ModuleType:
    try:
        from pyarrow import parquet
    except ImportError:
        raise InputError(
            f"{path}: Parquet needs pyarrow: pip install pyarrow, or use CSV"
        ) from None
    return parquet
