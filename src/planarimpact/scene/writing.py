"""Tables of scenes written piece by piece: CSV, JSON or Parquet.

`encoded` makes of a table what stands in the file, perhaps in another process. `appended` puts one
piece after the other.
"""

import gzip
import json
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from typing import IO, Any, TypeAlias

import numpy as np
import pandas as pd
import pyarrow as pa
import pyarrow.compute
import pyarrow.parquet

from planarimpact.ground import files
from planarimpact.ground.checks import InputError
from planarimpact.scene import places
from planarimpact.scene.places import Place

# What stands in a file for a table: text, or the columns of Parquet.
Encoded: TypeAlias = bytes | pa.Table
Write: TypeAlias = Callable[[Any], object]

# So many rows become text at a time: all cells of a piece as text would take much memory.
AT_A_TIME = 2**14
# Between two objects of JSON.
COMMA = ",\n{"
# Level of gzip, the default of the command. The highest level takes five times as long.
LEVEL = 6


def encoded(table: pd.DataFrame, kind: str, header: bool) -> Encoded:
    """What stands in a file for the rows of a table.

    Parameters
    ----------
    table : DataFrame
        Numbers, text, categories of text.
    kind : str
        Of the file, as of `Place`.
    header : bool
        Whether CSV has the names of the columns first.

    Returns
    -------
    bytes or Table
        Numbers have the fewest digits that read back to the same float64. NaN is an empty cell,
        null in JSON and Parquet; in JSON infinity is null too, and each row follows on a comma.

    Examples
    --------
    >>> table = pd.DataFrame({"spin [rad/s]": [0.1, 2.0, np.nan], "id": ["a", "b,c", ""]})
    >>> print(encoded(table, ".csv", header=True).decode(), end="")
    spin [rad/s],id
    0.1,a
    2.0,"b,c"
    ,
    >>> print(encoded(table[:1], ".json", header=True).decode())
    ,
    {"spin [rad/s]": 0.1, "id": "a"}
    """
    columns = pa.Table.from_pandas(table, preserve_index=False, nthreads=1)
    if kind == places.PARQUET:
        return columns.replace_schema_metadata()
    parts = [columns.slice(start, AT_A_TIME) for start in range(0, len(columns), AT_A_TIME)]
    if kind == places.JSON:
        return b"".join(map(_objects, parts))
    if header:
        names = columns.column_names
        parts.insert(0, pa.table([[name] for name in names], names))
    text = b"".join(map(_lines, parts))
    # Without a name and a time: the same table is the same file.
    return gzip.compress(text, LEVEL, mtime=0) if kind == places.GZIP and text else text


@contextmanager
def appended(target: Place) -> Iterator[Write]:
    """A function that appends pieces to a target. A file gets its name when all are written.

    Parameters
    ----------
    target : Place

    Yields
    ------
    callable
        Takes what `encoded` returns.

    Raises
    ------
    InputError
        If the target cannot be written. A pipe that nobody reads any more is a BrokenPipeError.
    """
    try:
        with ExitStack() as stack:
            opened = target.opened
            if not target.stream:
                opened = str(stack.enter_context(files.written(target.name)))
            file = stack.enter_context(open(opened, "wb", closefd=isinstance(opened, str)))
            managers = {places.JSON: _array, places.PARQUET: _parquet}
            manager = managers.get(target.kind)
            yield stack.enter_context(manager(file)) if manager else file.write
    except BrokenPipeError:
        raise
    except OSError as error:
        raise InputError(f"{target.name}: {error.strerror or error}") from None


@contextmanager
def _array(file: IO[bytes]) -> Iterator[Write]:
    """An array of objects, one a line."""
    before = b"["

    def write(objects: bytes) -> None:
        nonlocal before
        if objects:
            file.write(before)
            file.write(memoryview(objects)[1:] if before == b"[" else objects)
            before = b""

    yield write
    file.write(b"[]\n" if before else b"\n]\n")


@contextmanager
def _parquet(file: IO[bytes]) -> Iterator[Write]:
    with ExitStack() as stack:
        writer: pa.parquet.ParquetWriter | None = None

        def write(table: pa.Table) -> None:
            nonlocal writer
            if writer is None:
                writer = stack.enter_context(pa.parquet.ParquetWriter(file, table.schema))
            writer.write_table(table)

        yield write


def _lines(table: pa.Table) -> pa.Buffer:
    """Rows of CSV: every column as text, and then every row in one."""
    *cells, last = (_cells(column.combine_chunks(), _quoted) for column in table.columns)
    return _text(_together([*cells, _together([last, "\n"], "")], ","))


def _objects(table: pa.Table) -> pa.Buffer:
    """Rows of JSON, each after a comma."""
    parts: list[pa.Array | str] = []
    for name, column in zip(table.column_names, table.columns, strict=True):
        cells = column.combine_chunks()
        if pa.types.is_floating(cells.type):
            cells = pa.compute.if_else(pa.compute.is_finite(cells), cells, None)
        parts += [f"{', ' if parts else COMMA}{json.dumps(name)}: ", _cells(cells, _dumped)]
    return _text(_together([*parts, "}"], "", missing="null"))


def _text(rows: pa.Array) -> pa.Buffer:
    """All rows as one text: they stand in a buffer one after the other."""
    length = pa.compute.sum(pa.compute.binary_length(rows)).as_py()
    return rows.buffers()[2][:length]


def _together(cells: list[pa.Array | str], between: str, missing: str = "") -> pa.Array:
    return pa.compute.binary_join_element_wise(
        *(pa.scalar(x, pa.large_string()) if isinstance(x, str) else x for x in [*cells, between]),
        null_handling="replace",
        null_replacement=missing,
    )


def _cells(column: pa.Array, words: Callable[[pa.Array], pa.Array]) -> pa.Array:
    """Text of the cells of a column, in large strings: rows of 2 GB do not overflow."""
    if pa.types.is_floating(column.type):
        return _decimals(column)
    if pa.types.is_dictionary(column.type):
        return _cells(column.dictionary, words).take(column.indices)
    text = column.cast(pa.large_string())
    return text if pa.types.is_integer(column.type) else words(text)


def _decimals(column: pa.Array) -> pa.Array:
    """Text of numbers: 2 is 2.0, as readers take a column without points for integers."""
    text = column.cast(pa.large_string())
    numbers = column.to_numpy(zero_copy_only=False)
    whole = np.isfinite(numbers) & (np.trunc(numbers) == numbers)
    if not whole.any():
        return text
    short = pa.compute.and_not(pa.array(whole), pa.compute.match_substring(text, "e"))
    return pa.compute.if_else(short, _together([text, ".0"], ""), text)


def _quoted(text: pa.Array) -> pa.Array:
    """Words in quotation marks where CSV needs them."""
    special = pa.compute.match_substring_regex(text, '[",\r\n]')
    if not pa.compute.any(special).as_py():
        return text
    doubled = pa.compute.replace_substring(text, '"', '""')
    return pa.compute.if_else(special, _together(['"', doubled, '"'], ""), text)


def _dumped(text: pa.Array) -> pa.Array:
    """Words as JSON has them."""
    words = (None if word is None else json.dumps(word) for word in text.to_pylist())
    return pa.array(words, pa.large_string())
