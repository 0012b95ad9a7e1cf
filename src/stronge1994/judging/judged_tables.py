"""Read what a run judges as named curves: tables of figures, scenes, and the parameter study."""

from pathlib import Path

import numpy as np

from stronge1994 import csv_tables
from stronge1994.csv_tables import Columns, Curves


def read(path: str) -> Curves:
    """Curves that are judged. A number that is not finite is an error.

    The table of a figure has its own curves. That of a scene becomes one curve `impacts`, whose
    rows are numbered; the study becomes one curve `grid` with a row for each point.
    `csv_tables.Failed` says that the solver left an error instead.
    """
    if Path(path).suffix == ".npz":
        curves = {"grid": _points_of_study(path)}
    elif Path(path).parent.name == "scenes":
        curves = {"impacts": _impacts(path)}
    else:
        curves = csv_tables.read(path)
    for curve, columns in curves.items():
        for column, values in columns.items():
            if values.dtype.kind == "f" and not np.isfinite(values).all():
                raise ValueError(f"curve '{curve}', column '{column}' is not finite")
    return curves


def _impacts(path: str) -> Columns:
    rows = csv_tables.read_rows(path)
    columns = {name: csv_tables.values([row[name] for row in rows]) for name in rows[0]}
    return {"row [1]": np.arange(1.0, len(rows) + 1)} | columns


def _points_of_study(path: str) -> Columns:
    with np.load(path) as file:
        arrays = {name: file[name] for name in file.files if "[" in name}
        axes = [str(name) for name in file["axes"]]
    grid = np.meshgrid(*(arrays[name] for name in axes), indexing="ij")
    columns = {
        name: values.ravel()
        for name, values in (arrays | dict(zip(axes, grid, strict=True))).items()
    }
    # Points are labelled by the axes, without their units.
    return columns | {name.split(" [")[0]: columns[name] for name in axes}
