"""A comparison: what figure.yaml and source.yaml state of it, read once."""

from collections.abc import Iterator, Mapping
from dataclasses import field
from enum import StrEnum
from typing import Annotated, Any, ClassVar, Literal, TypeAlias

import numpy as np
from pydantic import Field
from pydantic.dataclasses import dataclass

from planarimpact.common.arrays import Array
from stronge1994 import tables
from stronge1994.names import STRONGE
from stronge1994.reference_data import Fact, Series
from stronge1994.reference_data.formats import CONFIG, Declared, Number, Span
from stronge1994.tables import Table
from stronge1994.verdict_table import Group

# Parts of the axis of incidence, in order; the limits of the regimes divide it into these.
REGIMES = ("initial stick", "slip and stick", "slip throughout")


class Metric(StrEnum):
    """What a comparison measures.

    Against points: the `distance` from a curve, or from its `vertices`. Against a stated fact: a
    `landmark` of a curve. Against a law, without a reference: a column that must be `small`, or two
    that must be equal; columns whose values have a `range`; or neighbours that must not leave
    further apart than they arrive (`contraction`).
    """

    DISTANCE = "distance"
    VERTICES = "vertices"
    LANDMARK = "landmark"
    RATIO = "ratio"
    SMALL = "small"
    RANGE = "range"
    CONTRACTION = "contraction"


# What a metric needs, and metrics of which alone a comparison has a field.
NEEDED = {
    Metric.DISTANCE: ("reference",),
    Metric.VERTICES: ("reference",),
    Metric.LANDMARK: ("reference", "landmark", "curve"),
    Metric.RATIO: ("reference", "scale"),
    Metric.SMALL: ("columns", "limit"),
    Metric.RANGE: ("columns", "range"),
    Metric.CONTRACTION: ("columns", "limit"),
}
ONLY = {
    "allowance": (Metric.DISTANCE, Metric.VERTICES),
    "regime": (Metric.DISTANCE, Metric.VERTICES),
    "scale": (Metric.DISTANCE, Metric.RATIO),
    "limit": (Metric.SMALL, Metric.CONTRACTION),
}
# Fewest and most columns of a law.
COLUMNS = {Metric.SMALL: (1, 2), Metric.CONTRACTION: (2, 2)}
LEAST_REASON = 10  # characters
# Largest limit of a contraction, and largest allowance for a model as a share of the range of its
# axis: with more a comparison would judge nothing.
LARGEST_EXPANSION, LARGEST_ALLOWANCE = 0.01, 0.02
Selection: TypeAlias = dict[str, str | Number | list[str | Number]]


@dataclass(frozen=True, config=CONFIG)
class Landmark(Declared):
    """A landmark of a curve, see `judging.landmarks`; `x` and `y` are columns.

    `at` is the x of a value; else what y reaches, a number or a word.
    """

    kind: Literal["peak", "first", "last", "value"]
    x: str
    y: str
    at: Number | str | None = None


@dataclass(frozen=True, config=CONFIG)
class KnownDifference(Declared):
    """What is known of a difference, and its cause: an entry of the ledger or a note.

    The entry says how wrong the paper is, by its grade. A note is for what does not concern it.
    """

    why: Literal["cause known", "cause unknown"]
    entry: str = ""
    note: Annotated[str, Field(min_length=5)] = ""

    def faults(self) -> Iterator[str]:
        """Whether it says where more stands."""
        if self.entry and self.note:
            yield "note: allowed is either a note or an entry of the ledger"
        elif not (self.entry or self.note):
            yield "note or entry: missing; one of them says what is known of the difference"


@dataclass(frozen=True, config=CONFIG)
class Allowance(Declared):
    """How far the model may be off by its form, in units of the axes."""

    x: Annotated[float, Field(strict=True, ge=0)]
    y: Annotated[float, Field(strict=True, ge=0)]


@dataclass(frozen=True, config=CONFIG)
class Comparison(Declared):
    """One comparison of a figure or scene.

    `curve` selects curves by their columns, see `tables.select`; empty, each point of the reference
    selects its own by its labels. Of the reference are compared only the points with these labels,
    `points`, in the `regime`. `says` is what the reference says, for readers; the stated value or
    the size comes behind it. A comparison, like a reference, may be for some `settings` of the
    figure alone. `differs` says what is known of a difference, should there be one. A `scale` names
    what nobody states the scale of, such as force: a factor of the curve is fitted to the points,
    see `judging.scales`. `limit` is in the unit of the axis: of a column that must be small, of two
    that must be equal, or how much a contraction may expand.
    """

    name: str
    metric: Metric
    reason: str
    figure: str = ""  # or scene_ and the name of a scene
    says: Annotated[str, Field(min_length=4)] = ""
    reference: Series | Fact | None = None
    curve: Selection = field(default_factory=dict)
    points: dict[str, str | Number] = field(default_factory=dict)
    regime: Literal["initial stick", "slip and stick", "slip throughout"] | None = None
    allowance: Allowance | None = None
    scale: Annotated[str, Field(min_length=3)] = ""
    landmark: Landmark | None = None
    columns: list[str] = field(default_factory=list)
    range: Span | None = None
    limit: Annotated[float, Field(strict=True, gt=0, le=2)] = 0.0
    settings: dict[str, Any] = field(default_factory=dict)
    differs: KnownDifference | None = None
    OURS: ClassVar = ("name",)

    def faults(self) -> Iterator[str]:
        """What its metric asks for, and what of its reference it cannot be compared with."""
        for key in NEEDED[self.metric]:
            if not getattr(self, key):
                yield f"{key}: missing; metric {self.metric} needs it"
        for key, metrics in ONLY.items():
            if getattr(self, key) and self.metric not in metrics:
                yield f"{key}: allowed with metric {' or '.join(metrics)}, not {self.metric}"
        if len(self.reason) < LEAST_REASON:
            yield f"reason = {self.reason!a}: allowed are {LEAST_REASON} characters or more"
        least, most = COLUMNS.get(self.metric, (0, len(self.columns)))
        if self.columns and not least <= len(self.columns) <= most:
            yield f"columns = {self.columns}: allowed are {least} to {most} with {self.metric}"
        if self.metric == Metric.CONTRACTION and self.limit > LARGEST_EXPANSION:
            yield f"limit = {self.limit:g}: allowed is up to {LARGEST_EXPANSION:g}"
        if self.range and not self.range[0] < self.range[1]:
            ends = ", ".join(f"{end:g}" for end in self.range)
            yield f"range = [{ends}]: the first number must be the smaller"
        known = self.reference
        if known and isinstance(known, Fact) != (self.metric == Metric.LANDMARK):
            yield f"metric = {self.metric}: a landmark needs a fact, all others a series"
        elif isinstance(known, Series):
            yield from self._faults_of_points(known)

    def _faults_of_points(self, series: Series) -> Iterator[str]:
        if self.metric == Metric.DISTANCE and not (self.curve or series.labels):
            yield "curve: missing; metric distance needs it where points have no labels"
        for label in self.points:
            if label not in series.labels:
                allowed = ", ".join(series.labels) or "none"
                yield f"points.{label}: no label of {series.name}; allowed are {allowed}"
        for key, axis in [("x", series.x), *(("y", axis) for axis in series.ordinates)]:
            low, high = axis.range
            most = LARGEST_ALLOWANCE * (high - low)
            if (size := self.allowed(key)) > most:
                yield (
                    f"allowance.{key} = {size:g}: allowed is up to {most:g}, a fiftieth of the "
                    f"range {low:g} to {high:g}; with more the comparison would judge nothing"
                )

    @property
    def group(self) -> Group:
        """With what it compares.

        OTHERS: points that others measured, and what other codes compute and others state. PAPER:
        what the paper states, and a difference that is an entry of the ledger. PRINTED: its printed
        curves. All else, our second codes and laws, only checks our SOLVER.
        """
        known, reference = self.differs, self.reference
        if reference is not None and reference.name.split("/")[0] == STRONGE:
            return Group.PAPER if isinstance(reference, Fact) else Group.PRINTED
        if isinstance(reference, Fact):
            return Group.OTHERS
        if reference is not None and (reference.is_published or reference.others):
            return Group.OTHERS
        return Group.PAPER if known and known.entry else Group.SOLVER

    def other_settings(self, run: Mapping[str, Any]) -> str:
        """For which settings it is, and which the run has, in words; empty if they are the same.

        It may be for one value among several of the run, or for some of them.

        >>> fact = Fact("a/b", "1", settings={"friction": 0.5, "speed": {"first": 2}})
        >>> own = Comparison("a", Metric.LANDMARK, "so", reference=fact)
        >>> own.other_settings({"friction": [0.5, 1.0], "speed": {"first": 3}})
        'speed.first 2, this run has 3'
        """
        of_reference = self.reference.settings if self.reference else {}
        wanted, there = _leaves({**of_reference, **self.settings}), _leaves(run)
        return "; ".join(
            f"{key} {_in_words(value)}, this run has {_in_words(there[key])}"
            for key, value in wanted.items()
            if key in there and value != there[key] and not _has(there[key], value)
        )

    def allowed(self, which: str) -> float:
        """How far the model may be off along an axis, x or y."""
        return float(getattr(self.allowance, which, 0.0))

    def selected_points(self, series: Series) -> tuple[Table, list[Array]]:
        """The points of its reference that are compared, and for each y axis their sigmas.

        These have a row for each point, with x and y; they have the allowance for the model.
        """
        points = series.points()
        low, high = self._window(series)
        x = points[series.x.name]
        chosen = points[tables.where(points, **self.points) & (x >= low) & (x < high)]
        if chosen.empty:
            raise ValueError("the reference has no such points")
        axes = {"x": [series.x], "y": series.ordinates}
        sigmas = {key: [axis.sigmas(chosen) for axis in own] for key, own in axes.items()}
        if not all(np.all(size) for own in sigmas.values() for size in own):
            raise ValueError("a point that is compared has an uncertainty of 0")
        along = np.hypot(sigmas["x"][0], self.allowed("x"))
        both = [[along, np.hypot(size, self.allowed("y"))] for size in sigmas["y"]]
        return chosen, [np.transpose(sizes) for sizes in both]

    def _window(self, series: Series) -> tuple[float, float]:
        """Where its regime begins and ends on the axis, by the parameters of the source."""
        if not self.regime:
            return -np.inf, np.inf
        stated = series.parameters
        groups = (stated[key] for key in ("mass_ratio", "stiffness_ratio", "restitution"))
        limits = limits_of_regimes(*groups)
        if series.x.column == "angle":
            limits = np.degrees(np.arctan(stated["friction"] * limits))
        ends = [-np.inf, *limits, np.inf]
        place = REGIMES.index(self.regime)
        return ends[place], ends[place + 1]


def _leaves(settings: Mapping[str, Any], group: str = "") -> dict[str, Any]:
    """Settings by their names, those of a group behind its name and a dot."""
    found: dict[str, Any] = {}
    for key, value in settings.items():
        own = f"{group}{key}"
        found |= _leaves(value, f"{own}.") if isinstance(value, Mapping) else {own: value}
    return found


def _has(values: Any, wanted: Any) -> bool:
    """Whether a list of a run has a value, or all of a shorter list.

    >>> _has([0, 0.5, 0.8, 1], [0, 0.5, 1]), _has([1, 0], [0, 1])
    (True, False)
    """
    if not isinstance(values, list):
        return False
    if isinstance(wanted, list):
        return len(values) > len(wanted) and all(value in values for value in wanted)
    return wanted in values


def _in_words(value: Any) -> str:
    return ", ".join(map(str, value)) if isinstance(value, list) else f"{value}"


def limits_of_regimes(mass_ratio: float, stiffness_ratio: float, restitution: float) -> Array:
    """Incidences at which a contact no longer sticks at first, and at which it slips throughout.

    Every model with Coulomb friction and both compliances has these limits (Stronge 1994, Eq. 11,
    and the incidence above which slip does not end by its Eqs 17 to 20). They are in mu v2(0), and
    e must be above 0. For zeta^2 > beta both are zeta^2: a contact that slips at first slips
    throughout. The limits select the points of a comparison. They are computed here, because a
    judge must not ask the solver that it judges.

    >>> limits_of_regimes(3.5, 1.21, 1.0).round(2).tolist()
    [1.21, 5.79]
    >>> limits_of_regimes(3.5, 5.0, 1.0).tolist()
    [5.0, 5.0]
    """
    beta, zeta2, e = mass_ratio, stiffness_ratio, restitution
    return np.array([zeta2, max(zeta2, beta + max(0.0, e * beta - zeta2 / e))])
