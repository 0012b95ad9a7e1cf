"""Fingerprints of what every job read and wrote, to find results that do not belong together.

Snakemake notices that a file is older than what it was made from. It does not notice that a file
was restored from a backup, copied from a colleague, or edited while a job ran.
"""

import base64
import hashlib
import json
import re
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

FOLDER = Path(".snakemake/records")
# Snakemake's own records: how a file was made, without which it notices no changed parameter, and
# which files are not finished.
METADATA, INCOMPLETE = Path(".snakemake/metadata"), Path(".snakemake/incomplete")
REPOSITORY = ("data", "src", "workflow")
HOW_TO_MEND = "remove that file and run again"


def fingerprint(path: str | Path) -> str:
    """Fingerprint of what a file holds, or a folder."""
    if Path(path).is_dir():
        files = [file for file in Path(path).rglob("*") if file.is_file()]
        # Snakemake puts a file of its own into a folder that a job has made.
        return fingerprint_of_all(str(file) for file in files if file.name[0] != ".")
    with open(path, "rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


def fingerprint_of_all(paths: Iterable[str]) -> str:
    """One fingerprint of many files, and of their names."""
    lines = "".join(f"{fingerprint(path)} {path}\n" for path in sorted(paths))
    return hashlib.sha256(lines.encode()).hexdigest()


def files_of_repository() -> list[str]:
    """Files that a run reads, or that belong to what it reads; not what Python and pip write."""
    found = ["Snakefile"]
    for folder in REPOSITORY:
        files = (path for path in Path(folder).rglob("*") if path.is_file())
        found += [str(p) for p in files if not re.search(r"\.pyc$|\.egg-info/", p.as_posix())]
    return found


def write(outputs: Iterable[str], inputs: Mapping[str, str]) -> None:
    """Record what a job has written, and the fingerprints that its inputs had when it began.

    Parameters
    ----------
    outputs : sequence of str
    inputs : dict
        `{path: fingerprint}`.
    """
    for path in outputs:
        record = FOLDER / f"{path}.json"
        record.parent.mkdir(parents=True, exist_ok=True)
        record.write_text(json.dumps({"sha256": fingerprint(path), "inputs": inputs}))


def faults(made: Iterable[str]) -> list[str]:
    """Files that have changed since their job wrote them, or whose inputs have changed since then.

    Parameters
    ----------
    made : iterable of str

    Returns
    -------
    list of str
        One line for each file.
    """
    known, found = {}, []

    def now(path: str) -> str | None:
        if path not in known:
            known[path] = fingerprint(path) if Path(path).exists() else None
        return known[path]

    for path in made:
        record = _read(FOLDER / f"{path}.json")
        if record is None or record["sha256"] != now(path):
            found.append(f"{path}: not as its job has left it: {HOW_TO_MEND}")
            continue
        other = [source for source, old in record["inputs"].items() if now(source) != old]
        if other:
            found.append(f"{path}: made from another {other[0]}: remove {path} and run again")
    return found


def unknown(made: Iterable[str]) -> list[str]:
    """Files that are there without Snakemake's records of how they were made."""
    return [
        path
        for path in made
        if Path(path).exists()
        and not (INCOMPLETE / _encoded(path)).exists()
        and not (_is_json(METADATA / _encoded(path)) and (FOLDER / f"{path}.json").exists())
    ]


def _encoded(path: str) -> str:
    return base64.b64encode(path.encode()).decode()


def _is_json(path: Path) -> bool:
    try:
        return bool(json.loads(path.read_text(encoding="utf-8")))
    except (OSError, ValueError):
        return False


def _read(path: Path) -> dict[str, Any] | None:
    """A record; None if it is missing or damaged."""
    try:
        record = json.loads(path.read_text(encoding="utf-8"))
        return record if {"sha256", "inputs"} <= set(record) else None
    except (OSError, ValueError, TypeError):
        return None
