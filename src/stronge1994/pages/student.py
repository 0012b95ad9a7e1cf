"""The notebook of a lecture for a student, who may change each number and needs one other file.

That is the wheel of the package, which the first cell of code installs. The notebook has no
answers, no checks and no outputs. Style, tables and pictures stand inside. Links lead to the pages
in its own folder. In place of a fold it has a cell to predict in, and the cells below show nothing
before. What the fold says stands in a second notebook, which is text alone.
"""

import base64
import pprint
import re
import sys
from collections.abc import Iterator
from itertools import groupby
from pathlib import Path
from typing import Any

import matplotlib
import pandas as pd
from nbformat.v4 import new_code_cell, new_markdown_cell, new_notebook

from stronge1994 import versions
from stronge1994.pages import structure

BEGIN = """\
**This notebook is yours.** Run one cell after the other: *Shift* and *Enter*. Where a question
begins with **Predict**, write what you expect into the cell below it, and run this cell. The next
cells show nothing while it is empty. Then read what the lecture says about it, in the file
[after_{name}.ipynb](after_{name}.ipynb) beside this one.

Change any number in a cell, then run that cell and those below it again. Texts keep the numbers of
the lecture. Cells with `play(...)` have sliders and a button if `ipywidgets` was installed before
Jupyter was started, else numbers to change. If something no longer works: undo your change,
restart, and run all cells again. In Colab, first upload the file {wheel} by the folder icon on the
left. Links lead to pages that lie beside this notebook, where it was downloaded. To use an address
such as `explorer.html#angle=45`, open `explorer.html` in a browser, and write the rest behind its
address there."""
JOINED = "# ---- Nothing to change from here on."
PREDICTION = '''\
# Write what you predict between the quotation marks. Run this cell, then those below.
PREDICTION_{fold} = """

"""'''
SEEN = """\
*What the lecture says about this:
Prediction {fold} in [after_{name}.ipynb](after_{name}.ipynb).*"""
AFTER = """\
# After your predictions: {title}

This is what the lecture says about each of its questions. Read a part when you have predicted, and
have seen the answer, in [student_{name}.ipynb](student_{name}.ipynb)."""
KERNEL = {
    "kernelspec": {"display_name": "Python 3", "language": "python", "name": "python3"},
    "language_info": {"name": "python"},
}
TOOLS = Path(__file__).with_name("tools_of_student.py")
EXERCISE = re.compile(r"### (Exercise (\d+))")

# What a lecture reads from files, and how: no other way is known here.
STYLE = re.compile(r'"(\w+\.mplstyle)"')
TABLE = re.compile(r'^(\w+) = pd\.read_csv\("([^"]+)"\)$', re.M)
PICTURE = re.compile(r"!\[([^]]*)\]\((\.\./[^)]+\.svg)\)")
PAGE = re.compile(r"\.\./\.\./figures/([\w.]+)")
# JupyterLab would open the explorer without its settings, so they stand in the text.
EXPLORER = re.compile(r"\[([^]]*)\]\(\.\./\.\./figures/(explorer\.html#[^)]+)\)")
MODULE = re.compile(r"^(?:from|import) (\w+)", re.M)
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


def notebook(book: Any, folder: Path, name: str) -> Any:
    """The student's notebook of the lecture `book`, which lies in `folder` and has no outputs yet.

    `name` is that of the lecture. A ValueError names a cell that would still read a file.
    """
    cells = []
    given = list(_with_room(cell for cell in book.cells if not {"answer", "check"} & _tags(cell)))
    for fold, part in groupby(zip(structure.folds(given), given, strict=True), lambda one: one[0]):
        inside = [cell for _, cell in part]
        if fold:  # a cell to predict in, in place of its heading
            del inside[0]
            cells.append(new_code_cell(PREDICTION.format(fold=fold), id=f"prediction-{fold}"))
        for cell in inside:
            if "joined" in _tags(cell):  # so that what is changed above it reaches it
                cells[-1].source += f"\n\n\n{JOINED}\n{code(cell.source, folder)}"
                continue
            cells += (_code if cell.cell_type == "code" else _text)(cell, folder, fold)
        if fold:
            said = SEEN.format(fold=fold, name=name)
            cells.append(new_markdown_cell(said, id=f"prediction-{fold}-seen"))
    sources = "\n".join(cell.source for cell in cells if cell.cell_type == "code")
    hidden = {"jupyter": {"source_hidden": True}}
    tools = TOOLS.read_text(encoding="utf-8").rstrip()
    cells[1:1] = [  # below the title
        new_markdown_cell(BEGIN.format(name=name, wheel=versions.WHEEL), id="begin"),
        new_code_cell(install(sources), id="install"),
        new_code_cell(tools, id="tools", metadata=hidden),
    ]
    return new_notebook(cells=cells, metadata=KERNEL)


def after(book: Any, folder: Path, name: str) -> Any:
    """A notebook of text alone: the questions of the lecture `book`, and what its folds say."""
    title = book.cells[0].source.splitlines()[0].lstrip("# ")
    cells = [new_markdown_cell(AFTER.format(title=title, name=name), id="begin")]
    opened, question = 0, ""
    for fold, cell in zip(structure.folds(book.cells), book.cells, strict=True):
        if cell.cell_type != "markdown":
            continue
        if fold > opened:
            said = f"## Prediction {fold}\n\n{question}"
            cells.append(new_markdown_cell(text(said, folder), id=f"prediction-{fold}"))
            question = ""
        elif fold:
            said = structure.STAGE.sub(r"\g<words> (in your notebook)", cell.source)
            said = text(structure.raised(said), folder)
            cells.append(new_markdown_cell(said, id=cell.id))
        elif asked := structure.QUESTION.search(cell.source):
            question = asked[0]
        opened = max(opened, fold)
    return new_notebook(cells=cells, metadata=KERNEL)


def _tags(cell: Any) -> set[str]:
    """What a cell is marked with."""
    return set(cell.metadata.get("tags", ()))


def _with_room(cells: Iterator[Any]) -> Iterator[Any]:
    """These cells, and an empty cell of code at the end of each exercise."""
    begun = None
    for cell in [*cells, None]:
        if begun and (cell is None or 0 < structure.level(cell) <= 3):
            yield new_code_cell(f"# {begun[1]}: calculate here.", id=f"calculate-{begun[2]}")
            begun = None
        if cell is not None:
            begun = EXERCISE.match(cell.source) or begun
            yield cell


def _code(cell: Any, folder: Path, fold: int) -> list[Any]:
    """A cell of code without a file, whose outputs wait for the prediction of its fold.

    It stays folded if it was, and is if a style or a table stands inside.
    """
    source = code(cell.source, folder)
    if re.search(r"\.\./|\.mplstyle", source):
        raise ValueError(f"{cell.get('id')}: a student has no such file: {source[:60]!a}")
    hidden = source != cell.source or "jupyter" in cell.metadata
    metadata = {"jupyter": {"source_hidden": True}} if hidden else {}
    return [new_code_cell(_waiting(source, fold), id=cell.id, metadata=metadata)]


def _text(cell: Any, folder: Path, fold: int) -> list[Any]:
    """A text, with a cell of code below each throw to play; of a text in a fold, these alone."""
    made, begin = [], 0
    for n, link in enumerate(structure.STAGE.finditer(cell.source)):
        words = cell.source[begin : link.start()] + link["words"]
        shown = f'stage("{link["state"][1:]}"{", ask=True" if link["ask"] else ""})'
        made.append(new_markdown_cell(text(words, folder), id=cell.id + f"-{n}" * (n > 0)))
        made.append(new_code_cell(_waiting(shown, fold), id=f"{cell.id}-stage-{n}"))
        begin = link.end()
    if rest := cell.source[begin:].strip():
        made.append(new_markdown_cell(text(rest, folder), id=cell.id + "-rest" * (begin > 0)))
    return [one for one in made if one.cell_type == "code"] if fold else made


def _waiting(source: str, fold: int) -> str:
    """A cell of code that waits for the prediction of its fold."""
    return f"%%after {fold}\n{source}" if fold else source


def code(source: str, folder: Path) -> str:
    """A cell of code with the style and the table that it reads inside."""
    source = STYLE.sub(lambda name: style(folder / name[1]), source)
    return TABLE.sub(lambda read: table(read[1], folder / read[2]), source)


def text(source: str, folder: Path) -> str:
    """A cell of text with its pictures inside, links to the pages beside it, and addresses.

    >>> text("[A throw](../../figures/explorer.html#angle=5)", Path())
    'A throw (`explorer.html#angle=5`)'
    >>> text("The [report](../../figures/report.html#found)", Path())
    'The [report](report.html#found)'
    """

    def inside(picture: re.Match[str]) -> str:
        data = base64.b64encode((folder / picture[2]).read_bytes()).decode()
        return f'<img alt="{picture[1]}" src="data:image/svg+xml;base64,{data}">'

    source = PAGE.sub(r"\1", EXPLORER.sub(r"\1 (`\2`)", source))
    return PICTURE.sub(inside, source)


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
        version=versions.installed()["planarimpact"],
        wheel=versions.WHEEL,
    )
