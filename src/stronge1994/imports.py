"""One digest of all code that a job runs, for the `params` of its rule.

Snakemake runs a job again if its `params` have changed. So it does where a module has changed that
the job imports, directly or not, whatever the dates of files are.
"""

import functools
import hashlib
import re
from collections.abc import Iterable
from pathlib import Path

SRC = Path(__file__).resolve().parents[1]
IMPORT = re.compile(r"^ *(?:from (\.*)([\w.]*) import (\([^)]*\)|.+)|import ([\w., ]+))", re.M)
# Beside modules all files count, as they may be read: data, templates. Settings are `params`.
NO_DATA = (".py", ".pyc", ".md", ".yaml")


def digest(paths: Iterable[str | Path]) -> str:
    """Hash of files, in folders too, and of each module of `src` that they import, with its data.

    Of `from package import module` the module counts, not the `__init__` of its package: this only
    passes it on.
    """
    waiting = [file for path in map(Path, paths) for file in _files(path.resolve())]
    found: dict[Path, str] = {}
    while waiting:
        path = waiting.pop()
        if path not in found:
            found[path], imported = _of_file(path)
            waiting += imported
    return hashlib.sha256("\n".join(sorted(found.values())).encode()).hexdigest()


def _files(path: Path) -> list[Path]:
    return [*path.rglob("[!.]*.py")] if path.is_dir() else [path]  # hidden ones are of an editor


@functools.cache
def _of_file(path: Path) -> tuple[str, list[Path]]:
    """Name of a file and hash of it, and the files that it imports."""
    content, is_code = path.read_bytes(), path.suffix == ".py"
    imported = [*_data(path.parent)] if is_code else []
    for dots, package, names, modules in IMPORT.findall(content.decode() if is_code else ""):
        base = path.parents[len(dots) - 1] if dots else SRC
        for name in re.findall(r"[\w.]+", re.sub(r"#.*| as \w+", "", names or modules)):
            imported += _module(base, f"{package}.{name}".strip(".")) or _module(base, package)
    return f"{path.relative_to(SRC.parent)} {hashlib.sha256(content).hexdigest()}", imported


def _module(base: Path, name: str) -> list[Path]:
    path = base / name.replace(".", "/")
    return [file for file in (path.with_suffix(".py"), path / "__init__.py") if file.is_file()]


@functools.cache
def _data(folder: Path) -> list[Path]:
    files = [path for pattern in ("[!.]*", "templates/[!.]*") for path in folder.glob(pattern)]
    return [path for path in files if path.is_file() and path.suffix not in NO_DATA]
