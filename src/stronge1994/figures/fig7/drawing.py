"""Fig. 7: largest normal and tangential force against the angle of incidence."""

from matplotlib.figure import Figure

from stronge1994.csv_tables import Curves
from stronge1994.curve_names import name
from stronge1994.figures.shared.drawing import house_style
from stronge1994.figures.shared.drawing.house_style import Points, Settings, Style

X, Y = "angle [deg]", "peak_force [m2 Omega S]"
TANGENTIAL: Style = {"color": house_style.BLUE, "linestyle": house_style.DASHES[1]}
PALE = TANGENTIAL | {"color": house_style.SKY, "linewidth": 1.0}
SLIDING: Style = {"facecolor": "none", "edgecolor": "0.75", "linewidth": 0, "hatch": "////"}


def draw(curves: Curves, settings: Settings, points: Points) -> Figure:
    """Draw (a) both peak forces, hatched if slip never stops; (b) what printed equations give."""
    figure = house_style.new(7.6)
    axes, below = figure.subplots(2, sharex=True, height_ratios=[5, 3.6])
    label = rf"normal, ${house_style.F2MAX}$"
    normal = house_style.line(axes, curves, "normal", X, Y, label=label, **house_style.LUMPED)
    sliding = curves["slip throughout"]
    area = axes.fill_between(sliding[X], sliding[Y], label="slip throughout", **SLIDING)
    values = ", ".join(f"{mu:g}" for mu in settings["friction"])
    label = rf"tangential, ${house_style.F1MAX}$, from below" + f"\n$\\mu = {values}$"
    for mu in settings["friction"]:
        curve = name("mu", mu)
        rough = house_style.rigid(
            axes, curves, f"no tangential compliance, {curve}", X, Y, compliant=curve
        )
        tangential = house_style.line(axes, curves, curve, X, Y, label=label, **TANGENTIAL)
        pale = house_style.line(below, curves, curve, X, Y, label="tangential, solved", **PALE)
    printed = house_style.as_printed(below, curves, X, Y, "Eqs 31, 32")
    below.axhline(0, **house_style.GUIDE)
    axes.set_ylim(0, None)
    below.set_ylabel(rf"${house_style.F1MAX}$ over $m_2\Omega S$")
    house_style.angle_axes([axes, below], settings["angle"])
    house_style.letter([axes, below])
    house_style.legend_below(figure, [normal, tangential], [rough, area, pale, *printed])
    return figure
