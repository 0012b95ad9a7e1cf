"""Write the note on the replication of the paper as a page, with a style for print.

Every number that a run computes is one of the key numbers.
"""

from collections.abc import Mapping, Sequence

from stronge1994.figure_table import FigureRow
from stronge1994.names import is_of_paper
from stronge1994.pages import templates

COUNTS = ["none", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine", "ten"]
# Smaller probabilities are shown as `< 0.001`.
LEAST_PROBABILITY = 1e-3


def probability(p: float) -> str:
    """A probability in two figures; a very small one as an upper bound, as tails are not known.

    >>> probability(0.00124), probability(3.6e-26)
    ('0.0012', '< 0.001')
    """
    return f"{p:.2g}" if p >= LEAST_PROBABILITY else f"< {LEAST_PROBABILITY:g}"


def count(number: float) -> str:
    """A small number as a word.

    >>> count(0.0), count(4.0)
    ('none', 'four')
    """
    return COUNTS[round(number)]


def page(
    numbers: Mapping[str, float],
    table: Sequence[FigureRow],
    pictures: Mapping[str, bytes],
) -> str:
    """The note as a page, from key numbers, the table for a reader, and SVG by their figures."""
    environment = templates.environment()
    environment.filters |= {"probability": probability, "count": count}
    return environment.get_template("note.html").render(
        n=numbers,
        figures=[row for row in table if is_of_paper(row.figure)],
        pictures={name: templates.embedded(svg) for name, svg in pictures.items()},
    )
