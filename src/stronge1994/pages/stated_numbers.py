"""The numbers that the texts of a lecture state, compared with what its cells give.

A cell with the tag `check` stands directly below a text and quotes it: `says` compares each number
of a quotation, and the message of an `assert` quotes what has no number. Pages, slides and the
notebook for students do not have these cells. So no cell that a student changes checks anything.
"""

import ast
import dis
import re
from collections.abc import Iterator, Sequence
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

NUMBER = re.compile(r"(?<![\w.])[−-]?\d+(?:\.\d+)?(?:e-?\d+)?(?: ?%)?")
# The names that a check may leave behind: what else it needs it makes in a function.
OF_CHECKS = {"says", "check"}


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


def says(words: str, *values: ArrayLike) -> None:
    """Compare each number of a quotation with one of `values`, to its last digit.

    An AssertionError says what the values are instead.

    >>> says("the share 0.45 at 20°", 0.4491, 20)
    >>> says("the share 0.46", 0.4491)
    Traceback (most recent call last):
    AssertionError: the text says 'the share 0.46', its cells give 0.4491
    """
    said, given = numbers(words), [float(one) for some in values for one in np.ravel(some)]
    if not said:
        raise ValueError(f"{words!r} has no number: assert belongs here")
    right = len(given) == len(said) and all(
        abs(value - wanted) <= half * (1 + 1e-6)
        for value, (wanted, half) in zip(given, said, strict=True)
    )
    if not right:
        found = ", ".join(f"{value:.6g}" for value in given)
        raise AssertionError(f"the text says {words!r}, its cells give {found or 'nothing'}")


def is_check(cell: Any) -> bool:
    """Whether a cell of a notebook checks a text."""
    return "check" in cell.metadata.get("tags", ())


def checked(cells: Sequence[Any]) -> Iterator[tuple[Any, Any]]:
    """The checks among the cells of a lecture, each with the cell above it, or None."""
    return ((text, cell) for text, cell in pairwise([None, *cells]) if is_check(cell))


def quotations(check: str) -> Iterator[tuple[str | None, ast.Call | ast.Assert]]:
    """What the source of a check quotes, and by what; None where that is no text in quotes.

    >>> [words for words, _ in quotations('assert b > 2, "more"; says(f"is {b}", b)')]
    ['more', None]
    """
    for node in ast.walk(ast.parse(check)):
        match node:
            case ast.Call(func=ast.Name(id="says"), args=[quoted, *_]) | ast.Assert(msg=quoted):
                words = getattr(quoted, "value", None)
                yield (words if isinstance(words, str) else None), node


def fault(cells: Sequence[Any]) -> str:
    """What is wrong with the checks of a lecture before any of them runs, or nothing."""
    for text, check in checked(cells):
        if text is None or text.cell_type != "markdown":
            return f"{check.id}: a check stands directly below the text that it quotes"
        try:
            steps = dis.get_instructions(compile(check.source, check.id, "exec"))
        except SyntaxError as error:
            return f"{text.id}: line {error.lineno} of its check: {error.msg}"
        for words, node in quotations(check.source):
            if words is None:
                return f"{text.id}: line {node.lineno} of its check quotes no words of the text"
            if " ".join(words.split()) not in " ".join(text.source.split()):
                return f"{text.id}: the text does not say {words!r}"
        left = {step.argval for step in steps if step.opname == "STORE_NAME"} - OF_CHECKS
        if left:
            return f"{text.id}: its check leaves {min(left)} behind; let a function make it"
    return ""
