"""Beyond the paper: digits of the lumped model's solution, beside those that are possible."""

from matplotlib.figure import Figure

from stronge1994 import tables
from stronge1994.figures.shared.drawing import house_style
from stronge1994.figures.shared.drawing.house_style import Points, Settings, Style
from stronge1994.tables import Table

OUTPUTS = {
    "velocity": "velocity",
    "peak_friction": "peak friction",
    "dissipation": "dissipation",
}
OMEGA = "omega [Omega]"
# As pixels inside the SVG: thousands of marks would be too many shapes.
MARK: Style = {"linestyle": "none", "marker": "o", "markersize": 1.8, "markeredgewidth": 0.4}
MARK |= {"color": house_style.BLUE, "markerfacecolor": "none", "rasterized": True}
MARK |= {"label": "output of an impact"}
# Digits fewer than allowed; see the comparison `stability-digits` for the second.
LINES = {"as many as allowed": (0, "-"), "2 digits fewer": (2, house_style.DASHES[1])}
DIGITS = range(0, 17, 4)


def draw(curves: Table, settings: Settings, points: Points) -> Figure:
    """Draw digits found (a) to (c) against the ratio of frequencies, (d) to (f) against allowed."""
    impacts = tables.select(curves, variant="impacts")
    figure = house_style.new(5.6)
    panels = figure.subplots(2, len(OUTPUTS), sharey=True)
    columns = zip(panels.T, "abc", "def", OUTPUTS.items(), strict=True)
    for (above, below), first, second, (name, title) in columns:
        found, allowed = f"digits_{name} [1]", f"digits_allowed_{name} [1]"
        house_style.line(above, impacts, OMEGA, found, **MARK)
        house_style.line(below, impacts, allowed, found, **MARK)
        for label, (fewer, dashes) in LINES.items():
            style = {"color": house_style.BLACK, "linewidth": 0.7, "linestyle": dashes, "zorder": 3}
            below.axline((0, -fewer), slope=1, label=label, **style)
        above.set(xscale="log", xlabel=r"$\omega/\Omega$", title=f"({first}) {title}")
        below.set(xlim=(-0.8, 16.8), xticks=DIGITS, xlabel="digits allowed")
        below.set_title(f"({second}) {title}")
        for axes in (above, below):
            axes.set(ylim=(-0.8, 16.8), yticks=DIGITS, ylabel="")
    for axes in panels[:, 0]:
        axes.set_ylabel("digits found")
    house_style.legend_below(figure, *([entry] for entry in below.lines))
    return figure
