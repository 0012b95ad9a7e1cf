"""Beyond the paper: a rubber sphere that bounces off granite, six models beside 13 impacts."""

import numpy as np
from matplotlib.figure import Figure

from stronge1994.csv_tables import Curves
from stronge1994.curve_names import ELASTIC, name
from stronge1994.figures.shared.drawing import beside, house_style
from stronge1994.figures.shared.drawing.beside import POINT
from stronge1994.figures.shared.drawing.house_style import Points, Series, Settings

X, E_T = "incidence [mu v2(0)]", "tangential_restitution [1]"
IMPACTS, STATED = "cross2014/impacts", "cross2014/stated"
ALONE = "velocity alone", "spin alone"


def draw(curves: Curves, settings: Settings, points: Points) -> Figure:
    """Draw e_t against incidence: lines of six models, what was measured, and what was stated."""
    figure = house_style.new(5.0)
    axes = figure.subplots()
    axes.axhline(0, **house_style.GUIDE)
    models = beside.lines(axes, curves, name("e", settings["restitution"]), X, E_T)
    models += beside.lines(axes, curves, name("e", 1.0), X, E_T, [ELASTIC])
    velocity, spin = (curves[half] for half in ALONE)
    bar = {"color": "0.75", "linewidth": 2.2, "label": "velocity alone (top), spin alone"}
    halves = axes.vlines(velocity[X], spin[E_T], velocity[E_T], zorder=1.2, **bar)
    impacts, stated = _impacts(points[IMPACTS], settings), _stated(points[STATED], settings)
    circles = house_style.measured(axes, impacts, label="measured (Cross 2014)", **POINT)
    diamond = POINT | {"marker": "D", "label": "stated, 2010 and 2002"}
    diamonds = house_style.measured(axes, stated, **diamond)
    axes.set_xlim(0, settings["incidence"][1])
    axes.set_title(rf"$e_t$; lines: models at $e = {settings['restitution']:g}$")
    house_style.legend_below(figure, models, [circles, halves, diamonds])
    return figure


def _impacts(series: Series, settings: Settings) -> Series:
    """Measured impacts over incidence; friction, which moves all of them, has no error bar."""
    own, friction = series["columns"], settings["ball"]["friction"]
    x, sigma = (
        own[f"{column} [1]"] / friction
        for column in ("tangential_before", "tangential_before_uncertainty")
    )
    return series | {"x": x, "sigma": (sigma, series["sigma"][1]), "axes": (X, E_T)}


def _stated(series: Series, settings: Settings) -> Series:
    """Stated impacts over incidence, with the error that their unknown friction makes."""
    keys = [f"friction_{ball[-4:]}" for ball in series["columns"]["ball"]]
    friction, sigma = (
        np.array([settings[known][key] for key in keys]) for known in ("ball", "uncertainty")
    )
    x = np.tan(np.radians(series["x"])) / friction
    errors = x * sigma / friction, series["sigma"][1]
    return series | {"x": x, "sigma": errors, "axes": (X, E_T)}
