"""What a lecture is made of besides text and code: folds, questions, throws to play."""

import re
from collections.abc import Sequence
from typing import Any

# A paragraph that is only a link to the stage of the explorer; it may ask before it shows.
STAGE = re.compile(
    r"^\[(?P<words>[^]]+)\]\((?:\.\./\.\./figures/)?"
    r"explorer\.html\?stage(?P<ask>&ask)?(?P<state>#\S+)\)$",
    re.M,
)
# A quotation that asks for a prediction.
QUESTION = re.compile(r"^> \*\*Predict\.\*\*.*(?:\n>.*)*", re.M)


def level(cell: Any) -> int:
    """Level of the heading with which a cell begins, or 0."""
    return len(cell.source) - len(cell.source.lstrip("#")) if cell.cell_type == "markdown" else 0


def folds(cells: Sequence[Any]) -> list[int]:
    """The number of the fold in which each cell stands, or 0.

    As in JupyterLab, a collapsed heading folds what stands below it up to the next heading of its
    own or a higher level. That of an answer to an exercise folds nothing.
    """
    found, number, top = [], 0, 0
    for cell in cells:
        top = 0 if 0 < level(cell) <= top else top
        folded = cell.metadata.get("jp-MarkdownHeadingCollapsed")
        if folded and not top and "answer" not in cell.metadata.get("tags", ()):
            number, top = number + 1, level(cell)
        found.append(number if top else 0)
    return found


def raised(source: str) -> str:
    """A text of a fold where the fold has no heading of its own: its headings are a level higher.

    >>> raised("#### Why")
    '### Why'
    """
    return re.sub("^#(?=###)", "", source, flags=re.M)
