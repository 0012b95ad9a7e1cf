"""The fastest model for each tolerance, by restitution, loss and how many impacts are together."""

import re
from collections.abc import Mapping, Sequence
from typing import Any

import pandas as pd

from stronge1994 import tables
from stronge1994.tables import Table

ERROR, BUILD = "max_velocity_with_kinks [mu v2(0)]", "build_time [s]"
SPREAD, SPREAD_STICK = "input_spread [mu v2(0)]", "input_spread_stick [mu v2(0)]"
TIME = re.compile(r"time_(\d+) \[s\]")
# Columns that tell the settings of a model.
SETTINGS = ("steps", "tolerance", "knots")
# Nine of ten times of two runs differ by less than this share, where the rounds of one run often
# agree to a few hundredths: the memory of another run lies elsewhere.
BETWEEN_RUNS = 0.1
# The continuum of another loss than that of the reference.
OTHER_CONTINUUM = {"viscous": "continuum.plastic", "plastic": "continuum.viscous"}
# In mu v2(0): from a very rough answer to one finer than any measurement.
TOLERANCES = (0.3, 0.1, 0.03, 0.01, 1e-3, 1e-4, 1e-5)


def answers(table: Table, tolerances: Sequence[float] = TOLERANCES) -> Table:
    """The fastest model that meets each tolerance: a row for each size of batch.

    `table` is that of the figure `trade`. A model meets a tolerance if its largest error of
    velocity does, with the error of the reference added; if no model does, it is "none".
    `build_time` is spread over the batch. Models whose times differ from the shortest by less than
    times scatter, `scatter_...` or `BETWEEN_RUNS`, are as fast: of them the nearest is taken.

    >>> columns = {ERROR: [0.2], "reference_error [mu v2(0)]": [1e-7]}
    >>> columns |= {"time_10 [s]": [3e-5], "scatter_10 [1]": [0.0]} | {SPREAD: [0.4]}
    >>> own = tables.curve(columns, "lumped", e=1.0, loss="")
    >>> answers(own, [0.3, 0.1])["model"].tolist()
    ['lumped', 'none']
    """
    batches = [int(match[1]) for match in map(TIME.fullmatch, table) if match]
    names = [_name(row) for row in table.to_dict("records")]
    known_error = table[ERROR] + table["reference_error [mu v2(0)]"]
    named = table.assign(name=names, known_error=known_error)
    contacts = named.sort_values(["e", "loss"], ascending=[False, True], kind="stable")
    return pd.DataFrame(
        {"e": e, "loss": loss, "tolerance [mu v2(0)]": tolerance, "batch": batch}
        | _cheapest(same[same["known_error"] <= tolerance], batch)
        for (e, loss), same in contacts.groupby(["e", "loss"], sort=False)
        for tolerance in tolerances
        for batch in batches
    )


def _name(row: Mapping[str, Any]) -> str:
    """A model with its settings."""
    settings = {key: row[key] for key in SETTINGS if pd.notna(row.get(key))}
    return tables.curve_name({"model": row["model"]} | settings)


def _cheapest(rows: Table, batch: int) -> dict[str, str]:
    """Model, error and time for one batch."""
    keys = "model", ERROR, "whole_time [s]"
    timed = rows.dropna(subset=[f"time_{batch} [s]"])
    if timed.empty:
        return dict(zip(keys, ("none", "", ""), strict=True))
    # Seconds for one of a batch of impacts, with its share of `build_time`; and how far it is off.
    alone, build = timed[f"time_{batch} [s]"], timed[BUILD].fillna(0.0) if BUILD in timed else 0.0
    time = alone + build / batch
    off = (timed[f"scatter_{batch} [1]"] * alone).clip(lower=BETWEEN_RUNS * time)
    fastest = time.idxmin()
    as_fast = time - time[fastest] <= off.clip(lower=off[fastest])
    nearest = timed[as_fast].assign(time=time).sort_values([ERROR, "time"]).iloc[0]
    values = nearest["name"], f"{nearest[ERROR]:.3g}", f"{nearest['time']:.2g}"
    return dict(zip(keys, values, strict=True))


def cases(found: Table, table: Table) -> list[dict[str, Any]]:
    """What the report shows of `answers` about a `table`, by restitution and loss.

    `spread` and `spread_stick` are those of the answer under uncertain inputs, `other_loss` is the
    error of the continuum of the other loss. Of `rows` each has the answers for all batches, and
    the largest and the least of the tolerances that follow each other and have these answers.
    """
    shown = []
    for (e, loss), own in found.groupby(["e", "loss"], sort=False):
        same = table[tables.where(table, e=e, loss=loss)]
        wrong = same[ERROR][same["model"] == OTHER_CONTINUUM.get(loss)]
        rows: list[dict[str, Any]] = []
        for tolerance, of_batches in own.groupby("tolerance [mu v2(0)]", sort=False):
            cells = of_batches[["batch", "model", ERROR, "whole_time [s]"]].to_numpy().tolist()
            if not rows or rows[-1]["answers"] != cells:
                rows.append({"largest": tolerance, "answers": cells})
            rows[-1]["least"] = tolerance
        shown.append(
            {
                "restitution": e,
                "loss": loss,
                "other_loss": f"{wrong.iloc[0]:.2g}" if len(wrong) else "",
                "spread": f"{same[SPREAD].iloc[0]:.2g}",
                "spread_stick": f"{same[SPREAD_STICK].iloc[0]:.2g}",
                "batches": own["batch"].unique().tolist(),
                "rows": rows,
            }
        )
    return shown
