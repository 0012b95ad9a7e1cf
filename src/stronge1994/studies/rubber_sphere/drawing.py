"""Beyond the paper: a rubber sphere that bounces off granite, six models and 13 impacts."""

from dataclasses import replace

import numpy as np
from matplotlib.figure import Figure

from stronge1994 import tables
from stronge1994.figures.shared.drawing import house_style, model_lines
from stronge1994.figures.shared.drawing.house_style import Points, Scatter, Settings
from stronge1994.figures.shared.drawing.model_lines import POINT
from stronge1994.names import ELASTIC, MODELS
from stronge1994.tables import Table

X, E_T = "incidence [mu v2(0)]", "tangential_restitution [1]"
IMPACTS, STATED = "cross2014/impacts", "cross2014/stated"
# Friction of each stated ball among the parameters of its source.
FRICTION = {"Cross 2010": "friction_2010", "Cross 2002": "friction_2002"}
ALONE = "velocity alone", "spin alone"


def draw(curves: Table, settings: Settings, points: Points) -> Figure:
    """Draw e_t against incidence: lines of six models, what was measured, and what was stated."""
    figure = house_style.new(5.0)
    axes = figure.subplots()
    axes.axhline(0, **house_style.GUIDE)
    lines = tables.select(curves, model=[*MODELS, ELASTIC])
    models = model_lines.draw(axes, lines, X, E_T)
    velocity, spin = (tables.select(curves, variant=half) for half in ALONE)
    bar = {"color": "0.75", "linewidth": 2.2, "label": "velocity alone (top), spin alone"}
    halves = axes.vlines(velocity[X], spin[E_T], velocity[E_T], zorder=1.2, **bar)
    impacts, stated = _impacts(points[IMPACTS], settings), _stated(points[STATED], settings)
    circles = house_style.measured(axes, impacts, label=impacts.legend, **POINT)
    diamond = POINT | {"marker": "D", "label": stated.legend}
    diamonds = house_style.measured(axes, stated, **diamond)
    axes.set_xlim(0, settings["incidence"][1])
    axes.set_ylabel("tangential restitution $e_t$")
    axes.set_title(rf"rubber sphere on granite; models at $e = {settings['restitution']:g}$")
    house_style.legend_below(figure, models, [circles, halves, diamonds])
    return figure


def _impacts(series: Scatter, settings: Settings) -> Scatter:
    """Measured impacts over incidence; friction, which moves all of them, has no error bar."""
    own, friction = series.columns, settings["ball"]["friction"]
    x, sigma = (
        own[f"{column} [1]"].to_numpy() / friction
        for column in ("tangential_before", "tangential_before_uncertainty")
    )
    return replace(series, x=x, sigma=(sigma, series.sigma[1]), axes=(X, E_T))


def _stated(series: Scatter, settings: Settings) -> Scatter:
    """Stated impacts over incidence, with the error that their unknown friction makes."""
    keys = [FRICTION[ball] for ball in series.columns["ball"]]
    friction, sigma = (
        np.array([settings[known][key] for key in keys]) for known in ("ball", "uncertainty")
    )
    x = np.tan(np.radians(series.x)) / friction
    errors = x * sigma / friction, series.sigma[1]
    return replace(series, x=x, sigma=errors, axes=(X, E_T))
