"""Solve the curves of one figure."""

import importlib
from collections.abc import Mapping
from typing import Any, TypeAlias

from stronge1994 import csv_tables

# CSV of a reference table: its x column; None stands for the whole table.
Tables: TypeAlias = Mapping[str, str | None]


def solve(figure: str, settings: dict[str, Any], nodes: Tables, output: str) -> None:
    """Write the curves of `figure`; it is an error if one is not finite.

    `nodes` names reference tables. Curves must pass through the points of their x columns; a whole
    table becomes the setting `points` instead.
    """
    module = importlib.import_module(f"stronge1994.figures.{figure}.curves")
    named = module.curves(**settings | read_nodes(nodes))
    csv_tables.refuse_not_finite(named)
    csv_tables.write(output, named)


def read_nodes(nodes: Tables) -> dict[str, Any]:
    """Settings that hold the points of reference tables, `nodes` as for `solve`."""
    points: dict[str, set[float]] = {}
    for path, column in nodes.items():
        rows = csv_tables.read_rows(path)
        if column is None:
            columns = {name: csv_tables.values([row[name] for row in rows]) for name in rows[0]}
            table = {name.split(" [")[0]: column.tolist() for name, column in columns.items()}
            return {"points": table}
        points.setdefault(column.split(" [")[0], set()).update(float(row[column]) for row in rows)
    return {"nodes": {axis: sorted(places) for axis, places in points.items()}} if points else {}
