"""Tables of scenes read piece by piece, from CSV or Parquet.

CSV is cut into whole rows here, read by pyarrow as text, and each column becomes numbers if all of
its cells are numbers. pyarrow does not say which row has too few or too many cells. Such a piece is
read once more by the module csv, and so is a piece with quotation marks, as pyarrow accepts also
marks that do not match.
"""

import csv
import gzip
import io
import zlib
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from itertools import islice, pairwise
from pathlib import Path
from typing import NamedTuple

import pandas as pd
import pyarrow as pa
import pyarrow.compute
import pyarrow.csv
import pyarrow.parquet

from planarimpact.ground.checks import InputError
from planarimpact.scene import columns, places
from planarimpact.scene.places import Place

SEPARATORS = {";": "semicolons", "\t": "tabs"}
# A cell has fewer lines than this. It bounds what one quotation mark without a second one reads.
MOST_LINES = 10_000


class Piece(NamedTuple):
    """Rows of a table, after `before` others.

    `share` of the source is read when they are, `since` before: 0 to 1, or None where nobody knows
    how much there is, as in a pipe. A column of CSV that has a cell that is no finite number is
    text as it stands, and so are columns that are carried over: text tells inf from 1e400.
    """

    since: float | None
    share: float | None
    before: int
    rows: pa.Table

    def table(self) -> pd.DataFrame:
        """The rows for pandas."""
        table = self.rows.to_pandas(use_threads=False, ignore_metadata=True)
        for name in columns.carried(self.rows.column_names):
            # pandas would write 7 as 7.0 where another cell is empty.
            table[name] = pd.Series(pd.arrays.ArrowExtensionArray(_plain(self.rows[name])))
        return table

    def parts(self, cuts: list[int]) -> list["Piece"]:
        """The piece in parts; `cuts` are the first rows of all but the first one."""
        shares = [self.share] * (len(cuts) + 1)
        if self.since is not None and self.share is not None:
            steps = range(1, len(shares))
            shares[:-1] = [self.since + (self.share - self.since) * k / len(shares) for k in steps]
        rows = [self.rows.slice(a, b - a) for a, b in pairwise([0, *cuts, len(self.rows)])]
        return [
            Piece(since, share, self.before + first, part)
            for since, share, first, part in zip(
                [self.since, *shares], shares, [0, *cuts], rows, strict=False
            )
        ]


def pieces(source: Place, rows: int) -> Iterator[Piece]:
    """Pieces of a table, of `rows` rows at most; a table without rows is refused."""
    before, since = 0, None
    read = _parquet if source.kind == places.PARQUET else _csv
    for share, table in read(source, rows):
        if len(table):
            yield Piece(since, share, before, table)
        before, since = before + len(table), share
    if not before:
        raise InputError("it has a header, but no rows")


def _parquet(source: Place, rows: int) -> Iterator[tuple[float, pa.Table]]:
    """Shares that are read, and the rows; the first piece is empty."""
    try:
        with open(source.opened, "rb") as raw, pa.parquet.ParquetFile(raw) as file:
            schema = file.schema_arrow
            for name in columns.carried(schema.names):
                _refuse_cells(name, schema.field(name).type)
            yield 0.0, schema.empty_table()
            count = 0
            for batch in file.iter_batches(rows, use_threads=False):
                count += batch.num_rows
                yield count / file.metadata.num_rows, pa.Table.from_batches([batch])
    except (pa.ArrowException, OSError) as error:
        if isinstance(error, OSError) and error.errno:
            raise
        raise InputError(f"it is no whole Parquet file: {str(error).splitlines()[0]}") from None


def _refuse_cells(name: str, kind: pa.DataType) -> None:
    """Refuse a column that is carried over and whose type CSV or JSON cannot hold."""
    value = kind.value_type if pa.types.is_dictionary(kind) else kind
    types = pa.types
    text = types.is_string(value) or types.is_large_string(value)
    if not (text or types.is_boolean(value) or types.is_integer(value) or types.is_floating(value)):
        raise InputError(
            f"column {name!r} has cells of type {kind}: allowed are text, numbers, true and false"
        )


def _plain(cells: pa.ChunkedArray) -> pa.ChunkedArray:
    """The same cells, without a dictionary."""
    return cells.cast(cells.type.value_type) if pa.types.is_dictionary(cells.type) else cells


def _csv(source: Place, rows: int) -> Iterator[tuple[float | None, pa.Table]]:
    """As `_parquet`, from CSV."""
    with _opened(source) as (lines, share):
        try:
            header = _header(lines)
            columns.named(header)
            yield share(), _read(b"", header, 0)
            before = 0
            for text in _cut(lines, rows):
                table = _read(text, header, before)
                before += len(table)
                yield share(), table
        except UnicodeDecodeError:
            raise InputError("it is no text in UTF-8") from None
        except (EOFError, zlib.error, gzip.BadGzipFile) as error:
            raise InputError(f"it is no whole gzip file: {error}") from None


@contextmanager
def _opened(source: Place) -> Iterator[tuple[Iterator[bytes], Callable[[], float | None]]]:
    """Lines of a source, and a function for the share of it that is read."""
    whole = 0 if source.stream else Path(source.name).stat().st_size
    with open(source.opened, "rb", closefd=isinstance(source.opened, str)) as raw:
        lines = gzip.GzipFile(fileobj=raw) if source.kind == places.GZIP else raw
        yield lines, lambda: raw.tell() / whole if whole else None


def _header(lines: Iterator[bytes]) -> list[str]:
    """The names in the first line that is not blank."""
    texts = (line.decode("utf-8-sig") for line in lines)
    number, line = next((entry for entry in enumerate(texts, 1) if not entry[1].isspace()), (0, ""))
    if not line:
        raise InputError("it is empty: the first line must name the columns")
    for separator, name in SEPARATORS.items():
        if separator in line:
            raise InputError(
                f"it is separated by {name}; allowed are commas, and points in decimals"
            )
    try:
        (header,) = csv.reader([line], strict=True)
    except csv.Error as error:
        words = f"its quotation marks do not match, or its end is wrong ({error})"
        raise InputError(f"header, line {number}: {words}") from None
    for cell in header:
        if _is_number(cell):
            raise InputError(
                f"header, line {number}: {cell!r} stands where the name of a column belongs"
            )
    return header


def _is_number(cell: str) -> bool:
    try:
        float(cell)
    except ValueError:
        return False
    return True


def _cut(lines: Iterator[bytes], rows: int) -> Iterator[bytes]:
    """Text of `rows` lines each; of more where the last cell goes on in the next line."""
    while taken := list(islice(lines, rows)):
        if sum(line.count(b'"') for line in taken) % 2:
            for line in islice(lines, MOST_LINES):
                taken.append(line)
                if line.count(b'"') % 2:
                    break
        yield b"".join(taken)


def _read(text: bytes, header: list[str], before: int) -> pa.Table:
    """Rows of CSV: a column is numbers if all of its cells are finite numbers, else text."""
    table = _text_cells(text, header, before)
    names = columns.named(header)
    for name in names.keys() - {"loss"}:
        position = header.index(names[name])
        table = table.set_column(position, names[name], _numbers(table[position]))
    return table


def _text_cells(text: bytes, header: list[str], before: int) -> pa.Table:
    """Rows of CSV, all cells as text."""
    kinds = dict.fromkeys(header, pa.string())
    if not text or text.isspace():
        return pa.schema(kinds).empty_table()
    if b'"' in text:
        _refuse_rows(text, len(header), before)
    # One block has all rows, as no row may stand in two.
    whole = pa.csv.ReadOptions(use_threads=False, block_size=len(text), column_names=header)
    blank_lines_left_out = pa.csv.ParseOptions(
        newlines_in_values=True,
        invalid_row_handler=lambda row: "skip" if row.text.isspace() else "error",
    )
    # Empty cells and words such as NA stay as they are.
    as_text = pa.csv.ConvertOptions(column_types=kinds, null_values=[], strings_can_be_null=False)
    try:
        return pa.csv.read_csv(pa.BufferReader(text), whole, blank_lines_left_out, as_text)
    except pa.ArrowInvalid as error:
        _refuse_rows(text, len(header), before)
        raise InputError(f"it is no table of CSV: {error}") from None


def _refuse_rows(text: bytes, width: int, before: int) -> None:
    """Refuse the first row with other than `width` cells, or with unmatched quotation marks."""
    row = before + 1
    try:
        for cells in csv.reader(io.StringIO(text.decode(), newline=""), strict=True):
            if not cells or (len(cells) == 1 and not cells[0].strip()):
                continue  # a blank line
            if len(cells) != width:
                hint = columns.DECIMALS if len(cells) > width else ""
                raise InputError(f"row {row}: {len(cells)} cells where {width} belong{hint}")
            row += 1
    except csv.Error as error:
        raise InputError(f"row {row}: its quotation marks do not match ({error})") from None


def _numbers(cells: pa.ChunkedArray) -> pa.ChunkedArray:
    """Text as numbers, if all cells are finite numbers or NaN."""
    try:
        numbers = pa.compute.ascii_trim_whitespace(cells).cast(pa.float64())
    except pa.ArrowInvalid:
        return cells
    infinite = pa.compute.any(pa.compute.is_inf(numbers)).as_py()
    return cells if infinite else numbers
