"""Draw one figure or its slide from its curves.

Nothing here solves: pictures are made from tables alone.
"""

import importlib
from collections.abc import Mapping
from typing import Any

from matplotlib.figure import Figure

from stronge1994 import tables
from stronge1994.figures.shared.drawing import house_style, slide
from stronge1994.figures.shared.drawing.house_style import Awaited, Points, Scatter
from stronge1994.names import home
from stronge1994.reference_data import Fact, Series


def draw(
    figure: str,
    stated: Mapping[str, Any],
    curves_path: str,
    pictures: Mapping[str, str],
    source: str = "",
) -> None:
    """Draw `figure` as `svg` and `png`, and, if it has a slide, that as `light` and `dark`.

    `stated` has its settings, the reference series, facts, and its slide.
    `source` says in the pictures' metadata what made them.
    """
    module = importlib.import_module(f"stronge1994.{home(figure)}.{figure}.drawing")
    curves, points = tables.read(curves_path), references(stated["overlays"])

    def drawn() -> Figure:
        return module.draw(curves, stated["settings"], points)

    house_style.save(drawn(), pictures["svg"], pictures["png"], source)
    if stated["slide"]:
        grounds = {name: pictures[name] for name in ("light", "dark")}
        slide.save(drawn(), **stated["slide"], **grounds, source=source)


def references(overlays: Mapping[str, Series | Fact]) -> Points:
    """Series and facts as a drawing gets them."""
    return {
        name: _points(known) if isinstance(known, Series) else known
        for name, known in overlays.items()
    }


def _points(series: Series) -> Scatter | Awaited:
    if series.kind == "awaited":
        return Awaited(series.legend)
    points, x, y = series.points(), series.x, series.ordinates[0]
    return Scatter(
        series.is_published,
        points[x.name].to_numpy(),
        points[y.name].to_numpy(),
        (x.sigmas(points), y.sigmas(points)),
        (x.name, y.name),
        points,
        series.parameters,
        series.legend,
    )
