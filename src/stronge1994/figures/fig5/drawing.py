"""Fig. 5: tangential velocity at separation against incidence, with what has been measured."""

import math
from dataclasses import replace

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from planarimpact.common.arrays import Array, ArrayLike
from planarimpact.common.results import Regime
from stronge1994 import tables
from stronge1994.figures.shared.drawing import house_style, model_lines
from stronge1994.figures.shared.drawing.house_style import (
    Entries,
    Points,
    Scatter,
    Settings,
    Style,
)
from stronge1994.names import CONTINUA, PAPER
from stronge1994.tables import Table

X, Y = "incidence [mu v2(0)]", "velocity [mu v2(0)]"
# Drawn below the paper's curves, with which these coincide where the contact slips throughout.
RUBBER: Style = {"color": house_style.GREEN, "linewidth": 1.0, "zorder": 1.9}
SOFT_CONTINUUM = RUBBER | {"linestyle": house_style.DASHES[1]}
POINT: Style = {"marker": "o", "markerfacecolor": "white"}
IN_PAPER = {"johnson1983/rubber_sphere": POINT | {"color": house_style.BLACK}}
ADDED = {"chung_ooi2011/rebound": POINT | {"color": house_style.VERMILLION, "marker": "s"}}
KHARAZ = "kharaz2001/tangential_restitution"
SHOTS: dict[str, Style] = {KHARAZ: {"color": house_style.BLUE, "marker": "o", "markersize": 3}}


def _converted(series: Scatter) -> Scatter:
    """Measurements against the angle, converted to the axes of the figure with their errors."""
    groups = [series.parameters[key] for key in ("mass_ratio", "friction")]
    angle, ratio = series.x, series.y
    angle_error, ratio_error = series.sigma
    x, y = contact_velocities(angle, ratio, *groups)
    by_angle = np.subtract(contact_velocities(angle + angle_error, ratio, *groups), (x, y))
    by_ratio = np.subtract(contact_velocities(angle, ratio + ratio_error, *groups), (x, y))
    sigma_x, sigma_y = np.hypot(by_angle, by_ratio)
    return replace(series, x=x, y=y, sigma=(sigma_x, sigma_y), axes=(X, Y))


def contact_velocities(
    angle: ArrayLike, centre_restitution: ArrayLike, mass_ratio: float, friction: float
) -> tuple[Array, Array]:
    """Measured points of a sphere without spin in the axes of the figure, incidence and velocity.

    `angle` is that of incidence, in degrees; `centre_restitution` is the tangential velocity of the
    centre, after over before.

    >>> x, w = contact_velocities(45.0, 1.0, 3.5, 0.5)
    >>> round(float(x), 9), round(float(w), 9)
    (2.0, 2.0)
    """
    x = np.tan(np.radians(angle)) / friction
    return x, x * (mass_ratio * np.asarray(centre_restitution) - (mass_ratio - 1))


def draw(curves: Table, settings: Settings, points: Points) -> Figure:
    """Draw (a) the paper's curves and series, and additions; (b) an experiment with its models."""
    figure = house_style.new(7.0)
    axes, shots = figure.subplots(2, 1, sharex=True, height_ratios=[5, 3.4])
    printed = (1 + settings["restitution"]) * settings["mass_ratio"]
    # As wide as in the paper, 8 with the printed limit at 7.
    left, right = settings["incidence"][0], min(settings["incidence"][1], printed * 8 / 7)
    paper, added = _draw_paper(axes, curves, points, settings, printed)
    measured = _draw_experiment(shots, curves, points, settings["experiment"])
    sphere, experiment = _sphere(curves), _experiment(curves)
    for panel, curve in ((axes, sphere), (shots, experiment)):
        drawn = curve[Y][curve[X] <= right]
        panel.set(xlim=(left, right), ylim=(drawn.min() - 1, drawn.iloc[-1] + 1))
    house_style.name_spans(axes, _regimes(sphere, right))
    house_style.letter([axes, shots])
    columns = [[*paper, "(b) added here", *measured[:2]], [*added, "", *measured[2:]]]
    house_style.legend_below(figure, *columns, titles=("(a) in the paper", "(a) added here"))
    return figure


def _sphere(curves: Table) -> Table:
    """The paper's own curve."""
    return tables.select(curves, model="lumped")


def _experiment(curves: Table) -> Table:
    """The paper's model of the measured shots."""
    return tables.select(curves, model=PAPER, variant="experiment")


def _draw_paper(
    axes: Axes, curves: Table, points: Points, settings: Settings, printed: float
) -> tuple[Entries, Entries]:
    """Draw what the paper's figure holds, and what we add; entries of the legend for both."""
    frequency = math.sqrt(settings["mass_ratio"] / settings["stiffness_ratio"])
    axes.set_title(rf"$e = {settings['restitution']:g}$,  $\omega/\Omega = {frequency:.2f}$")
    rubber = rf"rubber, $\zeta^2 = {settings['rubber']['stiffness_ratio']:g}$"
    lumped = rf"lumped model, $\zeta^2 = {settings['stiffness_ratio']:g}$"
    lines = [
        house_style.line(
            axes,
            tables.select(curves, model=model, variant=variant),
            X,
            Y,
            label=label,
            **style,
        )
        for model, variant, label, style in (
            ("lumped", "", lumped, house_style.LUMPED),
            ("continuum", "", "elastic continuum, computed here", house_style.CONTINUUM),
            ("rigid", "", "no tangential compliance", house_style.RIGID),
            ("lumped", "rubber", f"lumped model, {rubber}", RUBBER),
            ("continuum", "rubber", f"continuum, {rubber}", SOFT_CONTINUUM),
        )
    ]
    # The paper's limit of slip throughout, (1 + e) m2/m1, against its Eqs 17 to 20.
    limit = axes.axvline(printed, label="slip throughout as printed", **house_style.PRINTED)
    added = [*lines[3:], *house_style.as_printed(axes, curves, X, Y, "Eqs 15, 25")]
    series = house_style.references(axes, points, X, Y, IN_PAPER | ADDED)
    paper = [*lines[:3], limit, *(series.pop(name) for name in IN_PAPER if name in series)]
    return paper, [*added, *series.values()]


def _draw_experiment(axes: Axes, curves: Table, points: Points, experiment: Settings) -> Entries:
    """Draw an experiment and the models of its contact, and return entries of the legend."""
    axes.axhline(0, **house_style.GUIDE)
    e, zeta2 = experiment["restitution"], experiment["stiffness_ratio"]
    axes.set_title(rf"$e = {e:g}$,  $\zeta^2 = {zeta2:g}$")
    label = {"label": f"lumped model, $e = {e:g}$"}
    lumped = house_style.line(axes, _experiment(curves), X, Y, **house_style.LUMPED | label)
    continua = tables.select(curves, model=CONTINUA, variant="experiment")
    models = model_lines.draw(axes, continua, X, Y)
    shots = {KHARAZ: _converted(points[KHARAZ])} if KHARAZ in points else {}
    return [*house_style.references(axes, shots, X, Y, SHOTS).values(), lumped, *models]


def _regimes(curve: Table, right: float) -> list[tuple[float, float, str]]:
    """Regimes of the solver over the incidence; none for one point, such as normal impact."""
    x, regime = (curve[column][curve[X] <= right].to_numpy() for column in (X, "regime"))
    starts = [0, *(np.flatnonzero(regime[1:] != regime[:-1]) + 1)]
    spans = zip(x[starts], [*x[starts[1:]], right], regime[starts], strict=True)
    return [
        (low, high, Regime[name].words) for low, high, name in spans if high - low > 0.02 * right
    ]
