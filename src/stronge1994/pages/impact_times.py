"""Time of an impact in other codes and in ours, over the time of the table of spheres."""

import re
from collections.abc import Sequence
from typing import Any

from stronge1994.csv_tables import Row

CODES = {"lammps": "LAMMPS", "pooltool": "pooltool"}
TIME = re.compile(r"time_(\d+) \[s\]")
MICROSECONDS = 1e6
# Our fastest model, to which all times are compared, by loss.
TABLE = {"": "spheres", "viscous": "spheres.viscous", "plastic": "spheres.plastic"}
LAMMPS = "LAMMPS mindlin/force"


def section(trade: Sequence[Row], peers: Sequence[Row]) -> dict[str, Any]:
    """Times for the report.

    `peers` is empty where the other codes were not measured. `rows` are those of `ratios`, from
    `peers` where a code was measured, else from `trade`, because times of two processes do not
    compare. `absent` is a sentence for each code that the rows lack.

    >>> section([], [{"model": "lammps", "installed": "no"}])["absent"]
    ['LAMMPS is not installed.', 'pooltool was not measured.']
    """
    measured = [row for row in peers if row["installed"] == "yes"]
    absent = {row["model"] for row in peers if row["installed"] == "no"}
    names = {row["model"].split()[0].lower() for row in measured}
    sentences = [
        f"{label} {'is not installed' if code in absent else 'was not measured'}."
        for code, label in CODES.items()
        if code not in names
    ]
    return {"rows": ratios(measured or trade), "absent": sentences}


def ratios(rows: Sequence[Row]) -> list[Row]:
    """Time of an impact by code and model, and how many times that of the table of spheres.

    Times hardly follow e, so there are rows for e = 1 and for the largest e below it, by loss, the
    slowest first. Of a model with several settings the coarsest is taken. The time is that in the
    largest batch that all of them have solved; alone it is the median of random incidences. The
    ratios are left out where `rows` has no time of the table.

    >>> row = {"restitution [1]": "1.0", "loss": "", "max_velocity [mu v2(0)]": "0.2"}
    >>> row |= {"time_1 [s]": "1e-4"}
    >>> slow = row | {"model": "continuum", "time_1000 [s]": "6e-4"}
    >>> fast = row | {"model": "spheres", "time_1000 [s]": "2e-7"}
    >>> [ratio["times_spheres [1]"] for ratio in ratios([fast, slow])]
    ['3e+03', '1']
    """
    timed = [row for row in rows if any(row.get(key) for key in filter(TIME.fullmatch, row))]
    below = max((e for e in map(_restitution, timed) if e < 1), default=1.0)
    cases: dict[tuple[float, str], list[Row]] = {}
    for row in timed:
        if _restitution(row) in (1, below) and _is_shown(row):
            cases.setdefault((_restitution(row), row["loss"]), []).append(row)
    groups = [_coarsest(cases[case]) for case in sorted(cases, key=lambda case: -case[0])]
    known = {row["model"] for group in groups for row in group}
    with_ratios = bool(known & set(TABLE.values()))
    return [row for group in groups for row in _compared(group, with_ratios)]


def _restitution(row: Row) -> float:
    return float(row["restitution [1]"])


def _is_shown(row: Row) -> bool:
    """Whether a row is a code, the model that pooltool solves, or the continuum of its loss."""
    model, loss = row["model"], row["loss"]
    codes = "pooltool", "lumped", "lumped.hysteretic", LAMMPS, f"{LAMMPS}, viscoelastic, xt = 0"
    direct = f"continuum.{loss}" if loss else "continuum"
    return model in (*codes, direct, TABLE[loss])


def _coarsest(rows: Sequence[Row]) -> list[Row]:
    """One row of each model: that of the largest tolerance, or of the fewest steps."""

    def fineness(row: Row) -> tuple[float, float]:
        tolerance, steps = (row.get(key) for key in ("tolerance [mu v2(0)]", "steps [1]"))
        return -float(tolerance or 0), float(steps or 0)

    coarsest: dict[str, Row] = {}
    for row in sorted(rows, key=fineness):
        coarsest.setdefault(row["model"], row)
    return list(coarsest.values())


def _setting(row: Row) -> str:
    """Text for the steps or the tolerance of a row.

    >>> _setting({"steps [1]": "64"}), _setting({"tolerance [mu v2(0)]": "0.001"}), _setting({})
    ('64 steps', 'tolerance 0.001', '')
    """
    if steps := row.get("steps [1]"):
        return f"{float(steps):g} steps"
    tolerance = row.get("tolerance [mu v2(0)]")
    return f"tolerance {float(tolerance):g}" if tolerance else ""


def _batch(rows: Sequence[Row]) -> int:
    """Largest batch that all rows have solved."""
    solved = [{int(f[1]) for f in map(TIME.fullmatch, row) if f and row[f[0]]} for row in rows]
    return max(set.intersection(*solved))


def _compared(rows: Sequence[Row], with_ratios: bool) -> list[Row]:
    """Lines of the table for one restitution and loss."""
    batch = _batch(rows)
    times = {row["model"]: float(row[f"time_{batch} [s]"]) for row in rows}
    table = []
    for row in sorted(rows, key=lambda row: -times[row["model"]]):
        model, time = row["model"], times[row["model"]]
        alone = row.get("time_1 [s]", "")
        error = row.get("max_velocity [mu v2(0)]", "")
        entry = {
            "model": model,
            "setting": _setting(row),
            "restitution [1]": row["restitution [1]"],
            "loss": row["loss"],
            "max_velocity [mu v2(0)]": f"{float(error):.2g}" if error else "",
            "batch [1]": str(batch),
            "time [us]": f"{MICROSECONDS * time:.3g}",
            "time_alone [us]": f"{MICROSECONDS * float(alone):.3g}" if alone else "",
        }
        if with_ratios:
            base = times.get(TABLE[row["loss"]])
            entry["times_spheres [1]"] = f"{time / base:.2g}" if base else ""
        table.append(entry)
    return table
