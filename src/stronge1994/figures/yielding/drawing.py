"""Beyond the paper: spheres that yield, six models and finite elements of our own."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from planarimpact.common.arrays import Booleans
from stronge1994 import tables
from stronge1994.figures.shared.drawing import house_style, model_lines
from stronge1994.figures.shared.drawing.house_style import Points, Scatter, Settings
from stronge1994.figures.shared.drawing.model_lines import POINT, STYLES
from stronge1994.tables import Table

X, W, E = "incidence [mu v2(0)]", "velocity [mu v2(0)]", "restitution [1]"
APPROACH, SHARE = "approach [delta_max]", "share_of_elastic_force [1]"
SPHERES, PUSHED = "finite_elements/spheres", "finite_elements/pushed"
# Sets of runs that differ by restitution alone.
SETS = ("calibration", "other restitutions")


def draw(curves: Table, settings: Settings, points: Points) -> Figure:
    """Draw (a), (b) two contacts at all incidences, (c) what flows, (d) distances against e."""
    figure = house_style.new(6.3)
    panels = figure.subplots(2, 2)
    runs, contact = points[SPHERES], settings["contact"]
    for letter, axes, (e, own) in zip("ab", panels[0], tables.each(curves, "e"), strict=True):
        axes.axhline(0, **house_style.GUIDE)
        model_lines.draw(axes, own, X, W)
        of_contact = f"nu {contact['poisson_ratio']:g}, mu 0.1, e {e:.2f}"
        own = tables.where(runs.columns, set=SETS, contact=of_contact)
        measured = _draw_points(axes, runs, own)
        axes.set(xlim=settings["incidence"], title=f"({letter}) $e = {e:g}$")
    pushed, by_restitution = panels[1]
    for e, curve in tables.each(curves, "e", variant="pushed"):
        model_lines.draw(pushed, curve, APPROACH, SHARE)
        _draw_points(pushed, points[PUSHED], tables.where(points[PUSHED].columns, e=e))
        end = curve[[APPROACH, SHARE]].iloc[-1]
        note = {"fontsize": house_style.NOTE, "va": "center", "textcoords": "offset points"}
        pushed.annotate(f"$e = {e:g}$", end, (3, 0), annotation_clip=False, **note)
    pushed.set(xlim=(0, 1), ylim=(0, 1.1), title="(c) pushed sideways while it yields")
    _draw_distances(by_restitution, curves, runs.columns)
    by_restitution.axhline(runs.sigma[1][0], **house_style.GUIDE)
    models = tables.select(curves, variant="runs")["model"].unique()
    keys = [house_style.key(**STYLES[model]) for model in models]
    house_style.legend_below(figure, keys[:3], [*keys[3:], measured])
    return figure


def _draw_points(axes: Axes, series: Scatter, rows: Booleans) -> house_style.Entries:
    """Draw some points of finite elements, and return their entry of the legend."""
    return house_style.measured(axes, series.at(rows), label="finite elements", **POINT)


def _draw_distances(axes: Axes, curves: Table, runs: Table) -> None:
    """Draw the root mean square distance of each model over all incidences, by restitution."""
    alike = runs[runs["set"].isin(SETS)].groupby("contact")
    # Contacts that were solved at fewer incidences would have another mean.
    whole = alike.filter(lambda own: len(own) == alike.size().max())
    contacts = whole["contact"]
    e = whole[E].groupby(contacts).mean().sort_values()
    for model, own in tables.each(curves, "model", variant="runs"):
        squares = np.square(own[W] - runs[W])[whole.index]
        rms = np.sqrt(squares.groupby(contacts).mean()[e.index])
        axes.plot(e.to_numpy(), rms.to_numpy(), **STYLES[model])
    axes.set(yscale="log", xlabel="restitution", ylabel=r"rms distance, $\mu v_2(0)$")
    axes.set_title("(d) against finite elements")
