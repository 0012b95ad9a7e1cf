"""Tables in pandas: curves in long form, and rows of any other kind.

A table of curves has a row for each point of each curve. The columns `curve`, `model` and
`variant`, and the parameters in which the curves differ (`e`, `mu`, ...), tell which curve it is
of. A column with a unit in brackets is a quantity. Other columns are words about a point, such as
`event`. A cell that a curve does not have is empty: nan, or an empty text.

A curve that is solved with a parameter off by its uncertainty has the name of the parameter in
`shifted`, and 1 or -1 in `sigmas`. Where each point has parameters of its own, their effect on a
quantity stands in the column that `sigma_name` names.
"""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from os import PathLike
from typing import Any, TypeAlias

import numpy as np
import pandas as pd
from numpy.typing import ArrayLike

from planarimpact.common.arrays import Booleans

Table: TypeAlias = pd.DataFrame
Columns: TypeAlias = Mapping[str, ArrayLike]
# A row of any other table: its cells as text, by the names of the columns.
Row: TypeAlias = dict[str, str]
Path: TypeAlias = str | PathLike[str]

KEYS = ("curve", "model", "variant")
# Where a selection does not name these columns, they are empty: so it has the curve itself.
DEFAULTS = ("variant", "shifted")


def is_quantity(column: str) -> bool:
    """Whether a column has numbers with a unit.

    >>> is_quantity("velocity [mu v2(0)]"), is_quantity("e")
    (True, False)
    """
    return column[-1:] == "]"


def sigma_name(column: str) -> str:
    """Name of the column with one standard deviation of another column.

    >>> sigma_name("spin [rad/s]")
    'spin_sigma [rad/s]'
    """
    return column.replace(" [", "_sigma [")


def with_unit(value: float, unit: str) -> str:
    """A number and its unit, which a pure number does not have.

    >>> with_unit(0.50, "N"), with_unit(2.0, "1")
    ('0.5 N', '2')
    """
    return f"{value:g}" if unit in ("", "1") else f"{value:g} {unit}"


def curve(columns: Columns, model: str, variant: str = "", **parameters: Any) -> Table:
    """One curve, whose points have these columns. A number that is not finite is an error.

    >>> curve({"x [1]": [0.0, 1.0]}, "lumped", e=0.5)["curve"].tolist()
    ['lumped, e = 0.5', 'lumped, e = 0.5']
    """
    own = {"model": model, "variant": variant, **parameters}
    table = pd.DataFrame({"curve": curve_name(own), **own, **columns})
    refuse_not_finite(table)
    return table


def curve_name(own: Mapping[str, Any]) -> str:
    """Name of a curve for readers, by the columns that tell it from others; lists have several.

    >>> curve_name({"model": "continuum", "variant": "rubber", "mu": 0.50})
    'continuum, rubber, mu = 0.5'
    """
    parts = []
    for key, value in own.items():
        if key not in ("shifted", "sigmas") and value != "":
            values = value if isinstance(value, list) else [value]
            words = " or ".join(one if isinstance(one, str) else f"{one:g}" for one in values)
            parts.append(words if isinstance(values[0], str) else f"{key} = {words}")
    shift = [f"{own['shifted']} {own['sigmas']:+g} sigma"] if own.get("shifted") else []
    return ", ".join(parts + shift)


def join(curves: Iterable[Table]) -> Table:
    """Several curves as one table; two curves with the same columns are an error."""
    parts = list(curves)
    names = [name for part in parts for name in part["curve"].unique()]
    if twice := {name for name in names if names.count(name) > 1}:
        raise ValueError(f"two curves have the name {min(twice)!a}: allowed is one")
    return _filled(pd.concat(parts, ignore_index=True))


def _filled(table: Table) -> Table:
    """A table whose empty texts are texts, also in a column without a unit that is all empty."""
    numeric = table.select_dtypes("number")
    numbers = {column for column in numeric if is_quantity(column) or numeric[column].notna().any()}
    texts = [column for column in table if column not in numbers]
    return table.assign(**{column: table[column].astype(str).fillna("") for column in texts})


def refuse_not_finite(table: Table) -> None:
    """Refuse quantities of one curve that are not finite; a `ValueError` names the first one."""
    places = next(filter(is_quantity, table), "")
    for column in filter(is_quantity, table):
        good = np.isfinite(pd.to_numeric(table[column], errors="coerce"))
        if not good.all():
            first = table.loc[good.idxmin()]
            raise ValueError(
                f"curve '{first['curve']}', column '{column}' is {first[column]} where '{places}' "
                f"is {first[places]:g}: allowed are finite numbers"
            )


def where(table: Table, **wanted: Any) -> Booleans:
    """Which rows have the wanted values, by column; a sequence stands for any of its values.

    nan stands for an empty cell. A text is taken for a number where the column has numbers.
    """
    kept = np.full(len(table), True)
    for column, value in wanted.items():
        values = [value] if isinstance(value, str | float | int) else list(value)
        if column not in table:
            raise ValueError(f"no column {column!a}; there are {', '.join(table)}")
        if pd.api.types.is_numeric_dtype(table[column]):
            values = [_as_number(column, one) for one in values]
        kept &= table[column].isin(values).to_numpy()
    return kept


def _as_number(column: str, value: Any) -> float:
    try:
        return np.nan if value == "" else float(value)
    except ValueError:
        raise ValueError(f"{column} = {value!a}: allowed are numbers") from None


def only_curve(table: Table) -> str:
    """The name of the only curve of a table; that it has several is an error."""
    names = table["curve"].unique()
    if len(names) > 1:
        raise ValueError(f"allowed is one curve, and these are selected: {'; '.join(names)}")
    return str(names[0])


def no_curve(table: Table, wanted: Mapping[str, Any]) -> ValueError:
    """The error that no curve of a table has the wanted values."""
    asked = ", ".join(f"{column} = {value}" for column, value in wanted.items() if value != "")
    return ValueError(f"no curve has {asked}; there are: {'; '.join(table['curve'].unique())}")


def select(table: Table, **wanted: Any) -> Table:
    """The curves with the wanted values, as for `where`, without the columns that they lack.

    `variant` and `shifted` are empty unless they are named. That there is none is an error.

    >>> both = join(curve({"x [1]": [e]}, "lumped", e=e) for e in (0.5, 1.0))
    >>> select(both, e=0.5)["x [1]"].tolist()
    [0.5]
    >>> select(both, model="lumped", e=0.25)
    Traceback (most recent call last):
    ValueError: no curve has model = lumped, e = 0.25; there are: lumped, e = 0.5; lumped, e = 1
    """
    wanted = {key: "" for key in DEFAULTS if key in table and key not in wanted} | wanted
    found = table[where(table, **wanted)].reset_index(drop=True)
    if found.empty:
        raise no_curve(table, wanted)
    empty = [column for column in found if found[column].isin(["", np.nan]).all()]
    return found.drop(columns=[column for column in empty if column not in KEYS])


def each(table: Table, by: str, **wanted: Any) -> Iterator[tuple[Any, Table]]:
    """The values of a column of the selected curves in their order, and the curves of each value.

    >>> both = join(curve({"x [1]": [e]}, "lumped", e=e) for e in (1.0, 0.5))
    >>> [value for value, own in each(both, "e")]
    [1.0, 0.5]
    """
    chosen = select(table, **wanted)
    for value, own in chosen.groupby(by, sort=False):
        yield value, select(own, **wanted)


def write(path: Path, table: Table) -> None:
    """Write a table of curves, quantities last. What is read again is the same to the last bit."""
    table[sorted(table, key=is_quantity)].to_csv(path, index=False, lineterminator="\n")


def read(path: Path, curve: str = "") -> Table:
    """Read what `write` wrote; a quantity that is not a finite number is an error.

    `curve` is the name of the only curve of a table that has no such column.
    """
    texts = dict.fromkeys([*KEYS, *DEFAULTS], str)
    table = _filled(pd.read_csv(path, dtype=texts, keep_default_na=False, na_values=[""]))
    if curve:
        table.insert(0, "curve", curve)
    for _, own in table.groupby("curve", sort=False):
        refuse_not_finite(own.dropna(axis="columns", how="all"))
    return table


def write_rows(path: Path, rows: Iterable[Mapping[str, Any]], columns: Sequence[str]) -> None:
    """Write rows of any other table, these columns of theirs."""
    table = pd.DataFrame(list(rows), columns=list(columns), dtype=object)
    table.to_csv(path, index=False, lineterminator="\n")


def read_rows(path: Path, columns: Sequence[str] | None = None) -> list[Row]:
    """Rows of any other table, each cell as its text; `columns` are those that it must have."""
    table = pd.read_csv(path, dtype=str, keep_default_na=False, usecols=columns)
    return table.to_dict("records")
