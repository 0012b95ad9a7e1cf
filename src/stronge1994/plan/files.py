"""Files of this repository that a job reads: its script, the solver, rooms of the reproduction.

They are listed by folders, coarsely. A job that imports a module which is not listed fails.
"""

import functools
from pathlib import Path

# Files that every job imports: the solver, modules outside of rooms, the record of the job.
EVERY_JOB = (
    "src/planarimpact",
    "src/stronge1994/run/__init__.py",
    "src/stronge1994/run/record.py",
    "src/stronge1994/run/failures.py",
    "src/stronge1994/figures/__init__.py",
)
KINDS = (".py", ".npz", ".h", ".mjs", ".toml", ".txt")


def sources(script: str, *rooms: str) -> list[str]:
    """Files of a job: its script in workflow/scripts, and rooms or files of src/stronge1994.

    >>> [path for path in sources("draw", "figures/fig6/drawing.py") if "fig6" in path]
    ['src/stronge1994/figures/fig6/drawing.py']
    """
    paths = [f"workflow/scripts/{script}.py"]
    for folder in EVERY_JOB:
        paths += _files(folder)
    paths += map(str, sorted(Path("src/stronge1994").glob("*.py")))
    for room in rooms:
        paths += _files(f"src/stronge1994/{room}")
    return list(dict.fromkeys(paths))


@functools.cache
def _files(folder: str) -> list[str]:
    if Path(folder).suffix:
        return [folder]
    return sorted(str(path) for path in Path(folder).rglob("*") if path.suffix in KINDS)
