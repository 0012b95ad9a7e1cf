"""Facts about a run: versions, computer, date, commit, and how long its jobs took."""

import datetime
import os
import platform
import re
import subprocess
from collections.abc import Callable
from importlib import metadata
from pathlib import Path
from typing import Any

from stronge1994.run import record

PACKAGES = ("planarimpact", "numpy", "scipy", "matplotlib", "pandas", "snakemake")
NO_COMMIT = "unknown: not a git checkout, or git is missing"


def versions() -> dict[str, str]:
    """Versions of Python and of the packages that a run uses, `{name: version}`."""
    by_package = {"python": platform.python_version()}
    for name in PACKAGES:
        try:
            by_package[name] = metadata.version(name)
        except metadata.PackageNotFoundError:
            by_package[name] = "not installed"
    return by_package


def system() -> str:
    """Operating system and processor, without the name of the machine."""
    return f"{platform.platform()}, {os.cpu_count()} processors"


def date() -> str:
    """Now, to the minute, in universal time."""
    return f"{datetime.datetime.now(datetime.UTC):%d %B %Y, %H:%M} UTC"


def commit(folder: str | Path) -> str:
    """Commit of a checkout, and whether it has uncommitted changes; else `NO_COMMIT`."""
    try:
        root, name = _git(folder, "rev-parse", "--show-toplevel", "HEAD").split("\n")
        if Path(root).resolve() != Path(folder).resolve():
            return NO_COMMIT
        changed = _git(folder, "status", "--porcelain")
    except (OSError, subprocess.SubprocessError, ValueError):
        return NO_COMMIT
    return f"{name}, with uncommitted changes" if changed else name


def short(commit: str) -> str:
    """A commit with ten of its digits; a text behind it, or in its place, stays.

    >>> short("8ab9900d103054b1c3d40c442361c77869d9dbd6, with uncommitted changes")
    '8ab9900d10, with uncommitted changes'
    """
    return re.sub(r"^([0-9a-f]{10})[0-9a-f]{30}", r"\1", commit)


def _git(folder: str | Path, *arguments: str) -> str:
    # GIT_DIR, which hooks of git set, would make git look into another repository.
    environment = {key: value for key, value in os.environ.items() if not key.startswith("GIT_")}
    completed = subprocess.run(
        ["git", "-C", str(folder), *arguments],
        capture_output=True,
        text=True,
        check=True,
        timeout=20,
        env=environment,
    )
    return completed.stdout[:-1]


def times() -> list[tuple[str, float]]:
    """Seconds that each job took when it last ran, longest first: list of (job, seconds)."""
    known = {path.stem: record.read(str(path)) for path in Path(record.FOLDER).glob("*.json")}
    # A damaged record is left out: another job may be writing it.
    jobs = [(job, float(content["seconds"])) for job, content in known.items() if content]
    return sorted(jobs, key=lambda job: -job[1])


def everything() -> dict[str, tuple[Any, Callable[[], Any]]]:
    """All facts, as functions to call later: `{name: (value if it fails, function)}`."""
    return {
        "versions": ({}, versions),
        "system": ("", system),
        "date": ("", date),
        "commit": ("", lambda: commit(".")),
        "times": ([], times),
    }
