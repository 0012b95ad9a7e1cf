"""Fig. 2: force against deflection of the normal and the tangential element."""

from matplotlib.figure import Figure

from stronge1994 import tables
from stronge1994.figures.shared.drawing import house_style
from stronge1994.figures.shared.drawing.house_style import Points, Settings
from stronge1994.tables import Table

DEFLECTION, FORCE = "deflection [v2(0)/Omega]", "force [m2 Omega v2(0)]"


def draw(curves: Table, settings: Settings, points: Points) -> Figure:
    """Draw one panel for each element."""
    figure = house_style.new(3.0)
    normal, tangential = figure.subplots(1, 2)
    e, zeta2 = settings["restitution"], settings["stiffness_ratio"]
    ways = tables.where(curves, variant=["normal loading", "normal unloading"])
    corners = curves[ways][[DEFLECTION, FORCE]].to_numpy().T
    normal.fill(*corners, color=house_style.PALE, linewidth=0, label="_energy lost")
    for axes, variant, name, at, away in (
        (normal, "normal loading", r"slope $\kappa$", 0.5, (-28, 8)),
        (normal, "normal unloading", r"slope $\kappa/e^2$", 1 - 0.4 * e**2, (0, 0)),
        (tangential, "tangential", r"slope $\kappa/\zeta^2$", 0.45, (-38, 12)),
    ):
        curve = tables.select(curves, variant=variant)
        house_style.line(axes, curve, DEFLECTION, FORCE, **house_style.LUMPED)
        house_style.name_curve(axes, curve, DEFLECTION, FORCE, name, at, away)
    note = {"ha": "center", "va": "center", "fontsize": house_style.NOTE}
    height = 0.2
    middle = (height + 1 - e**2 * (1 - height)) / 2
    normal.text(middle, height, f"lost:\n$1 - e^2 = {1 - e**2:.3g}$", **note)
    normal.set(title=f"normal, $e = {e:g}$", xlim=(0, 1.1), ylim=(0, 1.1))
    tangential.set_title(rf"tangential, $\zeta^2 = {zeta2:g}$")
    for guide in (tangential.axhline, tangential.axvline):
        guide(0, **house_style.GUIDE)
    house_style.letter([normal, tangential])
    return figure
