"""Error against time as tables: all models in order, and the cheapest for each tolerance."""

import re
from collections.abc import Mapping, Sequence
from operator import itemgetter
from typing import Any

from stronge1994 import csv_tables
from stronge1994.csv_tables import Row

ERROR, RESTITUTION, LOSS = "max_velocity [mu v2(0)]", "restitution [1]", "loss"
SPREAD = "input_spread [mu v2(0)]", "input_spread_stick [mu v2(0)]"
REFERENCE_ERROR, BUILD_TIME = "reference_error [mu v2(0)]", "build_time [s]"
BUSY_BUILD = "busy_build [1]"
TIME = re.compile(r"time_(\d+) \[s\]")
BUSY = "not known: the machine was busy"

# In mu v2(0): from a very rough answer to one finer than any measurement.
TOLERANCES = (0.3, 0.1, 0.03, 0.01, 1e-3, 1e-4, 1e-5)


def ordered(rows: Sequence[Row]) -> list[Row]:
    """Rows by restitution, elastic ones first, by loss, and by error, the largest first."""
    return sorted(rows, key=lambda row: (-float(row[RESTITUTION]), row[LOSS], -float(row[ERROR])))


def which_model(rows: Sequence[Row], tolerances: Sequence[float] = TOLERANCES) -> list[Row]:
    """The cheapest model that meets each tolerance, for each restitution, loss and size of batch.

    A model meets a tolerance if its largest error of velocity does, with the error of the reference
    added; if no model does, it is "none". Any time of compilation is spread over the batch; a time
    that was taken on a busy machine is left out. The model is `BUSY` where nobody can know: the CPU
    time of some model alone is below the time of all others, but its own time is not.

    >>> row = {"restitution [1]": "1", "max_velocity [mu v2(0)]": "0.2", "build_time [s]": ""}
    >>> row |= {"reference_error [mu v2(0)]": "1e-7", "time_10 [s]": "3e-5", "loss": ""}
    >>> row |= {"model": "lumped"} | dict.fromkeys(SPREAD, "0.4")
    >>> table = which_model([row | {"curve": "lumped, e = 1"}], [0.3, 0.1])
    >>> [entry["model_10"] for entry in table]
    ['lumped', 'none']
    """
    batches = [int(match[1]) for match in map(TIME.fullmatch, rows[0]) if match]
    cases = {(row[RESTITUTION], row[LOSS]): None for row in ordered(rows)}
    table = []
    for restitution, loss in cases:
        same = [row for row in rows if (row[RESTITUTION], row[LOSS]) == (restitution, loss)]
        for tolerance in tolerances:
            good = [row for row in same if _known_error(row) <= tolerance]
            entry = {RESTITUTION: restitution, LOSS: loss, "tolerance [mu v2(0)]": f"{tolerance:g}"}
            entry |= {"other_loss [mu v2(0)]": _other_loss(same)}
            entry |= {key: f"{float(same[0][key]):.2g}" for key in SPREAD}
            for batch in batches:
                entry |= _cheapest(good, batch)
            table.append(entry)
    return table


def _other_loss(rows: Sequence[Row]) -> str:
    """Largest error of the continuum with the other loss, "" for an elastic contact."""
    for row in rows:
        loss = row[LOSS]
        if loss and row["model"].startswith("continuum.") and row["model"] != f"continuum.{loss}":
            return f"{float(row[ERROR]):.2g}"
    return ""


def whole_time(row: Mapping[str, Any], batch: int) -> float | None:
    """Seconds for one of a batch of impacts, with its share of compilation; None if not measured.

    >>> whole_time({"time_10 [s]": "0.5", "build_time [s]": "20"}, 10)
    2.5
    """
    time = row[f"time_{batch} [s]"]
    return float(time) + float(row[BUILD_TIME] or 0) / batch if time else None


def _least_time(row: Row, batch: int) -> float:
    """As `whole_time`, without the time that a busy machine may have added."""
    times = {f"time_{batch} [s]": f"busy_{batch} [1]", BUILD_TIME: BUSY_BUILD}
    time, build_time = (
        float(row[key] or 0) / float(row.get(busy) or 1) for key, busy in times.items()
    )
    return time + build_time / batch


def _known_error(row: Row) -> float:
    return float(row[ERROR]) + float(row[REFERENCE_ERROR])


def _cheapest(rows: Sequence[Row], batch: int) -> Row:
    """Cells for one batch."""
    keys = f"model_{batch}", f"max_velocity_{batch} [mu v2(0)]", f"whole_time_{batch} [s]"
    times = [(_least_time(row, batch), whole_time(row, batch), row) for row in rows]
    timed = sorted(((least, time, row) for least, time, row in times if time), key=itemgetter(0))
    if not timed:
        return dict(zip(keys, ("none", "", ""), strict=True))
    (least, time, best), *others = timed
    quiet = f"{time:.2g}" == f"{least:.2g}"
    if not quiet and others and others[0][0] < time:
        return dict(zip(keys, (BUSY, "", ""), strict=True))
    name = best["curve"].rsplit(", e = ", 1)[0]
    cells = name, f"{float(best[ERROR]):.3g}", f"{time:.2g}" if quiet else ""
    return dict(zip(keys, cells, strict=True))


def write(curves: str, table: str, cheapest: str) -> None:
    """Read the `curves` of the figure and write both tables; after a crash both hold its error."""
    rows = csv_tables.read_rows(curves)
    if "error" in rows[0]:
        for path in (table, cheapest):
            csv_tables.write_rows(path, ["error"], [[rows[0]["error"]]])
        return
    every = [{"name": row.pop("curve"), **row} for row in ordered([dict(row) for row in rows])]
    for path, rows_of_table in ((table, every), (cheapest, which_model(rows))):
        csv_tables.write_rows(
            path, list(rows_of_table[0]), [list(row.values()) for row in rows_of_table]
        )
