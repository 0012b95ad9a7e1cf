"""Error against time as tables: all models in order, and the cheapest for each tolerance."""

import re
from collections.abc import Mapping, Sequence
from typing import Any

from stronge1994 import csv_tables
from stronge1994.csv_tables import Row

ERROR, RESTITUTION, LOSS = "max_velocity [mu v2(0)]", "restitution [1]", "loss"
SPREAD = "input_spread [mu v2(0)]", "input_spread_stick [mu v2(0)]"
TIME = re.compile(r"time_(\d+) \[s\]")
# Nine of ten times of two runs differ by less than this share, where the rounds of one run often
# agree to a few hundredths: the memory of another run lies elsewhere.
BETWEEN_RUNS = 0.1

# In mu v2(0): from a very rough answer to one finer than any measurement.
TOLERANCES = (0.3, 0.1, 0.03, 0.01, 1e-3, 1e-4, 1e-5)


def ordered(rows: Sequence[Row]) -> list[Row]:
    """Rows by restitution, elastic ones first, by loss, and by error, the largest first."""
    return sorted(rows, key=lambda row: (-float(row[RESTITUTION]), row[LOSS], -float(row[ERROR])))


def which_model(rows: Sequence[Row], tolerances: Sequence[float] = TOLERANCES) -> list[Row]:
    """The fastest model that meets each tolerance, for each restitution, loss and size of batch.

    A model meets a tolerance if its largest error of velocity does, with the error of the reference
    added; if no model does, it is "none". `build_time` is spread over the batch. Models whose times
    differ from the shortest by less than times scatter, `scatter_...` or `BETWEEN_RUNS`, are as
    fast: of them the nearest is taken.

    >>> row = {"restitution [1]": "1", "max_velocity [mu v2(0)]": "0.2", "build_time [s]": ""}
    >>> row |= {"reference_error [mu v2(0)]": "1e-7", "time_10 [s]": "3e-5", "loss": ""}
    >>> row |= {"model": "lumped", "scatter_10 [1]": "0"} | dict.fromkeys(SPREAD, "0.4")
    >>> table = which_model([row | {"curve": "lumped, e = 1"}], [0.3, 0.1])
    >>> [entry["model_10"] for entry in table]
    ['lumped', 'none']
    """
    batches = [int(match[1]) for match in map(TIME.fullmatch, rows[0]) if match]
    cases = {(row[RESTITUTION], row[LOSS]): None for row in ordered(rows)}
    table = []
    for restitution, loss in cases:
        same = [row for row in rows if (row[RESTITUTION], row[LOSS]) == (restitution, loss)]
        wrong = [
            f"{float(row[ERROR]):.2g}"
            for row in same
            if loss and row["model"].startswith("continuum.") and not row["model"].endswith(loss)
        ]
        for tolerance in tolerances:
            entry = {RESTITUTION: restitution, LOSS: loss, "tolerance [mu v2(0)]": f"{tolerance:g}"}
            entry |= {"other_loss [mu v2(0)]": wrong[0] if wrong else ""}
            entry |= {key: f"{float(same[0][key]):.2g}" for key in SPREAD}
            for batch in batches:
                entry |= _cheapest([row for row in same if _known_error(row) <= tolerance], batch)
            table.append(entry)
    return table


def whole_time(row: Mapping[str, Any], batch: int) -> float | None:
    """Seconds for one of a batch of impacts, with its share of `build_time`; None if not measured.

    >>> whole_time({"time_10 [s]": "0.5", "build_time [s]": "20"}, 10)
    2.5
    """
    time = row[f"time_{batch} [s]"]
    return float(time) + float(row["build_time [s]"] or 0) / batch if time else None


def _known_error(row: Row) -> float:
    return float(row[ERROR]) + float(row["reference_error [mu v2(0)]"])


def _cheapest(rows: Sequence[Row], batch: int) -> Row:
    """Cells for one batch."""
    keys = f"model_{batch}", f"max_velocity_{batch} [mu v2(0)]", f"whole_time_{batch} [s]"
    timed = [(time, row) for row in rows if (time := whole_time(row, batch))]
    if not timed:
        return dict(zip(keys, ("none", "", ""), strict=True))
    fastest, first = min(timed, key=lambda one: one[0])
    as_fast = [
        (float(row[ERROR]), time, row["curve"])
        for time, row in timed
        if time - fastest <= max(_scatter(first, batch), _scatter(row, batch))
    ]
    error, time, curve = min(as_fast)
    name = curve.rsplit(", e = ", 1)[0]
    return dict(zip(keys, (name, f"{error:.3g}", f"{time:.2g}"), strict=True))


def _scatter(row: Row, batch: int) -> float:
    """How far the time of one of a batch of impacts may be off, in seconds."""
    measured = float(row[f"scatter_{batch} [1]"]) * float(row[f"time_{batch} [s]"])
    return max(measured, BETWEEN_RUNS * (whole_time(row, batch) or 0.0))


def write(curves: str, table: str, cheapest: str) -> None:
    """Read the `curves` of the figure and write both tables."""
    rows = csv_tables.read_rows(curves)
    every = [{"name": row.pop("curve"), **row} for row in ordered([dict(row) for row in rows])]
    for path, rows_of_table in ((table, every), (cheapest, which_model(rows))):
        csv_tables.write_table(path, rows_of_table, list(rows_of_table[0]))
