"""Write the digits of the lumped model by decades of each parameter."""

from typing import Any

import numpy as np

from stronge1994 import csv_tables
from stronge1994.csv_tables import Columns

GROUPS = ("incidence [mu v2(0)]", "mass_ratio [1]", "stiffness_ratio [1]", "restitution [1]")
QUANTITIES = (*GROUPS, "omega [Omega]", "phases [1]")
OUTPUTS = ("velocity", "peak_friction", "dissipation")
COLUMNS = (
    "quantity",
    "from [unit of quantity]",
    "to [unit of quantity]",
    "impacts [1]",
    "digits_median [1]",
    "digits_allowed_median [1]",
    "digits_least [1]",
    "digits_allowed_least [1]",
    "digits_lost_most [1]",
)
# Values more than this many decades away from 1 share one row.
LARGEST_DECADE = 16


def by_decade(impacts: Columns) -> list[list[Any]]:
    """Digits of the worst output of the impacts in each decade of each quantity, and at 0."""
    digits, allowed = (
        np.min([impacts[f"{kind}_{name} [1]"] for name in OUTPUTS], axis=0)
        for kind in ("digits", "digits_allowed")
    )
    rows = []
    for quantity in QUANTITIES:
        values = impacts[quantity]
        with np.errstate(divide="ignore"):
            decades = np.floor(np.log10(values))
        decades[values > 0] = np.clip(decades[values > 0], -LARGEST_DECADE - 1, LARGEST_DECADE)
        for decade in np.unique(decades):
            here = decades == decade
            cells = [
                f"{part(column[here]):.1f}"
                for part in (np.median, np.min)
                for column in (digits, allowed)
            ]
            lost = f"{np.max(impacts['digits_lost [1]'][here]):.1f}"
            rows.append([quantity, *_span(decade), int(here.sum()), *cells, lost])
    return rows


def _span(decade: float) -> tuple[str, str]:
    """Ends of a decade as texts."""
    if decade == -np.inf:
        return "0", "0"
    low = "0" if decade < -LARGEST_DECADE else f"1e{decade:.0f}"
    return low, "inf" if decade >= LARGEST_DECADE else f"1e{decade + 1:.0f}"


def write(curves: str, table: str) -> None:
    """Read the `curves` of the figure and write the table."""
    csv_tables.write_rows(table, COLUMNS, by_decade(csv_tables.read(curves)["impacts"]))
