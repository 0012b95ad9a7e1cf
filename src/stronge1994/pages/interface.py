"""The interface of the solver and of the printed formulas, as pages that pdoc makes."""

import inspect
from pathlib import Path
from typing import Any
from unittest import mock

from planarimpact.ground import arrays

SRC = Path(__file__).parents[2]
# Packages for users: the solver and the paper's formulas; beside them the curves that use both.
PACKAGES = ("planarimpact", "stronge1994.printed")
CURVES = "stronge1994/figures/*/curves.py"


def write(folder: str, templates: str | Path) -> None:
    """Write the pages into a folder; `templates` has our changes to those of pdoc."""
    import pdoc
    import pdoc.render
    from pygments.formatters import HtmlFormatter  # type: ignore[import-untyped]

    plain = inspect.formatannotation

    def named(annotation: Any, *arguments: Any) -> str:
        return _name(annotation) or plain(annotation, *arguments)

    pdoc.render.configure(
        docformat="numpy",
        footer_text="planarimpact",
        include_undocumented=False,
        template_directory=Path(templates),
    )
    dark = HtmlFormatter(style="github-dark").get_style_defs(".pdoc-code")
    pdoc.render.env.globals["dark_code"] = dark
    files = [path.relative_to(SRC).with_suffix("") for path in sorted(SRC.glob(CURVES))]
    curves = [".".join(file.parts) for file in files]
    # pdoc has no option for the names of types.
    with mock.patch("inspect.formatannotation", named):
        pdoc.pdoc(*PACKAGES, *curves, output_directory=Path(folder))


def _name(annotation: object) -> str | None:
    """Name of a type in our sources: NumPy's own annotation for ArrayLike fills a screen."""
    named = {name: getattr(arrays, name) for name in arrays.__all__}
    return next((name for name, known in named.items() if annotation == known), None)
