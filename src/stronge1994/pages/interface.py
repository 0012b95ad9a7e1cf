"""The interface of the solver and of the printed formulas, as pages that pdoc makes."""

import inspect
from pathlib import Path
from typing import Any, ForwardRef, get_args
from unittest import mock

from planarimpact.common import arrays
from stronge1994.pages import templates

# Packages for users: the solver and the paper's formulas.
PACKAGES = ("planarimpact", "stronge1994.printed")
# Types with a name of their own in the sources. A type comes before those that it contains.
NAMED_TYPES = {
    "Numbers": arrays.Numbers,
    "ArrayLike": arrays.ArrayLike,
    "Array": arrays.Array,
    "Integers": arrays.Integers,
    "Booleans": arrays.Booleans,
}


def write(folder: str) -> None:
    """Write the pages into a folder."""
    import pdoc
    import pdoc.render
    from pygments.formatters import HtmlFormatter  # type: ignore[import-untyped]

    plain, evaluate = inspect.formatannotation, pdoc.doc.safe_eval_type

    def evaluated(annotation: Any, *arguments: Any) -> Any:
        # pdoc does not know the module of fields of a named tuple: they keep the source's words.
        is_field = isinstance(annotation, ForwardRef)
        return annotation if is_field else evaluate(annotation, *arguments)

    def named(annotation: Any, *arguments: Any) -> str:
        if isinstance(annotation, ForwardRef):
            return annotation.__forward_arg__
        members, of_array_like = get_args(annotation), get_args(arrays.ArrayLike)
        if all(member in members for member in of_array_like):  # in one flat union with others
            others = [member for member in members if member not in of_array_like]
            return " | ".join(["ArrayLike", *(named(member) for member in others)])
        return with_names_of_types(plain(annotation, *arguments))

    pdoc.render.configure(
        docformat="numpy",
        footer_text="planarimpact",
        include_undocumented=False,
        template_directory=templates.SHARED / "interface",
    )
    # The bar and the theme of all pages; the theme takes the place of that of pdoc.
    pdoc.render.env.loader.searchpath.insert(1, templates.SHARED)  # type: ignore[union-attr]
    dark = HtmlFormatter(style="github-dark").get_style_defs(".pdoc-code")
    pdoc.render.env.globals["dark_code"] = dark
    # pdoc has no option for the names of types.
    with (
        mock.patch("inspect.formatannotation", named),
        mock.patch("pdoc.doc.formatannotation", named),
        mock.patch("pdoc.doc.safe_eval_type", evaluated),
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
