"""Laws of discrete-element codes before and after a fit, beside the continuum of three pairs."""

from matplotlib.figure import Figure

from stronge1994.csv_tables import Curves
from stronge1994.figures.shared.drawing import house_style
from stronge1994.figures.shared.drawing.house_style import Points, Settings, Style

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
DOTS: Style = {"color": house_style.BLACK, "marker": "o", "markersize": 1.8, "linestyle": "none"}


def draw(curves: Curves, settings: Settings, points: Points) -> Figure:
    """Draw a panel for each pair: the continuum, both laws before and after, and LAMMPS itself."""
    figure = house_style.new(3.5)
    pairs = settings["pairs"]
    panels = figure.subplots(1, len(pairs), sharey=True, squeeze=False)[0]
    for letter, axes, (pair, about) in zip("abcdef", panels, pairs.items(), strict=False):
        axes.axhline(0, **house_style.GUIDE)
        name = f"{pair}, continuum"
        style = CONTINUUM | {"label": "continuum of the pair"}
        exact = house_style.line(axes, curves, name, X, W, **style)
        columns: dict[str, house_style.Entries] = {when: [] for when in WHEN}
        for law, (words, colour) in LAWS.items():
            for when, (state, style) in WHEN.items():
                name, style = f"{pair}, {law}, {when}", style | {"label": f"{words}, {state}"}
                columns[when].append(
                    house_style.line(axes, curves, name, X, W, color=colour, **style)
                )
        if LAMMPS in points:
            series = points[LAMMPS]
            own = [curve.startswith(f"{pair}, ") for curve in series["columns"]["curve"]]
            axes.plot(series["x"][own], series["y"][own], zorder=3, **DOTS)
        axes.set_title(f"({letter}) {pair}, {about['loss']}\n$e = {about['restitution']:g}$")
        axes.set_xlim(0, settings["incidence_max"])
        axes.label_outer()
    dots = house_style.key("LAMMPS itself", **DOTS)
    house_style.legend_below(figure, [*columns["before"], exact], [*columns["after"], dots])
    return figure
