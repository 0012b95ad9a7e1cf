"""WebPlotDigitizer's exports: one dataset without a header, or all datasets below two lines.

Where a browser writes decimal commas, WebPlotDigitizer separates the cells of one dataset by
semicolons.
"""

import csv
from collections.abc import Sequence
from typing import TypeAlias

# Number of a line, and its cells.
NumberedRow: TypeAlias = tuple[int, list[str]]

# WebPlotDigitizer gives this name to a dataset that the user has not named.
UNNAMED = "Default Dataset"
SEPARATORS = {",": "commas", ";": "semicolons"}


def points(lines: Sequence[str], name: str) -> tuple[str, list[NumberedRow]]:
    """Decimal mark of the dataset of a name, and its points, x and y as text.

    >>> points(["0,5; -0,05", ";"], "mine")
    (',', [(1, ['0,5', '-0,05'])])
    >>> points(["0,5, -0,05"], "mine")
    Traceback (most recent call last):
    ValueError: line 1: 4 cells where 2 belong; commas separate the cells of this file; beside \
decimal commas, semicolons must
    """
    separator = ";" if any(";" in line for line in lines[:2]) else ","
    reader = csv.reader(lines, delimiter=separator, strict=True)
    rows = [(reader.line_num, [cell.strip(" ") for cell in row]) for row in reader]
    rows = [(line, row) for line, row in rows if any(row)]
    start, width = 0, 2
    if len(rows) > 1 and rows[1][1][:2] == ["X", "Y"]:
        (line, titles), (_, axes), *rows = rows
        names, width = titles[::2], len(axes)
        if names != [UNNAMED] and names.count(name) != 1:
            known = ", ".join(names)
            raise ValueError(
                f"line {line}: datasets ({known}); call one '{name}', or export one alone"
            )
        start = 2 * names.index(name) if name in names else 0
    for line, row in rows:
        if len(row) != width:
            raise ValueError(
                f"line {line}: {len(row)} cells where {width} belong; {SEPARATORS[separator]} "
                "separate the cells of this file; beside decimal commas, semicolons must"
            )
    pairs = [(line, row[start : start + 2]) for line, row in rows]
    pairs = [(line, pair) for line, pair in pairs if any(pair)]
    return "," if any("," in cell for _, pair in pairs for cell in pair) else ".", pairs
