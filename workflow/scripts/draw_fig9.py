"""Fig. 9: share of the initial kinetic energy dissipated by friction."""

import drawing

from planarimpact.curves.sampling import name

X, Y = "angle [deg]", "friction_dissipation [m2 S^2/2]"
NOTE = "black, blue: exact balance of energy\n(correction of the printed figure)"


def draw(curves, settings, points):
    """Colour and breadth tell friction, the pattern of the line restitution."""
    figure = drawing.new(4.3)
    axes = figure.subplots()
    for mu, style in _strokes(settings["friction"]):
        for e, dashes in drawing.patterned(settings["restitution"]):
            curve = curves[f"{name('mu', mu)}, {name('e', e)}"]
            axes.plot(curve[X], curve[Y], linestyle=dashes, **style)
    _draw_rigid(axes, curves, settings)
    drawing.angle_axes(axes, settings["angle"])
    axes.set_ylabel(r"dissipated by friction, $2D_1/m_2S^2$")
    patterns = {name("e", e): dashes for e, dashes in drawing.patterned(settings["restitution"])}
    printed = drawing.as_printed(axes, curves, X, Y, "Eqs 39, 40", patterns)
    if not printed:
        axes.set_ylim(bottom=0)
    else:
        axes.text(0.03, 0.96, NOTE, va="top", transform=axes.transAxes, fontsize=drawing.NOTE)
    drawing.legend_below(figure, *_legend(settings, printed))
    return figure


def _strokes(friction):
    """Each coefficient of friction with its colour and breadth."""
    for index, mu in enumerate(friction):
        colour = drawing.COLOURS[index % len(drawing.COLOURS)]
        yield mu, {"color": colour, "linewidth": 0.9 + 0.7 * index}


def _draw_rigid(axes, curves, settings):
    """Line of no tangential compliance: where slip halts it is one line for all mu and e."""
    pair = f"{name('mu', max(settings['friction']))}, {name('e', max(settings['restitution']))}"
    rough = curves[f"no tangential compliance, {pair}"]
    drawing.rigid(axes, rough[X], rough[Y], curves[pair][Y])


def _legend(settings, printed):
    frictions = [
        drawing.key(drawing.symbols(name("mu", mu)), **style)
        for mu, style in _strokes(settings["friction"])
    ]
    restitutions = [
        drawing.key(drawing.symbols(name("e", e)), color=drawing.BLACK, linestyle=dashes)
        for e, dashes in drawing.patterned(settings["restitution"])
    ]
    others = [drawing.key("no tangential compliance", **drawing.RIGID), *printed]
    return frictions, restitutions, others
