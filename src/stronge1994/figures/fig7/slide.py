"""Slide of Fig. 7: the printed equations of the largest friction force."""

import numpy as np
from matplotlib.figure import Figure

from stronge1994.csv_tables import Curves
from stronge1994.curve_names import AS_PRINTED, name
from stronge1994.figures.fig7.drawing import X, Y
from stronge1994.figures.shared.drawing import house_style, slide
from stronge1994.figures.shared.drawing.house_style import Points, Settings

ANGLE, FORCE = "angle of incidence, degrees", r"largest friction force over $m_2\Omega S$"


def draw(curves: Curves, settings: Settings, points: Points, ground: slide.Ground) -> Figure:
    """Draw the model and the printed equations for two coefficients of friction."""
    frictions = settings["friction"]
    pairs = [name("mu", mu) for mu in dict.fromkeys((frictions[0], frictions[len(frictions) // 3]))]
    printed = {pair: curves.get(f"{AS_PRINTED}, {pair}") for pair in pairs}
    missing = max(
        (
            float(np.max(1 - own[Y] / np.interp(own[X], curves[pair][X], curves[pair][Y])))
            for pair, own in printed.items()
            if own
        ),
        default=0.0,
    )
    title = "Largest friction force against the angle of incidence"
    if missing > 0.01:
        title = (
            "Where stick begins after compression, the printed equations give up to "
            f"{100 * missing:.0f} % too little for the largest friction force"
        )
    figure, axes = slide.new(title, "solved here; equations 31 and 32 of Stronge 1994", ground)
    for pair, own in printed.items():
        model = curves[pair]
        axes.plot(model[X], model[Y], color=ground.blue, linewidth=slide.LINE)
        # Behind the top, where the lines are apart.
        at = float(2 * model[X][model[Y].argmax()] + model[X][-1]) / 3
        text, colours = f"model, {house_style.symbols(pair)}", (ground.blue, ground.paper)
        slide.name_curve(axes, text, model[X], model[Y], at, (14, 14), colours)
        if own:
            style = {"color": ground.vermillion, "linestyle": house_style.DASHES[1]}
            axes.plot(own[X], own[Y], linewidth=slide.LINE, **style)
            at, colours = float(np.mean(own[X][[0, -1]])), (ground.vermillion, ground.paper)
            slide.name_curve(axes, "as printed", own[X], own[Y], at, (-16, -14), colours)
    axes.set(xticks=range(0, 91, 30), xlim=settings["angle"])
    axes.set_ylim(0, 1.2 * max(curves[pair][Y].max() for pair in pairs))
    slide.name_axes(axes, ANGLE, FORCE, ground)
    return figure
