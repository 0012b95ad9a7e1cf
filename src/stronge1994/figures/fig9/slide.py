"""Slide of Fig. 9: the printed equations of the energy that friction takes."""

import numpy as np
from matplotlib.figure import Figure

from stronge1994.csv_tables import Curves
from stronge1994.curve_names import AS_PRINTED, name
from stronge1994.figures.fig9.drawing import X, Y
from stronge1994.figures.shared.drawing import house_style, slide
from stronge1994.figures.shared.drawing.house_style import Points, Settings

ANGLE, SHARE = "angle of incidence, degrees", "share of the kinetic energy that friction takes"


def draw(curves: Curves, settings: Settings, points: Points, ground: slide.Ground) -> Figure:
    """Draw the balance of energy and the printed equations, for one friction and restitution."""
    mu, e = max(settings["friction"]), max(settings["restitution"])
    pair = f"{name('mu', mu)}, {name('e', e)}"
    model, printed = curves[pair], curves.get(f"{AS_PRINTED}, {pair}")
    title, where = "Energy that friction takes, against the angle of incidence", 0
    if printed:
        exact = np.interp(printed[X], model[X], model[Y])
        where = int((printed[Y] - exact).argmax())
        more = 100 * (printed[Y][where] / exact[where] - 1)
        if more > 1:
            title = (
                f"At {printed[X][where]:.0f} degrees the printed equations let friction take "
                f"{more:.0f} % more than the balance of energy"
            )
    data = "solved here; equations 39 to 41 of Stronge 1994, as read here"
    figure, axes = slide.new(title, data, ground)
    axes.plot(model[X], model[Y], color=ground.blue, linewidth=slide.LINE)
    at, colours = model[X][model[Y].argmax()], (ground.blue, ground.paper)
    text = ", ".join(["balance of energy", *map(house_style.symbols, pair.split(", "))])
    slide.name_curve(axes, text, model[X], model[Y], at, (0, 14), colours)
    if printed:
        style = {"color": ground.vermillion, "linestyle": house_style.DASHES[1]}
        axes.plot(printed[X], printed[Y], linewidth=slide.LINE, **style)
        colours = ground.vermillion, ground.paper
        place = float(printed[X][where]), (-20, 14), colours
        slide.name_curve(axes, "as printed", printed[X], printed[Y], *place)
    axes.axhline(0, color=ground.quiet, linewidth=slide.LINE / 3)
    axes.set(xticks=range(0, 91, 30), xlim=settings["angle"])
    axes.set_ylim(top=1.2 * model[Y].max())
    slide.name_axes(axes, ANGLE, SHARE, ground)
    return figure
