"""A comparison: what figure.yaml and source.yaml state of it, read once."""

from collections.abc import Mapping
from dataclasses import field
from enum import StrEnum
from typing import Any

import numpy as np
from pydantic.dataclasses import dataclass

from planarimpact.common.arrays import Array
from stronge1994 import reference_data, tables
from stronge1994.names import STRONGE
from stronge1994.reference_data import Axis, Fact, Series
from stronge1994.tables import Table
from stronge1994.verdict_table import Group, Why

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


@dataclass(frozen=True)
class Landmark:
    """A landmark of a curve, see `judging.landmarks`; `x` and `y` are columns."""

    kind: str
    x: str
    y: str
    at: float | str | None = None


@dataclass(frozen=True)
class KnownDifference:
    """What is known of a difference, and its cause: an entry of the ledger or a note.

    `paper` says of a statement of the paper whether it is wrong or vague.
    """

    why: Why
    entry: str = ""
    note: str = ""
    paper: str = ""


@dataclass(frozen=True)
class Allowance:
    """How far the model may be off by its form, in units of the axes."""

    x: float = 0.0
    y: float = 0.0


@dataclass(frozen=True)
class Comparison:
    """One comparison of a figure or scene.

    `curve` selects curves by their columns, see `tables.select`; empty, each point of the reference
    selects its own by its labels. Of the reference are compared only the points with these labels,
    `points`, in the `regime`. `says` is what the reference says, for readers. A comparison, like a
    reference, may be for some `settings` of the figure alone. `differs` says what is known of a
    difference, should there be one. A `scale` is fitted, see `judging.scales`.
    """

    name: str
    metric: Metric
    reason: str
    says: str = ""
    reference: Series | Fact | None = None
    curve: dict[str, Any] = field(default_factory=dict)
    points: dict[str, Any] = field(default_factory=dict)
    regime: str = ""  # one of `REGIMES`
    allowance: Allowance | None = None
    scale: str = ""
    landmark: Landmark | None = None
    columns: list[str] = field(default_factory=list)
    range: tuple[float, float] | None = None
    limit: float = 1.0  # in the unit of the axis, of a law
    settings: dict[str, Any] = field(default_factory=dict)
    differs: KnownDifference | None = None

    @classmethod
    def of(
        cls, name: str, entry: Mapping[str, Any], references: Mapping[str, Mapping[str, Any]]
    ) -> "Comparison":
        """A comparison from its entry in figure.yaml, and from source.yaml `{source/name: entry}`.

        >>> law = {"metric": "small", "columns": ["x [1]"], "reason": "a law"}
        >>> Comparison.of("a", law, {}).group.value
        'solver checked'
        """
        own = {**entry, "name": name}
        if "reference" in entry:
            full = entry["reference"]
            own["reference"] = reference_data.of(full, references[full])
        return cls(**own)

    @property
    def group(self) -> Group:
        """With what it compares.

        OTHERS: points of nature, and what other codes compute and others state. PAPER: what the
        paper states, and a difference that is an entry of the ledger. PRINTED: its printed curves.
        All else, our second codes and laws, only checks our SOLVER.
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

        It may be for one value among several of the run.

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
            if key in there
            and value != there[key]
            and not (isinstance(there[key], list) and value in there[key])
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
        along = self._sigma(series.x, chosen, "x")
        both = [[along, self._sigma(y, chosen, "y")] for y in series.ordinates]
        return chosen, [np.transpose(sigmas) for sigmas in both]

    def _sigma(self, axis: Axis, points: Table, which: str) -> Array:
        sigmas = axis.sigmas(points)
        if not np.all(sigmas):
            raise ValueError("a point that is compared has an uncertainty of 0")
        return np.hypot(sigmas, self.allowed(which))

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
