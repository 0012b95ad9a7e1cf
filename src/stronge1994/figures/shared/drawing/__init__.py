"""Draw one figure or its slide from its curves.

Nothing here solves: pictures are made from tables alone.
"""

import importlib
from collections.abc import Mapping
from typing import Any

from stronge1994 import csv_tables, reference_data
from stronge1994.figures.shared.drawing import house_style, slide
from stronge1994.figures.shared.drawing.house_style import Points, Series


def draw(
    figure: str, plan: Mapping[str, Any], curves_path: str, pictures: Mapping[str, str]
) -> None:
    """Draw `figure` as `svg` and `png`, and, if its plan has a slide, that as `light` and `dark`.

    The plan has the settings, the reference series that are not awaited, and facts.
    """
    module = importlib.import_module(f"stronge1994.figures.{figure}.drawing")
    given = csv_tables.read(curves_path), plan["settings"], series(plan["overlays"])
    house_style.save(module.draw(*given), pictures["svg"], pictures["png"])
    if plan["slide"]:
        grounds = {name: pictures[name] for name in ("light", "dark")}
        slide.save(module.draw(*given), **plan["slide"], **grounds)


def series(overlays: Mapping[str, Mapping[str, Any]]) -> Points:
    """Reference series as a drawing gets them, from the overlays of its plan."""
    return {
        name: _points(entry) if "kind" in entry else dict(entry) for name, entry in overlays.items()
    }


def _points(entry: Mapping[str, Any]) -> Series:
    columns = reference_data.arrays(entry)
    printed = [reference_data.sigma_column(entry[axis]) for axis in "xy"]
    return {
        "x": columns[reference_data.column_name(entry["x"])],
        "y": columns[reference_data.column_name(entry["y"])],
        "sigma": tuple(
            entry[axis]["sigma"] if column is None else columns[column]
            for axis, column in zip("xy", printed, strict=True)
        ),
        "axes": (reference_data.column_name(entry["x"]), reference_data.column_name(entry["y"])),
        "columns": columns,
        "parameters": entry["parameters"],
    }
