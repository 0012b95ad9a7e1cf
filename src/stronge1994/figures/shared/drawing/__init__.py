"""Draw one figure or its slide from its curves.

Nothing here solves: pictures are made from tables alone.
"""

import importlib
from collections.abc import Mapping
from typing import Any

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from stronge1994 import csv_tables, reference_data
from stronge1994.figures.shared.drawing import house_style, slide
from stronge1994.figures.shared.drawing.house_style import Points, Series


def draw(
    figure: str,
    stated: Mapping[str, Any],
    curves_path: str,
    pictures: Mapping[str, str],
    source: str = "",
) -> None:
    """Draw `figure` as `svg` and `png`, and, if it has a slide, that as `light` and `dark`.

    `stated` has its settings, the reference series that are not awaited, facts, and its slide.
    `source` says in the pictures' metadata what made them.
    """
    module = importlib.import_module(f"stronge1994.figures.{figure}.drawing")
    curves, points = csv_tables.read(curves_path), series(stated["overlays"])

    def drawn() -> Figure:
        return with_all(module.draw(curves, stated["settings"], points), points)

    house_style.save(drawn(), pictures["svg"], pictures["png"], source)
    if stated["slide"]:
        grounds = {name: pictures[name] for name in ("light", "dark")}
        slide.save(drawn(), **stated["slide"], **grounds, source=source)


def with_all(figure: Figure, points: Points) -> Figure:
    """A figure with those series that its drawing has left out, each where a panel has its axes.

    So nothing is compared in silence. A series of other axes, such as one against an angle that is
    compared with a table of the same impacts, has no place in the figure: the report shows it.
    """
    panels: dict[Any, Axes] = {}  # by what `house_style` has drawn there: series, pairs of columns
    for axes in figure.axes:
        for line in axes.lines:
            panels[line.get_gid()] = axes
            line.set_gid(None)  # in a file it would be an id, and some series have several lines
    for name, one in points.items():
        published = one.get("kind") not in (None, "computed")  # a stated fact has no kind
        panel = panels.get(f"{one.get('axes')}")
        if published and panel and name not in panels:
            style = {"marker": "o", "markerfacecolor": "white", "label": name}
            house_style.measured(panel, one, **style)
            panel.legend(handles=[bars for bars in panel.containers if bars.get_label() in points])
    return figure


def series(overlays: Mapping[str, Mapping[str, Any]]) -> Points:
    """Reference series as a drawing gets them, from its overlays."""
    return {
        name: _points(name, entry) if "kind" in entry else dict(entry)
        for name, entry in overlays.items()
    }


def _points(name: str, entry: Mapping[str, Any]) -> Series:
    columns = reference_data.arrays(entry)
    printed = [reference_data.sigma_column(entry[axis]) for axis in "xy"]
    return {
        "name": name,
        "kind": entry["kind"],
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
