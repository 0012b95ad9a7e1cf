"""Files that a rule reads: the modules that it imports, and what they hold."""

import ast
import functools
import hashlib
import json
import re
from pathlib import Path

from stronge1994 import records
from stronge1994.plan.config import ConfigError

SRC = Path(__file__).parents[2]
SCRIPTS = SRC.parent / "workflow/scripts"
CONFLICT = re.compile(r"^(<<<<<<< |>>>>>>> )", flags=re.M)


def refuse_unreadable_modules():
    """Refuse a module that Python cannot read, whatever the target: its rule would be dropped."""
    for file in [*SCRIPTS.glob("*.py"), *SRC.rglob("*.py")]:
        try:
            compile(file.read_bytes(), file, "exec", dont_inherit=True)
        except SyntaxError as error:
            raise ConfigError(f"{_shown(file)}, line {error.lineno}: {error.msg}") from None
        except ValueError as error:
            raise ConfigError(f"{_shown(file)}: {error}") from None


def content(*files):
    """Fingerprint of what files hold. One that is missing is left to whoever needs it."""
    digests = "".join(_digest(file) for file in files if Path(file).is_file())
    return hashlib.sha256(digests.encode()).hexdigest()


_digest = functools.cache(records.fingerprint)


def present(*files):
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


def modules(*names):
    """Files of some modules and of all they import: scripts beside this one, and planarimpact.

    Inputs of the rules, so that an edit reruns what it must and nothing more.
    """
    found, todo = set(), [file for name in names for file in _files(name)]
    while todo:
        file = todo.pop()
        if file not in found:
            found.add(file)
            todo += _imported(file)
    return sorted(str(_shown(file)) for file in found)


def modules_of_notebook(name):
    """As `modules`, of what runs a notebook of workflow/notebooks and of what it imports."""
    path = SCRIPTS.parent / "notebooks" / f"{name}.ipynb"
    try:
        book = json.loads(path.read_text(encoding="utf-8"))
        cells = ["".join(cell["source"]) for cell in book["cells"] if cell["cell_type"] == "code"]
    except (ValueError, KeyError, TypeError, RecursionError) as error:
        words = f"{type(error).__name__}: {error}"
        raise ConfigError(f"{_shown(path)}: not a notebook ({words})") from None
    try:
        imported = [name for cell in cells for name in _imports(cell)]
    except (SyntaxError, ValueError) as error:
        raise ConfigError(f"{_shown(path)}: a cell is no Python: {error}") from None
    return modules("run_notebook", *imported)


@functools.cache
def _imported(file):
    return [path for name in _imports(file.read_bytes()) for path in _files(name)]


def _imports(text):
    """Names that a Python text imports."""
    names = []
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.Import):
            names += [alias.name for alias in node.names]
        elif isinstance(node, ast.ImportFrom) and node.module:
            names += [node.module, *(f"{node.module}.{alias.name}" for alias in node.names)]
    return names


def _shown(file):
    """A path of the repository, from its top folder."""
    return file.relative_to(SRC.parent)


def _files(name):
    """Files that an import of `name` reads: its packages and itself, if they are ours."""
    sibling = SCRIPTS / f"{name}.py"
    if sibling.is_file():
        return [sibling]
    parts = name.split(".")
    paths = [SRC.joinpath(*parts[: i + 1]) for i in range(len(parts))]
    candidates = [p for path in paths for p in (path / "__init__.py", path.with_suffix(".py"))]
    return [path for path in candidates if path.is_file()]
