"""Beyond the paper: spheres that yield, six models beside finite elements of our own."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from planarimpact.common.arrays import Booleans
from stronge1994.csv_tables import Columns, Curves
from stronge1994.curve_names import ELASTIC_IN_SHEAR, name
from stronge1994.figures.shared.drawing import beside, house_style
from stronge1994.figures.shared.drawing.beside import POINT, STYLES
from stronge1994.figures.shared.drawing.house_style import Points, Series, Settings

X, W, E = "incidence [mu v2(0)]", "velocity [mu v2(0)]", "restitution [1]"
APPROACH, SHARE = "approach [delta_max]", "share_of_elastic_force [1]"
SPHERES, PUSHED = "finite_elements/spheres", "finite_elements/pushed"
# Sets of runs that differ by restitution alone.
SETS = ("calibration", "other restitutions")
MODELS = (*beside.MODELS, ELASTIC_IN_SHEAR)


def draw(curves: Curves, settings: Settings, points: Points) -> Figure:
    """Draw (a), (b) two contacts at all incidences, (c) what flows, (d) distances against e."""
    figure = house_style.new(6.3)
    panels = figure.subplots(2, 2)
    runs, contact = points[SPHERES], settings["contact"]
    for letter, axes, e in zip("ab", panels[0], contact["restitution"], strict=True):
        axes.axhline(0, **house_style.GUIDE)
        beside.lines(axes, curves, name("e", e), X, W, MODELS)
        of_contact = f"nu {contact['poisson_ratio']:g}, mu 0.1, e {e:.2f}"
        own = np.isin(runs["columns"]["set"], SETS) & (runs["columns"]["contact"] == of_contact)
        measured = _draw_points(axes, runs, own)
        axes.set(xlim=settings["incidence"], title=f"({letter}) $e = {e:g}$")
    pushed, by_restitution = panels[1]
    for e in settings["pushed"]:
        title = name("pushed, e", e)
        line = STYLES["continuum.plastic"] | {"marker": ""}
        house_style.line(pushed, curves, title, APPROACH, SHARE, **line)
        _draw_points(pushed, points[PUSHED], points[PUSHED]["columns"]["curve"] == title)
        end = curves[title][APPROACH][-1], curves[title][SHARE][-1]
        note = {"fontsize": house_style.NOTE, "va": "center", "textcoords": "offset points"}
        pushed.annotate(f"$e = {e:g}$", end, (3, 0), annotation_clip=False, **note)
    pushed.set(xlim=(0, 1), ylim=(0, 1.1), title="(c) pushed sideways while it yields")
    _draw_distances(by_restitution, curves, runs["columns"])
    by_restitution.axhline(runs["sigma"][1], **house_style.GUIDE)
    keys = [house_style.key(**STYLES[model]) for model in MODELS]
    house_style.legend_below(figure, keys[:3], [*keys[3:], measured])
    return figure


def _draw_points(axes: Axes, series: Series, rows: Booleans) -> house_style.Entries:
    """Draw some points of finite elements, and return their entry of the legend."""
    own = {axis: series[axis][rows] for axis in "xy"}
    return house_style.measured(axes, series | own, label="finite elements", **POINT)


def _draw_distances(axes: Axes, curves: Curves, runs: Columns) -> None:
    """Draw the root mean square distance of each model over all incidences, by restitution."""
    alike = np.isin(runs["set"], SETS)
    rows = [np.flatnonzero(alike & (runs["contact"] == one)) for one in np.unique(runs["contact"])]
    # Contacts that were solved at fewer incidences would have another mean.
    rows = [own for own in rows if len(own) == max(map(len, rows))]
    rows.sort(key=lambda own: float(runs[E][own].mean()))
    e = [runs[E][own].mean() for own in rows]
    for model in MODELS:
        square = (curves[f"{model}, runs"][W] - runs[W]) ** 2
        axes.plot(e, np.sqrt([square[own].mean() for own in rows]), **STYLES[model])
    axes.set(yscale="log", xlabel="restitution", ylabel=r"rms distance, $\mu v_2(0)$")
    axes.set_title("(d) against finite elements")
