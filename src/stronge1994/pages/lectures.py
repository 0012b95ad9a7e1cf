"""Run notebooks and write each with its outputs, as a page, as slides and as a sheet of answers.

The page folds what JupyterLab hides at first: the source of a cell, and what stands below a heading
that is collapsed. Answers to exercises are not on the page but on the sheet, for the teacher. What
stands on a slide is what JupyterLab calls the slide type of a cell.
"""

import os
import re
import sys
import tempfile
import zlib
from collections.abc import Iterable, Mapping
from functools import cache, partial
from pathlib import Path
from typing import Any

import nbformat
from jupyter_client.kernelspec import KernelSpec
from jupyter_client.manager import AsyncKernelManager
from nbclient import NotebookClient
from nbclient.exceptions import CellExecutionError, CellTimeoutError, DeadKernelError
from nbconvert import HTMLExporter, TemplateExporter
from nbconvert.filters import Highlight2HTML
from traitlets.config import Config

from stronge1994 import csv_tables

# How pictures are written: without a date, and as wide as they are drawn.
PICTURE = {"metadata": {"Date": None}, "bbox_inches": None}
# Longest time of a cell, in seconds.
CELL_TIMEOUT = 120
SRC = Path(__file__).parents[2]
COLOUR = re.compile(r"\x1b\[[0-9;]*m")
HEADING = re.compile(r"(#+) (.+)")
# Key in the metadata of a cell by which JupyterLab marks a collapsed heading.
COLLAPSED = "jp-MarkdownHeadingCollapsed"
ANSWER = "Answer to "  # how the collapsed heading of an exercise's answer begins
# A paragraph that is only a link to the stage of the explorer, or only a picture that is a file.
# `?stage=micro` opens the stage at the instant of micro-slip.
STAGE = re.compile(r'<p><a href="(explorer\.html)(\?stage(?:=micro)?)(#[^"]*)">(.*?)</a></p>', re.S)
DRAWING = re.compile(r'<p><img [^>]*src="\.\./report/([a-z_]+\.svg)"[^>]*></p>')
# Symbols have the colours that they have in the drawing of the model.
SYMBOLS = {
    "velocity": re.compile(r"<em>[vw]</em>[₁₂]?"),
    "friction": re.compile(r"<em>F</em>₁"),
}
# Colours of the theme, each with its light value, as pictures are drawn with it.
THEME = re.compile(r"(--[a-z-]+): light-dark\((#\w+),")


class NotebookError(Exception):
    """A cell of a notebook has failed."""


class ThisPython(AsyncKernelManager):
    """The Python of this job is the only kernel, whatever else is registered on this machine."""

    @property
    def kernel_spec(self) -> Any:
        """How this Python is started."""
        arguments = ["-m", "ipykernel_launcher", "-f", "{connection_file}"]
        # SVG pictures are sharp at any size.
        arguments.append("--InlineBackend.figure_formats={'svg'}")
        arguments.append(f"--InlineBackend.print_figure_kwargs={PICTURE}")
        # Pictures make many small objects; looking for cycles among them is a sixth of the time.
        arguments.append("--IPKernelApp.exec_lines=import gc; gc.set_threshold(100_000)")
        return KernelSpec(argv=[sys.executable, *arguments], language="python")


class Pages(HTMLExporter):
    """A page is what its template says.

    `HTMLExporter` reads each page again, to add what JupyterLab's own templates need. That takes
    longer than all else, and no template here needs it.
    """

    def from_notebook_node(self, nb: Any, resources: Any = None, **kw: Any) -> tuple[str, Any]:
        """The page and its resources."""
        return TemplateExporter.from_notebook_node(self, nb, resources, **kw)


def run_all(
    notebooks: Iterable[str],
    templates: Mapping[str, str],
    made: Iterable[Mapping[str, str]],
    tables: Mapping[str, Iterable[str]],
) -> None:
    """Run each notebook as `run` does; the others are written too if one fails.

    `tables` are those that a notebook reads, by its name. At the end a `NotebookError` says which
    notebooks have failed; or a `csv_tables.Failed` if only jobs before this one have.
    """
    failed: list[Exception] = []
    for notebook, files in zip(notebooks, made, strict=True):
        try:
            for table in tables.get(Path(notebook).stem, ()):
                csv_tables.read_rows(table)
            run(notebook, templates, files)
        except (NotebookError, csv_tables.Failed) as error:
            failed.append(error)
    if any(isinstance(error, NotebookError) for error in failed):
        raise NotebookError("; ".join(map(str, failed)))
    if failed:
        raise failed[0]


def run(notebook: str, templates: Mapping[str, str], made: Mapping[str, str]) -> None:
    """Run `notebook` from its first cell to its last and write all results.

    `made["executed"]` becomes the notebook with its outputs, `made["page"]` and `made["answers"]`
    pages made with the Jinja template `templates["page"]`, and `made["slides"]` with
    `templates["slides"]`. A `NotebookError` says in one line which cell failed, in which line and
    why; or that one took too long, or ended the kernel.
    """
    book = nbformat.read(notebook, as_version=4)
    _execute(book, notebook)
    pages = {
        "page": (templates["page"], without_answers(book.cells)),
        "slides": (templates["slides"], book.cells),
        "answers": (templates["page"], answers(book.cells)),
    }
    texts = {made["executed"]: nbformat.writes(book) + "\n"}
    for kind, (template, cells) in pages.items():
        shown = nbformat.from_dict({**book, "cells": cells})
        resources = {"metadata": {"name": Path(made["page"]).stem}, "kind": kind}
        texts[made[kind]] = _exporter(Path(template)).from_notebook_node(shown, resources)[0]
    for path, text in texts.items():
        Path(path).write_text(text, encoding="utf-8")


@cache
def _exporter(template: Path) -> Pages:
    """What makes a page by this template, which is compiled once."""
    folder = template.parent
    filters = {
        "highlight_code": Highlight2HTML(pygments_lexer="python"),
        "parts": parts,
        "slides": slides,
        "prose": partial(prose, folder=folder),
        "picture": partial(picture, colours=colours(folder / "theme.css")),
    }
    return Pages(template_file=str(template), exclude_anchor_links=True, filters=filters)


def _execute(book: Any, notebook: str) -> None:
    """Run the cells of `book`, which then holds their outputs."""
    with tempfile.TemporaryDirectory() as scratch:
        place = {"transport": "ipc", "connection_file": f"{scratch}/kernel.json"}
        client = NotebookClient(
            book,
            kernel_manager_class=ThisPython,
            config=Config({"ThisPython": place}),
            timeout=CELL_TIMEOUT,
            # A kernel that may end by itself sometimes fails while it closes its sockets.
            shutdown_kernel="immediate",
            record_timing=False,
            coalesce_streams=True,
            # As in JupyterLab, files are looked for beside the notebook.
            resources={"metadata": {"path": str(Path(notebook).parent)}},
        )
        try:
            client.execute(env=_environment(scratch), stderr=sys.stderr)
        except CellExecutionError as error:
            print(COLOUR.sub("", str(error)))
            raise NotebookError(f"{Path(notebook).name}, {_failure(book, error)}") from None
        except (CellTimeoutError, DeadKernelError) as error:
            raise NotebookError(f"{Path(notebook).name}: {str(error).splitlines()[0]}") from None


def parts(cells: Iterable[Any]) -> list[tuple[str, list[Any]]]:
    """The cells of a notebook in parts, open or folded.

    Each part has a title and cells. A part whose title is empty is open. The title of a folded part
    is its collapsed heading. It ends where JupyterLab ends it: before the next heading of the same
    or a higher level.

    >>> from nbformat.v4 import new_markdown_cell as markdown
    >>> folded = {"jp-MarkdownHeadingCollapsed": True}
    >>> cells = [markdown("Why?"), markdown("### Answer", metadata=folded), markdown("So.")]
    >>> cells.append(markdown("## 2"))
    >>> [(title, [cell.source for cell in group]) for title, group in parts(cells)]
    [('', ['Why?']), ('Answer', ['So.']), ('', ['## 2'])]
    """
    titled: list[tuple[str, list[Any]]] = [("", [])]
    level = 0  # of the heading whose part is folded
    for cell in cells:
        heading = _heading(cell)
        if heading and len(heading[1]) <= level:
            level = 0
            titled.append(("", []))
        if heading and not level and cell.metadata.get(COLLAPSED):
            level = len(heading[1])
            titled.append((heading[2], []))
        else:
            titled[-1][1].append(cell)
    return [(title, group) for title, group in titled if group]


def without_answers(cells: Iterable[Any]) -> list[Any]:
    """The cells of the page: all but the answers to exercises.

    >>> from nbformat.v4 import new_markdown_cell as markdown
    >>> folded = {"jp-MarkdownHeadingCollapsed": True}
    >>> cells = [markdown("### 1"), markdown("#### Answer to exercise 1", metadata=folded)]
    >>> cells += [markdown("Seven."), markdown("### 2")]
    >>> [cell.source for cell in without_answers(cells)]
    ['### 1', '### 2']
    """
    kept, level = [], 0
    for cell in cells:
        heading = _heading(cell)
        if heading and (not level or len(heading[1]) <= level):
            level = len(heading[1]) if heading[2].startswith(ANSWER) else 0
        kept += [] if level else [cell]
    return kept


def answers(cells: Iterable[Any]) -> list[Any]:
    """The cells of the sheet of answers: the title, and the part "Exercises", unfolded.

    >>> from nbformat.v4 import new_markdown_cell as markdown
    >>> folded = {"jp-MarkdownHeadingCollapsed": True}
    >>> cells = [markdown("# Balls"), markdown("They roll."), markdown("## Exercises")]
    >>> cells += [markdown("### 1"), markdown("#### Answer to 1", metadata=folded)]
    >>> cells += [markdown("## References")]
    >>> [(cell["source"], cell["metadata"]) for cell in answers(cells)]
    [('# Balls', {}), ('### 1', {}), ('#### Answer to 1', {})]
    """
    title, *others = cells
    kept, inside = [title], False
    for cell in others:
        heading = _heading(cell)
        if heading and len(heading[1]) == 2:
            inside = heading[2] == "Exercises"
        elif inside:
            kept.append({**cell, "metadata": {}} if heading else cell)
    return kept


def slides(cells: Iterable[Any]) -> list[tuple[str, list[Any]]]:
    """Slides: the heading of the part each belongs to, unless it has it itself, and its cells.

    >>> from nbformat.v4 import new_markdown_cell as markdown
    >>> types = ["slide", "-", "skip", "subslide"]
    >>> sources = ["## Motion", "A ball.", "Details.", "It spins."]
    >>> cells = [
    ...     markdown(source, metadata={"slideshow": {"slide_type": kind}})
    ...     for source, kind in zip(sources, types, strict=True)
    ... ]
    >>> [(title, [cell.source for cell in group]) for title, group in slides(cells)]
    [('', ['## Motion', 'A ball.']), ('Motion', ['It spins.'])]
    """
    titled: list[tuple[str, list[Any]]] = []
    part = ""
    for cell in cells:
        kind = cell.metadata.get("slideshow", {}).get("slide_type", "-")
        heading = _heading(cell)
        if heading and len(heading[1]) == 2:
            part = heading[2]
        if kind in ("skip", "notes"):
            continue
        if kind in ("slide", "subslide") or not titled:
            titled.append(("" if heading else part, []))
        titled[-1][1].append(cell)
    return titled


def prose(html: str, folder: Path) -> str:
    """Text of a cell on a page: symbols in colour, drawings inside, the stage where it is linked.

    No line ends beside a sign of equality.

    >>> prose('<p><a href="explorer.html?stage#angle=5">Play</a></p>', Path())
    '<figure class="play"><iframe src="explorer.html?stage#angle=5" title="Play" loading="lazy">\
</iframe><figcaption>Play. <a href="explorer.html#angle=5">Open in the explorer</a></figcaption>\
</figure>'
    >>> prose("<p>The velocity <em>v</em>₁ = 7</p>", Path())
    '<p>The velocity <span class="velocity"><em>v</em>₁</span>\\xa0=\\xa07</p>'
    """
    # A notebook lies two folders below the one that holds those of the pages.
    html = html.replace("../../figures/", "")
    html = STAGE.sub(_stage, html)
    html = DRAWING.sub(lambda found: (folder / found[1]).read_text(encoding="utf-8"), html)
    html = html.replace(" = ", "\N{NO-BREAK SPACE}=\N{NO-BREAK SPACE}")
    for name, symbol in SYMBOLS.items():
        html = symbol.sub(rf'<span class="{name}">\g<0></span>', html)
    return html


def _stage(link: re.Match[str]) -> str:
    """The stage of the explorer as a figure, with the link to the whole explorer below it."""
    page, stage, state, words = link.groups()
    plain = re.sub("<[^>]*>", "", words)
    frame = f'<iframe src="{page}{stage}{state}" title="{plain}" loading="lazy"></iframe>'
    below = f'{words}. <a href="{page}{state}">Open in the explorer</a>'
    return f'<figure class="play">{frame}<figcaption>{below}</figcaption></figure>'


def colours(theme: Path) -> dict[str, str]:
    """Variables of the theme by their light values, as matplotlib writes these."""
    found = THEME.findall(theme.read_text(encoding="utf-8"))
    doubled = ((name, re.sub(r"\b(\w)(\w)(\w)$", r"\1\1\2\2\3\3", light)) for name, light in found)
    return {light: f"var({name})" for name, light in doubled}


def picture(svg: str, words: str, colours: Mapping[str, str]) -> str:
    """A picture of matplotlib as part of a page: colours of the theme, names of its own.

    >>> svg = '<?xml?><svg><g id="a" style="fill: #ffffff"/><use href="#a"/></svg>'
    >>> picture(svg, "A dot", {"#ffffff": "var(--paper)"})
    '<svg role="img" aria-label="A dot"><g id="p283f2fc9-a" style="fill: var(--paper)"/>\
<use href="#p283f2fc9-a"/></svg>'
    """
    svg = re.sub(r"<metadata>.*?</metadata>", "", svg[svg.index("<svg") :], flags=re.S)
    own = f"p{zlib.crc32(svg.encode()):x}-"
    svg = re.sub(r'(\bid="|href="#|url\(#)', rf"\g<1>{own}", svg)
    svg = re.sub(r"(?<=: )#[0-9a-f]{6}\b", lambda found: colours.get(found[0], found[0]), svg)
    return svg.replace("<svg", f'<svg role="img" aria-label="{words}"', 1)


def _heading(cell: Any) -> re.Match[str] | None:
    """The heading with which a cell begins: its signs # and its words."""
    return HEADING.match(cell.source) if cell.cell_type == "markdown" else None


def _environment(scratch: str) -> dict[str, str]:
    """Variables of the kernel: the sources of this checkout, and no settings of the user."""
    places = dict.fromkeys(("IPYTHONDIR", "JUPYTER_CONFIG_DIR", "JUPYTER_RUNTIME_DIR"), scratch)
    # The lectures check their numbers by assertions, which PYTHONOPTIMIZE would switch off.
    return os.environ | {"PYTHONPATH": str(SRC), "PYTHONOPTIMIZE": ""} | places


def _failure(book: Any, error: Any) -> str:
    """Number of the cell that failed, its failing line, and the error."""
    number, cell = next(
        (n, cell)
        for n, cell in enumerate(book.cells, 1)
        if any(output.output_type == "error" for output in cell.get("outputs", ()))
    )
    traceback = COLOUR.sub("", error.traceback)
    lines = re.findall(r"^-+> *\d+ +(.*)$", traceback, flags=re.M)
    line = lines[0].strip() if lines else cell.source.splitlines()[0]
    message = " ".join([f"{error.ename}:", *error.evalue.split()]).removesuffix(":")
    return f"cell {number}: {line}: {message}"
