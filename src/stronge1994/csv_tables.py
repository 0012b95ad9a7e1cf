"""Named curves and series as CSV: first column the name, then one column a quantity and unit.

A solver that crashed leaves a table with the single column `error`.
"""

import csv

import numpy as np

from planarimpact.ground import files


class Failed(Exception):
    """The table holds the message of a solver that crashed."""


def write(path, named, first="curve"):
    """Write `{name: {column: array}}`; a column that a curve lacks stays empty."""
    columns = list(dict.fromkeys(column for curve in named.values() for column in curve))
    rows = []
    for name, curve in named.items():
        cells = [
            [str(value.item() if hasattr(value, "item") else value) for value in curve[column]]
            if column in curve
            else None
            for column in columns
        ]
        length = max(len(cell) for cell in cells if cell is not None)
        rows += [[name, *(cell[i] if cell else "" for cell in cells)] for i in range(length)]
    write_rows(path, [first, *columns], rows)


def write_rows(path, header, rows):
    """Write a CSV whole or not at all."""
    with (
        files.written(path) as partial,
        open(partial, "w", newline="", encoding="utf-8") as file,
    ):
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(header)
        writer.writerows(rows)


def read(path):
    """Read what `write` wrote: numbers as float64, words as text, empty columns left out."""
    with open(path, newline="", encoding="utf-8") as file:
        header, *rows = list(csv.reader(file))
    if header == ["error"]:
        raise Failed(rows[0][0])
    named = {}
    for name in dict.fromkeys(row[0] for row in rows):
        part = [row for row in rows if row[0] == name]
        columns = zip(*(row[1:] for row in part), strict=True)
        named[name] = {
            key: values(column)
            for key, column in zip(header[1:], columns, strict=True)
            if any(column)
        }
    return named


def read_rows(path, columns=()):
    """Rows of a table as dicts of text.

    Raises
    ------
    ValueError
        Naming file and line, if one of `columns` is missing or a row is not as wide as the header.
    """
    with open(path, newline="", encoding="utf-8") as file:
        header, *rows = list(csv.reader(file, strict=True)) or [[]]
    missing = [column for column in columns if column not in header]
    if missing:
        raise ValueError(f"{path}, line 1: column '{missing[0]}' is missing")
    for line, row in enumerate(rows, 2):
        if len(row) != len(header):
            raise ValueError(f"{path}, line {line}: {len(row)} cells where {len(header)} belong")
    return [dict(zip(header, row, strict=True)) for row in rows]


def values(column):
    """Cells of a column as float64; as text if one of them is no number."""
    try:
        return np.array([float(cell) for cell in column])
    except ValueError:
        return np.array(column)
