"""Beyond the paper: radius of stick over the impact, and the forces of both models."""

from collections.abc import Mapping, Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from planarimpact.ground.arrays import Array
from stronge1994.csv_tables import Curves
from stronge1994.figures.shared.drawing import house_style
from stronge1994.figures.shared.drawing.house_style import Dashes, Points, Settings, Style

TIME, CONTACT, STICK = "time [t_c]", "contact_radius [a_max]", "stick_radius [a_max]"
NORMAL, FRICTION = "normal_force [F2max]", "friction_force [mu F2max]"
# In all panels a pattern of line stands for a model, and a colour for an incidence.
PATTERNS: dict[str, Dashes] = {"continuum": (0, (6, 2)), "lumped": "-"}
RIM: Style = {"color": house_style.BLACK, "linewidth": 0.6}
NORMAL_LINE: Style = {"color": house_style.GREY, "linewidth": 0.8}
FRICTION_LINE: Style = {"linewidth": 1.4}
# Radii between which a curve has its number, if it has any there: one that always slips stays at 0.
LABELLED = 0.15, 0.9


def draw(curves: Curves, settings: Settings, points: Points) -> Figure:
    """Draw (a) radii of contact and stick; below, a panel of forces for each incidence."""
    forces = settings["forces"]
    figure = house_style.new(3.2 + 1.7 * len(forces))
    panels = figure.subplots(1 + len(forces), 1, sharex=True, height_ratios=[3] + [2] * len(forces))
    colours = dict(zip(settings["incidences"], house_style.COLOURS, strict=False))
    _draw_radii(panels[0], curves, colours)
    for letter, axes, x in zip("bcdefg", panels[1:], forces, strict=False):
        _draw_forces(axes, curves, x, colours.get(x, house_style.BLACK))
        axes.set_ylabel(f"({letter}) force")
    panels[-1].set(xlim=(0, 2), xlabel="$t/t_c$")
    black = {"color": house_style.BLACK}
    radii = [
        house_style.key("contact", **RIM),
        house_style.key("stick", linestyle=PATTERNS["continuum"], **black),
        house_style.key(f"number: {house_style.INCIDENCE}", linestyle="none"),
    ]
    kinds = [
        house_style.key(f"$F_2/{house_style.F2MAX}$", **NORMAL_LINE),
        house_style.key(rf"$F_1/\mu {house_style.F2MAX}$", **black, **FRICTION_LINE),
    ]
    models = [
        house_style.key("elastic continuum", linestyle=PATTERNS["continuum"], **black),
        house_style.key("lumped model", linestyle=PATTERNS["lumped"], **black),
    ]
    titles = "radii", "forces", "models"
    house_style.legend_below(figure, radii, kinds, models, titles=titles)
    frequency = (settings["mass_ratio"] / settings["stiffness_ratio"]) ** 0.5
    panels[0].set_title(rf"$e = 1$,  $\omega/\Omega = {frequency:.2f}$")
    return figure


def _draw_radii(axes: Axes, curves: Curves, colours: Mapping[float, str]) -> None:
    """Draw the radius of contact and those of stick, each with its incidence on its line."""
    drawn = {x: curves[f"continuum, x = {x:g}"] for x in colours}
    first = next(iter(drawn.values()))
    axes.plot(first[TIME], first[CONTACT], **RIM)
    lines = [_dense(curve[TIME], curve[STICK]) for curve in drawn.values()]
    rim = _dense(first[TIME], first[CONTACT])
    for number, (x, curve) in enumerate(drawn.items()):
        axes.plot(curve[TIME], curve[STICK], color=colours[x], linestyle=PATTERNS["continuum"])
        place = _apart(lines[number], [*lines[:number], *lines[number + 1 :], rim])
        plate = {"facecolor": "white", "edgecolor": "none", "pad": 1.6}
        style = {"ha": "center", "va": "center", "fontsize": house_style.NOTE, "bbox": plate}
        axes.annotate(f"{x:g}", place, color=colours[x], **style)
    axes.axvline(1, **house_style.GUIDE)
    axes.set(ylim=(0, 1.05), ylabel=r"(a) radius over $a_\mathrm{max}$")


def _dense(time: Array, radius: Array) -> Array:
    """Points of a curve, many also where it jumps; a row of times and one of radii."""
    along = np.concatenate([[0], np.hypot(np.diff(time), np.diff(radius)).cumsum()])
    even = np.linspace(0, along[-1], 300)
    return np.stack([np.interp(even, along, values) for values in (time, radius)])


def _apart(line: Array, others: Sequence[Array]) -> Array:
    """The point of a line that is farthest from the other lines."""
    chosen = (line[1] > LABELLED[0]) & (line[1] < LABELLED[1])
    inside = line[:, chosen] if chosen.any() else line
    gaps = np.hypot(*(inside[:, :, None] - np.concatenate(others, axis=1)[:, None, :]))
    return inside[:, gaps.min(axis=1).argmax()]


def _draw_forces(axes: Axes, curves: Curves, x: float, colour: str) -> None:
    for model, dashes in PATTERNS.items():
        curve = curves[f"{model}, x = {x:g}"]
        axes.plot(curve[TIME], curve[NORMAL], linestyle=dashes, **NORMAL_LINE)
        axes.plot(curve[TIME], curve[FRICTION], color=colour, linestyle=dashes, **FRICTION_LINE)
    axes.axhline(0, **house_style.GUIDE)
    axes.axvline(1, **house_style.GUIDE)
    axes.set(ylim=(-1.1, 1.1), yticks=[-1, 0, 1])
    place = {"ha": "left", "va": "bottom", "transform": axes.transAxes, "color": colour}
    axes.text(0.03, 0.06, rf"{house_style.INCIDENCE} $= {x:g}$", **place)
