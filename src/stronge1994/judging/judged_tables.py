"""Read what a run judges as named curves: tables of figures and of scenes."""

from pathlib import Path

import numpy as np

from stronge1994 import csv_tables
from stronge1994.csv_tables import Columns, Curves


def read(path: str) -> Curves:
    """Curves that are judged. A number that is not finite is an error.

    The table of a figure has its own curves. That of a scene becomes one curve `impacts`, whose
    rows are numbered. `csv_tables.Failed` says that the solver left an error instead.
    """
    if Path(path).parent.name == "scenes":
        curves = {"impacts": _impacts(path)}
    else:
        curves = csv_tables.read(path)
    csv_tables.refuse_not_finite(curves)
    return curves


def _impacts(path: str) -> Columns:
    rows = csv_tables.read_rows(path)
    columns = {name: csv_tables.values([row[name] for row in rows]) for name in rows[0]}
    return {"row [1]": np.arange(1.0, len(rows) + 1)} | columns
