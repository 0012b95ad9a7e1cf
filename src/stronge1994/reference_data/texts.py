"""Text files that others wrote: YAML, and CSV with a head; a `SourceError` names file and line."""

import copy
import csv
import functools
import io
import itertools
import re
from pathlib import Path
from typing import Any, Self

from stronge1994.reference_data import strict_yaml

# What files begin with that are no text in UTF-8.
OTHERS = {b"\xff\xfe": "UTF-16", b"\xfe\xff": "UTF-16", b"\x1f\x8b": "packed by gzip"}
OTHERS |= {b"PK": "a packed file, as of Excel"}
# How others write the letters of our units.
LETTERS = str.maketrans({"\u00b5": "mu", "\u03bc": "mu", "\u03a9": "Omega", "\u2126": "Omega"})
# A row whose decimals have commas: `1,5;2,3` or `"1,5","2,3"` or `1,5,2,3`.
WITH_COMMAS = re.compile(r'^"?[+-]?\d+,\d+"? *[,;\t] *"?[+-]?\d+,\d+"? *$', re.M)
COMMAS = "decimal commas; allowed are points, and commas between cells"
SEPARATED = "commas separate cells, and decimals have a point"


class SourceError(Exception):
    """Something in data/ or in the settings is not admissible: a line for each fault."""


class Faults(list[str]):
    """Faults that are told together: a `with` notes that of its block, and goes on."""

    def __enter__(self) -> Self:
        return self

    def __exit__(self, kind: Any, error: BaseException | None, trace: Any) -> bool:
        if isinstance(error, SourceError):
            self.append(f"{error}")
        return isinstance(error, SourceError)

    def refuse(self) -> None:
        """Raise them, if there are any."""
        if self:
            raise SourceError("\n".join(self))


def text_of(path: str | Path) -> str:
    """Text of a file in UTF-8, without the mark that Excel puts first."""
    try:
        content = Path(path).read_bytes()
        return content.decode("utf-8-sig")
    except OSError as error:
        raise SourceError(f"{path}: {error.strerror}") from None
    except UnicodeDecodeError as error:
        problem = f"byte 0x{error.object[error.start]:02x} is no UTF-8; save the file as UTF-8"
        if content[:2] in OTHERS:
            problem = f"it is {OTHERS[content[:2]]}; allowed is text, saved as UTF-8"
        line = 1 + error.object[: error.start].count(b"\n")
        raise SourceError(f"{path}, line {line}: {problem}") from None


def load_yaml(path: str | Path) -> dict[str, Any]:
    """Read a YAML file: a mapping whose keys are texts."""
    try:
        return copy.deepcopy(_parsed(text_of(path)))
    except ValueError as error:
        raise SourceError(f"{path}, {error}") from None


_parsed = functools.cache(strict_yaml.load)  # a start reads some files twice


def head_and_table(text: str) -> tuple[list[str], str]:
    r"""Lines with # before a table, and the text with blank ones there: lines keep their numbers.

    >>> head_and_table("# who: me\na,b\n1,2\n")
    (['# who: me\n'], '\na,b\n1,2\n')
    """
    lines = list(io.StringIO(text, newline=None))
    head = list(itertools.takewhile(lambda line: line.strip('" \t\r\n')[:1] in ("", "#"), lines))
    return head, "\n" * len(head) + "".join(lines[len(head) :])


def cells_of(path: str, columns: list[str]) -> tuple[list[int], dict[str, list[str]]]:
    """Lines of the rows of a table, and the cells of these columns, which it must have.

    A header may lack the unit of a column that has its name alone, or have other blanks in it.
    """
    head, text = head_and_table(text_of(path))
    try:
        (first, header), *rows = _rows(text)
    except ValueError as error:
        problem = f"{error}"
        if row := WITH_COMMAS.search(text):
            line = text.count("\n", 0, row.start()) + 1
            problem = f"line {line}: {row[0]!a} has {COMMAS}"
        raise SourceError(f"{path}, {problem}") from None
    found, bare = (
        [_squeezed(cell) for cell in header],
        [name.partition(" [")[0] for name in columns],
    )
    cells = {}
    for column, name in zip(columns, bare, strict=True):
        known = {_squeezed(column), _squeezed(name if bare.count(name) == 1 else column)}
        places = [place for place, cell in enumerate(found) if cell in known]
        if len(places) != 1:
            problem = "stands twice" if places else "is missing"
            there = ascii(", ".join(" ".join(cell.split()) for cell in header))[1:-1]
            where = f"{path}, line {len(head) + 1}"
            raise SourceError(f"{where}: column '{column}' {problem}; found {there}")
        cells[column] = [row[places[0]].strip() for _, row in rows]
    if not rows:
        raise SourceError(f"{path}: no points")
    return [line for line, _ in rows], cells


def _rows(text: str) -> list[tuple[int, list[str]]]:
    r"""Rows of a table with the numbers of their last lines, its header first; blank ones are none.

    >>> _rows("a,b\n\n1,2\n")
    [(1, ['a', 'b']), (3, ['1', '2'])]
    """
    reader = csv.reader(io.StringIO(text, newline=""), strict=True)
    try:
        every = [(reader.line_num, cells) for cells in reader]
    except csv.Error as error:
        raise ValueError(f"line {reader.line_num}: {error}") from None
    rows = [(line, cells) for line, cells in every if len(cells) > 1 or "".join(cells).strip()]
    line, header = rows[0] if rows else (1 + text.count("\n"), [])
    if "\0" in text:
        line = 1 + text[: text.index("\0")].count("\n")
        problem = "it has the character NUL, as UTF-16 has; save the file as UTF-8"
    elif not header:
        problem = "it is empty; a header and rows belong there"
    elif header[0].startswith("sep="):
        problem = f"{','.join(header)!a} is for Excel alone: remove this line; {SEPARATED}"
    elif len(header) == 1 and (marks := {*";\t"} & {*header[0]}):
        problem = f"{max(marks)!a} stands between cells; {SEPARATED}"
    elif others := [row for row in rows if len(row[1]) != len(header)]:
        line, cells = others[0]
        problem = f"{len(cells)} cells where {len(header)} belong"
    else:
        return rows
    raise ValueError(f"line {line}: {problem}")


def _squeezed(name: str) -> str:
    """A name of a column in our letters, without blanks."""
    return "".join(name.translate(LETTERS).split())
