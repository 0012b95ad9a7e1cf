"""Files that appear whole or not at all."""

import os
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from planarimpact.common.checks import InputError


@contextmanager
def written(path: str | Path) -> Iterator[Path]:
    """Give a path to write to; the file gets its own name when the block ends well.

    `path` is a new file, or one that is there and is replaced; links are followed. Until the end it
    has the same name in a new folder next to it, which is removed after an error too.

    Examples
    --------
    >>> path = Path(tempfile.mkdtemp()) / "words"
    >>> with written(path) as partial:
    ...     _ = partial.write_text("all of them")
    >>> path.read_text(), partial.exists()
    ('all of them', False)
    """
    target = Path(os.path.realpath(path))
    if os.path.lexists(target) and not target.is_file():  # a link in a circle is there too
        raise InputError(f"{path}: it is there already, and no regular file")
    if not target.parent.is_dir():
        raise InputError(f"{path}: there is no folder {target.parent}")
    try:
        beside = tempfile.TemporaryDirectory(prefix=".partial-", dir=target.parent)
    except OSError as error:
        error.filename = str(target.parent)  # the caller knows nothing of a folder in it
        raise
    with beside as folder:
        partial = Path(folder) / target.name
        yield partial
        os.replace(partial, target)
