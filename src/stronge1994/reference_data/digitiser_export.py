"""WebPlotDigitizer's exports: one dataset without a header, or all datasets below two lines.

Where a browser writes decimal commas, WebPlotDigitizer separates the cells of one dataset by
semicolons; all datasets together always have commas and decimal points.
"""

import re
from collections.abc import Iterable, Sequence
from typing import TypeAlias

# Number of a line, and its cells.
NumberedRow: TypeAlias = tuple[int, list[str]]

WHOLE = re.compile(r"[+-]?[0-9]+([eE][+-]?[0-9]+)?")
# These words stand where a number belongs. They are not names of columns.
NO_NUMBERS = ("nan", "inf", "infinity")
# WebPlotDigitizer gives this name to a dataset that the user has not named.
UNNAMED = "Default Dataset"
SEPARATORS = {",": "commas", ";": "semicolons"}


def separator(lines: Sequence[str]) -> str:
    """What separates the cells of an export: "," or ";".

    Examples
    --------
    >>> separator(["0,5; -0,05"]), separator(["a,,b,", "X,Y,X,Y"])
    (';', ',')
    """
    return ";" if any(";" in line for line in lines[:2]) else ","


def points(rows: Iterable[NumberedRow], between: str, name: str) -> tuple[str, list[NumberedRow]]:
    """Decimal mark of a dataset, and its points.

    Parameters
    ----------
    rows : sequence of (int, list of str)
        Number of the line, its cells.
    between : str
        What `separator` found.
    name : str
        Of the dataset, if there are several.

    Returns
    -------
    str
        "." or ",".
    list of (int, list of str)
        Number of the line, x and y.

    Raises
    ------
    ValueError
        Naming the line.

    Examples
    --------
    >>> points([(1, ["0,5", " -0,05"]), (2, ["", ""])], ";", "mine")
    (',', [(1, ['0,5', '-0,05'])])
    >>> points([(1, ["0", "5", " -0", "05"])], ",", "mine")
    Traceback (most recent call last):
    ValueError: line 1: 4 cells where 2 belong; it looks like decimal commas: separate cells by \
semicolons, or write decimal points
    """
    rows = [(line, [cell.strip(" ") for cell in row]) for line, row in rows]
    rows = [(line, row) for line, row in rows if any(row)]
    start, width = 0, 2
    if len(rows) > 1 and rows[1][1][:2] == ["X", "Y"]:
        start, width = _place(rows[0], rows[1], name)
        rows = rows[2:]
    elif rows and all(_is_word(cell) for cell in rows[0][1]):
        line, row = rows[0]
        raise ValueError(
            f"line {line}: {', '.join(row)!r} is a header; the export of one dataset has none: "
            "remove this line"
        )
    found = []
    for line, row in rows:
        if len(row) != width:
            raise ValueError(
                f"line {line}: {len(row)} cells where {width} belong; {_guess(row, width, between)}"
            )
        x, y = pair = row[start : start + 2]
        if x and y:
            found.append((line, pair))
        elif x or y:
            raise ValueError(f"line {line}: half a point: {'x' if x else 'y'} = {x or y!r} alone")
    return _decimal_mark(found), found


def _place(names: NumberedRow, axes: NumberedRow, name: str) -> tuple[int, int]:
    """First column of a dataset among several, and how many columns there are."""
    line, row = axes
    if row != ["X", "Y"] * (len(row) // 2):
        raise ValueError(f"line {line}: {', '.join(row)!r} where X, Y of each dataset belong")
    line, titles = names
    if len(titles) != len(row) or any(titles[1::2]):
        raise ValueError(
            f"line {line}: {len(titles)} cells where {len(row)} belong, a name and an empty cell "
            "for each dataset; a name must have no comma"
        )
    datasets = titles[::2]
    if datasets != [UNNAMED] and datasets.count(name) != 1:
        raise ValueError(
            f"line {line}: datasets ({', '.join(datasets)}); call one '{name}', or export one alone"
        )
    return 2 * (datasets.index(name) if name in datasets else 0), len(row)


def _is_word(cell: str) -> bool:
    return not cell or (cell[0].isalpha() and cell.lower() not in NO_NUMBERS)


def _guess(row: Sequence[str], width: int, between: str) -> str:
    """Why a row may have the wrong number of cells."""
    if between == "," and len(row) > width and all(map(WHOLE.fullmatch, filter(None, row))):
        return "it looks like decimal commas: separate cells by semicolons, or write decimal points"
    return f"{SEPARATORS[between]} separate the cells of this file"


def _decimal_mark(found: Iterable[NumberedRow]) -> str:
    """The decimal mark of the points. A cell with both marks is refused later, as no number."""
    marks: dict[str, tuple[int, str]] = {}
    for line, pair in found:
        for cell in pair:
            if ("," in cell) != ("." in cell):
                marks.setdefault("," if "," in cell else ".", (line, cell))
    if len(marks) == 2:
        (first, cell), (line, other) = sorted(marks.values())
        raise ValueError(
            f"line {line}: {other!r}, but {cell!r} in line {first}: write decimal points "
            "throughout, or decimal commas"
        )
    return next(iter(marks), ".")
