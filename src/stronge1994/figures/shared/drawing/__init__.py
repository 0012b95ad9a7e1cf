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
    figure: str,
    settings: Settings,
    overlays: Mapping[str, Mapping[str, Any]],
    curves_path: str,
    pictures: tuple[str, str],
    slide_pictures: Mapping[str, str],
) -> None:
    """Draw `figure` as SVG and PNG, and its slide on each ground, `{ground: file}`, if it has one.

    `overlays` holds the reference series that are not awaited, and facts.
    """
    curves, points = csv_tables.read(curves_path), series(overlays)
    house_style.save(drawn(_module(figure, "drawing"), curves, settings, points), *pictures)
    if slide_pictures:
        grounds = slides(figure, curves, settings, points)
        for ground, png in slide_pictures.items():
            slide.save(grounds[ground], png)


def drawn(module: ModuleType, curves: Curves, settings: Settings, points: Points) -> Figure:
    """The picture that a module draws."""
    picture: Figure = module.draw(*_prepared(module, curves, settings, points))
    return picture


def slides(figure: str, curves: Curves, settings: Settings, points: Points) -> dict[str, Figure]:
    """The slide of a figure on each ground."""
    given = _prepared(_module(figure, "drawing"), curves, settings, points)
    draw = _module(figure, "slide").draw
    return {name: draw(*given, ground) for name, ground in slide.GROUNDS.items()}


def _prepared(
    module: ModuleType, curves: Curves, settings: Settings, points: Points
) -> tuple[Curves, Settings, Points]:
    """Curves and reference series as a module draws them.

    A module may have `drawn_curves`, which adds to the curves what it draws beside their columns,
    and `drawn_series`, which converts reference series.
    """
    if hasattr(module, "drawn_series"):
        points = {name: module.drawn_series(name, one) for name, one in points.items()}
    if hasattr(module, "drawn_curves"):
        curves = module.drawn_curves(curves, settings, points)
    return curves, settings, points


def _module(figure: str, name: str) -> ModuleType:
    return importlib.import_module(f"stronge1994.figures.{figure}.{name}")


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
        "line": entry.get("line", False),
        "axes": (reference_data.column_name(entry["x"]), reference_data.column_name(entry["y"])),
        "columns": columns,
        "parameters": entry["parameters"],
    }
