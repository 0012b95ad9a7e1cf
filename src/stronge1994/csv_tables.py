"""Tables as CSV: named curves, and rows of any other kind.

The first column of a table of curves has the name of the curve. Each other column is a quantity,
its unit in brackets.
"""

import csv
from collections.abc import Iterable, Mapping, Sequence
from os import PathLike
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from planarimpact.common import csv_text

Column: TypeAlias = NDArray[Any]  # numbers, or texts
Columns: TypeAlias = dict[str, Column]
Curves: TypeAlias = dict[str, Columns]
# A row of any other table: its cells as text, by the names of the columns.
Row: TypeAlias = dict[str, str]
Path: TypeAlias = str | PathLike[str]


def refuse_not_finite(named: Mapping[str, Columns]) -> None:
    """Refuse curves of which a number is not finite; a `ValueError` names the first one.

    >>> refuse_not_finite({"a": {"x [1]": np.array([0.5, 1.5]), "y [1]": np.array([0, np.nan])}})
    Traceback (most recent call last):
    ValueError: curve 'a', column 'y [1]' is nan where 'x [1]' is 1.5: allowed are finite numbers
    """
    for name, curve in named.items():
        for column, values in curve.items():
            values = np.asarray(values)
            if values.dtype.kind == "f" and not np.isfinite(values).all():
                row = int(np.isfinite(values).argmin())
                first, places = next(iter(curve.items()))
                raise ValueError(
                    f"curve '{name}', column '{column}' is {values[row]} where '{first}' is "
                    f"{places[row]:g}: allowed are finite numbers"
                )


def write(path: Path, named: Mapping[str, Mapping[str, Iterable[Any]]]) -> None:
    """Write `{name: {column: array}}`; a column that a curve lacks stays empty."""
    columns = list(dict.fromkeys(column for curve in named.values() for column in curve))
    rows: list[list[Any]] = []
    for name, curve in named.items():
        own = {column: np.asarray(values).tolist() for column, values in curve.items()}
        empty = [""] * len(next(iter(own.values())))
        cells = (own.get(column, empty) for column in columns)
        rows += [[name, *row] for row in zip(*cells, strict=True)]
    write_rows(path, ["curve", *columns], rows)


def write_rows(path: Path, header: Sequence[str], rows: Iterable[Iterable[Any]]) -> None:
    """Write a table of cells below a header."""
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(header)
        writer.writerows(rows)


def write_table(path: Path, rows: Iterable[Mapping[str, Any]], columns: Sequence[str]) -> None:
    """Write rows that have these columns at least, in the order of the columns."""
    write_rows(path, columns, [[row[column] for column in columns] for row in rows])


def read(path: Path) -> Curves:
    """Read what `write` wrote: numbers as float64, others as text, empty columns left out."""
    rows = read_rows(path)
    first, *columns = rows[0] if rows else [""]
    named: Curves = {}
    for name in dict.fromkeys(row[first] for row in rows):
        part = [row for row in rows if row[first] == name]
        cells = {column: [row[column] for row in part] for column in columns}
        named[name] = {column: values(own) for column, own in cells.items() if any(own)}
    return named


def read_rows(path: Path, columns: Iterable[str] = ()) -> list[Row]:
    """Rows of a table, as `numbered_rows`."""
    with open(path, newline="", encoding="utf-8") as file:
        return [row for _, row in numbered_rows(file.read(), path, columns)]


def numbered_rows(text: str, path: Path, columns: Iterable[str] = ()) -> list[tuple[int, Row]]:
    """Rows, each with its line, of a table in the file `path`, which must have some columns.

    A `ValueError` names the line of a missing column or of a wrong width.
    """
    try:
        header, rows = csv_text.rows(text)
    except ValueError as error:
        raise ValueError(f"{path}, {error}") from None
    for column in columns:
        if header.count(column) != 1:
            problem = "stands twice" if column in header else "is missing"
            found = ascii(", ".join(header))[1:-1]
            raise ValueError(f"{path}, line 1: column '{column}' {problem}; found {found}")
    return [(line, dict(zip(header, row, strict=True))) for line, row in rows]


def values(column: Sequence[str]) -> Column:
    """Cells of a column as float64; as text if one of them is no number."""
    try:
        return np.array([float(cell) for cell in column])
    except ValueError:
        return np.array(column)
