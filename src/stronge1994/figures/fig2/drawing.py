"""Fig. 2: force against deflection of the normal and the tangential element."""

from matplotlib.figure import Figure

from stronge1994 import tables
from stronge1994.figures.shared.drawing import house_style
from stronge1994.figures.shared.drawing.house_style import Points, Settings, Style
from stronge1994.tables import Table

DEFLECTION, FORCE = "deflection [v2(0)/Omega]", "force [m2 Omega v2(0)]"
UNLOADING: Style = house_style.LUMPED | {"linestyle": house_style.DASHES[1]}


def draw(curves: Table, settings: Settings, points: Points) -> Figure:
    """Draw one panel for each element."""
    figure = house_style.new(3.4)
    normal, tangential = figure.subplots(1, 2)
    e, zeta2 = settings["restitution"], settings["stiffness_ratio"]
    ways = tables.where(curves, variant=["normal loading", "normal unloading"])
    corners = curves[ways][[DEFLECTION, FORCE]].to_numpy().T
    lost = rf"energy lost, $1 - e^2 = {1 - e**2:.3g}$"
    (area,) = normal.fill(*corners, color=house_style.PALE, linewidth=0, label=lost)
    lines = [
        house_style.line(
            axes,
            tables.select(curves, variant=variant),
            DEFLECTION,
            FORCE,
            label=label,
            **style,
        )
        for axes, variant, label, style in (
            (normal, "normal loading", r"loading, slope $\kappa$", house_style.LUMPED),
            (normal, "normal unloading", r"unloading, slope $\kappa/e^2$", UNLOADING),
            (tangential, "tangential", r"slope $\kappa/\zeta^2$", house_style.LUMPED),
        )
    ]
    normal.set(title=f"(a) normal, $e = {e:g}$", xlim=(0, None), ylim=(0, None))
    tangential.set_title(rf"(b) tangential, $\zeta^2 = {zeta2:g}$")
    for guide in (tangential.axhline, tangential.axvline):
        guide(0, **house_style.GUIDE)
    house_style.legend_below(figure, [*lines[:2], area], lines[2:], titles=["(a)", "(b)"])
    return figure
