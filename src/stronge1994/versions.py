"""What a run was made with: versions, computer, date and commit."""

import datetime
import os
import platform
import subprocess
from importlib import metadata
from pathlib import Path

import planarimpact

PACKAGES = ("numpy", "scipy", "matplotlib", "pandas", "snakemake")
# The file of the package that a run builds, for the notebooks of students.
WHEEL = f"planarimpact-{planarimpact.__version__}-py3-none-any.whl"
NO_COMMIT = "unknown: not a git checkout, or git is missing"


def installed() -> dict[str, str]:
    """Versions of Python, of the solver and of packages that a run uses, `{name: version}`."""
    own = {"python": platform.python_version(), "planarimpact": planarimpact.__version__}
    return own | {name: metadata.version(name) for name in PACKAGES}


def of_run() -> str:
    """When and with what a run was made, a fact in each line: the only text that has a date."""
    facts = {
        "date": f"{datetime.datetime.now(datetime.UTC):%d %B %Y, %H:%M} UTC",
        "commit": commit("."),
        # Without the name of the machine.
        "computer": f"{platform.platform()}, {os.cpu_count()} processors",
    }
    return "".join(f"{name}: {value}\n" for name, value in (facts | installed()).items())


def source() -> str:
    """What made a picture, for its metadata."""
    return f"planarimpact {planarimpact.__version__}, commit {commit('.')}"


def commit(folder: str | Path) -> str:
    """Commit of a checkout, and whether it has uncommitted changes; else `NO_COMMIT`."""
    try:
        root, name = _git(folder, "rev-parse", "--show-toplevel", "--short=10", "HEAD").split("\n")
        if Path(root).resolve() != Path(folder).resolve():
            return NO_COMMIT
        changed = _git(folder, "status", "--porcelain")
    except (OSError, subprocess.SubprocessError, ValueError):
        return NO_COMMIT
    return f"{name}, with uncommitted changes" if changed else name


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
