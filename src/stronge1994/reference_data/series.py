"""What a source.yaml states: sources, series with their axes, and facts; the points of a series."""

import math
import re
from collections.abc import Iterator, Mapping
from dataclasses import field
from typing import Annotated, Any, ClassVar, Literal, TypeAlias

import numpy as np
import pandas as pd
from numpy.typing import ArrayLike, NDArray
from pydantic import Discriminator, Field, Tag
from pydantic.dataclasses import dataclass

from planarimpact.common.arrays import Array
from stronge1994.reference_data import formats
from stronge1994.reference_data.calibration import Calibration
from stronge1994.reference_data.formats import (
    COMMAS,
    CONFIG,
    Declared,
    Number,
    Positive,
    SourceError,
    Span,
    Truth,
    Whole,
)
from stronge1994.tables import Table, with_unit

# Kinds of series that hold measured points, or published ones.
PUBLISHED = ("measured", "digitised", "stated", "awaited")
# What an entry has besides, by its kind.
NEEDED = {
    "measured": ("measured_by", "points"),
    "digitised": ("digitised_by", "points"),
    "stated": ("points",),
    "computed": ("command", "method", "points"),
    "awaited": (),
}
# float() would also take `1_000`, `nan` and digits of other scripts.
NUMBER = re.compile(r"[+-]?([0-9]+([.][0-9]*)?|[.][0-9]+)([eE][+-]?[0-9]+)?")
# Sigmas by which a value may lie outside the range of its axis.
MOST_SIGMAS_OUTSIDE = 3
# Largest sigma, as a share of the range of its axis. The series here have a tenth to a half of it.
# A measured series may have a larger one: that is how it was measured.
LARGEST_SIGMA = 0.01
Text3: TypeAlias = Annotated[str, Field(min_length=3)]
Text10: TypeAlias = Annotated[str, Field(min_length=10)]
Name: TypeAlias = Annotated[str, Field(pattern="^[a-z0-9_.]+$")]
Column: TypeAlias = Annotated[str, Field(pattern="^[a-z_]+$")]


@dataclass(frozen=True, config=CONFIG)
class Axis(Declared):
    """An axis: a column of a series, its unit, what its values can be, and their sigma.

    `sigma` is one number for all points, or the name of the column that has that of each. A value
    may lie outside the range by `slack`, for an error that all points of a reading share.
    """

    column: Column
    unit: str
    sigma: Number | Column
    range: Span
    slack: float = 0.0
    symbol: str = ""
    OURS: ClassVar = ("slack",)

    def faults(self) -> Iterator[str]:
        """A range the wrong way round, and a sigma that is no size."""
        low, high = self.range
        if not low < high:
            yield f"range = [{low:g}, {high:g}]: the first number must be the smaller"
        if not (isinstance(self.sigma, str) or self.sigma > 0):
            yield f"sigma = {self.sigma:g}: allowed is more than 0"
        if not self.symbol:
            yield "symbol: missing"

    def refusals(self, sigma: float | str) -> Iterator[str]:
        """Why points with such a sigma would judge nothing."""
        low, high = self.range
        most = LARGEST_SIGMA * (high - low)
        if isinstance(sigma, str):
            yield f"{sigma!a}: allowed is one number for all points"
        elif sigma > most:
            yield (
                f"{sigma:g}: allowed is up to {most:g}, a hundredth of the range {low:g} to "
                f"{high:g}; with more the series would judge nothing"
            )

    @property
    def name(self) -> str:
        """Column header: with its unit in brackets if it has one."""
        return f"{self.column} [{self.unit}]" if self.unit else self.column

    @property
    def of_sigma(self) -> "Axis | None":
        """The column of the uncertainties; None where one number holds for all.

        >>> Axis("friction", "1", "friction_uncertainty", (0, 1)).of_sigma.name
        'friction_uncertainty [1]'
        """
        low, high = self.range
        size = (0.0, high - low)
        return Axis(self.sigma, self.unit, 0.0, size) if isinstance(self.sigma, str) else None

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
        size = points[self.of_sigma.name] if self.of_sigma else self.sigma
        return np.broadcast_to(np.asarray(size, float), len(points))


@dataclass(frozen=True, config=CONFIG)
class Fact(Declared):
    """A number that a source states, with a tolerance; or an inequality that it states."""

    name: str = ""
    unit: str = ""
    value: Number | None = None
    tolerance: Positive | None = None
    less_than: Number | None = None
    greater_than: Number | None = None
    settings: dict[str, Any] = field(default_factory=dict)  # as those of a `Series`
    statement: Text10 = ""
    where: Text3 = ""
    tolerance_origin: Annotated[str, Field(min_length=5)] = ""
    OURS: ClassVar = ("name",)

    def faults(self) -> Iterator[str]:
        """What a fact lacks, or has too much."""
        needed = ["statement", "where", "unit"]
        needed += [] if self.value is None else ["tolerance", "tolerance_origin"]
        yield from (f"{key}: missing" for key in needed if not getattr(self, key))
        if [self.value, self.less_than, self.greater_than].count(None) != 2:
            yield "value: allowed is one of value, less_than and greater_than"

    @property
    def stated(self) -> str:
        """The value or the inequality, with its unit.

        >>> Fact("a/b", "N", less_than=2.0).stated
        '< 2 N'
        """
        signs = {"": self.value, "< ": self.less_than, "> ": self.greater_than}
        return next(f"{s}{with_unit(v, self.unit)}" for s, v in signs.items() if v is not None)


Several: TypeAlias = Annotated[
    Annotated[Axis, Tag("one")] | Annotated[tuple[Axis, ...], Field(min_length=2), Tag("several")],
    Discriminator(lambda y: "several" if isinstance(y, list | tuple) else "one"),
]


@dataclass(frozen=True, config=CONFIG)
class Series(Declared):
    """Points of one source: its entry in source.yaml, and what is known of them besides.

    `given` are columns beside the axes, which curves are solved with. `labels` are columns that
    name a point; those of the table of curves, such as model and e, choose the curve that it is
    compared with. `others` says that a code which is not ours computed it. `sigma_values` is the
    number of independent values from which the sigmas were estimated, None if they are known.
    `unpublished` names an error of the points that nobody has published, such as the scatter of a
    measurement: sigma does not hold it, so that no difference from the points can be judged.
    `settings` are those of a figure for which alone the points hold: where a run has others, they
    are not compared; of a list they are values that it must have. `open` names settings that the
    source does not state: whoever reads an awaited series says in the head of its file for which
    value of each the points hold. `legend` is the name in a legend, for readers; `count` is that of
    the points, `points` in the file, where a cut table is refused.

    `path` is that of its table, None while it is awaited; `name` is source/series. `parameters` are
    those of the source, by name. `calibration` is that of the picture in which the points were
    read, if it is known; `overlay` is a picture of it under our curves.
    """

    kind: Literal["measured", "digitised", "stated", "computed", "awaited"]
    x: Axis
    y: Several
    path: str | None = None
    name: str = ""
    given: tuple[Axis, ...] = ()
    labels: tuple[str, ...] = ()
    others: Truth = False
    sigma_values: Whole | None = None
    unpublished: Text10 = ""
    figure: Text3 = ""
    legend: Text3 = ""
    parameters: dict[str, float] = field(default_factory=dict)
    settings: dict[str, Any] = field(default_factory=dict)
    open: tuple[str, ...] = ()
    calibration: Calibration | None = None
    overlay: str | None = None
    sigma_origin: Text10 = ""
    measured_by: Text3 = ""  # who, when, with what
    digitised_by: Text3 = ""
    command: str = ""  # the one that computed it
    method: str = ""
    count: Whole | None = Field(default=None, alias="points")
    OURS: ClassVar = ("path", "name", "parameters", "calibration", "overlay")

    def faults(self) -> Iterator[str]:
        """What its kind asks for: keys, and how its sigmas are stated."""
        for key in ("figure", "sigma_origin", *NEEDED[self.kind]):
            if not getattr(self, "count" if key == "points" else key):
                yield f"{key}: missing; a series that is {self.kind} has it"
        if self.open and self.kind != "awaited":
            yield "open: allowed where a series is awaited"
        if isinstance(self.y, tuple) and self.kind != "computed":
            yield "y: allowed are several axes where a series is computed"
        for place, axis in self.axes.items():
            if self.kind == "stated" and not isinstance(axis.sigma, str):
                yield f"{place}.sigma = {axis.sigma:g}: allowed is the column that has that of each"
            elif axis in self.given and isinstance(axis.sigma, str):
                continue
            elif self.kind not in ("measured", "stated"):
                yield from (f"{place}.sigma = {refusal}" for refusal in axis.refusals(axis.sigma))

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
        """Whether its points were measured or published, see `PUBLISHED`."""
        return self.kind in PUBLISHED

    def points(self) -> Table:
        """Read and check the points: quantities as numbers; labels as numbers if all of them are.

        If there are several y axes, some of their cells may be empty: these become nan. A
        `SourceError` names file, line, column and value.
        """
        axes = {axis.name: axis for axis in self.axes.values()}
        axes |= {size.name: size for axis in self.axes.values() if (size := axis.of_sigma)}
        lines, cells = formats.cells_of(str(self.path), [*self.labels, *axes])
        may_be_empty = {axis.name for axis in self.y} if isinstance(self.y, tuple) else set()
        columns: dict[str, Any] = {}
        for name, own in cells.items():
            empty = (name in may_be_empty or name in self.labels) and any(own)
            good = [bool(NUMBER.fullmatch(cell)) or (empty and not cell) for cell in own]
            if all(good):
                columns[name] = [float(cell or math.nan) for cell in own]
            elif name in self.labels:
                columns[name] = own
            else:
                row = good.index(False)
                problem = "is not a decimal number such as -0.05"
                problem = f"has {COMMAS}" if {*",;"} & {*own[row]} else problem
                where = f"{self.path}, line {lines[row]}, column '{name}'"
                raise SourceError(f"{where}: {own[row]!a} {problem}")
        points = pd.DataFrame(columns)
        for column, axis in axes.items():
            if not (admitted := axis.admits(points[column])).all():
                row, (low, high) = int(admitted.argmin()), axis.range
                where = f"{self.path}, line {lines[row]}, column '{column}'"
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


@dataclass(frozen=True, config=CONFIG)
class Parameter(Declared):
    """A number that a source states of what it measured or computed.

    `uncertainty` is one standard deviation, of rounding a twelfth of the last digit under the root;
    None where it is not stated.
    """

    value: Number
    unit: str
    uncertainty: Annotated[float, Field(strict=True, ge=0)] | None
    origin: str


@dataclass(frozen=True, config=CONFIG)
class Source(Declared):
    """A source.yaml. `holds` and `made` are lines for data/README.md.

    `made_with` names other files of the folder, which make the series.
    """

    holds: Text10
    made: Text10
    citation: Text10
    doi: Annotated[str, Field(pattern="^10[.]")] | None
    rights: Text10
    sign_convention: Text10
    parameters: dict[str, Parameter]
    note: str = ""
    made_with: list[str] = field(default_factory=list)
    series: dict[Name, Series] = field(default_factory=dict)
    facts: dict[Name, Fact] = field(default_factory=dict)
