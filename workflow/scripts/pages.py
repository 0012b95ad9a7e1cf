"""What all pages share: templates in one folder, and files written whole or not at all."""

import os
from pathlib import Path

import jinja2


def environment(folder):
    """Environment for the templates of a folder; a name that they do not know is an error."""
    return jinja2.Environment(
        loader=jinja2.FileSystemLoader(folder),
        autoescape=True,
        trim_blocks=True,
        lstrip_blocks=True,
        undefined=jinja2.StrictUndefined,
    )


def write(path, text):
    """Write a page whole or not at all."""
    partial = Path(f"{path}.partial")
    partial.write_text(text, encoding="utf-8")
    os.replace(partial, path)
