"""Fig. 9: share of the initial kinetic energy dissipated by friction."""

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from stronge1994 import tables
from stronge1994.figures.shared.drawing import house_style, model_lines
from stronge1994.figures.shared.drawing.house_style import COLOURS, Entries, Points, Settings, Style
from stronge1994.names import CONTINUA, NO_SOLUTION, PRINTED
from stronge1994.tables import Table

X, Y = "angle [deg]", "friction_dissipation [m2 S^2/2]"
PALE: Style = {"color": "0.7", "linewidth": 2.5, "label": "balance of energy"}


def draw(curves: Table, settings: Settings, points: Points) -> Figure:
    """Draw (a) the balance of energy, with two continua; (b) the printed equations over it."""
    figure = house_style.new(7.2)
    axes, below = figure.subplots(2, sharex=True, height_ratios=[4, 3.6])
    balances = [
        (curve, _stroke(index, e) | {"label": house_style.parameters(curve)})
        for index, (_, of_friction) in enumerate(tables.each(curves, "mu", model="lumped"))
        for e, curve in tables.each(of_friction, "e")
    ]
    balance = [house_style.line(axes, curve, X, Y, **style) for curve, style in balances]
    # Where slip stops, it is one line for all mu and e.
    largest = {key: max(curve[key].iloc[0] for curve, _ in balances) for key in ("mu", "e")}
    rigid, lumped = (tables.select(curves, model=model, **largest) for model in ("rigid", "lumped"))
    added = [house_style.rigid(axes, rigid, X, Y, compliant=lumped)]
    continua = curves[tables.where(curves, model=CONTINUA)]
    for e, of_restitution in continua.groupby("e", sort=False):
        for _, own in of_restitution.groupby("mu", sort=False):
            lines = model_lines.draw(axes, own, X, Y, f", $e = {e:g}$")
        added += lines
    added += _draw_printed(below, curves, balances)
    balance += house_style.references(axes, points, X, Y).values()
    axes.set(ylim=(0, None), title="the model's balance of energy")
    below.axhline(0, **house_style.GUIDE)
    below.set_title("Eqs 39 to 41 as printed")
    house_style.angle_axes([axes, below], settings["angle"])
    house_style.letter([axes, below])
    house_style.legend_below(figure, balance, added)
    return figure


def _stroke(index: int, e: float) -> Style:
    """Line of a curve: colour and width by the place of its friction, pattern by restitution."""
    colour, width = COLOURS[index % len(COLOURS)], 0.9 + 0.7 * index
    return {"color": colour, "linewidth": width, "linestyle": house_style.of_restitution(e)}


def _draw_printed(axes: Axes, curves: Table, balances: list[tuple[Table, Style]]) -> Entries:
    """Draw the printed equations over the balance of energy, which is pale."""
    entries = [house_style.line(axes, curve, X, Y, **PALE) for curve, _ in balances][:1]
    printed = curves[curves["model"] == PRINTED]
    for curve, style in balances:
        own = printed[tables.where(printed, mu=curve["mu"].iloc[0], e=curve["e"].iloc[0])]
        if (own["variant"] == "").any():
            house_style.line(axes, tables.select(own, variant=""), X, Y, **style)
            # Elsewhere, as in slip throughout, the printed equations agree with the balance.
            same = (curve[X] <= own[X].min()) | (curve[X] >= own[X].max())
            house_style.line(axes, curve, X, Y, same, **style)
    return entries + house_style.as_printed(
        axes, printed[printed["variant"] == NO_SOLUTION], X, Y, ""
    )
