"""Fig. 2: force against deflection of the normal and the tangential element."""

from typing import TypeAlias

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from stronge1994.csv_tables import Columns, Curves
from stronge1994.figures.shared.drawing import house_style
from stronge1994.figures.shared.drawing.house_style import Points, Settings

Point: TypeAlias = tuple[float, float]

DEFLECTION, FORCE = "deflection [v2(0)/Omega]", "force [m2 Omega v2(0)]"
# End of the axes, over the largest value: to the right of the lines there is room for a label.
REACH = 1.4


def draw(curves: Curves, settings: Settings, points: Points) -> Figure:
    """Draw one panel for each element, with the paper's symbols on the axes."""
    figure = house_style.new(2.7)
    normal, tangential = figure.subplots(1, 2)
    _draw_normal(normal, curves, settings["restitution"])
    _draw_tangential(tangential, curves["tangential"], settings["stiffness_ratio"])
    figure.align_xlabels()
    return figure


def _draw_normal(axes: Axes, curves: Curves, e: float) -> None:
    origin, peak = _ends(curves["normal loading"])
    _, end = _ends(curves["normal unloading"])
    axes.fill(*zip(origin, peak, end, strict=True), color=house_style.PALE, linewidth=0)
    for name, dashes in (("normal loading", "-"), ("normal unloading", house_style.DASHES[1])):
        line = curves[name]
        axes.plot(line[DEFLECTION], line[FORCE], **(house_style.LUMPED | {"linestyle": dashes}))
    _label_slope(axes, origin, peak, r"slope $\kappa$")
    if e < 1:
        _label_slope(axes, end, peak, r"slope $\kappa/e^2$", right=True)
    axes.set_title(f"$e = {e:g}$, loss $1 - e^2 = {1 - e**2:.3g}$")
    axes.set_xticks([0, peak[0]], ["0", r"$u_2(t_c)$"])
    # The label of the remaining deflection is one line lower: at small e it would overlap the next.
    axes.set_xticks([end[0]], [r"$(1-e^2)\,u_2(t_c)$"], minor=True)
    axes.tick_params(axis="x", which="minor", length=3.5, pad=17)
    axes.set_yticks([0, peak[1]], ["0", r"$\Omega m_2 v_2(0)$"])
    axes.set(xlim=(0, REACH * peak[0]), ylim=(0, REACH * peak[1]))
    axes.set(xlabel="normal deflection $u_2$", ylabel="normal force $F_2$")


def _draw_tangential(axes: Axes, line: Columns, stiffness_ratio: float) -> None:
    axes.axhline(0, **house_style.GUIDE)
    axes.axvline(0, **house_style.GUIDE)
    axes.plot(line[DEFLECTION], line[FORCE], **house_style.LUMPED)
    _, end = _ends(line)
    _label_slope(axes, (0, 0), end, r"slope $\kappa/\zeta^2$")
    axes.set_title(rf"$\zeta^2 = {stiffness_ratio:g}$")
    axes.set_xticks([0])
    axes.set_yticks([0])
    # Both axes have one scale, as in the other panel, so that slopes can be compared.
    reach = REACH * max(end)
    axes.set(xlim=(-reach, reach), ylim=(-reach, reach))
    axes.set(xlabel="tangential deflection $u_1$", ylabel="tangential force $F_1$")


def _ends(line: Columns) -> tuple[Point, Point]:
    """First and last point of a line."""
    first, *_, last = zip(line[DEFLECTION], line[FORCE], strict=True)
    return first, last


def _label_slope(axes: Axes, start: Point, end: Point, text: str, right: bool = False) -> None:
    """Write to the left of the middle of a line, or to the right of its first third."""
    at = np.average([start, end], axis=0, weights=[2, 1] if right else None)
    away, ha, va = ((4, -2), "left", "top") if right else ((-4, 2), "right", "bottom")
    style = {"textcoords": "offset points", "fontsize": house_style.NOTE, "ha": ha, "va": va}
    style["bbox"] = {"color": "white", "pad": 0.5}
    axes.annotate(text, tuple(at), away, **style)
