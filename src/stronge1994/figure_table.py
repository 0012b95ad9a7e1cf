"""The verdicts of a run in one table: a row for each figure, a cell for each question.

Solved right: our second codes and laws, which say nothing about nature. As printed: what the paper
states. Beside others: measurements, other codes and other authors. There only the paper's model is
told; the table of all comparisons has the other models.
"""

import itertools
import textwrap
from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np
import pandas as pd

from stronge1994.names import SCENE, is_of_paper
from stronge1994.tables import Row, Table
from stronge1994.verdict_table import COLUMNS, LEDGER, Question, Verdict

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
    table = pd.DataFrame([dict.fromkeys(COLUMNS, "") | row for row in rows], columns=COLUMNS)
    numbers = [column for column in COLUMNS if column == "points" or column[-1] == "]"]
    table[numbers] = table[numbers].apply(pd.to_numeric)
    verdicts = [Verdict(verdict) for verdict in table["verdict"]]
    severity = [list(Verdict).index(verdict) for verdict in verdicts]
    table = table.assign(severity=severity, fails=[verdict.fails for verdict in verdicts])
    table["source"] = table["reference"].str.split("/").str[0]
    names = table["figure"].where(~table["figure"].str.startswith(SCENE), SCENES)
    return [_figure_row(name, own) for name, own in table.groupby(names, sort=False)]


def _figure_row(name: str, rows: Table) -> FigureRow:
    solved, printed, others = (rows[rows["question"] == question] for question in Question)
    shown = others[others["fails"] | others["model"].isin(MODELS_OF_PAPER)]
    awaited = shown["verdict"] == Verdict.AWAITED
    present, later = (
        [_source(source, own) for source, own in part.groupby("source", sort=False)]
        for part in (shown[~awaited], shown[awaited])
    )
    return FigureRow(name, list(_solved(solved)), list(_printed(printed)), present, later)


def _item(rows: Table, verdict: str = "", name: str = "", **cells: str) -> Item:
    """An item of some comparisons, with the worst verdict unless another one is given."""
    worst_first = rows.sort_values("severity", kind="stable")
    own = verdict or worst_first["verdict"].iloc[0]
    return Item(worst_first["comparison"].tolist(), own, name, **cells)


def _solved(rows: Table) -> Iterator[Item]:
    """What is wrong, else what is right with its largest differences; and what is known to differ.

    The difference in sigmas is that from second codes: 1 is all that is allowed.
    """
    wrong, right = rows[rows["fails"]], rows[rows["verdict"] == Verdict.RIGHT]
    known = rows[[Verdict(verdict).differs for verdict in rows["verdict"]]]
    if len(wrong):
        yield _item(wrong, Verdict.WRONG, points=f"{len(wrong)}")
    elif len(right):
        # A table with axes of several units has no difference in the unit of the axis.
        size = right["max [axis units]"][right["unit"] != ""].max()
        share = right["max [sigma]"][right["reference"] != ""].max()
        yield _item(
            right,
            points=f"{len(right)}",
            size="" if np.isnan(size) else f"{size:.0e}" if size else "0",
            sigmas="" if np.isnan(share) else f"{share:.1g}" if share > LEAST_SHARE else "0",
        )
    if len(known):
        yield _item(known, "known difference", points=f"{len(known)}")


def _printed(rows: Table) -> Iterator[Item]:
    """How many statements agree; then each difference, by entry of the ledger."""
    agree = rows["verdict"] == Verdict.AGREES
    if agree.any():
        yield _item(rows[agree], points=f"{agree.sum()}")
    differ = rows[~agree]
    causes = pd.Series([_cause(row) for row in differ.to_dict("records")], differ.index, str)
    for name, own in differ.groupby(causes, sort=False):
        first = own.iloc[0]
        size = ""  # of a figure that could not be solved
        if first["found"]:
            size = f"{first['found']}, not {first['stated']}".removesuffix(f" {first['unit']}")
        elif own["points"].notna().all():
            size = f"rms {_rms(own, 'axis units')}"
        yield _item(own, name=name, size=size, unit=first["unit"])


def _cause(row: Row) -> str:
    """Entry of the ledger or note of a known difference; of a row that fails without, its name."""
    note = row["note"].partition(";")[0]
    if row["fails"] and not note.startswith(LEDGER):
        return row["comparison"].removeprefix(f"{row['figure']}-")
    return note.removeprefix(LEDGER)


def _source(source: str, rows: Table) -> Item:
    """All comparisons with one source; the size is that of its first series."""
    measured = rows.dropna(subset=["points"])
    if measured.empty:
        return _item(rows, name=source)
    points = f"{measured['points'].sum():.0f}"
    if not measured["rms [sigma]"].any():  # an inequality that holds has no distance
        return _item(rows, name=source, points=points)
    first = measured[measured["reference"] == measured["reference"].iloc[0]]
    size, unit = _rms(first, "axis units"), first["unit"].iloc[0]
    return _item(
        rows, "", source, points=points, size=size, unit=unit, sigmas=_rms(measured, "sigma")
    )


def _rms(rows: Table, unit: str) -> str:
    """Root mean square distance of all points of several rows."""
    return f"{np.sqrt(np.average(rows[f'rms [{unit}]'] ** 2, weights=rows['points'])):.2g}"


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
