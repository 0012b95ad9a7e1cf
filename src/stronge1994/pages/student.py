"""The notebook of a lecture for a student, who may change each number and needs one other file.

That is the wheel of the package, which the first cell of code installs. The notebook has no
answers, no checks and no outputs. Style, tables and pictures stand inside. Links lead to the pages
in its own folder.
"""

import base64
import copy
import pprint
import re
import sys
from pathlib import Path
from typing import Any

import matplotlib
import nbformat
import pandas as pd

import planarimpact
from stronge1994 import versions

# What a lecture reads from files, and how: no other way is known here.
STYLE = re.compile(r'"(\w+\.mplstyle)"')
TABLE = re.compile(r'^(\w+) = pd\.read_csv\("([^"]+)"\)$', re.M)
PICTURE = re.compile(r"!\[([^]]*)\]\((\.\./[^)]+\.svg)\)")
PAGE = re.compile(r"\.\./\.\./figures/([\w.]+)(?:\?stage)?")
MODULE = re.compile(r"^(?:from|import) (\w+)", re.M)
BEGIN = """\
**This notebook is yours.** Run it from top to bottom: menu *Run*, *Run All Cells*. Then change any
number in a cell, and run that cell and those below it again. Texts keep the numbers of the lecture.
A click opens what is folded. Cells with `play(...)` have sliders and a button if `ipywidgets` was
installed before Jupyter was started, else numbers to change. If something no longer works: undo
your change, restart, and run all cells again. Links lead to pages that lie beside this notebook,
where it was downloaded."""
INSTALL = """\
# Installs planarimpact from its file, which lies beside this notebook. The network is needed only
# for {modules}, where they are missing.
%xmode Minimal
import importlib, os, sys

# VS Code may start elsewhere, and names the notebook.
os.chdir(os.path.dirname(globals().get("__vsc_ipynb_file__", "")) or ".")


def installed():
    try:
        from planarimpact import __version__  # which a mere folder of this name lacks
        import {modules}
    except ImportError:
        return False
    return __version__ == "{version}"


if not installed():
    if not os.path.exists("{wheel}"):
        raise FileNotFoundError(
            "Put {wheel} into the folder "
            f"of this notebook, {{os.getcwd()}} (in Colab: the notebook by File > Upload notebook, "
            "the other file by the folder icon on the left), and run this cell again."
        )
    %pip install -q ./{wheel} {others}
    for name in [name for name in sys.modules if name.split(".")[0] == "planarimpact"]:
        del sys.modules[name]
    importlib.invalidate_caches()
    if not installed():
        raise ImportError("Something is still missing: pip says above what, and why.")"""


def notebook(book: Any, folder: Path) -> Any:
    """The student's notebook of the lecture `book`, which lies in `folder` and has no outputs yet.

    A ValueError names a cell that would still read a file.
    """
    made = copy.deepcopy(book)
    made.metadata = nbformat.from_dict(
        {
            "kernelspec": {"display_name": "Python 3", "language": "python", "name": "python3"},
            "language_info": {"name": "python"},
        }
    )
    others = {"answer", "check"}
    made.cells = [cell for cell in made.cells if not others & {*cell.metadata.get("tags", ())}]
    for cell in made.cells:
        # How code and headings are folded stays, slides and tags are ours.
        kept = {"jupyter", "jp-MarkdownHeadingCollapsed"} & set(cell.metadata)
        cell.metadata = nbformat.from_dict({key: cell.metadata[key] for key in sorted(kept)})
        change = code if cell.cell_type == "code" else text
        before, cell.source = cell.source, change(cell.source, folder)
        if cell.cell_type == "code" and cell.source != before:
            cell.metadata["jupyter"] = {"source_hidden": True}
        if cell.cell_type == "code" and re.search(r"\.\./|\.mplstyle", cell.source):
            raise ValueError(f"{cell.get('id')}: a student has no such file: {cell.source[:60]!a}")
    first = next(n for n, cell in enumerate(made.cells) if cell.cell_type == "code")
    sources = "\n".join(cell.source for cell in made.cells if cell.cell_type == "code")
    made.cells[first:first] = [
        nbformat.v4.new_markdown_cell(BEGIN, id="begin"),
        nbformat.v4.new_code_cell(install(sources), id="install"),
    ]
    return made


def code(source: str, folder: Path) -> str:
    """A cell of code with the style and the table that it reads inside."""
    source = STYLE.sub(lambda name: style(folder / name[1]), source)
    return TABLE.sub(lambda read: table(read[1], folder / read[2]), source)


def text(source: str, folder: Path) -> str:
    """A cell of text with its pictures inside, and links to the pages beside it.

    >>> text("[Play it](../../figures/explorer.html?stage#angle=5)", Path())
    '[Play it](explorer.html#angle=5)'
    """

    def inside(picture: re.Match[str]) -> str:
        data = base64.b64encode((folder / picture[2]).read_bytes()).decode()
        return f'<img alt="{picture[1]}" src="data:image/svg+xml;base64,{data}">'

    return PICTURE.sub(inside, PAGE.sub(r"\1", source))


def style(path: Path) -> str:
    """A style of matplotlib as a dictionary, in Python."""
    read = matplotlib.rc_params_from_file(path, use_default_template=False)
    plain = (bool, float, int, list, str)
    values = {key: value if isinstance(value, plain) else str(value) for key, value in read.items()}
    return pprint.pformat(values, sort_dicts=False, width=100)


def table(name: str, path: Path) -> str:
    """A table in Python, with its name; six digits of each number are enough for a picture."""
    words = pd.read_csv(path).to_csv(index=False, float_format="%.6g", lineterminator="\n")
    about = f"# {path.name}, as the run that made this notebook has made it."
    return f'{about}\nfrom io import StringIO\n\n{name} = pd.read_csv(StringIO("""\\\n{words}"""))'


def install(sources: str) -> str:
    """The cell that installs the wheel beside the notebook, and what its cells import.

    >>> said = install("import sys\\nfrom scipy.optimize import brentq\\nimport pandas as pd")
    >>> print(said[said.index("        import") : said.index("    except")])
            import numpy, pandas, scipy
    <BLANKLINE>
    """
    modules = {*MODULE.findall(sources), "numpy", "scipy"} - {*sys.stdlib_module_names}
    others = sorted(modules - {"planarimpact"})
    return INSTALL.format(
        modules=", ".join(others),
        others=" ".join(others),
        version=planarimpact.__version__,
        wheel=versions.WHEEL,
    )
