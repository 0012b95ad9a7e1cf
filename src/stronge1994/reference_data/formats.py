"""Text files that others wrote, YAML and CSV: how they are read, and what they may contain.

A `SourceError` names file and line, or file, field, value and what is allowed: a line for each
fault. What a file may contain is declared once, as dataclasses of Pydantic or as a JSON schema.
"""

import copy
import csv
import functools
import io
import itertools
import re
import string
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Annotated, Any, ClassVar, Self, TypeAlias, TypeVar

from pydantic import (
    ConfigDict,
    Field,
    ModelWrapValidatorHandler,
    TypeAdapter,
    ValidationError,
    ValidationInfo,
    model_validator,
)
from pydantic.dataclasses import dataclass

from planarimpact.common import checks
from stronge1994.reference_data import strict_yaml

# What files begin with that are no text in UTF-8.
OTHERS = {b"\xff\xfe": "UTF-16", b"\xfe\xff": "UTF-16", b"\x1f\x8b": "packed by gzip"}
OTHERS |= {b"PK": "a packed file, as of Excel"}
# Names of columns: others write letters of our units otherwise, and have more blanks.
LETTERS = {"\u00b5": "mu", "\u03bc": "mu", "\u03a9": "Omega", "\u2126": "Omega"}
ALIKE = str.maketrans(LETTERS | dict.fromkeys(f"{string.whitespace}\u00a0\u2009\u202f", ""))
# A row whose decimals have commas: `1,5;2,3` or `"1,5","2,3"` or `1,5,2,3`.
WITH_COMMAS = re.compile(r'^"?[+-]?\d+,\d+"? *[,;\t] *"?[+-]?\d+,\d+"? *$', re.M)
COMMAS = "decimal commas; allowed are points, and commas between cells"
SEPARATED = "commas separate cells, and decimals have a point"
Schema: TypeAlias = Mapping[str, Any]
Kind = TypeVar("Kind")
# A text is no number, true is none, and 2.0 is no whole one.
Number: TypeAlias = Annotated[float, Field(strict=True)]
Positive: TypeAlias = Annotated[float, Field(strict=True, gt=0)]
Whole: TypeAlias = Annotated[int, Field(strict=True, ge=1)]
Truth: TypeAlias = Annotated[bool, Field(strict=True)]
Span: TypeAlias = tuple[Number, Number]
CONFIG = ConfigDict(extra="forbid")
# What is allowed, by the type of Pydantic's error.
ALLOWED = {
    "string_type": "a text",
    "float_type": "a number",
    "int_type": "a whole number",
    "bool_type": "true or false",
    "list_type": "a list",
    "tuple_type": "a list",
    "dict_type": "keys with values",
    "dataclass_type": "keys with values",
    "literal_error": "{expected}",
    "enum": "{expected}",
    "greater_than": "more than {gt:g}",
    "greater_than_equal": "{ge:g} or more",
    "less_than_equal": "up to {le:g}",
    "string_too_short": "a text of {min_length} characters or more",
    "string_pattern_mismatch": "a text as {pattern}",
    "too_short": "a list of {min_length} or more",
    "too_long": "up to {max_length} of them",
}


class SourceError(Exception):
    """Something in data/ or in the settings is not admissible: a line for each fault."""


class Faults(list[str]):
    """Faults that are told together: a `with` notes that of its block, and goes on."""

    def __enter__(self) -> Self:
        return self

    def __exit__(self, kind: Any, error: BaseException | None, trace: Any) -> bool:
        if isinstance(error, SourceError):
            self.append(f"{error}")
        return isinstance(error, SourceError)

    def refuse(self) -> None:
        """Raise them, if there are any."""
        if self:
            raise SourceError("\n".join(self))


def text_of(path: str | Path) -> str:
    """Text of a file in UTF-8, without the mark that Excel puts first."""
    try:
        content = Path(path).read_bytes()
        return content.decode("utf-8-sig")
    except OSError as error:
        raise SourceError(f"{path}: {error.strerror}") from None
    except UnicodeDecodeError as error:
        problem = f"byte 0x{error.object[error.start]:02x} is no UTF-8; save the file as UTF-8"
        if content[:2] in OTHERS:
            problem = f"it is {OTHERS[content[:2]]}; allowed is text, saved as UTF-8"
        line = 1 + error.object[: error.start].count(b"\n")
        raise SourceError(f"{path}, line {line}: {problem}") from None


def load_yaml(path: str | Path) -> dict[str, Any]:
    """Read a YAML file: a mapping whose keys are texts."""
    try:
        return copy.deepcopy(_parsed(text_of(path)))
    except ValueError as error:
        raise SourceError(f"{path}, {error}") from None


_parsed = functools.cache(strict_yaml.load)  # a start reads some files twice


def head_and_table(text: str) -> tuple[list[str], str]:
    r"""Lines with # before a table, and the text with blank ones there: lines keep their numbers.

    >>> head_and_table("# who: me\na,b\n1,2\n")
    (['# who: me\n'], '\na,b\n1,2\n')
    """
    lines = list(io.StringIO(text, newline=None))
    head = list(itertools.takewhile(lambda line: line.strip('" \t\r\n')[:1] in ("", "#"), lines))
    return head, "\n" * len(head) + "".join(lines[len(head) :])


def cells_of(path: str, columns: list[str]) -> tuple[list[int], dict[str, list[str]]]:
    """Lines of the rows of a table, and the cells of these columns, which it must have.

    A header may lack the unit of a column that has its name alone, or have other blanks in it.
    """
    head, text = head_and_table(text_of(path))
    try:
        (first, header), *rows = _rows(text)
    except ValueError as error:
        problem = f"{error}"
        if row := WITH_COMMAS.search(text):
            line = text.count("\n", 0, row.start()) + 1
            problem = f"line {line}: {row[0]!a} has {COMMAS}"
        raise SourceError(f"{path}, {problem}") from None
    found, bare = (
        [cell.translate(ALIKE) for cell in header],
        [name.partition(" [")[0] for name in columns],
    )
    cells = {}
    for column, name in zip(columns, bare, strict=True):
        known = {
            column.translate(ALIKE),
            (name if bare.count(name) == 1 else column).translate(ALIKE),
        }
        places = [place for place, cell in enumerate(found) if cell in known]
        if len(places) != 1:
            problem = "stands twice" if places else "is missing"
            there = ascii(", ".join(" ".join(cell.split()) for cell in header))[1:-1]
            where = f"{path}, line {len(head) + 1}"
            raise SourceError(f"{where}: column '{column}' {problem}; found {there}")
        cells[column] = [row[places[0]].strip() for _, row in rows]
    if not rows:
        raise SourceError(f"{path}: no points")
    return [line for line, _ in rows], cells


def _rows(text: str) -> list[tuple[int, list[str]]]:
    r"""Rows of a table with the numbers of their last lines, its header first; blank ones are none.

    >>> _rows("a,b\n\n1,2\n")
    [(1, ['a', 'b']), (3, ['1', '2'])]
    """
    reader = csv.reader(io.StringIO(text, newline=""), strict=True)
    try:
        every = [(reader.line_num, cells) for cells in reader]
    except csv.Error as error:
        raise ValueError(f"line {reader.line_num}: {error}") from None
    rows = [(line, cells) for line, cells in every if len(cells) > 1 or "".join(cells).strip()]
    line, header = rows[0] if rows else (1 + text.count("\n"), [])
    if "\0" in text:
        line = 1 + text[: text.index("\0")].count("\n")
        problem = "it has the character NUL, as UTF-16 has; save the file as UTF-8"
    elif not header:
        problem = "it is empty; a header and rows belong there"
    elif header[0].startswith("sep="):
        problem = f"{','.join(header)!a} is for Excel alone: remove this line; {SEPARATED}"
    elif len(header) == 1 and (marks := {*";\t"} & {*header[0]}):
        problem = f"{max(marks)!a} stands between cells; {SEPARATED}"
    elif others := [row for row in rows if len(row[1]) != len(header)]:
        line, cells = others[0]
        problem = f"{len(cells)} cells where {len(header)} belong"
    else:
        return rows
    raise ValueError(f"line {line}: {problem}")


@dataclass(frozen=True, config=CONFIG)
class Declared:
    """A part of a file. What our code makes of it is not asked for its `faults`."""

    OURS: ClassVar[tuple[str, ...]] = ()  # fields that no file states

    def faults(self) -> Iterator[str]:
        """What is wrong beyond the types of single fields: `field: what is allowed`."""
        yield from ()

    @model_validator(mode="wrap")
    @classmethod
    def _of_file(
        cls, given: Any, handler: ModelWrapValidatorHandler[Self], info: ValidationInfo
    ) -> Self:
        """Note the keys that a mapping of a file may have, for `in_words`, and refuse faults."""
        if info.context is not None and isinstance(given, dict):
            declared: Any = cls  # Pydantic has noted its fields
            every = {own.alias or key: key for key, own in declared.__pydantic_fields__.items()}
            allowed = ", ".join(key for key, name in every.items() if name not in cls.OURS)
            info.context[id(given)] = allowed
            if ours := set(given) & set(cls.OURS) - info.context["ours"]:
                raise ValueError(f"{min(ours)}: no such key; allowed are {allowed}")
        made = handler(given)
        if info.context is not None and (found := list(made.faults())):
            raise ValueError("\n".join(found))
        return made


def read(kind: type[Kind], document: Any, where: str | Path, **ours: Any) -> Kind:
    """What a file states, with fields of `ours`, as an object of a class that is `Declared`.

    >>> from stronge1994.reference_data.series import Parameter
    >>> read(Parameter, {"value": "1", "unit": "N", "uncertainty": None}, "ball.yaml")
    Traceback (most recent call last):
    stronge1994.reference_data.formats.SourceError: ball.yaml: value = '1': allowed is a number
    ball.yaml: origin: missing
    """
    whole = {**document, **ours} if ours else document
    keys: dict[Any, Any] = {"ours": set(ours)}
    try:
        return TypeAdapter(kind).validate_python(whole, context=keys)
    except ValidationError as error:
        told = in_words(error, whole, keys)
        mark = "." if ": " in f"{where}" else ": "  # where is a file, or a place in it
        raise SourceError("\n".join(f"{where}{mark}{line}" for line in told)) from None


def in_words(error: ValidationError, document: Any, keys: Mapping[Any, Any]) -> list[str]:
    """Pydantic's errors in our words; `keys` are those allowed in each mapping of the document."""
    told: dict[str, list[str]] = {}  # what is allowed: one of several types
    for one in error.errors(include_url=False):
        kind, places, node, parent = one["type"], [], document, document
        for part in one["loc"]:
            try:
                node, parent = node[part], node
            except (LookupError, TypeError):
                if kind != "missing":
                    continue  # the name that Pydantic gives to one of several types
            places.append(f"{part}")
        place = ".".join(places)
        if kind == "value_error":
            faults = str(one["ctx"]["error"]).splitlines()
            told |= {f"{place}.{fault}" if place else fault: [] for fault in faults}
        elif kind == "missing":
            told[f"{place}: missing"] = []
        elif kind == "unexpected_keyword_argument":
            told[f"{place}: no such key; allowed are {keys[id(parent)]}"] = []
        else:
            allowed = ALLOWED.get(kind, one["msg"]).format(**one.get("ctx", {})).replace("'", "")
            told.setdefault(
                f"{place or 'all of it'} = {shown(one['input'])}: allowed is", []
            ).append(allowed)
    lines = (" ".join(filter(None, [what, " or ".join(of)])) for what, of in told.items())
    return [checks.in_ascii(line) for line in lines]


def shown(value: Any) -> str:
    """A value in a message, its beginning if it is long."""
    text = f"{value!a}"
    return text if len(text) < 80 else f"{text[:70]} ..."


@functools.cache
def _validator() -> Any:
    """Class of validators of a JSON schema, whose arrays may be `ascending`.

    It takes 2.0 for an integer, range() refuses it; so do we.
    """
    import jsonschema  # slow to load, and jobs that only name columns do without it

    def ascends(_: Any, wanted: bool, numbers: Any, schema: Schema) -> Iterator[Exception]:
        items = numbers if isinstance(numbers, list) else []
        are_numbers = all(isinstance(number, int | float) for number in items)
        if wanted and are_numbers and sorted(set(items)) != items:
            problem = f"{numbers}: each number must be larger than that before"
            yield jsonschema.ValidationError(problem)

    draft = jsonschema.Draft202012Validator
    types = draft.TYPE_CHECKER.redefine(
        "integer", lambda _, value: isinstance(value, int) and not isinstance(value, bool)
    )
    return jsonschema.validators.extend(draft, {"ascending": ascends}, type_checker=types)


def refuse_invalid(document: Any, schema: Schema, name: str | Path) -> None:
    """Refuse a document that its JSON schema does not admit."""
    faults = Faults()
    for error in _validator()(schema).iter_errors(document):
        where = ".".join(map(str, error.path)) or "top level"
        broken = error.schema if isinstance(error.schema, dict) else {}  # else a bool
        known = ", ".join(broken.get("properties", {}))
        allowed = f"; allowed are {known}" if "unexpected" in error.message else ""
        if error.validator == "minLength":
            allowed = f"; allowed are texts of {error.validator_value} characters or more"
        faults.append(f"{name}: {checks.in_ascii(f'{where}: {error.message}')}{allowed}")
    faults.sort()
    faults.refuse()
