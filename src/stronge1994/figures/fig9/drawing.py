"""Fig. 9: share of the initial kinetic energy dissipated by friction."""

from collections.abc import Iterator, Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from stronge1994.csv_tables import Curves
from stronge1994.curve_names import AS_PRINTED, NO_SOLUTION, is_printed, name
from stronge1994.figures.shared.drawing import house_style
from stronge1994.figures.shared.drawing.house_style import Entries, Points, Settings, Style

X, Y = "angle [deg]", "friction_dissipation [m2 S^2/2]"
LABEL = r"dissipated by friction, $2D_1/m_2S^2$"
PRINTED = "Eqs 39 to 41 as printed"


def draw(curves: Curves, settings: Settings, points: Points) -> Figure:
    """Draw (a) the balance of energy, with two continua; (b) the printed equations over it."""
    heights = [4.0, 3.6][: 1 + any(map(is_printed, curves))]
    figure = house_style.new(0.75 * sum(heights) + 1.5)
    panels = figure.subplots(len(heights), sharex=True, squeeze=False, height_ratios=heights)
    axes, *more = panels[:, 0]
    for pair, style in _pairs(settings):
        axes.plot(curves[pair][X], curves[pair][Y], **style)
    _draw_rigid(axes, curves, settings)
    values = house_style.restitutions(settings["continua"]["restitution"])
    added = house_style.draw_lossy_continua(axes, curves, X, Y, values)
    house_style.angle_axes(axes, settings["angle"])
    axes.set(ylim=(0, None), ylabel=LABEL)
    for part in more:
        part.set_xlabel(axes.get_xlabel())
        axes.set(xlabel="", ylabel=f"(a) {LABEL}")
        added += _draw_printed(part, curves, settings)
        part.set_ylabel(f"(b) {LABEL}")
        for panel, note in ((axes, "the model's balance of energy"), (part, PRINTED)):
            place = {"va": "top", "transform": panel.transAxes}
            panel.text(0.03, 0.95, note, fontsize=house_style.NOTE, **place)
    house_style.legend_below(figure, *_legend(settings, added))
    return figure


def _draw_printed(axes: Axes, curves: Curves, settings: Settings) -> Entries:
    """Draw the printed equations over the pale balance of energy; return entries of the legend."""
    pale = {"color": house_style.PALE, "linewidth": 2.5, "linestyle": "-"}
    for pair, style in _pairs(settings):
        axes.plot(curves[pair][X], curves[pair][Y], **(style | pale))
    for pair, style in _pairs(settings):
        curve, x = curves[pair], curves[pair][X]
        own = [curves.get(f"{kind}, {pair}") for kind in (AS_PRINTED, NO_SOLUTION)]
        differs = np.concatenate([[], *(part[X] for part in own if part)])
        if own[0]:
            axes.plot(own[0][X], own[0][Y], **style)
        # Elsewhere, as in slip throughout, the printed equations agree with the balance.
        for same in (x <= min(differs, default=np.inf), x >= max(differs, default=np.inf)):
            axes.plot(x[same], curve[Y][same], **style)
    axes.axhline(0, **house_style.GUIDE)
    unsolved = {name: curve for name, curve in curves.items() if name.split(",")[0] == NO_SOLUTION}
    entries = house_style.as_printed(axes, unsolved, X, Y, "")
    return [house_style.key("as in (a)", **pale), *entries]


def _pairs(settings: Settings) -> Iterator[tuple[str, Style]]:
    """Name of each curve with its style."""
    for mu, style in _strokes(settings["friction"]):
        for e in settings["restitution"]:
            dashes = {"linestyle": house_style.of_restitution(e)}
            yield f"{name('mu', mu)}, {name('e', e)}", style | dashes


def _strokes(friction: Sequence[float]) -> Iterator[tuple[float, Style]]:
    """Each coefficient of friction with its colour and line width."""
    for index, mu in enumerate(friction):
        colour = house_style.COLOURS[index % len(house_style.COLOURS)]
        yield mu, {"color": colour, "linewidth": 0.9 + 0.7 * index}


def _draw_rigid(axes: Axes, curves: Curves, settings: Settings) -> None:
    """Draw no tangential compliance. Where slip stops, it is one line for all mu and e."""
    pair = f"{name('mu', max(settings['friction']))}, {name('e', max(settings['restitution']))}"
    house_style.rigid(axes, curves, f"no tangential compliance, {pair}", X, Y, pair)


def _legend(settings: Settings, added: Entries) -> tuple[Entries, Entries, Entries]:
    frictions = [
        house_style.key(house_style.symbols(name("mu", mu)), **style)
        for mu, style in _strokes(settings["friction"])
    ]
    restitutions = [
        house_style.key(
            house_style.symbols(name("e", e)),
            color=house_style.BLACK,
            linestyle=house_style.of_restitution(e),
        )
        for e in settings["restitution"]
    ]
    others = [house_style.key("no tangential compliance", **house_style.RIGID), *added]
    return frictions, restitutions, others
