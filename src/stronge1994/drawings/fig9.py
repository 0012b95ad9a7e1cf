"""Fig. 9: share of the initial kinetic energy dissipated by friction."""

from collections.abc import Iterator, Sequence

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from stronge1994.csv_tables import Curves
from stronge1994.curve_names import name
from stronge1994.drawings import house_style
from stronge1994.drawings.house_style import Entries, Points, Settings, Style

X, Y = "angle [deg]", "friction_dissipation [m2 S^2/2]"
NOTE = "black, blue: the model's balance of energy\n(correction of the printed figure)"


def draw(curves: Curves, settings: Settings, points: Points) -> Figure:
    """Draw each friction in its colour and line width, each restitution in its pattern of line."""
    figure = house_style.new(4.3)
    axes = figure.subplots()
    for mu, style in _strokes(settings["friction"]):
        for e, dashes in house_style.patterned(settings["restitution"]):
            curve = curves[f"{name('mu', mu)}, {name('e', e)}"]
            axes.plot(curve[X], curve[Y], linestyle=dashes, **style)
    _draw_rigid(axes, curves, settings)
    house_style.angle_axes(axes, settings["angle"])
    axes.set_ylabel(r"dissipated by friction, $2D_1/m_2S^2$")
    patterns = {
        name("e", e): dashes for e, dashes in house_style.patterned(settings["restitution"])
    }
    printed = house_style.as_printed(axes, curves, X, Y, "Eqs 39, 40", patterns)
    if not printed:
        axes.set_ylim(bottom=0)
    else:
        axes.text(0.03, 0.96, NOTE, va="top", transform=axes.transAxes, fontsize=house_style.NOTE)
    values = house_style.restitutions(settings["continua"]["restitution"])
    added = printed + house_style.lossy(axes, curves, X, Y, values)
    house_style.legend_below(figure, *_legend(settings, added))
    return figure


def _strokes(friction: Sequence[float]) -> Iterator[tuple[float, Style]]:
    """Each coefficient of friction with its colour and line width."""
    for index, mu in enumerate(friction):
        colour = house_style.COLOURS[index % len(house_style.COLOURS)]
        yield mu, {"color": colour, "linewidth": 0.9 + 0.7 * index}


def _draw_rigid(axes: Axes, curves: Curves, settings: Settings) -> None:
    """Draw no tangential compliance. Where slip stops, it is one line for all mu and e."""
    pair = f"{name('mu', max(settings['friction']))}, {name('e', max(settings['restitution']))}"
    rough = curves[f"no tangential compliance, {pair}"]
    house_style.rigid(axes, rough[X], rough[Y], curves[pair][Y])


def _legend(settings: Settings, added: Entries) -> tuple[Entries, Entries, Entries]:
    frictions = [
        house_style.key(house_style.symbols(name("mu", mu)), **style)
        for mu, style in _strokes(settings["friction"])
    ]
    restitutions = [
        house_style.key(
            house_style.symbols(name("e", e)), color=house_style.BLACK, linestyle=dashes
        )
        for e, dashes in house_style.patterned(settings["restitution"])
    ]
    others = [house_style.key("no tangential compliance", **house_style.RIGID), *added]
    return frictions, restitutions, others
