"""The table for a reader: of each figure of the paper what agrees with what, and what does not.

It has what the paper states, and what others measured or computed, of these only beside the paper's
model. The checks of our solver, and the figures beyond the paper, have a line each.
"""

import textwrap
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import NamedTuple

import numpy as np
import pandas as pd

from stronge1994 import words
from stronge1994.names import is_of_paper
from stronge1994.tables import Row, Table
from stronge1994.verdict_table import COLUMNS, Group, Verdict, Why

# The paper's model, in curves that are selected by their model.
MODELS_OF_PAPER = ("", "lumped", "lumped.hysteretic")
NUMBERS = ("points", "rms", "max")
WIDTH, INDENT = 80, " " * 14  # of a terminal
PRINTED = "printed curve"  # which no run has compared


class Item(NamedTuple):
    """What some comparisons with one source say together.

    The worst comparison stands first in `rows`, and gives `verdict` and `why`. `name` is that of
    the source, empty for the paper, and `paper` says whether that is wrong. `size` is in words.
    """

    rows: list[str]
    verdict: str
    why: str
    entry: str
    paper: str
    name: str
    says: str
    size: str

    @property
    def text(self) -> str:
        """What it says, without its source and why it differs."""
        return f"{self.says} {self.size}".strip()

    @property
    def reasons(self) -> list[str]:
        """Why it differs or is not compared; a known cause goes with a paper that is wrong."""
        return [self.why] if self.why and not (self.paper and self.why == Why.KNOWN) else []


class FigureRow(NamedTuple):
    """What a figure shows, and all that it is compared with but our own checks."""

    figure: str
    shows: str
    paper: list[Item]
    others: list[Item]


def of_run(rows: Sequence[Row], shows: Mapping[str, str]) -> list[FigureRow]:
    """A row for each figure that `shows` names, from the rows of the verdict table."""
    table = pd.DataFrame([dict.fromkeys(COLUMNS, "") | row for row in rows], columns=COLUMNS)
    for column in NUMBERS:
        table[column] = pd.to_numeric(table[column])
    severity = [list(Verdict).index(Verdict(verdict)) for verdict in table["verdict"]]
    table = table.assign(severity=severity, source=table["reference"].str.split("/").str[0])
    by_figure = {name: table[table["figure"] == name] for name in shows}
    return [_figure_row(name, shows[name], own) for name, own in by_figure.items()]


def _figure_row(name: str, shows: str, rows: Table) -> FigureRow:
    paper, others = (rows[rows["group"] == group] for group in (Group.PAPER, Group.OTHERS))
    shown = others["model"].isin(MODELS_OF_PAPER) | (others["verdict"] == Verdict.FAILS)
    return FigureRow(name, shows, list(_items(paper)), list(_items(others[shown])))


def _items(rows: Table) -> Iterator[Item]:
    """Comparisons that say the same of one source are one item; of the paper, all of one entry."""
    for (source, says), own in rows.groupby(["source", "says"], sort=False):
        first = own.sort_values("severity", kind="stable").iloc[0]
        of_paper = first["group"] == Group.PAPER
        yield Item(
            own.sort_values("severity", kind="stable")["comparison"].tolist(),
            first["verdict"],
            first["why"],
            first["entry"],
            first["paper"],
            "" if of_paper else words.source(source),
            says,
            _size(own, of_paper),
        )


def _size(rows: Table, of_paper: bool) -> str:
    """What was stated and found; of points how many, of which series, and how far they are off."""
    first = rows.iloc[0]
    if first["stated"]:
        stated, found = (" and ".join(rows[column]) for column in ("stated", "found"))
        is_met = stated[0] in "<>"  # an inequality has no size
        return "" if is_met else f"{stated}; ours {found}"
    compared = rows.dropna(subset=["points"])
    if compared.empty:
        return ""
    unit = "" if first["unit"] == "1" else f" {first['unit']}"
    if of_paper:
        return f"off by up to {compared['max'].max():.2g}{unit}"
    # Series of one source may have other units: the first one is told.
    name = compared["reference"].iloc[0]
    series = compared[compared["reference"] == name]
    rms = np.sqrt(np.average(series["rms"] ** 2, weights=series["points"]))
    more = compared["reference"].nunique() - 1
    others = f", and {more} more series" if more else ""
    what = f"{words.of_identifier(name.split('/')[1])}, {series['points'].sum():.0f} points"
    return f"{what}, rms {rms:.2g}{unit}{others}"


def text(table: Sequence[FigureRow]) -> str:
    """The table for a terminal of 80 columns."""
    lines = []
    for row in table:
        items = [*row.paper, *row.others]
        later = [item.name for item in items if item.verdict == Verdict.NOT_COMPARED]
        missing = ", ".join(dict.fromkeys([PRINTED, *later]))
        head = f"{words.figure(row.figure)}  {row.shows}; not compared: {missing}"
        lines += textwrap.wrap(head, WIDTH, subsequent_indent=INDENT)
        for item in items:
            if item.verdict != Verdict.NOT_COMPARED:
                who = item.name or f"paper {item.paper}".rstrip()
                told = f" {item.verdict:<12} {who}: {'; '.join([item.text, *item.reasons])}"
                lines += textwrap.wrap(told, WIDTH, subsequent_indent=INDENT)
    return "\n".join(lines)


def of_solver(rows: Iterable[Row]) -> str:
    """How the checks of our solver went, in one line."""
    words = counted(rows, solver=True)
    return f"Solver checked by our codes and laws: {words}" if words else ""


def beyond(rows: Iterable[Row]) -> str:
    """What the comparisons with others say in figures beyond the paper, in one line."""
    words = counted(row for row in rows if not is_of_paper(row["figure"]))
    return f"Beyond the paper, with others: {words}" if words else ""


def counted(rows: Iterable[Row], solver: bool = False) -> str:
    """How many rows have each verdict: of the checks of our solver, or of all others.

    Those that differ have their figures behind them.

    >>> counted([{"group": "paper", "verdict": "differs", "figure": "fig6"}])
    '1 differs (fig6)'
    """
    figures: dict[str, list[str]] = {verdict: [] for verdict in Verdict}
    for row in rows:
        if (row["group"] == Group.SOLVER) is solver:
            figures[row["verdict"]].append(row["figure"])
    known = "differ as known" if solver else "differ"
    plural: dict[str, str] = {Verdict.AGREES: "agree", Verdict.DIFFERS: known, Verdict.FAILS: "FAIL"}
    parts = [
        f"{len(own)} {verdict if len(own) == 1 else plural.get(verdict, verdict)}"
        + (f" ({', '.join(dict.fromkeys(own))})" if verdict == Verdict.DIFFERS else "")
        for verdict, own in figures.items()
        if own
    ]
    return ", ".join(reversed(parts))
