"""Draw one figure or its slide from its curves.

Nothing here solves: pictures are made from tables alone.
"""

import importlib
from collections.abc import Mapping
from types import ModuleType
from typing import Any

from matplotlib.figure import Figure

from stronge1994 import csv_tables, reference_data
from stronge1994.csv_tables import Curves
from stronge1994.figures.shared.drawing import house_style, slide
from stronge1994.figures.shared.drawing.house_style import Points, Series, Settings


def draw(
    figure: str, plan: Mapping[str, Any], curves_path: str, pictures: Mapping[str, str]
) -> None:
    """Draw `figure` as `svg` and `png`, and, if its plan has a slide, that as `light` and `dark`.

    The plan has the settings, the reference series that are not awaited, and facts.
    """
    module = importlib.import_module(f"stronge1994.figures.{figure}.drawing")
    given = csv_tables.read(curves_path), plan["settings"], series(plan["overlays"])
    house_style.save(drawn(module, *given), pictures["svg"], pictures["png"])
    if plan["slide"]:
        grounds = {name: pictures[name] for name in ("light", "dark")}
        slide.save(drawn(module, *given), **plan["slide"], **grounds)


def drawn(module: ModuleType, curves: Curves, settings: Settings, points: Points) -> Figure:
    """The picture that a module draws.

    A module may have `drawn_curves`, which adds to the curves what it draws beside their columns,
    and `drawn_series`, which converts reference series.
    """
    if hasattr(module, "drawn_series"):
        points = {name: module.drawn_series(name, one) for name, one in points.items()}
    if hasattr(module, "drawn_curves"):
        curves = module.drawn_curves(curves, settings, points)
    picture: Figure = module.draw(curves, settings, points)
    return picture


def series(overlays: Mapping[str, Mapping[str, Any]]) -> Points:
    """Reference series as a drawing gets them, from the overlays of its plan."""
    return {
        name: _points(name, entry) if "kind" in entry else dict(entry)
        for name, entry in overlays.items()
    }


def _points(name: str, entry: Mapping[str, Any]) -> Series:
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
