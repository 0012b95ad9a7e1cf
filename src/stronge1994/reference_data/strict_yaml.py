"""YAML 1.2, refused where a reader of YAML 1.1, as Snakemake has, finds something else in it.

PyYAML, of YAML 1.1, silently keeps the last of two equal keys, reads 010 as 8, 6:40 as 400, 1_21 as
121, no as false, and takes 4e-1 for a text.
"""

import math
import re
from typing import Any

import yaml

# Numbers that every reader understands alike.
NUMBERS = {
    "int": re.compile(r"[-+]?(0|[1-9][0-9]{0,17})"),
    "float": re.compile(r"[-+]?((0|[1-9][0-9]*)\.?[0-9]*|\.[0-9]+)(e[-+]?[0-9]+)?$", flags=re.I),
}
# All other kinds of values: a date would be no text.
KINDS = ("str", "bool", "null", "seq", "map", "merge")
MERGE = "tag:yaml.org,2002:merge"
_Fast: Any = getattr(yaml, "CSafeLoader", yaml.SafeLoader)  # some installations lack it


class Loader(_Fast):
    """A loader that knows the numbers of YAML 1.2: 4e-1 too."""

    def flatten_mapping(self, node: yaml.MappingNode) -> None:
        """Put merged keys into a mapping: its own ones win, then those of the first source.

        Versions of PyYAML differ here: 6.0.4 takes the key of a source's source before its own.
        """
        known: dict[str, tuple[yaml.Node, yaml.Node]] = {}
        own = {key.value: (key, value) for key, value in node.value if key.tag != MERGE}
        for key, value in node.value:
            if key.tag != MERGE:
                continue
            for source in value.value if isinstance(value, yaml.SequenceNode) else [value]:
                if not isinstance(source, yaml.MappingNode):
                    raise yaml.MarkedYAMLError(None, None, "<< needs a mapping", key.start_mark)
                self.flatten_mapping(source)
                known = {one[0].value: one for one in source.value} | known
        node.value = list((known | own).values())


Loader.add_implicit_resolver("tag:yaml.org,2002:float", NUMBERS["float"], [*"+-.0123456789"])


def load(text: str) -> dict[str, Any]:
    """Read a document, a mapping. A ValueError has one line, which begins with that of the text.

    >>> load("a: &one {b: 1}\\nc: {<<: *one, d: 2}")
    {'a': {'b': 1}, 'c': {'b': 1, 'd': 2}}
    >>> load("a: 1\\na: 2")
    Traceback (most recent call last):
    ValueError: line 2: the key 'a' stands twice
    """
    try:
        loader = Loader(text)
        node = loader.get_single_node()
        if not isinstance(node, yaml.MappingNode):
            raise ValueError("line 1: keys with values belong here, a mapping")
        _check(node)
        return loader.construct_document(node)
    except yaml.MarkedYAMLError as error:
        mark = error.problem_mark or error.context_mark
        problem = " ".join(part for part in (error.context, error.problem) if part)
        raise ValueError(f"line {mark.line + 1}: {problem}") from None
    except yaml.reader.ReaderError as error:
        raise ValueError(f"line 1 or later: {' '.join(str(error).split())}") from None
    except RecursionError:
        raise ValueError("line 1: too deep") from None


def _check(node: yaml.Node) -> None:
    """Refuse numbers, dates and keys that would be misread, before merge keys are resolved."""

    def refuse(what: str, at: yaml.Node) -> None:
        raise ValueError(f"line {at.start_mark.line + 1}: {what}")

    kind = node.tag.rpartition(":")[2]
    if kind in NUMBERS and not NUMBERS[kind].fullmatch(node.value):
        refuse(f"{node.value[:60]!a} is no decimal number such as -0.05", node)
    if kind in NUMBERS and not math.isfinite(float(node.value)):
        refuse(f"{node.value[:60]!a} is too large", node)
    if kind not in (*NUMBERS, *KINDS):
        refuse(f"{str(node.value)[:60]!a} is a {kind}; a text has quotes around it", node)
    if kind == "bool" and node.value.lower() not in ("true", "false"):
        refuse(f"{node.value!a}: allowed are true and false; a text has quotes around it", node)
    if isinstance(node, yaml.MappingNode):
        known = set()
        for key, value in node.value:
            if key.tag.rpartition(":")[2] not in ("str", "merge") or isinstance(key.value, list):
                refuse(f"the key {key.value!a} is no text", key)
            if key.value in known:
                refuse(f"the key {key.value!a} stands twice", key)
            known.add(key.value)
            _check(value)
    elif isinstance(node, yaml.SequenceNode):
        for item in node.value:
            _check(item)
