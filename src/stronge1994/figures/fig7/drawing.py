"""Fig. 7: largest normal and tangential force against the angle of incidence."""

import math
from collections.abc import Sequence
from typing import TypeAlias

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from stronge1994.csv_tables import Columns, Curves
from stronge1994.curve_names import AS_PRINTED, is_printed, name
from stronge1994.figures.shared.drawing import house_style
from stronge1994.figures.shared.drawing.house_style import Points, Settings, Style

Lines: TypeAlias = Sequence[tuple[str, Columns]]  # label and curve of each friction

X, Y = "angle [deg]", "peak_force [m2 Omega S]"
TANGENTIAL = {"color": house_style.BLUE, "linestyle": house_style.DASHES[1]}
SLIDING = {"facecolor": "none", "edgecolor": "0.75", "linewidth": 0, "hatch": "////"}


def draw(curves: Curves, settings: Settings, points: Points) -> Figure:
    """Draw (a) both peak forces, hatched if slip never stops; (b) what printed equations give."""
    printed = [mu for mu in settings["friction"] if f"{AS_PRINTED}, {name('mu', mu)}" in curves]
    heights = [5.0, 3.6][: 1 + any(map(is_printed, curves))]
    figure = house_style.new(0.75 * sum(heights) + 0.65)
    panels = figure.subplots(len(heights), sharex=True, squeeze=False, height_ratios=heights)
    axes, *more = panels[:, 0]
    _draw_curve(axes, curves["normal"], house_style.LUMPED)
    sliding = curves["slip throughout"]
    axes.fill_between(sliding[X], sliding[Y], **SLIDING)
    lines = []
    for mu in settings["friction"]:
        curve = curves[name("mu", mu)]
        rough = f"no tangential compliance, {name('mu', mu)}"
        house_style.rigid(axes, curves, rough, X, Y, name("mu", mu))
        _draw_curve(axes, curve, TANGENTIAL)
        lines.append((f"{mu:g}", curve))
    house_style.angle_axes(axes, settings["angle"])
    _label_lines(axes, lines)
    top = max(1.0, *(curve[Y].max() for curve in curves.values()))
    axes.set(ylim=(0, top), ylabel=r"largest force over $m_2\Omega S$")
    forces = [
        house_style.key(rf"normal, ${house_style.F2MAX}$", **house_style.LUMPED),
        house_style.key(rf"tangential, ${house_style.F1MAX}$, $\mu$ at the line", **TANGENTIAL),
    ]
    others = [
        house_style.key(rf"${house_style.F1MAX}$, no tangential compliance", **house_style.RIGID),
        Patch(label="slip throughout", **SLIDING),
    ]
    for part in more:
        part.set_xlabel(axes.get_xlabel())
        axes.set(xlabel="", ylabel=rf"(a) {axes.get_ylabel()}")
        entries = _draw_printed(part, curves, lines, printed)
        part.set_ylabel(rf"(b) ${house_style.F1MAX}$ over $m_2\Omega S$")
        forces, others = forces + entries[:1], others + entries[1:]
    house_style.legend_below(figure, forces, others)
    return figure


def _draw_printed(
    axes: Axes, curves: Curves, lines: Lines, printed: Sequence[float]
) -> house_style.Entries:
    """Draw what the printed equations give over the same curves, pale; entries of the legend."""
    for _, curve in lines:
        _draw_curve(axes, curve, TANGENTIAL | {"color": house_style.SKY, "linewidth": 1.0})
    entries = house_style.as_printed(axes, curves, X, Y, "Eqs 31, 32")
    axes.axhline(0, **house_style.GUIDE)
    top = max(curve[Y].max() for _, curve in lines)
    axes.set_ylim(-0.16 * top, 1.08 * top)
    # Each label stands below the foot of its line, but not too close to the label before.
    last, apart = -math.inf, 4.5
    for mu in printed:
        foot = curves[f"{AS_PRINTED}, {name('mu', mu)}"][X][-1]
        last = max(foot, last + apart)
        label = house_style.symbols(name("mu", mu)) if mu == printed[0] else f"{mu:g}"
        place = {"ha": "center", "va": "top", "fontsize": house_style.NOTE}
        axes.text(last, -0.04 * top, label, **place)
    return entries


def _draw_curve(axes: Axes, curve: Columns, style: Style) -> None:
    axes.plot(curve[X], curve[Y], **style)


def _label_lines(axes: Axes, lines: Lines) -> None:
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
        axes.annotate(label, (angle[at], force), ha="center", va="center", **style)
