"""How C and JavaScript write a file: its template, numbers, tables and comments.

A template is a file of its language. The samples between two marks in comments, such as `<start>`
and `</start>`, are replaced by the blocks of a file, and the name of the template by its own name.
"""

import re
import textwrap
from collections.abc import Mapping
from importlib import resources
from pathlib import Path
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from planarimpact.ground import checks
from planarimpact.ground.checks import InputError

WIDTH = 99
COLUMNS = 12
# A name in C, and not one of those that begin with an underscore: C reserves many of them.
IDENTIFIER = re.compile(r"[A-Za-z][A-Za-z0-9_]*", re.ASCII)
# Lines with the marks of a block, and what is between them.
BLOCK = re.compile(r"^[^\n]*<(\w+)>[^\n]*\n.*?</\1>[^\n]*\n", re.MULTILINE | re.DOTALL)


class Code(str):
    """Code as it stands."""


# Paragraphs of a comment, named constants, a table of numbers, rows of integers, a string, or code.
Block: TypeAlias = list[str] | Mapping[str, float] | NDArray[Any] | list[list[int]] | str | Code


class Language(NamedTuple):
    """How one language writes what every file has.

    Attributes
    ----------
    endings : tuple of str
        Endings of the names of files; the template has the first.
    named : bool
        Whether functions have the name of the file in front of their own.
    numbers : mapping
        Numbers that have no digits, by their names in Python.
    constants : mapping
        A constant, for `str.format` with name and value, by the block that it is in.
    row : str
        A row of a table of rows, for `str.format`.
    field : str
        A field of a structure, for `str.format`.
    preset : str
        A preset, for `str.format`: `comment` on it, `name`, and the fields of `body` and `pair`.
    """

    endings: tuple[str, ...]
    named: bool
    numbers: Mapping[str, str]
    constants: Mapping[str, str]
    row: str
    field: str
    preset: str


LANGUAGES = {
    "c": Language(
        endings=(".h",),
        named=True,
        numbers={"nan": "(double)NAN", "inf": "(double)INFINITY"},
        constants=dict.fromkeys(("public", "private"), "#define {} {}\n"),
        row="{{{}}},\n",
        field="{value}",
        preset="/*\n{comment} */\nstatic const struct {prefix}preset {prefix}{name} = {{\n"
        "    {{{body}}},\n    {{{pair}}}}};\n",
    ),
    "js": Language(
        endings=(".mjs", ".js"),
        named=False,
        numbers={"nan": "NaN", "inf": "Infinity"},
        constants={"public": "export const {} = {};\n", "private": "const {} = {};\n"},
        row="[{}],\n",
        field="{name}: {value}",
        preset="/*\n{comment} */\n{name}: {{\n"
        "    body: {{ {body} }},\n    pair: {{ {pair} }},\n}},\n",
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


def filled(stem: str, blocks: Mapping[str, Block], file: str, name: str, language: str) -> str:
    """The template with this stem, with the names of a file and its blocks."""
    chosen = LANGUAGES[language]
    template = stem + chosen.endings[0]
    text = resources.files(__package__).joinpath("templates", template).read_text(encoding="utf-8")
    names = {template: file, f"{stem}_": f"{name}_", f"{stem}_".upper(): f"{name}_".upper()}
    text = re.sub("|".join(map(re.escape, names)), lambda match: names[match[0]], text)
    prefix = f"{name}_".upper() if chosen.named else ""
    return BLOCK.sub(lambda match: _written(blocks[match[1]], match[1], prefix, chosen), text)


def _written(block: Block, mark: str, prefix: str, language: Language) -> str:
    """A block as lines of code."""
    if isinstance(block, Code):
        return block
    if isinstance(block, str):
        return f'"{block}"\n'
    if isinstance(block, Mapping):
        constant = language.constants[mark]
        return "".join(
            constant.format(prefix + key, _number(value, language)) for key, value in block.items()
        )
    if isinstance(block, np.ndarray):
        values = [_number(value, language) for value in block.ravel().tolist()]
        rows = [values[i : i + COLUMNS] for i in range(0, len(values), COLUMNS)]
        return "".join(",".join(numbers) + ",\n" for numbers in rows)
    return "".join(
        comment(row) if isinstance(row, str) else language.row.format(",".join(map(str, row)))
        for row in block
    )


def _number(value: float, language: Language) -> str:
    """A number with all digits, so that it is read as the same float64.

    >>> [_number(value, LANGUAGES["js"]) for value in (0.1, 1e300, float("inf"), 3)]
    ['0.1', '1e+300', 'Infinity', '3']
    """
    text = str(value)
    return language.numbers.get(text, text)


def comment(paragraph: str) -> str:
    """Lines of a comment, all with the indent of the first; a number such as 1e-05 stays in one."""
    indent = " * " + paragraph[: len(paragraph) - len(paragraph.lstrip())]
    lines = textwrap.wrap(
        paragraph.strip(),
        WIDTH,
        initial_indent=indent,
        subsequent_indent=indent,
        break_on_hyphens=False,
        break_long_words=False,
    )
    return "\n".join(lines or [" *"]) + "\n"
