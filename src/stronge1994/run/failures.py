"""What a job that failed leaves in place of its files: the reason, in the form of each file.

So the jobs that read them still run, and the rest of a run is drawn, judged and reported.
"""

import json
import textwrap
from html import escape
from pathlib import Path

from stronge1994 import csv_tables


def write(path: str, why: str) -> None:
    """Write a table, picture, page, notebook or folder that says `why` there is nothing else.

    `csv_tables.read` and `csv_tables.read_rows` raise `csv_tables.Failed` on such a table.
    """
    kind = Path(path).suffix
    if kind == ".csv":
        csv_tables.write_rows(path, ["error"], [[why]])
    elif kind in (".svg", ".png"):
        _draw(path, why)
    elif kind == ".ipynb":
        cell = {"cell_type": "markdown", "id": "failed", "metadata": {}, "source": why}
        book = {"cells": [cell], "metadata": {}, "nbformat": 4, "nbformat_minor": 5}
        Path(path).write_text(json.dumps(book), encoding="utf-8")
    elif kind:
        Path(path).write_text(_page(why), encoding="utf-8")
    else:
        Path(path).mkdir(exist_ok=True)
        Path(path, "index.html").write_text(_page(why), encoding="utf-8")


def _draw(path: str, why: str) -> None:
    import matplotlib  # only a failure needs it
    from matplotlib.figure import Figure

    with matplotlib.rc_context({"svg.fonttype": "none"}):
        picture = Figure((6.4, 1.6))
        # A dollar sign in the message of an error is not mathematics.
        style = {"ha": "center", "va": "center", "color": "#b84a00", "parse_math": False}
        picture.text(0.5, 0.5, textwrap.fill(why, 64), **style)
        picture.savefig(path)


def _page(why: str) -> str:
    return (
        '<!doctype html>\n<html lang="en"><head><meta charset="utf-8">'
        '<meta name="viewport" content="width=device-width"><title>Failed</title></head>\n'
        f"<body><main><p><b>FAILED</b> {escape(why)}</p></main></body></html>\n"
    )
