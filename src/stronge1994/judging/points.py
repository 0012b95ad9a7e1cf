"""Which points of a reference a comparison is about, and how uncertain they are."""

from collections.abc import Mapping, Sequence
from typing import Any, TypeAlias

import numpy as np

from planarimpact.common.arrays import Array, ArrayLike, Booleans
from stronge1994 import reference_data
from stronge1994.csv_tables import Columns
from stronge1994.curve_names import AS_PRINTED
from stronge1994.verdict_tables.verdict_table import QUESTIONS

# A comparison of the config, and what it names: a series or a fact of source.yaml, with the
# parameters of its source. What a law is compared with is empty.
Entry: TypeAlias = Mapping[str, Any]
Reference: TypeAlias = Mapping[str, Any]
PAPER = "stronge1994"  # the source that holds what the paper states
# The limits of the regimes divide the axis of incidence into these parts.
PARTS = ("initial stick", "slip and stick", "slip throughout")


def kind(reference: Reference) -> str:
    """Kind of a reference: a series has its own; else `fact`, or `law` without a reference."""
    return reference.get("kind", "fact") if reference else "law"


def is_published(reference: Reference) -> bool:
    """Whether a reference holds points of nature: published ones, or measured by their owner."""
    return kind(reference) in ("measured", "digitised", "stated", "awaited")


def question(entry: Entry, reference: Reference) -> str:
    """Which of three questions a comparison answers, of `verdict_table.QUESTIONS`.

    Beside others stand published and measured points, what other codes compute, and what others
    state. As printed is what the paper states, and a difference that is an entry of the ledger. All
    else asks only whether our curve is solved right: our second codes and laws.

    >>> question({"reference": "lumped_40_digits/fig6_rebound"}, {"kind": "computed"})
    'solved right'
    >>> question({"reference": "stronge1994/peak_angle_mu_1"}, {"statement": "at 60 deg"})
    'as printed'
    >>> question({"reference": "maw1976/slip_throughout_limit"}, {"statement": "at 4 chi - 1"})
    'beside others'
    """
    solved, printed, others = QUESTIONS
    theirs = kind(reference) == "fact" and not entry["reference"].startswith(f"{PAPER}/")
    if theirs or is_published(reference) or reference.get("others"):
        return others
    stated = kind(reference) == "fact" or "entry" in entry.get("documented", {})
    return printed if stated else solved


def points(entry: Entry, reference: Reference) -> Columns:
    """Columns of the reference in the regime and with the labels of the comparison."""
    series = reference_data.arrays(reference)
    if entry.get("as_printed"):
        series["curve"] = np.char.replace(series["curve"], f"{AS_PRINTED}, ", "")
    x = series[reference_data.column_name(reference["x"])]
    low, high = _window(entry, reference)
    chosen = (x >= low) & (x < high)
    for label, word in entry.get("points", {}).items():
        chosen &= series[label] == word
    if "curve" in entry and "curve" in reference.get("labels", []):
        chosen &= series["curve"] == entry["curve"]
    if not chosen.any():
        raise ValueError("the reference has no such points")
    return rows_of(series, chosen)


def rows_of(series: Columns, chosen: Booleans) -> Columns:
    """The chosen rows of a series."""
    return {column: values[chosen] for column, values in series.items()}


def sigma(
    entry: Entry, axes: Sequence[Mapping[str, Any]], series: Columns
) -> tuple[ArrayLike, ArrayLike]:
    """Uncertainties on both axes, of all points or of each, with an allowance for the model."""
    both = []
    for axis, which in zip(axes, "xy", strict=True):
        column = reference_data.sigma_column(axis)
        size = axis["sigma"] if column is None else series[column]
        if not np.all(size):
            raise ValueError("a point that is compared has an uncertainty of 0")
        allowance = entry.get("allowance", {}).get(which)
        both.append(size if allowance is None else np.hypot(size, allowance))
    return both[0], both[1]


def _window(entry: Entry, reference: Reference) -> tuple[float, float]:
    """Where a regime begins and ends on the axis of the reference, by its source's parameters."""
    if "regime" not in entry:
        return -np.inf, np.inf
    stated = reference["parameters"]
    keys = ("mass_ratio", "stiffness_ratio", "restitution")
    limits = limits_of_regimes(*(stated[key] for key in keys))
    if reference["x"]["column"] == "angle":
        limits = np.degrees(np.arctan(stated["friction"] * limits))
    ends = [-np.inf, *limits, np.inf]
    place = PARTS.index(entry["regime"])
    return ends[place], ends[place + 1]


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
