"""Files of this repository that a job reads: its script, the solver, rooms of the reproduction.

They are listed by folders, coarsely. A job that imports a module which is not listed fails.
"""

import functools
from collections.abc import Collection
from pathlib import Path

# What every job imports: the solver, the modules that stand in no room, the record of the job.
EVERY_JOB = ("src/planarimpact", "src/stronge1994/run/__init__.py", "src/stronge1994/run/record.py")
KINDS = (".py", ".pyi", ".npz")


def sources(
    script: str, *rooms: str, figure: str | None = None, figures: Collection[str] = ()
) -> list[str]:
    """Files that a job reads before it looks at its inputs.

    Parameters
    ----------
    script : str
        Its name in workflow/scripts, without ending.
    *rooms : str
        Folders of src/stronge1994, or single files there.
    figure : str, optional
        The figure that the job works at, if it is a job of one: modules of the other `figures` are
        left out.

    Examples
    --------
    >>> found = sources("draw", "drawings", figure="fig6", figures=["fig5", "fig6"])
    >>> [path for path in found if "drawings/fig" in path][:2]
    ['src/stronge1994/drawings/fig2.py', 'src/stronge1994/drawings/fig3.py']
    """
    found = [f"workflow/scripts/{script}.py"]
    for folder in EVERY_JOB:
        found += _files(folder)
    found += map(str, sorted(Path("src/stronge1994").glob("*.py")))
    for room in rooms:
        others = set(figures) - {figure} if figure else set()
        found += [
            file for file in _files(f"src/stronge1994/{room}") if Path(file).stem not in others
        ]
    return list(dict.fromkeys(found))


@functools.cache
def _files(folder: str) -> list[str]:
    if Path(folder).suffix:
        return [folder]
    return sorted(str(path) for path in Path(folder).rglob("*") if path.suffix in KINDS)
