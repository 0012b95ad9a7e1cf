"""WebPlotDigitizer's exports: one dataset without a header, or all datasets below two lines.

One dataset has the decimal mark of the browser's language, and the separator that the user chose.
All datasets together have decimal points and commas. Their names stand without quotation marks, and
may hold commas themselves. Source: dataTable.js and dataExport.js of WebPlotDigitizer 4.
"""

import re
from collections.abc import Sequence
from typing import TypeAlias

# Number of a line, and its cells.
NumberedRow: TypeAlias = tuple[int, list[str]]

# Decimal numbers, by their decimal mark.
NUMBERS = {
    mark: re.compile(rf"[+-]?([0-9]+([{mark}][0-9]*)?|[{mark}][0-9]+)([eE][+-]?[0-9]+)?")
    for mark in ".,"
}
# WebPlotDigitizer gives this name to a dataset that the user has not named.
UNNAMED = "Default Dataset"
_AXES = re.compile("X,Y(,X,Y)*")


def points(lines: Sequence[str], name: str) -> tuple[str, list[NumberedRow]]:
    """Decimal mark of the dataset of a name, and its points, x and y as text.

    >>> points(["0,5; -0,05", ";"], "mine")
    (',', [(1, ['0,5', '-0,05'])])
    >>> points(["nu = 0.5, dry,,mine,", "X,Y,X,Y", "7,7,0.5,-0.05"], "mine")
    ('.', [(3, ['0.5', '-0.05'])])
    >>> points(["0,5, -0,05"], "mine")
    Traceback (most recent call last):
    ValueError: line 1: '0,5, -0,05' has 4 columns; export this dataset alone, without groups; if \
these are decimal commas, choose semicolons between x and y
    """
    rows = [(number, line.strip(" \r\n")) for number, line in enumerate(lines, start=1)]
    if len(rows) > 1 and _AXES.fullmatch(rows[1][1]):
        return ".", _one_of_all(rows, name)
    rows = [(number, line) for number, line in rows if line.strip(" ,;")]
    separator = ";" if any(";" in line for _, line in rows) else ","
    mark = "," if separator == ";" and any("," in line for _, line in rows) else "."
    return mark, [(number, _x_and_y(number, line, separator)) for number, line in rows]


def _cells(line: str, separator: str) -> list[str]:
    return [cell.strip(" ") for cell in line.split(separator)]


def _x_and_y(number: int, line: str, separator: str) -> list[str]:
    """Both cells of a line of one dataset; an error says what else the line holds."""
    cells = _cells(line, separator)
    if '"' in line:
        problem = "has quotation marks; delete them, or export again"
    elif re.search(r"[^\W\d_]", cells[0]) and not any(
        form.fullmatch(cells[0]) for form in NUMBERS.values()
    ):
        problem = "has words; export this dataset alone, and delete its line of names"
    elif len(cells) < 2:
        mark = "semicolon" if separator == ";" else "comma"
        problem = f"has one column; put a {mark} between x and y"
    elif len(cells) > 2:
        commas = "; if these are decimal commas, choose semicolons between x and y"
        problem = (
            f"has {len(cells)} columns; export this dataset alone, without groups"
            f"{commas if separator == ',' else ''}"
        )
    else:
        return cells
    raise ValueError(f"line {number}: {line!r} {problem}")


def _one_of_all(rows: Sequence[tuple[int, str]], name: str) -> list[NumberedRow]:
    """Points of one of all datasets, which stand below their names and their axes."""
    (number, titles), (_, axes), *below = rows
    count = axes.count("X")
    # Two commas stand between names. If there are no other neighbouring commas, the names are sure.
    neighbours = len(re.findall(",(?=,)", titles.removesuffix(",")))
    if not titles.endswith(",") or neighbours != count - 1:
        raise ValueError(
            f"line {number}: it is not certain how {titles!r} names the columns {axes}; export "
            f"'{name}' alone"
        )
    names = [title.strip() for title in titles.removesuffix(",").split(",,")]
    if names != [UNNAMED] and names.count(name) != 1:
        known = ", ".join(map(repr, names))
        raise ValueError(f"line {number}: datasets {known}; call one '{name}', or export it alone")
    start = 2 * names.index(name) if name in names else 0
    found = []
    for number, line in below:
        cells = _cells(line, ",")
        if line and len(cells) != 2 * count:
            raise ValueError(
                f"line {number}: {len(cells)} cells below {count} times X,Y; export '{name}' alone"
            )
        found.append((number, cells[start : start + 2]))
    return [(number, pair) for number, pair in found if any(pair)]
