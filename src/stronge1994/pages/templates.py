"""What all pages share: templates in one folder, and files written whole or not at all."""

import jinja2

from planarimpact.ground import files


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
    with files.written(path) as partial:
        partial.write_text(text, encoding="utf-8")
