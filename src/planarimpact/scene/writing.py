"""Tables of scenes written piece by piece: CSV, JSON or Parquet.

`encoded` turns a table into the content of a file, perhaps in another process. `appended` writes
one piece after the other.
"""

import csv
import gzip
import io
import json
import math
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from typing import Any, TypeAlias

import pandas as pd
import pyarrow as pa
import pyarrow.csv
import pyarrow.parquet

from planarimpact.ground import files
from planarimpact.ground.checks import InputError
from planarimpact.scene import places
from planarimpact.scene.places import Place

# The content of a file: text, or the columns of Parquet.
Encoded: TypeAlias = bytes | pa.Table
Write: TypeAlias = Callable[[Any], object]

# Between two objects of JSON.
COMMA = b",\n"
# Level of gzip, the default of the command. The highest level takes five times as long.
LEVEL = 6
# Least rows of a group of Parquet.
GROUP = 50_000


def encoded(table: pd.DataFrame, kind: str, header: bool) -> Encoded:
    """Content of a file of this kind for the rows of a table, with a header before them or not.

    Numbers have the fewest digits that read back to the same float64. NaN is an empty cell, null in
    JSON and Parquet; in JSON infinity is null too. Text of CSV stands in quotation marks.

    >>> table = pd.DataFrame({"spin [rad/s]": [0.1, 2.0, None], "id": ["a", "b,c", ""]})
    >>> print(encoded(table, ".csv", header=True).decode(), end="")
    spin [rad/s],id
    0.1,"a"
    2,"b,c"
    ,""
    >>> print(encoded(table[:1], ".json", header=True).decode())
    {"spin [rad/s]": 0.1, "id": "a"}
    """
    rows = pa.Table.from_pandas(table, preserve_index=False, nthreads=1).replace_schema_metadata()
    if kind == places.JSON:
        return _objects(rows)
    if kind == places.PARQUET:
        return rows
    text = io.BytesIO()
    if header:
        names = io.StringIO()
        csv.writer(names, lineterminator="\n").writerow(table)
        text.write(names.getvalue().encode())
    pa.csv.write_csv(rows, text, pa.csv.WriteOptions(include_header=False))
    # Without a name and a time: the same table is the same file.
    packed = kind == places.GZIP and text.tell()
    return gzip.compress(text.getvalue(), LEVEL, mtime=0) if packed else text.getvalue()


def _objects(rows: pa.Table) -> bytes:
    """Rows as objects of JSON. One template for all rows is faster than a dictionary for each."""
    names = (json.dumps(name).replace("%", "%%") for name in rows.column_names)
    template = "{" + ", ".join(f"{name}: %s" for name in names) + "}"
    cells = map(_cells, rows.columns)
    return COMMA.join((template % row).encode() for row in zip(*cells, strict=True))


def _cells(column: pa.ChunkedArray) -> list[str]:
    """Cells as JSON writes them, null for NaN and infinite numbers."""
    if pa.types.is_floating(column.type):
        numbers = column.to_numpy().tolist()
        return [repr(number) if math.isfinite(number) else "null" for number in numbers]
    text = {cell: json.dumps(cell) for cell in set(column.to_pylist())}
    return [text[cell] for cell in column.to_pylist()]


@contextmanager
def appended(target: Place) -> Iterator[Write]:
    """A function that appends what `encoded` returns. A file gets its name when all is written.

    A pipe that nobody reads any more is a BrokenPipeError; other failures are an InputError.
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
def _array(file: io.BufferedIOBase) -> Iterator[Write]:
    """An array of JSON, one object a line."""
    before = b"[\n"

    def write(objects: bytes) -> None:
        nonlocal before
        if objects:
            file.write(before)
            file.write(objects)
            before = COMMA

    yield write
    file.write(b"[]\n" if before == b"[\n" else b"\n]\n")


@contextmanager
def _parquet(file: io.BufferedIOBase) -> Iterator[Write]:
    """Groups of rows; small pieces make up one, as each takes space and time to read."""
    with ExitStack() as stack:
        writer: pa.parquet.ParquetWriter | None = None
        waiting: list[pa.Table] = []

        def write_waiting() -> None:
            nonlocal writer
            table = pa.concat_tables(waiting)
            waiting.clear()
            if writer is None:
                writer = stack.enter_context(pa.parquet.ParquetWriter(file, table.schema))
            writer.write_table(table)

        def write(table: pa.Table) -> None:
            waiting.append(table)
            if sum(map(len, waiting)) >= GROUP:
                write_waiting()

        yield write
        if waiting:
            write_waiting()
