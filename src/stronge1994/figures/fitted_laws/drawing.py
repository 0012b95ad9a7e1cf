"""Laws of discrete-element codes before and after a fit, and the continuum of three pairs."""

from matplotlib.figure import Figure

from stronge1994 import tables
from stronge1994.figures.shared.drawing import house_style
from stronge1994.figures.shared.drawing.house_style import Points, Settings, Style
from stronge1994.tables import Table

X, W = "incidence [mu v2(0)]", "velocity [mu v2(0)]"
LAMMPS = "lammps/rebound"
LAWS = {
    "lammps-hertz-mindlin": ("Hertz and Mindlin", house_style.VERMILLION),
    "lammps-hooke": ("linear springs", house_style.BLUE),
}
# Words, patterns and widths: as a law is usually used, and fitted.
WHEN: dict[str, tuple[str, Style]] = {
    "before": ("usual values", {"linestyle": house_style.DASHES[3], "linewidth": 1.0}),
    "after": ("fitted", {"linestyle": "-", "linewidth": 1.2}),
}
CONTINUUM: Style = {"color": "0.75", "linestyle": "-", "linewidth": 4.0, "zorder": 1.5}
CONTINUUM |= {"label": "continuum of the pair"}
DOTS: Style = {"color": house_style.BLACK, "marker": "o", "markersize": 1.8, "linestyle": "none"}


def draw(curves: Table, settings: Settings, points: Points) -> Figure:
    """Draw a panel for each pair: the continuum, both laws before and after, and LAMMPS itself."""
    figure = house_style.new(3.5)
    pairs = list(tables.each(curves, "pair", variant=["", *WHEN]))
    panels = figure.subplots(1, len(pairs), sharey=True, squeeze=False)[0]
    for letter, axes, (pair, own) in zip("abcdef", panels, pairs, strict=False):
        axes.axhline(0, **house_style.GUIDE)
        exact = house_style.line(axes, tables.select(own, model="continuum"), X, W, **CONTINUUM)
        columns: dict[str, house_style.Entries] = {when: [] for when in WHEN}
        for law, (words, colour) in LAWS.items():
            for when, (state, style) in WHEN.items():
                style = style | {"label": f"{words}, {state}", "color": colour}
                curve = tables.select(own, model=law, variant=when)
                columns[when].append(house_style.line(axes, curve, X, W, **style))
        if LAMMPS in points:
            series = points[LAMMPS].at(tables.where(points[LAMMPS].columns, pair=pair))
            axes.plot(series.x, series.y, zorder=3, **DOTS)
        about = settings["pairs"][pair]
        axes.set_title(f"({letter}) {pair}, {about['loss']}\n$e = {about['restitution']:g}$")
        axes.set_xlim(0, settings["incidence_max"])
        axes.label_outer()
    dots = house_style.key("LAMMPS itself", **DOTS)
    house_style.legend_below(figure, [*columns["before"], exact], [*columns["after"], dots])
    return figure
