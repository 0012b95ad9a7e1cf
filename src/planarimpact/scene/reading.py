"""Tables of scenes read piece by piece, from CSV or Parquet.

`pieces` cuts a table into pieces of whole rows, and leaves the text of CSV alone. `table` reads one
piece, perhaps in another process. pyarrow refuses a row that is too short and a cell that is no
number, but it does not know the number of the line. Such a piece is read once more, row by row.
"""

import csv
import gzip
import io
import zlib
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from itertools import chain, islice
from pathlib import Path
from typing import NamedTuple, TextIO, TypeAlias

import pandas as pd
import pyarrow as pa
import pyarrow.compute
import pyarrow.csv
import pyarrow.parquet

from planarimpact.ground.checks import InputError
from planarimpact.scene import columns, places
from planarimpact.scene.places import Place

SEPARATORS = {";": "semicolons", "\t": "tabs"}


class Text(NamedTuple):
    """Rows as they stand in CSV, blank lines among them; `line` is the number of the first."""

    header: list[str]
    line: int
    body: str


Content: TypeAlias = Text | pa.RecordBatch


class Piece(NamedTuple):
    """Rows of a table.

    There are `rows` of them, after `before` others. `share` of the source is
    read when they are: 0 to 1, or None where nobody knows how much there is, as in a pipe.
    """

    share: float | None
    before: int
    rows: int
    content: Content


def pieces(source: Place, rows: int) -> Iterator[Piece]:
    """Pieces of a table.

    Parameters
    ----------
    source : Place
    rows : int
        Of a piece, at most.

    Yields
    ------
    Piece
        Each has at least one row, but for a table without rows, which is one piece.

    Raises
    ------
    InputError
        If the source is no table, by the number of its line.
    """
    before = 0
    cut = _cut_parquet if source.kind == places.PARQUET else _cut_csv
    for share, count, content in cut(source, rows):
        piece = Piece(share, before, count, content)
        before += count
        if count:
            yield piece
    if not before:
        yield piece


def table(content: Content) -> pd.DataFrame:
    """The table of a piece.

    Parameters
    ----------
    content : Text or RecordBatch

    Returns
    -------
    DataFrame
        A column of CSV where a cell is no number, or inf, is text as it stands: text tells inf from
        1e400.

    Raises
    ------
    InputError
        If a row of CSV has too few or too many cells, by the number of its line.
    """
    if isinstance(content, Text):
        return _read(content).to_pandas(use_threads=False)
    found = pa.Table.from_batches([content])
    read = found.to_pandas(use_threads=False, ignore_metadata=True)
    label = columns.named(found.column_names).get(columns.LABEL)
    if label is not None:  # pandas would write 7 as 7.0 where another cell is empty
        read[label] = pd.Series(pd.arrays.ArrowExtensionArray(_plain(found[label])))
    return read


def _cut_parquet(source: Place, rows: int) -> Iterator[tuple[float, int, pa.RecordBatch]]:
    """Shares that are read, counts of rows, and the rows; the first piece is empty."""
    try:
        with open(source.opened, "rb") as raw, pa.parquet.ParquetFile(raw) as file:
            schema = file.schema_arrow
            label = columns.named(schema.names).get(columns.LABEL)
            if label is not None:
                _refuse_label(label, schema.field(label).type)
            yield 0.0, 0, pa.RecordBatch.from_pylist([], schema)
            done, whole = 0, file.metadata.num_rows
            for batch in file.iter_batches(rows, use_threads=False):
                done += batch.num_rows
                yield done / whole, batch.num_rows, batch
    except (pa.ArrowException, OSError) as error:
        if isinstance(error, OSError) and error.errno:
            raise
        raise InputError(f"it is no whole Parquet file: {str(error).splitlines()[0]}") from None


def _refuse_label(label: str, kind: pa.DataType) -> None:
    """Refuse an id that CSV has no words for."""
    value = kind.value_type if pa.types.is_dictionary(kind) else kind
    text = pa.types.is_string(value) or pa.types.is_large_string(value)
    if not (text or pa.types.is_integer(value)):
        raise InputError(
            f"column {label!r} has cells of type {kind}: allowed are text and integers"
        )


def _plain(cells: pa.ChunkedArray) -> pa.ChunkedArray:
    """The same cells, without a dictionary."""
    return cells.cast(cells.type.value_type) if pa.types.is_dictionary(cells.type) else cells


def _cut_csv(source: Place, rows: int) -> Iterator[tuple[float | None, int, Text]]:
    """As `_cut_parquet`, from CSV."""
    with _opened(source) as (lines, share):
        try:
            line, header = _header(lines)
            columns.named(header)
            line += 1
            yield share(), 0, Text(header, line, "")
            while taken := list(islice(lines, rows)):
                used = len(taken)
                if any('"' in entry for entry in taken):  # a row may have several lines
                    found = list(islice(_rows(chain(taken, lines), line, len(header)), rows))
                    taken = [row.text for row in found]
                    used = sum(row.lines for row in found)
                count = len(taken) - sum(map(str.isspace, taken))
                yield share(), count, Text(header, line, "".join(taken))
                line += used
        except UnicodeDecodeError:
            raise InputError("it is no text in UTF-8") from None
        except (EOFError, zlib.error, gzip.BadGzipFile) as error:
            raise InputError(f"it is no whole gzip file: {error}") from None


@contextmanager
def _opened(source: Place) -> Iterator[tuple[TextIO, Callable[[], float | None]]]:
    """Lines of a source, and a function for the share of it that is read."""
    whole = 0 if source.stream else Path(source.name).stat().st_size
    with open(source.opened, "rb", closefd=isinstance(source.opened, str)) as raw:
        binary = gzip.GzipFile(fileobj=raw) if source.kind == places.GZIP else raw
        with io.TextIOWrapper(binary, encoding="utf-8-sig", newline="") as text:
            yield text, lambda: raw.tell() / whole if whole else None


def _header(lines: Iterable[str]) -> tuple[int, list[str]]:
    """Number of the first line that is not blank, and the names in it."""
    numbered = enumerate(lines, start=1)
    number, line = next((entry for entry in numbered if not entry[1].isspace()), (0, ""))
    if not line:
        raise InputError("it is empty: the first line must name the columns")
    for separator, words in SEPARATORS.items():
        if separator in line:
            raise InputError(
                f"it is separated by {words}; allowed are commas, and points in decimals"
            )
    try:
        (header,) = csv.reader([line], strict=True)
    except csv.Error as error:
        raise _unmatched(number, error) from None
    for cell in header:
        if _is_number(cell):
            raise InputError(f"line {number}: {cell!r} stands where the name of a column belongs")
    return number, header


def _is_number(cell: str) -> bool:
    try:
        float(cell)
    except ValueError:
        return False
    return True


class _Row(NamedTuple):
    """Text of a row, and how many lines it has."""

    text: str
    lines: int


def _rows(lines: Iterable[str], line: int, width: int) -> Iterator[_Row]:
    """Rows of so many cells and blank lines; of the lines the first has the number `line`."""
    taken: list[str] = []  # lines of the row

    def take() -> Iterator[str]:
        for entry in lines:
            taken.append(entry)
            yield entry

    try:
        for cells in csv.reader(take(), strict=True):
            row = _Row("".join(taken), len(taken))
            if len(cells) != width and not row.text.isspace():
                hint = columns.DECIMALS if len(cells) > width else ""
                raise InputError(f"line {line}: {len(cells)} cells where {width} belong{hint}")
            yield row
            line += row.lines
            taken.clear()
    except csv.Error as error:
        raise _unmatched(line, error) from None


def _unmatched(number: int, error: csv.Error) -> InputError:
    return InputError(f"line {number}: its quotation marks do not match ({error})")


def _read(text: Text) -> pa.Table:
    """Rows of CSV: all columns but words are numbers, if all cells of a column are."""
    words = {columns.LABEL, "loss"}
    numbers = [header for name, header in columns.named(text.header).items() if name not in words]
    try:
        found = _parsed(text, numbers)
        if not any(_is_endless(found[name]) for name in numbers):
            return found
    except (
        pa.ArrowInvalid
    ):  # a row that does not fit, blanks in a line, or a cell that is no number
        pass
    rows = _rows(io.StringIO(text.body, newline=""), text.line, len(text.header))
    body = "".join(row.text for row in rows if not row.text.isspace())
    found = _parsed(text._replace(body=body), [])
    for name in numbers:
        found = found.set_column(text.header.index(name), name, _numbers(found[name]))
    return found


def _parsed(text: Text, numbers: list[str]) -> pa.Table:
    """Rows of CSV; the other columns are text."""
    kinds = dict.fromkeys(text.header, pa.string()) | dict.fromkeys(numbers, pa.float64())
    if not text.body or text.body.isspace():
        return pa.schema(kinds).empty_table()
    rows = text.body.encode()
    return pa.csv.read_csv(
        pa.BufferReader(rows),
        # One block has all rows, as no row may stand in two.
        pa.csv.ReadOptions(use_threads=False, block_size=len(rows), column_names=text.header),
        pa.csv.ParseOptions(newlines_in_values=True),
        # Empty cells and words such as NA stay as they are.
        pa.csv.ConvertOptions(column_types=kinds, null_values=[], strings_can_be_null=False),
    )


def _numbers(cells: pa.ChunkedArray) -> pa.ChunkedArray:
    """Text as numbers, if all cells are finite numbers or NaN."""
    try:
        found = cells.cast(pa.float64())
    except pa.ArrowInvalid:
        return cells
    return cells if _is_endless(found) else found


def _is_endless(cells: pa.ChunkedArray) -> bool:
    return bool(pa.compute.any(pa.compute.is_inf(cells)).as_py())
