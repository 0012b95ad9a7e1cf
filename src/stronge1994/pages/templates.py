"""What all pages share: templates in one folder."""

from pathlib import Path

import jinja2


def environment(folder: str | Path) -> jinja2.Environment:
    """Environment for the templates of a folder, in which an unknown name is an error."""
    return jinja2.Environment(
        loader=jinja2.FileSystemLoader(folder),
        autoescape=True,
        trim_blocks=True,
        lstrip_blocks=True,
        undefined=jinja2.StrictUndefined,
    )
