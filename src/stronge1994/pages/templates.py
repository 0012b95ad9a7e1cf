"""What all pages share: templates in one folder, and pictures that need no other file."""

import base64
from pathlib import Path

import jinja2

from stronge1994.curve_names import SCENE, is_of_paper

# Folder of the theme and the bar of pages, which all pages share.
SHARED = Path(__file__).parents[3] / "workflow/report"


def environment(folder: str | Path) -> jinja2.Environment:
    """Environment for the templates of a folder, in which an unknown name is an error."""
    return jinja2.Environment(
        loader=jinja2.FileSystemLoader([folder, SHARED]),
        autoescape=True,
        trim_blocks=True,
        lstrip_blocks=True,
        undefined=jinja2.StrictUndefined,
    )


def embedded(svg: bytes) -> str:
    """Address of a picture that holds the picture itself.

    >>> embedded(b"<svg/>")
    'data:image/svg+xml;base64,PHN2Zy8+'
    """
    return f"data:image/svg+xml;base64,{base64.b64encode(svg).decode()}"


def title(name: str) -> str:
    """Name of a figure for a reader.

    >>> title("fig5"), title("micro_slip")
    ('Fig. 5', 'Micro slip')
    """
    if is_of_paper(name):
        return f"Fig. {name.removeprefix('fig')}"
    if name.startswith(SCENE):
        return f"Scene: {name.removeprefix(SCENE).replace('_', ' ')}"
    return name.replace("_", " ").capitalize()
