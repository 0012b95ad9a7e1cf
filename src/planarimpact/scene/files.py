"""Scenes from file to file, a part at a time: tables may be larger than the memory."""

import codecs
import csv
import gzip
import io
import re
import zlib
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from itertools import chain
from pathlib import Path
from typing import Any

from planarimpact.collision import TOLERANCE
from planarimpact.common import checks, csv_text, files
from planarimpact.common.checks import InputError
from planarimpact.scene import columns
from planarimpact.scene.solver import BLOCK, Solver

try:
    import pandas as pd
    import pyarrow as pa
    import pyarrow.compute
    import pyarrow.csv
    import pyarrow.parquet
except ImportError as error:
    message = "planarimpact.scene.files needs pandas and pyarrow: pip install 'planarimpact[scene]'"
    raise ImportError(f"{message} ({error})", name=error.name) from None

# What readers raise where a file is no table, beside an OSError without a number.
NO_TABLE = InputError, UnicodeError, EOFError, zlib.error, pa.ArrowException
KINDS = CSV, GZIP, PARQUET = ".csv", ".csv.gz", ".parquet"
# Standard input or output.
STREAM = "-"
# What is read at a time: bytes of CSV, rows of Parquet.
BYTES, ROWS = 2**22, BLOCK
HEAD = 2**22  # bytes that hold the header
# A cell of CSV in quotation marks, and what stands where it ends: nothing where that is not read.
QUOTED = re.compile(rb'"(?<![^,\r\n]")(?:[^"]|"")*+(?P<end>("[^"]?)?)')
SEPARATORS = b"", b",", b"\r", b"\n"


def solve(
    source: str | Path,
    target: str | Path,
    tolerance: float = TOLERANCE,
    skip_bad: bool = False,
    loss: str | None = None,
    notice: Callable[[str], None] | None = None,
) -> Solver:
    """Solve the scene of one file into another, which appears whole or not at all.

    Parameters
    ----------
    source, target : str or Path
        Tables as `solve` takes and returns them: `.csv`, `.csv.gz` or `.parquet` by the ending of
        the name, or `-`, standard input or output, which is CSV and has each part as soon as it is
        solved. NaN is an empty cell in CSV. Cells of columns that are not known are carried over
        as they are, from CSV as text.
    tolerance, loss : float, str
        As in `solve`.
    skip_bad : bool
        Leave bad rows out, also those with the wrong number of cells, instead of refusing the
        table. They are in `bad` of the result, and in a file next to the target,
        `<its name>.bad.csv`, which is written also if no row is bad.
    notice : callable, optional
        Called with a line of text: which columns are not known.

    Returns
    -------
    Solver
        With `rows`, `bad` and `explain()`.

    Raises
    ------
    InputError
        As `solve`, or if a file is no table or has no rows. Row 1 is the first one below the
        header; blank lines do not count.
    ConvergenceError
        As `solve`.
    OSError
        If a file cannot be read or written.
    """
    source, target = _checked(source), _checked(target)
    lists = [f"{target}.bad.csv"] if skip_bad and target != STREAM else []  # of bad rows
    for path in (target, *lists):
        if STREAM not in (source, path) and Path(path).exists() and Path(path).samefile(source):
            raise InputError(f"{path}: it is the table that is read; the result needs another name")
    solver = Solver(tolerance, loss)
    with ExitStack() as stack:
        partial = [stack.enter_context(files.written(path)) for path in lists]
        write = stack.enter_context(_writer(target))
        for part in _solved(solver, source, skip_bad, notice):
            write(part)
        for file in partial:  # also without a bad row: an old list is not about the new result
            pd.DataFrame(solver.bad, columns=["row", "problem"]).to_csv(file, index=False)
    return solver


def _checked(path: str | Path) -> str:
    """A name that shows the kind of its table."""
    name = str(path)
    if name != STREAM and not name.lower().endswith(KINDS):
        raise InputError(
            f"{checks.in_ascii(name)}: allowed are names that end in {', '.join(KINDS)}, and "
            f"{STREAM} for standard input or output"
        )
    return name


def _solved(
    solver: Solver, source: str, skip_bad: bool, notice: Callable[[str], None] | None
) -> Iterator[pd.DataFrame]:
    """Solved parts of a table; a refusal names the file."""
    skipped: dict[int, str] = {}  # rows that are no rows, by number
    try:
        for part in _parts(source, skipped.__setitem__ if skip_bad else None):
            if not (part.num_rows or skipped):
                continue
            table = part.to_pandas(types_mapper=pd.ArrowDtype, ignore_metadata=True)
            names = columns.named(table)
            own = [ascii(name) for name in table if name not in {*names.values(), columns.LABEL}]
            if notice and own and not solver.rows:
                notice(f"not known, and carried over as they are: columns {', '.join(own)}")
            after = solver.solve(table, skip_bad)
            # A column has one type in all parts, whatever a part has in it.
            yield after.astype({names[name]: float for name in names.keys() - {"loss"}})
        if not solver.rows + len(skipped):
            raise InputError("it has a header, but no rows")
        solver.insert_bad(skipped)
    except (*NO_TABLE, OSError) as error:
        if isinstance(error, OSError) and error.errno:
            raise
        name = "standard input" if source == STREAM else source
        words, *_ = str(error).splitlines() or [type(error).__name__]
        raise InputError(f"{name}: {checks.in_ascii(words)}") from None


def _parts(source: str, skip: Callable[[int, str], None] | None) -> Iterator[pa.Table]:
    """Parts of a table, see `_of_csv`."""
    opened = 0 if source == STREAM else source
    with open(opened, "rb", closefd=source != STREAM) as raw:
        if source.lower().endswith(PARQUET):
            for batch in pa.parquet.ParquetFile(raw).iter_batches(ROWS, use_threads=False):
                yield pa.Table.from_batches([batch])
        elif source.lower().endswith(GZIP):
            with gzip.open(raw) as unpacked:
                yield from _of_csv(unpacked, skip)
        else:
            yield from _of_csv(raw, skip)


class _Checked:
    """Bytes of CSV, looked at as they are read: Arrow itself takes the cell "0.1"5 for 0.15."""

    closed = False  # Arrow asks

    def __init__(self, file: Any) -> None:
        self._file, self._rest, self._ended = file, b"", False
        begin = file.read(HEAD).removeprefix(codecs.BOM_UTF8)
        self._begin = begin.lstrip()
        self.line = 1 + begin[: len(begin) - len(self._begin)].count(b"\n")
        whole = self._begin[: _end_of_lines(self._begin)] or self._begin
        self.header = csv_text.header(csv_text.decoded(whole, self.line))

    def read(self, size: int) -> bytes:
        """The next bytes, after a look at all lines that end in them."""
        part, self._begin = self._begin[:size], self._begin[size:]
        if len(part) < size:
            part += self._file.read(size - len(part))
        if len(part) < size and not self._ended:  # else Arrow takes a header alone for half a line
            part, self._ended = part + b"\n", True
        text = self._rest + part
        end = _end_of_lines(text) if part else len(text)
        if not text.isascii():  # both looks take their time
            csv_text.decoded(text[:end], self.line)
        for cell in QUOTED.finditer(text, 0, end) if b'"' in text else ():
            line = self.line + text[: cell.start()].count(b"\n")
            if not cell["end"] and part:  # it has line breaks, and goes on
                end = cell.start()
            elif not cell["end"]:
                raise InputError(f"line {line}: a quotation mark is not closed")
            elif cell["end"][1:] not in SEPARATORS:
                shown = ascii(cell[0].decode(errors="replace"))[:60]
                words = "allowed is a comma behind a closing quotation mark"
                raise InputError(f"line {line}: {shown}: {words}")
        self.line, self._rest = self.line + text[:end].count(b"\n"), text[end:]
        return part


def _end_of_lines(text: bytes) -> int:
    """Where the last line ends that is whole."""
    return max(text.rfind(b"\n"), text.rfind(b"\r")) + 1


def _of_csv(file: Any, skip: Callable[[int, str], None] | None) -> Iterator[pa.Table]:
    """Parts of CSV: known columns as numbers if all cells are finite numbers, all else as text.

    `skip` gets the number of a row with too many or too few cells, which is left out, and why.
    """
    checked = _Checked(file)
    known = columns.named(checked.header)
    problems: list[str] = []
    blank = 0  # lines, which Arrow counts if they have blanks

    def refused(row: pa.csv.InvalidRow) -> str:
        """What to do with a row that has another number of cells than the header."""
        nonlocal blank
        if not row.text.strip(' \t\r\n"'):
            blank += 1
            return "skip"
        hint = columns.DECIMALS if row.actual_columns > row.expected_columns else ""
        cells = f"{row.actual_columns} cells where {row.expected_columns} belong{hint}"
        number = row.number - 1 - blank  # the header is row 1 of Arrow
        if skip:
            skip(number, cells)
            return "skip"
        problems.append(f"row {number}: {cells}")
        return "error"

    try:
        # One thread numbers the rows. Empty cells and words such as NA stay as they are.
        batches = pa.csv.open_csv(
            checked,
            pa.csv.ReadOptions(
                use_threads=False,
                block_size=BYTES,
                column_names=checked.header,
                skip_rows_after_names=1,
            ),
            pa.csv.ParseOptions(newlines_in_values=True, invalid_row_handler=refused),
            pa.csv.ConvertOptions(
                column_types=dict.fromkeys(checked.header, pa.string()),
                null_values=[],
                strings_can_be_null=False,
            ),
        )
        # A last part without rows: a table of bad rows alone has a result, too.
        for batch in chain(batches, [pa.RecordBatch.from_pylist([], batches.schema)]):
            numbers = {known[name] for name in known.keys() - {"loss"}}
            cells = [
                _numbers(column) if name in numbers else column
                for name, column in zip(checked.header, batch.columns, strict=True)
            ]
            yield pa.Table.from_arrays(cells, checked.header)
    except pa.ArrowInvalid as error:
        if "straddling" in str(error):
            problems = [f"line {checked.line}: more than {BYTES} bytes; is a quotation mark open?"]
        raise InputError(problems[0] if problems else str(error)) from None


def _numbers(cells: pa.Array) -> pa.Array:
    """Text as numbers if all are finite or NaN, else as it is, as text tells inf from 1e400."""
    try:
        numbers = pa.compute.ascii_trim_whitespace(cells).cast(pa.float64())
    except pa.ArrowInvalid:
        return cells
    return cells if pa.compute.any(pa.compute.is_inf(numbers)).as_py() else numbers


@contextmanager
def _writer(target: str) -> Iterator[Callable[[pd.DataFrame], None]]:
    """A function that writes part after part of a table."""
    with ExitStack() as stack:
        opened: Any = 1 if target == STREAM else stack.enter_context(files.written(target))
        file: Any = stack.enter_context(open(opened, "wb", closefd=target != STREAM))
        if target.lower().endswith(GZIP):
            # Without a name and a time: the same table is the same file.
            file = stack.enter_context(gzip.GzipFile("", "wb", 6, file, mtime=0))
        writer: Any = None

        def write(part: pd.DataFrame) -> None:
            nonlocal writer
            rows = pa.Table.from_pandas(part, preserve_index=False).replace_schema_metadata()
            try:
                writer = writer or stack.enter_context(_begun(file, target, rows.schema))
                writer.write_table(rows)
            except pa.ArrowException as error:  # a column of the user that CSV has no text for
                raise InputError(f"{target}: {error}") from None

        yield write


def _begun(file: Any, target: str, schema: pa.Schema) -> Any:
    """A writer of tables. CSV has a header without quotation marks, and text in them."""
    if target.lower().endswith(PARQUET):
        return pa.parquet.ParquetWriter(file, schema)
    names = io.StringIO()
    csv.writer(names, lineterminator="\n").writerow(schema.names)
    file.write(names.getvalue().encode())
    return pa.csv.CSVWriter(file, schema, write_options=pa.csv.WriteOptions(include_header=False))
