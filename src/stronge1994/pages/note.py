"""Write the note on the replication of the paper, as a page and as a PDF of the same text.

Every number that a run computes is read from the table of key numbers.
"""

from collections.abc import Mapping, Sequence
from pathlib import Path

from stronge1994 import csv_tables
from stronge1994.csv_tables import Row
from stronge1994.curve_names import is_of_paper
from stronge1994.pages import key_numbers, names, pdf, templates
from stronge1994.pages.formulas import mathematical, number
from stronge1994.verdict_tables import figure_table, verdict_table

TITLE = "Planar impact of rough compliant bodies: a replication"
# Models below e = 1, in the order of the note.
MODELS = (
    "lumped.hysteretic",
    "lumped.unloading-stiffness",
    "lumped.viscous",
    "continuum.viscous",
    "continuum.plastic",
)
COUNTS = ["none", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine", "ten"]
# Smaller probabilities are shown as `< 0.001`.
LEAST_PROBABILITY = 1e-3


def probability(p: float) -> str:
    """A probability in two figures; a very small one as an upper bound, as tails are not known.

    >>> probability(0.2234), probability(3.6e-26)
    ('0.22', '< 0.001')
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
    pictures: Mapping[str, bytes],
    template: str,
) -> str:
    """The note as a page, from key numbers, rows of verdicts, and SVG by their figures."""
    environment = templates.environment(Path(template).parent)
    environment.filters |= {
        "probability": probability,
        "count": count,
        "entry_name": names.entry,
        "maths": mathematical,
        "number": number,
        "sentence": names.sentence,
        "source_name": names.source,
        "title_of": templates.title,
    }
    judged = [verdict for verdict in verdict_table.ORDER if verdict != "as before"]
    return environment.get_template(Path(template).name).render(
        title=TITLE,
        n=numbers,
        judged=sum(numbers.get(f"rows.{verdict}", 0) for verdict in judged),
        models=MODELS,
        figures=[row for row in figure_table.of_run(verdicts) if is_of_paper(row.figure)],
        pictures={name: templates.embedded(svg) for name, svg in pictures.items()},
    )


def write(
    output: str,
    output_pdf: str,
    table: str,
    verdicts: str,
    pictures: Mapping[str, str],
    template: str,
) -> None:
    """Write both files, from key numbers, verdicts and pictures (PNG, with SVG beside them)."""
    numbers = key_numbers.by_name(csv_tables.read_rows(table))
    svgs = {name: Path(path).with_suffix(".svg").read_bytes() for name, path in pictures.items()}
    rows = csv_tables.read_rows(verdicts, verdict_table.COLUMNS)
    text = page(numbers, rows, svgs, template)
    Path(output).write_text(text, encoding="utf-8")
    pdf.write(output_pdf, text, pictures, TITLE)
