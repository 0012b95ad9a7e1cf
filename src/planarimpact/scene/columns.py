"""The columns of a scene's table: names, units, allowed numbers, and which columns are needed."""

import difflib
import re
from collections.abc import Iterable
from functools import partial
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from planarimpact.collision import LOSSES, RESTITUTION_FROM
from planarimpact.ground.arrays import Array, Booleans
from planarimpact.ground.checks import InputError

if TYPE_CHECKING:
    import pandas as pd

# Position of a loss that is not said.
NO_LOSS = -1
HEADER = re.compile(r"(?P<name>[^\[\]]*?) *(\[(?P<unit>[^\]]*)\])?")


class Column(NamedTuple):
    """A column: its unit, the text of what is allowed, and the range of its numbers."""

    unit: str
    allowed: str
    low: float = -np.inf
    high: float = np.inf
    open_low: bool = False
    infinite: bool = False


_FINITE = "finite numbers"
_above = partial(Column, allowed="finite numbers above 0", low=0, open_low=True)
_large = partial(Column, allowed="numbers above 0, or inf", low=0, open_low=True, infinite=True)
_ratio = partial(Column, allowed="numbers above -1, up to 0.5", low=-1, high=0.5, open_low=True)
AXES = "xyz"

BODY = {
    "radius": _above("m"),
    "density": _above("kg/m^3"),
    "mass": _above("kg"),
    "gyration": _above("m"),
    "young_modulus": _above("Pa"),
    "poisson_ratio": _ratio(""),
}
OTHER = {
    "other_radius": _large("m"),
    "other_density": _above("kg/m^3"),
    "other_mass": _large("kg"),
    "other_gyration": _large("m"),
    "other_young_modulus": _large("Pa"),
    "other_poisson_ratio": _ratio(""),
}
PAIR = {
    "friction": Column("", "finite numbers from 0", low=0),
    "restitution": Column("", "numbers from 0 to 1", low=0, high=1),
    "relaxation_time": Column("s", "finite numbers from 0", low=0),
    "yield_pressure": _above("Pa"),
    "loss": Column("", ", ".join(LOSSES)),
}
PLANE = {
    "velocity_tangential": Column("m/s", _FINITE),
    "velocity_normal": Column("m/s", _FINITE),
    "spin": Column("rad/s", _FINITE),
}
SPACE = {f"velocity_{axis}": Column("m/s", _FINITE) for axis in AXES}
SPACE |= {f"spin_{axis}": Column("rad/s", _FINITE) for axis in AXES}
NORMAL = {f"normal_{axis}": Column("", _FINITE) for axis in AXES}  # of length 1
OTHER_PLANE = {f"other_{name}": column for name, column in PLANE.items()}
OTHER_SPACE = {f"other_{name}": column for name, column in SPACE.items()}

KNOWN = BODY | OTHER | PAIR | PLANE | SPACE | NORMAL | OTHER_PLANE | OTHER_SPACE
# The column that is carried over without a word; others that are not known are told.
LABEL = "id"
# A name as similar as this to one that is known is a misspelling.
CLOSE = 0.8
DECIMALS = "; decimals have a point, not a comma"


def header(name: str, ending: str = "") -> str:
    """Header of a column: its name, and an ending, with the unit in brackets if it has one.

    >>> header("radius"), header("friction")
    ('radius [m]', 'friction')
    """
    unit = KNOWN[name].unit
    return f"{name}{ending} [{unit}]" if unit else name + ending


# What the result has besides the columns of the table, and restitution and loss.
_STATES = [*PLANE, *SPACE, *OTHER_PLANE, *OTHER_SPACE]
ADDED = {
    *(header(name, "_after") for name in _STATES),
    "contact_velocity_after [m/s]",
    "model",
    "error_bound [m/s]",
    "model_form [m/s]",
    "regime",
    "incidence",
    "peak_normal_force [N]",
    "peak_friction_force [N]",
    "energy_lost [J]",
}


def named(headers: Iterable[object]) -> dict[str, str]:
    """`{name: header}` of the columns that are known.

    Refused are those that do not make up bodies and a state, that are there twice, that misspell a
    known one, or that the result has. Others are for the user alone.

    >>> named(["radius [mm]"])
    Traceback (most recent call last):
    ...
    planarimpact.InputError: column 'radius [mm]': the unit of radius is [m]
    """
    header_of: dict[str, str] = {}
    others: list[str] = []
    for text in map(str, headers):
        parts = HEADER.fullmatch(text.strip())
        name, unit = (parts["name"], parts["unit"]) if parts else (text, None)
        if name in KNOWN and unit not in ((KNOWN[name].unit,) if KNOWN[name].unit else (None, "1")):
            allowed = f"is [{KNOWN[name].unit}]" if KNOWN[name].unit else "is none: it is a number"
            raise InputError(f"column {text!r}: the unit of {name} {allowed}")
        if name in header_of or text in others:
            raise InputError(f"column {text!r} is there twice")
        if name in KNOWN:
            header_of[name] = text
        else:
            _refuse_similar(text, name)
            others.append(text)
    try:
        _refuse_incomplete(set(header_of))
    except InputError as error:
        unknown = ", ".join(repr(text) for text in others if text != LABEL)
        raise InputError(
            f"{error}; unknown is {unknown}; known are {_known()}" if unknown else str(error)
        ) from None
    return header_of


def _refuse_similar(text: str, name: str) -> None:
    """Refuse an unknown column that may be meant for a known one, or that the result has."""
    if text.strip() in ADDED:
        raise InputError(
            f"column {text!r}: the result has a column of this name; leave it out or rename it"
        )
    close = difflib.get_close_matches(name.lower(), KNOWN, n=1, cutoff=CLOSE)
    if close:
        raise InputError(
            f"column {text!r}: unknown; did you mean '{header(close[0])}'? If it is your own, "
            f"rename it; known are {_known()}"
        )


def _known() -> str:
    """All names in few words."""
    own = BODY | PAIR | PLANE | SPACE | NORMAL
    return f"{_listed(own)}, {LABEL}, and those of the body and its state with other_ in front"


def carried(headers: Iterable[object]) -> list[str]:
    """Headers of the columns that are not known: they are carried over as they are."""
    texts = list(map(str, headers))
    known = named(texts).values()
    return [text for text in texts if text not in known]


def _refuse_incomplete(names: set[str]) -> None:
    """Refuse a table whose columns do not make up bodies and a state."""
    _need(names, ["radius", "young_modulus", "poisson_ratio", "friction"])
    _refuse_restitution(names)
    _need_one_of(names, "density", ("mass", "gyration"))
    if names & (set(OTHER) - {"other_young_modulus", "other_poisson_ratio", "other_radius"}):
        _need(names, ["other_radius"])
        _need_one_of(names, "other_density", ("other_mass", "other_gyration"))
    _all_or_none(names, ["other_young_modulus", "other_poisson_ratio"])
    space = names & set(SPACE)
    if space and names & set(PLANE):
        raise InputError(
            f"columns {_listed(names & set(PLANE))} and {_listed(space)}: a state has two "
            "dimensions or three"
        )
    _need(names, list(SPACE if space else PLANE))
    _all_or_none(names, list(NORMAL))
    states = (OTHER_SPACE, OTHER_PLANE) if space else (OTHER_PLANE, OTHER_SPACE)
    for quantity in ("velocity", "spin"):  # what is left out is 0
        _all_or_none(names, [name for name in states[0] if quantity in name])
    wrong = names & set(states[1]) | (set() if space else names & set(NORMAL))
    if wrong:
        dimensions = "three" if space else "two"
        raise InputError(f"columns {_listed(wrong)}: the state has {dimensions} dimensions")


def _refuse_restitution(names: set[str]) -> None:
    """Refuse a table that does not say restitution in one way."""
    present = names & set(RESTITUTION_FROM)
    if len(present) != 1:
        listed = f" {_listed(present)}" if present else ""
        raise InputError(f"columns{listed}: needed is exactly one of {_listed(RESTITUTION_FROM)}")
    (name,) = present
    if "loss" in names and RESTITUTION_FROM[name]:
        raise InputError(
            f"column loss: allowed only beside restitution, as {header(name)} is always "
            f"{RESTITUTION_FROM[name]}"
        )


def _need(names: set[str], needed: Iterable[str]) -> None:
    missing = [name for name in needed if name not in names]
    if missing:
        raise InputError(f"columns {_listed(missing)}: missing")


def _need_one_of(names: set[str], single: str, several: Iterable[str]) -> None:
    if (single in names) == bool(names & set(several)):
        raise InputError(f"columns: needed are either {header(single)} or {_listed(several)}")
    if single not in names:
        _need(names, several)


def _all_or_none(names: set[str], group: Iterable[str]) -> None:
    if names & set(group):
        _need(names, group)


def _listed(names: Iterable[str]) -> str:
    return ", ".join(header(name) for name in KNOWN if name in names)


def numbers(
    table: "pd.DataFrame", names: dict[str, str]
) -> tuple[dict[str, Array], dict[int, str]]:
    """Columns of a table as float64 by name, and `{position: message}` of its bad rows.

    `names` is what `named` returns. The loss is its position in `LOSSES`. Of several
    problems of a row the first one counts.
    """
    values: dict[str, Array] = {}
    problems: dict[int, str] = {}
    for name, text in names.items():
        column = KNOWN[name]
        check = _losses if name == "loss" else partial(_checked, column=column)
        values[name], bad = check(table[text])
        for position in np.flatnonzero(bad).tolist():
            cell = table[text].iloc[position]
            shown = repr(cell) if isinstance(cell, str) else str(cell)
            hint = DECIMALS if "," in shown else ""
            problems.setdefault(position, f"{text} = {shown}: allowed are {column.allowed}{hint}")
    infinite = np.isinf(values.get("other_radius", 0.0)) & _moves(values)
    for position in np.flatnonzero(infinite).tolist():
        allowed = "allowed are finite numbers where the other body can move or turn"
        problems.setdefault(position, f"{names['other_radius']} = inf: {allowed}")
    return values, problems


def _moves(values: dict[str, Array]) -> Booleans:
    """Whether the other body has a mass, or a radius of gyration, that is finite."""
    if "other_density" in values:
        return np.ones(values["other_density"].size, dtype=bool)
    inertia = [values[name] for name in ("other_mass", "other_gyration") if name in values]
    return np.any(np.isfinite(inertia), axis=0) if inertia else np.zeros((), dtype=bool)


def _checked(series: "pd.Series", column: Column) -> tuple[Array, Booleans]:
    """Numbers of one column, and which are not admissible."""
    from pandas.api import types

    is_number = types.is_integer_dtype(series) or types.is_float_dtype(series)
    if is_number and series.dtype.itemsize <= 8:
        values = series.to_numpy(dtype=float, na_value=np.nan)
    else:  # words, numbers that float64 may not hold, or other objects: cell by cell
        values = np.array([_number(cell) for cell in series], dtype=float)
    good = values > column.low if column.open_low else values >= column.low
    good &= values <= column.high
    if not column.infinite:
        good &= np.isfinite(values)
    return values, ~good


def _losses(series: "pd.Series") -> tuple[Array, Booleans]:
    """Position in `LOSSES` of the loss in each cell, `NO_LOSS` of empty ones; and unknown ones."""
    known = {loss: position for position, loss in enumerate(LOSSES)}
    known |= dict.fromkeys(("", "None", "nan", "<NA>"), NO_LOSS)
    cells = series.to_numpy(dtype=object)  # pandas' own loop over words takes ten times as long
    values = np.array([known.get(str(cell).strip(), NO_LOSS - 1) for cell in cells], dtype=float)
    return values, values < NO_LOSS


def refuse_missing_loss(values: dict[str, Array], problems: dict[int, str]) -> None:
    """Add rows below restitution 1 whose loss nobody says to the problems."""
    if "loss" in values:
        missing = (values["restitution"] < 1) & (values["loss"] == NO_LOSS)
        for position in np.flatnonzero(missing).tolist():
            problems.setdefault(
                position,
                f"restitution = {values['restitution'][position]:g}: allowed are numbers equal to "
                "1, unless a column loss or the argument loss (--loss) says what takes the energy: "
                f"{', '.join(LOSSES)}",
            )


def _number(cell: Any) -> float:
    """The number in a cell, or of its text in plain digits, else NaN.

    Only the text inf is infinite. A number that is too large for float64 is NaN.
    """
    text = str(cell)
    refused = isinstance(cell, (bool, np.bool_, complex)) or "_" in text or not text.isascii()
    try:
        value = np.nan if refused else float(cell)
    except (TypeError, ValueError, OverflowError):
        return np.nan
    return np.nan if np.isinf(value) and "inf" not in text.lower() else value
