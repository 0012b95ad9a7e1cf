"""Run one notebook and write it twice: with its outputs, and as a page that needs no other file."""

import os
import re
import sys
import tempfile
from pathlib import Path
from typing import Any

import nbformat
from jupyter_client.kernelspec import KernelSpec
from jupyter_client.manager import AsyncKernelManager
from nbclient import NotebookClient
from nbclient.exceptions import CellExecutionError, CellTimeoutError, DeadKernelError
from nbconvert import HTMLExporter
from traitlets.config import Config

# A cell may take so many seconds.
CELL_TIMEOUT = 120
SRC = Path(__file__).parents[2]
COLOUR = re.compile(r"\x1b\[[0-9;]*m")


class NotebookError(Exception):
    """A cell of a notebook has failed."""


class ThisPython(AsyncKernelManager):
    """The Python of this job is the only kernel, whatever else is registered on this machine."""

    @property
    def kernel_spec(self) -> Any:
        """How this Python is started."""
        words = ["-m", "ipykernel_launcher", "-f", "{connection_file}"]
        # Pictures stay sharp on paper and at any size, and are the same bytes at every run.
        words.append("--InlineBackend.figure_formats={'svg'}")
        words.append("--InlineBackend.rc={'svg.hashsalt': 'planarimpact'}")
        words.append("--InlineBackend.print_figure_kwargs={'metadata': {'Date': None}}")
        return KernelSpec(argv=[sys.executable, *words], language="python")


def run(notebook: str, template: str, executed: str, page: str) -> None:
    """Run `notebook` from its first cell to its last and write both results.

    Parameters
    ----------
    notebook, template : path
        A notebook without outputs; the page as a Jinja template.
    executed, page : path
        What is written: the notebook with its outputs, and the page.

    Raises
    ------
    NotebookError
        If a cell fails: its number, the line that failed and the error, in one line. Also if one
        takes too long, or ends the kernel.
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
        )
        try:
            client.execute(env=_environment(scratch), stderr=sys.stderr)
        except CellExecutionError as error:
            print(COLOUR.sub("", str(error)))
            raise NotebookError(f"{Path(notebook).name}, {_failure(book, error)}") from None
        except (CellTimeoutError, DeadKernelError) as error:
            raise NotebookError(f"{Path(notebook).name}: {str(error).splitlines()[0]}") from None
    exporter = HTMLExporter(template_file=str(template), exclude_anchor_links=True)
    resources = {"metadata": {"name": Path(page).stem}}
    texts = {
        executed: nbformat.writes(book) + "\n",
        page: exporter.from_notebook_node(book, resources)[0],
    }
    for path, text in texts.items():
        Path(path).write_text(text, encoding="utf-8")


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
    words = " ".join([f"{error.ename}:", *error.evalue.split()]).removesuffix(":")
    return f"cell {number}: {line}: {words}"
