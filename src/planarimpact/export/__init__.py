"""Compiled responses in other languages: a header of C99, or a module of JavaScript.

The file needs nothing else, and says itself what it computes, in which units, to which error.
"""

from pathlib import Path

from planarimpact.export import pair
from planarimpact.export.languages import LANGUAGES, checked_name
from planarimpact.ground import files
from planarimpact.response import Response

__all__ = ["LANGUAGES", "checked_name", "text", "write"]


def text(response: Response, path: str | Path, language: str) -> str:
    """What `write` writes.

    Examples
    --------
    >>> from planarimpact import response
    >>> wall = response.compile("rigid", incidence_max=20, tolerance=1e-6)
    >>> print(text(wall, "wall.h", "c").splitlines()[1])
     * wall.h: the rebound of one pair of rough bodies after an oblique impact.
    """
    return pair.text(response, Path(path).name, checked_name(path, language), language)


def write(response: Response, path: str | Path, language: str) -> None:
    """Write a response as code, whole or not at all.

    The code computes what the response computes, by the same operations in the same order. Where
    the response refuses an incidence, as it is beyond `incidence_max` or no number, the code
    returns NaN.

    Parameters
    ----------
    response : Response
        Of `planarimpact.response`, compiled or loaded.
    path : str or Path
        "c": NAME.h, with the functions `NAME_velocity(x)` and `NAME_rebound(x)`; NAME has letters
        from A to Z, digits and underscores, and begins with a letter. "js": NAME.mjs or NAME.js,
        with `velocity(x)` and `rebound(x)`. A file that is there is replaced.
    language : str
        "c", also for C++, or "js".

    Raises
    ------
    InputError
        If there is no such language, the name is not allowed, or there can be no such file.

    Examples
    --------
    >>> import pathlib, tempfile
    >>> from planarimpact import response
    >>> wall = response.compile("rigid", incidence_max=20, tolerance=1e-6)
    >>> path = pathlib.Path(tempfile.mkdtemp()) / "wall.h"
    >>> write(wall, path, "c")
    >>> "double wall_velocity(double x)" in path.read_text()
    True
    """
    whole = text(response, path, language)
    with files.written(path) as partial:
        partial.write_text(whole, encoding="utf-8")
