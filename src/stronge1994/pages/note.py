"""Write the note on the replication of the paper as a page, with a style for print.

Every number that a run computes is one of the key numbers.
"""

from collections.abc import Mapping, Sequence
from pathlib import Path

from stronge1994 import figure_table
from stronge1994.names import is_of_paper
from stronge1994.pages import templates
from stronge1994.tables import Row

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
    verdicts: Sequence[Row],
    shows: Mapping[str, str],
    pictures: Mapping[str, bytes],
    template: Path,
) -> str:
    """The note as a page, from key numbers, verdicts, and by figures what they show, and SVG."""
    environment = templates.environment(template.parent)
    environment.filters |= {"probability": probability, "count": count}
    return environment.get_template(template.name).render(
        n=numbers,
        figures=figure_table.of_run(
            verdicts, {name: words for name, words in shows.items() if is_of_paper(name)}
        ),
        pictures={name: templates.embedded(svg) for name, svg in pictures.items()},
    )
