"""Solve the curves of one figure."""

import importlib
from collections.abc import Mapping
from typing import Any, TypeAlias

import pandas as pd

from stronge1994 import tables
from stronge1994.names import home

# CSV of a reference table: its x column; None stands for the whole table.
Tables: TypeAlias = Mapping[str, str | None]


def solve(figure: str, settings: dict[str, Any], nodes: Tables, output: str) -> None:
    """Write the curves of `figure`; it is an error if one is not finite.

    `nodes` names reference tables. Curves must pass through the points of their x columns; a whole
    table becomes the setting `points` instead.
    """
    module = importlib.import_module(f"stronge1994.{home(figure)}.{figure}.curves")
    tables.write(output, module.curves(**settings | read_nodes(nodes)))


def read_nodes(nodes: Tables) -> dict[str, Any]:
    """Settings that hold the points of reference tables, `nodes` as for `solve`."""
    points: dict[str, set[float]] = {}
    for path, column in nodes.items():
        table = pd.read_csv(path, keep_default_na=False)
        if column is None:
            return {"points": {name.split(" [")[0]: table[name].tolist() for name in table}}
        points.setdefault(column.split(" [")[0], set()).update(table[column].tolist())
    return {"nodes": {axis: sorted(places) for axis, places in points.items()}} if points else {}
