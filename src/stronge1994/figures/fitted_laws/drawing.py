"""Laws of discrete-element codes before and after a fit, beside the continuum of three pairs."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from stronge1994.csv_tables import Curves
from stronge1994.figures.shared.drawing import house_style
from stronge1994.figures.shared.drawing.house_style import Points, Series, Settings, Style

X, W = "incidence [mu v2(0)]", "velocity [mu v2(0)]"
LAMMPS = "lammps/rebound"
LAWS = {
    "lammps-hertz-mindlin": ("Hertz and Mindlin", house_style.VERMILLION),
    "lammps-hooke": ("linear springs", house_style.BLUE),
}
# Patterns and widths: as a law is usually used, and fitted.
LINES: dict[str, Style] = {
    "before": {"linestyle": house_style.DASHES[3], "linewidth": 1.0},
    "after": {"linestyle": "-", "linewidth": 1.2},
}
WORDS = {"before": "usual values", "after": "fitted"}
CONTINUUM: Style = {"color": "0.75", "linestyle": "-", "linewidth": 4.0, "zorder": 1.5}
DOTS: Style = {"color": house_style.BLACK, "marker": "o", "markersize": 1.8, "linestyle": "none"}


def draw(curves: Curves, settings: Settings, points: Points) -> Figure:
    """Draw a panel for each pair."""
    figure = house_style.new(3.5)
    pairs = settings["pairs"]
    panels = figure.subplots(1, len(pairs), sharey=True, squeeze=False)[0]
    for letter, axes, (pair, about) in zip("abcdef", panels, pairs.items(), strict=False):
        _draw_pair(axes, curves, pair, points.get(LAMMPS))
        axes.set_title(f"({letter}) {pair}, {about['loss']}\n$e = {about['restitution']:g}$")
        axes.set(xlabel=house_style.INCIDENCE, xlim=(0, settings["incidence_max"]))
    panels[0].set_ylabel(house_style.REBOUND)
    before, after = (
        [
            house_style.key(f"{label}, {words}", color=colour, **LINES[when])
            for label, colour in LAWS.values()
        ]
        for when, words in WORDS.items()
    )
    others = [
        house_style.key("continuum of the pair", **CONTINUUM),
        house_style.key("LAMMPS itself", **DOTS),
    ]
    house_style.legend_below(figure, [*before, others[0]], [*after, others[1]])
    return figure


def _draw_pair(axes: Axes, curves: Curves, pair: str, measured: Series | None) -> None:
    """Draw the continuum, both laws before and after, and what LAMMPS says."""
    axes.axhline(0, **house_style.GUIDE)
    exact = curves[f"{pair}, continuum"]
    axes.plot(exact[X], exact[W], **CONTINUUM)
    for law, (_, colour) in LAWS.items():
        for when, style in LINES.items():
            name = f"{pair}, {law}, {when}"
            axes.plot(curves[name][X], curves[name][W], color=colour, **style)
            if measured is not None:
                own = np.flatnonzero(measured["columns"]["curve"] == name)
                at = measured["x"][own], measured["y"][own]
                axes.plot(*at, label="LAMMPS itself", zorder=3, **DOTS)
