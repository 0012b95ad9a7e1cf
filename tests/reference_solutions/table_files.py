"""Tables of reference values as files: what the generators of data/ share."""

import csv
from functools import partial
from pathlib import Path
from typing import Any, NamedTuple

from mpmath import mp

DATA = Path(__file__).parents[2] / "data"
DIGITS = 50  # carried


class Table(NamedTuple):
    """A table whose rows are computed one by one, so that a test can compute a few of them anew."""

    header: list[str]
    rows: list[Any]  # functions of the cells: words, numbers, or None for a cell left empty

    def cells(self, row):
        """The texts of one row; numbers have 20 digits, float64 those that identify it."""
        with mp.workdps(DIGITS):
            return [_text(cell) for cell in self.rows[row]()]


def table(header, function, places):
    """The table whose rows are what a function returns at each of some places, its arguments."""
    return Table(header, [partial(function, *place) for place in places])


def impacts(folder, header, function):
    """The one table of a folder, made anew: what a function returns of the groups in each row."""
    points = [tuple(map(float, list(row.values())[:4])) for row in read(f"{folder}/impacts")]
    return {"impacts": table(header, function, [(point,) for point in points])}


def digits(number, places):
    """A number rounded to decimal places, without -0."""
    return round(float(number), places) + 0.0


def _text(cell):
    if cell is None:
        return ""
    if isinstance(cell, str):
        return cell
    if isinstance(cell, int | float):
        return repr(float(cell))
    return mp.nstr(cell, 20, strip_zeros=True)


def write(folder, tables):
    """Write `{name: Table}` as CSV files."""
    for name, table in tables.items():
        with open(Path(folder) / f"{name}.csv", "w", newline="", encoding="utf-8") as file:
            writer = csv.writer(file, lineterminator="\n")
            writer.writerow(table.header)
            writer.writerows(table.cells(row) for row in range(len(table.rows)))


def read(name):
    """Rows of a file of data/ by its name without an ending, each with its cells by column."""
    with open(DATA / f"{name}.csv", newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def differing(path, table, every=1, last_place=0.0):
    """Rows that a file has and should have, where they differ; `every` so many are computed.

    Numbers may differ by `last_place`: one in the last place written, where floating point computes
    them and may round otherwise on another machine.
    """
    with open(path, newline="", encoding="utf-8") as file:
        header, *found = csv.reader(file)
    if header != table.header or len(found) != len(table.rows):
        return [([*header, str(len(found))], [*table.header, str(len(table.rows))])]
    pairs = [(found[row], table.cells(row)) for row in range(0, len(found), every)]
    return [(old, new) for old, new in pairs if not _agree(old, new, last_place)]


def _agree(old, new, last_place):
    if old == new:
        return True
    return len(old) == len(new) and all(
        a == b or (_is_number(a) and _is_number(b) and abs(float(a) - float(b)) <= last_place)
        for a, b in zip(old, new, strict=True)
    )


def _is_number(text):
    return text.lstrip("-")[:1].isdigit()
