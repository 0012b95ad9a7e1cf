"""Files that appear whole or not at all, and what JSON writes for no number."""

import math
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from planarimpact.checks import InputError


@contextmanager
def written(path: str | Path) -> Iterator[Path]:
    """Give a path to write to; the file gets its own name when the block ends well.

    Parameters
    ----------
    path : str or Path
        A new file or one that is there; links are followed.

    Yields
    ------
    Path
        A file beside it, which does not outlive an error.

    Raises
    ------
    InputError
        If `path` is there and no regular file, or its folder is not.

    Examples
    --------
    >>> import tempfile
    >>> path = Path(tempfile.mkdtemp()) / "words"
    >>> with written(path) as partial:
    ...     _ = partial.write_text("all of them")
    >>> path.read_text(), partial.exists()
    ('all of them', False)
    """
    target = Path(path).resolve()
    if target.exists() and not target.is_file():
        raise InputError(f"{path}: it is there already, and no regular file")
    if not target.parent.is_dir():
        raise InputError(f"{path}: there is no folder {target.parent}")
    partial = target.with_name(f"{target.name}.partial")
    try:
        yield partial
        partial.replace(target)
    finally:
        partial.unlink(missing_ok=True)


def or_null(value: object) -> object:
    """A value for JSON, which knows neither NaN nor infinity: None for these.

    Examples
    --------
    >>> [or_null(value) for value in (1.5, float("inf"), "words")]
    [1.5, None, 'words']
    """
    return None if isinstance(value, float) and not math.isfinite(value) else value
