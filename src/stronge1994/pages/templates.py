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
# Parts of a drawing that nobody sees, its paths, and their numbers.
UNSEEN = re.compile(r"<\?xml.*?\?>|<!.*?>|<metadata>.*?</metadata>|(?<=\n) +", flags=re.S)
PATH = re.compile(r' d="[^"]*"')
DECIMAL = re.compile(r"\d+\.\d+")
COMMAND = re.compile(r"\s*([A-Zz])\s*")
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
    """Address of a drawing that holds the drawing itself, as short as it can be.

    It stands between double quotes. In base64 it would be a third longer. Paths are rounded to
    hundredths of a point, which nobody sees; what is said about the file, and comments, go.

    >>> print(embedded(b'<svg><!-- x --><path d="M 1.2345 60.0"  fill="#fff"/></svg>'))
    data:image/svg+xml,<svg><path d='M1.23 60'  fill='%23fff'/></svg>
    """
    text = UNSEEN.sub("", svg.decode("utf-8"))
    text = PATH.sub(lambda path: COMMAND.sub(r"\1", DECIMAL.sub(_rounded, path[0])), text)
    for character, escaped in ESCAPED.items():
        text = text.replace(character, escaped)
    return Markup(f"data:image/svg+xml,{text}")


def _rounded(number: re.Match[str]) -> str:
    return f"{float(number[0]):.2f}".rstrip("0").rstrip(".")


def embedded_png(png: bytes) -> str:
    """Address of a picture of pixels that holds the picture itself."""
    return f"data:image/png;base64,{base64.b64encode(png).decode()}"
