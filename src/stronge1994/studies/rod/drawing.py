"""Beyond the paper: a slender rod strikes with its tip; rebound, energy, a contact that jams."""

from collections.abc import Iterator, Mapping, Sequence

import numpy as np
from matplotlib import rcParams
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Arc

from planarimpact.common.arrays import Array, Booleans
from planarimpact.common.results import Regime
from stronge1994 import tables
from stronge1994.figures.shared.drawing import histories, house_style
from stronge1994.figures.shared.drawing.house_style import Entries, Points, Settings, Style
from stronge1994.tables import Table

TILT, TIME, ENERGY = "tilt [deg]", "time [1/Omega]", "kinetic_energy [K0]"
ROWS = ("tangential_velocity [v2(0)]", "normal_velocity [v2(0)]", ENERGY)
NORMAL, OVER_MU = "normal_force [m2 Omega v2(0)]", "friction_over_mu [m2 Omega v2(0)]"
COMPLIANT: Style = house_style.LUMPED | {"label": "compliant"}
NEWTON: Style = {"color": house_style.VERMILLION, "linestyle": house_style.DASHES[2]}
NEWTON |= {"linewidth": 1.1, "label": "rigid, Newton"}
CREATED: Style = {"facecolor": house_style.VERMILLION, "alpha": 0.25, "linewidth": 0}
CREATED |= {"label": "creates energy"}
# Friction is broad and below the normal force: where the contact slips, they coincide.
OF_FRICTION: Style = {"color": house_style.SKY, "linewidth": 2.4, "label": r"$F_1/\mu$"}
SMOOTH: Style = {"color": house_style.GREY, "linestyle": house_style.DASHES[1]}
SMOOTH |= {"label": r"$F_2$, $\mu = 0$"}
JAM: Style = {"facecolor": "white", "hatch": "//////", "edgecolor": "0.4", "linewidth": 0.6}
JAM |= {"label": "jams"}
SHADES = {"STICK_SLIP": "white", "SLIP_STICK_SLIP": "0.9", "SLIP_THROUGHOUT": "0.75"}


def draw(curves: Table, settings: Settings, points: Points) -> Figure:
    """Draw (a, b) velocities and (c) energy over the tilt, a column for each ratio; (d) forces."""
    figure = house_style.new(8.6)
    impacts = list(tables.each(curves, "velocity_ratio", variant=["", "Newton"]))
    over_tilt, over_time = figure.add_gridspec(2, 1, height_ratios=[5.7, 2])
    panels = over_tilt.subgridspec(1 + len(ROWS), len(impacts), height_ratios=[0.8, 2, 2, 2])
    panels = panels.subplots(sharex=True, sharey="row", squeeze=False)
    for column, (ratio, own) in zip(panels.T, impacts, strict=True):
        _draw_over_tilt(column, own)
        column[0].set_title(rf"$v_1(0)/v_2(0) = {ratio:g}$")
    house_style.letter(panels[1:, 0])
    house_style.above_each_other(panels[1:, 0])
    for axes in panels[:, 1:].ravel():
        axes.label_outer()
    panels[0, 0].set_yticks([0.5, 1.5, 2.5], ["regime", "jams", "rigid: jams"])
    panels[-1, 0].set_ylim(bottom=0)
    values = rf"$\mu = {settings['friction']:g}$,  $e = {settings['restitution']:g}$"
    figure.suptitle(f"slender rod,  {values}", fontsize=rcParams["axes.titlesize"])
    sketch, forces = over_time.subgridspec(1, 2, width_ratios=[1, 5]).subplots()
    _draw_rod(sketch, settings["contact"])
    lines = _draw_contact(forces, curves, settings["friction"])
    house_style.letter([forces], first=3)
    groups = [_shown(panels[0]), _shown(panels[-1]), lines]
    house_style.legend_below(figure, *groups, titles=["", "(a) to (c)", "(d)"])
    return figure


def _shown(panels: Sequence[Axes]) -> Entries:
    """Entries of the legend for all that some panels show, each label once."""
    pairs = [zip(*axes.get_legend_handles_labels(), strict=True) for axes in panels]
    return list({label: artist for pair in pairs for artist, label in pair}.values())


def _draw_over_tilt(panels: Sequence[Axes], curves: Table) -> None:
    """Draw one column of panels from the curves of one ratio of velocities."""
    compliant, rigid, newton = (
        tables.select(curves, model=model, variant=variant)
        for model, variant in (("lumped", ""), ("rigid", ""), ("rigid", "Newton"))
    )
    _draw_ribbons(panels[0], compliant, rigid)
    for axes, column in zip(panels[1:], ROWS, strict=True):
        axes.axhline(1 if column == ENERGY else 0, **house_style.GUIDE)
        axes.axvline(0, **house_style.GUIDE)
        house_style.line(axes, compliant, TILT, column, **COMPLIANT)
        house_style.rigid(axes, rigid, TILT, column, compliant, label="rigid impulse")
    tilt, energy = newton[TILT], newton[ENERGY]
    differs = ~np.isclose(energy, rigid[ENERGY])
    house_style.line(panels[-1], newton, TILT, ENERGY, differs, **NEWTON)
    panels[-1].fill_between(tilt, 1, energy, where=energy > 1, interpolate=True, **CREATED)
    panels[-1].set_xticks([-60, 0, 60])
    panels[-1].set_xlim(tilt.min(), tilt.max())


def _draw_ribbons(axes: Axes, compliant: Table, rigid: Table) -> None:
    """Draw three rows: regime; jams of the compliant contact; jams of the rigid one."""
    axes.set(ylim=(3, 0))
    axes.tick_params(which="both", length=0, labelbottom=False)
    axes.spines[:].set_visible(False)
    for regime in np.unique(compliant["regime"]):
        style = {"facecolor": SHADES.get(regime, "0.6"), "edgecolor": "0.4", "linewidth": 0.6}
        spans = _spans(compliant[TILT], compliant["regime"] == regime)
        axes.broken_barh(spans, (0.1, 0.8), label=Regime[regime].words, **style)
    for row, curve in enumerate((compliant, rigid), start=1):
        spans = _spans(curve[TILT], curve["jams [1]"] == 1)
        axes.broken_barh(spans, (row + 0.1, 0.8), **JAM)


def _spans(tilt: Array, inside: Booleans) -> list[tuple[float, float]]:
    """Start and width of each range of tilt inside.

    >>> _spans(np.array([0.0, 1.0, 2.0, 3.0]), np.array([True, True, False, True]))
    [(0.0, 1.0), (3.0, 0.0)]
    """
    ends = np.flatnonzero(np.diff(np.asarray(inside, int), prepend=0, append=0)).reshape(-1, 2)
    own = np.asarray(tilt)
    return [(float(own[i]), float(own[j - 1] - own[i])) for i, j in ends]


def _draw_contact(axes: Axes, curves: Table, friction: float) -> Entries:
    """Draw (d) both forces against time, stick and slip above them; entries of the legend."""
    contact, smooth = (tables.select(curves, variant="contact", mu=mu) for mu in (friction, 0.0))
    contact[OVER_MU] = contact["friction_force [m2 Omega v2(0)]"] / friction
    lines = [
        house_style.line(axes, contact, TIME, OVER_MU, **OF_FRICTION),
        house_style.line(axes, contact, TIME, NORMAL, color=house_style.BLACK, label="$F_2$"),
        house_style.line(axes, smooth, TIME, NORMAL, **SMOOTH),
    ]
    axes.axhline(0, **house_style.GUIDE)
    axes.set(xlim=(0, None), ylabel=r"force$/m_2\Omega v_2(0)$")
    house_style.name_spans(axes, list(_phases(contact)))
    return lines


def _phases(contact: Table) -> Iterator[tuple[float, float, str]]:
    """Phases of stick and slip. A slip jams if the body approaches faster at its end."""
    time, approach = contact[TIME], contact["normal_velocity [v2(0)]"]
    for start, end, state in histories.states(contact, TIME):
        first, last = np.interp([start, end], time, approach)
        jams = state == "slip" and last > first
        yield start, end, f"{state}s and jams" if jams else f"{state}s"


def _draw_rod(axes: Axes, contact: Mapping[str, float]) -> None:
    """Sketch the rod on the surface, its tilt, and the direction in which its tip moves."""
    tilt, ratio = contact["tilt"], contact["velocity_ratio"]
    axes.set(xlim=(-0.8, 0.8), ylim=(-0.2, 1.1), aspect="equal", anchor="N", xticks=[], yticks=[])
    axes.spines[:].set_visible(False)
    axes.fill_between([-0.8, 0.8], -0.2, 0, **house_style.SURFACE)
    axes.axhline(0, color=house_style.BLACK, linewidth=0.8)
    axes.plot([0, 0], [0, 1], color=house_style.BLACK, linewidth=0.5, linestyle="--")
    top = -np.sin(np.radians(tilt)), np.cos(np.radians(tilt))
    axes.plot([0, top[0]], [0, top[1]], color=house_style.BLACK, linewidth=3)
    low, high = sorted([90, 90 + tilt])
    axes.add_patch(Arc((0, 0), 1.4, 1.4, theta1=low, theta2=high, linewidth=0.6))
    place = {"ha": "center", "va": "center", "fontsize": house_style.NOTE}
    axes.text(0.4 * top[0], 0.85, r"$\alpha$", **place)
    way = np.sign(ratio)
    arrow = {"arrowstyle": "-|>", "color": house_style.BLACK}
    axes.annotate("", (0.7 * way, 0.13), (0.15 * way, 0.13), arrowprops=arrow)
    axes.text(0.5 * way, 0.3, "$v_1$", **place)
    lines = rf"tilt $\alpha = {tilt:g}\degree$", r"$v_1(0)/v_2(0)$", f"$= {ratio:g}$"
    axes.set_xlabel("\n".join(lines), fontsize=house_style.NOTE)
