"""Files that a rule reads: the modules that it imports, and what they hold."""

import functools
import hashlib
import json
import modulefinder
import os
import re
from collections.abc import Iterator
from modulefinder import ModuleFinder
from pathlib import Path
from types import CodeType
from typing import Any

from stronge1994 import records
from stronge1994.plan.config import ConfigError

SRC = Path(__file__).parents[2]
SCRIPTS = SRC.parent / "workflow/scripts"
CONFLICT = re.compile(r"^(<<<<<<< |>>>>>>> )", flags=re.M)


def refuse_unreadable_modules() -> None:
    """Refuse a module that Python cannot read, whatever the target: its rule would be dropped."""
    for file in [*SCRIPTS.glob("*.py"), *SRC.rglob("*.py")]:
        try:
            compile(file.read_bytes(), file, "exec", dont_inherit=True)
        except SyntaxError as error:
            raise ConfigError(f"{_shown(file)}, line {error.lineno}: {error.msg}") from None
        except ValueError as error:
            raise ConfigError(f"{_shown(file)}: {error}") from None


def content(*files: str) -> str:
    """Fingerprint of what files hold. One that is missing is left to whoever needs it."""
    digests = "".join(_digest(file) for file in files if Path(file).is_file())
    return hashlib.sha256(digests.encode()).hexdigest()


_digest = functools.cache(records.fingerprint)


def present(*files: str) -> str | list[str]:
    """The files, if they are there; Snakemake would drop the rule that reads a missing one.

    One file comes back as it is, several as a list: what an input of a rule may be.
    """
    for file in files:
        if not Path(file).is_file():
            raise ConfigError(f"{file}: missing, and a rule reads it")
        text = Path(file).read_text(encoding="utf-8")
        if not text.strip():
            raise ConfigError(f"{file}: empty")
        if CONFLICT.search(text):
            raise ConfigError(f"{file}: it has marks of a merge that was not finished")
    return list(files) if len(files) > 1 else files[0]


def modules(*names: str, cells: str = "") -> list[str]:
    """Files of some modules, of all that they import of this repository, and tables beside those.

    They are inputs of the rules, so that an edit reruns what it must and nothing more.

    Parameters
    ----------
    *names : str
        Scripts of workflow/scripts, or modules in dotted form.
    cells : str, optional
        Python text whose imports count too.

    Returns
    -------
    list of str
        Paths from the top folder, in order.
    """
    finder = _Finder([str(SRC)])
    found = {str(SCRIPTS / f"{name}.py") for name in names if (SCRIPTS / f"{name}.py").is_file()}
    for script in found:
        finder.run_script(script)
    for name in names:
        if not (SCRIPTS / f"{name}.py").is_file():
            finder.import_hook(name)
    if cells:
        finder.scan_code(compile(cells, "cells", "exec"), finder.add_module("cells"))
    found |= {getattr(module, "__file__", None) or "" for module in finder.modules.values()} - {""}
    found |= {str(table) for file in found for table in Path(file).parent.glob("*.npz")}
    return sorted(os.path.relpath(file, SRC.parent) for file in found)


def modules_of_notebook(name: str) -> list[str]:
    """As `modules`, of what runs a notebook of workflow/notebooks and of what it imports."""
    path = SCRIPTS.parent / "notebooks" / f"{name}.ipynb"
    try:
        book = json.loads(path.read_text(encoding="utf-8"))
        cells = ["".join(cell["source"]) for cell in book["cells"] if cell["cell_type"] == "code"]
    except (ValueError, KeyError, TypeError, RecursionError) as error:
        words = f"{type(error).__name__}: {error}"
        raise ConfigError(f"{_shown(path)}: not a notebook ({words})") from None
    try:
        return modules("run_notebook", cells="\n".join(cells))
    except (SyntaxError, ValueError) as error:
        raise ConfigError(f"{_shown(path)}: a cell is no Python: {error}") from None


class _Finder(ModuleFinder):
    """Finds what a module imports. Most rules share most modules: each is read once for all."""

    def scan_opcodes(self, co: CodeType) -> Iterator[tuple[str, tuple[Any, ...]]]:
        return iter(_scanned(co))


@functools.cache
def _scanned(code: CodeType) -> list[tuple[str, tuple[Any, ...]]]:
    return list(ModuleFinder().scan_opcodes(code))


# A finder compiles what it reads; it has no method of its own for that.
modulefinder.compile = functools.cache(compile)  # type: ignore[attr-defined]


def _shown(file: Path) -> str:
    """A path of the repository, from its top folder."""
    return str(file.relative_to(SRC.parent))
