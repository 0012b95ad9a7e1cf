"""The figure.yaml of each folder of `figures` and `studies`: settings, caption, comparisons."""

import copy
import functools
import itertools
import os
import re
from collections.abc import Iterator, Mapping
from dataclasses import fields
from pathlib import Path
from typing import Any, TypeAlias

from stronge1994 import reference_data
from stronge1994.judging.comparisons import Comparison
from stronge1994.names import home, is_of_paper
from stronge1994.reference_data import Faults, SourceError

Stated: TypeAlias = dict[str, Any]  # contents of a figure.yaml
PACKAGE = Path(__file__).parents[1]  # of the folders `figures` and `studies`
PROJECT = Path(__file__).parents[3]
KEYS = {own.name for own in fields(Comparison)}  # of a comparison


@functools.cache
def stated() -> dict[str, Stated]:
    """Every figure.yaml, checked; the figures of the paper first."""
    # `shared` is code for several figures. A folder that git has emptied may still hold bytecode.
    folders = [*PACKAGE.glob("figures/*"), *PACKAGE.glob("studies/*")]
    folders = [path for path in folders if any(path.glob("*.*"))]
    contents, faults = {}, Faults()
    for folder in sorted(folders, key=lambda folder: (not is_of_paper(folder.name), folder.name)):
        if folder.name not in ("shared", "__pycache__"):
            with faults:
                contents[folder.name] = _read(folder)
    faults.refuse()
    return contents


def _read(folder: Path) -> Stated:
    name, path = folder.name, file_of(folder.name)
    if folder.parent.name != home(name):
        raise SourceError(f"{folder}: figures/ has Figs 2 to 9, and studies/ has all others")
    if not re.fullmatch("(?!scene_)[a-z][a-z0-9_]*", name):
        problem = "allowed are a to z, 0 to 9 and _, and not scene_ at the beginning"
        raise SourceError(f"{path.parent}: {problem}")
    for file in ("curves.py", "drawing.py"):
        if not path.with_name(file).is_file():
            raise SourceError(f"{path.with_name(file)}: missing")
    content = reference_data.load_yaml(path)
    reference_data.refuse_invalid(content, schema("figure"), path)
    own, kinds = schema_of(content["settings"]), schema("config")["$defs"]
    for kind in set(re.findall(r"#/\$defs/(\w+)", f"{own}")) - set(kinds):
        problem = f"{kind!a} is no kind of values; allowed are {', '.join(kinds)}"
        raise SourceError(f"{path}: settings: allowed: {problem}")
    settings = values(content["settings"])
    reference_data.refuse_invalid(settings, own | {"$defs": kinds}, f"{path}: settings")
    return content


def with_trait(trait: str) -> list[str]:
    """Names of the figures that state a trait."""
    return [name for name, figure in stated().items() if figure.get(trait, False) is not False]


def values(settings: Mapping[str, Any]) -> dict[str, Any]:
    """Values of settings.

    >>> values({"contact": {"friction": {"value": 0.5, "allowed": "friction"}}})
    {'contact': {'friction': 0.5}}
    """
    return {
        key: copy.deepcopy(node["value"]) if "allowed" in node else values(node)
        for key, node in settings.items()
    }


def schema_of(settings: Mapping[str, Any]) -> dict[str, Any]:
    """JSON schema of settings; a kind of value stands under `$defs` of the config's schema.

    >>> schema_of({"a": {"value": 1, "allowed": "count"}})["properties"]
    {'a': {'$ref': '#/$defs/count'}}
    """

    def allowed(node: Mapping[str, Any]) -> dict[str, Any]:
        if "allowed" not in node:  # a group of settings
            return schema_of(node)
        kind = node["allowed"]
        return {"$ref": f"#/$defs/{kind}"} if isinstance(kind, str) else kind

    return {
        "type": "object",
        "additionalProperties": False,
        "required": list(settings),
        "properties": {key: allowed(node) for key, node in settings.items()},
    }


def comparisons() -> dict[str, dict[str, Any]]:
    """All comparisons, `{FIGURE-NAME: entry}`, each with the name of its figure."""
    entries: dict[str, dict[str, Any]] = {}
    for figure, content in stated().items():
        for pattern, common in content["comparisons"].items():
            where = f"{file_of(figure)}: comparisons.{pattern}"
            for name, entry in expanded(pattern, common):
                if placeholder := re.search(r"(?<!mathrm)\{\w*\}", f"{name} {entry}"):
                    raise SourceError(f"{where}: `each` has no {placeholder[0]}")
                if f"{figure}-{name}" in entries:
                    raise SourceError(f"{where}: {name!a} stands twice")
                entries[f"{figure}-{name}"] = {"figure": figure} | entry
    return entries


def expanded(name: str, entry: Mapping[str, Any]) -> Iterator[tuple[str, dict[str, Any]]]:
    """Comparisons from one entry that differ only by the cases of `each`.

    `each` is a list of cases, or lists of which every combination is a case. A value of a case
    replaces its name in braces in all texts; a key of a comparison is also entered into it.

    >>> entry = {"curve": {"model": "lumped", "e": "{e}"}}
    >>> entry["each"] = {"e": [0.5], "regime": ["initial stick", "slip throughout"]}
    >>> for comparison in expanded("e-{e}-{regime}", entry):
    ...     print(*comparison)
    e-0.5-initial-stick {'curve': {'model': 'lumped', 'e': 0.5}, 'regime': 'initial stick'}
    e-0.5-slip-throughout {'curve': {'model': 'lumped', 'e': 0.5}, 'regime': 'slip throughout'}
    """
    common = {key: value for key, value in entry.items() if key != "each"}
    each = entry.get("each", {})
    if isinstance(each, dict):
        each = [dict(zip(each, case, strict=True)) for case in itertools.product(*each.values())]
    for case in each:
        own = {key: value for key, value in case.items() if key in KEYS}
        yield _filled(name, case).replace(" ", "-"), _filled(common | own, case)


def _filled(node: Any, case: Mapping[str, Any]) -> Any:
    """A part of an entry, with the values of a case in place of their names in braces."""
    if isinstance(node, dict):
        return {key: _filled(value, case) for key, value in node.items()}
    if isinstance(node, str):
        if node[1:-1] in case and node == f"{{{node[1:-1]}}}":
            return case[node[1:-1]]  # a number stays one
        for key, value in case.items():
            node = node.replace(f"{{{key}}}", str(value))
    return node


@functools.cache
def schema(of: str) -> dict[str, Any]:
    """What a figure.yaml may state, or the config, with kinds of values under `$defs`."""
    return reference_data.load_yaml(PROJECT / f"workflow/schemas/{of}.schema.yaml")


def folder_of(figure: str) -> Path:
    """Folder of a figure.

    >>> folder_of("fig5").as_posix(), folder_of("rod").as_posix()
    ('src/stronge1994/figures/fig5', 'src/stronge1994/studies/rod')
    """
    return Path(os.path.relpath(PACKAGE / home(figure) / figure))


def file_of(figure: str) -> Path:
    """The figure.yaml of a figure."""
    return folder_of(figure) / "figure.yaml"
