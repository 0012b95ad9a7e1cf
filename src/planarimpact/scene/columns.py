"""The columns of a scene's table: names, units, allowed numbers, and which columns are needed."""

import difflib
import re
from collections.abc import Iterable
from functools import partial
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from planarimpact.collision import RESTITUTION_FROM
from planarimpact.common import checks
from planarimpact.common.arrays import Array, Booleans
from planarimpact.common.checks import LARGEST, LEAST, InputError
from planarimpact.common.losses import SPHERES

if TYPE_CHECKING:
    import pandas as pd

LOSSES = tuple(SPHERES)
HEADER = re.compile(r"(?P<name>[^\[\]]*?) *(\[(?P<unit>[^\]]*)\])?")


class Column(NamedTuple):
    """A column: unit, meaning, the text of what is allowed, and the range of its numbers."""

    unit: str
    meaning: str = ""
    allowed: str = "finite numbers"
    low: float = -LARGEST
    high: float = LARGEST


_above = partial(Column, allowed="finite numbers above 0", low=LEAST)
_from_0 = partial(Column, allowed="finite numbers from 0", low=0)
AXES = "xyz"

BODY = {
    "radius": _above("m", "distance from centre to contact point"),
    "density": _above("kg/m^3", "of a solid sphere; or else mass and gyration"),
    "mass": _above("kg"),
    "gyration": _above("m", "radius of gyration"),
    "young_modulus": _above("Pa"),
    "poisson_ratio": Column("", "", "numbers above -1, up to 0.5", np.nextafter(-1, 0), 0.5),
}
# Numbers of the other body may be infinite, but for its density and Poisson's ratio.
OTHER = {f"other_{name}": column for name, column in BODY.items()} | {
    f"other_{name}": Column(BODY[name].unit, "", "numbers above 0, or inf", LEAST, np.inf)
    for name in ("radius", "mass", "gyration", "young_modulus")
}
PAIR = {
    "friction": _from_0("", "coefficient of friction"),
    "restitution": Column("", "or else one of the next two", "numbers from 0 to 1", 0, 1),
    "relaxation_time": _from_0("s", "of viscous bodies: e by the speed"),
    "yield_pressure": _above("Pa", "the largest in the contact: e by the speed"),
    "loss": Column("", "what takes the energy; may be empty at e = 1", ", ".join(LOSSES)),
}
PLANE = {
    "velocity_tangential": Column("m/s"),
    "velocity_normal": Column("m/s", "positive towards the surface"),
    "spin": Column("rad/s", "positive if it moves the contact point forward"),
}
SPACE = {f"velocity_{axis}": Column("m/s") for axis in AXES}
SPACE |= {f"spin_{axis}": Column("rad/s") for axis in AXES}
NORMAL = {f"normal_{axis}": Column("", "from the surface to the body") for axis in AXES}
OTHER_PLANE = {f"other_{name}": column for name, column in PLANE.items()}
OTHER_SPACE = {f"other_{name}": column for name, column in SPACE.items()}

KNOWN = BODY | OTHER | PAIR | PLANE | SPACE | NORMAL | OTHER_PLANE | OTHER_SPACE
# What the result adds to the table, in addition to the states after, restitution and loss.
_result = partial(Column, allowed="")
RESULT = {
    "contact_velocity_after": _result("m/s", "of the contact point, in the direction of incidence"),
    "model": _result("", "which one solved the impact"),
    "error_bound": _result("m/s", "of that velocity, against the continuum: tested, not proved"),
    "model_form": _result("m/s", "how far that velocity would move with the other loss"),
    "regime": _result("", "the order of stick and slip"),
    "incidence": _result("", "tangential over normal speed of the contact point, over friction"),
    "peak_normal_force": _result("N", "NaN where restitution is below 0.022"),
    "peak_friction_force": _result("N"),
    "energy_lost": _result("J"),
}
# The column that is carried over without a warning, which other unknown columns get.
LABEL = "id"
# A name as similar as this to one that is known is a misspelling.
CLOSE = 0.8
DECIMALS = "; decimals have a point, not a comma"


def header(name: str, ending: str = "") -> str:
    """Header of a column: its name, and an ending, with the unit in brackets if it has one.

    >>> header("radius"), header("friction")
    ('radius [m]', 'friction')
    """
    unit = (KNOWN | RESULT)[name].unit
    return f"{name}{ending} [{unit}]" if unit else name + ending


_STATES = PLANE | SPACE | OTHER_PLANE | OTHER_SPACE
ADDED = {header(name, "_after") for name in _STATES} | set(map(header, RESULT))


def _lines(columns: dict[str, Column]) -> str:
    """A line of help for each column: header, meaning, and what is allowed."""
    meanings = {n: "; ".join(filter(None, [c.meaning, c.allowed])) for n, c in columns.items()}
    lines = (f"  {header(name):<28}  {meaning}" for name, meaning in meanings.items())
    return "\n".join(map(str.rstrip, lines))


HELP = f"""\
Columns, with units in the header, separated by commas; the order is free. Row 1 is the first one
below the header; blank lines do not count. Needed are a body,
{_lines(BODY)}
the pair of bodies,
{_lines(PAIR)}
and the state before, in a plane,
{_lines(PLANE)}
or in space, for bodies that turn alike about every axis. The normal has the length 1; left out it
is 0, 0, 1. Then, with x along the surface and z up, a plane state has spin_y = -spin.
{_lines(SPACE | NORMAL)}
The other body has the same columns with other_ in front, and velocities and spins in the same
directions. Its radius, mass, gyration and Young's modulus may be inf. Without a material it is
rigid; without a mass it is a wall, round if it has other_radius; without a velocity it is at rest.
Columns of other names, such as id, are your own, and carried over: from CSV as text. A name that
is nearly one of those above is refused, and so is one below. Contacts that stick at some time need
a restitution of 0.1 or more; with restitution 0 a plastic contact always sticks at some time.
The result has all these columns and then the state after, named as before with _after,
restitution and loss, if they are not given, and
{_lines(RESULT)}
Example:
  radius [m],density [kg/m^3],young_modulus [Pa],poisson_ratio,friction,restitution,loss,\
velocity_tangential [m/s],velocity_normal [m/s],spin [rad/s]
  0.01,7800,207e9,0.3,0.2,0.8,plastic,0.5,1,0
"""


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
            raise InputError(f"column {text!a}: the unit of {name} {allowed}")
        if name in header_of or text in others:
            raise InputError(f"column {text!a} is there twice")
        if name in KNOWN:
            header_of[name] = text
        else:
            _refuse_similar(text, name)
            others.append(text)
    try:
        _refuse_incomplete(set(header_of))
    except InputError as error:
        unknown = ", ".join(ascii(text) for text in others if text != LABEL)
        raise InputError(f"{error}; unknown is {unknown}" if unknown else str(error)) from None
    return header_of


def _refuse_similar(text: str, name: str) -> None:
    """Refuse an unknown column that may be meant for a known one, or that the result has."""
    if text.strip() in ADDED:
        raise InputError(
            f"column {text!a}: the result has a column of this name; leave it out or rename it"
        )
    close = difflib.get_close_matches(name.lower(), KNOWN, n=1, cutoff=CLOSE)
    if close:
        raise InputError(
            f"column {text!a}: unknown; did you mean '{header(close[0])}'? If it is your own, "
            "rename it"
        )


def _refuse_incomplete(names: set[str]) -> None:
    """Refuse a table whose columns do not make up bodies and a state."""
    _need(names, ["radius", "young_modulus", "poisson_ratio", "friction"])
    _refuse_restitution(names)
    _need_one_of(names, "density", ("mass", "gyration"))
    if names & (set(OTHER) - {"other_young_modulus", "other_poisson_ratio", "other_radius"}):
        _need(names, ["other_radius"])
        _need_one_of(names, "other_density", ("other_mass", "other_gyration"))
    _all_or_none(names, ["other_young_modulus", "other_poisson_ratio"])
    plane, space = names & set(PLANE | OTHER_PLANE), names & set(SPACE | NORMAL | OTHER_SPACE)
    if plane and space:
        raise InputError(
            f"columns {_listed(plane)} and {_listed(space)}: states have two dimensions or three"
        )
    _need(names, SPACE if space else PLANE)
    _all_or_none(names, NORMAL)
    for quantity in ("velocity", "spin"):  # what is left out is 0
        of_other = OTHER_SPACE if space else OTHER_PLANE
        _all_or_none(names, [name for name in of_other if quantity in name])


def _refuse_restitution(names: set[str]) -> None:
    """Refuse a table that does not give the restitution in one way."""
    present = names & set(RESTITUTION_FROM)
    if len(present) != 1:
        listed = f" {_listed(present)}" if present else ""
        raise InputError(f"columns{listed}: needed is exactly one of {_listed(RESTITUTION_FROM)}")
    (name,) = present
    if "loss" in names and RESTITUTION_FROM[name]:
        raise InputError(
            f"column loss: allowed only with restitution, as {header(name)} is always "
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
    table: "pd.DataFrame", names: dict[str, str], loss: str | None = None
) -> tuple[dict[str, Any], dict[int, str]]:
    """Columns of a table as float64 by name, and `{position: message}` of its bad rows.

    `names` is what `named` returns. Of several problems of a row the first one counts. Losses are
    words, empty where a row has none; `loss` is that of all rows of a table without the column.
    """
    values: dict[str, Any] = {}
    problems: dict[int, str] = {}
    for name, text in names.items():
        column = KNOWN[name]
        check = _losses if name == "loss" else partial(_checked, column=column)
        values[name], bad = check(table[text])
        for position in np.flatnonzero(bad).tolist():
            cell = table[text].iloc[position]
            shown = checks.brief(cell) if isinstance(cell, str) else checks.in_ascii(str(cell))
            hint = DECIMALS if "," in shown else ""
            number = np.nan if name == "loss" else values[name][position]
            bounds = column.low, min(column.high, LARGEST)
            said = checks.refusal(text, number, column.allowed, *bounds, shown)
            problems.setdefault(position, said + hint)
    inertia = ("other_density", "other_mass", "other_gyration")
    moves = np.any([np.isfinite(values[name]) for name in inertia if name in values], axis=0)
    for position in np.flatnonzero(np.isinf(values.get("other_radius", 0.0)) & moves).tolist():
        allowed = "allowed are finite numbers where the other body can move or turn"
        problems.setdefault(position, f"{names['other_radius']} = inf: {allowed}")
    if "restitution" in names:
        values.setdefault("loss", np.full(len(table), loss or ""))
        missing = (values["restitution"] < 1) & (values["loss"] == "")
        for position in np.flatnonzero(missing).tolist():
            problems.setdefault(
                position,
                f"restitution = {values['restitution'][position]:g}: below 1 it needs a loss, "
                f"from a column loss or the argument loss (--loss): choose {', '.join(LOSSES)}",
            )
    return values, problems


def _checked(series: "pd.Series", column: Column) -> tuple[Array, Booleans]:
    """Numbers of one column, and which are not admissible."""
    from pandas.api import types

    is_number = types.is_integer_dtype(series) or types.is_float_dtype(series)
    if is_number and getattr(series.dtype, "itemsize", 16) <= 8:
        values = series.to_numpy(dtype=float, na_value=np.nan)
    else:  # words, numbers that float64 may not hold, sparse or other objects: cell by cell
        values = np.array([_number(cell) for cell in series], dtype=float)
    most = min(column.high, LARGEST)
    return values, ~((values >= column.low) & ((values <= most) | (values == column.high)))


def _losses(series: "pd.Series") -> tuple[Any, Booleans]:
    """The loss in each cell, empty where there is none; and which are unknown."""
    known = dict.fromkeys(checks.NO_LOSS, "") | {loss: loss for loss in LOSSES}
    cells = series.to_numpy(dtype=object)  # pandas' own loop over words takes ten times as long
    words = np.array([known.get(str(cell).strip(), "?") for cell in cells], dtype=str)
    return words, words == "?"


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
