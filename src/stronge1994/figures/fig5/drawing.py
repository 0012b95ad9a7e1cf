"""Fig. 5: tangential velocity at separation against incidence, with what has been measured."""

import math
from dataclasses import replace

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from planarimpact.common.arrays import Array, ArrayLike
from stronge1994 import tables
from stronge1994.figures.shared.drawing import house_style, model_lines
from stronge1994.figures.shared.drawing.house_style import (
    OURS,
    PAPERS,
    Entries,
    Points,
    Scatter,
    Settings,
    Style,
)
from stronge1994.names import CONTINUA, PAPER
from stronge1994.tables import Table

X, Y = "incidence [mu v2(0)]", "velocity [mu v2(0)]"
POINT: Style = {"marker": "o", "markerfacecolor": "white"}
# Points that the print has, too.
IN_PAPER = {"johnson1983/rubber_sphere": POINT | {"color": house_style.BLACK}}
STEEL, ELEMENTS = "finite elements", "chung_ooi2011/rebound"
SQUARES = {ELEMENTS: POINT | {"color": house_style.VERMILLION, "marker": "s"}}
# Drawn below the curves of a sphere of steel, with which these coincide in slip throughout.
RUBBER: Style = {"color": house_style.GREEN, "linewidth": 1.2, "zorder": 1.9}
LUMPED: Style = {"label": "lumped model"}
SOFT_CONTINUUM = RUBBER | {"linestyle": house_style.DASHES[1]}
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
    """Draw (a) what the paper has, and three panels below.

    (b) has the difference from the elastic continuum, (c) rubber and finite elements, (d) an
    experiment with models of its contact.
    """
    figure = house_style.new(8.0)
    grid = figure.add_gridspec(3, 2, height_ratios=[5, 2.2, 4])
    paper = figure.add_subplot(grid[0, :])
    gap = figure.add_subplot(grid[1, :], sharex=paper)
    others, shots = grid[2, :].subgridspec(1, 2).subplots(sharex=True, sharey=True)
    # As wide as in the paper, 8 with the printed limit of slip throughout at 7.
    printed = (1 + settings["restitution"]) * settings["mass_ratio"]
    left, right = settings["incidence"][0], min(settings["incidence"][1], printed * 8 / 7)
    read, added = house_style.of_print(points, IN_PAPER)
    _draw_paper(paper, curves, settings, printed, read)
    _draw_gap(gap, curves, right, added)
    lines = _draw_others(others, curves, settings, added)
    measured = _draw_experiment(shots, curves, added)
    sphere, experiment = _sphere(curves), _experiment(curves)
    for panel, shown in ((paper, [sphere]), (others, [sphere, experiment])):
        drawn = np.concatenate([curve[Y][curve[X] <= right] for curve in shown])
        # As in the paper, -3 to 1; the last digit of a velocity makes no further unit.
        panel.set(xlim=(left, right), ylim=(np.floor(drawn.min()) - 1, np.ceil(drawn.max() - 1e-9)))
    house_style.letter([paper, gap], [PAPERS, f"{OURS}: difference from the elastic continuum"])
    e, zeta2 = (settings["experiment"][key] for key in ("restitution", "stiffness_ratio"))
    headings = f"{OURS}: rubber, elements", rf"{OURS}: $e = {e:g}$, $\zeta^2 = {zeta2:g}$"
    house_style.letter([others, shots], headings, first=2)
    house_style.above_each_other([paper, gap])
    shots.set_ylabel("")
    entries = [*lines, *measured]
    house_style.legend_below(figure, entries[: len(entries) // 2], entries[len(entries) // 2 :])
    return figure


def _sphere(curves: Table) -> Table:
    """The paper's own curve."""
    return tables.select(curves, model="lumped")


def _experiment(curves: Table) -> Table:
    """The paper's model of the measured shots."""
    return tables.select(curves, model=PAPER, variant="experiment")


def _draw_paper(
    axes: Axes, curves: Table, settings: Settings, printed: float, points: Points
) -> None:
    """Draw what the print has, with the three ranges of incidence as it names them."""
    frequency = math.sqrt(settings["mass_ratio"] / settings["stiffness_ratio"])
    values = rf"$e = {settings['restitution']:g}$,  $\omega/\Omega = {frequency:.2f}$"
    axes.set_title(values, loc="right", fontsize=house_style.NOTE)
    for model, name, at, away, style in (
        ("lumped", "lumped model", 0.53, (0, -10), house_style.LUMPED),
        ("continuum", "elastic continuum", 0.26, (-42, -26), house_style.CONTINUUM),
        ("rigid", "no tangential compliance", 0.52, (0, 7), house_style.RIGID),
    ):
        curve = tables.select(curves, model=model)
        house_style.line(axes, curve, X, Y, label="_", **style)
        house_style.name_curve(axes, curve, X, Y, name, at * printed * 8 / 7, away)
    stick, right = settings["stiffness_ratio"], printed * 8 / 7
    spans = (
        (0, stick, "initial stick,\nterminal slip"),
        (stick, printed, "slip – stick –\nreverse slip"),
        (printed, right, "continuous\nslip"),
    )
    house_style.name_spans(axes, spans)
    if series := house_style.references(axes, points, X, Y, IN_PAPER).values():
        axes.legend(
            handles=list(series), loc="lower center", fontsize=house_style.NOTE, frameon=True
        )


def _draw_gap(axes: Axes, curves: Table, right: float, points: Points) -> None:
    """Draw how far lumped models and finite elements lie from the continuum of their contact.

    For nu = 0.3, which the variant `finite elements` has, it is the continuum of Maw et al.
    """
    axes.axhline(0, **house_style.GUIDE)
    for variant, style in ((STEEL, house_style.LUMPED), ("rubber", RUBBER)):
        lumped, elastic = (
            tables.select(curves, model=model, variant=variant) for model in ("lumped", "continuum")
        )
        inside = lumped[X] <= right
        x, difference = lumped[X][inside], (lumped[Y] - elastic[Y])[inside]
        axes.plot(x, difference, **style | {"label": "_"})
        if variant == STEEL:
            top = difference.abs().idxmax()
            _bracket(axes, x[top], difference[top])
    if ELEMENTS in points:
        series = points[ELEMENTS]
        own = tables.select(curves, model="continuum", variant=STEEL)
        moved = series.y - np.interp(series.x, own[X], own[Y])
        house_style.measured(axes, replace(series, y=moved), label="_", **SQUARES[ELEMENTS])
    axes.set(xlabel=house_style.INCIDENCE, ylabel="difference")
    axes.margins(y=0.18)


def _bracket(axes: Axes, x: float, height: float) -> None:
    """Draw the largest difference as a bracket with its number, without sign."""
    style = {"arrowstyle": "|-|, widthA=0.25, widthB=0.25", "shrinkA": 0, "shrinkB": 0}
    axes.annotate("", (x, 0), (x, height), arrowprops=style | {"linewidth": 0.8})
    place = {"textcoords": "offset points", "va": "center", "fontsize": house_style.NOTE}
    axes.annotate(f"{abs(height):.2f}", (x, height), (7, 3), **place)


def _draw_others(axes: Axes, curves: Table, settings: Settings, points: Points) -> Entries:
    """Draw rubber, and finite elements beside the paper's sphere; entries of the legend."""
    black = house_style.line(axes, _sphere(curves), X, Y, **house_style.LUMPED | LUMPED)
    rubber = rf"rubber, $\zeta^2 = {settings['rubber']['stiffness_ratio']:g}$"
    lines = [
        house_style.line(axes, curve, X, Y, label=label, **style)
        for curve, label, style in (
            (tables.select(curves, model="lumped", variant="rubber"), f"lumped, {rubber}", RUBBER),
            (
                tables.select(curves, model="continuum", variant="rubber"),
                f"continuum, {rubber}",
                SOFT_CONTINUUM,
            ),
        )
    ]
    printed = house_style.as_printed(axes, curves, X, Y, "Eqs 15, 25")
    series = house_style.references(axes, points, X, Y, SQUARES).values()
    return [black, *lines, *printed, *series]


def _draw_experiment(axes: Axes, curves: Table, points: Points) -> Entries:
    """Draw an experiment and the models of its contact, and return entries of the legend."""
    axes.axhline(0, **house_style.GUIDE)
    house_style.line(axes, _experiment(curves), X, Y, **house_style.LUMPED | LUMPED)
    continua = tables.select(curves, model=CONTINUA, variant="experiment")
    models = model_lines.draw(axes, continua, X, Y)
    shots = {KHARAZ: _converted(points[KHARAZ])} if KHARAZ in points else {}
    return [*house_style.references(axes, shots, X, Y, SHOTS).values(), *models]
