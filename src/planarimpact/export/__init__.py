"""Collisions of spheres in other languages: a header of C99, or a JavaScript module.

The file needs no other file. Its head says what it computes, in which units, to which error.
`spheres` writes the table and collisions; `templates` has what is the same in every file, and
`languages` fills it.
"""

from pathlib import Path

from planarimpact.export import spheres as table_of_spheres
from planarimpact.export.languages import LANGUAGES, checked_name
from planarimpact.ground import checks, files
from planarimpact.spheres import table

__all__ = ["LANGUAGES", "TABLES", "checked_name", "spheres_text", "write_spheres"]
# The shipped tables of spheres by their largest errors.
TABLES = table_of_spheres.TABLES


def spheres_text(path: str | Path, language: str, tolerance: float = min(TABLES)) -> str:
    """The code that `write_spheres` writes.

    Parameters
    ----------
    path, language, tolerance
        As for `write_spheres`.

    Returns
    -------
    str

    Examples
    --------
    >>> code = spheres_text("balls.h", "c", tolerance=max(TABLES))
    >>> "struct balls_result balls_rebound(" in code
    True
    """
    name = checked_name(path, language)
    if tolerance not in TABLES:
        allowed = " or ".join(f"{error:g}" for error in TABLES)
        raise checks.InputError(
            f"tolerance = {checks.brief(tolerance)}: allowed is {allowed}, for the table of spheres"
        )
    shipped, bounds = table.shipped(TABLES[tolerance]), table_of_spheres.BOUNDS[TABLES[tolerance]]
    return table_of_spheres.text(shipped, bounds, Path(path).name, name, language)


def write_spheres(path: str | Path, language: str, tolerance: float = min(TABLES)) -> None:
    """Write collisions of spheres as code, by the table of spheres; whole or not at all.

    The code computes what `planarimpact.collide` computes, and without vectors what
    `planarimpact.spheres.rebound` computes, by the same operations in the same order. Where the
    table has no answer, the regime is UNRESOLVED, and numbers that are not known are NaN; but
    `collide`, `bounce` and `model_form` of JavaScript throw a RangeError for bad arguments, and in
    C `NAME_problem` says what is wrong. Both languages give the same bits. With the default
    tolerance `collide` gives the same velocities to rounding; only within 0.02 % of the incidence
    from which metal slides throughout they differ, by up to 0.001 mu v2(0).

    Parameters
    ----------
    path : str or Path
        "c": NAME.h, with the functions `NAME_collide`, `NAME_bounce`, `NAME_velocity`,
        `NAME_rebound` and more; NAME has letters from A to Z, digits and underscores, and begins
        with a letter. "js": NAME.mjs or NAME.js, with `collide` and so on. The head of the file
        explains them. A file that is there is replaced.
    language : str
        "c", also for C++, or "js".
    tolerance : float
        A key of `TABLES`: the largest error. That of the table in this package is the smaller one.

    Raises
    ------
    InputError
        If there is no such language, the name is not allowed, there can be no such file, or there
        is no table of this tolerance.

    Examples
    --------
    >>> import pathlib, tempfile
    >>> path = pathlib.Path(tempfile.mkdtemp()) / "spheres.mjs"
    >>> write_spheres(path, "js", tolerance=max(TABLES))
    >>> "export function collide(" in path.read_text()
    True
    """
    code = spheres_text(path, language, tolerance)
    with files.written(path) as partial:
        partial.write_text(code, encoding="utf-8")
