"""What all pages share: templates in one folder, and pictures that need no other file."""

import base64
import re
from pathlib import Path

import jinja2
from markupsafe import Markup

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
    Verdict.CANNOT_JUDGE: "not",
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
# What stands in the file of a drawing, and not in it.
ABOUT = re.compile(r"<\?xml.*?\?>|<!.*?>|<metadata>.*?</metadata>|(?<=\n) +", flags=re.S)
# What has a meaning in an address or in an attribute of HTML between double quotes.
ESCAPED = {"&": "&amp;", "%": "%25", "#": "%23", "'": "&amp;apos;", '"': "'", "\n": " "}


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


def embedded(svg: bytes) -> Markup:
    """Address of a drawing that holds the drawing itself, without what is said about its file.

    It stands between double quotes. In base64 it would be a third longer.

    >>> print(embedded(b'<?xml version="1.0"?><svg><path d="M1.2 6" fill="#fff"/></svg>'))
    data:image/svg+xml,<svg><path d='M1.2 6' fill='%23fff'/></svg>
    """
    text = ABOUT.sub("", svg.decode("utf-8"))
    for character, escaped in ESCAPED.items():
        text = text.replace(character, escaped)
    return Markup(f"data:image/svg+xml,{text}")


def embedded_png(png: bytes) -> str:
    """Address of a picture of pixels that holds the picture itself."""
    return f"data:image/png;base64,{base64.b64encode(png).decode()}"
