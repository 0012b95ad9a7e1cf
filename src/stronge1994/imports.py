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
IMPORT = re.compile(r"^ *(?:from ([\w.]+) import (\([^)]*\)|.+)|import ([\w., ]+))", re.M)
DATA = (".npz", ".toml", ".txt", ".h", ".mjs")  # what a package brings along beside its modules


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
    known = (".py", *DATA)
    return [p for p in path.rglob("*") if p.suffix in known] if path.is_dir() else [path]


@functools.cache
def _of_file(path: Path) -> tuple[str, list[Path]]:
    """Name of a file and hash of it, and the files that it imports."""
    content, imported = path.read_bytes(), [*_data(path.parent)]
    text = content.decode() if path.suffix == ".py" else ""
    for package, names, modules in IMPORT.findall(text):
        for name in re.findall(r"[\w.]+", re.sub(r"#.*| as \w+", "", names or modules)):
            imported += _module(f"{package}.{name}".lstrip(".")) or _module(package)
    return f"{path.relative_to(SRC.parent)} {hashlib.sha256(content).hexdigest()}", imported


def _module(name: str) -> list[Path]:
    path = SRC / name.replace(".", "/")
    return [file for file in (path.with_suffix(".py"), path / "__init__.py") if file.is_file()]


@functools.cache
def _data(folder: Path) -> list[Path]:
    return [
        path
        for pattern in ("*", "templates/*")
        for path in folder.glob(pattern)
        if path.suffix in DATA
    ]
