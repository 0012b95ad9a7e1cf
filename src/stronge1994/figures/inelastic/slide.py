"""Slide of inelastic: the least elastic of the measured pairs tells the models apart."""

from matplotlib.figure import Figure

from stronge1994 import curve_names
from stronge1994.csv_tables import Curves
from stronge1994.figures.inelastic.drawing import BETA_0, E
from stronge1994.figures.shared.drawing import house_style, slide
from stronge1994.figures.shared.drawing.house_style import Points, Settings

PAPER, OTHER = "lumped.hysteretic", "continuum.viscous"
# Ratio of the paper's model and a measurement from which the title states it.
CLEARLY = 1.5


def draw(curves: Curves, settings: Settings, points: Points, ground: slide.Ground) -> Figure:
    """Draw bands of two models, and the measured pairs."""
    series = points.get(settings["points"])
    title = "Tangential restitution against restitution, by two models"
    low, high = settings["poisson_ratio"]
    data = f"solved here, bands: Poisson's ratio {low:g} to {high:g}"
    if series:
        data += "; measured: Cornell 1999, Joseph & Hunt 2004"
        least = int(series["x"].argmin())
        pair = series["columns"]["pair"][least]
        model = curves[f"{PAPER}, pairs"]
        ratio = float(model[BETA_0][model["pair"] == pair][0] / series["y"][least])
        if ratio > CLEARLY:
            title = (
                f"For {pair} the paper's model gives {ratio:.1f} times the tangential restitution "
                "that was measured"
            )
    figure, axes = slide.new(title, data, ground)
    edges = [curve_names.name("nu", nu) for nu in settings["poisson_ratio"]]
    e = min(settings["restitution"]) + 0.3 * (1 - min(settings["restitution"]))
    for name, text, colour, dashes, side, offset in (
        (PAPER, "lumped, as in the paper", ground.ink, "-", 1, (16, 16)),
        (OTHER, "continuum, viscous", ground.blue, house_style.DASHES[1], 0, (0, -36)),
    ):
        bounds = [curves[f"{name}, {edge}"] for edge in edges]
        order = bounds[0][E].argsort()
        x, *sides = bounds[0][E][order], *(bound[BETA_0][order] for bound in bounds)
        axes.fill_between(x, *sides, color=colour, alpha=0.15, linewidth=0)
        for beta_0 in sides:
            axes.plot(x, beta_0, color=colour, linestyle=dashes, linewidth=slide.LINE * 0.6)
        outer = sorted(sides, key=lambda beta_0: beta_0.mean())[-side]
        slide.name_curve(axes, text, x, outer, e, offset, (colour, ground.paper))
    if series:
        mark = {"color": ground.vermillion, "marker": "o", "markersize": slide.MARK * 0.8}
        mark |= {"elinewidth": slide.LINE / 2, "capsize": 8, "capthick": slide.LINE / 2}
        errors = dict(zip(("xerr", "yerr"), series["sigma"], strict=True))
        axes.errorbar(series["x"], series["y"], linestyle="none", zorder=3, **mark, **errors)
        here = series["x"][[least]], series["y"][[least]], float(series["x"][least])
        colours = ground.vermillion, ground.paper
        slide.name_curve(axes, f"measured: {pair}", *here, (0, 34), colours)
    axes.set_xlim(min(settings["restitution"]), max(settings["restitution"]) + 0.02)
    axes.set_ylim(bottom=0)
    x_label, y_label = "restitution $e$", r"tangential restitution $\beta_0$"
    slide.name_axes(axes, x_label, y_label, ground)
    return figure
