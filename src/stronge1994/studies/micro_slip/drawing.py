"""Beyond the paper: radius of stick over the impact, and the forces of both models."""

from matplotlib.figure import Figure

from stronge1994 import tables
from stronge1994.figures.shared.drawing import house_style
from stronge1994.figures.shared.drawing.house_style import Dashes, Points, Settings, Style
from stronge1994.tables import Table

TIME, CONTACT, STICK = "time [t_c]", "contact_radius [a_max]", "stick_radius [a_max]"
# A colour stands for an incidence. In panels of forces a pattern of line stands for a model; in the
# first panel, which has the continuum alone, the incidences have patterns too.
PATTERNS: dict[str, Dashes] = {"continuum": (0, (6, 2)), "lumped": "-"}
RIM: Style = {"color": house_style.GREY, "linewidth": 0.8}
FORCES: dict[str, Style] = {
    "normal_force [F2max]": {"color": house_style.GREY, "linewidth": 0.8},
    "friction_force [mu F2max]": {"linewidth": 1.4},
}


def draw(curves: Table, settings: Settings, points: Points) -> Figure:
    """Draw (a) radii of contact and stick; below, a panel of forces for each incidence."""
    contacts = dict(tables.each(curves, "x", model="continuum", x=settings["incidences"]))
    forces = dict(tables.each(curves, "x", model="lumped"))
    figure = house_style.new(3.2 + 1.7 * len(forces))
    panels = figure.subplots(1 + len(forces), 1, sharex=True, height_ratios=[3] + [2] * len(forces))
    colours = dict(zip(contacts, house_style.COLOURS, strict=False))
    # The radius of contact is the same at every incidence.
    own = next(iter(contacts.values()))
    rim = house_style.line(panels[0], own, TIME, CONTACT, label="contact", **RIM)
    stick = []
    for (x, colour), dashes in zip(colours.items(), house_style.DASHES, strict=False):
        style = {"color": colour, "linestyle": dashes}
        style["label"] = f"stick, {house_style.INCIDENCE} $= {x:g}$"
        stick.append(house_style.line(panels[0], contacts[x], TIME, STICK, **style))
    panels[0].set(ylim=(0, 1.05), ylabel=r"radius over $a_\mathrm{max}$")
    for axes, x in zip(panels[1:], forces, strict=True):
        axes.axhline(0, **house_style.GUIDE)
        for model, dashes in PATTERNS.items():
            curve = tables.select(curves, model=model, x=x)
            for column, style in FORCES.items():
                own = {"color": colours.get(x, house_style.BLACK), "linestyle": dashes} | style
                house_style.line(axes, curve, TIME, column, **own)
        axes.set(ylim=(-1.1, 1.1), yticks=[-1, 0, 1], ylabel="force")
        axes.set_title(rf"{house_style.INCIDENCE} $= {x:g}$", pad=3)
    for axes in panels:
        axes.axvline(1, **house_style.GUIDE)
    panels[-1].set_xlim(0, 2)
    house_style.letter(list(panels))
    house_style.above_each_other(list(panels))
    names = rf"$F_2/{house_style.F2MAX}$", rf"$F_1/\mu {house_style.F2MAX}$"
    black = {"color": house_style.BLACK}
    keys = [
        *(house_style.key(n, **black | s) for n, s in zip(names, FORCES.values(), strict=True)),
        *(house_style.key(model, linestyle=d, **black) for model, d in PATTERNS.items()),
    ]
    house_style.legend_below(figure, [rim, *stick], keys, titles=["(a)", "forces, models"])
    frequency = (settings["mass_ratio"] / settings["stiffness_ratio"]) ** 0.5
    panels[0].set_title(rf"$e = 1$,  $\omega/\Omega = {frequency:.2f}$")
    return figure
