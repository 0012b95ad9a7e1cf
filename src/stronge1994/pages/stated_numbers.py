"""The numbers that the texts of a lecture state, compared with what its cells give.

The table of a lecture is the YAML file beside its notebook. Each row names a `cell` of text and
quotes, in `says`, words of it. `gives` is an expression in Python: the numbers of the quotation, in
their order. `holds` is an expression that is true if the quotation is. Expressions see all names of
the cells above the text, and those that the lines of `given` make, which leave nothing behind. So
the cells need no assertion, and nothing stops a student who changes a number in them.
"""

import re
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

NUMBER = re.compile(r"(?<![\w.])[−-]?\d+(?:\.\d+)?(?:e-?\d+)?(?: ?%)?")


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


def with_checks(cells: Sequence[Any], rows: Sequence[Mapping[str, str]]) -> list[tuple[Any, list]]:
    """Each cell with the rows of its text.

    A ValueError names a row whose cell or words are not in the lecture.
    """
    texts = {cell.get("id"): " ".join(cell.source.split()) for cell in cells}
    for row in rows:
        if " ".join(row["says"].split()) not in texts.get(row["cell"], ""):
            raise ValueError(f"{row['cell']}: no cell of the lecture says {row['says']!r}")
    return [(cell, [row for row in rows if row["cell"] == cell.get("id")]) for cell in cells]


def compare(names: Mapping[str, Any], rows: Sequence[Mapping[str, str]]) -> None:
    """Compare the `rows` of one text with what the cells above it have given, their `names`.

    >>> compare({"b": 0.4491}, [{"cell": "path", "says": "the share 0.45", "gives": "b"}])
    >>> compare({"b": 0.4491}, [{"cell": "path", "says": "the share 0.46", "gives": "b"}])
    Traceback (most recent call last):
    stronge1994.pages.stated_numbers.WrongNumberError: path: the text says 'the share 0.46', its cells give 0.4491
    """
    for row in rows:
        space = dict(names)
        exec(row.get("given", ""), space)
        if "holds" in row:
            right, found = bool(eval(row["holds"], space)), f"no truth of {row['holds']}"
        else:
            said = numbers(row["says"])
            given = np.ravel(np.asarray(eval(row["gives"], space), dtype=float))
            right = len(given) == len(said) and all(
                abs(value - wanted) <= half * (1 + 1e-6)
                for value, (wanted, half) in zip(given, said, strict=True)
            )
            found = ", ".join(f"{value:.6g}" for value in given)
        if not right:
            raise WrongNumberError(
                f"{row['cell']}: the text says {row['says']!r}, its cells give {found}"
            )
