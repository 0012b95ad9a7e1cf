"""The table for a reader: of each figure what agrees with what, and what does not.

It has the printed curves, what the paper states, and what others measured or computed. Of these the
paper's model is told, and of other models only whether they agree. The checks of our solver are not
in it.
"""

import textwrap
from collections import Counter
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

    The worst comparison stands first in `rows`, and gives `verdict` and `entry`. `name` is that of
    the source, empty for the paper. `size` is in words, and so are `reason`, why it differs or
    cannot be judged, and `models`, what of models beside the paper's.
    """

    rows: list[str]
    verdict: str
    entry: str
    name: str
    says: str
    size: str
    reason: str
    models: str

    @property
    def text(self) -> str:
        """What it says, without its source and why it differs."""
        return f"{self.says} {self.size}".strip(" ,")


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


def of_run(
    rows: Sequence[Row], shows: Mapping[str, str], grades: Mapping[str, str]
) -> list[FigureRow]:
    """A row for each figure that `shows` names, from the rows of the verdict table.

    `grades` are those of the ledger's entries, which say how wrong the paper is; else empty.
    """
    table = pd.DataFrame([dict.fromkeys(COLUMNS, "") | row for row in rows], columns=COLUMNS)
    for column in NUMBERS:
        table[column] = pd.to_numeric(table[column])
    severity = [list(Verdict).index(Verdict(verdict)) for verdict in table["verdict"]]
    table = table.assign(
        severity=severity,
        source=table["reference"].str.split("/").str[0],
        reason=[_reason(row, grades) for row in table.to_dict("records")],
    )
    return [_figure_row(name, shows[name], table[table["figure"] == name]) for name in shows]


def _reason(row: Row, grades: Mapping[str, str]) -> str:
    """Why a comparison differs, or cannot be judged; of the paper, how wrong that is."""
    if row["verdict"] == Verdict.CANNOT_JUDGE:
        return row["note"]
    grade = grades.get(row["entry"], "") if row["group"] == Group.PAPER else ""
    cause = row["why"] if not grade or row["why"] == Why.UNKNOWN else ""
    return ", ".join(filter(None, [grade, cause]))


def _figure_row(name: str, shows: str, rows: Table) -> FigureRow:
    paper, others = (rows[rows["group"] == group] for group in (Group.PAPER, Group.OTHERS))
    shown = others["model"].isin(MODELS_OF_PAPER) | (others["verdict"] == Verdict.FAILS)
    printed = rows[rows["group"] == Group.PRINTED]
    awaited = int((printed["why"] == Why.AWAITED).sum())
    items = map(list, (_printed(printed), _items(paper), _items(others[shown], others[~shown])))
    return FigureRow(name, shows, awaited, *items)


def _printed(rows: Table) -> Iterator[Item]:
    """Printed curves that somebody has read, those of one verdict together, the worst first.

    A ratio of two curves is of none.
    """
    curves = (rows["curve"] != "").sum()
    read = rows[rows["why"] != Why.AWAITED]
    for (_, says, unit), own in read.groupby(["severity", "says", "unit"]):
        verdict, reason, entry, curve = own.iloc[0][["verdict", "reason", "entry", "curve"]]
        count = f"{len(own)} of {curves}" if curve else ""
        size = [count, says, f"rms {_rms(own, unit)}" if unit else ""]
        told = ", ".join(filter(None, size))
        yield Item(own["comparison"].tolist(), verdict, entry, "", "", told, reason, "")


def _items(rows: Table, models: Table | None = None) -> Iterator[Item]:
    """Comparisons that say the same of one source are one item.

    Of others' points an item is of one series, and of one verdict. `models` has the rows of other
    models.
    """
    of_points = (rows["group"] == Group.OTHERS) & (rows["stated"] == "")
    series = (rows["reference"] + rows["verdict"]).where(of_points, "")
    for (source, says, _), own in rows.groupby([rows["source"], rows["says"], series], sort=False):
        worst_first = own.sort_values("severity", kind="stable")
        first = worst_first.iloc[0]
        name = "" if first["group"] == Group.PAPER else words.source(source)
        verdict, reason, entry = first[["verdict", "reason", "entry"]]
        if first["stated"]:
            size, others = _against_facts(own), ""
        else:
            of_series = rows[rows["reference"] == first["reference"]]
            size = _against_points(own, first, name, of_series["points"].sum())
            others = _of_others(models, first)
        yield Item(
            worst_first["comparison"].tolist(), verdict, entry, name, says, size, reason, others
        )


def _of_others(models: Table | None, first: Row) -> str:
    """What other models make of the series of an item, each by its worst comparison."""
    if models is None or first["verdict"] in (Verdict.AGREES, Verdict.NOT_COMPARED):
        return ""
    own = models[models["reference"] == first["reference"]]
    worst = own.groupby("model")["severity"].min()
    if worst.empty:
        return ""
    if first["verdict"] == Verdict.CANNOT_JUDGE and (worst == first["severity"]).all():
        return f"none of {len(worst) + 1} models agrees within the error of reading"
    counts = Counter(list(Verdict)[place] for place in sorted(worst))
    said = ", ".join(
        f"{verdict} {n}" if len(counts) > 1 else verdict for verdict, n in counts.items()
    )
    return f"{len(worst)} other model{'s' * (len(worst) > 1)}: {said}"


def _against_facts(rows: Table) -> str:
    """What was stated, and what the model has; an inequality has no size."""
    *others, last = rows["stated"]
    if last[0] in "<>":
        return ""
    unit = f" {rows['unit'].iloc[0]}"  # said once, of the last value
    stated = " and ".join([*(value.removesuffix(unit) for value in others), last])
    found = " and ".join(f"{float(value):.3g}" for value in rows["found"])
    return f"{stated}, model {found}"


def _against_points(rows: Table, first: Row, name: str, of: float) -> str:
    """How far points are off: of the paper at most, of others as a root mean square.

    Of the series as many points are compared.
    """
    compared = rows.dropna(subset=["points"])
    if compared.empty:
        return ""
    if not name:
        return with_unit(float(f"{compared['max'].max():.2g}"), first["unit"])
    what = words.of_identifier(first["reference"].split("/")[1])
    count = f"{compared['points'].sum():.0f}"
    count += f" of {of:.0f}" if count != f"{of:.0f}" else ""
    return f"{what}, {count} points, rms {_rms(compared, first['unit'])}"


def _rms(rows: Table, unit: str) -> str:
    """Root mean square distance of the points of some rows."""
    rms = np.sqrt(np.average(rows["rms"] ** 2, weights=rows["points"]))
    return with_unit(float(f"{rms:.2g}"), unit)


def text(table: Iterable[FigureRow]) -> str:
    """The table for a terminal of 80 columns.

    A figure beyond the paper that is compared with nothing is left out.
    """
    lines = []
    for row in table:
        items = [*row.paper, *row.others]
        of_paper = is_of_paper(row.figure)
        if not (of_paper or items):
            continue
        later = [f"points of {i.name}" for i in items if i.verdict == Verdict.NOT_COMPARED]
        awaited = [PRINTED] if of_paper and not row.printed else []
        missing = ", ".join(dict.fromkeys([*awaited, *later]))
        head = f"{words.figure(row.figure)}  {row.shows}"
        head += f"; not compared: {missing}" if missing else ""
        lines += textwrap.wrap(head, verdict_table.WIDTH, subsequent_indent=" " * 8)
        for item in row.printed:
            lines += verdict_table.lines(item.verdict, PRINTED, (item.text, item.reason))
        for item in items:
            if item.verdict != Verdict.NOT_COMPARED:
                parts = item.text, item.reason, item.models
                lines += verdict_table.lines(item.verdict, item.name or "paper", parts)
    return "\n".join(lines)


def counted(rows: Iterable[Row]) -> str:
    """How many rows have each verdict, best first.

    >>> counted([{"verdict": "differs"}, {"verdict": "agrees"}])
    'agrees 1, differs 1'
    """
    counts = Counter(row["verdict"] for row in rows)
    return ", ".join(
        f"{verdict} {counts[verdict]}" for verdict in reversed(Verdict) if counts[verdict]
    )
