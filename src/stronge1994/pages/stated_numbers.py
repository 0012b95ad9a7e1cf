"""The numbers that the texts of a lecture state, compared with what its cells give.

The table of a lecture is the YAML file beside its notebook. Each row names a `cell` of text and
quotes, in `says`, words of it. `gives` is an expression in Python: the numbers of the quotation, in
their order. `holds` is an expression that is true if the quotation is. Expressions see all names of
the cells above the text, and those that the lines of `given` make, which leave nothing behind. So
the cells need no assertion, and nothing stops a student who changes a number in them.
"""

import re
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, TypeAlias

import nbformat
import numpy as np

from stronge1994.reference_data import SourceError, load_yaml

Row: TypeAlias = Mapping[str, str]
NUMBER = re.compile(r"(?<![\w.])[−-]?\d+(?:\.\d+)?(?:e-?\d+)?(?: ?%)?")
KEYS = {"cell", "says", "given", "gives", "holds"}
# A cell that a run adds below a text, and that no notebook keeps.
CHECK = """\
from stronge1994.pages import stated_numbers as _stated_numbers
_stated_numbers.compare(globals(), {})"""


class WrongNumberError(Exception):
    """A text says what its cells do not give."""


def numbers(words: str) -> list[tuple[float, float]]:
    """Each number of a text, and half a unit of its last digit.

    >>> numbers("from −1.25 to 14 % of w₁")
    [(-1.25, 0.005), (0.14, 0.005)]
    """
    found = []
    for number in NUMBER.findall(words):
        digits = number.replace("−", "-").rstrip(" %")
        mantissa, _, power = digits.partition("e")
        places = len(mantissa.partition(".")[2]) - int(power or 0) + 2 * number.endswith("%")
        unit = 0.01 if number.endswith("%") else 1.0
        found.append((float(digits) * unit, 0.5 * 10.0**-places))
    return found


def read(path: str | Path, cells: Sequence[Any]) -> list[tuple[Any, list[Row]]]:
    """The cells of a lecture, each with the rows that a table has of its text.

    What a row quotes must stand in the cell that it names. A `SourceError` names the first row that
    cannot be compared, and its file.
    """
    table = load_yaml(path)
    rows = table.get("numbers")
    if set(table) != {"numbers"} or not isinstance(rows, list):
        raise SourceError(f"{path}: allowed is one key, numbers, with a list of rows")
    texts = {cell.get("id"): " ".join(cell.source.split()) for cell in cells}
    for number, row in enumerate(rows, 1):
        if not isinstance(row, dict):
            raise SourceError(f"{path}: row {number}: a row has keys, such as cell and says")
        if fault := _fault(row, texts):
            raise SourceError(f"{path}: {row.get('cell', f'row {number}')}: {fault}")
    return [(cell, [row for row in rows if row["cell"] == cell.get("id")]) for cell in cells]


def _fault(row: Mapping[str, Any], texts: Mapping[str, str]) -> str:
    """What is wrong with a row on one of some texts, or nothing.

    >>> _fault({"cell": "path", "says": "often", "gives": "b"}, {"path": "It is often b."})
    "'often' has no number: holds belongs here"
    """
    for key, value in row.items():
        if key not in KEYS:
            return f"unknown key {key!r}; allowed are {', '.join(sorted(KEYS))}"
        if not (isinstance(value, str) and value.strip()):
            return f"{key} is {value!r}: allowed is a text, in quotes"
    missing = {"cell", "says"} - set(row)
    if missing or ("gives" in row) == ("holds" in row):
        return f"no {min(missing)}" if missing else "either gives or holds belongs here"
    if "gives" in row and not numbers(row["says"]):
        return f"{row['says']!r} has no number: holds belongs here"
    if row["cell"] not in texts:
        return "the lecture has no such cell"
    if " ".join(row["says"].split()) not in texts[row["cell"]]:
        return f"the cell does not say {row['says']!r}"
    return ""


def with_checks(texts: Sequence[tuple[Any, list[Row]]]) -> list[Any]:
    """The cells of a lecture, as `read` gives them, and below each with rows one that compares."""
    both = []
    for cell, own in texts:
        both.append(cell)
        if own:
            both.append(nbformat.v4.new_code_cell(CHECK.format([dict(row) for row in own])))
    return both


def compare(names: Mapping[str, Any], rows: Sequence[Row]) -> None:
    """Compare the `rows` of one text with what the cells above it have given, their `names`.

    >>> compare({"b": 0.4491}, [{"cell": "path", "says": "the share 0.45", "gives": "b"}])
    >>> compare({"b": 0.4491}, [{"cell": "path", "says": "the share 0.46", "gives": "b"}])
    Traceback (most recent call last):
    stronge1994.pages.stated_numbers.WrongNumberError: path: the text says 'the share 0.46', its cells give 0.4491
    """  # noqa: E501  (the message is one line)
    for row in rows:
        try:
            found = _otherwise(dict(names), row)
        except Exception as error:
            found = f"no answer: {type(error).__name__}: {' '.join(str(error).split())}"
        if found:
            raise WrongNumberError(
                f"{row['cell']}: the text says {row['says']!r}, its cells give {found}"
            )


def _otherwise(space: dict[str, Any], row: Row) -> str:
    """What the cells give if it is not what the text says, else nothing."""
    exec(row.get("given", ""), space)
    if "holds" in row:
        return "" if eval(row["holds"], space) else f"no truth of {row['holds']}"
    said = numbers(row["says"])
    given = np.ravel(np.asarray(eval(row["gives"], space), dtype=float))
    right = len(given) == len(said) and all(
        abs(value - wanted) <= half * (1 + 1e-6)
        for value, (wanted, half) in zip(given, said, strict=True)
    )
    return "" if right else ", ".join(f"{value:.6g}" for value in given)
