"""The interface of the solver and of the printed formulas, as pages that pdoc makes."""

import ast
import doctest
import inspect
import re
import sys
from pathlib import Path
from types import ModuleType
from typing import Any, get_args
from unittest import mock

from markupsafe import Markup

from planarimpact.ground import arrays
from stronge1994 import csv_tables
from stronge1994.pages import templates

# Packages for users: the solver and the paper's formulas.
PACKAGES = ("planarimpact", "stronge1994.printed")
# Types with a name of their own in the sources. A type comes before those that it contains.
NAMED_TYPES = {
    "Curves": csv_tables.Curves,
    "Numbers": arrays.Numbers,
    "ArrayLike": arrays.ArrayLike,
    "Array": arrays.Array,
    "Integers": arrays.Integers,
    "Booleans": arrays.Booleans,
}


def write(folder: str, replaced_templates: str | Path) -> None:
    """Write the pages into a folder; `replaced_templates` is the folder of ours for pdoc."""
    import pdoc
    import pdoc.render
    from pygments.formatters import HtmlFormatter  # type: ignore[import-untyped]

    plain = inspect.formatannotation

    def named(annotation: Any, *arguments: Any) -> str:
        members, of_array_like = get_args(annotation), get_args(arrays.ArrayLike)
        if all(member in members for member in of_array_like):  # in one flat union with others
            others = [member for member in members if member not in of_array_like]
            return " | ".join(["ArrayLike", *(named(member) for member in others)])
        return with_names_of_types(plain(annotation, *arguments))

    pdoc.render.configure(
        docformat="numpy",
        footer_text="planarimpact",
        include_undocumented=False,
        template_directory=Path(replaced_templates),
    )
    # The bar and the theme of all pages; the theme takes the place of that of pdoc.
    pdoc.render.env.loader.searchpath.insert(1, templates.SHARED)  # type: ignore[union-attr]
    pdoc.render.env.filters |= {"runnable": runnable, "short_names": short_names}
    dark = HtmlFormatter(style="github-dark").get_style_defs(".pdoc-code")
    pdoc.render.env.globals["dark_code"] = dark
    # pdoc has no option for the names of types.
    with (
        mock.patch("inspect.formatannotation", named),
        mock.patch("pdoc.doc.formatannotation", named),
    ):
        pdoc.pdoc(*PACKAGES, output_directory=Path(folder))


def with_names_of_types(annotation: str) -> str:
    """An annotation with the names that the sources give to types: NumPy's own fill a screen.

    >>> with_names_of_types(f"tuple[{arrays.Array}, {arrays.Numbers}, {arrays.ArrayLike}]")
    'tuple[Array, Numbers, ArrayLike]'
    """
    annotation = annotation.replace("typing.", "")
    for name, full in NAMED_TYPES.items():
        annotation = annotation.replace(str(full).replace("typing.", ""), name)
    return annotation


def runnable(docstring: str, page: str, defined_in: str) -> str:
    """A docstring whose examples begin with the imports of what they use.

    `page` is the module by which a reader reaches the function, `defined_in` the one that has it.

    >>> module = "stronge1994.pages.interface"
    >>> runnable("  >>> three = Path('3')", module, module).splitlines()
    ['  >>> from pathlib import Path', "  >>> three = Path('3')"]
    """
    examples = doctest.DocTestParser().get_examples(docstring)
    statements = _imports(_unbound_names(examples), page, sys.modules[defined_in])
    lines = [f">>> {statement}\n" for statement in statements]
    return re.sub(
        r"^( *)(?=>>> )",
        lambda indent: indent[1] + indent[1].join([*lines, ""]),
        docstring,
        count=1,
        flags=re.M,
    )


def _unbound_names(examples: list[doctest.Example]) -> set[str]:
    """Names that examples use and do not bind themselves."""
    nodes = [node for example in examples for node in ast.walk(ast.parse(example.source))]
    names = [node for node in nodes if isinstance(node, ast.Name)]
    used = {node.id for node in names if isinstance(node.ctx, ast.Load)}
    bound = {node.id for node in names if not isinstance(node.ctx, ast.Load)}
    bound |= {node.asname or node.name for node in nodes if isinstance(node, ast.alias)}
    bound |= {node.arg for node in nodes if isinstance(node, ast.arg)}
    bound |= {node.name for node in nodes if isinstance(node, ast.FunctionDef | ast.ClassDef)}
    return used - bound


def _imports(names: set[str], page: str, defined_in: ModuleType) -> list[str]:
    """Lines that import names of a module; each comes from where a reader finds it first."""
    lines: list[str] = []
    by_place: dict[str, list[str]] = {}
    for name in sorted(names & set(vars(defined_in))):
        value = vars(defined_in)[name]
        if isinstance(value, ModuleType):
            place, _, last = value.__name__.rpartition(".")
            renamed = f" as {name}" if name != last else ""
            lines.append(f"{f'from {place} ' if place else ''}import {last}{renamed}")
            continue
        home = getattr(value, "__module__", page).split(".")
        packages = [".".join(home[: n + 1]) for n in range(len(home))]
        places = [*packages[:1], page, *packages[1:], defined_in.__name__]
        place = next(p for p in places if vars(sys.modules[p]).get(name) is value)
        by_place.setdefault(place, []).append(name)
    lines += [f"from {place} import {', '.join(by_place[place])}" for place in sorted(by_place)]
    return lines


def short_names(signature: str) -> Markup:
    """A signature whose links show the last part of a name; the link itself tells where it is.

    >>> print(short_names('<a href="../planarimpact.html#Rebound">planarimpact.Rebound</a>'))
    <a href="../planarimpact.html#Rebound">Rebound</a>
    """
    return Markup(re.sub(r">(?:\w+\.)+(\w+)</a>", r">\1</a>", str(signature)))
