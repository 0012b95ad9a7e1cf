"""What a file may contain: declared once, as dataclasses of Pydantic, or as a JSON schema.

All faults of a file are told at once, a line for each: file, field, value, and what is allowed.
"""

import functools
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Annotated, Any, ClassVar, Self, TypeAlias, TypeVar

from pydantic import (
    ConfigDict,
    Field,
    TypeAdapter,
    ValidationError,
    ValidationInfo,
    model_validator,
)
from pydantic.dataclasses import dataclass

from planarimpact.common import checks
from stronge1994.reference_data.texts import Faults, SourceError

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


@dataclass(frozen=True, config=CONFIG)
class Declared:
    """A part of a file. What our code makes of it is not asked for its `faults`."""

    OURS: ClassVar[tuple[str, ...]] = ()  # fields that no file states

    def faults(self) -> Iterator[str]:
        """What is wrong beyond the types of single fields: `field: what is allowed`."""
        yield from ()

    @model_validator(mode="before")
    @classmethod
    def _note_keys(cls, given: Any, info: ValidationInfo) -> Any:
        """Note the keys that a mapping of a file may have, for `in_words`."""
        if info.context is not None and isinstance(given, dict):
            declared: Any = cls  # Pydantic has noted its fields
            every = {own.alias or name: name for name, own in declared.__pydantic_fields__.items()}
            allowed = ", ".join(key for key, name in every.items() if name not in cls.OURS)
            info.context[id(given)] = allowed
            if ours := set(given) & set(cls.OURS) - info.context["ours"]:
                raise ValueError(f"{min(ours)}: no such key; allowed are {allowed}")
        return given

    @model_validator(mode="after")
    def _refuse_faults(self, info: ValidationInfo) -> Self:
        if info.context is not None and (found := list(self.faults())):
            raise ValueError("\n".join(found))
        return self


def read(kind: type[Kind], document: Any, where: str | Path, **ours: Any) -> Kind:
    """What a file states, with fields of `ours`, as an object of a class that is `Declared`.

    >>> from stronge1994.reference_data.series import Parameter
    >>> read(Parameter, {"value": "1", "unit": "N", "uncertainty": None}, "ball.yaml")
    Traceback (most recent call last):
    stronge1994.reference_data.texts.SourceError: ball.yaml: value = '1': allowed is a number
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
