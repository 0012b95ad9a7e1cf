"""Text of CSV that others wrote, as reference data are."""

import csv
import io

from planarimpact.common.checks import InputError

# What files begin with that are no text in UTF-8.
OTHERS = {b"\xff\xfe": "UTF-16", b"\xfe\xff": "UTF-16", b"\x1f\x8b": "packed by gzip"}
OTHERS |= {b"PK": "a packed file, as of Excel"}


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
        problem = f"byte 0x{content[error.start]:02x} is no UTF-8; save the file as UTF-8"
        if line == 1 and content[:2] in OTHERS:
            problem = f"it is {OTHERS[content[:2]]}; allowed is text, saved as UTF-8"
        line += content[: error.start].count(b"\n")
        raise InputError(f"line {line}: {problem}") from None


def header(text: str, line: int = 1) -> list[str]:
    """Cells of the first line of a table, without the blanks and line breaks around words.

    It is this line of a file.

    Examples
    --------
    >>> header('"radius\\n[m]", friction\\n0.1,0.2')
    ['radius [m]', 'friction']
    """
    try:
        cells = next(csv.reader(io.StringIO(text, newline=""), strict=True), [])
    except csv.Error as error:
        raise InputError(f"line {line}: {error}") from None
    if "\0" in text:
        line += text[: text.index("\0")].count("\n")
        problem = "it has the character NUL, as UTF-16 has; save the file as UTF-8"
        raise InputError(f"line {line}: {problem}")
    if not cells:
        raise InputError(f"line {line}: it is empty; a header and rows belong there")
    separated = "commas separate cells, and decimals have a point"
    if cells[0].startswith("sep="):
        first = ",".join(cells)
        raise InputError(
            f"line {line}: {first!a} is for Excel alone: remove this line; {separated}"
        )
    for mark in ";\t":
        if len(cells) == 1 and mark in cells[0]:
            raise InputError(f"line {line}: {mark!a} stands between cells; {separated}")
    return [" ".join(cell.split()) for cell in cells]


def rows(text: str) -> tuple[list[str], list[tuple[int, list[str]]]]:
    r"""Header of a table, and rows with the numbers of their last lines; blank lines are none.

    Examples
    --------
    >>> rows("a,b\n\n1,2\n")
    (['a', 'b'], [(3, ['1', '2'])])
    """
    begin = text.lstrip()
    names = header(begin, 1 + text[: len(text) - len(begin)].count("\n"))
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
