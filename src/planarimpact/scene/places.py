"""What the name of a table means: a kind of file, standard input or output, or a pipe."""

import os
from pathlib import Path
from typing import NamedTuple

from planarimpact.ground.checks import InputError

CSV, GZIP, JSON, PARQUET = ".csv", ".csv.gz", ".json", ".parquet"


class Place(NamedTuple):
    """Where a table is read or written.

    A stream is standard input or output, a pipe or a device. It is CSV whatever its name, and it is
    written to directly, since no file can replace it.
    """

    name: str  # for messages
    opened: str | int  # for `open`: a path, or the number of an open file
    kind: str
    stream: bool


def source(path: str | Path) -> Place:
    """Place of a table that is read; `-` is standard input.

    >>> source("shots.csv").kind, source("-").name
    ('.csv', 'standard input')
    """
    return _place(path, ("-", "/dev/stdin"), 0, "standard input", (CSV, GZIP, PARQUET))


def target(path: str | Path) -> Place:
    """Place of a table that is written, JSON too; `-` is standard output.

    >>> target("after.json").kind, target("-").stream
    ('.json', True)
    """
    return _place(path, ("-", "/dev/stdout"), 1, "standard output", (CSV, GZIP, JSON, PARQUET))


def beside(target: Place) -> Place | None:
    """Place of the list of bad rows: `<name>.bad.csv`; a stream has nothing beside it."""
    name = f"{target.name}.bad.csv"
    return None if target.stream else Place(name, name, CSV, stream=False)


def _place(
    path: str | Path, standard: tuple[str, ...], number: int, called: str, kinds: tuple[str, ...]
) -> Place:
    name = str(path)
    kind = next((kind for kind in kinds if name.lower().endswith(kind)), None)
    flows = Path(path).is_fifo() or Path(path).is_char_device()
    # A file with a known ending is opened by its name, even if it is standard input or output too.
    if name in standard or ((flows or not kind) and _is_open(path, number)):
        return Place(called, number, CSV, stream=True)
    if flows:
        return Place(name, name, CSV, stream=True)
    if kind:
        return Place(name, name, kind, stream=False)
    endings = f"{', '.join(kinds[:-1])} or {kinds[-1]}"
    raise InputError(f"{name}: allowed are names that end in {endings}, pipes, and - for {called}")


def _is_open(path: str | Path, number: int) -> bool:
    """Whether a path leads to the open file of a number, as /dev/fd/1 does to standard output."""
    try:
        return os.path.samestat(os.stat(path), os.fstat(number))
    except OSError:  # either is not there
        return False
