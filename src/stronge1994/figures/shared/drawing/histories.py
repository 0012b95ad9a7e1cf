"""Figs 3 and 4: forces and tangential velocity against time."""

from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from stronge1994 import tables
from stronge1994.figures.shared.drawing import house_style
from stronge1994.figures.shared.drawing.house_style import Points, Settings, Style
from stronge1994.tables import Table

TIME, VELOCITY = "time [t_c]", "velocity [mu v2(0)]"
NORMAL, FRICTION = "normal_force [m2 Omega v2(0)]", "friction_force [mu m2 Omega v2(0)]"
LIMIT = "friction_limit [mu m2 Omega v2(0)]"
# Friction and velocity of the first restitution are broad and light, below all other lines, with
# which they coincide for a while.
BROAD: Style = {"linewidth": 3, "zorder": 1.9}
FORCES: dict[str, Style] = {
    FRICTION: {"color": house_style.BLUE, "label": r"$F_1/\mu m_2\Omega v_2(0)$"},
    NORMAL: {"color": house_style.BLACK, "label": r"$F_2/m_2\Omega v_2(0)$"},
    LIMIT: {"color": house_style.GREY, "linewidth": 0.6, "label": r"added here: limit $-\mu F_2$"},
}
BAR: Style = {"edgecolor": house_style.BLACK, "linewidth": 0.6}
FILLS = {"stick": "white", "slip": house_style.PALE}


def draw(curves: Table, settings: Settings, points: Points) -> Figure:
    """Draw bars of stick and slip, (a) both forces and (b) velocity of each restitution."""
    contacts = dict(tables.each(curves.assign(**{LIMIT: -curves[NORMAL]}), "e"))
    figure = house_style.new(5.8)
    heights = [0.5 * len(contacts), 5, 4.4]
    bars, forces, velocity = figure.subplots(3, 1, sharex=True, height_ratios=heights)
    frequency = np.sqrt(settings["mass_ratio"] / settings["stiffness_ratio"])
    bars.set_title(
        rf"{house_style.INCIDENCE}$\;= {settings['incidence']:g}$,  "
        rf"$\omega/\Omega = {frequency:.2f}$"
    )
    _draw_bars(bars, list(contacts.values()))
    patterns, quantities = [], []
    for index, (e, curve) in enumerate(contacts.items()):
        dashes = {"linestyle": house_style.of_restitution(e)}
        for column, style in FORCES.items():
            light = {} if index or column != FRICTION else BROAD | {"color": house_style.SKY}
            own = style | dashes | light
            quantities.append(house_style.line(forces, curve, TIME, column, **own))
        black = dashes | {"color": house_style.BLACK}
        light = {} if index else BROAD | {"color": "0.65"}
        label = house_style.parameters(curve)
        house_style.line(velocity, curve, TIME, VELOCITY, label=label, **black | light)
        patterns.append(house_style.key(label, **black))
    series: dict[str, Any] = {}
    for axes, column in ((forces, NORMAL), (forces, FRICTION), (velocity, VELOCITY)):
        series |= house_style.references(axes, points, TIME, column)
    forces.set(ylabel="force", yticks=np.linspace(-1, 1, 5))
    velocity.set(ylabel=r"velocity $v_1(t)/\mu v_2(0)$", xlim=(0, None))
    for axes in (forces, velocity):
        axes.axhline(0, **house_style.GUIDE)
        axes.axvline(1, **house_style.GUIDE)
    house_style.letter([forces, velocity])
    states = [Patch(label=f"it {state}s", facecolor=fill, **BAR) for state, fill in FILLS.items()]
    house_style.legend_below(
        figure, [*quantities[: len(FORCES)], *series.values()], [*patterns, *states]
    )
    return figure


def _draw_bars(axes: Axes, contacts: Sequence[Table]) -> None:
    """Draw a row for each restitution: white while the contact sticks, grey while it slips."""
    axes.set(ylim=(len(contacts) - 0.5, -0.5))
    axes.set_yticks(range(len(contacts)), map(house_style.parameters, contacts))
    axes.tick_params(length=0, labelbottom=False)
    axes.spines[:].set_visible(False)
    for row, curve in enumerate(contacts):
        for start, end, state in states(curve, TIME):
            axes.barh(row, end - start, 0.76, start, color=FILLS[state], **BAR)


def states(curve: Table, time: str) -> Iterator[tuple[float, float, str]]:
    """Phases of a contact: start, end, stick or slip."""
    changes = curve[curve["event"].isin(["stick", "slip"])]
    ends = [*changes[time][1:], curve[time].iloc[-1]]
    yield from zip(changes[time], ends, changes["event"], strict=True)
