"""Beyond the paper: spheres that yield, six models beside finite elements of our own."""

from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from stronge1994 import curve_names
from stronge1994.csv_tables import Curves
from stronge1994.figures.shared.drawing import house_style
from stronge1994.figures.shared.drawing.house_style import Dashes, Points, Series, Settings, Style

X, W, E = "incidence [mu v2(0)]", "velocity [mu v2(0)]", "restitution [1]"
APPROACH, SHARE = "approach [delta_max]", "share_of_elastic_force [1]"
RMS = "rms_distance [mu v2(0)]"
SPHERES, PUSHED = "finite_elements/spheres", "finite_elements/pushed"
# Sets of runs that differ by restitution alone.
SETS = ("calibration", "other restitutions")


class Model(NamedTuple):
    """Style and label of a model."""

    label: str
    colour: str
    dashes: Dashes
    marker: str
    width: float = 1.1

    @property
    def line(self) -> Style:
        """Its line."""
        return {"color": self.colour, "linestyle": self.dashes, "linewidth": self.width}


# A colour for each cause of loss, and patterns, as in the figure `inelastic`.
MODELS = {
    "continuum.plastic": Model(
        "continuum, flows in shear", house_style.VERMILLION, "-", "o", width=1.7
    ),
    "continuum.plastic-elastic-shear": Model(
        "continuum, elastic in shear", house_style.ORANGE, house_style.DASHES[3], "v"
    ),
    "continuum.viscous": Model("continuum, viscous", house_style.BLUE, house_style.DASHES[4], "s"),
    "lumped.hysteretic": Model("lumped, as in the paper", house_style.BLACK, "-", "D", width=0.8),
    "lumped.viscous": Model("lumped, Kelvin–Voigt", house_style.SKY, house_style.DASHES[2], "^"),
    "lumped.unloading-stiffness": Model(
        r"lumped, $e^2\zeta^2$", house_style.PURPLE, house_style.DASHES[1], "P", width=0.9
    ),
}
MEASURED = {
    "color": house_style.BLACK,
    "marker": "o",
    "markersize": 3.2,
    "markerfacecolor": "white",
}
POINTS = "finite elements"


def drawn_curves(curves: Curves, settings: Settings, points: Points) -> Curves:
    """Root mean square distance of each model over all incidences, by restitution."""
    if SPHERES not in points:
        return curves
    series = points[SPHERES]["columns"]
    rows = [np.flatnonzero(series["contact"] == name) for name in np.unique(series["contact"])]
    rows = [own[np.isin(series["set"][own], SETS)] for own in rows]
    # Contacts that were solved at fewer incidences would have another mean.
    rows = [own for own in rows if len(own) == max(map(len, rows))]
    rows.sort(key=lambda own: float(series[E][own].mean()))
    e = np.array([series[E][own].mean() for own in rows])
    tables = {}
    for model in MODELS:
        square = (curves[f"{model}, runs"][W] - series[W]) ** 2
        rms = np.array([np.sqrt(square[own].mean()) for own in rows])
        tables[f"rms of {model}"] = {E: e, RMS: rms}
    return curves | tables


def draw(curves: Curves, settings: Settings, points: Points) -> Figure:
    """Draw (a), (b) two contacts at all incidences, (c) what flows, (d) distances against e."""
    figure = house_style.new(6.3)
    panels = figure.subplots(2, 2)
    contact = settings["contact"]
    for letter, axes, e in zip("ab", panels[0], contact["restitution"], strict=False):
        _draw_contact(axes, curves, e)
        _draw_runs(axes, points.get(SPHERES), contact["poisson_ratio"], e)
        axes.set_title(f"({letter}) $e = {e:g}$")
    panels[0, 1].set_ylabel("")
    _draw_pushed(panels[1, 0], curves, settings["pushed"], points.get(PUSHED))
    _draw_distances(panels[1, 1], curves, points.get(SPHERES))
    keys = [house_style.key(model.label, **model.line) for model in MODELS.values()]
    measured = house_style.key(POINTS, linestyle="none", **MEASURED)
    house_style.legend_below(figure, keys[:3], [*keys[3:], measured])
    return figure


def _draw_contact(axes: Axes, curves: Curves, e: float) -> None:
    axes.axhline(0, **house_style.GUIDE)
    for name, model in reversed(MODELS.items()):
        curve = curves[f"{name}, {curve_names.name('e', e)}"]
        axes.plot(curve[X], curve[W], **model.line)
    axes.set(xlabel=house_style.INCIDENCE, ylabel=house_style.REBOUND)
    axes.set_xlim(curve[X].min(), curve[X].max())


def _draw_runs(axes: Axes, series: Series | None, nu: float, e: float) -> None:
    """Draw the finite elements of one contact, with their errors."""
    if series is None:
        return
    columns = series["columns"]
    of_contact = columns["contact"] == f"nu {nu:g}, mu 0.1, e {e:.2f}"
    own = of_contact & np.isin(columns["set"], SETS)
    bars = {"linestyle": "none", "elinewidth": 0.8, "markeredgewidth": 0.8, "zorder": 3}
    x, w, sigma = series["x"][own], series["y"][own], series["sigma"][1]
    axes.errorbar(x, w, yerr=sigma, label=POINTS, **bars, **MEASURED)


def _draw_pushed(
    axes: Axes, curves: Curves, restitutions: list[float], series: Series | None
) -> None:
    """Draw the force on a contact that yields while it is pushed, each restitution at its line."""
    law = MODELS["continuum.plastic"].line
    note = {"fontsize": house_style.NOTE, "va": "center", "textcoords": "offset points"}
    for e in restitutions:
        name = curve_names.name("pushed, e", e)
        curve = curves[name]
        axes.plot(curve[APPROACH], curve[SHARE], **law)
        end = curve[APPROACH][-1], curve[SHARE][-1]
        axes.annotate(f"$e = {e:g}$", end, (3, 0), annotation_clip=False, **note)
        if series is not None:
            own = series["columns"]["curve"] == name
            style = {"linestyle": "none", "markeredgewidth": 0.8, "zorder": 3}
            axes.plot(series["x"][own], series["y"][own], label=POINTS, **style, **MEASURED)
    axes.set(xlim=(0, 1), ylim=(0, 1.1), ylabel="share of elastic force")
    axes.set_xlabel(r"$\delta/\delta_\mathrm{max}$")
    axes.set_title("(c) pushed sideways while it yields")


def _draw_distances(axes: Axes, curves: Curves, series: Series | None) -> None:
    """Draw the distance of each model against restitution, and a guide at sigma."""
    axes.set(xlabel="restitution $e$", ylabel=r"rms distance $[\mu v_2(0)]$", yscale="log")
    axes.set_title("(d) against finite elements")
    if series is None:
        return
    axes.axhline(series["sigma"][1], **house_style.GUIDE)
    for name, model in reversed(MODELS.items()):
        curve = curves[f"rms of {name}"]
        marks = {"marker": model.marker, "markersize": 3.2, "markerfacecolor": "white"}
        axes.plot(curve[E], curve[RMS], **model.line, **marks)
