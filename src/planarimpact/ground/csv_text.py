"""Text of CSV that others wrote: what scenes and the reproduction's reference data both read."""

import csv
import io

from planarimpact.ground.checks import InputError


def decoded(content: bytes, line: int = 1) -> str:
    r"""Text in UTF-8 that begins in this line of a file, without the mark that Excel puts first.

    Examples
    --------
    >>> decoded(b"1\n\xe9")
    Traceback (most recent call last):
    ...
    planarimpact.InputError: line 2: byte 0xe9 is no UTF-8; save the file as UTF-8
    """
    try:
        return content.decode("utf-8-sig" if line == 1 else "utf-8")
    except UnicodeDecodeError as error:
        line += content[: error.start].count(b"\n")
        problem = f"byte 0x{content[error.start]:02x} is no UTF-8; save the file as UTF-8"
        raise InputError(f"line {line}: {problem}") from None


def header(text: str) -> list[str]:
    """Cells of the first line of a table, without the blanks and line breaks around words.

    Examples
    --------
    >>> header('"radius\\n[m]", friction\\n0.1,0.2')
    ['radius [m]', 'friction']
    >>> header("sep=;\\nradius [m];friction")
    Traceback (most recent call last):
    ...
    planarimpact.InputError: line 1: 'sep=;' is for Excel alone: remove this line; commas separate \
cells, and decimals have a point
    """
    try:
        cells = next(csv.reader(io.StringIO(text, newline=""), strict=True), [])
    except csv.Error as error:
        raise InputError(f"line 1: {error}") from None
    if "\0" in text[:1000]:
        raise InputError("line 1: it has the character NUL, as UTF-16 has; save the file as UTF-8")
    separated = "commas separate cells, and decimals have a point"
    if cells and cells[0].startswith("sep="):
        first = ",".join(cells)
        raise InputError(f"line 1: {first!a} is for Excel alone: remove this line; {separated}")
    for mark in ";\t":
        if len(cells) == 1 and mark in cells[0]:
            raise InputError(f"line 1: {mark!a} stands between cells; {separated}")
    return [" ".join(cell.split()) for cell in cells]


def rows(text: str) -> tuple[list[str], list[tuple[int, list[str]]]]:
    r"""Header of a table, and rows with the numbers of their last lines; blank lines are none.

    Examples
    --------
    >>> rows("a,b\n\n1,2\n")
    (['a', 'b'], [(3, ['1', '2'])])
    >>> rows("a,b\n1\n")
    Traceback (most recent call last):
    ...
    planarimpact.InputError: line 2: 1 cells where 2 belong
    """
    names = header(text.lstrip())
    reader = csv.reader(io.StringIO(text, newline=""), strict=True)
    found = []
    try:
        for cells in reader:
            if len(cells) > 1 or "".join(cells).strip():
                found.append((reader.line_num, cells))
    except csv.Error as error:
        raise InputError(f"line {reader.line_num}: {error}") from None
    for line, cells in found:
        if len(cells) != len(names):
            raise InputError(f"line {line}: {len(cells)} cells where {len(names)} belong")
    return names, found[1:]
