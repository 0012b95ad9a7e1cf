"""Beyond the paper: a slender rod strikes with its tip; rebound, energy, a contact that jams."""

from collections.abc import Mapping, Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Arc, Patch

from planarimpact import Regime
from planarimpact.ground.arrays import Array
from stronge1994 import curve_names
from stronge1994.csv_tables import Column, Columns, Curves
from stronge1994.figures.shared.drawing import house_style
from stronge1994.figures.shared.drawing.house_style import Entries, Points, Settings

TILT, TIME = "tilt [deg]", "time [1/Omega]"
ENERGY = "kinetic_energy [K0]"
ROWS = {
    "tangential_velocity [v2(0)]": r"(a) $v_1(t_f)/v_2(0)$",
    "normal_velocity [v2(0)]": r"(b) $v_2(t_f)/v_2(0)$",
    ENERGY: r"(c) $K(t_f)/K(0)$",
}
NORMAL, OVER_MU = "normal_force [m2 Omega v2(0)]", "friction_over_mu [m2 Omega v2(0)]"
NEWTON = {"color": house_style.VERMILLION, "linestyle": (0, (7, 2, 1.5, 2)), "linewidth": 1.1}
CREATED = {"facecolor": house_style.VERMILLION, "alpha": 0.25, "linewidth": 0}
JAM = {"facecolor": "white", "hatch": "//////", "edgecolor": "0.4", "linewidth": 0.6}
SHADES = {"STICK_SLIP": "white", "SLIP_STICK_SLIP": "0.93", "SLIP_THROUGHOUT": "0.8"}
RIBBONS = {"regime": "", "jams": "", "rigid: jams": "rigid, "}  # beginnings of the curves' names


def ribbon(row: str, ratio: str) -> str:
    """Name of the table of one row of parts, over the tilt."""
    return f"ribbon of {row}, {ratio}"


def drawn_curves(curves: Curves, settings: Settings, points: Points) -> Curves:
    """Friction over mu, and the parts of the tilt that have one regime, or jam."""
    contact = curves["contact"]
    over_mu = contact["friction_force [m2 Omega v2(0)]"] / settings["friction"]
    tables = curves | {"contact": contact | {OVER_MU: over_mu}}
    for ratio in settings["velocity_ratio"]:
        name = curve_names.name("v1/v2", ratio)
        for row, kind in RIBBONS.items():
            curve = curves[kind + name]
            labels = curve["regime" if row == "regime" else "jams [1]"]
            tables[ribbon(row, name)] = _parts(curve[TILT], labels)
    return tables


def _parts(x: Array, labels: Column) -> Columns:
    """Edges of parts with one label, half way between two points, and the label behind each."""
    changes = np.flatnonzero(labels[1:] != labels[:-1])
    edges = np.array([x[0], *(x[changes] + x[changes + 1]) / 2, x[-1]])
    return {TILT: edges, "label": labels[[*changes, -1, -1]]}


def draw(curves: Curves, settings: Settings, points: Points) -> Figure:
    """Draw (a, b) velocities and (c) energy over the tilt, a column for each ratio; (d) forces."""
    figure = house_style.new(8.2)
    over_tilt, over_time = figure.subfigures(2, 1, height_ratios=[5.7, 2.5])
    ratios = settings["velocity_ratio"]
    panels = over_tilt.subplots(
        1 + len(ROWS),
        len(ratios),
        sharex=True,
        sharey="row",
        squeeze=False,
        height_ratios=[0.8, 2, 2, 2],
    )
    for column, ratio in zip(panels.T, ratios, strict=True):
        # 94 letters fit beside each other on the ribbons of all columns together.
        _draw_over_tilt(column, curves, f"v1/v2 = {ratio:g}", 94 / len(ratios))
        column[0].set_title(rf"$v_1(0)/v_2(0) = {ratio:g}$")
        column[-1].set_xlabel(r"tilt $\alpha$")
    panels[-1, 0].set_ylim(bottom=0)
    for axes, label in zip(panels[1:, 0], ROWS.values(), strict=True):
        axes.set_ylabel(label)
    panels[0, 0].set_yticks([0.5, 1.5, 2.5], list(RIBBONS))
    groups = rf"$\mu = {settings['friction']:g}$,  $e = {settings['restitution']:g}$"
    over_tilt.suptitle(f"slender rod,  {groups}", fontsize=house_style.STYLE["axes.titlesize"])
    compliant = house_style.key("compliant", **house_style.LUMPED)
    rigid = house_style.key("rigid impulse", **house_style.RIGID)
    newton = house_style.key("rigid, Newton's coefficient", **NEWTON)
    created = Patch(label="creates energy", **CREATED)
    jam = Patch(label="jams: friction presses the tip in faster", **JAM)
    house_style.legend_below(over_tilt, [compliant, rigid], [newton, created, jam])
    sketch, forces = over_time.subplots(1, 2, width_ratios=[1, 5])
    _draw_rod(sketch, settings["contact"])
    house_style.legend_below(over_time, *_draw_contact(forces, curves))
    return figure


def _draw_over_tilt(panels: Sequence[Axes], curves: Curves, name: str, letters: float) -> None:
    compliant, rigid, newton = (
        curves[f"{kind}{name}"] for kind in ("", "rigid, ", "rigid, Newton, ")
    )
    _draw_ribbons(panels[0], [curves[ribbon(row, name)] for row in RIBBONS], letters)
    for axes, column in zip(panels[1:], ROWS, strict=True):
        axes.axhline(1 if column == ENERGY else 0, **house_style.GUIDE)
        axes.axvline(0, **house_style.GUIDE)
        axes.plot(compliant[TILT], compliant[column], **house_style.LUMPED)
        house_style.rigid(axes, curves, f"rigid, {name}", TILT, column, name)
    energy = newton[ENERGY]
    panels[-1].plot(
        newton[TILT], np.where(np.isclose(energy, rigid[ENERGY]), np.nan, energy), **NEWTON
    )
    panels[-1].fill_between(newton[TILT], 1, energy, where=energy > 1, interpolate=True, **CREATED)
    panels[-1].set_xticks([-60, 0, 60], [rf"${angle}\degree$" for angle in (-60, 0, 60)])
    panels[-1].set_xticks([-30, 30], minor=True)
    panels[-1].set_xlim(compliant[TILT][[0, -1]])


def _draw_ribbons(axes: Axes, ribbons: Sequence[Columns], letters: float) -> None:
    """Draw three rows: regime; jams of the compliant contact; jams of the rigid one."""
    axes.set(ylim=(3, 0))
    axes.tick_params(which="both", length=0, labelbottom=False)
    axes.spines[:].set_visible(False)
    regimes, *jammed = (
        list(zip(part[TILT], part[TILT][1:], part["label"], strict=False)) for part in ribbons
    )
    whole = np.ptp(ribbons[0][TILT])
    for start, end, regime in regimes:
        shade = SHADES.get(regime, "0.6")
        frame = {"facecolor": shade, "edgecolor": house_style.BLACK, "linewidth": 0.6}
        axes.barh(0.5, end - start, 0.8, start, clip_on=False, **frame)
        # A bar that is too short for its label has only its shade.
        if (end - start) / whole * letters > len(label := Regime[regime].words):
            place = {"ha": "center", "va": "center_baseline", "fontsize": house_style.NOTE - 1}
            axes.text((start + end) / 2, 0.5, label, **place)
    for row, parts in zip((1.5, 2.5), jammed, strict=True):
        for start, end, jams in parts:
            if jams:
                axes.barh(row, end - start, 0.8, start, **JAM)


def _draw_contact(axes: Axes, curves: Curves) -> list[Entries]:
    """Draw (d) both forces against time, stick and slip above them; entries of the legend."""
    contact, smooth = curves["contact"], curves["contact, mu = 0"]
    normal = {"color": house_style.BLACK, "label": "$F_2$"}
    # This line is broad and below the other: where the contact slips, they coincide.
    friction = {"color": house_style.BLUE, "linewidth": 2.4, "zorder": 1.9, "label": r"$F_1/\mu$"}
    free = {"color": house_style.GREY, "linewidth": 0.9, "linestyle": house_style.DASHES[1]}
    free |= {"label": "$F_2$ without friction"}
    axes.plot(contact[TIME], contact[NORMAL], **normal)
    axes.plot(contact[TIME], contact[OVER_MU], **friction)
    axes.plot(smooth[TIME], smooth[NORMAL], **free)
    axes.axhline(0, **house_style.GUIDE)
    axes.set(xlim=(0, contact[TIME][-1] * 1.08), xlabel=r"$\Omega t$")
    axes.set_ylabel(r"(d) force$/m_2\Omega v_2(0)$")
    _mark_events(axes, contact)
    return [[house_style.key(**style)] for style in (normal, friction, free)]


def _mark_events(axes: Axes, contact: Columns) -> None:
    """Draw brackets of stick and slip. A slip jams if the body approaches faster at its end."""
    event, time, approach = contact["event"], contact[TIME], contact["normal_velocity [v2(0)]"]
    changes = np.flatnonzero(np.isin(event, ["stick", "slip"]))
    spans = []
    for start, end in zip(changes, [*changes[1:], len(time) - 1], strict=True):
        jams = event[start] == "slip" and approach[end] > approach[start]
        word = "slips and jams" if jams else f"{event[start]}s"
        spans.append((time[start], time[end], word))
        axes.axvline(time[end], **house_style.GUIDE)
    house_style.brackets(axes, spans)
    # A short last bracket has its label behind it.
    place = {"va": "center_baseline", "transform": axes.get_xaxis_transform()}
    if spans[-1][1] - spans[-1][0] < 0.08 * time[-1]:
        axes.text(time[-1] * 1.01, 1.07, spans[-1][2], fontsize=house_style.NOTE, **place)
    for index in np.flatnonzero(event == "maximum compression"):
        top = time[index], contact[NORMAL][index]
        axes.plot(*top, "o", color=house_style.BLACK, markersize=3)
        offset = {"xytext": (0, 4), "textcoords": "offset points", "ha": "center"}
        axes.annotate("maximum compression", top, fontsize=house_style.NOTE, **offset)
    axes.margins(y=0.14)


def _draw_rod(axes: Axes, contact: Mapping[str, float]) -> None:
    """Sketch the rod on the surface, its tilt, and the direction in which its tip moves."""
    tilt, ratio = contact["tilt"], contact["velocity_ratio"]
    axes.set(xlim=(-0.8, 0.8), ylim=(-0.2, 1.1), aspect="equal", anchor="N")
    axes.set(xticks=[], yticks=[])
    axes.spines[:].set_visible(False)
    axes.fill_between([-0.8, 0.8], -0.2, 0, **house_style.SURFACE)
    axes.axhline(0, color=house_style.BLACK, linewidth=0.8)
    axes.plot([0, 0], [0, 1], color=house_style.BLACK, linewidth=0.5, linestyle="--")
    x, y = -np.sin(np.radians(tilt)), np.cos(np.radians(tilt))
    axes.plot([0, x], [0, y], color=house_style.BLACK, linewidth=3, solid_capstyle="round")
    ends = sorted([90, 90 + tilt])
    axes.add_patch(Arc((0, 0), 1.4, 1.4, theta1=ends[0], theta2=ends[1], linewidth=0.6))
    half = np.radians(tilt / 2)
    place = {"ha": "center", "va": "center", "fontsize": house_style.NOTE}
    axes.text(-0.82 * np.sin(half), 0.82 * np.cos(half), r"$\alpha$", **place)
    way = np.sign(ratio)
    arrow = {"arrowstyle": "-|>", "color": house_style.BLACK}
    axes.annotate("", (0.7 * way, 0.13), (0.15 * way, 0.13), arrowprops=arrow)
    axes.text(0.5 * way, 0.3, "$v_1$", **place)
    lines = rf"$\alpha = {tilt:g}\degree$", r"$v_1(0)/v_2(0)$", f"$= {ratio:g}$"
    axes.set_xlabel("\n".join(lines), fontsize=house_style.NOTE)
