"""Draw one figure from its curves, as SVG and PNG. If there are none, the picture says why.

Nothing here solves: pictures are made from tables alone.
"""

import importlib
from collections.abc import Mapping
from types import ModuleType
from typing import Any

from matplotlib.figure import Figure

from stronge1994 import csv_tables, reference_data
from stronge1994.csv_tables import Curves
from stronge1994.figures.shared.drawing import checked, house_style, tables, words
from stronge1994.figures.shared.drawing.house_style import Points, Series, Settings


def draw(
    figure: str,
    settings: Settings,
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
        failure = house_style.failure(f"{figure}: the solver failed: {error}")
        checked.save(failure, {}, figure, svg, png)
        return
    points: Points = {
        name: _points(name, entry, series_paths[name.split("/")[0]])
        if "kind" in entry
        else dict(entry)
        for name, entry in overlays.items()
    }
    module = importlib.import_module(f"stronge1994.figures.{figure}.drawing")
    checked.save(*drawn(module, curves, settings, points), figure, svg, png, words.of(module))


def drawn(
    module: ModuleType, curves: Curves, settings: Settings, points: Points
) -> tuple[Figure, Curves]:
    """The picture that a module draws, not yet checked, and the tables of its numbers.

    A module may have `drawn_curves`, which adds to the curves what it draws beside their columns,
    and `drawn_series`, which converts reference series.
    """
    if hasattr(module, "drawn_series"):
        points = {name: module.drawn_series(name, series) for name, series in points.items()}
    if hasattr(module, "drawn_curves"):
        curves = module.drawn_curves(curves, settings, points)
    return module.draw(curves, settings, points), tables.tables(curves, points)


def _points(name: str, entry: Mapping[str, Any], path: str) -> Series:
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
        "axes": (reference_data.column_name(entry["x"]), reference_data.column_name(entry["y"])),
        "columns": columns,
        "parameters": entry["parameters"],
    }
