"""Beyond the paper: radius of stick over the impact, and the forces of both models."""

from collections.abc import Sequence

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from stronge1994.csv_tables import Curves
from stronge1994.drawings import house_style
from stronge1994.drawings.house_style import Entries, Points, Settings

TIME, CONTACT, STICK = "time [t_c]", "contact_radius [a_max]", "stick_radius [a_max]"
NORMAL, FRICTION = "normal_force [F2max]", "friction_force [mu F2max]"
NORMAL_LINE = {"color": house_style.GREY, "linewidth": 0.8}
FRICTION_LINE = {"color": house_style.BLUE, "linewidth": 1.4}
LUMPED, CONTINUUM = "-", (0, (6, 2))


def draw(curves: Curves, settings: Settings, points: Points) -> Figure:
    """Draw (a) radii of contact and stick; below, a panel of forces for each incidence."""
    forces = settings["forces"]
    figure = house_style.new(3.4 + 1.9 * len(forces))
    panels = figure.subplots(1 + len(forces), 1, sharex=True, height_ratios=[3] + [2] * len(forces))
    edges = _draw_radii(panels[0], curves, settings["incidences"])
    for letter, axes, x in zip("bcdefg", panels[1:], forces, strict=False):
        _draw_forces(axes, curves, x)
        axes.set_ylabel(f"({letter}) force")
    panels[-1].set(xlim=(0, 2), xlabel="$t/t_c$")
    lines = [
        house_style.key(r"$F_2/F_{2,\mathrm{max}}$", **NORMAL_LINE),
        house_style.key(r"$F_1/\mu F_{2,\mathrm{max}}$", **FRICTION_LINE),
        house_style.key("elastic continuum", color=house_style.BLACK, linestyle=CONTINUUM),
        house_style.key("lumped model", color=house_style.BLACK, linestyle=LUMPED),
    ]
    house_style.legend_below(figure, edges, lines, titles=("radii", "forces"))
    frequency = (settings["mass_ratio"] / settings["stiffness_ratio"]) ** 0.5
    panels[0].set_title(rf"$e = 1$,  $\omega/\Omega = {frequency:.2f}$")
    return figure


def _draw_radii(axes: Axes, curves: Curves, incidences: Sequence[float]) -> Entries:
    """Draw the radius of contact and those of stick, and return entries of the legend."""
    first = curves[f"continuum, x = {incidences[0]:g}"]
    rim = {"color": house_style.BLACK, "linewidth": 0.6}
    entries = axes.plot(first[TIME], first[CONTACT], label="contact", **rim)
    for x, (colour, dashes) in zip(incidences, house_style.CYCLE, strict=False):
        curve = curves[f"continuum, x = {x:g}"]
        label = rf"stick, {house_style.INCIDENCE} $= {x:g}$"
        entries += axes.plot(curve[TIME], curve[STICK], color=colour, linestyle=dashes, label=label)
    axes.axvline(1, **house_style.GUIDE)
    axes.set(ylim=(0, 1.05), ylabel=r"(a) radius over $a_\mathrm{max}$")
    return entries


def _draw_forces(axes: Axes, curves: Curves, x: float) -> None:
    for model, dashes in (("continuum", CONTINUUM), ("lumped", LUMPED)):
        curve = curves[f"{model}, x = {x:g}"]
        axes.plot(curve[TIME], curve[NORMAL], linestyle=dashes, **NORMAL_LINE)
        axes.plot(curve[TIME], curve[FRICTION], linestyle=dashes, **FRICTION_LINE)
    axes.axhline(0, **house_style.GUIDE)
    axes.axvline(1, **house_style.GUIDE)
    axes.set(ylim=(-1.1, 1.1), yticks=[-1, 0, 1])
    place = {"ha": "left", "va": "bottom", "transform": axes.transAxes}
    axes.text(0.03, 0.06, rf"{house_style.INCIDENCE} $= {x:g}$", **place)
