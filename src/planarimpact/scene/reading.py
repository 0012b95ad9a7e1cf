"""Tables of scenes read piece by piece, from CSV.

pandas would silently accept a row that is too short, or a name that is there twice. Here both are
refused with the number of their line: commas are counted before pandas reads the text.
"""

import csv
import gzip
import io
import zlib
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from itertools import chain, islice
from pathlib import Path
from typing import TypeAlias

import numpy as np
import pandas as pd

from planarimpact.ground.checks import InputError
from planarimpact.scene import columns, places
from planarimpact.scene.places import Place

Lines: TypeAlias = Iterator[tuple[int, str]]  # with their numbers, from 1
Piece: TypeAlias = tuple[float | None, pd.DataFrame]

SEPARATORS = {";": "semicolons", "\t": "tabs"}


def pieces(source: Place, rows: int) -> Iterator[Piece]:
    """Tables of some rows each, with the share of the source that is read so far.

    Parameters
    ----------
    source : Place
    rows : int
        Of a table, at most.

    Yields
    ------
    share : float or None
        0 to 1; None where nobody knows how much there is, as in a pipe.
    table : DataFrame
        The first may be empty, and has its columns. Cells that are no numbers are text as it
        stands.

    Raises
    ------
    InputError
        If the source is no table, by the number of its line.
    """
    with _opened(source) as (lines, share):
        try:
            line, header = _header(lines)
            label = columns.named(header).get(columns.LABEL)
            types = {} if label is None else {label: str}
            checked, first = _rows(lines, len(header)), True
            while (text := "".join(islice(checked, rows))) or first:
                first = False
                yield share(), _table(line + text, types)
        except UnicodeDecodeError:
            raise InputError("it is no text in UTF-8") from None
        except (EOFError, zlib.error, gzip.BadGzipFile) as error:
            raise InputError(f"it is no whole gzip file: {error}") from None


def _table(text: str, types: dict[str, type[str]]) -> pd.DataFrame:
    """Rows of the text; columns with infinite cells are text, which tells inf from 1e400."""
    table = _parsed(text, types)
    endless = [name for name in table.select_dtypes(float) if np.isinf(table[name]).any()]
    return _parsed(text, types | dict.fromkeys(endless, str)) if endless else table


def _parsed(text: str, types: dict[str, type[str]]) -> pd.DataFrame:
    return pd.read_csv(
        io.BytesIO(text.encode()),
        index_col=False,
        dtype=types,
        na_filter=False,  # empty cells and words such as NA stay as they are
        low_memory=False,  # each column gets one type
    )


@contextmanager
def _opened(source: Place) -> Iterator[tuple[Lines, Callable[[], float | None]]]:
    """Lines of a source, and a function for the share of it that is read."""
    whole = 0 if source.stream else Path(source.name).stat().st_size
    with open(source.opened, "rb", closefd=isinstance(source.opened, str)) as raw:
        binary = gzip.GzipFile(fileobj=raw) if source.kind == places.GZIP else raw
        with io.TextIOWrapper(binary, encoding="utf-8-sig", newline="") as text:
            yield enumerate(text, start=1), lambda: raw.tell() / whole if whole else None


def _header(lines: Lines) -> tuple[str, list[str]]:
    """The first line that is not blank, and the names in it."""
    number, line = next((entry for entry in lines if not entry[1].isspace()), (0, ""))
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
    return line.rstrip("\r\n") + "\n", header


def _is_number(cell: str) -> bool:
    try:
        float(cell)
    except ValueError:
        return False
    return True


def _rows(lines: Lines, width: int) -> Iterator[str]:
    """Text of each row, of as many cells as belong."""
    for number, line in lines:
        if '"' in line:  # from here on a comma or the end of a line may stand within a cell
            yield from _rows_with_quotes(chain([(number, line)], lines), width)
        else:
            cells = line.count(",") + 1
            yield line if cells == width else _fitting(number, line, cells, width)


def _rows_with_quotes(lines: Lines, width: int) -> Iterator[str]:
    """As `_rows`, slower."""
    taken: list[tuple[int, str]] = []  # lines of the row

    def take() -> Iterator[str]:
        for entry in lines:
            taken.append(entry)
            yield entry[1]

    try:
        for cells in csv.reader(take(), strict=True):
            yield _fitting(taken[0][0], "".join(line for _, line in taken), len(cells), width)
            taken.clear()
    except csv.Error as error:
        raise _unmatched(taken[0][0], error) from None


def _fitting(number: int, text: str, cells: int, width: int) -> str:
    """A row that has its cells, or is blank."""
    if cells == width or text.isspace():
        return text
    hint = columns.DECIMALS if cells > width else ""
    raise InputError(f"line {number}: {cells} cells where {width} belong{hint}")


def _unmatched(number: int, error: csv.Error) -> InputError:
    return InputError(f"line {number}: its quotation marks do not match ({error})")
