"""Fig. 7: largest normal and tangential force against the angle of incidence."""

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from stronge1994.csv_tables import Columns, Curves
from stronge1994.curve_names import name
from stronge1994.drawings import house_style
from stronge1994.drawings.house_style import Points, Settings, Style

X, Y = "angle [deg]", "peak_force [m2 Omega S]"
TANGENTIAL = {"color": house_style.BLUE, "linestyle": house_style.DASHES[1]}
SLIDING = {"facecolor": "none", "edgecolor": "0.75", "linewidth": 0, "hatch": "////"}


def draw(curves: Curves, settings: Settings, points: Points) -> Figure:
    """Draw both peak forces; dotted without tangential compliance, hatched if slip never stops."""
    figure = house_style.new(4.4)
    axes = figure.subplots()
    _draw_curve(axes, curves["normal"], house_style.LUMPED)
    sliding = curves["slip throughout"]
    axes.fill_between(sliding[X], sliding[Y], **SLIDING)
    lines = []
    for mu in settings["friction"]:
        curve = curves[name("mu", mu)]
        rough = curves[f"no tangential compliance, {name('mu', mu)}"]
        house_style.rigid(axes, rough[X], rough[Y], curve[Y])
        _draw_curve(axes, curve, TANGENTIAL)
        lines.append((f"{mu:g}", curve))
    house_style.angle_axes(axes, settings["angle"])
    _label_lines(axes, lines)
    top = max(1.0, *(curve[Y].max() for curve in curves.values()))
    axes.set(ylim=(0, top), ylabel=r"largest force over $m_2\Omega S$")
    forces = [
        house_style.key(r"normal, $F_2^{max}$", **house_style.LUMPED),
        house_style.key(r"tangential, $F_1^{max}$, $\mu$ at the line", **TANGENTIAL),
    ]
    others = [
        house_style.key(r"$F_1^{max}$, no tangential compliance", **house_style.RIGID),
        Patch(label="slip throughout", **SLIDING),
    ]
    printed = house_style.as_printed(axes, curves, X, Y, "Eqs 31, 32")
    house_style.legend_below(figure, forces + printed[:1], others + printed[1:])
    return figure


def _draw_curve(axes: Axes, curve: Columns, style: Style) -> None:
    axes.plot(curve[X], curve[Y], **style)


def _label_lines(axes: Axes, lines: Sequence[tuple[str, Columns]]) -> None:
    """Write labels into the lines, at the angle where the lines are furthest apart."""
    left, right = axes.get_xlim()
    # Away from both ends, where a label would cross the frame.
    angle = np.linspace(left, right, 361)[20:-20]
    forces = np.array([np.interp(angle, curve[X], curve[Y]) for _, curve in lines])
    normal = np.cos(np.radians(angle))
    # Labels must keep away from the axis and from the normal force too.
    gaps = np.diff(np.sort(np.vstack([0 * angle, forces, normal]), axis=0), axis=0)
    at = int(gaps.min(axis=0).argmax())
    box = {"facecolor": "white", "edgecolor": "none", "pad": 0.8}
    style = {"color": house_style.BLUE, "fontsize": house_style.NOTE, "bbox": box}
    for (label, _), force in zip(lines, forces[:, at], strict=True):
        axes.text(angle[at], force, label, ha="center", va="center", **style)
