"""Solve the curves of one figure. A crash becomes a table that says so: a failed verdict."""

import importlib
import traceback

from stronge1994 import csv_tables


def solve(figure, settings, nodes, output):
    """Write the curves of `figure`.

    `nodes`, `{CSV of a reference table: its x column}`, are points that curves must pass through;
    without a column it is the whole table, `points`.
    """
    try:
        settings = settings | read_nodes(nodes)
        named = importlib.import_module(f"stronge1994.curves.{figure}").curves(**settings)
    except Exception as error:
        traceback.print_exc()
        csv_tables.write_rows(output, ["error"], [[f"{type(error).__name__}: {error}"]])
        return
    csv_tables.write(output, named)


def read_nodes(nodes):
    """Settings that hold the points of reference tables, `nodes` as for `solve`."""
    points = {}
    for path, column in nodes.items():
        rows = csv_tables.read_rows(path)
        if column is None:
            names = {name.split(" [")[0]: name for name in rows[0]}
            table = {short: [float(row[name]) for row in rows] for short, name in names.items()}
            return {"points": table}
        points.setdefault(column.split(" [")[0], set()).update(float(row[column]) for row in rows)
    return {"nodes": {axis: sorted(found) for axis, found in points.items()}} if points else {}
