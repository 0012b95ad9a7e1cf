"""Fig. 9: share of the initial kinetic energy dissipated by friction."""

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from stronge1994 import tables
from stronge1994.figures.shared.drawing import house_style, model_lines
from stronge1994.figures.shared.drawing.house_style import (
    COLOURS,
    OURS,
    PAPERS,
    Entries,
    Points,
    Settings,
    Style,
)
from stronge1994.names import CONTINUA
from stronge1994.tables import Table

X, Y = "angle [deg]", "friction_dissipation [m2 S^2/2]"
# The balance of energy below other curves.
PALE: Style = {"color": "0.72", "linewidth": 3, "zorder": 1.7, "label": "balance of energy"}


def draw(curves: Table, settings: Settings, points: Points) -> Figure:
    """Draw (a) the balance of energy; for each friction printed equations and continua over it."""
    frictions = dict(tables.each(curves, "mu", model="lumped"))
    largest_first = sorted(frictions, reverse=True)
    figure = house_style.new(3.6 + 2.2 * len(frictions))
    axes, *below = figure.subplots(
        1 + len(frictions), sharex=True, height_ratios=[4] + [3] * len(frictions)
    )
    balances = _draw_balances(axes, frictions)
    # Where slip stops, it is one line for all mu and e.
    largest = {key: max(curve[key].iloc[0] for curve in frictions.values()) for key in ("mu", "e")}
    rigid, lumped = (tables.select(curves, model=model, **largest) for model in ("rigid", "lumped"))
    no_compliance = house_style.rigid(axes, rigid, X, Y, compliant=lumped)
    for panel, mu in zip(below, largest_first, strict=True):
        added = _draw_added(panel, frictions[mu], curves[tables.where(curves, mu=mu)])
        panel.axhline(0, **house_style.GUIDE)
    read, others = house_style.of_print(points)
    series = house_style.references(axes, read, X, Y)
    series |= house_style.references(below[0], others, X, Y)
    for panel in (axes, *below):
        panel.set_ylabel(r"share of $m_2 S^2/2$")
    axes.set_ylim(0, None)
    house_style.angle_axes([axes, *below], settings["angle"])
    headings = [
        f"{PAPERS}, by the balance of energy",
        *(rf"{OURS}: $\mu = {mu:g}$" for mu in largest_first),
    ]
    house_style.letter([axes, *below], headings)
    house_style.above_each_other([axes, *below])
    house_style.legend_below(figure, [*balances, no_compliance, *series.values()], added)
    return figure


def _draw_balances(axes: Axes, frictions: dict[float, Table]) -> Entries:
    """Draw the balance of energy: a colour for each friction, a pattern for each restitution."""
    return [
        house_style.line(
            axes, curve, X, Y, **_stroke(index, e), label=house_style.parameters(curve)
        )
        for index, of_friction in enumerate(frictions.values())
        for e, curve in tables.each(of_friction, "e")
    ]


def _stroke(index: int, e: float) -> Style:
    """Line of a curve: colour and width by the place of its friction, pattern by restitution."""
    colour, width = COLOURS[index % len(COLOURS)], 1.0 + 0.5 * index
    return {"color": colour, "linewidth": width, "linestyle": house_style.of_restitution(e)}


def _draw_added(axes: Axes, balance: Table, curves: Table) -> Entries:
    """Draw the printed equations and the continua of one friction; entries of the legend."""
    entries: Entries = []
    for e, curve in tables.each(balance, "e"):
        style = PALE | {"linestyle": house_style.of_restitution(e)}
        entries.append(house_style.line(axes, curve, X, Y, **style))
    for line in entries[1:]:
        line.set_label("_")
    entries = entries[:1] + house_style.as_printed(axes, curves, X, Y, "Eqs 38-40")
    continua = curves[tables.where(curves, model=CONTINUA)]
    for e, own in continua.groupby("e", sort=False):
        entries += model_lines.draw(axes, own, X, Y, f", $e = {e:g}$")
    return entries
