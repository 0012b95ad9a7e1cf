"""Tables of scenes written piece by piece: CSV or JSON."""

import gzip
import io
import json
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from typing import Any, TextIO, TypeAlias

import pandas as pd

from planarimpact.ground import files
from planarimpact.ground.checks import InputError
from planarimpact.scene import places
from planarimpact.scene.places import Place

Write: TypeAlias = Callable[[pd.DataFrame], None]

# Level of gzip, the default of the command. The highest level takes five times as long.
LEVEL = 6


@contextmanager
def appended(target: Place) -> Iterator[Write]:
    """A function that appends tables to a target. A file gets its name when all are written.

    Parameters
    ----------
    target : Place

    Yields
    ------
    callable
        Takes a DataFrame; all of them have the same columns.

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
            file = stack.enter_context(_text(opened, target.kind))
            manager = _json if target.kind == places.JSON else _csv
            yield stack.enter_context(manager(file))
    except BrokenPipeError:
        raise
    except OSError as error:
        raise InputError(f"{target.name}: {error.strerror or error}") from None


@contextmanager
def _text(opened: str | int, kind: str) -> Iterator[TextIO]:
    with ExitStack() as stack:
        file: Any = stack.enter_context(open(opened, "wb", closefd=isinstance(opened, str)))
        if kind == places.GZIP:  # without name and time: the same table is the same file
            file = stack.enter_context(gzip.GzipFile("", "wb", LEVEL, file, mtime=0))
        yield stack.enter_context(io.TextIOWrapper(file, encoding="utf-8", newline=""))


class _Lines:
    """A file of CSV that is told "\\r\\n" at the end of each row, and writes "\\n".

    Python quotes a cell with a carriage return only where that is part of the end of a row.
    """

    def __init__(self, file: TextIO) -> None:
        self.write_text = file.write

    def write(self, row: str) -> None:
        self.write_text(row.removesuffix("\r\n") + "\n")


@contextmanager
def _csv(file: TextIO) -> Iterator[Write]:
    header, lines = True, _Lines(file)

    def write(table: pd.DataFrame) -> None:
        nonlocal header
        table.to_csv(lines, index=False, header=header, lineterminator="\r\n")
        header = False

    yield write


@contextmanager
def _json(file: TextIO) -> Iterator[Write]:
    """An array of objects, one a line; what is no finite number is null."""
    before = "[\n"

    def write(table: pd.DataFrame) -> None:
        nonlocal before
        for row in table.astype(object).to_dict("records"):
            plain = {name: files.or_null(cell) for name, cell in row.items()}
            file.write(before + json.dumps(plain))
            before = ",\n"

    yield write
    file.write("[]\n" if before == "[\n" else "\n]\n")
