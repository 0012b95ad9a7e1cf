"""Figs 3 and 4: forces and tangential velocity against time."""

from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from stronge1994 import tables
from stronge1994.figures.shared.drawing import house_style
from stronge1994.figures.shared.drawing.house_style import (
    OURS,
    PAPERS,
    Points,
    Settings,
    Style,
)
from stronge1994.tables import Table

TIME, VELOCITY = "time [t_c]", "velocity [mu v2(0)]"
NORMAL, FRICTION = "normal_force [m2 Omega v2(0)]", "friction_force [mu m2 Omega v2(0)]"
SHARE = "friction_over_limit [1]"
# Columns of the forces, their colours, and their names with the place of each beside its curve.
FORCES: dict[str, tuple[Style, Style]] = {
    FRICTION: (
        {"color": house_style.BLUE},
        {"name": r"$F_1/\mu m_2\Omega v_2(0)$", "at": 1.55, "away": (-56, -12)},
    ),
    NORMAL: (
        {"color": house_style.BLACK},
        {"name": r"$F_2/m_2\Omega v_2(0)$", "at": 1.6, "away": (38, 12)},
    ),
}
X_MARK: Style = {"color": house_style.BLACK, "marker": "x", "linestyle": "none"}
X_MARK |= {"markersize": 7, "markeredgewidth": 1.4, "label": "at separation"}
BAR: Style = {"edgecolor": house_style.BLACK, "linewidth": 0.6}
FILLS = {"stick": "white", "slip": house_style.PALE}


def draw(curves: Table, settings: Settings, points: Points) -> Figure:
    """Draw bars of stick and slip, (a) forces and (b) velocity; (c) friction over its limit."""
    contacts = dict(tables.each(curves, "e"))
    figure = house_style.new(6.6)
    heights = [0.5 * len(contacts), 5, 4.4, 1.9]
    bars, *panels = figure.subplots(4, 1, sharex=True, height_ratios=heights)
    forces, velocity, share = panels
    frequency = np.sqrt(settings["mass_ratio"] / settings["stiffness_ratio"])
    # The paper states the ratio of frequencies, and only a range of the incidence.
    bars.set_title(
        rf"$\omega/\Omega = {frequency:.2f}$;  chosen here: {house_style.INCIDENCE}"
        rf"$\,= {settings['incidence']:g}$"
    )
    _draw_bars(bars, list(contacts.values()))
    entries = []
    for e, curve in contacts.items():
        dashes: Style = {"linestyle": house_style.of_restitution(e)}
        for column, (style, _) in FORCES.items():
            house_style.line(forces, curve, TIME, column, label="_", **style | dashes)
        black = dashes | {"color": house_style.BLACK, "label": house_style.parameters(curve)}
        entries.append(house_style.line(velocity, curve, TIME, VELOCITY, **black))
        last = curve.iloc[-1:]
        (final,) = velocity.plot(last[TIME], last[VELOCITY], **X_MARK)
        # At first contact and at separation both forces vanish, and their ratio has no value.
        pressed = curve[curve[NORMAL] > 0]
        ratio = pressed.assign(**{SHARE: pressed[FRICTION] / pressed[NORMAL]})
        house_style.line(share, ratio, TIME, SHARE, **black | {"label": "_"})
    longest = max(contacts.values(), key=lambda contact: float(contact[TIME].max()))
    for column, (style, name) in FORCES.items():
        house_style.name_curve(forces, longest, TIME, column, **style | name)
    series: dict[str, Any] = {}
    for axes, column in ((forces, NORMAL), (forces, FRICTION), (velocity, VELOCITY)):
        series |= house_style.references(axes, points, TIME, column)
    forces.set(ylabel="force", ylim=(-1.1, 1.1), yticks=np.linspace(-1, 1, 5))
    velocity.set(ylabel=r"$v_1(t)/\mu v_2(0)$", xlim=(0, None))
    share.set(ylabel=r"$F_1/\mu F_2$", ylim=(-1.2, 1.2), yticks=[-1, 0, 1])
    for axes in panels:
        axes.axhline(0, **house_style.GUIDE)
        axes.axvline(1, **house_style.GUIDE)
    house_style.letter(panels, [PAPERS, PAPERS, f"{OURS}: friction over its limit"])
    house_style.above_each_other(panels)
    states = [Patch(label=f"{state}s", facecolor=fill, **BAR) for state, fill in FILLS.items()]
    house_style.legend_below(figure, entries, states, [final, *series.values()])
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
