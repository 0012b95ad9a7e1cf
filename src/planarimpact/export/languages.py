"""How C and JavaScript write what every file has: its frame, constants, tables and comments."""

import re
import textwrap
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from planarimpact.ground import checks
from planarimpact.ground.checks import InputError

WIDTH = 96
# A name in C, and not one of those that begin with an underscore: C reserves many of them.
IDENTIFIER = re.compile(r"[A-Za-z][A-Za-z0-9_]*", re.ASCII)


class Language(NamedTuple):
    """How one language writes what every file has.

    Attributes
    ----------
    endings : tuple of str
        Of the names of files.
    named : bool
        Whether functions have the name of the file in front of their own.
    others : mapping
        Numbers that have no digits, by their names in Python.
    types : mapping
        Types of tables, by NumPy's types of arrays.
    constant : str
        A number that users may read, for `str.format` with name and value.
    table : str
        A table, for `str.format` with type, name, count and rows.
    file : str
        The whole file, for `str.format` with words, NAME and code.
    """

    endings: tuple[str, ...]
    named: bool
    others: Mapping[str, str]
    types: Mapping[str, str]
    constant: str
    table: str
    file: str


# A compiler without NaN may drop the test of the range, and a table is read beyond its ends. GCC
# and Clang always define the first of these names, MSVC defines the last with /fp:fast.
NAN_IS_KNOWN = """\
#if defined(__FINITE_MATH_ONLY__) ? __FINITE_MATH_ONLY__ : defined(__FAST_MATH__)
#error "This header needs NaN: add -fno-finite-math-only after -ffast-math"
#elif defined(_M_FP_FAST)
#error "This header needs NaN: compile it without /fp:fast"
#endif
"""

LANGUAGES = {
    "c": Language(
        endings=(".h",),
        named=True,
        others={"nan": "(double)NAN", "inf": "(double)INFINITY"},
        types={
            **{"float64": "double", "uint8": "unsigned char", "uint16": "unsigned short"},
            "int32": "int",
        },
        constant="#define {name} {value}\n",
        table="static const {type} {name}[{count}] = {{\n{rows}\n}};\n",
        file="{words}\n#ifndef PLANARIMPACT_{NAME}_H\n#define PLANARIMPACT_{NAME}_H\n\n"
        f"{NAN_IS_KNOWN}\n#include <math.h>\n\n{{code}}\n#endif\n",
    ),
    "js": Language(
        endings=(".mjs", ".js"),
        named=False,
        others={"nan": "NaN", "inf": "Infinity"},
        types={
            **{"float64": "Float64Array", "uint8": "Uint8Array", "uint16": "Uint16Array"},
            "int32": "Int32Array",
        },
        constant="export const {name} = {value};\n",
        table="const {name} = new {type}([\n{rows}\n]);\n",
        file="{words}\n{code}",
    ),
}


def checked_name(path: str | Path, language: str) -> str:
    """The name of a file without its ending, which functions in C begin with; or refuse it.

    Parameters
    ----------
    path : str or Path
    language : str
        A key of `LANGUAGES`.

    Returns
    -------
    str

    Raises
    ------
    InputError
        If there is no such language, the ending is of another one, or functions cannot have the
        name.

    Examples
    --------
    >>> checked_name("build/ball.h", "c")
    'ball'
    >>> checked_name("ball.py", "js")
    Traceback (most recent call last):
    ...
    planarimpact.InputError: ball.py: allowed are names that end in .mjs or .js
    """
    if language not in LANGUAGES:
        raise InputError(f"language = {checks.brief(language)}: allowed are {', '.join(LANGUAGES)}")
    file, chosen = Path(path), LANGUAGES[language]
    if file.suffix.lower() not in chosen.endings:
        raise InputError(f"{path}: allowed are names that end in {' or '.join(chosen.endings)}")
    if chosen.named and not IDENTIFIER.fullmatch(file.stem):
        raise InputError(
            f"{path}: allowed are names of letters from A to Z, digits and underscores, a letter "
            "first, as the functions have this name"
        )
    return file.stem


def number(value: float, language: Language) -> str:
    """A number with all digits, so that it is read as the same float64.

    Examples
    --------
    >>> [number(value, LANGUAGES["js"]) for value in (0.1, 1e300, float("inf"))]
    ['0.1', '1e+300', 'Infinity']
    """
    text = repr(float(value))
    return language.others.get(text, text)


def table(name: str, values: NDArray[Any], language: Language) -> str:
    """An array of constants, flat and row by row, in the type of the values.

    Parameters
    ----------
    name : str
    values : ndarray of float64, uint8 or uint16, shape (n,) or (rows, n)
    language : Language

    Examples
    --------
    >>> print(table("start", np.array([0.0, 0.1, np.inf]), LANGUAGES["c"]), end="")
    static const double start[3] = {
        0.0, 0.1, (double)INFINITY
    };
    """
    kind = values.dtype.name
    write = str if kind != "float64" else lambda value: number(value, language)
    rows = [", ".join(map(write, row)) for row in np.atleast_2d(values).tolist()]
    return language.table.format(
        type=language.types[kind],
        name=name,
        count=values.size,
        rows=",\n".join(_wrapped("    " + row) for row in rows),
    )


def comment(paragraphs: Iterable[str]) -> str:
    """Paragraphs as one comment, which C and JavaScript write alike.

    Examples
    --------
    >>> print(comment(["One pair.", "", "Another line."]), end="")
    /*
     * One pair.
     *
     * Another line.
     */
    """
    lines = "\n".join(map(_wrapped, paragraphs)).split("\n")
    return "\n".join(["/*", *(f" * {line}".rstrip() for line in lines), " */"]) + "\n"


def _wrapped(text: str) -> str:
    """Lines with the indent of the first; a number such as 1e-05 stays in one."""
    indent = text[: len(text) - len(text.lstrip())]
    return textwrap.fill(
        text, WIDTH, subsequent_indent=indent, break_on_hyphens=False, break_long_words=False
    )
