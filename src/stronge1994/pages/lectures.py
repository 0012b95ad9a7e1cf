"""Run one notebook and write it twice: with its outputs, and as a page that needs no other file.

The page folds what JupyterLab hides at first: the source of a cell, and what stands below a heading
that is collapsed.
"""

import os
import re
import sys
import tempfile
from collections.abc import Iterable
from pathlib import Path
from typing import Any

import nbformat
from jupyter_client.kernelspec import KernelSpec
from jupyter_client.manager import AsyncKernelManager
from nbclient import NotebookClient
from nbclient.exceptions import CellExecutionError, CellTimeoutError, DeadKernelError
from nbconvert import HTMLExporter
from traitlets.config import Config

# Longest time of a cell, in seconds.
CELL_TIMEOUT = 120
SRC = Path(__file__).parents[2]
COLOUR = re.compile(r"\x1b\[[0-9;]*m")
HEADING = re.compile(r"(#+) (.+)")
# Key in the metadata of a cell by which JupyterLab marks a collapsed heading.
COLLAPSED = "jp-MarkdownHeadingCollapsed"


class NotebookError(Exception):
    """A cell of a notebook has failed."""


class ThisPython(AsyncKernelManager):
    """The Python of this job is the only kernel, whatever else is registered on this machine."""

    @property
    def kernel_spec(self) -> Any:
        """How this Python is started."""
        arguments = ["-m", "ipykernel_launcher", "-f", "{connection_file}"]
        # SVG pictures are sharp at any size; they are written without a date.
        arguments.append("--InlineBackend.figure_formats={'svg'}")
        arguments.append("--InlineBackend.print_figure_kwargs={'metadata': {'Date': None}}")
        return KernelSpec(argv=[sys.executable, *arguments], language="python")


def run(notebook: str, template: str, executed: str, page: str) -> None:
    """Run `notebook` from its first cell to its last and write both results.

    `executed` becomes the notebook with its outputs, `page` the page made with the Jinja
    `template`. A `NotebookError` says in one line which cell failed, in which line and why; or that
    one took too long, or ended the kernel.
    """
    book = nbformat.read(notebook, as_version=4)
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
    exporter = HTMLExporter(
        template_file=str(template), exclude_anchor_links=True, filters={"parts": parts}
    )
    resources = {"metadata": {"name": Path(page).stem}}
    texts = {
        executed: nbformat.writes(book) + "\n",
        page: exporter.from_notebook_node(book, resources)[0],
    }
    for path, text in texts.items():
        Path(path).write_text(text, encoding="utf-8")


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
        heading = cell.cell_type == "markdown" and HEADING.match(cell.source)
        if heading and len(heading[1]) <= level:
            level = 0
            titled.append(("", []))
        if heading and not level and cell.metadata.get(COLLAPSED):
            level = len(heading[1])
            titled.append((heading[2], []))
        else:
            titled[-1][1].append(cell)
    return [(title, group) for title, group in titled if group]


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
