"""Beyond the paper: a rubber sphere that bounces off granite, six models beside 13 impacts."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from stronge1994.csv_tables import Columns, Curves
from stronge1994.curve_names import name
from stronge1994.figures.shared.drawing import house_style, lossy
from stronge1994.figures.shared.drawing.house_style import Points, Series, Settings, Style
from stronge1994.figures.shared.drawing.lossy import Model

X, E_T = "incidence [mu v2(0)]", "tangential_restitution [1]"
LIMIT, RMS = "incidence_limit [mu v2(0)]", "rms_distance [1]"
IMPACTS, STATED = "cross2014/impacts", "cross2014/stated"
ELASTIC = "continuum"
ALONE = "velocity alone", "spin alone"
# Curves that `drawn_curves` adds: e_t from one half of a measurement to the other, and the range
# that an unknown friction leaves.
HALVES, OPEN = "halves of the measurement", "friction 0.4 to 0.9"


# The model without loss is green and has no marker.
MODELS = lossy.MODELS | {
    ELASTIC: Model("elastic continuum, $e = 1$", house_style.GREEN, house_style.DASHES[1], "")
}
POINT: Style = {"color": house_style.BLACK, "markerfacecolor": "white", "linestyle": "none"}
MEASURED = POINT | {"marker": "o", "markersize": 4}
STATED_POINT = POINT | {"marker": "D", "markersize": 4}
HALF: Style = {"color": "0.75", "linewidth": 2.2, "solid_capstyle": "butt", "zorder": 1.2}
ALL = {"marker": "s", "markersize": 5, "linestyle": "none"}
STICKING = ALL | {"markerfacecolor": "white"}
# End of the axis of distances, with room for labels, and distance of a label from its mark.
WORST, APART = 0.9, 0.02


def drawn_series(name: str, series: Series) -> Series:
    """Impacts measured against the angle, over incidence; friction is drawn by `drawn_curves`."""
    known, angle = series["parameters"], np.radians(series["x"])
    if name == STATED:
        friction = np.array([known[f"friction_{ball[-4:]}"] for ball in series["columns"]["ball"]])
        x, sigma = np.tan(angle) / friction, np.zeros_like(angle)
    else:
        own = series["columns"]
        x, sigma = (
            own[f"{column} [1]"] / known["friction"]
            for column in ("tangential_before", "tangential_before_uncertainty")
        )
    return series | {"x": x, "sigma": (sigma, series["sigma"][1]), "axes": (X, E_T), "angle": angle}


def drawn_curves(curves: Curves, settings: Settings, points: Points) -> Curves:
    """Ends of bars: e_t by both halves of a measurement, incidences of stated impacts."""
    tables = {}
    if IMPACTS in points:
        ends = [curves[alone] for alone in ALONE]
        tables[HALVES] = {
            column: np.stack([end[column] for end in ends], 1).ravel() for column in (X, E_T)
        }
    if STATED in points:
        tables[OPEN] = _open(points[STATED], settings)
    return curves | tables


def _open(series: Series, settings: Settings) -> Columns:
    """Where stated impacts lie, from the smallest friction to the largest."""
    ends = []
    for ball, angle in zip(series["columns"]["ball"], series["angle"], strict=True):
        key = f"friction_{ball[-4:]}"
        # Sigma of a value that lies evenly between two bounds is their distance over sqrt(12).
        half = np.sqrt(3) * settings["uncertainty"][key]
        ends += [np.tan(angle) / (settings["ball"][key] + sign * half) for sign in (1, -1)]
    return {X: np.array(ends), E_T: np.repeat(series["y"], 2)}


def draw(curves: Curves, settings: Settings, points: Points) -> Figure:
    """Draw (a) e_t against incidence, (b) how far each model is off."""
    figure = house_style.new(6.6)
    top, below = figure.subplots(2, 1, height_ratios=[5, 2.4])
    e = settings["restitution"]
    top.axhline(0, **house_style.GUIDE)
    for key, model in MODELS.items():
        curve = curves[f"{key}, {name('e', 1.0 if key == ELASTIC else e)}"]
        top.plot(curve[X], curve[E_T], **model.line)
    left, right = settings["incidence"]
    top.set(xlim=(0, right), xlabel=house_style.INCIDENCE, ylabel="tangential restitution $e_t$")
    top.set_title(rf"(a) lines: models at $e = {e:g}$")
    measured = _draw_points(top, curves, points)
    _draw_distances(below, curves, settings["sticking"])
    lines = [house_style.key(model.label, **model.line) for model in MODELS.values()]
    house_style.legend_below(figure, lines, measured)
    return figure


def _draw_points(axes: Axes, curves: Curves, points: Points) -> house_style.Entries:
    """Draw what was measured and stated, and return entries of the legend."""
    entries = []
    bars = {"elinewidth": 0.8, "markeredgewidth": 0.9, "zorder": 3}
    if IMPACTS in points:
        series, ends = points[IMPACTS], curves[HALVES]
        for row in range(0, len(ends[X]), 2):
            pair = slice(row, row + 2)
            axes.plot(ends[X][pair], ends[E_T][pair], **HALF)
        x_error, y_error = series["sigma"]
        style = bars | MEASURED
        axes.errorbar(series["x"], series["y"], yerr=y_error, xerr=x_error, **style)
        entries.append(house_style.key("measured (Cross 2014)", **MEASURED))
        entries.append(house_style.key("velocity alone (top), spin alone", **HALF))
    if STATED in points:
        series, ends = points[STATED], curves[OPEN]
        for row in range(0, len(ends[X]), 2):
            pair = slice(row, row + 2)
            axes.plot(ends[X][pair], ends[E_T][pair], color=house_style.BLACK, linewidth=0.8)
        axes.errorbar(series["x"], series["y"], yerr=series["sigma"][1], **bars | STATED_POINT)
        entries.append(house_style.key("stated, 2010 and 2002", **STATED_POINT))
    return entries


def _draw_distances(axes: Axes, curves: Curves, sticking: float) -> None:
    """Draw how far each model is off, over all impacts and over those of low incidence."""
    for row, (key, model) in enumerate(MODELS.items()):
        near, whole = curves[f"{key}, rms"][RMS]
        axes.plot([whole], [row], color=model.colour, **ALL)
        axes.plot([near], [row], color=model.colour, **STICKING)
        place = {"va": "center", "fontsize": house_style.NOTE}
        axes.text(max(near, whole) + APART, row, model.label, **place)
    axes.set(
        yticks=[], ylim=(len(MODELS) - 0.5, -0.5), xlim=(0, WORST), xlabel="rms distance of $e_t$"
    )
    axes.set_title(f"(b) full: all impacts; open: incidence below {sticking:g}")
