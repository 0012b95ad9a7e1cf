"""Figs 3 and 4: forces and tangential velocity against time."""

from collections.abc import Iterator

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MultipleLocator

from stronge1994.csv_tables import Columns, Curves
from stronge1994.figures.shared.drawing import house_style
from stronge1994.figures.shared.drawing.house_style import Dashes, Points, Settings

TIME, VELOCITY = "time [t_c]", "velocity [mu v2(0)]"
FRICTION = "friction_force [mu m2 Omega v2(0)]"

NORMAL_LINE = {"color": house_style.BLACK, "label": r"$F_2/m_2\Omega v_2(0)$"}
# Curves of two restitutions coincide for a while. So the first is broad and light, and the others
# are thin and dark on top of it. The broad line is also below the normal force, with which friction
# coincides where the contact slips.
BROAD = {"linewidth": 3, "zorder": 1.9}
FRICTION_LINES = (BROAD | {"color": house_style.SKY}, {"color": house_style.BLUE})
VELOCITY_LINES = (BROAD | {"color": "0.65"}, {"color": house_style.BLACK})
FRICTION_KEY = FRICTION_LINES[0] | {"label": r"$F_1/\mu m_2\Omega v_2(0)$"}
LIMIT_LINE = {"color": house_style.GREY, "linewidth": 0.6, "label": r"added here: limit $-\mu F_2$"}

CROSS = {"color": house_style.BLACK, "markersize": 6, "clip_on": False}
NORMAL, LIMIT = "normal_force [m2 Omega v2(0)]", "friction_limit [mu m2 Omega v2(0)]"


def draw(curves: Curves, settings: Settings, points: Points) -> Figure:
    """Draw bars of stick and slip, (a) both forces and (b) velocity of each restitution."""
    # Beside the friction its limit, where it acts backward.
    curves = {name: curve | {LIMIT: -curve[NORMAL]} for name, curve in curves.items()}
    figure = house_style.new(5.8)
    heights = [0.5 * len(curves), 5, 4.4]
    bars, forces, velocity = figure.subplots(3, 1, sharex=True, height_ratios=heights)
    frequency = np.sqrt(settings["mass_ratio"] / settings["stiffness_ratio"])
    bars.set_title(
        rf"{house_style.INCIDENCE}$\;= {settings['incidence']:g}$,  "
        rf"$\omega/\Omega = {frequency:.2f}$"
    )
    _draw_bars(bars, curves)
    _draw_forces(forces, curves)
    _draw_velocity(velocity, curves)
    velocity.xaxis.set_major_locator(MultipleLocator(0.5))
    velocity.set_xlim(0, max(2.0, *(curve[TIME][-1] for curve in curves.values())))
    quantities = [house_style.key(**style) for style in (NORMAL_LINE, FRICTION_KEY, LIMIT_LINE)]
    patterns = [
        house_style.key(house_style.symbols(name), color=house_style.BLACK, linestyle=dashes)
        for name, dashes in _patterns(curves)
    ]
    cross = house_style.key("separation", linestyle="none", marker="x", **CROSS)
    house_style.legend_below(figure, quantities, [*patterns, cross])
    return figure


def _draw_bars(axes: Axes, curves: Curves) -> None:
    """Draw a row for each restitution: white while the contact sticks, grey while it slips."""
    axes.set(ylim=(len(curves), 0))
    axes.set_yticks(np.arange(len(curves)) + 0.5, [house_style.symbols(name) for name in curves])
    axes.tick_params(length=0, labelbottom=False)
    axes.spines[:].set_visible(False)
    for row, curve in enumerate(curves.values()):
        for start, end, state in _states(curve):
            fill = "white" if state == "stick" else house_style.PALE
            bar = {
                "color": fill,
                "edgecolor": house_style.BLACK,
                "linewidth": 0.6,
                "clip_on": False,
            }
            axes.barh(row + 0.5, end - start, 0.76, start, **bar)
            # A short last bar has its label behind it. Other short bars have no label.
            place = {"va": "center_baseline", "fontsize": house_style.NOTE}
            if end - start > 0.15:
                axes.text((start + end) / 2, row + 0.5, state, ha="center", **place)
            elif end == curve[TIME][-1]:
                axes.text(end + 0.02, row + 0.5, state, **place)


def _states(curve: Columns) -> Iterator[tuple[float, float, str]]:
    """Phases of a contact: start, end, stick or slip."""
    changes = np.flatnonzero(np.isin(curve["event"], ["stick", "slip"]))
    for start, end in zip(changes, [*changes[1:], -1], strict=True):
        yield curve[TIME][start], curve[TIME][end], str(curve["event"][start])


def _draw_forces(axes: Axes, curves: Curves) -> None:
    for later, dashes, columns in _lines(curves):
        time = columns[TIME]
        axes.plot(time, columns[LIMIT], linestyle=dashes, **LIMIT_LINE)
        axes.plot(time, columns[NORMAL], linestyle=dashes, **NORMAL_LINE)
        axes.plot(time, columns[FRICTION], linestyle=dashes, **FRICTION_LINES[later])
    axes.axhline(0, **house_style.GUIDE)
    axes.axvline(1, **house_style.GUIDE)
    axes.set(ylim=(-1.1, 1.1), yticks=np.linspace(-1, 1, 5), ylabel="(a) force")
    below = {"xycoords": axes.get_xaxis_transform(), "va": "center", "fontsize": house_style.NOTE}
    axes.annotate(r"compression $\leftarrow$", (0.98, -0.06), ha="right", **below)
    axes.annotate(r"$\rightarrow$ restitution", (1.02, -0.06), ha="left", **below)


def _draw_velocity(axes: Axes, curves: Curves) -> None:
    for name, (later, dashes, columns) in zip(curves, _lines(curves), strict=True):
        axes.plot(columns[TIME], columns[VELOCITY], linestyle=dashes, **VELOCITY_LINES[later])
        end = columns[TIME][-1], columns[VELOCITY][-1]
        axes.plot(*end, "x", **CROSS)
        away, ha, va = ((5, -4), "left", "top") if later else ((-6, 5), "right", "bottom")
        place = {"textcoords": "offset points", "ha": ha, "va": va}
        axes.annotate(house_style.symbols(name), end, away, fontsize=house_style.NOTE, **place)
    axes.axhline(0, **house_style.GUIDE)
    axes.axvline(1, **house_style.GUIDE)
    axes.set(xlabel="$t/t_c$", ylabel=r"(b) velocity $v_1(t)/\mu v_2(0)$")
    axes.margins(y=0.13)


def _patterns(curves: Curves) -> Iterator[tuple[str, Dashes]]:
    """Names of the curves, `e = NUMBER`, each with the pattern of its restitution."""
    for name in curves:
        yield name, house_style.of_restitution(float(name.removeprefix("e = ")))


def _lines(curves: Curves) -> Iterator[tuple[bool, Dashes, Columns]]:
    """Whether a curve is not the first, its line pattern and columns; compression is drawn once."""
    for index, (name, dashes) in enumerate(_patterns(curves)):
        drawn = curves[name][TIME] >= (1 if index else 0)
        columns = {
            key: curves[name][key][drawn] for key in (TIME, NORMAL, FRICTION, LIMIT, VELOCITY)
        }
        yield index > 0, dashes, columns
