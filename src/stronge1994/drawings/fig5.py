"""Fig. 5: tangential velocity at separation against incidence, with what has been measured."""

import math

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from planarimpact import Regime
from planarimpact.ground.arrays import Array, ArrayLike
from stronge1994.csv_tables import Columns, Curves
from stronge1994.drawings import house_style
from stronge1994.drawings.house_style import Entries, Points, Series, Settings, Style

X, Y = "incidence [mu v2(0)]", "velocity [mu v2(0)]"
RUBBER = {"color": house_style.GREEN, "linestyle": "-", "linewidth": 1.0}
SOFT_CONTINUUM = {"color": house_style.GREEN, "linestyle": house_style.DASHES[1], "linewidth": 1.0}
EXPERIMENT = {"color": house_style.BLUE, "linestyle": "-", "linewidth": 0.7}
RUBBER_SPHERE = "johnson1983/rubber_sphere"
RUBBER_POINTS: Style = {"color": house_style.BLACK, "marker": "o", "markerfacecolor": "white"}
ELEMENT_POINTS: Style = {"color": house_style.VERMILLION, "marker": "s", "markerfacecolor": "white"}
GLASS_POINTS: Style = {"color": house_style.BLUE, "marker": "o", "markersize": 3}
# These points are measured against the angle: they must be converted to the axes of the figure.
MEASURED_ANGLES = "kharaz2001/tangential_restitution"


def draw(curves: Curves, settings: Settings, points: Points) -> Figure:
    """Draw the paper's curves and series, and additions with their own part of the legend."""
    figure = house_style.new(5.0)
    axes = figure.subplots()
    printed = (1 + settings["restitution"]) * settings["mass_ratio"]
    # As wide as in the paper, 8 with the printed limit at 7; wider if the limit is larger.
    left, end = settings["incidence"]
    wide = max(8.0, printed * 8 / 7)
    right = wide if left < wide < end else end
    paper = _draw_paper(axes, curves, points, settings)
    added = _draw_added(axes, curves, points, settings)
    _set_axes(axes, curves["lumped"], left, right)
    if RUBBER_SPHERE in points:
        house_style.let_in(axes, points[RUBBER_SPHERE])
    _draw_regimes(axes, curves["lumped"], right)
    _draw_printed_limit(axes, printed)
    frequency = math.sqrt(settings["mass_ratio"] / settings["stiffness_ratio"])
    state = rf"$e = {settings['restitution']:g}$,  $\omega/\Omega = {frequency:.2f}$"
    axes.text(0.97, 0.05, state, ha="right", transform=axes.transAxes)
    house_style.legend_below(figure, paper, added, titles=("in the paper", "added here"))
    return figure


def _draw_paper(axes: Axes, curves: Curves, points: Points, settings: Settings) -> Entries:
    """Draw what the paper's figure holds, and return entries of the legend."""
    lumped = rf"lumped model, $\zeta^2 = {settings['stiffness_ratio']:g}$"
    rough = curves["no tangential compliance"]
    entries = [
        _draw_curve(axes, curves["lumped"], lumped, house_style.LUMPED),
        _draw_curve(
            axes, curves["continuum"], "elastic continuum (Maw et al.)", house_style.CONTINUUM
        ),
        _draw_curve(axes, rough, "no tangential compliance", house_style.RIGID),
    ]
    series = {RUBBER_SPHERE: ("rubber sphere (Johnson)", RUBBER_POINTS)}
    return entries + house_style.references(axes, points, series)


def _draw_added(axes: Axes, curves: Curves, points: Points, settings: Settings) -> Entries:
    """Draw what this repository adds, and return entries of the legend."""
    sphere, rubber = settings["experiment"], settings["rubber"]["stiffness_ratio"]
    groups = rf"$\zeta^2 = {sphere['stiffness_ratio']:g}$, $e = {sphere['restitution']:g}$"
    soft = rf"rubber, $\zeta^2 = {rubber:g}$"
    entries = [
        _draw_curve(axes, curves["lumped, rubber"], f"lumped, {soft}", RUBBER),
        _draw_curve(axes, curves["continuum, rubber"], f"continuum, {soft}", SOFT_CONTINUUM),
        _draw_curve(axes, curves["lumped, experiment"], f"lumped, {groups}", EXPERIMENT),
    ]
    series = {
        MEASURED_ANGLES: ("alumina on glass (Kharaz et al.)", GLASS_POINTS),
        "chung_ooi2011/rebound": ("finite elements (Chung & Ooi)", ELEMENT_POINTS),
    }
    restitution = house_style.restitutions([sphere["restitution"]])
    entries += house_style.lossy(axes, curves, X, Y, restitution, "experiment")
    entries += house_style.as_printed(axes, curves, X, Y, "Eqs 15, 25")
    if MEASURED_ANGLES in points:
        points = points | {MEASURED_ANGLES: _contact_series(points[MEASURED_ANGLES])}
    return entries + house_style.references(axes, points, series)


def _draw_curve(axes: Axes, curve: Columns, label: str, style: Style) -> Line2D:
    return axes.plot(curve[X], curve[Y], label=label, **style)[0]


def _contact_series(series: Series) -> Series:
    """Measurements against the angle, converted to the axes of the figure with their errors."""
    groups = [series["parameters"][key] for key in ("mass_ratio", "friction")]
    angle, ratio = series["x"], series["y"]
    angle_error, ratio_error = series["sigma"]
    x, y = contact_velocities(angle, ratio, *groups)
    by_angle = np.subtract(contact_velocities(angle + angle_error, ratio, *groups), (x, y))
    by_ratio = np.subtract(contact_velocities(angle, ratio + ratio_error, *groups), (x, y))
    return {"x": x, "y": y, "sigma": np.hypot(by_angle, by_ratio), "line": False}


def contact_velocities(
    angle: ArrayLike, centre_restitution: ArrayLike, mass_ratio: float, friction: float
) -> tuple[Array, Array]:
    """Measured points of a sphere without spin in the axes of the figure.

    Parameters
    ----------
    angle : array_like
        Angle of incidence in degrees.
    centre_restitution : array_like
        Tangential velocity of the centre, after over before.
    mass_ratio, friction : float
        beta and mu.

    Returns
    -------
    incidence, velocity : ndarray
        x = tan(theta)/mu and w = x (beta e_t - (beta - 1)).

    Examples
    --------
    >>> x, w = contact_velocities(45.0, 1.0, 3.5, 0.5)
    >>> round(float(x), 9), round(float(w), 9)
    (2.0, 2.0)
    """
    x = np.tan(np.radians(angle)) / friction
    return x, x * (mass_ratio * np.asarray(centre_restitution) - (mass_ratio - 1))


def _set_axes(axes: Axes, curve: Columns, left: float, right: float) -> None:
    drawn = curve[Y][curve[X] <= right]
    low, high = min(-3.0, math.floor(drawn.min())), max(2.0, math.ceil(drawn[-1]))
    axes.set(xlim=(left, right), ylim=(low, high), xlabel=house_style.INCIDENCE)
    axes.set_ylabel(house_style.REBOUND)


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
    """Mark the paper's limit of slip throughout, (1 + e) m2/m1, which its Eq. 21 contradicts."""
    left, right = axes.get_xlim()
    if left < limit < right:
        place = {"transform": axes.get_xaxis_transform()}
        axes.plot([limit, limit], [0.955, 1], **place, **house_style.PRINTED)
        style = {
            "color": house_style.GREY,
            "fontsize": house_style.NOTE,
            "ha": "center",
            "va": "top",
        }
        axes.text(limit, 0.945, "limit as printed", **place, **style)
