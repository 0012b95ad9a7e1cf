"""The verdicts of a run in one table: a row for each figure, a cell for each question.

Solved right: our second codes and laws, which say nothing about nature. As printed: what the paper
states. Beside others: measurements, other codes and other authors. There only the paper's model is
told; the table of all comparisons has the other models.
"""

import itertools
import math
import textwrap
from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import NamedTuple

from stronge1994.names import SCENE, is_of_paper
from stronge1994.tables import Row
from stronge1994.verdict_table import LEDGER, Question, Verdict, fails

SCENES = "scenes"  # one row for all tables of impacts
# The paper's model, in curves that are selected by their model.
MODELS_OF_PAPER = ("", "lumped", "lumped.hysteretic")
LEAST_SHARE = 1e-3  # of a sigma: less is shown as 0
# Widths of the columns in a terminal of 80. Names of the paper's figures are shorter than others.
PAPER_WIDTHS, OTHER_WIDTHS = (6, 11, 23, 37), (13, 11, 16, 37)
HEADER = """\
figure solved right as printed              beside others: number of points,
       axis  sigma what differs: how much  rms [axis], rms [sigma], verdict"""


class Item(NamedTuple):
    """A part of a cell: what it says, and the comparisons that say it.

    The worst comparison stands first. `name` is a source or an entry of the ledger; `size` says how
    large a difference is, in `unit` or as two numbers. `points` are those of a source; of other
    items it counts the comparisons.
    """

    rows: list[str]
    verdict: str
    name: str = ""
    points: str = ""
    size: str = ""
    unit: str = ""
    sigmas: str = ""


class FigureRow(NamedTuple):
    """The verdicts on one figure, by question; `others` of the paper's model only."""

    figure: str
    solved: list[Item]
    printed: list[Item]
    others: list[Item]
    awaited: list[Item]


def of_run(rows: Sequence[Row]) -> list[FigureRow]:
    """A row for each figure of the verdict table `rows`, in their order; one for all scenes.

    >>> row = {"figure": "fig6", "comparison": "fig6-rebound", "question": "solved right"}
    >>> row |= {"verdict": "right", "reference": "lumped_40_digits/fig6", "unit": "m"}
    >>> row |= {"max [sigma]": "0.4", "max [axis units]": "4e-13"}
    >>> of_run([row])[0].solved[0].size
    '4e-13'
    """
    names = dict.fromkeys(map(_name, rows))
    return [_figure_row(name, [row for row in rows if _name(row) == name]) for name in names]


def _name(row: Row) -> str:
    return SCENES if row["figure"].startswith(SCENE) else row["figure"]


def _figure_row(name: str, rows: Sequence[Row]) -> FigureRow:
    solved, printed, others = (
        [row for row in rows if row["question"] == question] for question in Question
    )
    shown = [row for row in others if fails(row) or row["model"] in MODELS_OF_PAPER]
    awaited = [row for row in shown if row["verdict"] == Verdict.AWAITED]
    present = [row for row in shown if row not in awaited]
    return FigureRow(
        name,
        list(_solved(solved)),
        list(_printed(printed)),
        [_source(source, group) for source, group in _grouped(present, _source_of)],
        [_source(source, group) for source, group in _grouped(awaited, _source_of)],
    )


def _grouped(rows: Iterable[Row], key: Callable[[Row], str]) -> list[tuple[str, list[Row]]]:
    groups: dict[str, list[Row]] = {}
    for row in rows:
        groups.setdefault(key(row), []).append(row)
    return list(groups.items())


def _source_of(row: Row) -> str:
    return row["reference"].partition("/")[0]


def _worst_first(rows: Iterable[Row]) -> list[Row]:
    order = list(Verdict)
    return sorted(rows, key=lambda row: order.index(Verdict(row["verdict"])))


def _names(rows: Iterable[Row]) -> list[str]:
    return [row["comparison"] for row in _worst_first(rows)]


def _worst(rows: Iterable[Row]) -> str:
    return _worst_first(rows)[0]["verdict"]


def _solved(rows: Sequence[Row]) -> Iterator[Item]:
    """What is wrong, else what is right with its largest differences; and what is known to differ.

    The difference in sigmas is that from second codes: 1 is all that is allowed.
    """
    wrong = [row for row in rows if fails(row)]
    right = [row for row in rows if row["verdict"] == Verdict.RIGHT]
    known = [row for row in rows if Verdict(row["verdict"]).differs]
    if wrong:
        yield Item(_names(wrong), Verdict.WRONG, points=f"{len(wrong)}")
    elif right:
        # A table with axes of several units has no difference in the unit of the axis.
        sizes = [float(row["max [axis units]"]) for row in right if row["unit"]]
        sigmas = [float(row["max [sigma]"]) for row in right if row["reference"]]
        size, share = max(sizes, default=None), max(sigmas, default=None)
        yield Item(
            _names(right),
            "right",
            points=f"{len(right)}",
            size="" if size is None else f"{size:.0e}" if size else "0",
            sigmas="" if share is None else f"{share:.1g}" if share > LEAST_SHARE else "0",
        )
    if known:
        yield Item(_names(known), "known difference", points=f"{len(known)}")


def _printed(rows: Sequence[Row]) -> Iterator[Item]:
    """How many statements agree; then each difference, by entry of the ledger."""
    agree = [row for row in rows if row["verdict"] == "agrees"]
    if agree:
        yield Item(_names(agree), "agrees", points=f"{len(agree)}")
    differ = [row for row in rows if row not in agree]
    for name, group in _grouped(differ, _cause):
        first = group[0]
        size = ""  # of a figure that could not be solved
        if first["found"]:
            size = f"{first['found']}, not {first['stated']}".removesuffix(f" {first['unit']}")
        elif all(row["points"] for row in group):
            size = f"rms {_rms(group, 'axis units')}"
        yield Item(_names(group), _worst(group), name, size=size, unit=first["unit"])


def _cause(row: Row) -> str:
    """Entry of the ledger or note of a known difference; of a row that fails without, its name."""
    note = row["note"].partition(";")[0]
    if fails(row) and not note.startswith(LEDGER):
        return row["comparison"].removeprefix(f"{row['figure']}-")
    return note.removeprefix(LEDGER)


def _source(source: str, rows: Sequence[Row]) -> Item:
    """All comparisons with one source; the size is that of its first series."""
    measured = [row for row in rows if row["points"]]
    first = [row for row in measured if row["reference"] == measured[0]["reference"]]
    # An inequality that holds has no distance.
    shown = first if any(float(row["rms [sigma]"]) for row in measured) else []
    return Item(
        _names(rows),
        _worst(rows),
        source,
        f"{sum(int(row['points']) for row in measured)}" if measured else "",
        _rms(shown, "axis units") if shown else "",
        shown[0]["unit"] if shown else "",
        _rms(measured, "sigma") if shown else "",
    )


def _rms(rows: Sequence[Row], unit: str) -> str:
    """Root mean square distance of all points of several rows."""
    points = [int(row["points"]) for row in rows]
    squares = [float(row[f"rms [{unit}]"]) ** 2 for row in rows]
    mean = sum(n * s for n, s in zip(points, squares, strict=True)) / sum(points)
    return f"{math.sqrt(mean):.2g}"


def text(table: Sequence[FigureRow]) -> str:
    """The table for a terminal of 80 columns."""
    lines = [HEADER]
    for row in table:
        widths = PAPER_WIDTHS if is_of_paper(row.figure) else OTHER_WIDTHS
        cells = [
            [row.figure],
            [_solved_words(item) for item in row.solved],
            [_printed_words(item) for item in row.printed],
            [*map(_source_words, row.others), *(f"awaited: {i.name}" for i in row.awaited)],
        ]
        wrapped = [
            [line for part in cell for line in textwrap.wrap(part, width)] or ["-"]
            for cell, width in zip(cells, widths, strict=True)
        ]
        for line in itertools.zip_longest(*wrapped, fillvalue=""):
            parts = [part.ljust(width) for part, width in zip(line, widths, strict=True)]
            lines.append(" ".join(parts).rstrip())
    return "\n".join(lines)


def _solved_words(item: Item) -> str:
    if item.verdict == Verdict.RIGHT:
        return f"{item.size or '':5} {item.sigmas}".rstrip() or "right"
    return f"{item.points} WRONG" if item.verdict == Verdict.WRONG else f"{item.points} known"


def _printed_words(item: Item) -> str:
    if item.verdict == "agrees":
        return f"{item.points} agree" + ("s" if item.points == "1" else "")
    mark = "DIVERGES " if Verdict(item.verdict).fails else ""
    return f"{mark}{item.name}" + (f": {item.size}" if item.size else "")


def _source_words(item: Item) -> str:
    verdict = item.verdict.upper() if Verdict(item.verdict).fails else item.verdict
    numbers = [item.points, item.size, item.sigmas, verdict.removesuffix(" difference")]
    return " ".join([item.name, *(part for part in numbers if part)])
