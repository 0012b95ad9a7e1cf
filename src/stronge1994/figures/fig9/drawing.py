"""Fig. 9: share of the initial kinetic energy dissipated by friction."""

import numpy as np
from matplotlib.figure import Figure

from stronge1994.csv_tables import Curves
from stronge1994.curve_names import AS_PRINTED, NO_SOLUTION, name
from stronge1994.figures.shared.drawing import beside, house_style
from stronge1994.figures.shared.drawing.house_style import COLOURS, Points, Settings, Style

X, Y = "angle [deg]", "friction_dissipation [m2 S^2/2]"
PALE: Style = {"color": "0.7", "linewidth": 2.5, "label": "balance of energy"}


def draw(curves: Curves, settings: Settings, points: Points) -> Figure:
    """Draw (a) the balance of energy, with two continua; (b) the printed equations over it."""
    figure = house_style.new(7.2)
    axes, below = figure.subplots(2, sharex=True, height_ratios=[4, 3.6])
    strokes: dict[str, Style] = {
        f"{name('mu', mu)}, {name('e', e)}": {
            "color": COLOURS[index % len(COLOURS)],
            "linewidth": 0.9 + 0.7 * index,
            "linestyle": house_style.of_restitution(e),
        }
        for index, mu in enumerate(settings["friction"])
        for e in settings["restitution"]
    }
    balance = [house_style.line(axes, curves, pair, X, Y, **strokes[pair]) for pair in strokes]
    # Where slip stops, it is one line for all mu and e.
    pair = f"{name('mu', max(settings['friction']))}, {name('e', max(settings['restitution']))}"
    rough = f"no tangential compliance, {pair}"
    added = [house_style.rigid(axes, curves, rough, X, Y, compliant=pair)]
    continua = settings["continua"]
    for e in continua["restitution"]:
        for mu in settings["friction"]:
            end, note = f"{name('mu', mu)}, {name('e', e)}", f", $e = {e:g}$"
            lines = beside.lines(axes, curves, end, X, Y, continua["models"], note)
        added += lines
    added += [house_style.line(below, curves, pair, X, Y, **PALE) for pair in strokes][:1]
    for pair, style in strokes.items():
        own = [f"{kind}, {pair}" for kind in (AS_PRINTED, NO_SOLUTION)]
        if own[0] not in curves:
            continue
        label = house_style.symbols(pair)
        house_style.line(below, curves, own[0], X, Y, label=label, **style)
        # Elsewhere, as in slip throughout, the printed equations agree with the balance.
        x = curves[pair][X]
        differs = np.concatenate([curves[part][X] for part in own if part in curves])
        same = (x <= differs.min()) | (x >= differs.max())
        house_style.line(below, curves, pair, X, Y, same, **style)
    unsolved = {key: curve for key, curve in curves.items() if key.startswith(NO_SOLUTION)}
    added += house_style.as_printed(below, unsolved, X, Y, "")
    axes.set(ylim=(0, None), title="the model's balance of energy")
    below.axhline(0, **house_style.GUIDE)
    below.set_title("Eqs 39 to 41 as printed")
    house_style.angle_axes([axes, below], settings["angle"])
    house_style.letter([axes, below])
    house_style.legend_below(figure, balance, added)
    return figure
