"""The table for a reader: of each figure of the paper what agrees with what, and what does not.

It has the printed curves, what the paper states, and what others measured or computed, of these
only beside the paper's model. The checks of our solver, and the figures beyond the paper, have a
line each.
"""

import textwrap
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import NamedTuple

import numpy as np
import pandas as pd

from stronge1994 import verdict_table, words
from stronge1994.names import is_of_paper
from stronge1994.tables import Row, Table, with_unit
from stronge1994.verdict_table import COLUMNS, Group, Verdict, Why

# The paper's model, in curves that are selected by their model.
MODELS_OF_PAPER = ("", "lumped", "lumped.hysteretic")
NUMBERS = ("points", "rms", "max")
PRINTED = "printed curve"


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
        return f"{self.says} {self.size}".strip(" ,")

    @property
    def reason(self) -> str:
        """Why it differs or is not compared; of the paper, whether it is wrong."""
        return self.paper or self.why


class FigureRow(NamedTuple):
    """What a figure shows, and all that it is compared with but our own checks.

    Of its printed curves so many are `awaited`; `printed` has all others.
    """

    figure: str
    shows: str
    awaited: int
    printed: list[Item]
    paper: list[Item]
    others: list[Item]


def of_run(rows: Sequence[Row], shows: Mapping[str, str]) -> list[FigureRow]:
    """A row for each figure that `shows` names, from the rows of the verdict table."""
    table = pd.DataFrame([dict.fromkeys(COLUMNS, "") | row for row in rows], columns=COLUMNS)
    for column in NUMBERS:
        table[column] = pd.to_numeric(table[column])
    severity = [list(Verdict).index(Verdict(verdict)) for verdict in table["verdict"]]
    table = table.assign(severity=severity, source=table["reference"].str.split("/").str[0])
    return [_figure_row(name, shows[name], table[table["figure"] == name]) for name in shows]


def _figure_row(name: str, shows: str, rows: Table) -> FigureRow:
    paper, others = (rows[rows["group"] == group] for group in (Group.PAPER, Group.OTHERS))
    shown = others["model"].isin(MODELS_OF_PAPER) | (others["verdict"] == Verdict.FAILS)
    printed = rows[rows["group"] == Group.PRINTED]
    awaited = int((printed["why"] == Why.AWAITED).sum())
    items = map(list, (_printed(printed), _items(paper), _items(others[shown])))
    return FigureRow(name, shows, awaited, *items)


def _printed(rows: Table) -> Iterator[Item]:
    """Printed curves that somebody has read, those of one verdict together, the worst first.

    A ratio of two curves is of none.
    """
    curves = (rows["curve"] != "").sum()
    read = rows[rows["why"] != Why.AWAITED]
    for (_, says, unit), own in read.groupby(["severity", "says", "unit"]):
        verdict, why, entry, curve = own.iloc[0][["verdict", "why", "entry", "curve"]]
        count = f"{len(own)} of {curves}" if curve else ""
        size = [count, says, f"rms {_rms(own, unit)}" if unit else ""]
        told = ", ".join(filter(None, size))
        yield Item(own["comparison"].tolist(), verdict, why, entry, "", "", "", told)


def _items(rows: Table) -> Iterator[Item]:
    """Comparisons that say the same of one source are one item."""
    for (source, says), own in rows.groupby(["source", "says"], sort=False):
        worst_first = own.sort_values("severity", kind="stable")
        first = worst_first.iloc[0]
        name = "" if first["group"] == Group.PAPER else words.source(source)
        verdict, why, entry, paper = first[["verdict", "why", "entry", "paper"]]
        size = _against_facts(own) if first["stated"] else _against_points(own, first, name)
        named = worst_first["comparison"].tolist()
        yield Item(named, verdict, why, entry, paper, name, says, size)


def _against_facts(rows: Table) -> str:
    """What was stated, and what the model has; an inequality has no size."""
    *others, last = rows["stated"]
    if last[0] in "<>":
        return ""
    unit = f" {rows['unit'].iloc[0]}"  # said once, of the last value
    stated = " and ".join([*(value.removesuffix(unit) for value in others), last])
    found = " and ".join(f"{float(value):.3g}" for value in rows["found"])
    return f"{stated}, model {found}"


def _against_points(rows: Table, first: Row, name: str) -> str:
    """How far points are off: of the paper at most, of others as a root mean square.

    Series of a source may have other units. The first one is told, and how many are like it.
    """
    compared = rows.dropna(subset=["points"])
    if compared.empty:
        return ""
    if not name:
        return with_unit(float(f"{compared['max'].max():.2g}"), first["unit"])
    series = [own for _, own in compared.groupby("reference", sort=False)]
    alike = [one for one in series if (one["verdict"] == first["verdict"]).any()]
    own = alike[0]
    size = _rms(own, own["unit"].iloc[0])
    what = words.of_identifier(own["reference"].iloc[0].split("/")[1])
    of = f"in {len(alike)} of {len(series)} series: " if len(series) > 1 else ""
    return f"{of}{what}, {own['points'].sum():.0f} points, rms {size}"


def _rms(rows: Table, unit: str) -> str:
    """Root mean square distance of the points of some rows."""
    rms = np.sqrt(np.average(rows["rms"] ** 2, weights=rows["points"]))
    return with_unit(float(f"{rms:.2g}"), unit)


def text(table: Sequence[FigureRow]) -> str:
    """The table for a terminal of 80 columns."""
    lines = []
    for row in table:
        items = [*row.paper, *row.others]
        later = [f"points of {i.name}" for i in items if i.verdict == Verdict.NOT_COMPARED]
        missing = ", ".join(dict.fromkeys([*([] if row.printed else [PRINTED]), *later]))
        head = f"{words.figure(row.figure)}  {row.shows}"
        head += f"; not compared: {missing}" if missing else ""
        lines += textwrap.wrap(head, verdict_table.WIDTH)
        for item in row.printed:
            lines += verdict_table.lines(item.verdict, PRINTED, (item.text, item.reason))
        for item in items:
            if item.verdict != Verdict.NOT_COMPARED:
                parts = item.text, item.reason
                lines += verdict_table.lines(item.verdict, item.name or "paper", parts)
    return "\n".join(lines)


def of_solver(rows: Iterable[Row]) -> str:
    """How the checks of our solver went, in one line."""
    told = counted(rows, solver=True)
    return f"Solver checked by our codes and laws: {told}" if told else ""


def of_printed(rows: Iterable[Row]) -> str:
    """How many printed curves were compared, of how many; empty if none was.

    >>> of_printed([{"group": "printed figure", "verdict": "agrees", "curve": "lumped"}])
    '1 of 1 compared'
    """
    of_curves = (row for row in rows if row["group"] == Group.PRINTED and row["curve"])
    verdicts = [row["verdict"] for row in of_curves]
    done = len(verdicts) - verdicts.count(Verdict.NOT_COMPARED)
    return f"{done} of {len(verdicts)} compared" if done else ""


def beyond(rows: Iterable[Row]) -> str:
    """What comparisons with others say in figures beyond the paper, in one line of a terminal."""
    told = counted(row for row in rows if not is_of_paper(row["figure"]))
    return f"Beyond the paper: {told}" if told else ""


def counted(rows: Iterable[Row], solver: bool = False) -> str:
    """How many rows have each verdict, of the checks of our solver or of all others, best first.

    Behind those that differ stand the names of their figures.

    >>> counted([{"group": "paper", "verdict": "differs", "figure": "fig6"}])
    '1 differs (Fig. 6)'
    """
    own = [row for row in rows if (row["group"] == Group.SOLVER) is solver]
    parts = []
    for verdict in reversed(Verdict):
        names = [words.figure(row["figure"]) for row in own if row["verdict"] == verdict]
        where = f" ({', '.join(dict.fromkeys(names))})" if verdict == Verdict.DIFFERS else ""
        parts += [f"{len(names)} {verdict}{where}"] if names else []
    return ", ".join(parts)
