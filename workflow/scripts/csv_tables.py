"""Named curves and series as CSV: first column the name, then one column a quantity and unit.

A solver that crashed leaves a table with the single column `error`.
"""

import csv
import os

import numpy as np


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
    partial = f"{path}.partial"
    with open(partial, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(header)
        writer.writerows(rows)
    os.replace(partial, path)


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
            key: _values(column)
            for key, column in zip(header[1:], columns, strict=True)
            if any(column)
        }
    return named


def read_rows(path):
    """Rows of a table as dicts of text."""
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def _values(column):
    try:
        return np.array([float(cell) for cell in column])
    except ValueError:
        return np.array(column)
