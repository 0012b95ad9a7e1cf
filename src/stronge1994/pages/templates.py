"""What all pages share: templates in one folder, and pictures that need no other file."""

import base64
from pathlib import Path

import jinja2

from stronge1994 import words
from stronge1994.formulas import mathematical, number
from stronge1994.verdict_table import Verdict

# Folder of the theme and the bar of pages, which all pages share.
SHARED = Path(__file__).parents[3] / "workflow/report"
# Classes of the style, by verdict.
MARKS = {
    Verdict.FAILS: "fails",
    Verdict.DIFFERS: "misprint",
    Verdict.CANNOT_TELL: "not",
    Verdict.NOT_COMPARED: "not",
    Verdict.AGREES: "confirmed",
    Verdict.PASSED: "confirmed",
}
FILTERS = {
    "mark_of": lambda verdict: MARKS[Verdict(verdict)],
    "with_units": words.with_units,
    "maths": mathematical,
    "number": number,
    "title_of": words.figure,
    "comparison_name": words.comparison,
    "source_name": words.source,
    "series_name": words.series,
    "entry_name": words.entry,
    "column_name": words.column,
    "unit": words.unit,
    "sentence": words.sentence,
}


def environment(*folders: str | Path) -> jinja2.Environment:
    """Environment for the templates of some folders and the shared ones.

    In a template an unknown name is an error.
    """
    made = jinja2.Environment(
        loader=jinja2.FileSystemLoader([*folders, SHARED]),
        autoescape=True,
        trim_blocks=True,
        lstrip_blocks=True,
        undefined=jinja2.StrictUndefined,
    )
    made.filters |= FILTERS
    return made


def embedded(picture: bytes, kind: str = "svg+xml") -> str:
    """Address of a picture that holds the picture itself.

    >>> embedded(b"<svg/>")
    'data:image/svg+xml;base64,PHN2Zy8+'
    """
    return f"data:image/{kind};base64,{base64.b64encode(picture).decode()}"
