"""Draw one figure from its curves, as SVG and PNG. If there are none, the picture says why.

Nothing here solves: pictures are made from tables alone.
"""

import importlib
from collections.abc import Mapping
from typing import Any

from stronge1994 import csv_tables, reference_data
from stronge1994.drawings import house_style


def draw(
    figure: str,
    settings: house_style.Settings,
    overlays: Mapping[str, Mapping[str, Any]],
    curves_path: str,
    series_paths: Mapping[str, str],
    svg: str,
    png: str,
) -> None:
    """Draw `figure`; `overlays` holds the reference series that are not awaited, and facts."""
    try:
        curves = csv_tables.read(curves_path)
    except csv_tables.Failed as error:
        house_style.save(house_style.failure(f"{figure}: the solver failed: {error}"), svg, png)
        return
    points = {
        name: _points(name, entry, series_paths[name.split("/")[0]]) if "kind" in entry else entry
        for name, entry in overlays.items()
    }
    module = importlib.import_module(f"stronge1994.drawings.{figure}")
    house_style.save(module.draw(curves, settings, points), svg, png)


def _points(name: str, entry: Mapping[str, Any], path: str) -> house_style.Series:
    columns = csv_tables.read(path)[name.split("/")[1]]
    printed = [reference_data.sigma_column(entry[axis]) for axis in "xy"]
    return {
        "x": columns[reference_data.column_name(entry["x"])],
        "y": columns[reference_data.column_name(entry["y"])],
        "sigma": tuple(
            entry[axis]["sigma"] if column is None else columns[column]
            for axis, column in zip("xy", printed, strict=True)
        ),
        "line": entry.get("line", False),
        "columns": columns,
        "parameters": entry["parameters"],
    }
