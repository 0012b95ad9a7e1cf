"""Error against time as tables: all models in order, and the cheapest for each tolerance."""

import re
from collections.abc import Mapping, Sequence
from typing import Any

import pandas as pd

from stronge1994 import tables
from stronge1994.tables import Table

ERROR, BUILD = "max_velocity [mu v2(0)]", "build_time [s]"
SPREAD = "input_spread [mu v2(0)]", "input_spread_stick [mu v2(0)]"
TIME = re.compile(r"time_(\d+) \[s\]")
# Columns that tell the settings of a model.
SETTINGS = ("steps", "circles", "tolerance", "knots")
# Nine of ten times of two runs differ by less than this share, where the rounds of one run often
# agree to a few hundredths: the memory of another run lies elsewhere.
BETWEEN_RUNS = 0.1

# The continuum of another loss than that of the reference.
OTHER_CONTINUUM = {"viscous": ["continuum.plastic"], "plastic": ["continuum.viscous"]}
# In mu v2(0): from a very rough answer to one finer than any measurement.
TOLERANCES = (0.3, 0.1, 0.03, 0.01, 1e-3, 1e-4, 1e-5)


def ordered(table: Table) -> Table:
    """The table by restitution, elastic ones first, by loss, and by error, the largest first."""
    return table.sort_values(["e", "loss", ERROR], ascending=[False, True, False], kind="stable")


def which_model(table: Table, tolerances: Sequence[float] = TOLERANCES) -> Table:
    """The fastest model that meets each tolerance, for each restitution, loss and size of batch.

    A model meets a tolerance if its largest error of velocity does, with the error of the reference
    added; if no model does, it is "none". `build_time` is spread over the batch. Models whose times
    differ from the shortest by less than times scatter, `scatter_...` or `BETWEEN_RUNS`, are as
    fast: of them the nearest is taken.

    >>> columns = {"max_velocity [mu v2(0)]": [0.2], "reference_error [mu v2(0)]": [1e-7]}
    >>> columns |= {"time_10 [s]": [3e-5], "scatter_10 [1]": [0.0]} | dict.fromkeys(SPREAD, [0.4])
    >>> own = tables.curve(columns, "lumped", e=1.0, loss="")
    >>> which_model(own, [0.3, 0.1])["model_10"].tolist()
    ['lumped', 'none']
    """
    batches = [int(match[1]) for match in map(TIME.fullmatch, table) if match]
    names = [_name(row) for row in table.to_dict("records")]
    known_error = table[ERROR] + table["reference_error [mu v2(0)]"]
    named = table.assign(name=names, known_error=known_error)
    rows = []
    for (e, loss), same in ordered(named).groupby(["e", "loss"], sort=False):
        wrong = same[ERROR][same["model"].isin(OTHER_CONTINUUM.get(loss, []))]
        for tolerance in tolerances:
            row = {"restitution [1]": e, "loss": loss, "tolerance [mu v2(0)]": f"{tolerance:g}"}
            row["other_loss [mu v2(0)]"] = f"{wrong.iloc[0]:.2g}" if len(wrong) else ""
            row |= {key: f"{same[key].iloc[0]:.2g}" for key in SPREAD}
            for batch in batches:
                row |= _cheapest(same[same["known_error"] <= tolerance], batch)
            rows.append(row)
    return pd.DataFrame(rows)


def _name(row: Mapping[str, Any]) -> str:
    """A model with its settings."""
    settings = {key: row[key] for key in SETTINGS if pd.notna(row.get(key))}
    return tables.curve_name({"model": row["model"]} | settings)


def _cheapest(rows: Table, batch: int) -> dict[str, str]:
    """Cells for one batch."""
    keys = f"model_{batch}", f"max_velocity_{batch} [mu v2(0)]", f"whole_time_{batch} [s]"
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


def write(curves: str, table: str, cheapest: str) -> None:
    """Read the `curves` of the figure and write both tables."""
    every = tables.read(curves)
    tables.write(table, ordered(every))
    which_model(every).to_csv(cheapest, index=False, lineterminator="\n")
