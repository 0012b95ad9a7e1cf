"""Run a lecture, and write it as a page, slides, a sheet of answers and notebooks for students.

nbconvert makes the pages. Cells that have the tag `answer` stand on the sheet alone, for the
teacher, and those with `student` in the notebook alone. What stands on a slide is what JupyterLab
calls the slide type of a cell. Cells with the tag `check` stand nowhere: they compare the numbers
that a text states with what the cells give.
"""

import ast
import os
import re
import sys
import tempfile
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import nbformat
from jupyter_client.kernelspec import KernelSpec
from jupyter_client.manager import AsyncKernelManager
from nbclient import NotebookClient
from nbclient.exceptions import CellExecutionError, CellTimeoutError, DeadKernelError
from nbconvert import HTMLExporter, SlidesExporter
from nbconvert.filters import strip_ansi
from traitlets.config import Config

from stronge1994 import versions
from stronge1994.pages import stated_numbers, structure, student

# How pictures are written: without a date, and as wide as they are drawn.
PICTURE = {"metadata": {"Date": None}, "bbox_inches": None}
# Longest time of a cell, in seconds.
CELL_TIMEOUT = 120
SRC = Path(__file__).parents[2]
EXPORTERS = {"page": HTMLExporter, "answers": HTMLExporter, "slides": SlidesExporter}
FRAME = """<figure class="play">
<iframe src="explorer.html?stage{ask}{state}" title="{title}" loading="lazy"></iframe>
<figcaption>

{words}{stop} [Open in the explorer](explorer.html{alone}{state})

</figcaption>
</figure>"""
# A paragraph that is only a picture that is a file.
DRAWING = re.compile(r"^!\[[^]]*\]\(\.\./report/([a-z_]+\.svg)\)$", re.M)
# Symbols have the colours that they have in the drawing of the model.
SYMBOLS = {"velocity": r"\*[vw]\*[₁₂]?", "friction": r"\*F\*₁"}


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


def run(notebook: str, templates: Mapping[str, str], made: Mapping[str, str]) -> None:
    """Run `notebook` from its first cell to its last, its checks among them, and write all.

    `made["page"]` and `made["answers"]` become pages, made with the Jinja template
    `templates["page"]`, and `made["slides"]` one with `templates["slides"]`. `made["student"]`
    becomes the notebook for students, and `made["after"]` what they read after they have predicted.
    A `NotebookError` says in one line which cell failed, in which line and why; or which text
    states what its cells do not give, or is not as its check quotes it; or that a cell took too
    long, or ended the kernel.
    """
    book, folder = nbformat.read(notebook, as_version=4), Path(notebook).parent
    if fault := stated_numbers.fault(book.cells):
        raise NotebookError(f"{Path(notebook).name}, {fault}")
    name, notebooks = Path(notebook).stem, {"student": student.notebook, "after": student.after}
    texts = {
        made[kind]: nbformat.writes(write(book, folder, name)) + "\n"
        for kind, write in notebooks.items()
    }
    _execute(book, notebook)
    for cell, fold in zip(book.cells, structure.folds(book.cells), strict=True):
        cell.metadata["fold"] = fold
        if cell.cell_type == "markdown":
            source = structure.raised(cell.source) if fold else cell.source
            cell.source = on_a_page(source, Path(templates["page"]).parent)
    for kind, exporter in EXPORTERS.items():
        others = {"student", "check"} | ({"answer"} if kind != "answers" else set())
        rest = Config({"TagRemovePreprocessor": {"enabled": True, "remove_cell_tags": others}})
        one = exporter(template_file=str(templates.get(kind, templates["page"])), config=rest)
        one.exclude_anchor_links = one.exclude_output_prompt = True
        resources = {"metadata": {"name": name}, "kind": kind, "wheel": versions.WHEEL}
        texts[made[kind]] = one.from_notebook_node(book, resources)[0]
    for path, text in texts.items():
        Path(path).write_text(text, encoding="utf-8")


def on_a_page(source: str, folder: Path) -> str:
    """The Markdown of a cell for a page: symbols in colour, drawings and the stage in place.

    `folder` is that of the drawings. No line ends beside a sign of equality.

    >>> print(on_a_page("[Play](../../figures/explorer.html?stage#angle=5)", Path()))
    <figure class="play">
    <iframe src="explorer.html?stage#angle=5" title="Play" loading="lazy"></iframe>
    <figcaption>
    <BLANKLINE>
    Play. [Open in the explorer](explorer.html#angle=5)
    <BLANKLINE>
    </figcaption>
    </figure>
    >>> on_a_page("The velocity *v*₁ = 7", Path())
    'The velocity <span class="velocity">*v*₁</span>\\xa0=\\xa07'
    """
    # A notebook lies two folders below the one that holds those of the pages.
    source = structure.STAGE.sub(_frame, source.replace("../../figures/", ""))
    source = DRAWING.sub(lambda found: (folder / found[1]).read_text(encoding="utf-8"), source)
    for name, symbol in SYMBOLS.items():
        source = re.sub(symbol, rf'<span class="{name}">\g<0></span>', source)
    return source.replace(" = ", "\N{NO-BREAK SPACE}=\N{NO-BREAK SPACE}")


def _frame(link: re.Match[str]) -> str:
    """The stage in place of a link to it. One that asks does so in the explorer, too."""
    words, ask = link["words"], link["ask"] or ""
    more = {"title": words.replace("*", ""), "stop": "" if words[-1] in ".!?" else "."}
    return FRAME.format(
        words=words, ask=ask, state=link["state"], alone=ask and f"?stage{ask}", **more
    )


def _execute(book: Any, notebook: str) -> None:
    """Run all cells of `book`, which then holds their outputs."""
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
            print(strip_ansi(str(error)))
            raise NotebookError(f"{Path(notebook).name}, {_failure(book, error)}") from None
        except (CellTimeoutError, DeadKernelError) as error:
            raise NotebookError(f"{Path(notebook).name}: {str(error).splitlines()[0]}") from None


def _environment(scratch: str) -> dict[str, str]:
    """Variables of the kernel: the sources of this checkout, and no settings of the user."""
    places = dict.fromkeys(("IPYTHONDIR", "JUPYTER_CONFIG_DIR", "JUPYTER_RUNTIME_DIR"), scratch)
    return os.environ | {"PYTHONPATH": str(SRC)} | places


def _failure(book: Any, error: Any) -> str:
    """The cell that failed, its failing line, and the error; of a check, what the text states."""
    number, cell = next(
        (n, cell)
        for n, cell in enumerate(book.cells, 1)
        if any(output.output_type == "error" for output in cell.get("outputs", ()))
    )
    if stated_numbers.is_check(cell) and error.ename == AssertionError.__name__:
        return f"{book.cells[number - 2].id}: {_wrong(cell.source, error.evalue)}"
    traceback = strip_ansi(error.traceback)
    lines = re.findall(r"^-+> *\d+ +(.*)$", traceback, flags=re.M)
    line = lines[0].strip() if lines else cell.source.splitlines()[0]
    message = " ".join([f"{error.ename}:", *error.evalue.split()]).removesuffix(":")
    return f"cell {number}: {line}: {message}"


def _wrong(check: str, message: str) -> str:
    """What the text above a check states wrongly, by the `message` of `says` or of an assertion."""
    for words, node in stated_numbers.quotations(check):
        if words == message and isinstance(node, ast.Assert):
            return f"the text says {words!r}, its cells give no truth of {ast.unparse(node.test)}"
    return message
