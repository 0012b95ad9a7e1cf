"""Series and stated facts of a source.yaml as objects with fields, and the points of a series."""

import io
import itertools
import math
import re
from collections.abc import Mapping
from dataclasses import field
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
from numpy.typing import ArrayLike, NDArray
from pydantic.dataclasses import dataclass

from planarimpact.common.arrays import Array
from stronge1994.reference_data import csv_text
from stronge1994.reference_data.calibration import Calibration
from stronge1994.tables import Table, with_unit

# Kinds of series that hold points of nature: published ones, or measured by their owner.
PUBLISHED = ("measured", "digitised", "stated", "awaited")
# float() would also take `1_000`, `nan` and digits of other scripts.
NUMBER = re.compile(r"[+-]?([0-9]+([.][0-9]*)?|[.][0-9]+)([eE][+-]?[0-9]+)?")
# Sigmas by which a value may lie outside the range of its axis.
MOST_SIGMAS_OUTSIDE = 3
# How others write the letters of our units.
LETTERS = str.maketrans({"\u00b5": "mu", "\u03bc": "mu", "\u03a9": "Omega", "\u2126": "Omega"})
# A row whose decimals have commas: `1,5;2,3` or `"1,5","2,3"` or `1,5,2,3`.
WITH_COMMAS = re.compile(r'^"?[+-]?\d+,\d+"? *[,;\t] *"?[+-]?\d+,\d+"? *$', re.M)
COMMAS = "decimal commas; allowed are points, and commas between cells"


class SourceError(Exception):
    """Something in data/ contradicts source.yaml or its schema."""


@dataclass(frozen=True)
class Axis:
    """An axis: a column of a series, its unit, what its values can be, and their sigma.

    `sigma` is one number for all points, or the name of the column that has that of each. A value
    may lie outside the range by `slack`, for an error that all points of a reading share.
    """

    column: str
    unit: str
    sigma: float | str
    range: tuple[float, float]
    slack: float = 0.0

    @property
    def name(self) -> str:
        """Column header: with its unit in brackets if it has one."""
        return f"{self.column} [{self.unit}]" if self.unit else self.column

    @property
    def sigma_name(self) -> str | None:
        """Column header of the uncertainties; None where one number holds for all.

        >>> Axis("friction", "1", "friction_uncertainty", (0, 1)).sigma_name
        'friction_uncertainty [1]'
        """
        if not isinstance(self.sigma, str):
            return None
        return Axis(self.sigma, self.unit, 0.0, self.range).name

    @property
    def beyond(self) -> float:
        """How far a value may lie outside the range.

        One with an uncertainty of its own lies in the range: no axis of a picture was read.
        """
        own = 0.0 if isinstance(self.sigma, str) else MOST_SIGMAS_OUTSIDE * self.sigma
        return max(own, self.slack)

    def admits(self, values: ArrayLike) -> NDArray[np.bool_]:
        """Which of some values can be; an empty cell, nan, can.

        >>> Axis("angle", "deg", 0.5, (0, 90)).admits([-1.5, -1.6, np.nan]).tolist()
        [True, False, True]
        """
        low, high = self.range[0] - self.beyond, self.range[1] + self.beyond
        return np.logical_not(np.less(values, low) | np.greater(values, high))

    def sigmas(self, points: Table) -> Array:
        """The uncertainty of each of some points of its series.

        >>> Axis("angle", "deg", 0.5, (0, 90)).sigmas(pd.DataFrame({"angle [deg]": [30.0, 60.0]}))
        array([0.5, 0.5])
        """
        size = points[self.sigma_name] if self.sigma_name else self.sigma
        return np.broadcast_to(np.asarray(size, float), len(points))


@dataclass(frozen=True)
class Fact:
    """A number that a source states, with a tolerance; or an inequality that it states."""

    name: str
    unit: str
    value: float | None = None
    tolerance: float | None = None
    less_than: float | None = None
    greater_than: float | None = None
    settings: dict[str, Any] = field(default_factory=dict)  # as those of a `Series`

    @property
    def stated(self) -> str:
        """The value or the inequality, with its unit.

        >>> Fact("a/b", "N", less_than=2.0).stated
        '< 2 N'
        """
        signs = {"": self.value, "< ": self.less_than, "> ": self.greater_than}
        return next(f"{s}{with_unit(v, self.unit)}" for s, v in signs.items() if v is not None)


@dataclass(frozen=True)
class Series:
    """Points of one source: its entry in source.yaml.

    `path` is that of its table, None while it is awaited; `legend` is its name in a legend.
    `others` says that a code which is not ours computed it. `sigma_values` is the number of
    independent values from which the sigmas were estimated, None if they are known. `parameters`
    are those of the source, by name; `settings` are those of a figure for which alone the points
    hold. `calibration` is that of the picture in which the points were read, if it is known;
    `overlay` is a picture of it under our curves.
    """

    kind: str
    x: Axis
    y: Axis | tuple[Axis, ...]
    path: str | None = None
    name: str = ""  # source/series
    given: tuple[Axis, ...] = ()
    labels: tuple[str, ...] = ()
    others: bool = False
    sigma_values: int | None = None
    figure: str = ""
    legend: str = ""
    parameters: dict[str, float] = field(default_factory=dict)
    settings: dict[str, Any] = field(default_factory=dict)
    open: tuple[str, ...] = ()
    calibration: Calibration | None = None
    overlay: str | None = None

    @property
    def ordinates(self) -> tuple[Axis, ...]:
        """The y axes."""
        return self.y if isinstance(self.y, tuple) else (self.y,)

    @property
    def axes(self) -> dict[str, Axis]:
        """All axes, by their places in source.yaml."""
        y = {f"y.{place}": axis for place, axis in enumerate(self.ordinates)}
        given = {f"given.{place}": axis for place, axis in enumerate(self.given)}
        return {"x": self.x} | (y if isinstance(self.y, tuple) else {"y": self.y}) | given

    @property
    def is_published(self) -> bool:
        """Whether it holds points of nature, see `PUBLISHED`."""
        return self.kind in PUBLISHED

    def points(self) -> Table:
        """Read and check the points: quantities as numbers; labels as numbers if all of them are.

        If there are several y axes, some of their cells may be empty: these become nan. A
        `SourceError` names file, line, column and value.
        """
        path = str(self.path)
        axes = {axis.name: axis for axis in self.axes.values()}
        for axis in list(axes.values()):
            if axis.sigma_name:
                low, high = axis.range
                axes[axis.sigma_name] = Axis(axis.sigma_name, "", 0.0, (0.0, high - low))
        lines, cells = _cells(path, [*self.labels, *axes])
        may_be_empty = {axis.name for axis in self.y} if isinstance(self.y, tuple) else set()
        columns: dict[str, Any] = {label: _label(cells[label]) for label in self.labels}
        for column in axes:
            columns[column] = [
                _number(cell, f"{path}, line {line}, column '{column}'")
                if cell or column not in may_be_empty
                else math.nan
                for line, cell in zip(lines, cells[column], strict=True)
            ]
        points = pd.DataFrame(columns)
        for column, axis in axes.items():
            if not (admitted := axis.admits(points[column])).all():
                row, (low, high) = int(admitted.argmin()), axis.range
                where = f"{path}, line {lines[row]}, column '{column}'"
                sigmas = "" if axis.slack else f"{MOST_SIGMAS_OUTSIDE} sigmas, "
                raise SourceError(
                    f"{where}: {cells[column][row]} is outside {low:g} to {high:g} by more than "
                    f"{sigmas}{axis.beyond:g}" + self._guess(points, axes, column)
                )
        return points

    def _guess(self, points: Table, axes: Mapping[str, Axis], outside: str) -> str:
        """What may be wrong with points of which one is outside: all would fit without it."""
        x, y = self.x.name, self.ordinates[0].name
        guesses = {
            "; are the columns exchanged?": {x: points[y], y: points[x]},
            "; is its sign turned?": {outside: -points[outside]},
        }
        for guess, changed in guesses.items():
            tried = points.assign(**changed)
            if all(axis.admits(tried[column]).all() for column, axis in axes.items()):
                return guess
        return ""


def of(name: str, entry: Mapping[str, Any]) -> Series | Fact:
    """A series or a fact `source/name` from its entry in source.yaml; a series has a `kind`."""
    return (Series if "kind" in entry else Fact)(**{**entry, "name": name})


def text_of(path: str | Path) -> str:
    """Text of a file in UTF-8; of one that is none a `SourceError` names the line."""
    try:
        return csv_text.decoded(Path(path).read_bytes())
    except OSError as error:
        raise SourceError(f"{path}: {error.strerror}") from None
    except ValueError as error:
        raise SourceError(f"{path}, {error}") from None


def head_and_table(text: str) -> tuple[list[str], str]:
    r"""Lines with # before a table, and the text with blank ones there: lines keep their numbers.

    >>> head_and_table("# who: me\na,b\n1,2\n")
    (['# who: me\n'], '\na,b\n1,2\n')
    """
    lines = list(io.StringIO(text, newline=None))
    head = list(itertools.takewhile(lambda line: line.strip('" \t\r\n')[:1] in ("", "#"), lines))
    return head, "\n" * len(head) + "".join(lines[len(head) :])


def _cells(path: str, columns: list[str]) -> tuple[list[int], dict[str, list[str]]]:
    """Lines of the rows of a table, and the cells of these columns, which it must have.

    A header may lack the unit of a column that has its name alone, or have other blanks in it.
    """
    head, text = head_and_table(text_of(path))
    try:
        header, rows = csv_text.rows(text)
    except ValueError as error:
        problem = f"{error}"
        if row := WITH_COMMAS.search(text):
            line = text.count("\n", 0, row.start()) + 1
            problem = f"line {line}: {row[0]!a} has {COMMAS}"
        raise SourceError(f"{path}, {problem}") from None
    places, bare = {}, [column.partition(" [")[0] for column in columns]
    for column, name in zip(columns, bare, strict=True):
        known = {_squeezed(column), _squeezed(name if bare.count(name) == 1 else column)}
        at = [place for place, cell in enumerate(header) if _squeezed(cell) in known]
        if len(at) != 1:
            problem = "stands twice" if at else "is missing"
            found = ascii(", ".join(header))[1:-1]
            where = f"{path}, line {len(head) + 1}"
            raise SourceError(f"{where}: column '{column}' {problem}; found {found}")
        places[column] = at[0]
    if not rows:
        raise SourceError(f"{path}: no points")
    cells = {column: [row[place].strip() for _, row in rows] for column, place in places.items()}
    return [line for line, _ in rows], cells


def _squeezed(name: str) -> str:
    """A name of a column in our letters, without blanks."""
    return "".join(name.translate(LETTERS).split())


def _label(cells: list[str]) -> Any:
    """Labels of points as numbers, if all are numbers or empty; else as texts."""
    if any(cells) and all(NUMBER.fullmatch(cell) for cell in cells if cell):
        return np.array([float(cell or "nan") for cell in cells])
    return cells


def _number(cell: str, where: str) -> float:
    """A decimal number."""
    if NUMBER.fullmatch(cell):
        return float(cell)
    problem = f"has {COMMAS}" if {*",;"} & {*cell} else "is not a decimal number such as -0.05"
    raise SourceError(f"{where}: {cell!a} {problem}")
