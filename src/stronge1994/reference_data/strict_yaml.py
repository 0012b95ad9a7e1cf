"""YAML that is refused where PyYAML would lose something, crash, or fill the memory.

If a key stands twice, PyYAML keeps the last one without a word. A date that does not exist ends in
a ValueError. A few lines of aliases can stand for more values than fit into memory. And 010 is read
as 8, 6:40 as 400, 1_21 as 121.
"""

import re
from typing import Any, NoReturn

import yaml

# Most levels of a document. Those of this project have ten.
DEEPEST = 50
# Most values of a document, with aliases written out. The largest of this project has 2203.
MOST_VALUES = 100_000
# Numbers that every reader understands alike. Infinities and NaN are left to the schemas.
NUMBERS = {
    "tag:yaml.org,2002:int": re.compile(r"[-+]?(0|[1-9][0-9]*)"),
    "tag:yaml.org,2002:float": re.compile(
        r"[-+]?([0-9]+\.?[0-9]*|\.[0-9]+)(e[-+]?[0-9]+)?|[-+]?\.(inf|nan)", flags=re.I
    ),
}
TEXT, MERGE = "tag:yaml.org,2002:str", "tag:yaml.org,2002:merge"


def load(text: str) -> dict[str, Any]:
    """Read a document: a mapping with texts as keys, each once.

    Parameters
    ----------
    text : str

    Returns
    -------
    dict

    Raises
    ------
    ValueError
        In one line, which begins with that of the document.

    Examples
    --------
    >>> load("a: &one {b: 1}\\nc: {<<: *one, d: 2}")
    {'a': {'b': 1}, 'c': {'b': 1, 'd': 2}}
    >>> load("a: 1\\na: 2")
    Traceback (most recent call last):
    ValueError: line 2: the key 'a' stands twice
    """
    try:
        document = yaml.load(text, Loader=_Loader)
    except yaml.reader.ReaderError as error:
        line = text.count("\n", 0, error.position) + 1
        raise ValueError(f"line {line}: {_no_character(error.character)}") from None
    except yaml.MarkedYAMLError as error:
        mark = error.problem_mark or error.context_mark
        words = ", ".join(part for part in (error.context, error.problem) if part)
        raise ValueError(f"line {mark.line + 1}: {' '.join(words.split())}") from None
    if not isinstance(document, dict):
        kind = {"NoneType": "nothing", "list": "a list"}.get(type(document).__name__, "a value")
        raise ValueError(f"line 1: {kind} where a mapping belongs, keys with values")
    return document


class _Loader(yaml.SafeLoader):
    """Counts while it reads: there an alias takes no memory, however much it stands for."""

    def __init__(self, stream: str) -> None:
        super().__init__(stream)
        self._level = self._values = 0

    def compose_node(self, parent: Any, index: Any) -> Any:
        """Compose a node, unless it is too deep or there are too many."""
        event = self.peek_event()
        is_alias, before = isinstance(event, yaml.AliasEvent), self._values
        self._level += 1
        self._values += 1
        self._refuse_too_much(self._level, event.start_mark)
        node = super().compose_node(parent, index)
        if not is_alias:
            node.size = self._values - before
            node.height = 1 + max((child.height for child in _inside(node)), default=0)
        elif not hasattr(node, "size"):
            _refuse(f"the alias '*{event.anchor}' stands inside its own anchor", event.start_mark)
        else:
            self._values += node.size - 1
            self._refuse_too_much(self._level + node.height - 1, event.start_mark)
        self._level -= 1
        return node

    def _refuse_too_much(self, level: int, mark: Any) -> None:
        if level > DEEPEST:
            _refuse(f"deeper than {DEEPEST} levels", mark)
        if self._values > MOST_VALUES:
            _refuse(f"more than {MOST_VALUES} values, with aliases written out", mark)

    def compose_scalar_node(self, anchor: Any) -> Any:
        """Compose a scalar of characters that a file can hold."""
        node = super().compose_scalar_node(anchor)
        for character in node.value:
            if character == "\0" or "\ud800" <= character <= "\udfff":
                _refuse(_no_character(ord(character)), node.start_mark)
        if node.tag in NUMBERS and not NUMBERS[node.tag].fullmatch(node.value):
            _refuse(f"{node.value[:60]!r} is no decimal number such as -0.05", node.start_mark)
        return node

    def compose_mapping_node(self, anchor: Any) -> Any:
        """Compose a mapping with every key once; what a merge brings may be overridden."""
        node = super().compose_mapping_node(anchor)
        known = set()
        for key, _ in node.value:
            if not isinstance(key, yaml.ScalarNode):
                _refuse("a key is no text", key.start_mark)
            if key.tag not in (TEXT, MERGE):
                _refuse(f"the key '{key.value}' is no text", key.start_mark)
            if key.value in known:
                _refuse(f"the key '{key.value}' stands twice", key.start_mark)
            known.add(key.value)
        return node

    def construct_object(self, node: Any, deep: bool = False) -> Any:
        """Build a value; a text that cannot be one is refused, in whichever way PyYAML fails."""
        try:
            return super().construct_object(node, deep)
        except (ArithmeticError, AttributeError, LookupError, TypeError, ValueError):
            kind = node.tag.rpartition(":")[2]
            _refuse(f"{node.value[:60]!r} is no {kind}", node.start_mark)


def _inside(node: Any) -> list[Any]:
    if isinstance(node, yaml.MappingNode):
        return [child for pair in node.value for child in pair]
    return node.value if isinstance(node, yaml.SequenceNode) else []


def _no_character(code: int) -> str:
    return f"U+{code:04X} is no character of a text"


def _refuse(what: str, mark: Any) -> NoReturn:
    raise yaml.constructor.ConstructorError(None, None, what, mark)
