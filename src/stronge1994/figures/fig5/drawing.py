"""Fig. 5: tangential velocity at separation against incidence, with what has been measured."""

import math

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from planarimpact import Regime
from planarimpact.ground.arrays import Array, ArrayLike
from stronge1994.csv_tables import Columns, Curves
from stronge1994.figures.shared.drawing import house_style
from stronge1994.figures.shared.drawing.house_style import Entries, Points, Series, Settings, Style

X, Y = "incidence [mu v2(0)]", "velocity [mu v2(0)]"
# Drawn below the paper's curves, with which these coincide where the contact slips throughout.
RUBBER = {"color": house_style.GREEN, "linewidth": 1.0, "zorder": 1.9}
SOFT_CONTINUUM = RUBBER | {"linestyle": house_style.DASHES[1]}
RUBBER_SPHERE = "johnson1983/rubber_sphere"
RUBBER_POINTS: Style = {"color": house_style.BLACK, "marker": "o", "markerfacecolor": "white"}
# Measured with loss, and so not on the curves, which have e = 1.
LOSSY_RUBBER = "cross2014/impacts"
LOSSY_POINTS: Style = {"color": house_style.GREEN, "marker": "o", "markerfacecolor": "white"}
ELEMENT_POINTS: Style = {"color": house_style.VERMILLION, "marker": "s", "markerfacecolor": "white"}
GLASS_POINTS: Style = {"color": house_style.BLUE, "marker": "o", "markersize": 3}
# These points are measured against the angle: they must be converted to the axes of the figure.
MEASURED_ANGLES = "kharaz2001/tangential_restitution"


def drawn_series(name: str, series: Series) -> Series:
    """Measurements against the angle, converted to the axes of the figure with their errors."""
    if name == LOSSY_RUBBER:
        return series | _turned_round(series)
    if name != MEASURED_ANGLES:
        return series
    groups = [series["parameters"][key] for key in ("mass_ratio", "friction")]
    angle, ratio = series["x"], series["y"]
    angle_error, ratio_error = series["sigma"]
    x, y = contact_velocities(angle, ratio, *groups)
    by_angle = np.subtract(contact_velocities(angle + angle_error, ratio, *groups), (x, y))
    by_ratio = np.subtract(contact_velocities(angle, ratio + ratio_error, *groups), (x, y))
    columns = "incidence [mu v2(0)]", "velocity [mu v2(0)]"
    sigma = np.hypot(by_angle, by_ratio)
    return {"x": x, "y": y, "sigma": sigma, "line": False, "axes": columns}


def _turned_round(series: Series) -> Series:
    """Points of which the share of the tangential velocity is measured that is turned round."""
    share, friction = series["y"], series["parameters"]["friction"]
    x, x_error = (
        series["columns"][f"{column} [1]"] / friction
        for column in ("tangential_before", "tangential_before_uncertainty")
    )
    sigma = x_error, np.hypot(share * x_error, series["sigma"][1] * x)
    return {"x": x, "y": -share * x, "sigma": sigma, "axes": (X, Y)}


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


def draw(curves: Curves, settings: Settings, points: Points) -> Figure:
    """Draw (a) the paper's curves and series, and additions; (b) an experiment with its models."""
    figure = house_style.new(7.0)
    axes, shots = figure.subplots(2, 1, sharex=True, height_ratios=[5, 3.4])
    printed = (1 + settings["restitution"]) * settings["mass_ratio"]
    # As wide as in the paper, 8 with the printed limit at 7; wider if the limit is larger.
    left, end = settings["incidence"]
    wide = max(8.0, printed * 8 / 7)
    right = wide if left < wide < end else end
    paper = _draw_paper(axes, curves, points, settings)
    added = _draw_added(axes, curves, points, settings)
    experiment = _draw_experiment(shots, curves, points, settings)
    axes.set(xlim=(left, right), ylabel=f"(a) {house_style.REBOUND}")
    axes.set_ylim(*_range(curves["lumped"], right, (-3.0, 2.0)))
    shots.set(xlabel=house_style.INCIDENCE, ylabel=f"(b) {house_style.REBOUND}")
    shots.set_ylim(*_range(curves["lumped.hysteretic, experiment"], right, (-2.0, 1.0)))
    if RUBBER_SPHERE in points:
        house_style.let_in(axes, points[RUBBER_SPHERE])
    _draw_regimes(axes, curves["lumped"], right)
    _draw_printed_limit(axes, printed)
    frequency = math.sqrt(settings["mass_ratio"] / settings["stiffness_ratio"])
    groups = [settings["experiment"][key] for key in ("restitution", "stiffness_ratio")]
    for part, title in (
        (axes, rf"$e = {settings['restitution']:g}$,  $\omega/\Omega = {frequency:.2f}$"),
        (shots, rf"$e = {groups[0]:g}$,  $\zeta^2 = {groups[1]:g}$"),
    ):
        part.text(0.97, 0.06, title, ha="right", transform=part.transAxes)
    gaps = [""] * (2 + len(paper) - len(added))
    house_style.legend_below(
        figure,
        ["(a) in the paper", *paper, "", "(b) added here", *experiment[:2]],
        ["(a) added here", *added, *gaps, *experiment[2:]],
    )
    return figure


def _draw_paper(axes: Axes, curves: Curves, points: Points, settings: Settings) -> Entries:
    """Draw what the paper's figure holds, and return entries of the legend."""
    lumped = rf"lumped model, $\zeta^2 = {settings['stiffness_ratio']:g}$"
    rough = curves["no tangential compliance"]
    entries = [
        _draw_curve(axes, curves["lumped"], lumped, house_style.LUMPED),
        _draw_curve(
            axes, curves["continuum"], "elastic continuum, computed here", house_style.CONTINUUM
        ),
        _draw_curve(axes, rough, "no tangential compliance", house_style.RIGID),
    ]
    series = {RUBBER_SPHERE: ("rubber sphere (Johnson)", RUBBER_POINTS)}
    return entries + house_style.references(axes, points, series)


def _draw_added(axes: Axes, curves: Curves, points: Points, settings: Settings) -> Entries:
    """Draw what this repository adds to the paper's figure, and return entries of the legend."""
    rubber, curve = (
        rf"rubber, $\zeta^2 = {settings['rubber']['stiffness_ratio']:g}$",
        curves["lumped, rubber"],
    )
    lowest = int(curve[Y].argmin())
    place = {
        "textcoords": "offset points",
        "ha": "center",
        "va": "top",
        "fontsize": house_style.NOTE,
    }
    axes.annotate(
        "rubber", (curve[X][lowest], curve[Y][lowest]), (0, -4), color=house_style.GREEN, **place
    )
    entries = [
        _draw_curve(axes, curve, f"lumped model, {rubber}", RUBBER),
        _draw_curve(axes, curves["continuum, rubber"], f"continuum, {rubber}", SOFT_CONTINUUM),
    ]
    entries += house_style.as_printed(axes, curves, X, Y, "Eqs 15, 25")
    series = {"chung_ooi2011/rebound": ("finite elements (Chung & Ooi)", ELEMENT_POINTS)}
    series[LOSSY_RUBBER] = (r"rubber sphere (Cross 2014), $e \approx 0.9$", LOSSY_POINTS)
    return entries + house_style.references(axes, points, series)


def _draw_experiment(axes: Axes, curves: Curves, points: Points, settings: Settings) -> Entries:
    """Draw an experiment and the models of its contact, and return entries of the legend."""
    axes.axhline(0, **house_style.GUIDE)
    e = house_style.restitutions([settings["experiment"]["restitution"]])
    lumped = _draw_curve(
        axes, curves["lumped.hysteretic, experiment"], f"lumped model, {e}", house_style.LUMPED
    )
    models = house_style.draw_lossy_continua(axes, curves, X, Y, e, "experiment")
    series = {MEASURED_ANGLES: ("measured (Kharaz et al.)", GLASS_POINTS)}
    return [*house_style.references(axes, points, series), lumped, *models]


def _draw_curve(axes: Axes, curve: Columns, label: str, style: Style) -> Line2D:
    return axes.plot(curve[X], curve[Y], label=label, **style)[0]


def _range(curve: Columns, right: float, least: tuple[float, float]) -> tuple[float, float]:
    """Range of velocities, at least `least`: down to a curve's lowest, up to its end."""
    drawn = curve[Y][curve[X] <= right]
    return min(least[0], math.floor(drawn.min())), max(least[1], math.ceil(drawn[-1]))


def _draw_regimes(axes: Axes, curve: Columns, right: float) -> None:
    """Draw brackets over the regimes of the solver, and lines where the regime changes."""
    x, regime = (curve[column][curve[X] <= right] for column in (X, "regime"))
    starts = [0, *(np.flatnonzero(regime[1:] != regime[:-1]) + 1)]
    bounds = [*x[starts], right]
    # A regime may be one point, such as normal impact: it has no bracket.
    spans = [
        (start, end, Regime[regime[index]].words)
        for start, end, index in zip(bounds[:-1], bounds[1:], starts, strict=True)
        if end - start > 0.02 * right
    ]
    house_style.brackets(axes, spans)
    for start, _, _ in spans[1:]:
        axes.axvline(start, **house_style.GUIDE)


def _draw_printed_limit(axes: Axes, limit: float) -> None:
    """Mark the paper's limit of slip throughout, (1 + e) m2/m1, against its Eqs 17 to 20."""
    left, right = axes.get_xlim()
    if left < limit < right:
        place = {"transform": axes.get_xaxis_transform()}
        axes.plot([limit, limit], [0.94, 1], **place, **house_style.PRINTED)
        style = {"fontsize": house_style.NOTE, "ha": "center", "va": "top"}
        axes.text(limit, 0.93, "limit as printed", **place, **style)
